"""Classes over REST: what instructors and students ask, and what they are told."""

from __future__ import annotations

import re
import unicodedata
from datetime import UTC, datetime
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, StringConstraints

from ..classes.handed import Draft, Handed
from .fields import Strict, Whole
from .labs import Answers, Design, FlightGiven, LabView, Marked, StepName, Told
from .model import Complex, Model

LONGEST_NAME = 80
LONGEST_TITLE = 120
LONGEST_COMMENT = 2000
LARGEST_ID = 2**31 - 1
LARGEST_SEQ = 2**53
_REFUSED = frozenset(("Cc", "Cs", "Zl", "Zp", "Co", "Cn"))
_DIRECTIONS = frozenset("\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\u200e\u200f\u061c")
"""Signs that turn the direction of what follows: a name could put on another one's clothes."""
_FORMATTING = frozenset("\u00ad\u200b\u2060\ufeff")


def _line(text: str) -> str:
    """A line that a person has typed, without what is not seen."""
    if any(unicodedata.category(sign) in _REFUSED or sign in _DIRECTIONS for sign in text):
        raise ValueError("it holds signs that cannot be seen: control characters, or halves of others")
    line = " ".join(unicodedata.normalize("NFC", text).split())
    if not line.strip("".join(_FORMATTING) + " "):
        raise ValueError("it is empty")
    return line


def _lines(text: str) -> str:
    """Several such lines."""
    if any(unicodedata.category(sign) in ("Cc", "Cs") and sign not in "\n\r\t" for sign in text):
        raise ValueError("it holds control characters, or halves of signs")
    return text.replace("\r\n", "\n").replace("\r", "\n").strip()


def _time(value: Any) -> Any:
    """ISO 8601 with its time zone, as seconds since 1970."""
    if not isinstance(value, str) or not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d.{0,40}", value):
        raise ValueError("a time is ISO 8601 with its time zone, as 2027-01-31T16:00:00Z")
    try:
        moment = datetime.fromisoformat(value)
        if moment.tzinfo is None:
            raise ValueError
        return moment.astimezone(UTC).timestamp()
    except (ValueError, OverflowError):
        raise ValueError("a time is ISO 8601 with its time zone, as 2027-01-31T16:00:00Z") from None


