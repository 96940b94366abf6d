"""Remarks on the closed loop: settling, rig against linear model, delay margin, gains and slow poles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from math import degrees, radians

import numpy as np

from .figures import AxisMetrics, Margins
from .findings import Finding
from .kernels.layout import BAND
from .loop import Loop
from .metrics import StepMetrics
from .remarks import FAR_OUT
from .rotors import USUAL_LAG, Actuators
from .scenario import Digital, Limits, Scenario
from .signals import AXES, INPUTS, OUTPUTS
from .simulation.response import Response
from .tables import number

UNLIKE, UNLIKE_AT_LIMITS = 1.25, 1.05
"""Ratio of two settling times from which rig and linear model are said to differ; and where a motor is at its limit,
whose cost is worth knowing."""
UNLIKE_OVERSHOOT = 10.0
"""The same for overshoot, percentage points."""
SLOWER = 5.0
"""How many times slower than every placed pole a pole of the whole loop is remarked on."""
AMPLE = 2.0
"""Times `rotors.USUAL_LAG` that a loop should bear where the rig's rotors are said to follow at once."""
DEAD_SAMPLES = 1.5
"""Dead time of a digital loop in samples: one to compute, half a sample's hold
(Åström and Wittenmark, Computer-Controlled Systems, 1997, section 8)."""
_OTHER_CAUSES = frozenset(
    ("diverges", "integration_stopped", "starts_on_stop", "reference_beyond_stop", "travel_stop")
)

Stepped = tuple[Response, StepMetrics]


@dataclass(frozen=True)
class Experiment:
    """One experiment by both models, each as its response and its metrics."""

    linear: Stepped
    rig: Stepped


def behaviour_remarks(
    loop: Loop,
    limits: Limits,
    scenario: Scenario,
    margins: tuple[Margins, Margins] | None,
    experiments: Sequence[Experiment],
) -> tuple[Finding, ...]:
    """Findings on a stable loop; an unstable one has its own, which explains whatever else is seen.

    Args:
        loop: the whole loop.
        limits: of the rig.
        scenario: the experiment; in `experiments` it may step one axis alone.
        margins: at the pitch and the yaw motor.
        experiments: each axis is judged in the last one that steps it, so the one that steps it alone.
    """
    if not loop.stable or margins is None:
        return ()
    axes = {name: each for each in experiments for name in each.rig[1].axes}
    return tuple(
        chain(
            _on_delay(margins, scenario),
            _on_lag(loop),
            _on_gain(loop, limits),
            _on_slow_poles(loop),
            _on_settling(loop, axes, noisy=any(scenario.noises)),
            () if scenario.disturbance else _on_models(axes, scenario, loop.actuators),
        )
    )


def _on_delay(margins: tuple[Margins, Margins], scenario: Scenario) -> Iterator[Finding]:
    sample = (scenario.digital or Digital()).sample_time
    short = {
        axis: m.delay_margin
        for axis, m in zip(AXES, margins, strict=True)
        if m.delay_margin is not None and m.delay_margin < DEAD_SAMPLES * sample
    }
    if short:
        axis = min(short, key=lambda name: short[name])
        usual = "this" if scenario.digital else "a usual"
        yield Finding(
            "short_delay_margin",
            "warning",
            f"The {axis} motor's delay margin is {_time(short[axis])}. A digital controller with {usual} sample "
            f"time of {_time(sample)} adds up to {_time(DEAD_SAMPLES * sample)} of dead time. Place slower poles "
            "or lower the gains.",
        )


def _on_lag(loop: Loop) -> Iterator[Finding]:
    own, limit = loop.actuators, loop.lag_margin
    if limit is None:
        yield Finding("lag_unlimited", "info", "The loop stays stable however slow both rotors are.")
    elif (own is None or not own.tau.all()) and limit < AMPLE * USUAL_LAG:
        short = limit < USUAL_LAG
        yield Finding(
            "lives_by_fast_rotors",
            "warning" if short else "info",
            f"{'The design lives by rotors that follow at once: t' if short else 'T'}he loop turns unstable once "
            f"both rotors lag by {limit:.3g} s; an Aero's lag by {USUAL_LAG:g} s. Place slower poles or lower the "
            "gains, or give the rig its rotors' lag and place them, too.",
        )


def _on_gain(loop: Loop, limits: Limits) -> Iterator[Finding]:
    if max(map(abs, loop.design.closed_loop_poles.tolist())) > FAR_OUT:
        return  # said of the poles already
    rows = zip(AXES, (limits.V_p, limits.V_y), loop.design.K.tolist(), strict=True)
    asked = [
        (radians(abs(gain)), bound, motor, axis)
        for motor, bound, row in rows
        for axis, gain in zip(AXES, row[:2], strict=True)
    ]
    volts, bound, motor, axis = max(asked, key=lambda each: each[0] / each[1])
    if volts > bound:
        yield Finding(
            "high_gain",
            "warning",
            f"One degree of {axis} error asks the {motor} motor for {volts:.3g} V; its limit is {bound:g} V. "
            "Place slower poles.",
        )


