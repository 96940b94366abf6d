"""The controller in C99, as a header and a source: what `kernels.digital` does at every sample."""

from __future__ import annotations

from functools import partial
from textwrap import wrap

from ..kernels.layout import FILTER_DAMPING, FILTER_FREQUENCY
from ..simulation.digital import rate_filter
from ..spec import Spec
from . import c_text
from .c_design import Controller
from .c_text import LARGEST_READING, matrix, number, vector
from .format import Format
from .machine import estimator_in_words, poles_in_words
from .origin import origin

_STEM = "heli2dof_controller"


def render_header(spec: Spec, link: str = "") -> str:
    """Types and prototypes, with what a caller must know."""
    controller = Controller.of(spec)
    prototypes = {name: "\n".join(lines) + ";" for name, lines in c_text.prototypes(controller).items()}
    rates = _RATES.format(prototype=prototypes["rates"]) if controller.sampled is None else ""
    return _HEADER.format(
        head=_head(spec, "c-header", link),
        discretization=_comment(_discretization(spec, controller)),
        use=_comment(_use(controller)),
        sample_time=repr(controller.sample_time),
        members="\n".join(f"    heli2dof_real {member}" for member in _members(controller)),
        start=prototypes["start"],
        rates=rates,
        inputs=_inputs(controller),
        step=prototypes["step"],
    )


def render_source(spec: Spec, link: str = "") -> str:
    """The constants and the functions."""
    controller = Controller.of(spec)
    parts = [
        f"/*\n{_head(spec, 'c-source', link)}\n */",
        f'#include "{_STEM}.h"',
        "#define R(x) ((heli2dof_real)(x))",
        "\n".join(_constants(controller)),
        "\n".join([*_inner_constants(controller), _LARGEST]),
        c_text.HOLD.rstrip(),
    ]
    functions = [c_text.start(controller)]
    if controller.sampled is None:
        functions += [c_text.rates(controller)]
    else:
        functions += [c_text.observe(len(controller.sampled[0]))]
    functions += [c_text.step(controller)]
    return "\n\n".join([*parts, *map("\n".join, functions)]) + "\n"


def _head(spec: Spec, name: str, link: str) -> str:
    safe = link.replace("*", "%2A")  # nothing in a link may end the comment
    return _comment(origin(spec, name, safe))


def _comment(lines: list[str]) -> str:
    return "\n".join(f" * {line}".rstrip() for line in lines)


def _discretization(spec: Spec, controller: Controller) -> list[str]:
    ms = 1e3 * controller.sample_time
    lines = [
        f"Discretization: sample time {ms:g} ms, voltages held between samples (zero-order hold).",
        "The state feedback and the PI loops' proportional part act on the sample itself;"
        if controller.sampled is None
        else "The PI loops' proportional part acts on the sample itself, the state feedback on the estimate;",
    ]
    if controller.integrates:
        lines += [
            "the integrals are sums, z += Ts * error (forward Euler), updated after the voltages,",
            "so that a sample's voltages hold the errors before it. Anti-windup:",
            f"{_windup_in_words(controller)}.",
        ]
    else:
        lines += ["nothing integrates."]
    if controller.sampled is None:
        lines += [
            f"The rate filters, 2nd order, {FILTER_FREQUENCY:.6g} rad/s, damping {FILTER_DAMPING:g}, are exact for",
            "held angles.",
        ]
    return lines + _observer_in_words(spec, controller)


def _observer_in_words(spec: Spec, controller: Controller) -> list[str]:
    observer, states = controller.observer, controller.loop.design.states
    if observer is None:
        return []
    names = ", ".join(state.name for state in states[: observer.order])
    poles = poles_in_words(observer.poles.tolist())
    rotors = "The rotors' speeds v_p, v_y, as the voltages that would hold them, follow the voltages alone. "
    told = (
        "those that the motors have during this sample, which were computed one sample before, and the trim before "
        "the first"
        if controller.delay
        else "those of this sample"
    )
    words = (
        f"The states are not measured: the feedback acts on {estimator_in_words(spec)}.",
        f"x' = A x + B u + L (y - C x) for x = ({names}), y the angles, u the voltages, all in deviations from the "
        f"trim; poles of A - LC: {poles} rad/s. {rotors * (observer.order > 4)}From sample to sample it is exact for "
        "angles and voltages that are held between them. It predicts: a sample's voltages use the estimate from the "
        "samples before it, which then goes on by this sample's angles and by the voltages after their limits, "
        f"{told}.",
    )
    return ["", *(line for paragraph in words for line in wrap(paragraph, 110))]


def _windup_in_words(controller: Controller) -> str:
    if controller.clamps:
        return "clamping (an integral that drives its motor farther beyond its limit stands still)"
    if controller.tracks:
        return "back-calculation (the integrals follow what the limits leave)"
    return "none"


