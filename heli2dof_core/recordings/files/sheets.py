"""Spreadsheets (.xlsx), read by openpyxl row by row, within limits."""

from __future__ import annotations

import io
import re
import zipfile
from collections import Counter
from dataclasses import replace
from typing import Any

from ...errors import Heli2DofError, RecordingError, Wanted
from ...findings import Finding
from ..recording import Table
from .cells import is_empty, number
from .grid import Grid, table_of_grid
from .limits import MOST_COLUMNS, MOST_ROWS, check_size, check_unpacked, refused

_AT_A_TIME = 2_000
_ABOVE = 60
"""Rows and columns beside the data that are looked at."""
_MOST_SHEETS = 50


def read_sheet(data: bytes, name: str, wanted: Wanted) -> Table:
    """The table of a workbook's sheet with most rows of numbers.

    Raises:
        RecordingError: it is damaged, too large once unpacked, or holds no rows of numbers.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            names = {info.filename: info for info in packed.infolist()}
            # A part is read no further than the size that its entry tells.
            check_unpacked(sum(info.file_size for info in names.values()), name)
            if "xl/workbook.xml" not in names:
                raise refused(
                    "this archive is no spreadsheet (.xlsx)",
                    name,
                    "Give the files in it one by one; .ods and .numbers: save as .xlsx or CSV.",
                )
            if len(names) > 20 * _MOST_SHEETS:
                raise refused("the spreadsheet holds too many parts", name, "Save the one sheet as CSV.")
            _require_few_strings(packed, names, wanted)
        return _largest(data, wanted)
    except Heli2DofError:
        raise
    except Exception as error:  # its readers raise whatever the bytes provoke
        raise refused("the spreadsheet is damaged", name, "Save it again, or as CSV.") from error


def _require_few_strings(packed: zipfile.ZipFile, names: dict[str, Any], wanted: Wanted) -> None:
    """A document type may define entities that grow without bound; no spreadsheet has one."""
    for part in names:
        if part.endswith((".xml", ".rels")):
            wanted()
            with packed.open(part) as file:
                if re.search(rb"<!(DOCTYPE|ENTITY)", file.read(4096)):
                    raise refused("the spreadsheet is damaged", part, "Save it again, or as CSV.")


def _largest(data: bytes, wanted: Wanted) -> Table:
    from openpyxl import load_workbook

    book = load_workbook(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
    sheets = book.worksheets[:_MOST_SHEETS]
    tables: list[tuple[str, Table]] = []
    problem: RecordingError | None = None
    for sheet in sheets:
        try:
            tables.append((str(sheet.title), _table(sheet, wanted)))
        except RecordingError as error:
            problem = problem or error
    book.close()
    if not tables:
        raise problem or refused("the spreadsheet holds no rows of numbers", hint="Save the sheet as CSV.")
    title, table = max(tables, key=lambda item: len(item[1].values))
    if len(sheets) == 1:
        return table
    words = f"Of {len(sheets)} sheets {title!r} was read, which holds most rows of numbers."
    return replace(table, findings=(*table.findings, Finding("one_sheet", "info", words)))


def _table(sheet: Any, wanted: Wanted) -> Table:
    rows, places = [], []
    most = MOST_ROWS + _ABOVE
    cells = sheet.iter_rows(max_row=most + 1, max_col=MOST_COLUMNS + _ABOVE, values_only=True)
    for place, row in enumerate(cells, 1):
        if place % _AT_A_TIME == 0:
            wanted()
        if place > most:
            check_size(place, 0)
        own = list(row)
        while own and is_empty(own[-1]):
            own.pop()
        if own:
            rows.append(own)
            places.append(place)
    if not rows:
        raise refused(
            "the spreadsheet holds no rows of numbers", hint="Save the sheet with the recording as CSV."
        )
    first = min(next(i for i, cell in enumerate(row) if not is_empty(cell)) for row in rows)
    rows = [row[first:] for row in rows]
    widths = Counter(len(row) for row in rows if sum(number(cell) is not None for cell in row) > len(row) / 2)
    width = max(widths, key=lambda n: (widths[n], n), default=len(rows[0]))
    width = max([n for n in widths if widths[n] >= 0.01 * widths[width]], default=width)
    check_size(0, width)
    padded = [row + [None] * (width - len(row)) if _is_row(row, width) else row for row in rows]
    return table_of_grid(Grid(padded, places, width), wanted)


def _is_row(row: list[Any], width: int) -> bool:
    """Whether a row is one of the data, with empty cells at its end."""
    return len(row) < width and sum(isinstance(cell, int | float) for cell in row) >= len(row) / 2
