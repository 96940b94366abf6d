"""Goals on a task in the air: ``{kind: flight, task: hold, figure: flight_error_rms, axis: psi, max: 2 °}``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from ...errors import Heli2DofError
from ...figures import FLIGHT
from ...flight.scores import BY_AXIS
from ...flight.tasks import TASKS
from ...measured import AXIS_WORDS, NOT_REACHED, Axis, Measured, worst
from ..context import Context
from ..kinds import Member, Number, OneOf, Reading, Record, known
from ..lab import Goal, Outcome
from ..nodes import Node
from .goal import SHARED, BaseGoal, Limit, limits_text, read_limits, require_limits

Hands = Literal["", "on", "off"]
NOT_FLOWN = "Fly it: the best flight is handed in with your design."
_AXES = ("theta", "psi", "both")
_BY_HAND = {"on": ", by hand", "off": ", hands off", "": ""}
_SLIP = 0.02
"""Share of a flight by hand in which the controller may be on all the same: until the hand is there."""


def _measured(name: str) -> Measured:
    """A flight's figure with the words and the rounding that all figures have; it is read from a score instead."""
    return Measured(name, FLIGHT[name], "design", name, lambda _report, _where: (), none=NOT_REACHED)


MEASURED = {name: _measured(name) for name, figure in FLIGHT.items() if figure.notation != "flag"}
"""The figures of a flight that may be required, by name."""


@dataclass(frozen=True)
class FlightGoal(BaseGoal):
    """A figure of a task that the student has flown, within limits: what counts is the flight that was handed in.

    The server makes the flight again from its log. It has to be of the task, on the student's own rig, and under no
    other design than the one that is handed in with it.

    Attributes:
        task: its name in `flight.tasks.TASKS`.
        figure: its name in the registry's group of flights.
        axis: of a figure that each axis has; both: the worse of them.
        max, min: in the figure's unit; one of them at least.
        hands: on: with the sticks as the motors' voltages, the controller off; off: never so; empty: as one likes.
        changes: allowed: the design may change in the air, as far as the step unlocks it.
        seed: of the task's gusts, the same for all students and flights; None: each flight has its own.
    """

    kind: ClassVar[str] = "flight"
    task: str = ""
    figure: str = ""
    axis: Axis | None = None
    max: float | None = None
    min: float | None = None
    hands: Hands = ""
    changes: Literal["", "allowed"] = ""
    seed: int | None = None

    @property
    def measured(self) -> Measured:
        """The figure."""
        return MEASURED[self.figure]

    @property
    def words(self) -> str:
        """Task, figure and axis: ``Hold still: RMS error, yaw``."""
        term = self.measured.figure.title or self.measured.figure.term
        axis = {None: "", "both": ", both axes"}.get(self.axis, f", {AXIS_WORDS.get(self.axis or '', '')}")
        words = term if term[:2].isupper() else f"{term[:1].lower()}{term[1:]}"
        return f"{TASKS[self.task].title}: {words}{axis}{_BY_HAND[self.hands]}"

    @property
    def required_text(self) -> str:
        """The limits."""
        low = None if self.min is None else self.measured.limit_text(self.min)
        return limits_text(low, None if self.max is None else self.measured.limit_text(self.max))

    def judge(self, context: Context) -> Outcome:
        """Whether the figure of the flight that was handed in lies within; why not, where there is none."""
        flown = context.flown
        if flown is None:
            return Outcome(False, None, "not flown", NOT_FLOWN)
        if isinstance(flown, Heli2DofError):
            return Outcome(False, None, "not counted", _sentences(flown))
        share = flown.score.value("by_hand") or 0.0
        if self.hands == "on" and share < 1 - _SLIP:
            return Outcome(False, None, "not by hand", "The controller was on; fly with hands on throughout.")
        if self.hands == "off" and share > 0:
            return Outcome(
                False, None, "by hand", "The controller was off for a while; leave it on throughout."
            )
        axes = ("theta", "psi") if self.axis == "both" else (self.axis,)
        values = [flown.score.value(self.figure, axis) for axis in axes]
        value = worst(self.measured, values, self.min, self.max)
        return Outcome(self.measured.meets(value, self.min, self.max), value, self.measured.written(value))

    def told(self) -> dict[str, Any]:
        """Task, figure and limits, in the figure's unit; and how it is written, which a page knows of no flight."""
        own = self.measured.figure
        unit = own.shown or own.unit
        after = "" if own.in_head else unit if unit in ("", "°") else f" {unit}"
        return {
            "task": self.task,
            "figure": self.figure,
            "written": {
                "digits": own.digits,
                **({"scale": own.scale} if own.scale != 1.0 else {}),
                **({"after": after} if after else {}),
                **({} if own.notation == "fixed" else {"notation": own.notation}),
            },
            **({"axis": self.axis} if self.axis else {}),
            **({"max": self.max} if self.max is not None else {}),
            **({"min": self.min} if self.min is not None else {}),
            **({"hands": self.hands} if self.hands else {}),
            **({"changes": self.changes} if self.changes else {}),
            **({} if self.seed is None else {"seed": self.seed}),
        }


def _sentences(error: Heli2DofError) -> str:
    words = str(error).rstrip(".")
    return f"{words[:1].upper()}{words[1:]}. {error.hint}".rstrip()


class FlightRecord(Record[Goal]):
    """The record of such a goal, whose limits have the unit of its figure."""

    def read(self, node: Node, at: Reading, path: str) -> Goal:
        """The goal."""
        raw: dict[str, Any] = super().read(node, at, path)  # pyright: ignore[reportAssignmentType]
        read_limits(raw, MEASURED[raw["figure"]].figure.unit, at, path)
        goal = FlightGoal(**raw)
        require_limits(goal.min, goal.max, at, path)
        by_axis = goal.figure in BY_AXIS
        if by_axis and goal.axis is None:
            at.tell(node, f"{path}.axis", f"{goal.figure} is of an axis, and none is named", known("", _AXES))
        if not by_axis and goal.axis is not None:
            at.tell_at(f"{path}.axis", f"{goal.figure} has no axis", "Leave it out.")
        return goal


def _raw(**values: Any) -> Any:
    return values


RECORD = FlightRecord(
    _raw,
    (
        Member("task", OneOf(tuple(TASKS)), "what is flown", required=True),
        Member("figure", OneOf(tuple(MEASURED)), "of the flight", required=True),
        Member("axis", OneOf(_AXES), "of a figure that each axis has; both: the worse of them"),
        Member("max", Limit("2 °"), "the largest value that is met, in SI units or with its unit"),
        Member("min", Limit("2 °"), "the smallest value that is met"),
        Member("hands", OneOf(("on", "off")), "on: with the controller off throughout; off: never so"),
        Member(
            "seed",
            Number(0, 2**32 - 1, whole=True),
            "of the gusts, for all flights; at random where left out",
        ),
        Member("changes", OneOf(("allowed",)), "allowed: the design may be changed in the air"),
        *SHARED,
    ),
    "the goal",
)
