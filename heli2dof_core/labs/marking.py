"""An attempt marked: goal by goal and question by question, by the core's own numbers on the student's own rig."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import asdict, dataclass
from math import isfinite
from typing import Any

from ..errors import InvalidInputError, nobody_leaves
from ..findings import Finding
from ..request import Body
from .context import Context
from .flights import Flown
from .lab import Goal, Lab, Outcome, Question, Step
from .questions import NumberQuestion

UNSTABLE = "The loop is unstable: no step comes to rest, so nothing is reached."


@dataclass(frozen=True)
class Told:
    """What is told of one goal or question.

    Attributes:
        name, label: which.
        met: None where a person marks it.
        value: in the figure's or the question's unit; None where there is none.
        value_text, required_text: as people read them; nothing is required of questions.
        points, of: given, and at most.
        message: why it is not met, where the value does not say so.
    """

    name: str
    label: str
    met: bool | None
    value: float | None
    value_text: str
    required_text: str
    points: float
    of: float
    message: str = ""


@dataclass(frozen=True)
class Marked:
    """An attempt at a step, marked.

    Attributes:
        step: its name.
        goals, questions: in the file's order.
        points, of: given, hints taken off, and at most; what a person marks is in `of` alone.
        by_hand: how many of `of` a person gives.
        cost: of the hints that were taken.
        stable: whether the whole loop is.
        findings: remarks on the design.
        ignored: locked parts in which the design differed from the step's start, which was taken.
        body: the design that was judged: on the student's rig and the step's locks.
        flight: of the flight that was judged its task, seed, ticks, checksum and figures; None where none was.
    """

    step: str
    goals: tuple[Told, ...]
    questions: tuple[Told, ...]
    points: float
    of: float
    by_hand: float
    cost: float
    stable: bool
    findings: tuple[Finding, ...]
    ignored: tuple[str, ...]
    body: Body
    flight: Mapping[str, Any] | None = None

    @property
    def done(self) -> bool:
        """Whether every goal is met and every question answered as far as this can be said."""
        return all(each.met is not False for each in (*self.goals, *self.questions))

    def as_dict(self) -> dict[str, Any]:
        """As JSON; a value that does not exist is left out."""
        found: dict[str, Any] = asdict(self) | {"done": self.done}
        for told in [*found["goals"], *found["questions"]]:
            if told["value"] is None:
                del told["value"]
        found["ignored"] = [*self.ignored]
        if self.flight is None:
            del found["flight"]
        return found


def mark(
    lab: Lab,
    step_name: str,
    rig: Mapping[str, Any],
    body: Mapping[str, Any],
    answers: Mapping[str, Any],
    *,
    hints: Iterable[int] = (),
    check: Callable[[], None] = nobody_leaves,
    seed: int | None = None,
    flight: Mapping[str, Any] | None = None,
) -> Marked:
    """Marks an attempt; nothing of it is believed but the design's free parts and the answers.

    Args:
        lab: the lab.
        step_name: of the step.
        rig: the student's, by `student_rig`.
        body: the design handed in; forced onto the rig and onto the step's locks.
        answers: by question's name: a number or text, for a choice its place from 1 or a list of places.
        hints: numbers, from 1, of the hints that were taken; each costs once.
        check: called now and then in long work; raises where nobody waits any more.
        seed: of the student, for goals on what only the server knows of their rig.
        flight: the log of a flight, for goals on a task in the air.

    Raises:
        Heli2DofError: there is no such step or hint, or the body is no design.
    """
    step = lab.step(step_name)
    context = Context(lab, step, rig, dict(body), check, seed, flight)
    own, ignored = context.own, context.forced[1]
    goals = tuple(_goal(goal, context) for goal in step.goals)
    questions = tuple(_question(question, answers.get(question.name), context) for question in step.questions)
    cost = _cost(step, {*hints})
    found = sum(told.points for told in (*goals, *questions))
    by_hand = sum(question.points for question in step.questions if question.kind == "text")
    return Marked(
        step.name,
        goals,
        questions,
        max(0.0, found - cost),
        step.points,
        by_hand,
        cost,
        own.stable,
        () if own.failure is not None else own.report.findings,
        ignored,
        own.body,
        context.flown.told if goals and isinstance(context.flown, Flown) else None,
    )


def right_answers(
    lab: Lab,
    step_name: str,
    rig: Mapping[str, Any],
    body: Mapping[str, Any],
    *,
    check: Callable[[], None] = nobody_leaves,
    seed: int | None = None,
) -> dict[str, dict[str, Any]]:
    """By question's name what would be right on a student's rig, for the instructor: never for a student.

    Returns:
        of a number ``value``, left out where there is none, and ``unit``; what `Question.answered` says of all.
    """
    context = Context(lab, lab.step(step_name), rig, dict(body), check, seed)
    found = {}
    for question in context.step.questions:
        found[question.name] = question.answered()
        if isinstance(question, NumberQuestion):
            value = question.right(context)
            found[question.name] |= {"unit": question.unit} | ({} if value is None else {"value": value})
    return found


def _goal(goal: Goal, context: Context) -> Told:
    own = context.own
    if own.failure is not None:
        outcome = Outcome(False, None, "no design", str(own.failure))
    elif not own.stable and not goal.unstable:
        outcome = Outcome(False, None, "unstable", UNSTABLE)
    else:
        outcome = goal.judge(context)
    return _told(goal.name, goal.label, goal.required_text, goal.points, outcome)


def _question(question: Question, answer: Any, context: Context) -> Told:
    return _told(question.name, question.text, "", question.points, question.judge(answer, context))


def _told(name: str, label: str, required: str, of: float, outcome: Outcome) -> Told:
    points = of if outcome.met else 0.0
    value = outcome.value if outcome.value is not None and isfinite(outcome.value) else None
    return Told(name, label, outcome.met, value, outcome.value_text, required, points, of, outcome.message)


def _cost(step: Step, hints: Collection[int]) -> float:
    for n in hints:
        if not 1 <= n <= len(step.hints):
            raise InvalidInputError(
                f"there is no hint {n}", field="hints", value=n, hint=f"There are {len(step.hints)}."
            )
    return sum(step.hints[n - 1].cost for n in hints)
