"""Goals on what the student sets: ``{kind: setting, path: scenario.digital.sample_time, min: 25 ms}``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from ..amounts import in_unit, unit_of
from ..bodies import PATHS
from ..context import Context
from ..kinds import Amount, Member, OneOf, Reading, Record, Unusable
from ..lab import Goal, Outcome
from ..nodes import Node, Scalar
from .goal import SHARED, BaseGoal, Limit, limits_text, require_limits

SETTABLE = tuple(
    path
    for path, (_, known) in PATHS.items()
    if not known.choices and known.kind is not bool and not path.startswith(("parameters.", "limits."))
)
"""Paths of a design body whose values are numbers and may be a student's own."""
SLACK = 1e-9
"""Relative: on the border is met."""


@dataclass(frozen=True)
class SettingGoal(BaseGoal):
    """A number of the design itself within limits: what a cheaper controller or a gentler loop would have.

    Attributes:
        path: of a design body.
        max, min: in `unit`; one of them at least.
        unit: in which limits and value are written.
    """

    kind: ClassVar[str] = "setting"
    path: str = ""
    max: float | None = None
    min: float | None = None
    unit: str = ""

    @property
    def words(self) -> str:
        """What the quantity means."""
        meaning = PATHS[self.path][1].quantity.meaning.partition(";")[0]
        return f"{meaning[:1].upper()}{meaning[1:]}"

    @property
    def required_text(self) -> str:
        """The limits."""
        low = None if self.min is None else self._written(self.min)
        return limits_text(low, None if self.max is None else self._written(self.max))

    def judge(self, context: Context) -> Outcome:
        """Whether the student's own value lies within."""
        raw = context.own.flat.get(self.path)
        if not isinstance(raw, (int, float)) or isinstance(raw, bool):
            return Outcome(False, None, "not set", "This is not set in your design.")
        value = float(raw)
        if self.unit:
            value = in_unit(value, PATHS[self.path][1].quantity.unit, self.unit)
        low = self.min is None or value >= self.min - SLACK * max(1.0, abs(self.min))
        high = self.max is None or value <= self.max + SLACK * max(1.0, abs(self.max))
        return Outcome(low and high, float(raw), self._written(value))

    def told(self) -> dict[str, Any]:
        """Path, limits, and the factor from the body's unit to the one shown."""
        si = PATHS[self.path][1].quantity.unit
        return {
            "path": self.path,
            "unit": self.unit,
            "scale": in_unit(1.0, si, self.unit) if self.unit else 1.0,
            **({"max": self.max} if self.max is not None else {}),
            **({"min": self.min} if self.min is not None else {}),
        }

    def _written(self, value: float) -> str:
        number = f"{value:.6g}".replace("-", "−")
        return number + (self.unit if self.unit == "°" else f" {self.unit}".rstrip())


class SettingRecord(Record[Goal]):
    """The record of such a goal, whose limits have the unit of its quantity."""

    def read(self, node: Node, at: Reading, path: str) -> Goal:
        """The goal; its values are shown in the unit in which its limits are written."""
        raw: dict[str, Any] = super().read(node, at, path)  # pyright: ignore[reportAssignmentType]
        si, bad = PATHS[raw["path"]][1].quantity.unit, False
        raw["unit"] = si
        for side in ("min", "max"):
            if side not in raw:
                continue
            own: Scalar = raw[side]
            written = own.text.lstrip("-+−–0123456789.,eE ") if isinstance(own.value, str) else ""
            try:
                raw[side] = Amount(si).read(own, at, f"{path}.{side}")
            except Unusable:
                bad = True
                continue
            if written and raw["unit"] == si:  # the first unit that is written
                raw["unit"] = unit_of(written) or si
        if bad:
            raise Unusable(path)
        if raw["unit"] and raw["unit"] != si:
            for side in ("min", "max"):
                if side in raw:
                    raw[side] = round(in_unit(raw[side], si, raw["unit"]), 9)
        goal = SettingGoal(**raw)
        require_limits(goal.min, goal.max, at, path)
        return goal


def _raw(**values: Any) -> Any:
    return values


RECORD = SettingRecord(
    _raw,
    (
        Member(
            "path", OneOf(SETTABLE), "of a design body, such as scenario.digital.sample_time", required=True
        ),
        Member("max", Limit("25 ms"), "the largest value that is met, in SI units or with its unit"),
        Member("min", Limit("25 ms"), "the smallest value that is met"),
        *SHARED,
    ),
    "the goal",
)
