"""Poles from value to value: matched one to one, with more values where they move fast, and where they cross."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..frozen import Frozen
from ..signals import Complexes, Floats
from .sweeps import Sweep, border, side

ROUNDS = 12
"""Times that a step between two values is halved, at most."""
MORE = 2
"""At most so many values are added for each one asked for."""
CLEAR = 0.7
"""A step is clear where no two poles move, one against the other, by more than this share of their distance."""
SEEN = 1e-3
"""Moves below this share of the fastest pole are clear in any case: nobody sees them."""
NEARLY = 0.25
"""A pole may pass where the parabola through three heights comes nearer than this share of the middle one."""


@dataclass(frozen=True)
class Course(Frozen):
    """Values at which there is a loop, ascending; where stretches begin; poles, each column one course; stability."""

    values: Floats
    starts: tuple[int, ...]
    poles: Complexes
    stable: NDArray[np.bool_]


def followed(sweep: Sweep, values: Floats, check: Callable[[], None]) -> Course:
    """The poles' courses over `values` and over more of them, where steps are not clear."""
    poles, stable = sweep.poles(values)
    room = MORE * len(values)
    for _ in range(ROUNDS):
        check()
        new = _unclear(values, poles)[: max(room, 0)]
        if not len(new):
            break
        room -= len(new)
        values, poles, stable = _merged(sweep, values, poles, stable, new)
    turns = [value for value in _turning(sweep, values, poles) if value not in values]
    if turns:
        values, poles, stable = _merged(sweep, values, poles, stable, np.array(turns))
    return _course(values, poles, stable)


def _merged(
    sweep: Sweep, values: Floats, poles: Complexes, stable: np.ndarray, new: Floats
) -> tuple[Floats, Complexes, np.ndarray]:
    more, also = sweep.poles(new)
    width = max(poles.shape[1], more.shape[1])
    rows = np.vstack((_padded(poles, width), _padded(more, width)))
    values = np.concatenate((values, new))
    order = np.argsort(values, kind="stable")
    return values[order], rows[order], np.concatenate((stable, also))[order]


def _padded(poles: Complexes, width: int) -> Complexes:
    """With poles at 0, those of integrals that drive nothing, where there are fewer; NaN stays."""
    missing = width - poles.shape[1]
    if not missing:
        return poles
    more = (
        np.where(np.isnan(poles[:, :1]), poles[:, :1], 0.0)
        if poles.shape[1]
        else np.full((len(poles), 1), np.nan)
    )
    return np.hstack((poles, np.repeat(more, missing, axis=1)))


def _there(poles: Complexes) -> np.ndarray:
    return np.isfinite(poles).all(axis=1) & (poles.shape[1] > 0)


def courses(stack: Complexes) -> Complexes:
    """The rows (steps, order) in an order in which each column follows one pole; the last one keeps its own.

    Neighbours are matched by the least sum of squares, which keeps the order of poles that move along a line.
    """
    from scipy.optimize import linear_sum_assignment

    ordered = stack.copy()
    for k in range(len(ordered) - 1, 0, -1):
        distance = np.abs(ordered[k][:, None] - ordered[k - 1])
        nearest = distance.argmin(axis=1)
        if len(set(nearest.tolist())) < len(nearest):
            nearest = linear_sum_assignment(distance**2)[1]
        ordered[k - 1] = ordered[k - 1][nearest]
    return ordered


def _course(values: Floats, poles: Complexes, stable: np.ndarray) -> Course:
    there = np.flatnonzero(_there(poles))
    if not len(there):
        return Course(values[:0], (), poles[:0], stable[:0])
    gaps = np.flatnonzero(np.diff(there) > 1) + 1
    return Course(values[there], (0, *gaps.tolist()), courses(poles[there]), stable[there])


def _unclear(values: Floats, poles: Complexes) -> Floats:
    """Middles of the steps in which it is not clear which pole went where, those that move farthest first."""
    there = np.flatnonzero(_there(poles))
    if len(there) < 2 or poles.shape[1] < 2:
        return values[:0]
    rows = courses(poles[there])
    between = rows[:, :, None] - rows[:, None, :]
    moved, room = np.abs(np.diff(between, axis=0)), np.abs(between)
    unclear = moved > CLEAR * np.minimum(room[:-1], room[1:])
    size = np.max(np.abs(rows), axis=1)
    unclear &= moved > SEEN * np.minimum(size[:-1], size[1:])[:, None, None]
    worst = np.where(unclear, moved, 0.0).max(axis=(1, 2))
    worst[np.diff(there) > 1] = 0.0
    steps = np.flatnonzero(worst)
    steps = steps[np.argsort(-worst[steps], kind="stable")]
    low, high = values[there][:-1], values[there][1:]
    return 0.5 * (low[steps] + high[steps])