def _use(controller: Controller) -> list[str]:
    """What the caller does at every sample, and what becomes of bad readings."""
    if controller.sampled is not None:
        calls = [
            "At every sample: read the angles, call heli2dof_step, and give the voltages to the motors, every time:",
            "the estimate relies on it. Angles in rad, absolute; voltages in V, as the motors",
        ]
        read, spoilt = "An angle or reference", "the estimate nor integrals"
    elif controller.rotors_measured:
        unless = "" if controller.measured == "filtered" else " (unless the rates are measured)"
        calls = [
            f"At every sample: read the angles and the rotors' speeds, call heli2dof_rates{unless}, then",
            "heli2dof_step, and give the voltages to the motors. A rotor's speed is told by the voltage that",
            "would hold it, in V, absolute. Angles in rad, absolute; rates in rad/s; voltages in V, as the motors",
        ]
        read, spoilt = "An angle, rate, rotor's speed or reference", "filters nor integrals"
    else:
        unless = "" if controller.measured == "filtered" else " (unless the rates are measured)"
        calls = [
            f"At every sample: read the angles, call heli2dof_rates{unless}, then heli2dof_step,",
            "and give the voltages to the motors. Angles in rad, absolute; rates in rad/s; voltages in V, "
            "as the motors",
        ]
        read, spoilt = "An angle, rate or reference", "filters nor integrals"
    return [
        *calls,
        "get them, trim included. Order: pitch, yaw. No allocation, no library, no global state.",
        "Where the voltages reach the motors one sample late, they have the trim until the first ones arrive.",
        "",
        f"{read} that is NaN, infinite or beyond +-{LARGEST_READING:g} counts as not read: in its place stands",
        f"the last good one, for each axis by itself, so that neither {spoilt} are spoilt and the controller",
        "goes on with the next good reading. A rig whose readings stay away for long is not controlled: "
        "the caller must",
        "stop it. This needs IEEE arithmetic; do not compile with -ffast-math or -ffinite-math-only.",
        "Compile with -DHELI2DOF_REAL=float for single precision.",
    ]


def _members(controller: Controller) -> list[str]:
    """Of the state."""
    good = (
        "angles[2], "
        + "rates[2], " * (controller.sampled is None)
        + "rotors[2], " * controller.rotors_measured
    )
    return [
        "filter[2][2]; /* of the rate filters, per axis */"
        if controller.sampled is None
        else f"estimate[{len(controller.sampled[0])}]; /* of the states, in deviations from the trim */",
        *["integral[2]; /* of the errors of pitch and yaw, rad s */"] * controller.integrates,
        *["motors[2]; /* the voltages on their way to the motors, V */"] * controller.told_late,
        f"{good}reference[2]; /* the last good ones */",
    ]


def _inputs(controller: Controller) -> str:
    if controller.sampled is not None:
        return "angles and reference angles"
    return (
        "angles, rates, rotors' speeds and reference angles"
        if controller.rotors_measured
        else ("angles, rates and reference angles")
    )


def _constants(controller: Controller) -> list[str]:
    loop = controller.loop
    units = ("V/rad", "V/rad", "V s/rad", "V s/rad", "V/V", "V/V")[: loop.design.K.shape[1]]
    lines = [
        matrix("K", loop.design.K, f"u = -K x + v; {', '.join(units)}"),
        vector("OPERATING_POINT", (loop.design.plant.theta_0, 0.0), "rad"),
        vector("TRIM", controller.trim, "V"),
    ]
    if controller.sampled is not None or controller.rotors_measured:
        lines.append(
            vector("REST", loop.design.trim, "voltages and rotors' speeds of the rig at rest there, V")
        )
    if controller.told_late:
        lines.append(
            vector("BEFORE", controller.before, "what the motors have until the first ones arrive, V")
        )
    if loop.proportional.any():
        lines.append(matrix("PROPORTIONAL", loop.proportional, "volts of each motor per error, V/rad"))
    if loop.feedforward.any():
        lines.append(matrix("FEEDFORWARD", loop.feedforward, "G(0)^-1, V/rad"))
    if loop.integral is not None:
        lines.append(matrix("INTEGRAL", loop.integral, "per integral of the errors, V/(rad s)"))
        lines.append(f"static const heli2dof_real SAMPLE_TIME = {number(controller.sample_time)}; /* s */")
    if controller.limited:
        lines.append(vector("LIMIT", controller.limits, "V"))
    if controller.tracks:
        lines.append(matrix("TRACKING", controller.tracking, "rad/(V s)"))
    if controller.clamps:
        motors = ", ".join(map(str, controller.motor_of))
        lines.append(
            f"static const int MOTOR_OF[2] = {{{motors}}}; /* the motor that each integral drives */"
        )
    return lines


def _inner_constants(controller: Controller) -> list[str]:
    """Of the rate filters, or of the observer."""
    if controller.sampled is not None:
        names = ("ESTIMATE", "BY_ANGLES", "BY_VOLTAGES")
        return [matrix(name, rows) for name, rows in zip(names, controller.sampled, strict=True)]
    F, b = rate_filter(controller.sample_time)
    return [
        "/* x+ = FILTER x + FILTER_GAIN angle, rate = FILTER_RATE x[1] */",
        matrix("FILTER", F),
        vector("FILTER_GAIN", b),
        f"static const heli2dof_real FILTER_RATE = {number(FILTER_FREQUENCY**2)};",
    ]


_LARGEST = f"static const heli2dof_real LARGEST_READING = {number(LARGEST_READING)};"

_HEADER = """\
/*
{head}
 *
{discretization}
 *
{use}
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
{members}
}} heli2dof_state;

/* Before the first sample: the rig rests at these angles; one that is not read is taken at the operating point. */
{start}

{rates}/* Voltages of this sample from its {inputs}. */
{step}

#ifdef __cplusplus
}}
#endif

#endif
"""

_RATES = """\
/* Rates from the angles of this sample, by the filters; once per sample. */
{prototype}

"""

_format = partial(Format, stem=_STEM)
HEADER = _format("c-header", "Controller in C99: header", ".h", "text/x-c; charset=utf-8", render_header)
SOURCE = _format("c-source", "Controller in C99: source", ".c", "text/x-c; charset=utf-8", render_source)
