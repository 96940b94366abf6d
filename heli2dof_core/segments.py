"""Stretches of a recording that are simulated from starting states of their own, and those states' least-squares fit.

Above level the pitch of a rig with its centre of mass in front is unstable without feedback: in a simulation driven
by recorded voltages any error grows, and over a minute by many powers of ten. Therefore the recording is cut into
segments (multiple shooting without continuity: Bock, in Ebert et al., Modelling of Chemical Reaction Systems, 1981,
pp. 102–125; Ljung, System Identification, 1999, section 13.4 on closed loops).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import RecordingError
from .parameters import Parameters
from .recordings import Recording
from .signals import Floats
from .simulation.recorded import longest_step, run_segments

GROWTH = 1.0
"""Exponent by which an error may grow within a segment."""
SHORTEST = 1.0
"""Shortest segment that is chosen by itself, s."""
FEWEST = 12
"""Samples of the shortest segment that is used: three times what its starting state takes."""
STOP_MARGIN = 0.01
"""Distance from a stop of the pitch travel below which pitch may rest on it, rad."""
_START = 0.06
_TOLERANCE = 1e-9
_MOST_STEPS = 8


@dataclass(frozen=True)
class Fitted:
    """All segments under one set of parameters, their starting states fitted.

    Attributes:
        starts: (segments, 4).
        residuals: measured minus simulated angles, (n, 2), rad; 0 outside the segments.
        slopes: derivatives of the simulated angles by the seven parameters, (n, 2, 7), with whatever the starting
            states can make up for taken out; 0 outside.
    """

    starts: Floats
    residuals: Floats
    slopes: Floats


def segment_length(p: Parameters, recording: Recording) -> float:
    """How long a segment may be, s: the whole recording where nothing grows."""
    theta = recording.angles[:, 0]
    stiffness = (p.m * p.g * p.l * np.sin(theta) - p.K_s) / p.alpha
    damping = p.B_p / p.alpha
    growth = float(np.max(-damping / 2 + np.sqrt(np.maximum(damping**2 / 4 + stiffness, 0.0))))
    whole = float(recording.t[-1])
    return whole if growth <= 0 else min(whole, max(SHORTEST, GROWTH / growth))


def cut(recording: Recording, length: float, travel: float | None) -> NDArray[np.int64]:
    """First and last + 1 of each segment, (segments, 2): at most `length` s each, none while pitch is on a stop.

    Raises:
        RecordingError: nothing is left.
    """
    free = np.ones(len(recording.t), dtype=bool)
    if travel is not None:
        free = np.abs(recording.angles[:, 0]) < travel - STOP_MARGIN
    edges = np.flatnonzero(np.diff(np.concatenate([[False], free, [False]]).astype(int)))
    bounds = []
    for first, end in edges.reshape(-1, 2):
        if end - first < FEWEST:
            continue
        span = recording.t[end - 1] - recording.t[first]
        parts = max(1, min(int(np.ceil(span / length - 1e-9)), (end - first) // FEWEST))
        marks = np.linspace(first, end, parts + 1).astype(np.int64)
        bounds += pairwise(marks.tolist())
    if not bounds:
        raise RecordingError(
            "the rig rests on its stops all the time",
            field="columns.theta",
            hint="Check sign and offset of the pitch encoder, or the pitch travel of this rig.",
        )
    return np.array(bounds, dtype=np.int64)


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
    p: Any, recording: Recording, bounds: NDArray[np.int64], starts: Floats, *, weights: Floats, step: float
) -> Fitted:
    """Gauss and Newton's method on each segment's starting state, from `starts`; p stays.

    Args:
        p: has Parameters' fields, of any value.
        recording: what was measured.
        bounds: of the segments.
        starts: where to begin, (segments, 4).
        weights: of the residuals of θ and ψ, 1/rad.
        step: longest one of the integration, s.
    """
    t, angles, volts = recording.t, recording.angles, recording.voltages
    starts = starts.copy()
    last = starts, np.empty(0), np.empty(0)
    for _ in range(_MOST_STEPS):
        outputs, slopes = run_segments(p, starts, bounds, t, volts, step=step)
        residuals, largest = (angles - outputs) * weights, 0.0
        slopes *= weights[:, None]
        last = starts.copy(), slopes, residuals
        for i, (first, end) in enumerate(bounds.tolist()):
            r, own = residuals[first:end].ravel(), slopes[first:end, :, :4].reshape(-1, 4)
            if not (np.all(np.isfinite(own)) and np.all(np.isfinite(r))):
                raise FloatingPointError("the simulation diverges")
            Q, R = np.linalg.qr(own)
            shown = Q.T @ r
            starts[i] += np.linalg.lstsq(R, shown, rcond=1e-12)[0]
            largest = max(largest, float(shown @ shown) / (1e-300 + float(r @ r)))
        if largest < _TOLERANCE:  # the last step is below what the residuals show
            break
    return _projected(bounds, weights, *last)


def _projected(
    bounds: NDArray[np.int64], weights: Floats, starts: Floats, slopes: Floats, residuals: Floats
) -> Fitted:
    """What is left of weighted slopes by the parameters where the starting states follow them."""
    left, kept = np.zeros((*residuals.shape, slopes.shape[2] - 4)), np.zeros_like(residuals)
    for first, end in bounds.tolist():
        Q, _ = np.linalg.qr(slopes[first:end, :, :4].reshape(-1, 4))
        rest = slopes[first:end, :, 4:].reshape(len(Q), -1)
        left[first:end] = (rest - Q @ (Q.T @ rest)).reshape(end - first, 2, -1)
        kept[first:end] = residuals[first:end]
    return Fitted(starts, kept / weights, left / weights[:, None])


def fit_of(p: Parameters, recording: Recording, bounds: NDArray[np.int64]) -> Fitted:
    """The segments under a rig's parameters, both axes weighted alike."""
    starts, step = rough_starts(recording, bounds), longest_step(p)
    return fit_starts(p, recording, bounds, starts, weights=np.ones(2), step=step)
