"""A rig's damping, stiffness, thrust constants, rotors and friction from a recording, by output error."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter

import numpy as np

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
from .told import correlated, remarks, require_excited
from .unknowns import ACTUATORS, FREE, IDENTIFIABLE, Unknowns, checked, default_free, info
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
    report: Callable[[Progress], None] = lambda progress: None,
    wanted: Wanted = nobody_leaves,
) -> Identification:
    """The free parameters that bring the simulated angles nearest to the recorded ones.

    Output error (Ljung, System Identification, 1999, sections 7.2 and 10.2): the nonlinear model, driven by the
    recorded voltages in segments whose starting states are unknown too, is fitted by SciPy's trust-region
    Gauss–Newton method, starting states eliminated within each step (Golub & Pereyra, SIAM J. Numer. Anal. 10
    (1973) 413–432). Short segments bring a wrong rig near; then both axes are weighted alike, then by their
    residuals. Intervals are those of `grouped_covariance`, of the kind for correlated residuals unless a test finds
    them white, and never narrower than for white ones.

    Where rotors take time or an axis rubs, or that is to be found, thrust follows the rotors' speeds, which depend on
    their time constants and the recorded voltages alone: a run-up without segments lets them forget how they began.

    Args:
        p: the rig as it is thought to be; what is not free stays.
        recording: at least as long as the rig's slowest motion.
        free: of `IDENTIFIABLE` and `ACTUATORS`.
        rotors: as they are thought to be; what is not free of them stays, dead zones and curves always.
        friction: likewise, of the axes.
        theta_0: operating point, rad, at whose trim a thrust curve is matched that does not say it itself.
        limits: of both voltages, V, for a motor that rests at the trim.
        segment: length, s; by default as long as no error grows much (`segment_length`).
        travel: pitch stops at ±travel, rad; what happens there is left out.
        report: called after each simulation; what it raises ends the search.
        wanted: called more often, within a simulation; what it raises ends the search.

    Raises:
        InvalidInputError: `free` is empty or holds an unknown name; `segment` is out of its range.
        RecordingError: the recording does not say what is asked of it.
    """
    began = perf_counter()
    names = checked(default_free(p) if free is None else free)
    unknowns = Unknowns.of(p, acting_of(p, rotors, friction, theta_0, limits), names)
    length = segment_length(p, recording) if segment is None else segment
    require_within(length, "segment", "s", 0.1, 1e4)
    recording = bridged(recording)

    def segmented(length: float, values: Floats, spent: int = 0) -> Search:
        bounds = cut(recording, length, travel, RUN_UP * unknowns.run_up(values))
        return Search(unknowns, recording, bounds, report=report, wanted=wanted, evaluations=spent)

    with divergence_told():
        search, before, values = _found(segmented, unknowns, length)
        return _concluded(search, before, values, (rotors, friction), began)


def _concluded(
    search: Search,
    before: tuple[float, float] | None,
    values: Floats,
    thought: tuple[Rotors, AxisFriction],
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
    plain = QUANTILE * search.scales * np.sqrt(np.diag(plain_covariance(J[inside], r[inside], count)))
    widths = np.maximum(
        search.scales * own, plain
    )  # few groups may underrate what white noise does by itself
    missed = unmodelled(
        unknowns.rig(values),
        recording,
        search.bounds,
        after.starts,
        J=J,
        r=r,
        widths=widths / search.scales,
        names=names,
        weights=search.weights,
        step=search.step,
        acting=unknowns.acted(values),
        wanted=search.wanted,
    )
    estimates = []
    for i, name in enumerate(names):
        own, value = unknowns.value(i, unknowns.before), unknowns.value(i, values)
        unit, width = info(name).unit, float(widths[i])
        estimates.append(Estimate(name, unit, own, value, value - width, value + width, float(plain[i])))
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
        lags=float(np.median(np.diff(groups, axis=1))),
        evaluations=search.evaluations,
        seconds=perf_counter() - began,
        findings=(
            *recording.findings,
            *missed,
            *correlated(tested, recording.sample_time),
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
    "IDENTIFIABLE",
    "Estimate",
    "Identification",
    "Progress",
    "default_free",
    "identify",
]
