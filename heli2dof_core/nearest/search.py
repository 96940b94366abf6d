"""The search for the nearest design that meets all: samples around the design, then steps along the limits.

Figures have kinks and jumps (a settling time jumps where an oscillation leaves the band), so that no method of
smooth optimization is enough, and samples alone are not exact. The same task always gives the same answer: its
random numbers are always the same, and its effort is counted in designs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from ..signals import Floats
from .handles import Chart
from .judge import Judge

DIFFERENCE = 1e-4
"""Step of differences, in coordinates."""
JUMP = 0.05
"""A limit that changes by more than this over one such step jumps there: its slope says nothing."""
INSIDE = 1e-6
"""So much within a limit, as a share of it, steps aim: what is found lies on the right side."""
PENALTY = 20.0
"""Squared distance that missing a limit by all of it is worth."""
FRACTIONS = np.array([1.0, 0.7, 0.4, 0.2, 0.08, 0.02])
"""Of each step, which are tried."""
BEYOND = 3.0
"""So many times farther than the best, samples are worth something: steps from there end elsewhere."""
SHORTEST = 1e-6
"""Steps that are no longer than this end."""
APPROACHED = 2
"""Designs that miss little, around which is looked where nothing meets all."""
RADII = (0.03, 0.1, 0.3, 0.7)
"""At which every coordinate alone is tried, as shares of what counts as near."""


@dataclass(frozen=True)
class Effort:
    """How much is looked at.

    Attributes:
        samples: random designs, in every chart.
        starts: from which steps are taken.
        steps: from each.
        rounds: of samples around the best.
        around: in each round.
    """

    samples: int
    starts: int
    steps: int
    rounds: int
    around: int

    @property
    def less(self) -> Effort:
        """A fraction of it, where each design takes long."""
        samples, steps, rounds = self.samples // 4, (self.steps + 1) // 2, (self.rounds + 2) // 3
        return Effort(samples, min(self.starts, 2), steps, rounds, self.around // 2)


@dataclass
class Best:
    """The nearest design so far that meets all, if there is one.

    Attributes:
        distance: of it, or how far it may be.
        chart, z: where it stands.
        row: its numbers for the kernel.
    """

    distance: float
    chart: Chart | None = None
    z: Floats | None = None
    row: Floats | None = None

    def take(self, chart: Chart, z: Floats, met: np.ndarray) -> bool:
        """Takes the nearest of those that meet all, where it is nearer."""
        far = np.where(met, chart.distances(z), inf)
        i = int(np.argmin(far))
        if not far[i] < self.distance:
            return False
        self.distance, self.chart, self.z = float(far[i]), chart, z[i].copy()
        return True


def search(
    judge: Judge,
    charts: Sequence[Chart],
    within: float,
    effort: Effort,
    known: Sequence[tuple[Chart, Floats]],
) -> Best:
    """The nearest design of these charts that meets all.

    Args:
        judge: of the requirements.
        charts: where to look.
        within: how far.
        effort: how much.
        known: designs to begin with, by chart of these and coordinates (n,).
    """
    return _Search(judge, effort, Best(within)).through(charts, known)


class _Search:
    """One search: what it has found, and its random numbers."""

    def __init__(self, judge: Judge, effort: Effort, best: Best) -> None:
        self.judge, self.effort, self.best = judge, effort, best
        self._within, self.random = best.distance, np.random.default_rng(0)

    def through(self, charts: Sequence[Chart], known: Sequence[tuple[Chart, Floats]]) -> Best:
        """Samples all charts, steps from the best of each, and then around the best of all."""
        best = self.best
        seen: list[tuple[Chart, Floats]] = []
        for chart in charts:
            if chart.offset**0.5 < best.distance:
                starts = self._sampled(chart, [z for other, z in known if other is chart])
                seen.append((chart, starts))
        ends: list[tuple[float, Chart, Floats]] = []
        for chart, starts in seen:
            if chart.offset**0.5 < best.distance:
                merit = self._step(chart, starts, self.effort.steps)
                ends += [(own, chart, z) for own, z in zip(merit.tolist(), starts, strict=True)]
        for merit, chart, z in sorted(ends, key=lambda end: end[0])[:APPROACHED]:
            if best.chart is None or merit < best.distance**2:
                self._approach(chart, z)
        if best.chart is not None and best.z is not None:
            self._around()
            row = self._row()
            for chart in charts:  # the nearest may be just beyond where two real poles meet
                if chart.offset**0.5 < best.distance:
                    z = chart.coordinates(chart.read(row))
                    self._step(chart, z[np.newaxis], self.effort.steps)
            best.row = self._row()
        return best

    def _row(self) -> Floats:
        """The best's numbers for the kernel."""
        chart, z = self.best.chart, self.best.z
        assert chart is not None
        assert z is not None
        return self.judge.rows(chart, z[np.newaxis])[0]

    def _look(self, chart: Chart, z: Floats) -> Floats:
        """By how much designs, (k, n), miss each limit; takes those that meet all."""
        verdict = self.judge.of_chart(chart, z)
        self.best.take(chart, z, verdict.met)
        return verdict.missed

    def _sampled(self, chart: Chart, known: Sequence[Floats]) -> Floats:
        """The best of samples, no two near each other, (starts, n)."""
        size, zs, missed = len(chart.center), [], []
        units = self.random.standard_normal((self.effort.samples, size))
        # denser towards the design, and the nearer the more is known
        units *= (self.random.random(len(units)) / np.linalg.norm(units, axis=1))[:, np.newaxis]
        for unit in (None, *np.array_split(units, max(1, len(units) // 64))):
            reach = sqrt(max(min(self._within, BEYOND * self.best.distance) ** 2 - chart.offset, 0.0))
            if unit is None:
                alone = [sign * share * reach * np.eye(size) for share in RADII for sign in (1.0, -1.0)]
                z = np.vstack([np.zeros((1, size)), *known, *alone])
            else:
                z = reach * unit
            zs.append(z)
            missed.append(self._look(chart, z))
        seen, merit = np.vstack(zs), _merit(chart, np.vstack(zs), np.vstack(missed))
        chosen: list[Floats] = []
        for z in seen[np.argsort(merit, kind="stable")]:
            apart = 0.3 * max(float(np.linalg.norm(z)), 1e-3)
            if all(np.linalg.norm(z - other) > apart for other in chosen):
                chosen.append(z)
            if len(chosen) == self.effort.starts:
                break
        return np.array(chosen)

    def _step(self, chart: Chart, z: Floats, steps: int) -> Floats:
        """Steps from several designs at once, each to the nearest point that the limits' slopes promise.

        Args:
            chart: in which the designs are.
            z: their coordinates, (k, n), overwritten by where the steps end.
            steps: how many.

        Returns:
            The ends' merits, (k,).
        """
        count, size = z.shape
        missed, trust, first = self._look(chart, z), np.full(count, 0.5), np.arange(count)
        for _ in range(steps):
            beside = (z[:, np.newaxis] + DIFFERENCE * np.eye(size)).reshape(-1, size)
            change = self._look(chart, beside).reshape(count, size, -1) - missed[:, np.newaxis]
            slopes = np.where(np.abs(change) > JUMP, 0.0, change / DIFFERENCE).transpose(0, 2, 1)
            ways = np.array([_towards(z[i], missed[i], slopes[i], trust[i]) for i in range(count)])
            tried = (z[:, np.newaxis] + FRACTIONS[:, np.newaxis] * ways[:, np.newaxis]).reshape(-1, size)
            there = self._look(chart, tried)
            merit = _merit(chart, tried, there).reshape(count, -1)
            pick = np.argmin(merit, axis=1)
            better = merit[first, pick] < _merit(chart, z, missed)
            taken = (first * len(FRACTIONS) + pick)[better]
            z[better], missed[better] = tried[taken], there[taken]
            trust *= np.where(better, np.where(pick == 0, 2.0, 1.0), 0.2)
            if np.all(trust < SHORTEST):
                break
        return _merit(chart, z, missed)

    def _approach(self, chart: Chart, z: Floats) -> None:
        """Samples around a design that misses little, until one meets all: across kinks steps do not come."""
        least, spread = inf, 0.1
        for _ in range(2 * self.effort.rounds):
            own = z + spread / sqrt(len(z)) * self.random.standard_normal((self.effort.around, len(z)))
            before = self.best.distance
            merit = _merit(chart, own, self._look(chart, own))
            if self.best.distance < before:
                return
            i = int(np.argmin(merit))
            if merit[i] < least:
                least, z = float(merit[i]), own[i]
                spread *= 1.3
            else:
                spread *= 0.7

    def _around(self) -> None:
        """Samples around the best, each nearer to the design: along jumps there are no slopes to follow."""
        chart, z, spread = self.best.chart, self.best.z, 0.3
        for _ in range(self.effort.rounds):
            if chart is None or z is None:
                return
            count, radius = self.effort.around, float(np.linalg.norm(z))
            own = z + spread * radius / sqrt(len(z)) * self.random.standard_normal((count, len(z)))
            shorter = radius * (1.0 - 0.5 * spread * self.random.random(count) ** 2)
            length = np.linalg.norm(own, axis=1)
            own *= (np.minimum(shorter, length) / np.maximum(length, 1e-300))[:, np.newaxis]
            # some on the straight way to the design
            own[0], own[1] = (1.0 - 0.3 * spread) * z, (1.0 - 0.03 * spread) * z
            self._look(chart, own)
            better, z = self.best.z is not z, self.best.z
            spread = min(0.5, spread * (1.4 if better else 0.6))


def _merit(chart: Chart, z: Floats, missed: Floats) -> Floats:
    """Squared distance, and what missing limits adds to it."""
    return chart.offset + np.sum(z * z, axis=-1) + PENALTY * np.sum(np.maximum(missed, 0.0), axis=-1)


def _towards(z: Floats, missed: Floats, slopes: Floats, trust: float) -> Floats:
    """The step to the point nearest to the design at which all limits hold, were they linear."""
    rows = np.any(slopes != 0.0, axis=1)
    a, b = -slopes[rows], missed[rows] + INSIDE - np.sum(slopes[rows] * z, axis=1)
    target = least_distance(a, b)
    if target is None:  # together they cannot hold: at least miss them by less
        wrong = np.maximum(missed[rows] + INSIDE, 0.0)
        target = z - np.linalg.lstsq(slopes[rows], wrong, rcond=1e-6)[0]
    step = target - z
    length = float(np.linalg.norm(step))
    return step * min(1.0, trust / length) if length else step


def least_distance(a: Floats, b: Floats) -> Floats | None:
    """The point nearest to the origin with a x ≥ b; None where there is none.

    Lawson and Hanson, Solving Least Squares Problems (1974), chapter 23: problem LDP by non-negative least squares.

    Args:
        a: (m, n).
        b: (m,).
    """
    from scipy.optimize import nnls

    n = a.shape[1]
    if not len(a):
        return np.zeros(n)
    size = np.maximum(np.linalg.norm(a, axis=1), 1e-300)
    a, b = a / size[:, np.newaxis], b / size
    e, f = np.vstack([a.T, b]), np.append(np.zeros(n), 1.0)
    try:
        u, norm = nnls(e, f)
    except RuntimeError:  # too many iterations
        return None
    r = e @ u - f
    return None if norm < 1e-9 or abs(r[-1]) < 1e-12 else -r[:-1] / r[-1]
