"""Stretches of a recording that are simulated from starting states of their own, and those states' least-squares fit.

Above level the pitch of a rig with its centre of mass in front is unstable without feedback: in a simulation driven
by recorded voltages any error grows, and over a minute by many powers of ten. Therefore the recording is cut into
segments (multiple shooting without continuity: Bock, in Ebert et al., Modelling of Chemical Reaction Systems, 1981,
pp. 102–125; Ljung, System Identification, 1999, section 13.4 on closed loops).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import RecordingError, Wanted, nobody_leaves
from ..frozen import Frozen
from ..parameters import Parameters
from ..signals import Floats
from ..simulation.recorded import Turning, longest_step, run_segments, turning
from .inertias import by_inertias
from .recording import Recording
from .time_axis import missing_rows, stretches

GROWTH = 1.0
"""Exponent by which an error may grow within a segment."""
SHORTEST = 1.0
"""Shortest segment that is chosen by itself, s."""
FEWEST = 12
"""Samples of the shortest segment that is used: three times what its starting state takes."""
STOP_MARGIN = 0.01
"""Distance from a stop of the pitch travel below which pitch may rest on it, rad."""
LEAP, LEAST_LEAP = 4.0, 0.02
"""A change of a voltage that is many times its usual one from row to row, and the least that counts as usual, V."""
RUN_UP, LONGEST_RUN_UP = 8.0, 0.25
"""Time constants until rotors have forgotten their unknown speeds where a stretch begins, to 3e-4, and the share of a
stretch that may pass so."""
_START = 0.06
_TOLERANCE = 1e-9
_MOST_STEPS, _MOST_GUARDED = 8, 20
_SHORTER = 0.25


@contextmanager
def divergence_told() -> Iterator[None]:
    """Turns whatever the numbers of a rig that runs away provoke into an error that says what to look at.

    Raises:
        RecordingError: under the recorded voltages the simulated rig runs away.
    """
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is looked for
            yield
    except (ArithmeticError, np.linalg.LinAlgError) as error:
        raise RecordingError(
            "under the recorded voltages the simulated rig runs away",
            field="columns",
            hint="Check units (of time too), signs, offsets and which rig was recorded, or try shorter segments.",
        ) from error


def bridged(recording: Recording) -> Recording:
    """The recording with the voltages that acted where rows are missing.

    Behind a row that misses n rows the voltages are not held: the best that is known of them lies between this row's
    and the next one's, whose mean over the n + 1 sample times is taken.
    """
    missing = missing_rows(recording.t)
    if not np.any(missing):
        return recording
    volts = recording.voltages.copy()
    share = (missing / (2 * (missing + 1)))[:, None]
    volts[:-1] += share * np.diff(recording.voltages, axis=0)
    return replace(recording, voltages=volts)


def _leaps(recording: Recording) -> NDArray[np.int64]:
    """Rows before which others are missing while a voltage changed much: nobody knows when it did.

    A volt that comes two milliseconds sooner or later is an error that lasts to the segment's end.
    """
    missing = np.append(missing_rows(recording.t), 0)
    changes = np.abs(np.diff(recording.voltages, axis=0, append=recording.voltages[-1:]))
    usual = np.maximum(np.median(changes, axis=0), LEAST_LEAP)
    return np.flatnonzero((missing > 0) & np.any(changes > LEAP * usual, axis=1)) + 1


@dataclass(frozen=True)
class Fitted(Frozen):
    """All segments under one set of parameters, their starting states fitted.

    Attributes:
        starts: (segments, 4).
        residuals: measured minus simulated angles, (n, 2), rad; 0 outside the segments.
        slopes: derivatives of the simulated angles by the seven parameters, (n, 2, 7), with rotors by four more, then
            by the inertias that were asked for; what the starting states can make up for is taken out; 0 outside.
        basis: of what its starting state can do, weighted, orthonormal in each segment, (n, 2, 4); 0 outside.
    """

    starts: Floats
    residuals: Floats
    slopes: Floats
    basis: Floats


def segment_length(p: Parameters, recording: Recording) -> float:
    """How long a segment may be, s: the whole recording where nothing grows."""
    theta = recording.angles[:, 0]
    stiffness = (p.m * p.g * p.l * np.sin(theta) - p.K_s) / p.alpha
    damping = p.B_p / p.alpha
    growth = float(np.max(-damping / 2 + np.sqrt(np.maximum(damping**2 / 4 + stiffness, 0.0))))
    whole = float(recording.t[-1])
    return whole if growth <= 0 else min(whole, max(SHORTEST, GROWTH / growth))


def cut(
    recording: Recording, length: float, travel: float | None, run_up: float = 0.0, edge: int | None = None
) -> NDArray[np.int64]:
    """First and last + 1 of each segment, (segments, 2).

    They last at most `length` s; none crosses a gap of the recording or the row `edge`, none lies where pitch is on
    a stop, and none within `run_up` s, but at most `LONGEST_RUN_UP`, from where a stretch begins.

    Raises:
        RecordingError: nothing is left.
    """
    free = np.ones(len(recording.t), dtype=bool)
    if travel is not None:
        free = np.abs(recording.angles[:, 0]) < travel - STOP_MARGIN
    if run_up > 0.0:
        for first, end in stretches(recording.t).tolist():
            since = recording.t[first:end] - recording.t[first]
            free[first:end] &= since >= min(run_up, LONGEST_RUN_UP * float(since[-1]))
    bounds, short = [], False
    for first, end in _runs(free, recording, edge):
        if end - first < FEWEST:
            short = True
            continue
        span = recording.t[end - 1] - recording.t[first]
        parts = max(1, min(int(np.ceil(span / length - 1e-9)), (end - first) // FEWEST))
        marks = np.linspace(first, end, parts + 1).astype(np.int64)
        bounds += pairwise(marks.tolist())
    if not bounds and short and np.any(free):
        raise RecordingError(
            f"no stretch without gaps has {FEWEST} rows",
            field="columns.time",
            hint="Record without interruptions, or choose no column of time and give the sample time.",
        )
    if not bounds:
        raise RecordingError(
            "the rig rests on its stops all the time",
            field="columns.theta",
            hint="Check sign and offset of the pitch encoder, or the pitch travel of this rig.",
        )
    return np.array(bounds, dtype=np.int64)


def _runs(free: NDArray[np.bool_], recording: Recording, edge: int | None) -> Iterator[tuple[int, int]]:
    """First row and last + 1 wherever the rig is free and its voltages are known."""
    edges = np.union1d(stretches(recording.t).ravel(), _leaps(recording))
    if edge is not None:
        edges = np.union1d(edges, [edge])
    for first, end in pairwise(edges.astype(int).tolist()):
        own = np.concatenate([[False], free[first:end], [False]]).astype(int)
        for run in np.flatnonzero(np.diff(own)).reshape(-1, 2).tolist():
            yield first + run[0], first + run[1]


def rough_starts(recording: Recording, bounds: NDArray[np.int64]) -> Floats:
    """Starting states of the segments by a parabola through their first samples, (segments, 4)."""
    starts = np.empty((len(bounds), 4))
    for i, (first, end) in enumerate(bounds.tolist()):
        count = int(np.searchsorted(recording.t[first:end], recording.t[first] + _START, side="right"))
        few = slice(first, first + min(end - first, max(count, 6)))
        since = recording.t[few] - recording.t[first]
        line = np.polynomial.polynomial.polyfit(since, recording.angles[few], 2)
        starts[i] = [*line[0], *line[1]]
    return starts


def fit_starts(
    p: Any,
    recording: Recording,
    bounds: NDArray[np.int64],
    starts: Floats,
    *,
    weights: Floats,
    step: float,
    acting: Floats | None = None,
    away: Floats | None = None,
    inertias: Sequence[str] = (),
    wanted: Wanted = nobody_leaves,
) -> Fitted:
    """Gauss and Newton's method on each segment's starting state, from `starts`; p stays.

    Where an axis sticks, its starting rate hardly matters and the next step leads far astray: with friction, a step
    that makes a segment's residuals larger is shortened.

    Args:
        p: has Parameters' fields, of any value.
        recording: what was measured.
        bounds: of the segments.
        starts: where to begin, (segments, 4).
        weights: of the residuals of θ and ψ, 1/rad.
        step: longest one of the integration, s.
        acting: rotors and friction, `rotors.Actuators.constants`; None for the paper's rig.
        away: how far rotors are from the first voltages where a stretch begins, (stretches, 2), V; None: they are
            settled.
        inertias: by which the slopes are wanted, too.
        wanted: called now and then; what it raises ends the fit.

    Raises:
        FloatingPointError: the simulation diverges.
    """
    t, angles, volts = recording.t, recording.angles, recording.voltages
    rotors = None if acting is None else turning(acting, stretches(t), t, volts, away)
    starts = starts.copy()

    def concluded(starts: Floats, slopes: Floats, residuals: Floats) -> Fitted:
        if inertias:
            more = by_inertias(
                inertias, p, starts, bounds, t=t, volts=volts, step=step, rotors=rotors, wanted=wanted
            )
            slopes = np.concatenate([slopes, more * weights[:, None]], axis=2)
        return _projected(bounds, weights, starts, slopes, residuals)

    if rotors is not None:
        return concluded(
            *_fit_guarded(p, recording, bounds, starts, rotors, weights=weights, step=step, wanted=wanted)
        )
    last = starts, np.empty(0), np.empty(0)
    for _ in range(_MOST_STEPS):
        outputs, slopes = run_segments(p, starts, bounds, t, volts, step=step, wanted=wanted)
        residuals, largest = (angles - outputs) * weights, 0.0
        slopes *= weights[:, None]
        last = starts.copy(), slopes, residuals
        for i, (first, end) in enumerate(bounds.tolist()):
            change, share = _change(residuals[first:end], slopes[first:end])
            starts[i] += change
            largest = max(largest, share)
        if largest < _TOLERANCE:  # the last step is below what the residuals show
            break
    return concluded(*last)


def _change(residuals: Floats, slopes: Floats) -> tuple[Floats, float]:
    """Gauss and Newton's step of a segment's starting state, (4,), and its share of the squares.

    Raises:
        FloatingPointError: the simulation diverges.
    """
    r, own = residuals.ravel(), slopes[:, :, :4].reshape(-1, 4)
    if not (np.all(np.isfinite(own)) and np.all(np.isfinite(r))):
        raise FloatingPointError("the simulation diverges")
    Q, R = np.linalg.qr(own)
    shown = Q.T @ r
    change = np.asarray(np.linalg.lstsq(R, shown, rcond=1e-12)[0], dtype=np.float64)
    return change, float(shown @ shown) / (1e-300 + float(r @ r))


def _fit_guarded(
    p: Any,
    recording: Recording,
    bounds: NDArray[np.int64],
    starts: Floats,
    rotors: Turning,
    *,
    weights: Floats,
    step: float,
    wanted: Wanted,
) -> tuple[Floats, Floats, Floats]:
    """Starts, slopes, residuals; no step may make a segment's residuals larger, each keeps its best."""
    t, angles, volts = recording.t, recording.angles, recording.voltages
    best, squares = starts.copy(), np.full(len(bounds), np.inf)
    changes, shares = np.zeros_like(starts), np.ones(len(bounds))
    slopes, residuals = np.empty(0), np.empty(0)
    for _ in range(_MOST_GUARDED):
        outputs, found = run_segments(p, starts, bounds, t, volts, step=step, rotors=rotors, wanted=wanted)
        left, found = (angles - outputs) * weights, found * weights[:, None]
        if not slopes.size:
            slopes, residuals = found.copy(), left.copy()
        for i, (first, end) in enumerate(bounds.tolist()):
            own = float(np.sum(left[first:end] ** 2))
            if own < squares[i] or not np.isfinite(squares[i]):
                best[i], squares[i] = starts[i], own
                slopes[first:end], residuals[first:end] = found[first:end], left[first:end]
                changes[i], shares[i] = _change(left[first:end], found[first:end])
            else:
                changes[i] *= _SHORTER
                shares[i] *= _SHORTER
        if np.max(shares) < _TOLERANCE:
            break
        starts = best + changes
    return best, slopes, residuals


