"""The controller in C99, as a header and a source: what `kernels.digital` does at every sample."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from math import isfinite

from ..errors import MethodUnavailableError
from ..evaluate import loop_of
from ..frozen import Frozen
from ..kernels.layout import BACK_CALCULATION, CLAMPING, MOTOR_OF, TRACKING, TRAVEL, WINDUP
from ..loop import Loop
from ..scenario import Digital
from ..signals import Floats
from ..simulation.digital import FILTER_DAMPING, FILTER_FREQUENCY, rate_filter
from ..simulation.nonlinear import NonlinearLoop
from ..spec import Spec
from .format import Format
from .origin import origin

_STEM = "heli2dof_controller"


@dataclass(frozen=True)
class _Controller(Frozen):
    """The design as the digital rig runs it."""

    loop: Loop
    sample_time: float
    trim: tuple[float, float]
    limits: Floats
    windup: int
    motor_of: Sequence[int]
    tracking: Floats

    @classmethod
    def of(cls, spec: Spec) -> _Controller:
        loop, scenario = loop_of(spec), spec.scenario
        _require_measured(spec)
        system = NonlinearLoop.of(loop, spec.limits, scenario)
        V_p, V_y = loop.design.trim.tolist() if scenario.trim_feedforward else (0.0, 0.0)
        return cls(
            loop,
            (scenario.digital or Digital()).sample_time,
            (V_p, V_y),
            system.limits,
            int(system.modes[WINDUP]),
            system.modes[MOTOR_OF:WINDUP].tolist(),
            system.constants[TRACKING:TRAVEL].reshape(2, 2),
        )

    @property
    def limited(self) -> bool:
        return all(map(isfinite, self.limits))


def _require_measured(spec: Spec) -> None:
    """Raises MethodUnavailableError where the feedback acts on what the functions in C are not given."""
    if spec.place_rotors:
        raise MethodUnavailableError(
            "the controller in C does not feed the rotors' speeds back",
            field="place_rotors",
            hint="Export the design of four states, or take the matrices from another format.",
        )
    if spec.scenario.measured == "observer":
        raise MethodUnavailableError(
            "the controller in C has no observer",
            field="scenario.measured",
            hint="Export the feedback of filtered rates, or take the matrices from another format.",
        )


def render_header(spec: Spec, link: str = "") -> str:
    """Types and prototypes, with what a caller must know."""
    controller = _Controller.of(spec)
    return _HEADER.format(
        head=_head(spec, "c-header", link),
        discretization=_discretization(controller),
        sample_time=repr(controller.sample_time),
        integrals=_INTEGRALS if controller.loop.has_integrators else "",
        largest=LARGEST_READING,
    )


def render_source(spec: Spec, link: str = "") -> str:
    """The constants and the functions."""
    controller = _Controller.of(spec)
    loop, integrates = controller.loop, controller.loop.has_integrators
    F, b = rate_filter(controller.sample_time)
    parts = [
        f"/*\n{_head(spec, 'c-source', link)}\n */",
        f'#include "{_STEM}.h"',
        "#define R(x) ((heli2dof_real)(x))",
        "\n".join(_constants(controller)),
        _FILTER.format(
            filter=_matrix("FILTER", F),
            gain=_vector("FILTER_GAIN", b),
            rate=f"R({FILTER_FREQUENCY**2!r})",
            largest=_number(LARGEST_READING),
            integrals="        state->integral[i] = R(0.0);\n" if integrates else "",
        ),
        _step(
            controller, proportional=bool(loop.proportional.any()), feedforward=bool(loop.feedforward.any())
        ),
    ]
    return "\n\n".join(parts) + "\n"


def _head(spec: Spec, name: str, link: str) -> str:
    safe = link.replace("*", "%2A")  # nothing in a link may end the comment
    return "\n".join(f" * {line}" for line in origin(spec, name, safe))


def _discretization(controller: _Controller) -> str:
    ms = 1e3 * controller.sample_time
    lines = [
        f"Discretization: sample time {ms:g} ms, voltages held between samples (zero-order hold).",
        "The state feedback and the PI loops' proportional part act on the sample itself;",
    ]
    if controller.loop.has_integrators:
        lines += [
            "the integrals are sums, z += Ts * error (forward Euler), updated after the voltages,",
            "so that a sample's voltages hold the errors before it. Anti-windup:",
            f"{_WINDUP_WORDS[controller.windup]}.",
        ]
    else:
        lines += ["nothing integrates."]
    lines += [
        f"The rate filters, 2nd order, {FILTER_FREQUENCY:.6g} rad/s, damping {FILTER_DAMPING:g}, are exact for",
        "held angles.",
    ]
    return "\n".join(f" * {line}" for line in lines)


_WINDUP_WORDS = {
    0: "none",
    CLAMPING: "clamping (an integral that drives its motor farther beyond its limit stands still)",
    BACK_CALCULATION: "back-calculation (the integrals follow what the limits leave)",
}


def _number(value: float) -> str:
    return f"R({float(value)!r})"


def _vector(name: str, values: Iterable[float], unit: str = "") -> str:
    comment = f" /* {unit} */" if unit else ""
    return f"static const heli2dof_real {name}[2] = {{{', '.join(map(_number, values))}}};{comment}"


def _matrix(name: str, rows: Floats, unit: str = "") -> str:
    comment = f" /* {unit} */" if unit else ""
    inner = ",\n".join(f"    {{{', '.join(map(_number, row))}}}" for row in rows.tolist())
    return f"static const heli2dof_real {name}[2][{rows.shape[1]}] = {{{comment}\n{inner}\n}};"


def _constants(controller: _Controller) -> list[str]:
    loop = controller.loop
    lines = [
        _matrix("K", loop.design.K, "u = -K x + v; V/rad, V/rad, V s/rad, V s/rad"),
        _vector("OPERATING_POINT", (loop.design.plant.theta_0, 0.0), "rad"),
        _vector("TRIM", controller.trim, "V"),
    ]
    if loop.proportional.any():
        lines.append(_matrix("PROPORTIONAL", loop.proportional, "volts of each motor per error, V/rad"))
    if loop.feedforward.any():
        lines.append(_matrix("FEEDFORWARD", loop.feedforward, "G(0)^-1, V/rad"))
    if loop.integral is not None:
        lines.append(_matrix("INTEGRAL", loop.integral, "per integral of the errors, V/(rad s)"))
        lines.append(f"static const heli2dof_real SAMPLE_TIME = {_number(controller.sample_time)}; /* s */")
    if controller.limited:
        lines.append(_vector("LIMIT", controller.limits, "V"))
    if controller.windup == BACK_CALCULATION:
        lines.append(_matrix("TRACKING", controller.tracking, "rad/(V s)"))
    if controller.windup == CLAMPING:
        motors = ", ".join(map(str, controller.motor_of))
        lines.append(
            f"static const int MOTOR_OF[2] = {{{motors}}}; /* the motor that each integral drives */"
        )
    return lines


def _step(controller: _Controller, *, proportional: bool, feedforward: bool) -> str:
    integrates = controller.loop.has_integrators
    errors = proportional or integrates
    asked = ["        heli2dof_real u = TRIM[i];"]
    asked += [
        "        for (j = 0; j < 2; j++) {",
        "            u -= K[i][j] * (state->angles[j] - OPERATING_POINT[j]);",
    ]
    asked += ["            u -= K[i][2 + j] * state->rates[j];"]
    asked += ["            u += PROPORTIONAL[i][j] * error[j];"] * proportional
    asked += [
        "            u += FEEDFORWARD[i][j] * (state->reference[j] - OPERATING_POINT[j]);"
    ] * feedforward
    asked += ["            u += INTEGRAL[i][j] * state->integral[j];"] * integrates + ["        }"]
    if controller.limited:
        asked += ["        voltages[i] = u > LIMIT[i] ? LIMIT[i] : u < -LIMIT[i] ? -LIMIT[i] : u;"]
    else:
        asked += ["        voltages[i] = u;"]
    cut = controller.windup in (CLAMPING, BACK_CALCULATION)
    asked += ["        asked[i] = u;"] * (controller.windup == CLAMPING) + [
        "        cut[i] = voltages[i] - u;"
    ] * cut
    lines = [
        "void heli2dof_step(heli2dof_state *state, const heli2dof_real angles[2], const heli2dof_real rates[2],"
    ]
    lines += ["                   const heli2dof_real reference[2], heli2dof_real voltages[2])", "{"]
    names = ["error[2]"] * errors + ["asked[2]"] * (controller.windup == CLAMPING) + ["cut[2]"] * cut
    lines += [f"    heli2dof_real {', '.join(names)};"] * bool(names) + ["    int i, j;", ""]
    lines += ["    hold(state->angles, angles);", "    hold(state->rates, rates);"]
    lines += ["    hold(state->reference, reference);"]
    lines += [
        "    for (i = 0; i < 2; i++)",
        "        error[i] = state->reference[i] - state->angles[i];",
    ] * errors
    lines += ["    for (i = 0; i < 2; i++) {", *asked, "    }"]
    if integrates:
        lines += [
            "    for (i = 0; i < 2; i++) {",
            "        heli2dof_real e = error[i];",
            *_windup(controller.windup),
        ]
        lines += ["        state->integral[i] += SAMPLE_TIME * e;", "    }"]
    return "\n".join([*lines, "}"])


def _windup(kind: int) -> list[str]:
    if kind == BACK_CALCULATION:
        return ["        e += TRACKING[i][0] * cut[0] + TRACKING[i][1] * cut[1];"]
    if kind == CLAMPING:
        return [
            "        const int motor = MOTOR_OF[i];",
            "        const int beyond = cut[motor] > R(0.0) || cut[motor] < R(0.0);",
            "        if (beyond && INTEGRAL[motor][i] * e * asked[motor] > R(0.0))",
            "            e = R(0.0);",
        ]
    return []


_INTEGRALS = "    heli2dof_real integral[2]; /* of the errors of pitch and yaw, rad s */\n"
LARGEST_READING = 1e6
"""Angles, rates and references beyond this, rad or rad/s, are no readings, as are NaN and infinity."""

_HEADER = """\
/*
{head}
 *
{discretization}
 *
 * At every sample: read the angles, call heli2dof_rates (unless the rates are measured), then heli2dof_step,
 * and give the voltages to the motors. Angles in rad, absolute; rates in rad/s; voltages in V, as the motors
 * get them, trim included. Order: pitch, yaw. No allocation, no library, no global state.
 * Where the voltages reach the motors one sample late, they have the trim until the first ones arrive.
 *
 * An angle, rate or reference that is NaN, infinite or beyond +-{largest:g} counts as not read: in its place stands
 * the last good one, for each axis by itself, so that neither filters nor integrals are spoilt and the controller
 * goes on with the next good reading. A rig whose readings stay away for long is not controlled: the caller must
 * stop it. This needs IEEE arithmetic; do not compile with -ffast-math or -ffinite-math-only.
 * Compile with -DHELI2DOF_REAL=float for single precision.
 */
