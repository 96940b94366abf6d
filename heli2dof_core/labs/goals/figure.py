"""Goals on a figure of merit: ``{figure: settling_time, axis: theta, max: 0.8 s}``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from ...measured import MEASURED, Axis, Measured, Model, Motor, Steps, Where, stepped, worst
from ..context import Context
from ..kinds import Member, OneOf, Reading, Record, known
from ..lab import Goal, Outcome
from ..nodes import Fields, Node
from .goal import SHARED, BaseGoal, Limit, limits_text, read_limits, require_limits

_UNSTABLE = "The loop is unstable."


@dataclass(frozen=True)
class FigureGoal(BaseGoal):
    """A figure of merit within limits.

    Attributes:
        figure: its name in `measured.MEASURED`.
        axis, motor, model, steps: as in `measured.Where`.
        max, min: in the figure's unit; one of them at least.
    """

    kind: ClassVar[str] = "figure"
    figure: str = ""
    axis: Axis | None = None
    motor: Motor | None = None
    model: Model = "nonlinear"
    steps: Steps = "alone"
    max: float | None = None
    min: float | None = None

    @property
    def measured(self) -> Measured:
        """The figure."""
        return MEASURED[self.figure]

    @property
    def where(self) -> Where:
        """Of which response."""
        return Where(self.axis, self.motor, self.model, self.steps)

    @property
    def words(self) -> str:
        """Figure and response."""
        return self.measured.words(self.where)

    @property
    def required_text(self) -> str:
        """The limits; where a figure's size counts, of both signs."""
        low = None if self.min is None else self.measured.limit_text(self.min)
        high = None if self.max is None else self.measured.limit_text(self.max)
        return f"± {high}" if self.measured.figure.signed and low is None else limits_text(low, high)

    def judge(self, context: Context) -> Outcome:
        """Whether the figure, as it is shown, lies within."""
        own, where = context.own, self.where
        if not own.stable and self.measured.of in ("margins", "sensitivity", "loop"):
            return Outcome(False, None, "unstable", _UNSTABLE)  # these exist of a stable loop alone
        if self.measured.has_axis and self.axis != "both" and self.axis not in stepped(own.report):
            return Outcome(False, None, "not stepped", "This axis is not stepped.")
        values = self.measured.read(own.report, where)
        if not values:
            return Outcome(False, None, "not stepped", "No axis is stepped.")
        value = worst(self.measured, values, self.min, self.max)
        return Outcome(self.measured.meets(value, self.min, self.max), value, self.measured.written(value))

    def told(self) -> dict[str, Any]:
        """Figure, response and limits, in the figure's unit."""
        return {
            "figure": self.figure,
            "of": self.measured.of,
            **({"axis": self.axis} if self.axis else {}),
            **({"motor": self.motor} if self.motor else {}),
            "model": self.model,
            "steps": self.steps,
            **({"max": self.max} if self.max is not None else {}),
            **({"min": self.min} if self.min is not None else {}),
        }


_FIELDS = (
    Member("figure", OneOf(tuple(MEASURED)), "the figure of merit", required=True),
    Member("axis", OneOf(("theta", "psi", "both")), "the axis that is stepped; both: the worse of them"),
    Member("motor", OneOf(("V_p", "V_y", "both")), "the motor; both, the standard: the worse of them"),
    Member("model", OneOf(("nonlinear", "linear")), "of the response; nonlinear where left out"),
    Member(
        "steps",
        OneOf(("alone", "together")),
        "alone, the standard: each axis is stepped by itself; together: the scenario as it is set",
    ),
    Member("max", Limit("0.8 s"), "the largest value that is met, in SI units or with its unit"),
    Member("min", Limit("0.8 s"), "the smallest value that is met"),
)


class FigureRecord(Record[Goal]):
    """The record of a figure's goal, whose limits are read in the unit of its figure."""

    def read(self, node: Node, at: Reading, path: str) -> Goal:
        """The goal."""
        raw: dict[str, Any] = super().read(node, at, path)  # pyright: ignore[reportAssignmentType]
        read_limits(raw, MEASURED[raw["figure"]].figure.unit, at, path)
        goal = FigureGoal(**raw)
        self._judge(goal, at, path, node)
        return goal

    def _judge(self, goal: FigureGoal, at: Reading, path: str, node: Node) -> None:
        own = goal.measured
        require_limits(goal.min, goal.max, at, path)
        if own.has_axis and goal.axis is None:
            at.tell(node, f"{path}.axis", f"{goal.figure} is of an axis, and none is named", known("", _AXES))
        for name, allowed in (
            ("axis", own.may_have_axis),
            ("motor", own.may_have_motor),
            ("model", own.may_have_model),
            ("steps", own.may_have_model),
        ):
            given = isinstance(node, Fields) and name in node.fields
            if given and not allowed:
                at.tell_at(f"{path}.{name}", f"{goal.figure} has no {name}", "Leave it out.")
        if own.of == "step" and goal.steps == "together":
            at.tell_at(f"{path}.steps", f"{goal.figure} is of one axis stepped alone", "Leave `steps` out.")


_AXES = ("theta", "psi", "both")


def _raw(**values: Any) -> Any:
    return values


RECORD = FigureRecord(_raw, (*_FIELDS, *SHARED), "the goal")
