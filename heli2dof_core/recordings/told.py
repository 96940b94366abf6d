"""What is said of an identification: what a recording does not show, and where intervals may not hold."""

from __future__ import annotations

import numpy as np

from ..errors import RecordingError
from ..findings import Finding
from ..parameters import Parameters
from ..signals import Floats
from .identified import Estimate
from .search import MOST_EVALUATIONS, Search
from .segments import LONGEST_RUN_UP, RUN_UP
from .time_axis import stretches
from .unknowns import ACTUATORS, INERTIAS, SCALED
from .whiteness import Whiteness

COARSE_ENCODER = 0.45
"""Residuals in encoder steps below which their rounding is no noise (alone it makes 0.29): it moves with the angle
and biases what is found. Then intervals that take it for white held the truth in 43 % of the bench's cases."""
RESOLVED = 2.0
"""Time constants, in sample times, below which a rotor's lag may be a delay of the controller's."""
LOOSE = 0.25
"""Relative half width of an inertia's interval from which it is said that only ratios are known."""
_POOR_CONDITION = 1e6


def require_excited(J: Floats, names: tuple[str, ...]) -> None:
    """Sees that the recording shows each of the unknowns, and apart from the others.

    Raises:
        RecordingError: it does not.
    """
    sizes = np.linalg.norm(J, axis=0)
    silent = [name for name, size in zip(names, sizes, strict=True) if size < 1e-9 * (1e-300 + np.max(sizes))]
    rank = np.linalg.matrix_rank(J / np.where(sizes > 0, sizes, 1.0), tol=1e-7)
    if silent or rank < len(names):
        which = (
            "nothing about " + ", ".join(silent) if silent else "too little to tell these parameters apart"
        )
        hint = "Leave some out, or record steps of both references, one after the other."
        inertias = [] if silent else [name for name in INERTIAS if name in names]
        if inertias:
            pairs = " and ".join(
                ", ".join(_ratio(own, name) for own in SCALED[name] if own in names) for name in inertias
            )
            hint = (
                f"The motion shows {pairs} only: hold one of them at a value that you know otherwise (swing it, "
                "weigh it, pull with a spring)."
            )
        raise RecordingError(
            f"the recording says {which}", field="free", value=list(silent or names), hint=hint
        )


def _ratio(name: str, inertia: str) -> str:
    return f"{name}/({inertia} + m l²)"


def scaled_together(p: Parameters, estimates: list[Estimate], covariance: Floats) -> list[Finding]:
    """That an inertia is hardly known, though its ratios to thrust and damping are.

    Args:
        p: the rig as it is thought to be.
        estimates: of the unknowns.
        covariance: theirs by noise, (k, k), in their own units.
    """
    names, more = [e.name for e in estimates], p.m * p.l**2
    found = []
    for inertia in (name for name in INERTIAS if name in names):
        i = names.index(inertia)
        own = estimates[i]
        half = (own.high - own.low) / 2 / abs(own.value)
        partners = [names.index(name) for name in SCALED[inertia] if name in names]
        partners = [j for j in partners if estimates[j].value != 0]
        if half < LOOSE or not partners:
            continue
        told = []
        for j in partners:
            by = np.zeros(len(names))
            by[i], by[j] = -1.0 / (own.value + more), 1.0 / estimates[j].value
            width = 196 * float(np.sqrt(max(by @ covariance @ by, 0.0)))
            told.append(f"{_ratio(names[j], inertia)} ± {width:.2g} %")
        words = (
            f"{inertia} is known to ± {100 * half:.0f} % only: thrust, damping and inertia of an axis that grow "
            f"together leave its motion nearly as it is. Known, by noise alone: {', '.join(told)}. Hold {inertia} or "
            "one of these at a value that you know otherwise."
        )
        found.append(Finding("only_ratios", "warning", words))
    return found


def nothing_held(held_out: float, segments: int) -> list[Finding]:
    """That nothing could be held out though it was asked for."""
    if held_out <= 0.0 or segments:
        return []
    words = (
        "The end of the recording is too short, or at a stop: nothing is held out, and nothing is validated."
    )
    return [Finding("nothing_held_out", "info", words)]


