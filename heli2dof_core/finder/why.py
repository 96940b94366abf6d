"""Where no design meets everything: which requirements contradict, and by how much each would have to give."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import combinations
from math import isfinite

import numpy as np

from ..errors import Heli2DofError
from ..requirements import Requirement
from ..spec import Spec
from .ask import Find
from .problem import Problem, Tried
from .proof import proved, report_of, value_of
from .result import Give, Why
from .search import MISSES, POPULATION, Exhausted, Search

LEAST = 4 * POPULATION
"""Designs of the smallest search for whether some of the requirements can be met together."""
PAIRS = 10
"""Most requirements of which all pairs are looked at; of more, single ones are left out one after the other."""


class Contradiction:
    """Looks for the smallest set of requirements that no design meets together.

    Args:
        search: one that has found no design that meets everything; its budget is used on.
    """

    def __init__(self, search: Search) -> None:
        self._search, self._problem = search, search.problem
        self._ask, self._count = search.problem.ask, len(search.problem.ask.require)
        self._share = max(LEAST, (search.designs - search.used) // (2 * self._count + 4))
        self.why: Why | None = None

    def run(self) -> Iterator[None]:
        """Fills `why`; stops for a moment after every part of the work.

        Where the time runs out before a set is found it stays None: what was not looked at long enough is no
        contradiction.
        """
        with suppress(Exhausted):
            yield from self._run()

    def _run(self) -> Iterator[None]:
        own = yield from self._smallest()
        gives = []
        for k, i in enumerate(own):
            self._share = max(LEAST, (self._search.designs - self._search.used) // (len(own) - k))
            try:
                gives.append(self._give(i, own))
            except Exhausted:  # what of it was found is told
                gives.append(Give(i, None, False))
            yield
        self.why = Why(own, tuple(gives))

    def _smallest(self) -> Generator[None, None, tuple[int, ...]]:
        """The smallest set that nothing was found to meet."""
        for size in (1, 2) if self._count <= PAIRS else (1,):
            if size >= self._count:
                break
            for some in self._likely(size):
                if not self._together(some):
                    return some
                yield
        own = tuple(range(self._count))
        for i in range(self._count) if self._count > 1 else ():
            rest = tuple(k for k in own if k != i)
            if rest and not self._together(rest):
                own = rest
            yield
        return own

    def _likely(self, size: int) -> list[tuple[int, ...]]:
        """Sets of so many, those first that the designs tried are farthest from meeting together."""
        every = list(combinations(range(self._count), size))
        return sorted(every, key=lambda some: -float(self._search.excess[:, some].sum(axis=1).min()))

    def _together(self, some: Sequence[int]) -> bool:
        """Whether some of the requirements can be met together, as far as was seen."""
        if np.any(np.all(self._search.excess[:, some] == 0.0, axis=1)):
            return True
        ask = replace(self._ask, require=tuple(self._ask.require[i] for i in some), minimize=())
        search = self._sub(ask, None, some)
        with suppress(Exhausted):
            search.meet(search.designs)
        self._search.used += search.used
        if search.front is None:
            self._require_time(search)
        return search.front is not None

    def _require_time(self, search: Search) -> None:
        """Raises Exhausted where a search has found nothing because its time had run out."""
        if search.stopped:
            self._search.stopped = True
            raise Exhausted

    def _sub(self, ask: Find, open_end: int | None, near: Sequence[int]) -> Search:
        """A search with some of the requirements, which begins where the first was nearest to those of `near`."""
        own = self._problem
        if not any(need.uncertain for need in ask.require):
            ask = replace(ask, uncertainty=None)
        problem = Problem(own.space.spec, ask, own.threads, own.check, open_end)
        search = Search(
            problem, self._share, self._search.until
        )  # a little more than is left, where little was given
        known = self._search.kept
        assert known is not None
        order = np.argsort(known.excess[:, near].sum(axis=1), kind="stable")
        try:
            search.begin(known.points[order[: self._share // 6]])
        except Exhausted:
            self._require_time(search)
            raise
        return search

    def _own(self, spec: Spec, need: Requirement) -> float:
        """What a design has of a figure; of both axes the one that decides."""
        parts = need.apart([axis for axis in ("theta", "psi") if getattr(spec.scenario, axis) is not None])
        if need.measured is None:
            (design,) = proved(self._problem, [spec])
            return design.values[self._problem.told.index(need.measure)]
        report = report_of(spec)
        values = [value_of(report, one.measure) for one in parts]
        return max(values, key=lambda value: float(need.excess(np.array(value))))

    def _give(self, i: int, own: tuple[int, ...]) -> Give:
        """What a requirement would have to become, all others kept; or at least those that contradict it."""
        others = tuple(k for k in range(self._count) if k != i)
        for rest in dict.fromkeys((others, tuple(k for k in own if k != i))):
            some = (*rest, i)
            ask = replace(self._ask, require=tuple(self._ask.require[k] for k in some), minimize=())
            last = len(some) - 1
            search = self._sub(ask, last, rest)
            with suppress(Exhausted):
                while search.used + POPULATION <= search.designs:
                    before = search.used
                    search.descend(lambda tried, at=last: _misses(tried, at), search.designs)
                    if search.used == before:
                        break
            self._search.used += search.used
            self._require_time(search)
            best = self._nearest(search, last)
            if best is not None:
                spec, value = best
                return Give(i, value, rest == others, spec)
        return Give(i, None, False)

    def _nearest(self, search: Search, last: int) -> tuple[Spec, float] | None:
        """The design that misses the last requirement by least and meets the others, and what it has."""
        assert search.kept is not None
        for k in np.argsort(_misses(search.kept, last), kind="stable")[:4].tolist():
            if search.kept.excess[k, :last].sum() > 0.0 or search.kept.missed[k] >= MISSES:
                return None
            try:
                spec = search.problem.space.design(search.kept.points[k])
                (design,) = proved(search.problem, [spec])
            except Heli2DofError:
                continue
            if not all(own.met for own in design.required[:last]):
                continue
            need = search.problem.ask.require[last]
            share = design.required[last].share
            if share is not None:
                return spec, share
            value = self._own(spec, need)
            if isfinite(value):
                return spec, need.admitting(value)
        return None


def _misses(tried: Tried, last: int) -> np.ndarray:
    others = tried.missed - tried.excess[:, last]
    return np.where(others > 1e-12, MISSES + tried.missed, tried.excess[:, last])
