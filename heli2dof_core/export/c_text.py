"""The C of the exported controller, piece by piece."""

from __future__ import annotations

from collections.abc import Iterable

from ..signals import Floats
from .c_design import Controller

LARGEST_READING = 1e6
"""Readings beyond this, rad, rad/s, V, are none, as are NaN and infinity."""


def number(value: float) -> str:
    """A literal of the type that the caller has chosen."""
    return f"R({float(value)!r})"


def vector(name: str, values: Iterable[float], unit: str = "") -> str:
    """A constant pair."""
    comment = f" /* {unit} */" if unit else ""
    return f"static const heli2dof_real {name}[2] = {{{', '.join(map(number, values))}}};{comment}"


def matrix(name: str, rows: Floats, unit: str = "") -> str:
    """A constant matrix."""
    comment = f" /* {unit} */" if unit else ""
    inner = ",\n".join(f"    {{{', '.join(map(number, row))}}}" for row in rows.tolist())
    sizes = f"[{rows.shape[0]}][{rows.shape[1]}]"
    return f"static const heli2dof_real {name}{sizes} = {{{comment}\n{inner}\n}};"


def prototypes(controller: Controller) -> dict[str, list[str]]:
    """Lines of what begins each function, by its name."""
    inputs = ["const heli2dof_real angles[2]"]
    inputs += ["const heli2dof_real rates[2]"] * (controller.sampled is None)
    inputs += ["const heli2dof_real rotors[2]"] * controller.rotors_measured
    outputs = "const heli2dof_real reference[2], heli2dof_real voltages[2])"
    if len(inputs) == 3:
        inputs, outputs = inputs[:2], f"{inputs[2]}, {outputs}"
    return {
        "start": ["void heli2dof_start(heli2dof_state *state, const heli2dof_real angles[2])"],
        "rates": [
            "void heli2dof_rates(heli2dof_state *state, const heli2dof_real angles[2], heli2dof_real rates[2])"
        ],
        "step": [
            f"void heli2dof_step(heli2dof_state *state, {', '.join(inputs)},",
            f"                   {outputs}",
        ],
    }


def start(controller: Controller) -> list[str]:
    """The function that begins."""
    return [
        *prototypes(controller)["start"],
        "{",
        "    int i;",
        "",
        "    for (i = 0; i < 2; i++) {",
        "        state->angles[i] = OPERATING_POINT[i];",
        *["        state->rates[i] = R(0.0);"] * (controller.sampled is None),
        *["        state->rotors[i] = REST[i];"] * controller.rotors_measured,
        *["        state->motors[i] = BEFORE[i];"] * controller.told_late,
        *["        state->integral[i] = R(0.0);"] * controller.integrates,
        "    }",
        "    hold(state->angles, angles);",
        "    for (i = 0; i < 2; i++) {",
        "        state->reference[i] = state->angles[i];",
        *(_FILTERS_START if controller.sampled is None else _ESTIMATE_STARTS),
        "    }",
        *([] if controller.sampled is None else _rest_of_estimate(len(controller.sampled[0]))),
        "}",
    ]


_FILTERS_START = (
    "        state->filter[i][0] = state->angles[i] / FILTER_RATE;",
    "        state->filter[i][1] = R(0.0);",
)
_ESTIMATE_STARTS = ("        state->estimate[i] = state->angles[i] - OPERATING_POINT[i];",)


def _rest_of_estimate(m: int) -> list[str]:
    return [f"    for (i = 2; i < {m}; i++)", "        state->estimate[i] = R(0.0);"]


def rates(controller: Controller) -> list[str]:
    """The function of the rate filters."""
    return [
        *prototypes(controller)["rates"],
        "{",
        "    int i;",
        "",
        "    hold(state->angles, angles);",
        "    for (i = 0; i < 2; i++) {",
        "        heli2dof_real *x = state->filter[i];",
        "        const heli2dof_real x0 = x[0], x1 = x[1];",
        "",
        "        rates[i] = FILTER_RATE * x1;",
        "        x[0] = FILTER[0][0] * x0 + FILTER[0][1] * x1 + FILTER_GAIN[0] * state->angles[i];",
        "        x[1] = FILTER[1][0] * x0 + FILTER[1][1] * x1 + FILTER_GAIN[1] * state->angles[i];",
        "    }",
        "}",
    ]


