"""What a search has found: designs with the figures that `evaluate` tells of them, and why there are none."""

from __future__ import annotations

from dataclasses import dataclass

from ..exclusion import exclusion_text
from ..many import Measure
from ..requirements import Requirement
from ..spec import Spec
from ..tables import NOTHING, Shown, Table, number, poles
from .ask import Find, Free


@dataclass(frozen=True)
class Judged:
    """A requirement of one design.

    Attributes:
        met: whether it is met.
        share: of the uncertain rigs that meet it, 0 to 1; None where none are asked for.
    """

    met: bool
    share: float | None = None


@dataclass(frozen=True, repr=False)
class Candidate(Shown):
    """One design.

    Attributes:
        spec: the design, with rig and experiment.
        values: of the search's measures, as `evaluate` tells them; NaN where there is none, ±∞ where it is unlimited.
        required: each requirement's outcome.
        stable: whether its loop is.
    """

    spec: Spec
    values: tuple[float, ...]
    required: tuple[Judged, ...]
    stable: bool

    @property
    def met(self) -> bool:
        """Whether the loop is stable and all requirements are met."""
        return self.stable and all(own.met for own in self.required)

    def summary(self) -> str:
        """Its poles, and how many requirements it meets."""
        count = sum(own.met for own in self.required)
        return f"poles {poles(self.spec.poles.values)} rad/s; meets {count} of {len(self.required)}"


@dataclass(frozen=True)
class Give:
    """By how much one requirement would have to give, so that the others can be met.

    Attributes:
        requirement: its number.
        value: the best that was found, in the figure's unit; None where nothing met the others.
        others_met: whether all other requirements are met there, or those alone that contradict it.
        spec: the design that has it.
    """

    requirement: int
    value: float | None
    others_met: bool
    spec: Spec | None = None


@dataclass(frozen=True)
class Why:
    """Why no design meets everything, as far as the search has seen.

    Requirements by their numbers.

    Attributes:
        requirements: of those that can be met by themselves the smallest set found that no design tried meets
            together; without any one of them there are designs that meet the others of it. Empty where the others
            than `alone` can be met together.
        gives: what each of `alone` and of these would have to give.
        alone: those that no design tried meets, whatever else is asked.
        excluding: pairs of limits of one figure that exclude one another, whatever the design; then no design was
            tried.
    """

    requirements: tuple[int, ...]
    gives: tuple[Give, ...]
    alone: tuple[int, ...] = ()
    excluding: tuple[tuple[int, int], ...] = ()


@dataclass(frozen=True, repr=False)
class Designs(Shown):
    """The answer of a search.

    Attributes:
        ask: what was asked.
        measures: what is told of each design: what is minimized first.
        candidates: the front, the best in the first figure first; where none meets everything, the nearest misses.
        present: the design that was there.
        tried: how many designs were tried, those of uncertain rigs counted by rig.
        seconds: how long it took.
        stopped: whether the time had run out before all designs were tried: then another run may differ.
        why: where none meets everything.
    """

    ask: Find
    measures: tuple[Measure, ...]
    candidates: tuple[Candidate, ...]
    present: Candidate | None
    tried: int
    seconds: float
    stopped: bool
    why: Why | None

    @property
    def met(self) -> bool:
        """Whether there is a design that meets everything."""
        return any(own.met for own in self.candidates)

    def summary(self) -> str:
        """How many designs, of how many."""
        count = sum(own.met for own in self.candidates)
        if count:
            return f"{count} designs on the front, of {self.tried} tried"
        return f"none of {self.tried} designs meets everything"

    def tables(self) -> tuple[Table, ...]:
        """The designs with their figures; and why there are none."""
        free = self.ask.free
        heads = (*(HEADS[name] for name in free), *(own.words for own in self.measures), "meets")
        rows = []
        for own in self.candidates:
            figures = (measure.written(v) for measure, v in zip(self.measures, own.values, strict=True))
            count = f"{sum(one.met for one in own.required)} of {len(own.required)}"
            rows.append((*(told(own.spec, name) for name in free), *figures, count))
        found = [Table.of("designs" if self.met else "nearest misses", heads, rows)]
        if self.why is not None:
            found += self._gives("out of reach", self.why.alone) + self._gives(
                "these contradict", self.why.requirements
            )
            if self.why.excluding:
                pairs = ([f"{self.ask.require[i].words} {self.ask.require[i].limit_text}" for i in pair]
                         for pair in self.why.excluding)  # fmt: skip
                found.append(Table.of("these exclude one another", ("requirement", "and"), pairs))
        return tuple(found)

    def _gives(self, title: str, which: tuple[int, ...]) -> list[Table]:
        """What some requirements would have to give, where there are any."""
        assert self.why is not None
        rows = []
        for give in self.why.gives:
            if give.requirement in which:
                need = self.ask.require[give.requirement]
                then = "" if give.value is None else consequence(self, give)
                rows.append((need.words, need.limit_text, gives_text(need, give), then))
        return [Table.of(title, ("requirement", "asked", "would have to give", ""), rows)] if rows else []


