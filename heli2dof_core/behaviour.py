"""Remarks on the closed loop: settling, rig against linear model, delay margin, gains and slow poles."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import degrees, inf, radians
from typing import Any, NamedTuple

import numpy as np

from .findings import Finding
from .judged import Judged
from .kernels.layout import BAND
from .loop import Loop
from .metrics import Numbers
from .remarks import FAR_OUT
from .rotors import USUAL_LAG, Actuators
from .scenario import Digital, Limits, Scenario
from .signals import AXES, OUTPUTS
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
USUAL_SAMPLE_TIME = Digital().sample_time
_NAMES = tuple(signal.name for signal in OUTPUTS)
_OTHER_CAUSES = frozenset(
    ("diverges", "integration_stopped", "starts_on_stop", "reference_beyond_stop", "travel_stop")
)


class Course(NamedTuple):
    """What one model has made of an experiment: its figures, and the remarks on it."""

    metrics: Numbers
    findings: Sequence[Finding]


class Experiment(NamedTuple):
    """One experiment by both models.

    Attributes:
        reference: θ and ψ, absolute, rad.
        steps: how far they are from its start, rad.
        linear, rig: what the models have made of it.
    """

    reference: tuple[float, float]
    steps: tuple[float, float]
    linear: Course
    rig: Course


def behaviour_remarks(
    loop: Judged,
    limits: Limits,
    scenario: Scenario,
    *,
    delays: Sequence[float | None],
    experiments: Sequence[Experiment],
    misses: Callable[[], bool],
) -> tuple[Finding, ...]:
    """Findings on a stable loop; an unstable one has its own, which explains whatever else is seen.

    Args:
        loop: the whole loop.
        limits: of the rig.
        scenario: the experiment; in `experiments` it may step one axis alone.
        delays: delay margins at the pitch and the yaw motor, s.
        experiments: each axis is judged in the last one that steps it, so the one that steps it alone.
        misses: whether the linear loop itself ends beside its references.
    """
    if not loop.stable:
        return ()
    axes: dict[str, Experiment] = {}
    for each in experiments:
        for name in _NAMES:
            if name in each.rig.metrics:
                axes[name] = each
    axes = {name: each for name, each in axes.items() if not _explained(each)}
    found = [*_on_delay(delays, scenario), *_on_lag(loop), *_on_gain(loop, limits), *_on_slow_poles(loop)]
    if not all(each.rig.metrics[name]["settled"] for name, each in axes.items()):
        found += _on_settling(loop, axes, scenario, misses)
    if scenario.disturbance is None:
        found += _on_models(axes, scenario, loop.actuators)
    return tuple(found)


def _on_delay(delays: Sequence[float | None], scenario: Scenario) -> Iterator[Finding]:
    sample = USUAL_SAMPLE_TIME if scenario.digital is None else scenario.digital.sample_time
    least = min([delay for delay in delays if delay is not None], default=inf)
    if least < DEAD_SAMPLES * sample:
        axis = AXES[[*delays].index(least)]
        usual = "this" if scenario.digital else "a usual"
        yield Finding(
            "short_delay_margin",
            "warning",
            f"The {axis} motor's delay margin is {_time(least)}. A digital controller with {usual} sample "
            f"time of {_time(sample)} adds up to {_time(DEAD_SAMPLES * sample)} of dead time. Place slower poles "
            "or lower the gains.",
        )


def _on_lag(loop: Judged) -> Iterator[Finding]:
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


def _on_gain(loop: Judged, limits: Limits) -> Iterator[Finding]:
    (a, b, *_), (c, d, *_) = loop.placed.K
    pitch, yaw = radians(max(abs(a), abs(b))), radians(max(abs(c), abs(d)))
    if pitch <= limits.V_p and yaw <= limits.V_y:
        return
    if max(map(abs, loop.placed.poles)) > FAR_OUT:
        return  # said of the poles already
    volts, bound, motor, row = pitch, limits.V_p, AXES[0], (a, b)
    if yaw / limits.V_y > pitch / limits.V_p:
        volts, bound, motor, row = yaw, limits.V_y, AXES[1], (c, d)
    axis = AXES[0 if abs(row[0]) >= abs(row[1]) else 1]
    yield Finding(
        "high_gain",
        "warning",
        f"One degree of {axis} error asks the {motor} motor for {volts:.3g} V; its limit is {bound:g} V. "
        "Place slower poles.",
    )


def _on_slow_poles(loop: Judged) -> Iterator[Finding]:
    if loop.by_axis is None:
        return
    placed, slowest = max(pole.real for pole in loop.placed.poles), loop.connected[0].real
    if placed < SLOWER * slowest:
        yield Finding(
            "slow_pole",
            "warning",
            f"The integral action adds a slow pole at {number(slowest, 2)} rad/s, {min(placed / slowest, 999):.0f} "
            f"times slower than the slowest placed pole. The last of an error takes about "
            f"{number(-4 / slowest, 2)} s to decay. Tune the loops for these poles.",
        )


def _on_settling(
    loop: Judged, axes: Mapping[str, Experiment], scenario: Scenario, misses: Callable[[], bool]
) -> Iterator[Finding]:
    parts, held = [], False
    for i, name in enumerate(_NAMES):
        each = axes.get(name)
        if each is None:
            continue
        own, ideal = each.rig.metrics[name], each.linear.metrics[name].get("settling_time")
        if not own["settled"]:
            linear = "" if ideal is None else f" (linear: settled in {_time(ideal)})"
            held = held or bool(linear and loop.actuators is not None and loop.actuators.breakaway[i])
            error = abs(own["steady_state_error"])
            within = error <= BAND * abs(each.steps[i])
            words = f"{degrees(error):.2g}° from its reference{', but does not stay there' if within else ''}"
            parts.append((AXES[i], words, linear))
    if parts:
        end, integrates, noisy = _time(scenario.duration), loop.by_axis is not None, any(scenario.noises)
        names = " and ".join(f"{axis} ends {words}{linear}" for axis, words, linear in parts)
        advice = "Watch longer, or place faster poles."
        if not integrates and (any(linear for *_, linear in parts) or misses()):
            advice = "Without integral action such an error stays: close the PI loops."
        elif noisy and any(linear for *_, linear in parts):
            advice = (
                "Noise on the measured angles keeps it moving: place slower poles, or measure more quietly."
            )
        elif held:
            advice = "Friction holds the rig until the integral action outgrows it: watch longer, or raise the gains."
        yield Finding("not_settled", "warning", f"Not settled within {end}: {names}. {advice}")


def loop_misses(loop: Loop) -> bool:
    """Whether the linear loop itself ends beside its references, as with motors that the design does not know."""
    steady_state = -np.linalg.solve(loop.A, loop.B)[:2]
    return bool(np.max(np.abs(np.eye(2) - steady_state)) > BAND)


def _on_models(
    axes: Mapping[str, Experiment], scenario: Scenario, own: Actuators | None
) -> Iterator[Finding]:
    parts, limited = [], False
    for i, name in enumerate(_NAMES):
        each = axes.get(name)
        if each is None:
            continue
        rig, linear = each.rig.metrics, each.linear.metrics
        at_limit = rig["V_p"]["saturated"] > 0 or rig["V_y"]["saturated"] > 0
        ratio = UNLIKE_AT_LIMITS if at_limit else UNLIKE
        told = _difference(rig[name], linear[name], ratio)
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


def _difference(rig: Mapping[str, Any], linear: Mapping[str, Any], ratio: float) -> str:
    """In which figures the models differ, the linear one's in parentheses; empty where in none.

    `ratio` of the settling times counts as a difference.
    """
    words = []
    own, ideal = rig.get("settling_time"), linear.get("settling_time")
    if own is not None and ideal is not None and max(own, ideal) > ratio * min(own, ideal):
        words.append(f"settles in {_time(own)} (linear: {_time(ideal)})")
    if abs(rig["overshoot"] - linear["overshoot"]) > UNLIKE_OVERSHOOT:
        words.append(f"overshoots by {rig['overshoot']:.1f} % (linear: {linear['overshoot']:.1f} %)")
    return " and ".join(words)


def _listed(words: Sequence[str]) -> str:
    return " and ".join(part for part in (", ".join(words[:-1]), *words[-1:]) if part)


def _explained(each: Experiment) -> bool:
    found = (*each.rig.findings, *each.linear.findings)
    return bool(found) and any(finding.code in _OTHER_CAUSES for finding in found)


def _time(seconds: float) -> str:
    """As the page writes it: milliseconds below 0.1 s."""
    return f"{1e3 * seconds:.2g} ms" if seconds < 0.1 else f"{seconds:.2f} s"
