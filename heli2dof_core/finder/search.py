"""The search itself: differential evolution and CMA-ES by turns, from one part of the front to the next.

First it looks for designs that meet everything, then for the best in each figure, then between those where the front
has its widest gap. Each part is one run with one weighting of the figures, and begins with the best for it of all
that was tried before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np

from ..signals import Floats
from .problem import LARGE, Problem, Tried

POPULATION, OFFSPRING = 48, 16
"""Designs of a generation: of differential evolution, of CMA-ES."""
IDLE = 6
"""Runs that leave the front as it was, after which nothing more is expected."""
SPREAD = 0.1
"""Standard deviation with which CMA-ES begins, in the unit cube."""
STARTS, MOST_STARTS = 0.08, 1000
"""Share of the budget for random designs, and the most of them."""
FEASIBLE = 0.5
"""Most of the budget after which the search for a first design that meets everything ends."""
PIECE = 1500
"""Most designs of one run, so that the others hear how far it is."""
NEAR = 0.1
"""How far the first designs are from the one that is there, in the unit cube."""
TOLERANCE = 1e-4
"""Spread of a generation's fitness at which a run has converged."""
PARTS = 10
"""Runs that the rest of the budget is for."""
KEPT = 4000
"""Designs that are remembered, besides the front, to begin runs with."""
MISSES = 1e4
"""What a design that misses something counts at least, where others are told by how good they are."""
_SLOPE = 0.05


class Exhausted(Exception):  # noqa: N818 (no error: the end of the budget)
    """The budget of one run, or of all, is used up."""


