"""What the kinds of goals share: their fields in the file, and limits."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

from ..context import Context
from ..kinds import Amount, Member, Name, Number, OneOf, Reading, Schema, Text, Unusable
from ..lab import Outcome
from ..nodes import Node, Scalar

MOST_POINTS = 1000


@dataclass(frozen=True)
class BaseGoal:
    """Base of a goal: see `lab.Goal`."""

    kind: ClassVar[str]
    name: str = ""
    own_label: str = ""
    points: float = 1.0
    allowed: str = ""

    @property
    def label(self) -> str:
        """The file's own words, or those of the kind."""
        return self.own_label or self.words

    @property
    def words(self) -> str:
        """What is judged."""
        raise NotImplementedError

    @property
    def required_text(self) -> str:
        """What is required."""
        raise NotImplementedError

    @property
    def unstable(self) -> bool:
        """Whether an unstable loop may meet it."""
        return self.allowed == "allowed"

    def judge(self, context: Context) -> Outcome:
        """Whether the design meets it; the loop is stable, or may be unstable."""
        raise NotImplementedError

    def told(self) -> dict[str, Any]:
        """What a page needs to judge it live."""
        raise NotImplementedError

    def named(self, name: str) -> Self:
        """The same under another name."""
        return replace(self, name=name)


SHARED = (
    Member("name", Name(60), "its name within the step, in results; made from what is judged where left out"),
    Member("label", Text(200), "its own words in place of the usual ones", attribute="own_label"),
    Member("points", Number(0, MOST_POINTS), "what it is worth, 1 where left out"),
    Member(
        "unstable", OneOf(("allowed",)), "allowed: an unstable loop may meet it, too", attribute="allowed"
    ),
)


def limits_text(low: str | None, high: str | None) -> str:
    """Limits in words: ``≤ 0.80 s``, ``≥ 45°``, ``0.20 s to 0.40 s``."""
    if low is not None and high is not None:
        return f"{low} to {high}"
    return f"≤ {high}" if high is not None else f"≥ {low}"


def require_limits(low: float | None, high: float | None, at: Reading, path: str) -> None:
    """Tells where limits are missing or crossed."""
    if low is None and high is None:
        at.tell_at(path, "the goal has neither max nor min", "Give one of them, or both.")
    elif low is not None and high is not None and low > high:
        at.tell_at(f"{path}.min", "min is above max", "Exchange them.")


class Limit:
    """A limit whose unit depends on another member: read as it stands, and understood by the record.

    Args:
        example: of a limit, for messages.
    """

    def __init__(self, example: str) -> None:
        self._example = example

    def read(self, node: Node, at: Reading, path: str) -> Node:
        """The node itself."""
        if not isinstance(node, Scalar):
            raise at.refuse(
                node, path, f"this is {node.kind}, not a value", f"Write {self._example}, or a number."
            )
        return node

    def schema(self) -> Schema:
        """A number or text."""
        return {"anyOf": [{"type": "number"}, Amount("").schema()["anyOf"][1]]}


def read_limits(raw: dict[str, Any], unit: str, at: Reading, path: str) -> None:
    """Puts numbers in this unit in the place of `max` and `min` as `Limit` has read them.

    Raises:
        Unusable: one of them is none; both have been told.
    """
    bad = False
    for side in ("max", "min"):
        if side in raw:
            try:
                raw[side] = Amount(unit).read(raw[side], at, f"{path}.{side}")
            except Unusable:
                bad = True
    if bad:
        raise Unusable(path)