#ifndef HELI2DOF_CONTROLLER_H
#define HELI2DOF_CONTROLLER_H

#ifndef HELI2DOF_REAL
#define HELI2DOF_REAL double
#endif

typedef HELI2DOF_REAL heli2dof_real;

#define HELI2DOF_SAMPLE_TIME {sample_time} /* s */

#ifdef __cplusplus
extern "C" {{
#endif

/* What the controller remembers between samples. */
typedef struct {{
    heli2dof_real filter[2][2]; /* of the rate filters, per axis */
{integrals}    heli2dof_real angles[2], rates[2], reference[2]; /* the last good ones */
}} heli2dof_state;

/* Before the first sample: the rig rests at these angles; one that is not read is taken at the operating point. */
void heli2dof_start(heli2dof_state *state, const heli2dof_real angles[2]);

/* Rates from the angles of this sample, by the filters; once per sample. */
void heli2dof_rates(heli2dof_state *state, const heli2dof_real angles[2], heli2dof_real rates[2]);

/* Voltages of this sample from its angles, rates and reference angles. */
void heli2dof_step(heli2dof_state *state, const heli2dof_real angles[2], const heli2dof_real rates[2],
                   const heli2dof_real reference[2], heli2dof_real voltages[2]);

#ifdef __cplusplus
}}
#endif