def _on_slow_poles(loop: Loop) -> Iterator[Finding]:
    placed = max(pole.real for pole in loop.design.closed_loop_poles.tolist())
    slowest = float(loop.connected_poles[0].real)
    if loop.has_integrators and placed < SLOWER * slowest:
        yield Finding(
            "slow_pole",
            "warning",
            f"The integral action adds a slow pole at {number(slowest, 2)} rad/s, {min(placed / slowest, 999):.0f} "
            f"times slower than the slowest placed pole. The last of an error takes about "
            f"{number(-4 / slowest, 2)} s to decay. Tune the loops for these poles.",
        )


def _on_settling(loop: Loop, axes: Mapping[str, Experiment], *, noisy: bool) -> Iterator[Finding]:
    parts, held = [], False
    for i, signal in enumerate(OUTPUTS):
        each = axes.get(signal.name)
        if each is None or _explained(each):
            continue
        own, ideal = (metrics.axes[signal.name] for _, metrics in (each.rig, each.linear))
        if not own.settled:
            linear = (
                "" if ideal.settling_time is None else f" (linear: settled in {_time(ideal.settling_time)})"
            )
            held = held or bool(linear and loop.actuators is not None and loop.actuators.breakaway[i])
            response, error = each.rig[0], abs(own.steady_state_error)
            within = error <= BAND * abs(response.reference[i] - response.start[i])
            words = f"{degrees(error):.2g}° from its reference{', but does not stay there' if within else ''}"
            parts.append((AXES[i], words, linear))
    if parts:
        end = _time(float(next(iter(axes.values())).rig[0].t[-1]))
        names = " and ".join(f"{axis} ends {words}{linear}" for axis, words, linear in parts)
        advice = "Watch longer, or place faster poles."
        if not loop.has_integrators and (any(linear for *_, linear in parts) or _misses(loop)):
            advice = "Without integral action such an error stays: close the PI loops."
        elif noisy and any(linear for *_, linear in parts):
            advice = (
                "Noise on the measured angles keeps it moving: place slower poles, or measure more quietly."
            )
        elif held:
            advice = "Friction holds the rig until the integral action outgrows it: watch longer, or raise the gains."
        yield Finding("not_settled", "warning", f"Not settled within {end}: {names}. {advice}")


def _misses(loop: Loop) -> bool:
    """Whether the linear loop itself ends beside its references, as with motors that the design does not know."""
    steady_state = -np.linalg.solve(loop.A, loop.B)[:2]
    return bool(np.max(np.abs(np.eye(2) - steady_state)) > BAND)


def _on_models(
    axes: Mapping[str, Experiment], scenario: Scenario, own: Actuators | None
) -> Iterator[Finding]:
    parts, limited = [], False
    for i, signal in enumerate(OUTPUTS):
        each = axes.get(signal.name)
        if each is None or _explained(each):
            continue
        (_, rig), (_, linear) = each.rig, each.linear
        at_limit = any(rig.motors[motor.name].saturated > 0 for motor in INPUTS)
        ratio = UNLIKE_AT_LIMITS if at_limit else UNLIKE
        told = _difference(rig.axes[signal.name], linear.axes[signal.name], ratio)
        if told:
            parts.append(f"the {AXES[i]} step {told}")
            limited = limited or at_limit
    if parts:
        causes = [
            *(["the motors' limits"] if limited else []),
            *(["sampling"] if scenario.digital else []),
            *(["noise"] if any(scenario.noises) else []),
            *(["how thrust curves"] if own is not None and own.square.any() else []),
            *(["friction"] if own is not None and own.breakaway.any() else []),
            *([] if scenario.trim_feedforward else ["the missing trim voltages"]),
        ]
        cause = _listed(causes) or "gravity and coupling beyond the operating point"
        advice = " Step less, or place slower poles." if limited else ""
        yield Finding(
            "unlike_linear",
            "warning",
            f"The rig differs from the linear model: {', '.join(parts)}. "
            f"The linear model leaves out {cause}.{advice}",
        )


def _difference(rig: AxisMetrics, linear: AxisMetrics, ratio: float) -> str:
    """In which figures the models differ, the linear one's in parentheses; empty where in none.

    `ratio` of the settling times counts as a difference.
    """
    words = []
    own, ideal = rig.settling_time, linear.settling_time
    if own is not None and ideal is not None and max(own, ideal) > ratio * min(own, ideal):
        words.append(f"settles in {_time(own)} (linear: {_time(ideal)})")
    if abs(rig.overshoot - linear.overshoot) > UNLIKE_OVERSHOOT:
        words.append(f"overshoots by {rig.overshoot:.1f} % (linear: {linear.overshoot:.1f} %)")
    return " and ".join(words)


def _listed(words: Sequence[str]) -> str:
    return " and ".join(part for part in (", ".join(words[:-1]), *words[-1:]) if part)


def _explained(each: Experiment) -> bool:
    found = chain(each.rig[0].findings, each.linear[0].findings)
    return any(finding.code in _OTHER_CAUSES for finding in found)


def _time(seconds: float) -> str:
    """As the page writes it: milliseconds below 0.1 s."""
    return f"{1e3 * seconds:.2g} ms" if seconds < 0.1 else f"{seconds:.2f} s"
