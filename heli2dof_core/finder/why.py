"""Where no design meets everything: what no design meets by itself, what contradicts, what each would have to give.

First each requirement by itself: one that no design meets contradicts any other, which says nothing of the other.
Only of those that can be met a smallest set is sought that no design meets together.
"""

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
    """Looks for requirements that no design meets by themselves, and for the smallest set of others that contradict.

    Args:
        search: one that has found no design that meets everything; its budget is used on.
    """

    def __init__(self, search: Search) -> None:
        self._search, self._problem = search, search.problem
        self._ask, self._count = search.problem.ask, len(search.problem.ask.require)
        self._share = max(LEAST, (search.designs - search.used) // (2 * self._count + 4))
        self._alone: list[int] = []
        self._set: tuple[int, ...] = ()
        self._gives: list[Give] = []

    @property
    def why(self) -> Why | None:
        """What was found; None where nothing was.

        Where the time runs out before a set is found none is named: what was not looked at long enough is no
        contradiction.
        """
        named = (*sorted(self._alone), *self._set)
        if not named:
            return None
        known = {own.requirement: own for own in self._gives}
        gives = tuple(known.get(i, Give(i, None, False)) for i in named)
        return Why(self._set, gives, tuple(sorted(self._alone)))

    def run(self) -> Iterator[None]:
        """Fills `why`; stops for a moment after every part of the work."""
        with suppress(Exhausted):
            yield from self._run()

    def _run(self) -> Iterator[None]:
        for (i,) in self._likely(1, range(self._count)):
            # of a single one the whole search has been about it
            if not (self._seen((i,)) if self._count == 1 else self._together((i,))):
                self._alone.append(i)
            yield
        self._set = yield from self._smallest([i for i in range(self._count) if i not in self._alone])
        named = (*sorted(self._alone), *self._set)
        for k, i in enumerate(named):
            self._share = max(LEAST, (self._search.designs - self._search.used) // (len(named) - k))
            with suppress(Exhausted):  # what of it was found is told
                self._gives.append(self._give(i))
            yield

    def _smallest(self, possible: Sequence[int]) -> Generator[None, None, tuple[int, ...]]:
        """The smallest set that nothing was found to meet, of requirements that can be met by themselves."""
        own = tuple(possible)
        # of all of them the whole search has been about it
        if len(own) < 2 or (self._seen(own) if len(own) == self._count else self._together(own)):
            return ()
        yield
        for some in self._likely(2, own) if 2 < len(own) <= PAIRS else ():
            if not self._together(some):
                return some
            yield
        for i in possible:
            rest = tuple(k for k in own if k != i)
            if len(rest) > 1 and not self._together(rest):
                own = rest
            yield
        return own

    def _likely(self, size: int, among: Sequence[int]) -> list[tuple[int, ...]]:
        """Sets of so many, those first that the designs tried are farthest from meeting together."""
        every = list(combinations(among, size))
        return sorted(every, key=lambda some: -float(self._search.excess[:, some].sum(axis=1).min()))

    def _seen(self, some: Sequence[int]) -> bool:
        """Whether a design that was tried meets some of the requirements together."""
        return bool(np.any(np.all(self._search.excess[:, some] == 0.0, axis=1)))

    def _together(self, some: Sequence[int]) -> bool:
        """Whether some of the requirements can be met together, as far as was seen."""
        if self._seen(some):
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

    def _give(self, i: int) -> Give:
        """What a requirement would have to become, all others kept; or at least those that it may be met with.

        These are the others that can be met by themselves, and else those alone that contradict it.
        """
        others = tuple(k for k in range(self._count) if k != i)
        possible = tuple(k for k in others if k not in self._alone)
        for rest in dict.fromkeys((possible, tuple(k for k in self._set if k != i and i in self._set))):
            some = (*rest, i)
            ask = replace(self._ask, require=tuple(self._ask.require[k] for k in some), minimize=())
            last = len(some) - 1
            search = self._sub(ask, last, rest or some)
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