HEADS: dict[Free, str] = {
    "poles": "poles (rad/s)",
    "rotor_poles": "rotor poles (rad/s)",
    "loops": "k_p, T_i of pitch; yaw",
    "structure": "structure",
    "shift": "shift",
    "pairing": "pairing",
    "decoupler": "decoupler",
    "observer": "observer's poles (rad/s)",
    "weights": "weights: states; inputs; integrals",
}


def told(spec: Spec, name: Free) -> str:
    """What was free of a design, in a cell of a table."""
    outer, structure = spec.outer, spec.structure
    if name == "loops":
        return "; ".join(f"{number(own.kp)}, {number(own.ti)}" for own in (outer.pitch, outer.yaw))
    if name == "weights" and spec.weights is not None:
        own = (spec.weights.states, spec.weights.inputs, spec.weights.integrals)
        return "; ".join(", ".join(map(number, values)) for values in own if values)
    if name == "observer" and spec.observer is not None:
        return poles(spec.observer.poles.values)
    cells: dict[Free, str] = {
        "poles": poles(spec.poles.values),
        "rotor_poles": ", ".join(map(number, spec.rotor_poles)),
        "structure": structure.family.title,
        "shift": number(structure.shift),
        "pairing": outer.pairing,
        "decoupler": "yes" if outer.decoupler else "no",
    }
    return cells.get(name, NOTHING)


def gives_text(need: Requirement, give: Give) -> str:
    """What one requirement would have to become."""
    if give.value is None:
        return "nothing was found"
    if need.share is not None:
        return f"{100 * give.value:.4g} % of the rigs"
    return need.written(give.value)


def consequence(found: Designs, give: Give) -> str:
    """What is met where a requirement gives so much, in words."""
    if give.others_met:
        return "then all others are met"
    alone = found.why is not None and give.requirement in found.why.alone
    return (
        "others are missed there all the same"
        if alone
        else "then those that contradict it are met, not all others"
    )


def why_text(found: Designs) -> str:
    """Which requirements are out of reach by themselves, and which of the others contradict, in words."""
    why, needs = found.why, found.ask.require
    assert why is not None
    if why.excluding:
        return exclusion_text(needs, why.excluding)
    alone, own = (
        [f"{needs[i].words} {needs[i].limit_text}" for i in which] for which in (why.alone, why.requirements)
    )
    told = [
        f"No design of {found.tried} tried meets {one}{'' if len(needs) == 1 else ', whatever else is asked'}."
        for one in alone
    ]
    if own:
        none = "Of the others, none" if alone else f"No design of {found.tried} tried"
        together = f"{', '.join(own[:-1])} and {own[-1]}"
        told.append(f"{none} meets {together} together; without any one of them the others can be met.")
    return " ".join(told)
