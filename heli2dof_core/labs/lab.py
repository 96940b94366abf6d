"""A lab as frozen values: its steps, and in each what is unlocked, what shall be reached, what is asked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, ClassVar, Protocol

from ..request import Body

FORMAT = 1
"""Version of the file's format."""


@dataclass(frozen=True)
class Outcome:
    """How far a goal or a question is met.

    Attributes:
        met: None where a person has to say so.
        value: in the figure's unit; None where there is none.
        value_text: as people read it.
        message: why it is not met, where the value does not say so.
    """

    met: bool | None
    value: float | None = None
    value_text: str = ""
    message: str = ""


class Goal(Protocol):
    """Something that a design shall reach.

    `kind` is its word in the file, `name` is unique within its step, `label` says it in a few words, and where
    `unstable` holds it may be met by an unstable loop.
    """

    kind: ClassVar[str]

    @property
    def name(self) -> str:
        """Unique within the step."""
        ...

    @property
    def label(self) -> str:
        """What is judged, in words."""
        ...

    @property
    def required_text(self) -> str:
        """What is required, in words: ``≤ 0.80 s``."""
        ...

    @property
    def points(self) -> float:
        """What it is worth."""
        ...

    @property
    def unstable(self) -> bool:
        """Whether an unstable loop may meet it."""
        ...

    def judge(self, context: Any) -> Outcome:
        """Whether the design of a `context.Context` meets it."""
        ...

    def told(self) -> dict[str, Any]:
        """What a page needs to judge it live, beside what all goals have."""
        ...

    def named(self, name: str) -> Goal:
        """The same under another name."""
        ...


class Question(Protocol):
    """Something that is asked, with an answer that a student never sees; `kind` is its word in the file."""

    kind: ClassVar[str]

    @property
    def name(self) -> str:
        """Unique within the step."""
        ...

    @property
    def text(self) -> str:
        """What is asked, Markdown."""
        ...

    @property
    def points(self) -> float:
        """What the right answer is worth."""
        ...

    def judge(self, answer: Any, context: Any) -> Outcome:
        """Whether an answer is right for a `context.Context`; `met` is None where a person has to say so."""
        ...

    def told(self) -> dict[str, Any]:
        """What a page needs to ask it, beside what all questions have; never the answer."""
        ...

    def answered(self) -> dict[str, Any]:
        """The answer, for the instructor."""
        ...


@dataclass(frozen=True)
class Hint:
    """Markdown that helps on, and what it costs in points."""

    text: str
    cost: float = 0.0


@dataclass(frozen=True)
class Step:
    """One step of a lab.

    Attributes:
        name: unique in the lab.
        title, text: heading, and Markdown.
        view: where the page goes.
        start: a part of a design body: over the lab's rig, or over the step before where `continues`.
        continues: whether it goes on with the student's own design of the step before.
        unlocked: names of locks (`locks.LOCKS`); all else is locked.
        hidden: what the page does not tell.
        goals, questions, hints: as they stand in the file.
        solution: a part of a design body over the step's start that reaches every goal; None where there is none.
    """

    name: str
    title: str
    text: str = ""
    view: str = "design"
    start: Body = field(default_factory=dict)
    continues: bool = False
    unlocked: tuple[str, ...] = ()
    hidden: tuple[str, ...] = ()
    goals: tuple[Goal, ...] = ()
    questions: tuple[Question, ...] = ()
    hints: tuple[Hint, ...] = ()
    solution: Body | None = None

    @property
    def points(self) -> float:
        """The most that it gives, questions that a person marks among them."""
        return sum(each.points for each in (*self.goals, *self.questions))


@dataclass(frozen=True)
class Lab:
    """One lab.

    Attributes:
        name: by which it is called; its file's name.
        title, summary: a heading and one sentence.
        preset, rig: the rig on which it is done: a preset, and a part of a design body over it.
        steps: in order.
        vary: per parameter, or per path of a design body, by which share it differs from student to student, ±.
        number: its place in the course; None without one.
        minutes: how long it takes.
        text, end: Markdown before the first step and when all is done.
        instructor: Markdown that no student gets.
        hidden_rig: whether students design on the rig as it is printed, and have to identify their own.
        worn: a part of a design body: how the true rigs differ from the printed one, before they vary.
        alone: whether it may be done without a class.
    """

    name: str
    title: str
    preset: str
    steps: tuple[Step, ...]
    rig: Body = field(default_factory=dict)
    vary: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    summary: str = ""
    number: int | None = None
    minutes: int | None = None
    text: str = ""
    end: str = ""
    instructor: str = ""
    hidden_rig: bool = False
    worn: Body = field(default_factory=dict)
    alone: bool = True

    @property
    def points(self) -> float:
        """The most that it gives."""
        return sum(step.points for step in self.steps)

    def step(self, name: str) -> Step:
        """The step of that name.

        Raises:
            InvalidInputError: there is none.
        """
        from ..checks import require_known

        return require_known(name, {step.name: step for step in self.steps}, "step")

    def before(self, step: Step) -> Step | None:
        """The step before one; None before the first."""
        at = self.steps.index(step)
        return self.steps[at - 1] if at else None