def _turning(sweep: Sweep, values: Floats, poles: Complexes) -> Iterator[float]:
    """Values at which a pole comes nearest to the border between two values, and perhaps passes it twice."""
    from scipy.optimize import minimize_scalar

    course = _course(values, poles, np.zeros(len(values), dtype=bool))
    heights = side(course.poles, sweep.plane)
    for a, b in _stretches(course):
        for k in range(a + 1, b - 1):
            x = course.values[k - 1 : k + 2]
            for j in range(heights.shape[1]):
                near = complex(course.poles[k, j])
                if near.imag < 0.0 or not _may_pass(x, heights[k - 1 : k + 2, j]):
                    continue
                own = _Height(sweep, near, float(np.sign(heights[k, j])))
                slack = {"xatol": 1e-6 * float(x[2] - x[0])}
                found = minimize_scalar(own, bounds=(x[0], x[2]), method="bounded", options=slack)
                yield float(found.x)


class _Height:
    """How far the pole that is near a given one lies from the border, on the side where it is."""

    def __init__(self, sweep: Sweep, near: complex, sign: float) -> None:
        self._sweep, self._near, self._sign = sweep, near, sign

    def __call__(self, value: float) -> float:
        row, _ = self._sweep.poles(np.array([value]))
        nearest = row[:1, int(np.argmin(np.abs(row[0] - self._near)))]
        return self._sign * float(side(nearest, self._sweep.plane)[0])


def _may_pass(x: Floats, heights: Floats) -> bool:
    """Whether a parabola through three heights on one side turns near the border, or beyond it, between them."""
    before, own, after = np.abs(heights).tolist()
    one_side = bool(np.all(heights > 0.0) or np.all(heights < 0.0))
    if not one_side or not np.all(np.isfinite(heights)) or own > min(before, after):
        return False
    left, right = (before - own) / (x[1] - x[0]), (after - own) / (x[2] - x[1])
    bend = (left + right) / (x[2] - x[0])
    slope = (right * (x[1] - x[0]) - left * (x[2] - x[1])) / (x[2] - x[0])
    return bool(bend > 0.0 and own - slope * slope / (4.0 * bend) < NEARLY * own)


def _stretches(course: Course) -> Iterator[tuple[int, int]]:
    yield from zip(course.starts, (*course.starts[1:], len(course.values)), strict=True)


def crossings_of(
    sweep: Sweep, course: Course, check: Callable[[], None]
) -> list[tuple[float, complex, bool]]:
    """Where poles pass the border: the value, the pole with Im ≥ 0, and whether it leaves the stable side."""
    found: list[tuple[float, complex, bool]] = []
    heights, slack = side(course.poles, sweep.plane), border(course.poles, sweep.plane)
    for a, b in _stretches(course):
        for j in range(heights.shape[1]):
            check()
            off = [k for k in range(a, b) if abs(heights[k, j]) > slack[k]]
            for k, m in pairwise(off):
                if heights[k, j] * heights[m, j] > 0.0 or course.poles[m, j].imag < 0.0:
                    continue
                ends = (float(course.values[k]), float(course.values[m]))
                poles = (complex(course.poles[k, j]), complex(course.poles[m, j]))
                value, pole = _located(sweep, ends, poles)
                found.append((value, complex(pole.real, abs(pole.imag)), bool(heights[m, j] > 0.0)))
    return sorted(found, key=lambda own: own[0])


def _located(
    sweep: Sweep, ends: tuple[float, float], poles: tuple[complex, complex]
) -> tuple[float, complex]:
    """The value between two at which the pole that is between two passes the border, and the pole there."""
    from scipy.optimize import brentq

    (low, high), (first, last) = ends, poles

    def pole_at(value: float) -> complex:
        if value == low:
            return first
        if value == high:
            return last
        between = first + (last - first) * (value - low) / (high - low)
        row, _ = sweep.poles(np.array([value]))
        return complex(row[0, np.argmin(np.abs(row[0] - between))])

    def height(value: float) -> float:
        return float(side(np.array([pole_at(value)]), sweep.plane)[0])

    size = max(abs(low), abs(high))
    value = float(brentq(height, low, high, xtol=1e-13 * size, rtol=1e-14))  # pyright: ignore[reportArgumentType]
    return value, pole_at(value)