#endif
"""

_FILTER = """\
/* x+ = FILTER x + FILTER_GAIN angle, rate = FILTER_RATE x[1] */
{filter}
{gain}
static const heli2dof_real FILTER_RATE = {rate};
static const heli2dof_real LARGEST_READING = {largest};

/* The last good values: what is not read changes nothing. A comparison with NaN is false. */
static void hold(heli2dof_real good[2], const heli2dof_real read[2])
{{
    int i;

    for (i = 0; i < 2; i++)
        if (read[i] >= -LARGEST_READING && read[i] <= LARGEST_READING)
            good[i] = read[i];
}}

void heli2dof_start(heli2dof_state *state, const heli2dof_real angles[2])
{{
    int i;

    for (i = 0; i < 2; i++) {{
        state->angles[i] = OPERATING_POINT[i];
        state->rates[i] = R(0.0);
{integrals}    }}
    hold(state->angles, angles);
    for (i = 0; i < 2; i++) {{
        state->reference[i] = state->angles[i];
        state->filter[i][0] = state->angles[i] / FILTER_RATE;
        state->filter[i][1] = R(0.0);
    }}
}}

void heli2dof_rates(heli2dof_state *state, const heli2dof_real angles[2], heli2dof_real rates[2])
{{
    int i;

    hold(state->angles, angles);
    for (i = 0; i < 2; i++) {{
        heli2dof_real *x = state->filter[i];
        const heli2dof_real x0 = x[0], x1 = x[1];

        rates[i] = FILTER_RATE * x1;
        x[0] = FILTER[0][0] * x0 + FILTER[0][1] * x1 + FILTER_GAIN[0] * state->angles[i];
        x[1] = FILTER[1][0] * x0 + FILTER[1][1] * x1 + FILTER_GAIN[1] * state->angles[i];
    }}
}}"""

_format = partial(Format, stem=_STEM)
HEADER = _format("c-header", "Controller in C99: header", ".h", "text/x-c; charset=utf-8", render_header)
SOURCE = _format("c-source", "Controller in C99: source", ".c", "text/x-c; charset=utf-8", render_source)
