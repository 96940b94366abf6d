"""One figure of merit: what is to be known of it, and where classes of results keep theirs."""

from __future__ import annotations

from dataclasses import dataclass, fields
from math import pi
from typing import Literal, TypeVar, get_args, get_type_hints

from ..docstrings import with_attributes

Better = Literal["lower", "higher", "none"]
Notation = Literal["fixed", "significant", "seconds", "decibel", "exponent", "flag"]


@dataclass(frozen=True)
class Figure:
    """One figure of merit, or one number beside it.

    Attributes:
        term: the field's word for it; heads its row in the library and on the command line.
        meaning: its definition, in one sentence without a full stop.
        unit: of its value in results and replies, SI but for %; empty without one.
        better: which way is better.
        source: of the definition; empty where it says itself what it is.
        absent: when there is no value, as it goes on after "left out".
        notation: how its value is written; "seconds" and "decibel" bring their unit, a "flag" is yes or no.
        digits: decimals ("fixed") or significant digits.
        shown: the unit that people read; `unit` where empty.
        in_head: whether that unit stands at the row's head and not after each number.
        title: heads its row on the page and in the report; without one it has none there.
        short: heads its narrow column where designs stand one below the other; without one it has none there.
        hint: what is said of that column; its meaning where empty.
        symbol: as printed, subscripts after "_".
        key: its short name on the page, in requirements and addresses; its own name where empty.
        signed: whether its size alone is better or worse.
        detail: whether it is seen only where more figures are asked for.
        least: two values that differ by less are alike, in `unit`.
    """

    term: str
    meaning: str
    unit: str = ""
    better: Better = "lower"
    source: str = ""
    absent: str = ""
    notation: Notation = "fixed"
    digits: int = 2
    shown: str = ""
    in_head: bool = False
    title: str = ""
    short: str = ""
    hint: str = ""
    symbol: str = ""
    key: str = ""
    signed: bool = False
    detail: bool = False
    least: float = 0.0

    @property
    def head(self) -> str:
        """Term and unit, of a row of plain values."""
        return f"{self.term} ({self.unit})" if self.unit else self.term

    @property
    def titled(self) -> str:
        """Title and the unit that is not written after each number."""
        return f"{self.title}, {self.shown}" if self.in_head else self.title

    @property
    def scale(self) -> float:
        """What a value is multiplied with to be shown: rad to °, a share to %."""
        if self.unit.startswith("rad") and self.shown.startswith("°"):
            return 180 / pi
        return 100.0 if self.shown == "%" and not self.unit else 1.0

    @property
    def described(self) -> str:
        """Meaning, unit, and when there is none: what a schema says."""
        return f"{self.measured}{f'; left out {self.absent}' if self.absent else ''}"

    @property
    def measured(self) -> str:
        """Meaning and unit, where that is not among the words already."""
        return f"{self.meaning}, {self.unit}" if self.unit not in ("", "%") else self.meaning

    @property
    def told(self) -> str:
        """Meaning and source, as a sentence of its own."""
        source = f" ({self.source})" if self.source else ""
        return f"{self.meaning[:1].upper()}{self.meaning[1:]}{source}"


Class = TypeVar("Class")


def figures_of(cls: type) -> dict[str, Figure]:
    """The figures that are fields of a class of results, by name and in order."""
    hints = get_type_hints(cls, include_extras=True)
    return {field.name: get_args(hints[field.name])[1] for field in fields(cls)}


def documented(cls: type[Class]) -> type[Class]:
    """With its figures in its docstring."""
    return with_attributes(cls, {name: figure.described for name, figure in figures_of(cls).items()})