def observe(m: int) -> list[str]:
    """The function that predicts the estimate of the next sample."""
    return [
        "/* The estimate of the next sample, in deviations: w+ = ESTIMATE w + BY_ANGLES y + BY_VOLTAGES u. */",
        "static void observe(heli2dof_state *state, const heli2dof_real motors[2])",
        "{",
        f"    heli2dof_real next[{m}];",
        "    int i, j;",
        "",
        f"    for (i = 0; i < {m}; i++) {{",
        "        next[i] = R(0.0);",
        f"        for (j = 0; j < {m}; j++)",
        "            next[i] += ESTIMATE[i][j] * state->estimate[j];",
        "        for (j = 0; j < 2; j++) {",
        "            next[i] += BY_ANGLES[i][j] * (state->angles[j] - OPERATING_POINT[j]);",
        "            next[i] += BY_VOLTAGES[i][j] * (motors[j] - REST[j]);",
        "        }",
        "    }",
        f"    for (i = 0; i < {m}; i++)",
        "        state->estimate[i] = next[i];",
        "}",
    ]


def step(controller: Controller) -> list[str]:
    """The function of a sample."""
    loop = controller.loop
    errors = bool(loop.proportional.any()) or controller.integrates
    cut = controller.clamps or controller.tracks
    names = ["error[2]"] * errors + ["asked[2]"] * controller.clamps + ["cut[2]"] * cut
    return [
        *prototypes(controller)["step"],
        "{",
        *[f"    heli2dof_real {', '.join(names)};"] * bool(names),
        "    int i, j;",
        "",
        "    hold(state->angles, angles);",
        *["    hold(state->rates, rates);"] * (controller.sampled is None),
        *["    hold(state->rotors, rotors);"] * controller.rotors_measured,
        "    hold(state->reference, reference);",
        *[
            "    for (i = 0; i < 2; i++)",
            "        error[i] = state->reference[i] - state->angles[i];",
        ]
        * errors,
        "    for (i = 0; i < 2; i++) {",
        *_asked(controller),
        "    }",
        *_integrated(controller) * controller.integrates,
        *_estimated(controller),
        "}",
    ]


def _asked(controller: Controller) -> list[str]:
    """One motor's voltage."""
    loop = controller.loop
    terms = []
    if controller.sampled is None:
        terms += [
            "            u -= K[i][j] * (state->angles[j] - OPERATING_POINT[j]);",
            "            u -= K[i][2 + j] * state->rates[j];",
        ]
    terms += ["            u -= K[i][4 + j] * (state->rotors[j] - REST[j]);"] * controller.rotors_measured
    terms += ["            u += PROPORTIONAL[i][j] * error[j];"] * bool(loop.proportional.any())
    if loop.feedforward.any():
        terms += ["            u += FEEDFORWARD[i][j] * (state->reference[j] - OPERATING_POINT[j]);"]
    terms += ["            u += INTEGRAL[i][j] * state->integral[j];"] * controller.integrates
    lines = ["        heli2dof_real u = TRIM[i];"]
    if controller.sampled is not None:
        lines += [
            "",
            f"        for (j = 0; j < {len(controller.sampled[0])}; j++)",
            "            u -= K[i][j] * state->estimate[j];",
        ]
    if terms:
        lines += ["        for (j = 0; j < 2; j++) {", *terms, "        }"]
    if controller.limited:
        lines += ["        voltages[i] = u > LIMIT[i] ? LIMIT[i] : u < -LIMIT[i] ? -LIMIT[i] : u;"]
    else:
        lines += ["        voltages[i] = u;"]
    lines += ["        asked[i] = u;"] * controller.clamps
    return lines + ["        cut[i] = voltages[i] - u;"] * (controller.clamps or controller.tracks)


def _integrated(controller: Controller) -> list[str]:
    """The integrals' sums with their anti-windup."""
    lines = ["    for (i = 0; i < 2; i++) {", "        heli2dof_real e = error[i];"]
    if controller.tracks:
        lines += ["        e += TRACKING[i][0] * cut[0] + TRACKING[i][1] * cut[1];"]
    if controller.clamps:
        lines += [
            "        const int motor = MOTOR_OF[i];",
            "        const int beyond = cut[motor] > R(0.0) || cut[motor] < R(0.0);",
            "        if (beyond && INTEGRAL[motor][i] * e * asked[motor] > R(0.0))",
            "            e = R(0.0);",
        ]
    return [*lines, "        state->integral[i] += SAMPLE_TIME * e;", "    }"]


def _estimated(controller: Controller) -> list[str]:
    """What an observer learns of the sample."""
    if controller.sampled is None:
        return []
    if not controller.told_late:
        return ["    observe(state, voltages);"]
    return [
        "    observe(state, state->motors); /* what the motors have during this sample */",
        "    for (i = 0; i < 2; i++)",
        "        state->motors[i] = voltages[i];",
    ]


HOLD = """\
/* The last good values: what is not read changes nothing. A comparison with NaN is false. */
static void hold(heli2dof_real good[2], const heli2dof_real read[2])
{
    int i;

    for (i = 0; i < 2; i++)
        if (read[i] >= -LARGEST_READING && read[i] <= LARGEST_READING)
            good[i] = read[i];
}
"""
