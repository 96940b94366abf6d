"""What can be said of a design or a response that is legal but deserves a word."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

Severity = Literal["info", "warning", "error"]


@dataclass(frozen=True)
class Finding:
    """One remark: a stable code for programs, a severity, and a sentence for people."""

    code: str
    severity: Severity
    message: str


_RANK = {"error": 0, "warning": 1, "info": 2}


def merged(*groups: Iterable[Finding]) -> tuple[Finding, ...]:
    """One finding per code, the gravest first; of several with one code, the first one given."""
    unique: dict[str, Finding] = {}
    for group in groups:
        for finding in group:
            unique.setdefault(finding.code, finding)
    return tuple(sorted(unique.values(), key=_rank)) if len(unique) > 1 else tuple(unique.values())


def _rank(finding: Finding) -> int:
    return _RANK[finding.severity]