_ISO = {"type": "string", "format": "date-time", "pattern": r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z$"}
Time = Annotated[
    float,
    BeforeValidator(_time, json_schema_input_type=str),
    Field(json_schema_extra={"format": "date-time"}),
]
"""A moment; in Python seconds since 1970."""
Name = Annotated[str, StringConstraints(min_length=1, max_length=LONGEST_NAME), AfterValidator(_line)]
Title = Annotated[str, StringConstraints(min_length=1, max_length=LONGEST_TITLE), AfterValidator(_line)]
Email = Annotated[
    str,
    StringConstraints(min_length=3, max_length=254, pattern=r"^[^@\s]+@[^@\s]+$"),
    AfterValidator(_line),
]
Secret = Annotated[str, StringConstraints(min_length=16, max_length=128, pattern=r"^[A-Za-z0-9_-]+$")]
Id = Annotated[
    str,
    StringConstraints(pattern=r"^[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}$"),
    Field(description="a random UUID that the page makes: what comes twice counts once"),
]


class ClassRequest(Strict):
    """A new class."""

    lab: StepName = Field(description="the lab's name")
    title: Title = Field(description="as students see it")
    closes: Time | None = Field(default=None, description="when it closes by itself")


class JoinClassRequest(Strict):
    """Somebody joins by their name, or comes back by their secret."""

    student: Secret | None = Field(default=None, description="of who comes back; all else is left out then")
    name: Name | None = Field(default=None, description="as the instructor knows you")
    email: Email | None = Field(default=None, description="for the grade book")
    login: Name | None = Field(default=None, description="for the grade book")
    id: Id | None = None


class AttemptRequest(Strict):
    """An attempt at a step."""

    student: Secret
    id: Id
    step: StepName = Field(description="the step's name")
    design: Design = Field(description="as for evaluate")
    answers: Answers = Field(default_factory=dict)
    flight: FlightGiven | None = None
    at: Time | None = Field(default=None, description="by the page's clock, of an attempt made offline")

    def to_handed(self) -> Handed:
        """The attempt as it is marked and kept."""
        design: Any = self.design
        return Handed(self.id, self.step, design, self.answers, self.at, self.flight)


class DraftRequest(Strict):
    """Where a student is."""

    student: Secret
    step: StepName = Field(description="the step's name")
    design: Design = Field(description="as for evaluate")
    answers: Answers = Field(default_factory=dict)
    seq: Whole = Field(
        ge=0, le=LARGEST_SEQ, description="of the page: an older draft than the one kept is dropped"
    )

    def to_draft(self) -> Draft:
        """The draft as it is kept."""
        design: Any = self.design
        return Draft(self.step, self.seq, design, self.answers)


class HintRequest(Strict):
    """A hint that a student takes."""

    student: Secret
    step: StepName = Field(description="the step's name")
    hint: Whole = Field(ge=1, le=100, description="its number, 1-based")


class HandMark(Strict):
    """An instructor's mark of an answer in words."""

    step: StepName = Field(description="the step's name")
    question: Annotated[str, StringConstraints(min_length=1, max_length=40)]
    points: float = Field(ge=0, le=1000, description="points given")
    comment: Annotated[str, StringConstraints(max_length=LONGEST_COMMENT), AfterValidator(_lines)] = ""


class ClassChanges(Strict):
    """What an instructor changes; what is left out stays."""

    title: Title | None = None
    open: bool | None = None
    closes: Time | None = Field(default=None, description="null: it does not close by itself")


class NewClassReply(Model):
    """A class that was made; its secret is told this once."""

    code: str = Field(description="for the board")
    instructor: str = Field(description="the instructor's secret")
    student_link: str = Field(description="fragment of the page's address, for students")
    instructor_link: str = Field(description="address of the wall, relative to the page's; holds the secret")
    ends: str = Field(description="when it is deleted with all that is in it")


class LabOfClass(Model):
    """Which lab a class works on."""

    name: str
    number: float | None = Field(None, description="place in the course")
    title: str


class ClassAbout(Model):
    """What anyone is told who has the code. Times are ISO 8601, UTC."""

    code: str
    title: str
    lab: LabOfClass
    minutes: float | None = Field(None, description="that the lab takes, min")
    student_link: str
    open: bool = Field(description="whether attempts are taken")
    closes: str | None = Field(None, description="when it closes by itself")
    closed_at: str | None = Field(None, description="since when it is closed")
    ends: str = Field(description="when it is deleted")
    at: str = Field(description="the server's time")


class ClassHead(ClassAbout):
    """The class itself."""

    points: float = Field(description="points there are")
    created: str
    version: int = Field(description="raised by every change")


class HandMarked(Model):
    """A hand mark, as it is kept."""

    question: str
    points: float = Field(description="points given")
    comment: str
    at: str


class Best(Marked):
    """The best attempt at a step."""

    answers: dict[str, Any] | None = Field(None, description="to which the verdict was given")


class StepKept(Told):
    """What is kept of a student's step."""

    attempts: int = Field(description="how many there were")
    hints: list[int] = Field(description="those that were taken, 1-based")
    hand: list[HandMarked]
    design: dict[str, Any] | None = Field(None, description="of the newest draft or attempt")
    answers: dict[str, Any] | None = None
    at: str | None = None
    seq: int | None = Field(None, description="of the newest draft")
    best: Best | None = None


class Person(Told):
    """A student."""

    id: int = Field(description="within this server")
    number: int = Field(description="by order of joining")
    name: str
    email: str | None = None
    login: str | None = None
    joined: str
    last_seen: str
    at: str = Field(description="the server's time")


class AtPlatform(Model):
    """What is kept of a student who came by a learning platform (LTI)."""

    name: str = Field(description="the platform, as it is registered here")
    subject: str = Field(description="the student, as the platform calls them")
    points: float | None = Field(None, description="that go there; left out before the first attempt")
    sent: bool | None = Field(None, description="whether they are there")


class Mine(Person):
    """Everything that is kept of a student."""

    code: str
    title: str
    open: bool
    closes: str | None = None
    closed_at: str | None = None
    ends: str
    steps: dict[str, StepKept]
    platform: AtPlatform | None = None


class Joined(Mine):
    """Where a student begins, or left off."""

    student: str = Field(description="the student's secret")
    rig: dict[str, Any] = Field(description="their own rig: part of a design")
    lab: LabView


class AttemptReply(Marked):
    """An attempt, marked and kept."""

    id: str
    step: str
    at: str = Field(description="the server's time")
    handed_at: str | None = Field(None, description="the page's")
    best: Best


class StepTold(Told):
    """A student's step on the wall."""

    points: float = Field(description="points given, by hand too")
    of: float = Field(description="points there are")
    goals: list[bool | None] = Field(description="of the best attempt")
    last: list[bool | None] | None = Field(None, description="of the newest one")
    attempts: int = Field(description="how many")
    hints: int = Field(description="how many were taken")
    to_mark: int = Field(description="answers in words that nobody has marked")


class StudentRow(Told):
    """A student on the wall."""

    id: int = Field(description="within this server")
    number: int = Field(description="by order of joining")
    name: str
    email: str | None = None
    login: str | None = None
    step: str | None = Field(None, description="where they are")
    points: float = Field(description="points given")
    of: float = Field(description="points there are")
    joined: str
    last_seen: str
    online: bool
    stable: bool | None = None
    poles: list[Complex] | None = None
    steps: dict[str, StepTold]


class HeldUp(Model):
    """A goal that holds students up."""

    step: str
    goal: str
    students: int = Field(description="who are there or have tried")
    tried: int = Field(description="who have tried")
    met: int = Field(description="of these, who meet it")


class GoalHead(Model):
    """A goal, as the head of a column."""

    name: str
    label: str | None = None
    required_text: str | None = None
    points: float = Field(description="points there are")


class QuestionHead(Model):
    """A question, as the head of a column."""

    name: str
    kind: str
    text: str
    points: float = Field(description="points there are")
    by_hand: bool


class StepHead(Model):
    """A step, as the head of columns."""

    name: str
    title: str
    points: float = Field(description="points there are")
    goals: list[GoalHead]
    questions: list[QuestionHead]


class ClassReply(ClassHead):
    """The whole class."""

    steps: list[StepHead]
    students: list[StudentRow]
    held_up: list[HeldUp] = Field(description="the goals that hold most students up, the worst first")


class StudentReply(Person):
    """Everything of one student, for the instructor."""

    points: float = Field(description="points given")
    of: float = Field(description="points there are")
    steps: dict[str, Told]


class ClassExport(ClassHead):
    """All of a class, to be taken out."""

    lab_text: str
    students: list[dict[str, Any]]


class NewLink(Model):
    """A student's new personal link; the old one has ended."""

    student: str = Field(description="the new secret")
    link: str = Field(description="fragment of the page's address")


class NewInstructorLink(Model):
    """The instructor's new link; the old one has ended."""

    instructor: str = Field(description="the new secret")
    instructor_link: str = Field(description="address of the wall, relative to the page's")
