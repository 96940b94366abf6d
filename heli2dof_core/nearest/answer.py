"""The nearest designs that meet all that is required: each handle alone, poles, loops, and all that is free."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..checks import require_within
from ..errors import Heli2DofError
from ..evaluate import Report, evaluate
from ..exclusion import excluding, exclusion_text
from ..measured import worst
from ..requirements import Requirement, requirements_of
from ..spec import Spec
from ..tables import NOTHING, Shown, Table, conjugates, number
from .handles import GROUPS, HANDLES, Chart, Handle, charts, distance, handles_of, moved
from .judge import Judge
from .search import Best, Effort, search
from .tidy import tidied

WITHIN = 1.5
"""How far is near: poles move by as much of their distance from the origin, gains by a factor of 4.5."""
CLOSEST, FARTHEST = 1e-2, 5.0
"""How far one may look."""
AS_NEAR = 1.02
"""A move of fewer handles is preferred where it is farther by no more."""
_WORDS: dict[str, str] = {
    "pitch-pair": "pitch poles",
    "yaw-pair": "yaw poles",
    "pitch-pi": "pitch PI",
    "yaw-pi": "yaw PI",
}
_EFFORT = {2: Effort(96, 2, 7, 8, 16), 4: Effort(192, 3, 9, 10, 24), 8: Effort(192, 4, 12, 12, 32)}
"""By the number of coordinates, at most."""


@dataclass(frozen=True, repr=False)
class Move(Shown):
    """A design near another.

    Attributes:
        before: the design that it moves away from.
        spec: where it moves to.
        handles: what moves.
        distance: how far: poles as shares of their distance from the origin, gains by logarithms, all together as
            the root of the squares' sum.
        values: of each requirement the value that it is judged by, in the figure's unit; None where there is none.
        shown: these as they are shown.
        meets: whether each is met.
    """

    before: Spec
    spec: Spec
    handles: tuple[Handle, ...]
    distance: float
    values: tuple[float | None, ...]
    shown: tuple[str, ...]
    meets: tuple[bool, ...]

    @property
    def words(self) -> str:
        """What moves where: ``pitch poles to −13 ± 2j; yaw PI to kp 32 V/rad, ti 0.1 s``."""
        return "; ".join(f"{_WORDS[name]} to {_place(self.spec, name)}" for name in self.handles)

    def summary(self) -> str:
        """How far, and what moves."""
        return f"{100 * self.distance:.3g} % away: {self.words or 'nothing moves'}"


@dataclass(frozen=True, repr=False)
class Nearest(Shown):
    """What would have to move.

    Attributes:
        spec: the design.
        requirements: what is required of it.
        free: the handles that may move.
        now: the design as it is; no move.
        moves: that meet all, each proved by `evaluate`, the nearest first: of all that is free, and of less alone
            where that is enough. None where none is near, or where the design meets all already.
        closest: where no design near meets all, the one that misses the least.
        out_of_reach: positions of requirements that no design near has met.
        within: how far was looked.
        tried: designs that were looked at.
        excluding: pairs of requirements, by position, whose limits exclude one another; then no design was looked at.
    """

    spec: Spec
    requirements: tuple[Requirement, ...]
    free: tuple[Handle, ...]
    now: Move
    moves: tuple[Move, ...]
    closest: Move | None
    out_of_reach: tuple[int, ...]
    within: float
    tried: int
    excluding: tuple[tuple[int, int], ...] = ()

    @property
    def met(self) -> bool:
        """Whether the design meets all as it is."""
        return not self.moves and self.closest is None and not self.excluding

    @property
    def missed(self) -> str:
        """What the closest design misses, in words, all of it; empty where there is none that is told."""
        if self.closest is None:
            return ""
        each = zip(self.requirements, self.closest.shown, self.closest.meets, strict=True)
        return "; ".join(
            f"{own.words} {shown} in place of {own.limit_text}" for own, shown, met in each if not met
        )

    def summary(self) -> str:
        """The nearest move, or that there is none."""
        if self.met:
            return "met as it is"
        if self.excluding:
            return exclusion_text(self.requirements, self.excluding)
        if self.moves:
            return self.moves[0].summary()
        if not self.requirements:
            return "no design near is stable"
        if self.out_of_reach:
            out = "; ".join(
                f"{self.requirements[i].words} {self.requirements[i].limit_text}" for i in self.out_of_reach
            )
            told = f"no design near meets all; out of reach: {out}"
        else:
            told = "no design near meets all at once, though each requirement alone can be met"
        if self.closest is None:
            return told
        return f"{told}; the closest, {100 * self.closest.distance:.3g} % away, misses: {self.missed}"

    def tables(self) -> tuple[Table, ...]:
        """What is required and what each move gives; what moves where."""
        others = self.moves or ((self.closest,) if self.closest else ())
        heads = ("requirement", "limit", "now", *(f"{i + 1}" for i in range(len(others))))
        rows = (
            (own.words, own.limit_text, self.now.shown[i], *(move.shown[i] for move in others))
            for i, own in enumerate(self.requirements)
        )
        places = (
            (f"{i + 1}", f"{100 * move.distance:.3g} %", move.words or NOTHING)
            for i, move in enumerate(others)
        )
        title = "moves that meet all" if self.moves else "the closest"
        moves = (Table.of(title, ("", "distance", "what moves"), places),) if others else ()
        return (Table.of("requirements", heads, rows), *moves)


def nearest(
    spec: Spec,
    requirements: Mapping[str, Any] | Sequence[Requirement],
    free: Sequence[str] = ("poles", "loops"),
    *,
    within: float = WITHIN,
    threads: int = 1,
    check: Callable[[], None] = lambda: None,
) -> Nearest:
    """The smallest moves with which a design would meet what is required of it, and be stable.

    >>> spec = Spec.from_preset()
    >>> found = nearest(spec, {"settling_time": {"max": 0.8}}, free=["yaw-pi"])
    >>> found.moves[0].words
    'yaw PI to kp 30.48 V/rad, ti 0.098 s'

    The search is heuristic, as figures jump and have kinks: tests compare it with grids. The same task has the same
    answer.

    Args:
        spec: a design and its experiment.
        requirements: on nominal figures, also as `requirements_of` takes them; the design may meet some of them
            already, and shall go on to.
        free: ``poles``, ``loops``, or a handle each: ``pitch-pair``, ``yaw-pair`` (with the rotor's pole where it is
            placed), ``pitch-pi``, ``yaw-pi``. What moves nothing in this design is left out.
        within: how far is near, as `Move.distance`.
        threads: that compute, at most.
        check: called after every few designs; what it raises ends the work.

    Raises:
        InvalidInputError: a requirement cannot be judged of this experiment, or nothing is free.
        Heli2DofError: the design does not exist.
    """
    require_within(within, "within", "", CLOSEST, FARTHEST)
    handles = handles_of(spec, free)
    requirements = requirements_of(requirements) if isinstance(requirements, Mapping) else tuple(requirements)
    judge = Judge(spec, requirements, within, threads, check)
    now = _proved(spec, spec, requirements)
    if pairs := excluding(requirements, judge.stepped):  # which no move can mend
        return Nearest(spec, requirements, handles, now, (), None, (), within, judge.tried, pairs)
    if bool(judge(judge.many.row[np.newaxis], np.zeros(1)).met[0]):
        return Nearest(spec, requirements, handles, now, (), None, (), within, judge.tried)
    found: list[Best] = []
    for group in _groups(handles):
        own = charts(spec, group)
        if not own or not len(own[0].center):
            continue
        effort = _EFFORT[next((n for n in sorted(_EFFORT) if len(own[0].center) <= n), max(_EFFORT))]
        placed_outside = judge.places_outside and any(name in GROUPS["poles"] for name in group)
        if placed_outside or spec.scenario.controller is not None:
            effort = effort.less
        best = search(judge, own, within, effort, _known(own, found))
        if best.chart is not None:
            tidied(judge, best, within)
            found.append(best)
    moves = _sparse([move for best in found if (move := _move(judge, best, requirements)) is not None])
    if moves:
        return Nearest(spec, requirements, handles, now, moves, None, (), within, judge.tried)
    out = [i for i, least in enumerate(judge.least) if least > 0.0]
    closest = _proved(spec, judge.spec_of(judge.closest), requirements)
    return Nearest(spec, requirements, handles, now, (), closest, tuple(out), within, judge.tried)


def _groups(handles: Sequence[Handle]) -> list[tuple[Handle, ...]]:
    """What is tried, each alone first: what is found of fewer handles begins the search of more."""
    groups: list[tuple[Handle, ...]] = [(name,) for name in handles]
    for together in (GROUPS["poles"], GROUPS["loops"], HANDLES):
        own: tuple[Handle, ...] = tuple(name for name in together if name in handles)
        if own and own not in groups:
            groups.append(own)
    return groups


def _known(own: Sequence[Chart], found: Sequence[Best]) -> list[tuple[Chart, np.ndarray]]:
    """What was found before, in the coordinates of other charts."""
    rows = [best.row for best in found if best.row is not None]
    return [(chart, chart.coordinates(chart.read(row))) for row in rows for chart in own]


def _move(judge: Judge, best: Best, requirements: Sequence[Requirement]) -> Move | None:
    """The best as a move, where `evaluate` proves it."""
    assert best.row is not None
    try:
        move = _proved(judge.spec, judge.spec_of(best.row), requirements)
    except Heli2DofError:
        return None
    return move if all(move.meets) else None


def _proved(before: Spec, spec: Spec, requirements: Sequence[Requirement]) -> Move:
    """A design with its figures at full accuracy."""
    report = evaluate(spec, each_axis=True)
    values = tuple(_value(report, own) for own in requirements)
    meets = tuple(
        report.judged.stable and own.meets(value) for own, value in zip(requirements, values, strict=True)
    )
    shown = tuple(own.written(value) for own, value in zip(requirements, values, strict=True))
    return Move(before, spec, moved(before, spec), distance(before, spec), values, shown, meets)


def _value(report: Report, requirement: Requirement) -> float | None:
    known = requirement.measured
    assert known is not None
    values = known.read(report, requirement.measure.where)
    return worst(known, values, requirement.min, requirement.max)


def _sparse(moves: Sequence[Move]) -> tuple[Move, ...]:
    """Nearest first, without those that move more than another and are hardly nearer."""
    kept: list[Move] = []
    for move in sorted(moves, key=lambda own: (len(own.handles), own.distance)):
        if not any(
            set(other.handles) <= set(move.handles) and other.distance <= AS_NEAR * move.distance
            for other in kept
        ):
            kept.append(move)
    return tuple(sorted(kept, key=lambda own: own.distance))


def _place(spec: Spec, name: Handle) -> str:
    axis = int(name.startswith("yaw"))
    if name in GROUPS["loops"]:
        own = (spec.outer.pitch, spec.outer.yaw)[axis]
        return f"kp {number(own.kp)} V/rad, ti {number(own.ti)} s"
    p, q = spec.poles.values[2 * axis : 2 * axis + 2]
    words = conjugates(p) if p.imag else f"{number(p)}, {number(q)}"
    return f"{words}, rotor {number(spec.rotor_poles[axis])}" if spec.place_rotors else words