def _projected(
    bounds: NDArray[np.int64], weights: Floats, starts: Floats, slopes: Floats, residuals: Floats
) -> Fitted:
    """What is left of weighted slopes by the parameters where the starting states follow them."""
    left, kept = np.zeros((*residuals.shape, slopes.shape[2] - 4)), np.zeros_like(residuals)
    basis = np.zeros((*residuals.shape, 4))
    for first, end in bounds.tolist():
        Q, _ = np.linalg.qr(slopes[first:end, :, :4].reshape(-1, 4))
        rest = slopes[first:end, :, 4:].reshape(len(Q), -1)
        left[first:end] = (rest - Q @ (Q.T @ rest)).reshape(end - first, 2, -1)
        basis[first:end] = Q.reshape(end - first, 2, 4)
        kept[first:end] = residuals[first:end]
    return Fitted(starts, kept / weights, left / weights[:, None], basis)


def fit_of(
    p: Parameters,
    recording: Recording,
    bounds: NDArray[np.int64],
    wanted: Wanted = nobody_leaves,
    *,
    acting: Floats | None = None,
    away: Floats | None = None,
) -> Fitted:
    """The segments under a rig's parameters, both axes weighted alike; the rest as in `fit_starts`.

    Raises:
        RecordingError: the rig runs away.
    """
    starts, step = rough_starts(recording, bounds), longest_step(p)
    with divergence_told():
        return fit_starts(
            p,
            recording,
            bounds,
            starts,
            weights=np.ones(2),
            step=step,
            acting=acting,
            away=away,
            wanted=wanted,
        )
