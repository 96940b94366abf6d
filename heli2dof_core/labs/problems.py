"""What is wrong with a lab's file, with line and column: all of it at once, for whoever writes it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ..errors import Heli2DofError

Severity = Literal["error", "warning"]


@dataclass(frozen=True, order=True)
class LabProblem:
    """One thing that is wrong, or unwise, in a lab's file.

    Attributes:
        line, column: where, both from 1.
        path: of the field, such as ``steps[0].goals[1].max``; empty for the file as a whole.
        message: what is wrong.
        hint: what to do.
        severity: an error keeps the lab from being used, a warning does not.
    """

    line: int
    column: int
    path: str
    message: str
    hint: str = ""
    severity: Severity = "error"

    def __str__(self) -> str:
        where = f" {self.path}:" if self.path else ""
        hint = f" {self.hint}" if self.hint else ""
        return f"{self.line}:{self.column}: {self.severity}:{where} {self.message}.{hint}"


class LabError(Heli2DofError):
    """A lab's file cannot be used; its problems are all that is wrong with it, errors alone."""

    code = "unusable_lab"

    def __init__(self, problems: Sequence[LabProblem], name: str = "") -> None:
        self.problems = tuple(problems)
        first, more = self.problems[0], len(self.problems) - 1
        others = f" ({more} more)" if more else ""
        file = f"{name}:" if name else "line "
        path = f"{first.path}: " if first.path else ""
        super().__init__(
            f"{file}{first.line}:{first.column}: {path}{first.message}{others}",
            field=first.path,
            hint=first.hint,
        )
