"""A class as CSV: plain, and in the columns that Moodle and Canvas import."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from typing import Any

_FORMULA = ("=", "+", "-", "@", "\t", "\r", "＝", "＋", "－", "＠")
"""How a cell begins that a spreadsheet would run."""
_AFTER_SEPARATOR = re.compile(r"([;\t|]\s*)(?=[=+\-@＝＋－＠])")
"""The same within a cell: where lists are separated by semicolons, a spreadsheet begins another cell there."""


def sheet(told: Mapping[str, Any], target: str) -> str:
    """The class as CSV.

    Args:
        told: the class, as the wall has it.
        target: `plain`: all points; `moodle`, `canvas`: what their grade books import.
    """
    rows = {"plain": _plain, "moodle": _moodle, "canvas": _canvas}[target](told)
    out = io.StringIO()
    csv.writer(out, lineterminator="\r\n").writerows([_safe(cell) for cell in row] for row in rows)
    return out.getvalue()


def _safe(cell: Any) -> str:
    """A cell that no spreadsheet takes for a formula."""
    if not isinstance(cell, str):
        return f"{cell:g}" if isinstance(cell, float) else str(cell)
    text = _AFTER_SEPARATOR.sub(r"\1'", cell)
    return f"'{text}" if text.lstrip(" ").startswith(_FORMULA) else text


def _share(points: float, of: float) -> str:
    return f"{100 * points / of:.1f}" if of else ""


def _plain(told: Mapping[str, Any]) -> list[Sequence[Any]]:
    steps = told["steps"]
    rows: list[Sequence[Any]] = [
        [
            *("Number", "Name", "Email", "Login"),
            *(f"{step['title']} (of {step['points']:g})" for step in steps),
            *("Points", "Of", "Share, %", "To be marked", "Attempts", "Hints", "Last seen"),
        ]
    ]
    for person in told["students"]:
        own = [person["steps"][step["name"]] for step in steps]
        rows.append(
            [
                *(person["number"], person["name"], person.get("email", ""), person.get("login", "")),
                *(float(step["points"]) for step in own),
                *(float(person["points"]), float(person["of"]), _share(person["points"], person["of"])),
                *(sum(step[key] for step in own) for key in ("to_mark", "attempts", "hints")),
                person["last_seen"],
            ]
        )
    return rows


def _moodle(told: Mapping[str, Any]) -> list[Sequence[Any]]:
    """Moodle matches by e-mail address or username, and maps each other column by hand to a grade item."""
    item = _item(told)
    rows: list[Sequence[Any]] = [["Full name", "Email address", "Username", item, f"{item} (feedback)"]]
    for person in told["students"]:
        identity = (person["name"], person.get("email", ""), person.get("login", ""))
        rows.append([*identity, float(person["points"]), _feedback(told, person)])
    return rows


def _canvas(told: Mapping[str, Any]) -> list[Sequence[Any]]:
    """Canvas: five columns that it knows people by, one per assignment, in the second row what is possible."""
    rows: list[Sequence[Any]] = [
        ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", _item(told)],
        ["Points Possible", "", "", "", "", float(told["points"])],
    ]
    for person in told["students"]:
        login = person.get("login") or person.get("email", "")
        rows.append([person["name"], "", "", login, "", float(person["points"])])
    return rows


def _item(told: Mapping[str, Any]) -> str:
    return f"heli2dof: {told['lab']['title']}"


def _feedback(told: Mapping[str, Any], person: Mapping[str, Any]) -> str:
    own = person["steps"]
    return "; ".join(f"{s['title']}: {own[s['name']]['points']:g} of {s['points']:g}" for s in told["steps"])