def correlated(tested: list[Whiteness], sample_time: float) -> list[Finding]:
    """Whether residuals are correlated, by the tests of both axes."""
    axes = [i for i, axis in enumerate(tested) if not axis.white]
    if not axes:
        return []
    worst = max(axes, key=lambda i: tested[i].span)
    words = (
        f"The residuals in {' and '.join(('pitch', 'yaw')[i] for i in axes)} are not white: over some "
        f"{1e3 * sample_time * tested[worst].span:.2g} ms they are correlated, successive ones by "
        f"{max(tested[i].correlations[0] for i in axes):.2f}. The intervals allow for that, but from few segments: "
        "they may be too narrow. Record longer, or look for what the model leaves out."
    )
    return [Finding("correlated_residuals", "warning", words)]


def remarks(estimates: list[Estimate], J: Floats, names: tuple[str, ...], search: Search) -> list[Finding]:
    """What is to be said of the estimates.

    Args:
        estimates: of the unknowns.
        J: derivatives by them inside the segments, (n, 2, k).
        names: of the unknowns.
        search: that found them.
    """
    found = _of_rotors(estimates, search)
    if not search.ended:
        words = (
            f"The search was given up after {MOST_EVALUATIONS} steps: the values are no least squares yet."
        )
        found.append(Finding("search_stopped", "warning", words))
    for e in estimates:
        if e.allowed != e.value:
            words = (
                f"{e.name} was found at {e.value:.3g} {e.unit}, where it cannot be; adopted is {e.allowed:g}."
            )
            found.append(Finding("out_of_range", "warning", words.replace("-", "−")))
        if e.low < 0 < e.high and (e.before or e.name in ACTUATORS):
            words = f"The interval of {e.name} contains 0: the recording hardly shows it."
            found.append(Finding("undetermined", "warning", words))
    rms = search.rms(search.last)
    for axis, word in enumerate(("pitch", "yaw")):
        steps = np.abs(np.diff(search.recording.angles[:, axis]))
        if rms[axis] < COARSE_ENCODER * np.min(steps[steps > 0], initial=np.inf) < np.inf:
            words = f"Rounding by the {word} encoder outweighs its noise: the intervals may be too narrow."
            found.append(Finding(f"coarse_{word}_encoder", "warning", words))
    columns = J.reshape(-1, len(names))
    condition = float(np.linalg.cond(columns / np.linalg.norm(columns, axis=0)))
    if condition > _POOR_CONDITION:
        words = "The recording hardly tells these parameters apart: their values depend on one another."
        found.append(Finding("poorly_excited", "warning", words))
    return found


def _of_rotors(estimates: list[Estimate], search: Search) -> list[Finding]:
    found, recording = [], search.recording
    for e in estimates:
        if not e.name.endswith(".tau"):
            continue
        if e.value < RESOLVED * recording.sample_time:
            words = (
                f"{e.name} was found at {1e3 * e.value:.3g} ms, with {1e3 * recording.sample_time:.3g} ms between "
                "samples: a sample's delay in the controller or in the log looks alike."
            )
            found.append(Finding("tau_unresolved", "warning", words))
        elif e.low > 0 and e.high - e.low > e.value:
            words = f"{e.name} is known to ± {50 * (e.high - e.low) / e.value:.0f} %: record steps of that voltage."
            found.append(Finding("undetermined", "warning", words))
    longest = search.unknowns.run_up(search.deviations)
    left_out = sum(
        LONGEST_RUN_UP * float(recording.t[end - 1] - recording.t[first]) < RUN_UP * longest
        for first, end in stretches(recording.t).tolist()
    )
    if left_out:
        words = (
            f"The rotors' speeds where the recording begins are unknown and matter for {RUN_UP * longest:.2g} s, of "
            f"which no more than a quarter of the recording's stretch was left out ({left_out} such): record longer."
        )
        found.append(Finding("short_run_up", "warning", words))
    return found
