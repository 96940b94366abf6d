"""Labs over REST: what is listed, what a student may see, what an attempt is and how it is marked."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StringConstraints, WrapValidator

from .experiment import StepRequest
from .fields import Strict, Whole
from .model import Finding, Model

LARGEST_SEED = 2**53
MOST_ANSWERS = 60
LONGEST_ANSWER = 4000
LONGEST_ANSWERS = 48 * 1024
"""Characters of all answers together: they are kept."""


class Told(BaseModel):
    """A reply's part that the lab's own format describes further (docs/labs.md)."""

    model_config = ConfigDict(extra="allow", allow_inf_nan=False)


def _as_given(value: Any, check: Any) -> Any:
    """The body itself once it is found valid: a lab says what is left out of it."""
    check(value)
    return value


Design = Annotated[StepRequest, WrapValidator(_as_given)]
"""A design and its experiment, as a JSON object; in Python the dictionary that was sent."""


def _not_too_long(answers: dict[str, Any]) -> dict[str, Any]:
    size = sum(len(name) + len(str(answer)) for name, answer in answers.items())
    if size > LONGEST_ANSWERS:
        raise ValueError(f"answers have at most {LONGEST_ANSWERS} characters in all")
    return answers


StepName = Annotated[str, StringConstraints(min_length=1, max_length=40, pattern=r"^[a-z0-9-]+$")]
Answer = (
    Annotated[str, StringConstraints(max_length=LONGEST_ANSWER)]
    | float
    | Annotated[list[float], Field(max_length=20)]
    | None
)
Answers = Annotated[
    dict[Annotated[str, StringConstraints(min_length=1, max_length=40)], Answer],
    AfterValidator(_not_too_long),
    Field(
        max_length=MOST_ANSWERS,
        description="by the question's name: a number, a choice or several (1-based), or text",
    ),
]


FlightGiven = Annotated[
    dict[str, Any],
    Field(max_length=20, description="the log of a flight, where a goal is one; it is marked and not kept"),
]


class MarkRequest(Strict):
    """An attempt at a lab's step without a class."""

    seed: Whole = Field(
        default=0, ge=0, le=LARGEST_SEED, description="of the rig: the same seed, the same rig"
    )
    step: StepName = Field(description="the step's name")
    design: Design = Field(description="as for evaluate")
    answers: Answers = Field(default_factory=dict)
    hints: list[Whole] = Field(
        default_factory=list, max_length=100, description="hints that were taken, 1-based"
    )
    flight: FlightGiven | None = None


class LabSummary(Model):
    """A lab in the list."""

    name: str
    number: float | None = Field(None, description="place in the course")
    title: str
    summary: str = ""
    minutes: float | None = Field(None, description="that it takes, min")
    points: float = Field(description="points there are")
    steps: int = Field(description="number of steps")
    source: str = Field(description="`shipped`, or `own` of who runs the server")


class LabView(Told):
    """A lab as a student may see it: no answers, no solutions, no hint's text that costs points."""

    name: str
    title: str
    steps: list[dict[str, Any]] = Field(description="texts, locks, goals, questions; see docs/labs.md")
    rig: dict[str, Any] | None = Field(None, description="of the seed asked for: part of a design")


class GoalTold(Told):
    """A goal or a question of an attempt, judged."""

    name: str
    met: bool | None = Field(None, description="left out where it is marked by hand")
    points: float = Field(description="points given")
    of: float = Field(description="points there are")


class FlightTold(Model):
    """A flight that was marked: enough to tell later that a log is this one."""

    task: str
    seed: int = Field(description="of its gusts and its noise")
    ticks: int = Field(description="how long it was")
    checksum: str = Field(description="of its log")
    values: dict[str, float | dict[str, float]] = Field(description="figures, some by axis")


class Marked(Told):
    """An attempt, marked."""

    goals: list[GoalTold]
    questions: list[GoalTold]
    points: float = Field(description="points given")
    of: float = Field(description="points there are")
    stable: bool | None = None
    findings: list[Finding] | None = None
    flight: FlightTold | None = Field(None, description="where one was handed in and counts")


class Hint(Told):
    """A hint."""

    hint: int = Field(description="its number, 1-based")
    text: str
    cost: float = Field(description="points that it costs")
