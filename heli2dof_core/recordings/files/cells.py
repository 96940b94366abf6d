"""Cells of text as numbers: decimal points and commas, units behind numbers, durations, dates."""

from __future__ import annotations

import re
from collections.abc import Callable
from datetime import UTC, datetime, time, timedelta
from math import isnan
from typing import Any

from ..units import SECONDS, known_unit

Cell = Any
"""Text, or what a spreadsheet holds: a number, a date, a time, nothing."""
EMPTY = frozenset({"", "nan", "na", "n/a", "null", "none", "#n/a", "-nan", "missing", "<undefined>", "nat"})
_COMMA = re.compile(r"[+-]?(\d+|\d{1,3}(\.\d{3})+)?,\d*([eEdD][+-]?\d+)?")
_FORTRAN = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)[dD][+-]?\d+")
_WITH_UNIT = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([a-zA-Zµμ°º/%]+)")
_CLOCK = re.compile(r"([+-]?)(?:(\d+)(?:[:.]|\s+days?\s+)(?=\d+:))?(\d+):(\d\d):(\d\d(?:[.,]\d*)?)")
_MINUTES = re.compile(r"([+-]?)(\d+):(\d\d[.,]\d+)")
_DATES = (
    "%d-%b-%Y %H:%M:%S.%f",
    "%d-%b-%Y %H:%M:%S",
    "%d.%m.%Y %H:%M:%S.%f",
    "%d.%m.%Y %H:%M:%S",
    "%m/%d/%Y %H:%M:%S.%f",
    "%m/%d/%Y %H:%M:%S",
    "%d/%m/%Y %H:%M:%S.%f",
    "%d/%m/%Y %H:%M:%S",
    "%Y/%m/%d %H:%M:%S.%f",
    "%Y/%m/%d %H:%M:%S",
)
Number = tuple[float, str]
"""A value and its unit, which is empty where none is told."""
_NOTHING: Number = (float("nan"), "")
_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def number(cell: Cell, comma: bool = False) -> Number | None:
    """A cell as a number, NaN where it is empty; None where it is none. `comma`: decimals stand behind a comma."""
    if isinstance(cell, bool):
        return None
    if isinstance(cell, int | float):
        return float(cell), ""
    if not isinstance(cell, str):
        return _of_object(cell)
    text = cell.strip().strip("'").replace("\u2212", "-").replace("\u00a0", "").replace("\u202f", "")
    if text.lower() in EMPTY:
        return _NOTHING
    if comma:
        if _COMMA.fullmatch(text):
            text = text.replace(".", "").replace(",", ".")
        elif "," in text and "." not in text:
            text = text.replace(",", ".")
    try:
        return (float(text), "") if "_" not in text else None
    except ValueError:
        return _unusual(text)


def _unusual(text: str) -> Number | None:
    if not text or not (text[0].isdigit() or text[0] in "+-."):
        return None
    if _FORTRAN.fullmatch(text):
        return float(text.lower().replace("d", "e")), ""
    if (found := _WITH_UNIT.fullmatch(text)) and (unit := known_unit(found[2])):
        return float(found[1]), unit[1]
    if found := _CLOCK.fullmatch(text):
        sign, days, hours, minutes, seconds = found.groups()
        own = (
            86400 * int(days or 0) + 3600 * int(hours) + 60 * int(minutes) + float(seconds.replace(",", "."))
        )
        return (-own if sign == "-" else own), "s"
    if found := _MINUTES.fullmatch(text):
        own = 60 * int(found[2]) + float(found[3].replace(",", "."))
        return (-own if found[1] == "-" else own), "s"
    return _date(text)


def _date(text: str) -> Number | None:
    if len(text) < 8 or not any(mark in text for mark in "-/."):
        return None
    ways: list[Callable[[str], datetime]] = [datetime.fromisoformat]
    ways += [lambda words, form=form: datetime.strptime(words, form) for form in _DATES]
    for way in ways:
        try:
            return _of_object(way(text.replace(",", ".")))
        except (ValueError, OverflowError):
            continue
    return None


def _of_object(cell: Cell) -> Number | None:
    if cell is None:
        return _NOTHING
    if isinstance(cell, datetime):
        return ((cell if cell.tzinfo else cell.replace(tzinfo=UTC)) - _EPOCH).total_seconds(), "s"
    if isinstance(cell, timedelta):
        return cell.total_seconds(), "s"
    if isinstance(cell, time):
        return 3600 * cell.hour + 60 * cell.minute + cell.second + 1e-6 * cell.microsecond, "s"
    return None


def numbers(cells: list[Cell], comma: bool) -> tuple[list[float], str, int | None]:
    """A column's numbers, its unit, and the place of the first cell that is none (None: all are).

    Times in several units become seconds.
    """
    try:
        if not comma or not any("," in cell for cell in cells):
            plain = list(map(float, cells))
            if not any(cell.count("_") for cell in cells):
                return plain, "", None
    except (ValueError, TypeError, AttributeError):
        pass
    found, bad = [], None
    for place, cell in enumerate(cells):
        own = number(cell, comma)
        if own is None and bad is None:
            bad = place
        found.append(own or _NOTHING)
    units = {unit for value, unit in found if unit}
    if units and any(not unit and not isnan(value) for value, unit in found):
        units.add("")
    if len(units) <= 1:
        return [value for value, _ in found], next(iter(units), ""), bad
    if units <= set(SECONDS) and "" not in units:
        return [value * SECONDS.get(unit, 1.0) for value, unit in found], "s", bad
    odd = next(place for place, (value, unit) in enumerate(found) if not isnan(value) and unit != found[0][1])
    return [value for value, _ in found], "", odd if bad is None else bad


def share_of_numbers(cells: list[Cell], comma: bool) -> float:
    """Of the cells that are not empty."""
    filled = [own for cell in cells if not is_empty(cell) for own in (number(cell, comma),)]
    return sum(own is not None for own in filled) / len(filled) if filled else 0.0


def is_empty(cell: Cell) -> bool:
    """Whether there is nothing in a cell."""
    return cell is None or (isinstance(cell, str) and cell.strip().lower() in EMPTY)
