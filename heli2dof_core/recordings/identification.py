"""A rig's damping, stiffness, thrust constants, rotors and friction from a recording, by output error."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from ..checks import require_within
from ..errors import Wanted, nobody_leaves
from ..parameters import Parameters
from ..rotors import AxisFriction, Rotors
from ..signals import Floats
from .acting import acting_of
from .covariance import grouped_covariance, groups_of, plain_covariance, student_quantile
from .identified import Estimate, Identification, Progress
from .model_errors import unmodelled
from .recording import Recording
from .search import Search, pair
from .segments import RUN_UP, bridged, cut, divergence_told, segment_length
from .told import correlated, nothing_held, remarks, require_excited, scaled_together
from .unknowns import ACTUATORS, FREE, IDENTIFIABLE, INERTIAS, Unknowns, checked, default_free, info
from .validated import validated
from .validation import HELD_OUT, MOST_HELD_OUT, fitted_part, split_at, until
from .whiteness import whiteness

QUANTILE = 1.959964
"""Of the normal distribution, for 95 %."""
COARSE = 0.5
"""Length of the segments of a first fit, s; from one fit to the next they grow."""
GROWING = 3.0
COARSE_TOLERANCE = 1e-2
"""Relative change of the parameters at which a first search ends."""


def identify(
    p: Parameters,
    recording: Recording,
    free: Sequence[str] | None = None,
    rotors: Rotors = Rotors(),
    friction: AxisFriction = AxisFriction(),
    *,
    theta_0: float = 0.0,
    limits: tuple[float, float] | None = None,
    segment: float | None = None,
    travel: float | None = None,
    held_out: float = 0.0,
    report: Callable[[Progress], None] = lambda progress: None,
    wanted: Wanted = nobody_leaves,
) -> Identification:
    """The free parameters that bring the simulated angles nearest to the recorded ones.

    Output error (Ljung, System Identification, 1999, sections 7.2 and 10.2): the nonlinear model, driven by the
    recorded voltages in segments whose starting states are unknown too, is fitted by SciPy's trust-region
    Gauss–Newton method, starting states eliminated within each step (Golub & Pereyra, SIAM J. Numer. Anal. 10
    (1973) 413–432). Short segments bring a wrong rig near; then both axes are weighted alike, then by their
    residuals.

    An interval of noise alone is that of `grouped_covariance`, of the kind for correlated residuals unless a test
    finds them white, and never narrower than for white ones. The interval that is told allows for the model, too:
    |b| + √(w² + z²(s² + τ²)) on both sides, with w that of noise, b and s the bias that usual effects make and its
    spread, as far as the residuals tell it (`unmodelled`), and τ by how much more the part that is held out would
    have it moved than noise moves it (`validated`). It holds the truth where these effects are what the model leaves
    out and are small enough that their sum is; not where units, signs, m, l or the columns are wrong.

    Where rotors take time or an axis rubs, or that is to be found, thrust follows the rotors' speeds, which depend on
    their time constants and the recorded voltages alone: a run-up without segments lets them forget how they began.

    Args:
        p: the rig as it is thought to be; what is not free stays.
        recording: at least as long as the rig's slowest motion.
        free: of `IDENTIFIABLE`, `ACTUATORS` and `INERTIAS`.
        rotors: as they are thought to be; what is not free of them stays, dead zones and curves always.
        friction: likewise, of the axes.
        theta_0: operating point, rad, at whose trim a thrust curve is matched that does not say it itself.
        limits: of both voltages, V, for a motor that rests at the trim.
        segment: length, s; by default as long as no error grows much (`segment_length`).
        travel: pitch stops at ±travel, rad; what happens there is left out.
        held_out: share of the recording's time, its end, that is not fitted, but held against what was found.
        report: called after each simulation; what it raises ends the search.
        wanted: called more often, within a simulation; what it raises ends the search.

    Raises:
        InvalidInputError: `free` is empty or holds an unknown name; `segment` is out of its range.
        RecordingError: the recording does not say what is asked of it.
    """
    began = perf_counter()
    names = checked(default_free(p) if free is None else free)
    unknowns = Unknowns.of(p, acting_of(p, rotors, friction, theta_0, limits), names)
    require_within(held_out, "held_out", "", 0.0, MOST_HELD_OUT)
    recording = bridged(recording)
    row = split_at(recording, held_out)
    length = segment_length(p, until(recording, row)) if segment is None else segment
    require_within(length, "segment", "s", 0.1, 1e4)

    def bounded(length: float, values: Floats) -> NDArray[np.int64]:
        return cut(recording, length, travel, RUN_UP * unknowns.run_up(values), row)

    def segmented(length: float, values: Floats, spent: int = 0) -> Search:
        bounds = fitted_part(bounded(length, values), row)
        return Search(unknowns, recording, bounds, report=report, wanted=wanted, evaluations=spent)

    with divergence_told():
        search, before, values = _found(segmented, unknowns, length)
        held = bounded(length, search.deviations)
        held = held[held[:, 0] >= (len(recording.t) if row is None else row)]
        bounds = np.concatenate([search.bounds, held])
        found = _concluded(search, before, values, thought=(rotors, friction), bounds=bounds, began=began)
        return replace(found, findings=(*found.findings, *nothing_held(held_out, len(held))))


def _concluded(
    search: Search,
    before: tuple[float, float] | None,
    values: Floats,
    *,
    thought: tuple[Rotors, AxisFriction],
    bounds: NDArray[np.int64],
    began: float,
) -> Identification:
    """The estimates with their intervals, and what is to be said of them."""
    unknowns, recording, names = search.unknowns, search.recording, search.names
    after = search.fitted(values)
    J, r = search.slopes(after) * search.weights[:, None], after.residuals * search.weights
    inside = search.inside
    count = len(names) + 4 * len(search.bounds)
    groups = groups_of(search.bounds)
    tested = whiteness(search.bounds, r, after.basis)
    power = 0.5 if all(axis.white for axis in tested) else 1.0
    covariance = grouped_covariance(J, r, groups, after.basis, power)
    own = student_quantile(len(groups) - len(names)) * np.sqrt(np.diag(covariance))
    white = QUANTILE * np.sqrt(np.diag(plain_covariance(J[inside], r[inside], count)))
    widths = np.maximum(own, white)  # few groups may underrate what white noise does by itself
    missed = unmodelled(
        unknowns.rig(values),
        recording,
        search.bounds,
        after.starts,
        J=J,
        r=r,
        widths=widths,
        names=names,
        weights=search.weights,
        step=search.step,
        acting=unknowns.acted(values),
        wanted=search.wanted,
    )
    checked_on = validated(search, values, bounds, covariance, power)
    more = np.diag(missed.spread) + checked_on.spread
    whole = np.abs(missed.bias) + np.sqrt(widths**2 + QUANTILE**2 * more)
    estimates = []
    for i, name in enumerate(names):
        thought_of, value, scale = (
            unknowns.value(i, unknowns.before),
            unknowns.value(i, values),
            search.scales[i],
        )
        unit, half = info(name).unit, float(scale * whole[i])
        sizes = float(scale * widths[i]), float(scale * white[i])
        estimates.append(Estimate(name, unit, thought_of, value, value - half, value + half, *sizes))
    adopted = unknowns.adopted({e.name: e.allowed for e in estimates}, *thought)
    return Identification(
        estimates=tuple(estimates),
        parameters=adopted[0],
        rotors=adopted[1],
        friction=adopted[2],
        rms_before=before,
        rms=pair(search.rms(after)),
        residuals=after.residuals,
        segments=search.bounds,
        parts=checked_on.parts,
        before=checked_on.before,
        after=checked_on.after,
        bounds=bounds,
        whiteness=(tested[0], tested[1]),
        lags=float(np.median(np.diff(groups, axis=1))),
        evaluations=search.evaluations,
        seconds=perf_counter() - began,
        findings=(
            *recording.findings,
            *checked_on.findings,
            *missed.findings,
            *correlated(tested, recording.sample_time),
            *scaled_together(unknowns.p, estimates, covariance * np.outer(search.scales, search.scales)),
            *remarks(estimates, J[inside], names, search),
        ),
    )


def _found(
    segmented: Callable[..., Search], unknowns: Unknowns, length: float
) -> tuple[Search, tuple[float, float] | None, Floats]:
    """The search in segments of `length`, the residuals before it and what it found.

    A wrong rig soon falls out of reach of the right one, so that short segments bring it near first.
    """
    values, short = np.zeros(len(unknowns.names)), min(COARSE, length)
    search = segmented(short, values)
    require_excited(search.slopes(search.fitted(values)).reshape(-1, len(values)), unknowns.names)
    while short < length:
        values = search.minimum(values, COARSE_TOLERANCE)
        short = min(GROWING * short, length)
        search = segmented(short, values, search.evaluations)
    try:
        before = pair(search.rms(search.fitted(unknowns.before)))
    except FloatingPointError:
        before = None
    search.begin()
    for _ in range(2):
        search.weights = 1.0 / np.maximum(search.rms(search.fitted(values)), 1e-9)
        values = search.minimum(values)
    return search, before, values


__all__ = [
    "ACTUATORS",
    "FREE",
    "HELD_OUT",
    "IDENTIFIABLE",
    "INERTIAS",
    "MOST_HELD_OUT",
    "Estimate",
    "Identification",
    "Progress",
    "default_free",
    "identify",
]