class Search:
    """All that was tried.

    Args:
        problem: what is asked.
        designs: the budget.
        until: when it ends in any case, as `time.perf_counter` tells it; None: never.

    Attributes:
        used: of the budget.
        met: how many of those tried meet everything.
        stopped: whether the time had run out.
        front: the best designs that meet everything; None where there are none.
        kept: of those tried the most promising.
        excess: of all that were tried, (n, r), as `Tried.excess`.
    """

    def __init__(self, problem: Problem, designs: int, until: float | None = None) -> None:
        self.problem, self.designs, self.until = problem, designs, until
        self.used, self.stopped, self.met, self._turn = 0, False, 0, 0
        self.front: Tried | None = None
        self.kept: Tried | None = None
        self._excess: list[Floats] = []
        self._home = problem.space.point_of(problem.space.spec)
        self._rng = np.random.default_rng(problem.ask.seed)

    @property
    def excess(self) -> Floats:
        """By how much each design that was tried misses each requirement."""
        if len(self._excess) > 1:
            self._excess = [np.concatenate(self._excess)]
        return self._excess[0]

    def run(self) -> Iterator[None]:
        """Searches until the budget is used up; stops for a moment after every part of the work.

        Where nothing meets everything, it ends with a share of the budget left: for why.
        """
        try:
            self.begin()
            yield
            limit = int(FEASIBLE * self.designs)
            while self.front is None and self.used + POPULATION <= limit:
                self.meet(min(limit, self.used + PIECE))
                yield
            if self.front is not None:
                yield from self._spread()
        except Exhausted:
            pass

    def begin(self, points: Floats | None = None) -> None:
        """Tries the design that is there, some near it and random ones; with `points` these, too."""
        count = min(max(POPULATION, min(int(STARTS * self.designs), MOST_STARTS)), self.designs)
        size = self.problem.space.size
        first = self._rng.random((count, size))
        near = count // 4
        first[:near] = np.clip(self._home + NEAR * self._rng.standard_normal((near, size)), 0.0, 1.0)
        first[0] = self._home
        if points is not None:
            first = np.vstack((points, first[: max(POPULATION - len(points), near)]))
        for i in range(0, len(first), 256):
            self.look(first[i : i + 256])

    def meet(self, until: int) -> None:
        """Until a design meets everything, at most until so much of the budget is used."""
        while self.front is None and self.used + POPULATION <= until:
            self.descend(lambda own: own.missed, until, ends=lambda: self.front is not None)

    def _spread(self) -> Iterator[None]:
        """Along the front."""
        goals = len(self.problem.ask.minimize) or 1
        weights = list(np.eye(goals)) if goals > 1 else [np.ones(1)]
        parts = PARTS if goals > 1 else 3
        share = min(PIECE, (self.designs - self.used) // parts)
        done: list[Floats] = []
        idle = 0
        while self.used + POPULATION <= self.designs and idle < IDLE:
            weight = weights.pop(0) if weights else self._between(done)
            done.append(weight)
            before = self.front
            self.descend(self._weighted(weight), self.used + max(share, 4 * POPULATION))
            idle = idle + 1 if self._is_as(before) else 0
            yield

    def _is_as(self, before: Tried | None) -> bool:
        """Whether the front is as it was."""
        if before is None or self.front is None or len(before) != len(self.front):
            return False
        return bool(np.all(np.abs(before.goals - self.front.goals) <= TOLERANCE * np.abs(self.front.goals)))

    def _between(self, done: list[Floats]) -> Floats:
        """A weighting that aims at the middle of the front's widest gap."""
        goals = len(done[0])
        if goals == 1:
            return done[0]
        if self.front is None or len(self.front) < 2:
            own = self._rng.dirichlet(np.ones(goals))
            return own / own.max()
        ideal, scale = self._frame()
        points = (self.front.goals - ideal) / scale
        if goals == 2:
            points = points[np.argsort(points[:, 0])]
            gaps = np.hypot(*np.diff(points, axis=0).T)
            i = int(np.argmax(gaps * self._rng.uniform(0.5, 1.0, len(gaps))))
            target = 0.5 * (points[i] + points[i + 1])
        else:
            a, b = points[self._rng.choice(len(points), 2, replace=False)]
            target = 0.5 * (a + b)
        own = 1.0 / np.maximum(target, 0.02)
        return own / own.max()

    def _frame(self) -> tuple[Floats, Floats]:
        """The best of each figure among those that meet everything, and how far the front reaches."""
        own = self.front if self.front is not None and len(self.front) else self.kept
        assert own is not None
        goals = own.goals[np.all(own.goals < LARGE / 10, axis=1)] if len(own) else own.goals
        goals = goals if len(goals) else own.goals
        ideal = goals.min(axis=0)
        return ideal, np.maximum(np.ptp(goals, axis=0), 1e-3 * np.abs(ideal) + 1e-9)

    def _weighted(self, weight: Floats) -> Callable[[Tried], Floats]:
        ideal, scale = self._frame()

        def fitness(own: Tried) -> Floats:
            parts = weight * (own.goals - ideal) / scale
            value = np.max(parts, axis=1) + _SLOPE * np.sum((own.goals - ideal) / scale, axis=1)
            return np.where(own.missed > 0.0, MISSES + own.missed, np.clip(value, -1e3, 1e3))

        return fitness

    def descend(
        self, fitness: Callable[[Tried], Floats], until: int, ends: Callable[[], bool] = lambda: False
    ) -> None:
        """One run, until so much of the budget is used, it ends or has converged; both kinds take turns."""
        self._turn += 1
        until = min(until, self.designs)
        (self._evolve if self._turn % 2 else self._adapt)(fitness, until, ends)

    def _evolve(self, fitness: Callable[[Tried], Floats], until: int, ends: Callable[[], bool]) -> None:
        """Differential evolution of the best so far, with some random designs among them."""
        from scipy.optimize import differential_evolution

        size = self.problem.space.size
        assert self.kept is not None
        best = np.argsort(fitness(self.kept), kind="stable")[: 3 * POPULATION // 4]
        first = np.vstack((self.kept.points[best], self._rng.random((POPULATION - len(best), size))))
        failed: list[ValueError] = []

        def values(points: Floats) -> Floats:
            if self.used + POPULATION > until or ends():
                raise Exhausted
            try:
                return fitness(self.look(points.T if points.ndim > 1 else points[np.newaxis]))
            except ValueError as error:  # which SciPy would take for a fault of the function's shape
                failed.append(error)
                raise Exhausted from error

        how: dict[str, Any] = {"vectorized": True, "updating": "deferred", "init": first, "maxiter": 10**6}
        how |= {"polish": False, "tol": TOLERANCE, "atol": TOLERANCE, "rng": self._rng}
        try:
            differential_evolution(values, [(0.0, 1.0)] * size, **how)
        except Exhausted:
            if failed:
                raise failed[0] from None
            if self.used + POPULATION > self.designs or self.stopped:
                raise

    def _adapt(self, fitness: Callable[[Tried], Floats], until: int, ends: Callable[[], bool]) -> None:
        """CMA-ES around the best so far."""
        from cma import CMAEvolutionStrategy

        assert self.kept is not None
        if self.problem.space.size < 2:  # which it does not take
            return self._evolve(fitness, until, ends)
        start = self.kept.points[int(np.argmin(fitness(self.kept)))]
        how: dict[str, Any] = {"bounds": [0.0, 1.0], "popsize": OFFSPRING, "verbose": -9, "seed": np.nan}
        # its own random numbers would be NumPy's, which everybody shares
        how |= {
            "randn": lambda *shape: self._rng.standard_normal(shape),
            "tolfun": TOLERANCE,
            "tolx": TOLERANCE,
        }
        strategy = CMAEvolutionStrategy(start, SPREAD, how)
        while not strategy.stop() and self.used + OFFSPRING <= until and not ends():
            points = strategy.ask()
            strategy.tell(points, fitness(self.look(np.array(points))).tolist())
        return None

    def look(self, points: Floats) -> Tried:
        """Tries designs, and remembers them."""
        if self.used + len(points) > self.designs:
            raise Exhausted
        # the first are always tried, so that there is something to tell
        if self.kept is not None and self.until is not None and perf_counter() > self.until:
            self.stopped = True
            raise Exhausted
        self.problem.check()
        points = np.clip(points, 0.0, 1.0)
        own = self._near(self.problem.tried(points))
        self.used += len(points)
        if self.problem.on_all is not None:
            own = self._near(self._on_rigs(own))
        self._remember(own)
        return own

    def _near(self, own: Tried) -> Tried:
        """The same; where nothing is to be minimized, nearer to the present design is better."""
        if self.problem.ask.minimize:
            return own
        return replace(own, goals=np.linalg.norm(own.points - self._home, axis=1)[:, np.newaxis])

    def _on_rigs(self, own: Tried) -> Tried:
        """Puts those on uncertain rigs that might enlarge the front."""
        which = np.flatnonzero(own.waiting)
        if self.front is not None and len(which):
            known = self.front.goals
            dominated = np.any(np.all(known[np.newaxis] <= own.goals[which, np.newaxis], axis=2), axis=1)
            which = which[~dominated]
        which = which[: (self.designs - self.used) // self.problem.cost]
        self.used += len(which) * self.problem.cost
        return self.problem.put_on_rigs(own, which)

    def _remember(self, own: Tried) -> None:
        self._excess.append(own.excess)
        good = own.missed == 0.0
        self.met += int(np.count_nonzero(good))
        if np.any(good):
            every = own.taken(good) if self.front is None else Tried.joined(self.front, own.taken(good))
            self.front = every.taken(nondominated(every.goals))
        every = own if self.kept is None else Tried.joined(self.kept, own)
        if len(every) > 2 * KEPT:
            every = every.taken(np.sort(np.argsort(every.missed, kind="stable")[:KEPT]))
        self.kept = every


def nondominated(goals: Floats) -> np.ndarray:
    """Which of the rows, (n, k), are dominated by no other: their numbers, sorted by the first figure.

    Of equal ones the first stays.
    """
    order = np.lexsort(goals.T[::-1])
    if goals.shape[1] == 1:
        return order[:1]
    if goals.shape[1] == 2:
        second = goals[order, 1]
        before = np.concatenate(([np.inf], np.minimum.accumulate(second)[:-1]))
        return order[second < before]
    kept: list[int] = []
    for i in order.tolist():
        if not any(np.all(goals[j] <= goals[i]) for j in kept):
            kept.append(i)
    return np.array(kept, dtype=int)
