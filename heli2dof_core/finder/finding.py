"""From what is asked to the designs that are told."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from ..errors import Heli2DofError, nobody_leaves
from ..exclusion import excluding
from ..frozen import Frozen
from ..signals import Floats
from ..spec import Spec
from .ask import Find
from .problem import UNSTABLE, Problem, Tried
from .proof import proved
from .result import Candidate, Designs, Why
from .search import Search
from .why import Contradiction

MOST_TOLD, MOST_ON_RIGS = 60, 24
"""Designs that are told; where each is put on uncertain rigs."""
MOST_POINTS = 100
PAUSE = 0.2
"""Seconds between two tellings of how far a search is: a front that changes faster is followed by nobody's eyes."""
THREADS = 2
APART = 0.05
"""How far two nearest misses are apart at least, as a share of what a free number may range over.

Sizes are logarithmic: of poles between 0.5 and 50 rad/s it is a fourth of the size, which is seen in the s-plane at a
glance; a run of CMA-ES ends with hundreds of designs within a thousandth.
"""
SAME = 0.05
"""Figures of two designs that differ by a smaller share than this show nobody another compromise."""


@dataclass(frozen=True)
class Progress(Frozen):
    """How far a search is.

    Attributes:
        tried, designs: of the budget.
        seconds: since it began.
        met: how many of those tried meet everything.
        points: the front so far: what is minimized, of at most `MOST_POINTS` designs that are spread along it,
            (n, k), as `many.Many.values`.
    """

    tried: int
    designs: int
    seconds: float
    met: int
    points: Floats


def find(
    spec: Spec,
    ask: Find,
    check: Callable[[], None] = nobody_leaves,
    progress: Callable[[Progress], None] | None = None,
    threads: int = THREADS,
) -> Designs:
    """Designs that meet what is required, along the front of what is to be small.

    The same seed gives the same designs, unless the time had run out (`Designs.stopped`).

    Args:
        spec: the design that is there, with rig and experiment; what is not free stays.
        ask: what is free, required and minimized.
        check: called now and then; what it raises ends the search.
        progress: called with what is known so far, at most every `PAUSE` seconds.
        threads: that compute, at most.

    Raises:
        InvalidInputError: what is asked does not fit the design.
        Heli2DofError: the design that is there does not exist.
    """
    for part in find_in_parts(spec, ask, check, threads):
        if isinstance(part, Designs):
            return part
        if progress is not None:
            progress(part)
    raise AssertionError("a search ends with its designs")


def find_in_parts(
    spec: Spec, ask: Find, check: Callable[[], None] = nobody_leaves, threads: int = THREADS
) -> Iterator[Progress | Designs]:
    """The same as it goes: progress, and the designs last."""
    begin = perf_counter()
    problem = Problem(spec, ask, threads, check)
    if pairs := excluding(ask.require, problem.stepped):  # which no search can mend
        present, seconds = _present(problem, spec), perf_counter() - begin
        named = tuple(sorted({i for pair in pairs for i in pair}))
        why = Why(named, (), excluding=pairs)
        yield Designs(ask, problem.told, (), present, 0, seconds, False, why)
        return
    search = Search(problem, ask.designs, begin + ask.seconds)
    for _ in _paced(search.run()):
        yield _progress(search, begin)
    why = None
    if search.front is None:
        contradiction = Contradiction(search)
        for _ in _paced(contradiction.run()):
            yield _progress(search, begin)
        why = contradiction.why
    candidates = _told(search)
    if why is not None and any(own.met for own in candidates):
        why = None
    present = _present(problem, spec)
    seconds = perf_counter() - begin
    yield Designs(ask, problem.told, candidates, present, search.used, seconds, search.stopped, why)


def _paced(parts: Iterable[None]) -> Iterator[None]:
    """The first part, and of the others those that end `PAUSE` after the one before."""
    told: float | None = None
    for _ in parts:
        now = perf_counter()
        if told is None or now - told >= PAUSE:
            told = now
            yield


def _progress(search: Search, begin: float) -> Progress:
    points = np.zeros((0, len(search.problem.ask.minimize)))
    if search.front is not None and search.problem.ask.minimize:
        chosen = search.front.taken(thinned(search.front.goals, MOST_POINTS))
        points = search.problem.figures(chosen)
    return Progress(
        min(search.used, search.designs), search.designs, perf_counter() - begin, search.met, points
    )


def _present(problem: Problem, spec: Spec) -> Candidate | None:
    try:
        return proved(problem, [spec])[0]
    except Heli2DofError:
        return None


def _told(search: Search) -> tuple[Candidate, ...]:
    """The front, proved; where nothing meets everything, the nearest misses."""
    problem, most = search.problem, MOST_TOLD if search.problem.on_all is None else MOST_ON_RIGS
    if search.front is not None:
        own = search.front.taken(thinned(search.front.goals, most))
    else:
        assert search.kept is not None
        own = search.kept.taken(distinct(problem, search.kept, most // 4))
    specs = []
    for point in own.points:
        try:
            specs.append(problem.space.design(point))
        except Heli2DofError:
            continue
    found = proved(problem, specs)
    met = [design for design in found if design.met]
    # on all uncertain rigs a design may miss what it met on some
    return tuple(met if met else found)


def distinct(problem: Problem, tried: Tried, most: int) -> np.ndarray:
    """Of designs those that miss the least and are not alike, nearest first: their numbers, at most so many.

    Two are alike where nothing that is free is `APART` from the other's and no figure differs by more than is worth
    telling apart. Unstable ones are told only where no other was tried.
    """
    order = np.argsort(tried.missed, kind="stable")
    stable = order[tried.missed[order] < UNSTABLE]
    least = np.array([max(own.figure.least, 1e-9) for own in problem.measures])
    chosen: list[int] = []
    homes: list[Floats] = []
    for i in (stable if len(stable) else order[:1]).tolist():
        try:
            # as the design stands, so that a coordinate that moves nothing in it does not count
            home = problem.space.point_of(problem.space.design(tried.points[i]))
        except Heli2DofError:
            continue
        if not any(
            np.max(np.abs(home - other), initial=0.0) < APART and _alike(tried.values[[i, k]], least)
            for k, other in zip(chosen, homes, strict=True)
        ):
            chosen.append(i)
            homes.append(home)
        if len(chosen) == most:
            break
    return np.array(chosen, dtype=int)


def _alike(pair: Floats, least: Floats) -> bool:
    """Whether the figures of two designs, (2, m), are the same to everybody's eyes."""
    with np.errstate(invalid="ignore"):
        near = np.abs(pair[0] - pair[1]) <= np.maximum(least, SAME * np.max(np.abs(pair), axis=0))
    return bool(np.all(near | (pair[0] == pair[1]) | np.all(np.isnan(pair), axis=0)))


def thinned(goals: Floats, most: int) -> np.ndarray:
    """Of a front, (n, k), so many rows at most, spread along it, both ends among them; in their order."""
    count = len(goals)
    if count <= most:
        return np.arange(count)
    scale = np.ptp(goals, axis=0)
    points = goals / np.where(scale > 0, scale, 1.0)
    chosen = (
        [0] if goals.shape[1] == 1 else [int(i) for i in dict.fromkeys(np.argmin(points, axis=0).tolist())]
    )
    distance = np.min([np.sum((points - points[i]) ** 2, axis=1) for i in chosen], axis=0)
    while len(chosen) < most:
        i = int(np.argmax(distance))
        chosen.append(i)
        distance = np.minimum(distance, np.sum((points - points[i]) ** 2, axis=1))
    return np.sort(np.array(chosen))
