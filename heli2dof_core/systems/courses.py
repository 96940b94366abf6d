"""Responses of a closed loop over time: steps of the references, and from an initial state."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, log10

import numpy as np
from numpy.typing import ArrayLike

from ..checks import require_within
from ..errors import InvalidInputError
from ..frozen import Frozen
from ..signals import Complexes, Floats
from .loop import ClosedLoop

SAMPLES = 241
LONGEST, SHORTEST = 1e6, 1e-6
"""Seconds of a response."""
FARTHEST = 1e12
"""Of an initial state, each."""
SETTLED = 6.0
"""A response lasts so many time constants of the slowest pole, in which exp(−t/τ) falls to 0.25 %."""
FASTEST = 2000.0
"""A response lasts at most so many times as long as the largest pole's magnitude turns once."""


@dataclass(frozen=True)
class Courses(Frozen):
    """Over time, s.

    Attributes:
        t: (`SAMPLES`,).
        step_y: per reference every output, (m, q, `SAMPLES`); each reference steps by 1, the others stay 0.
        step_u: per reference every input, (m, p, `SAMPLES`).
        initial_x: every state from x(0), the references 0, (n, `SAMPLES`).
        initial_y, initial_u: the outputs and inputs meanwhile.
        estimate: with an observer, which begins at 0, every estimated state; else None.
        x0: where the states begin.
    """

    t: Floats
    step_y: Floats
    step_u: Floats
    initial_x: Floats
    initial_y: Floats
    initial_u: Floats
    estimate: Floats | None
    x0: Floats


def courses(loop: ClosedLoop, x0: ArrayLike | None = None, duration: float | None = None) -> Courses:
    """Exact at every sample: one matrix exponential, then its powers.

    Args:
        loop: the closed loop.
        x0: n states at t = 0, within ±`FARTHEST`; 1 for the first and 0 for the others if not given.
        duration: s; by default until the slowest pole has settled.

    Raises:
        InvalidInputError: x0 has another size, or it or the duration is out of its range.
    """
    n, _, q = loop.system.sizes
    start = np.eye(n)[0] if x0 is None else np.asarray(x0, dtype=float)
    if start.shape != (n,):
        raise InvalidInputError(
            f"x0 has {start.size} entries", field="x0", hint=f"Give {n} numbers, one per state."
        )
    for i, value in enumerate(start.tolist()):
        require_within(value, f"x0.{i}", "", -FARTHEST, FARTHEST)
    A, B, C, D = loop.matrices()
    last = _duration(_all_poles(loop)) if duration is None else duration
    require_within(last, "duration", "s", SHORTEST, LONGEST)
    t = np.linspace(0.0, last, SAMPLES)
    m = B.shape[1]
    stepped = _run(
        np.block([[A, B], [np.zeros((m, len(A) + m))]]), np.vstack([np.zeros((len(A), m)), np.eye(m)]), t
    )
    seen = np.hstack([C, D]) @ stepped  # (samples, q + p, m)
    inner, state, out = _with_estimate(loop, start)
    course = _run(inner, state[:, None], t)[:, :, 0].T
    told = out @ course
    return Courses(
        t,
        _bounded(seen[:, :q].transpose(2, 1, 0)),
        _bounded(seen[:, q:].transpose(2, 1, 0)),
        _bounded(course[:n]),
        _bounded(told[:q]),
        _bounded(told[q:]),
        None if loop.L is None else _bounded(course[:n] - course[-n:]),
        start,
    )


def _with_estimate(loop: ClosedLoop, x0: Floats) -> tuple[Floats, Floats, Floats]:
    """The whole loop without references, states [x, z, e], e = x − x̂; where it begins; and [y, u] of the states."""
    A, _, C, _ = loop.matrices()
    n, k, L = len(x0), len(A) - len(x0), loop.L
    if L is None:
        return A, np.concatenate([x0, np.zeros(k)]), C
    own = loop.system
    enter = np.vstack([own.B, np.zeros((k, own.B.shape[1]))]) @ loop.K
    whole = np.block([[A, enter], [np.zeros((n, n + k)), own.A - L @ own.C]])
    out = np.hstack([C, np.vstack([own.D @ loop.K, loop.K])])
    return whole, np.concatenate([x0, np.zeros(k), x0]), out


def _all_poles(loop: ClosedLoop) -> Complexes:
    return (
        loop.poles if loop.observer is None else np.concatenate([loop.poles, loop.observer.closed_loop_poles])
    )


def _duration(poles: Complexes) -> float:
    """Until the slowest pole has settled, in a round number of seconds."""
    size = float(np.max(np.abs(poles), initial=0.0)) or 1.0
    slowest = float(np.min(np.abs(poles.real)))
    seconds = min(SETTLED / max(slowest, 1e-12), FASTEST / size)
    step = 10.0 ** floor(log10(seconds))
    return float(np.clip(np.ceil(2 * seconds / step) / 2 * step, SHORTEST, LONGEST))


def _run(A: Floats, start: Floats, t: Floats) -> Floats:
    """e^(At) start at evenly spaced times, (samples, rows of A, columns of start)."""
    from scipy.linalg import expm

    step, found = expm(A * (t[1] - t[0])), np.empty((len(t), *start.shape))
    found[0] = start
    with np.errstate(over="ignore", invalid="ignore"):
        for i in range(1, len(t)):
            np.matmul(step, found[i - 1], out=found[i])
    return found


def _bounded(values: Floats) -> Floats:
    """Where an unstable loop has left all bounds, numbers that files and plots still take."""
    return np.ascontiguousarray(np.clip(np.nan_to_num(values, nan=0.0), -1e30, 1e30))
