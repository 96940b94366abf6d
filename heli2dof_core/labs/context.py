"""What goals and questions are judged by: the student's design on the student's rig, computed once, by the core."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

from ..errors import Heli2DofError, InvalidInputError, nobody_leaves
from ..evaluate import Report, evaluate
from ..lazily import computed
from ..request import Body, spec_of
from ..spec import Spec
from .bodies import Flat, body_of_flat, flat_body
from .flights import Flown, flown_again
from .flown import fly
from .lab import Lab, Step
from .rigs import free_paths, handed_in, solution_flat, start_flat, true_rig

Which = Literal["own", "start", "solution", "rig"]
SAMPLES = 501
"""Of a response that is judged: no figure depends on them but a linear model's voltages."""


class Evaluated:
    """One design and its numbers.

    Attributes:
        flat, body: the design.
        spec: what it says, with as many samples as are needed to judge it.
        rig: the rig on which it is judged, where that is another than the one that it is designed for.
    """

    def __init__(self, flat: Flat, rig: Flat | None = None) -> None:
        self.flat, self.body = flat, body_of_flat(flat)
        self.rig = None if rig is None else spec_of(body_of_flat(rig))
        spec = spec_of(self.body)
        self.spec: Spec = replace(spec, scenario=replace(spec.scenario, samples=SAMPLES))

    @computed
    def report(self) -> Report:
        """Of the scenario, and of each axis alone.

        Raises:
            Heli2DofError: there is no such design.
        """
        return evaluate(self.spec, each_axis=True) if self.rig is None else fly(self.spec, self.rig)

    @computed
    def failure(self) -> Heli2DofError | None:
        """Why there is no such design; None where there is one."""
        try:
            _ = self.report
        except Heli2DofError as error:
            return error
        return None

    @property
    def stable(self) -> bool:
        """Whether the whole loop is."""
        return self.failure is None and self.report.judged.stable


@dataclass(frozen=True)
class Context:
    """One attempt at a step.

    Attributes:
        lab, step: which.
        rig: the student's, a part of a design body.
        given: the design as handed in.
        check: called now and then in long work; raises where nobody waits any more.
        seed: of the student; None where nobody said it.
        flight: the log of the flight that is handed in with it; None without one.
    """

    lab: Lab
    step: Step
    rig: Mapping[str, Any]
    given: Body
    check: Callable[[], None] = nobody_leaves
    seed: int | None = None
    flight: Mapping[str, Any] | None = None

    @computed
    def flown(self) -> Flown | Heli2DofError | None:
        """The flight that was handed in, made again, once for all goals; or why it does not count.

        None where there is none, or the step asks for none.
        """
        if self.flight is None:
            return None
        of = next((goal.told() for goal in self.step.goals if goal.kind == "flight"), None)
        if of is None:
            return None
        free = free_paths(self.lab, self.step) if of.get("changes") else []
        try:
            return flown_again(
                self.flight, of["task"], self.forced[0], free, seed=of.get("seed"), wanted=self.check
            )
        except Heli2DofError as error:
            return error

    @computed
    def forced(self) -> tuple[Flat, tuple[str, ...]]:
        """The design with what is locked taken from the start, and the locked parts that differed."""
        return handed_in(self.lab, self.step, self.rig, self.given)

    @computed
    def own(self) -> Evaluated:
        """The student's design; where the lab hides the true rig, flown on that."""
        return Evaluated(self.forced[0], self.true_rig if self.lab.hidden_rig else None)

    @computed
    def start(self) -> Evaluated:
        """The design with which the step starts."""
        return Evaluated(start_flat(self.lab, self.step, self.rig))

    @computed
    def solution(self) -> Evaluated | None:
        """The reference solution on this rig; None where there is none."""
        flat = solution_flat(self.lab, self.step, self.rig, self.seed)
        return None if flat is None else Evaluated(flat, self.true_rig if self.lab.hidden_rig else None)

    @computed
    def true_rig(self) -> Flat:
        """The student's true rig, with the preset's own design on it: `rig`, unless the lab hides it.

        Raises:
            InvalidInputError: the lab hides it, and nobody said whose it is.
        """
        if not self.lab.hidden_rig:
            return flat_body(self.rig)
        if self.seed is None:
            raise InvalidInputError(
                "the rig of no student is meant", field="seed", hint="Give the student's seed."
            )
        return flat_body(true_rig(self.lab, self.seed))

    def of(self, which: Which) -> Evaluated | None:
        """One of these designs."""
        return {
            "own": lambda: self.own,
            "start": lambda: self.start,
            "solution": lambda: self.solution,
            "rig": lambda: Evaluated(self.true_rig),
        }[which]()
