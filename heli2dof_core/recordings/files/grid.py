"""Rows of cells as a table: where the numbers begin, which row names the columns, which one holds their units."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import isnan

import numpy as np

from ...errors import Wanted
from ...findings import Finding
from ..recording import Table
from ..units import known_unit
from .cells import Cell, is_empty, numbers, share_of_numbers
from .limits import check_size, refused

MOSTLY = 0.5
"""Share of numbers from which a row is one of data, and a column one of numbers."""
_AT_A_TIME = 20_000
_LONGEST_NAME = 60


@dataclass(frozen=True)
class Grid:
    """Rows of cells and how they were told apart.

    Attributes:
        rows: of cells, none of them empty.
        places: the number of each row in the file.
        width: cells of a row of data.
        comma: whether decimals stand behind a comma.
        comments: cells of each comment above the data, the nearest last, for each way to split it.
        words: how the rows were told apart, for messages; empty where the file itself says it.
    """

    rows: Sequence[Sequence[Cell]]
    places: Sequence[int]
    width: int
    comma: bool = False
    comments: Sequence[Sequence[list[str]]] = ()
    words: str = ""


def table_of_grid(grid: Grid, wanted: Wanted) -> Table:
    """The table in a grid.

    Raises:
        RecordingError: a row has another number of cells, a cell holds no number; it names row and column.
    """
    start = next((i for i, row in enumerate(grid.rows) if _is_data(grid, row)), None)
    if start is None:
        raise refused(
            "the file holds no rows of numbers",
            hint="Give time, both angles and both voltages as columns of numbers, or choose the separator.",
        )
    names, units = _head(grid, start)
    body, width = grid.rows[start:], len(names)
    check_size(len(body), width)
    _check_widths(grid, start, width, wanted)
    columns, kept, left_out, stated = [], [], [], {}
    for j, name in enumerate(names):
        wanted()
        cells = [row[j] if j < len(row) else "" for row in body]
        values, unit, bad = numbers(cells, grid.comma)
        if all(map(isnan, values)) and (not name or bad is not None):
            if name:
                left_out.append(name)
            continue
        if bad is not None:
            if share_of_numbers(cells, grid.comma) < MOSTLY:
                left_out.append(name or f"column {j + 1}")
                continue
            place, cell = grid.places[start + bad], str(cells[bad])
            raise refused(
                f"row {place}, column {name or f'column {j + 1}'!r} holds {cell[:40]!r}, not a number",
                cell[:100],
                "Correct or delete this row; empty cells may stay empty. "
                + ("A second recording may begin here: keep one. " if bad > 1 else "")
                + (f"Or choose another separator ({grid.words} was taken)." if grid.words else ""),
            )
        kept.append((j, name))
        columns.append(values)
        if unit or units.get(j):
            stated[j] = unit or units[j]
    if not columns:
        raise refused(
            "the file holds no columns of numbers", hint="Choose the separator, or correct the file."
        )
    unique = unique_names([name or f"column {j + 1}" for j, name in kept])
    return Table(
        tuple(unique),
        np.array(columns, dtype=np.float64).T.copy(),
        grid.places[start],
        {name: stated[j] for (j, _), name in zip(kept, unique, strict=True) if j in stated},
        findings=left_out_finding([f"{name} (no numbers)" for name in left_out]),
    )


def left_out_finding(what: Sequence[str]) -> tuple[Finding, ...]:
    """What of a file could not be read, as one remark or none."""
    if not what:
        return ()
    shown = ", ".join(what[:8]) + (f" and {len(what) - 8} more" if len(what) > 8 else "")
    return (Finding("left_out", "info", f"Left out of the file: {shown}."),)


def unique_names(names: Sequence[str]) -> list[str]:
    """Names of at most 60 characters, numbered where they are equal."""
    seen: Counter[str] = Counter()
    taken: set[str] = set()
    result = []
    for place, given in enumerate(names, 1):
        base = name = given.strip()[:_LONGEST_NAME] or f"column {place}"
        seen[base] += 1
        while name in taken or (seen[base] > 1 and name == base):
            name = f"{base} ({seen[base]})"
            seen[base] += name in taken
        taken.add(name)
        result.append(name)
    return result


def _is_data(grid: Grid, row: Sequence[Cell]) -> bool:
    near = abs(len(row) - grid.width) <= (1 if grid.width > 2 else 0)
    return near and share_of_numbers(list(row), grid.comma) >= MOSTLY and not _units(row)


def _units(row: Sequence[Cell]) -> bool:
    """Whether all cells that are not empty are units; the unit 1 alone is a number."""
    filled = [cell for cell in row if not is_empty(cell)]
    known = all(isinstance(cell, str) and known_unit(cell) for cell in filled)
    return known and any(not cell.strip("[](){} ").isdigit() for cell in filled)


def _head(grid: Grid, start: int) -> tuple[list[str], dict[int, str]]:
    """Names (empty where there are none) and units by column, from the rows above the data or from comments."""
    first, units = len(grid.rows[start]), {}
    width = grid.width
    rows = [[str(cell or "").strip() for cell in row] for row in grid.rows[max(0, start - 3) : start]]
    if rows and _units(rows[-1]) and len(rows[-1]) == width:
        units = dict(enumerate(rows.pop()))
    if rows:
        named = rows[-1]
        while len(named) > width and not named[-1]:
            named = named[:-1]
        if len(named) in (width, width - 1 if first == width else width) and len(named) > 0:
            return (named if len(named) == width else _shorter(grid, named, start)), units
        if len(named) > 1 and not any(mark in " ".join(named) for mark in ":="):
            raise _mismatch(grid, start, len(grid.rows[start]), len(named))
    return _of_comments(grid, units)


def _of_comments(grid: Grid, units: dict[int, str]) -> tuple[list[str], dict[int, str]]:
    """Names and units from the nearest comments that have a cell for each column."""
    for ways in reversed(grid.comments):
        for cells in ways:
            if len(cells) != grid.width:
                continue
            if _units(cells):
                units = units or dict(enumerate(cells))
                break
            if share_of_numbers(list(cells), grid.comma) < MOSTLY:
                return list(cells), units
    return [""] * grid.width, units


def _shorter(grid: Grid, named: list[str], start: int) -> list[str]:
    """A header with one name less than the rows have cells: a separator at each row's end, or numbers of the rows."""
    last = [row[-1] if row else "" for row in grid.rows[start:]]
    return [*named, ""] if all(map(is_empty, last)) else ["row", *named]


def _check_widths(grid: Grid, start: int, width: int, wanted: Wanted) -> None:
    for i in range(start, len(grid.rows)):
        if (i - start) % _AT_A_TIME == 0:
            wanted()
        row = grid.rows[i]
        if (
            len(row) == width
            or (len(row) == width + 1 and is_empty(row[-1]))
            or (len(row) == width - 1 and all(is_empty(other[-1]) for other in grid.rows[start : start + 3]))
        ):
            continue
        raise _mismatch(grid, i, len(row), width)


def _mismatch(grid: Grid, i: int, cells: int, width: int) -> Exception:
    values = "1 value" if cells == 1 else f"{cells} values"
    taken = f" (separator taken: {grid.words})" if grid.words else ""
    return refused(
        f"row {grid.places[i]} has {values}, the header {width}{taken}",
        str(list(grid.rows[i]))[:100],
        "Choose the separator, or correct this row. If commas stand before decimals, separate columns by semicolons.",
    )
