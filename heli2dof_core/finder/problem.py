"""A search as a function of points: what each design gives, by how much it misses, and how good it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from math import inf, nan

import numpy as np
from numpy.typing import NDArray

from ..errors import Heli2DofError, nobody_leaves
from ..frozen import Frozen
from ..kernels.update_layout import DONE, FOUND_FIGURES, FOUND_OUTCOME, STABLE
from ..many import SHARES, Many, Measure
from ..measured import MEASURED
from ..requirements import Requirement
from ..signals import Floats
from ..spec import Spec
from .ask import Find
from .gains import Gains
from .space import Space
from .uncertain import SEARCHED, OnAll, missed_share

CAP = 20.0
"""The most that one requirement counts: a design far away in one respect is not lost."""
UNSTABLE, ABSENT = 100.0, 1000.0
"""What is missed by an unstable loop, and by a design that does not exist: more than all requirements together."""
_GUIDES = "steady_state_error", "itae"
"""How far a response is from settling, where it does not."""


@dataclass(frozen=True)
class Tried(Frozen):
    """Designs that were tried.

    Attributes:
        points: (n, size).
        values: of the measures, (n, m), as `Many.values`.
        excess: of each requirement, (n, r), at most `CAP`; of those on uncertain rigs 1 where they were not tried.
        missed: their sum, and what an unstable loop misses, (n,); 0 where everything is met.
        goals: of what is to be minimized, (n, k), smaller is better.
        nominal: whether everything is met on the nominal rig, (n,).
        on_rigs: whether a design has been put on uncertain rigs, or need not be, (n,).
    """

    points: Floats
    values: Floats
    excess: Floats
    missed: Floats
    goals: Floats
    nominal: NDArray[np.bool_]
    on_rigs: NDArray[np.bool_]

    @property
    def waiting(self) -> np.ndarray:
        """Whether a design meets everything on the nominal rig, and has not been put on others, (n,)."""
        return self.nominal & ~self.on_rigs

    def __len__(self) -> int:
        return len(self.points)

    def taken(self, which: np.ndarray) -> Tried:
        """Some of them."""
        return Tried(*(getattr(self, own.name)[which] for own in fields(self)))

    @classmethod
    def joined(cls, *parts: Tried) -> Tried:
        """Several, one after the other."""
        return cls(*(np.concatenate([getattr(part, own.name) for part in parts]) for own in fields(cls)))


class Problem:
    """What is asked, of the nominal rig.

    Args:
        spec: the design that is there, with rig and experiment.
        ask: the search.
        threads: that compute, at most.
        check: called now and then; what it raises ends the work.
        open_end: a requirement, by its number, that may be missed: by how much it has to be is what is sought.

    Attributes:
        space: the designs.
        stepped: the axes that are stepped.
        told: what is told of each design: minimized first, then what else is required.
        measures: what is computed of each.
        gains: where their K and L come from.
    """

    def __init__(
        self,
        spec: Spec,
        ask: Find,
        threads: int = 1,
        check: Callable[[], None] = nobody_leaves,
        open_end: int | None = None,
    ) -> None:
        self.ask, self.check, self.threads = ask, check, threads
        self._closed = [i for i in range(len(ask.require)) if i != open_end]
        self.space = Space(spec, ask)
        scenario = spec.scenario
        self.stepped = [axis for axis in ("theta", "psi") if getattr(scenario, axis) is not None]
        self._parts = [need.apart(self.stepped) for need in ask.require]
        self.told = tuple(dict.fromkeys((*ask.minimize, *(need.measure for need in ask.require))))
        wanted = (*ask.minimize, *(need.measure for parts in self._parts for need in parts))
        self.measures = tuple(dict.fromkeys(own for own in wanted if own.name not in SHARES))
        self._column = {own: i for i, own in enumerate(self.measures)}
        more = [Measure(name, own.where) for own in self.measures if _may_lack(own) for name in _GUIDES]
        extra = tuple(dict.fromkeys(own for own in more if own not in self.measures))
        self._guides = {own: len(self.measures) + i for i, own in enumerate(extra)} | self._column
        self.many = Many(spec, (*self.measures, *extra), threads=threads, unstable=False)
        self.on_all = OnAll(spec, ask, threads) if ask.of_rigs is not None else None
        self.gains = Gains(spec, ask, self.space, self.many)

    def rows(self, points: Floats) -> Floats:
        """The designs in numbers, (n, NUMBERS); NaN where one does not exist."""
        rows = self.space.rows(self.gains.row, points)
        for i in np.flatnonzero(self.gains.give(rows, points)).tolist():
            self.check()
            try:
                rows[i] = self.many.numbers_of(self.space.design(points[i]), given=True)
            except Heli2DofError:
                rows[i] = nan
        return rows

    def tried(self, points: Floats) -> Tried:
        """What designs give: (n, size) within 0 … 1."""
        rows = self.rows(points)
        there = ~np.isnan(rows[:, 0])
        every = np.full((len(points), len(self._guides)), nan)
        stable, known = np.zeros(len(points), dtype=bool), np.zeros(len(points), dtype=bool)
        if np.any(there):
            own = points[there]
            found = self.many.run(rows[there], lambda i: self.space.design(own[i]), self.check)
            every[there] = self.many.values(rows[there], found)
            known[there] = found.rows[:, FOUND_OUTCOME] == DONE
            stable[there] = known[there] & (found.rows[:, FOUND_FIGURES + STABLE] != 0.0)
            right = np.full(len(points), nan)
            right[there] = np.max(found.poles.real, axis=1)
        else:
            right = np.full(len(points), nan)
        values = every[:, : len(self.measures)]
        excess = np.zeros((len(points), len(self.ask.require)))
        for i, need in enumerate(self.ask.require):
            if need.measure.name not in SHARES:
                excess[:, i] = np.max([self._missed(one, every) for one in self._parts[i]], axis=0)
        lacking = self._lacking(every)
        nominal = stable & (lacking == 0.0) & np.all(excess[:, self._closed] == 0.0, axis=1)
        for i, need in enumerate(self.ask.require):
            excess[:, i] += float(need.uncertain)
        excess[~stable] = CAP
        missed = excess.sum(axis=1) + lacking
        unstable = UNSTABLE * (1.0 + np.log1p(np.clip(np.nan_to_num(right), 0.0, None)))
        missed = np.where(stable, missed, missed + unstable)
        missed[~known] = ABSENT + missed[~known]
        done = np.full(len(points), self.on_all is None)
        return Tried(points, values, excess, missed, self._goals(every, stable), nominal, done)

    def figures(self, tried: Tried) -> Floats:
        """What is minimized, in the figures' own units, (n, k): NaN where there is none, ±∞ where it is unlimited."""
        found = np.empty((len(tried), len(self.ask.minimize)))
        for k, measure in enumerate(self.ask.minimize):
            share = measure.name in SHARES
            found[:, k] = -tried.goals[:, k] if share else tried.values[:, self._column[measure]]
        return found

    @property
    def cost(self) -> int:
        """How many designs one that is put on uncertain rigs counts as."""
        return 0 if self.on_all is None else min(SEARCHED, self.on_all.rigs)

    def put_on_rigs(self, tried: Tried, which: np.ndarray) -> Tried:
        """The same with some designs, given by their numbers, tried on uncertain rigs, too."""
        if self.on_all is None or not len(which):
            return tried
        points = tried.points[which]
        own = (lambda i: self.space.design(points[i])), self.rows(points)
        met, shares = self.on_all.of(*own, self.cost, self.check)
        excess, goals = tried.excess.copy(), tried.goals.copy()
        at = 0
        for i, need in enumerate(self.ask.require):
            if need.share is not None:
                excess[which, i], at = missed_share(need, met[:, at]), at + 1
            elif need.uncertain:
                share = shares[:, self.on_all.shares.index(need.measure)]
                excess[which, i] = missed_share(need, share)
        for k, measure in enumerate(self.ask.minimize):
            if measure.name in SHARES:
                goals[which, k] = -shares[:, self.on_all.shares.index(measure)]
        missed, done = tried.missed.copy(), tried.on_rigs.copy()
        missed[which], done[which] = excess[which].sum(axis=1), True
        return replace(tried, excess=excess, missed=missed, goals=goals, on_rigs=done)

    def _missed(self, need: Requirement, every: Floats) -> Floats:
        """By how much a requirement is missed on the nominal rig, at most `CAP`."""
        own = need.excess(every[:, self._column[need.measure]])
        lacking = np.isinf(own)
        own = _shrunk(np.where(lacking, 0.0, own))
        if np.any(lacking):
            # what does not happen in time is worse than what happens last of all
            last = float(need.excess(np.array(self.space.spec.scenario.duration)))
            beyond = _shrunk(np.array(last if np.isfinite(last) else 0.0)) + 1.0
            own = np.where(lacking, beyond + self._away(need.measure, every), own)
        return np.minimum(own, CAP)

    def _away(self, measure: Measure, every: Floats) -> Floats:
        """How far responses are from what has no value in them, as settling: 0 near it, at most `CAP`."""
        if not _may_lack(measure):
            return np.full(len(every), CAP)
        error, itae = (every[:, self._guides[Measure(name, measure.where)]] for name in _GUIDES)
        step, duration = self._step(measure), self.space.spec.scenario.duration
        own = np.abs(error) / step + 4.0 * itae / (step * duration**2)
        return np.minimum(np.where(np.isnan(own), CAP, own), CAP)

    def _step(self, measure: Measure) -> float:
        scenario, base = self.space.spec.scenario, (self.space.spec.theta_0, 0.0)
        asked = (scenario.theta, scenario.psi)
        sizes = [
            abs(r - b)
            for r, b, axis in zip(asked, base, ("theta", "psi"), strict=True)
            if r is not None and measure.where.axis in (axis, "both", None)
        ]
        return max((size for size in sizes if size), default=1.0)

    def _lacking(self, every: Floats) -> Floats:
        """How far designs are from having all figures that are to be minimized, (n,): 0 where they do."""
        found = np.zeros(len(every))
        for measure in self.ask.minimize:
            if measure.name not in SHARES:
                none = np.isnan(every[:, self._column[measure]])
                found += np.where(none, np.minimum(1.0 + self._away(measure, every), CAP), 0.0)
        return found

    def _goals(self, every: Floats, stable: np.ndarray) -> Floats:
        """What is to be made small, finite: (n, k)."""
        found = np.empty((len(every), len(self.ask.minimize)))
        for k, measure in enumerate(self.ask.minimize):
            if measure.name in SHARES:
                found[:, k] = 0.0
                continue
            known, value = MEASURED[measure.name], every[:, self._column[measure]]
            better = known.figure.better == "higher"
            size = np.abs(value) if known.figure.signed else value
            own = -size if better else size
            worst = LARGE * (1.0 + self._away(measure, every))
            own = np.where(np.isnan(own) | (own == inf) | ~stable, worst, own)
            # without any limit is as good as can be
            found[:, k] = np.where(own == -inf, -LARGE, own)
        return found


LARGE = 1e6
"""A figure that does not exist counts so much where it is to be small."""


def _may_lack(measure: Measure) -> bool:
    """Whether a stable loop's response may have no such figure."""
    known = MEASURED.get(measure.name)
    return known is not None and known.of == "axis"


def _shrunk(own: Floats) -> Floats:
    """Misses by more than the limit itself, by their logarithm: what is far away in one respect is not lost."""
    return np.where(own > 1.0, 1.0 + np.log(np.maximum(own, 1.0)), own)
