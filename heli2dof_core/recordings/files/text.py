"""Text in the dialects that tools write: separators and decimal marks are judged over many lines."""

from __future__ import annotations

import csv
import re
from collections import Counter
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Literal, get_args

from ...errors import RecordingError, Wanted
from ...findings import Finding
from ..recording import Table
from .cells import is_empty, number, share_of_numbers
from .grid import MOSTLY, Grid, table_of_grid
from .limits import MOST_ROWS, check_size, refused

Separator = Literal["comma", "semicolon", "tab", "bar", "blank"]
Decimal = Literal["point", "comma"]
SEPARATORS = MappingProxyType({"semicolon": ";", "tab": "\t", "comma": ",", "bar": "|", "blank": None})
"""Marks by name, in the order in which equals are preferred; None is any white space."""
_SAMPLED = 300
_A_TABLE = 0.25
"""Share of lines that are rows of numbers, below which a text is no table."""
_CONSISTENT = 0.8
"""Share of the best candidate's lines from which a candidate counts as consistent, too."""
SYNTHETIC = "A digital rig of heli2dof"
"""With this begins a comment of files that nobody has measured."""
_COMMENT = ("#", "%", "//")
_LINES = re.compile(r"\r\n|\n|\r")
_DECLARED = re.compile(r"\ufeff?\"?sep=(.)\"?\s*", re.IGNORECASE)


@dataclass(frozen=True)
class Dialect:
    """How text is to be read; what is None is judged.

    Attributes:
        separator: between cells.
        decimal: what stands before decimals.
    """

    separator: Separator | None = None
    decimal: Decimal | None = None

    def __post_init__(self) -> None:
        for value, known, what in (
            (self.separator, Separator, "separator"),
            (self.decimal, Decimal, "decimal"),
        ):
            if value is not None and value not in get_args(known):
                raise RecordingError(
                    f"{what} is {value!r}, which does not exist",
                    field=what,
                    value=value,
                    hint="Known are " + ", ".join(get_args(known)) + ".",
                )


def read_text(data: bytes, name: str, dialect: Dialect, wanted: Wanted) -> Table:
    """The table in a text.

    Raises:
        RecordingError: it is no text, or its rows cannot be read; it names row and column.
    """
    text = decoded(data, name)
    lines = _LINES.split(text)
    if declared := _DECLARED.fullmatch(lines[0]):
        lines[0] = ""
        known = {mark: key for key, mark in SEPARATORS.items()}
        if dialect.separator is None and declared[1] in known:
            dialect = replace(dialect, separator=known[declared[1]])  # pyright: ignore[reportArgumentType]
    rows, places, comments = [], [], []
    for place, line in enumerate(lines, 1):
        bare = line.strip()
        if not bare:
            continue
        if bare.startswith(_COMMENT):
            if len(comments) < 200:
                comments.append(bare.lstrip("#%/ \t"))
        else:
            rows.append(line)
            places.append(place)
    if not rows:
        raise refused(
            "the file holds no rows", name, "Give rows of numbers: time, both angles, both voltages."
        )
    check_size(len(rows) - 50 if len(rows) > MOST_ROWS + 50 else 0, 0)
    separator, comma, width = _judged(rows, dialect)
    wanted()
    cells = [split(row, separator) for row in rows]
    ways = [SEPARATORS[separator], ",", ";", "\t", None]
    split_comments = [[_cells(comment, way) for way in ways] for comment in comments]
    grid = Grid(cells, places, width, comma, split_comments, separator)
    table = table_of_grid(grid, wanted)
    if any(comment.startswith(SYNTHETIC) for comment in comments):
        words = "A digital rig of heli2dof made this recording: no real one was measured."
        table = replace(table, findings=(*table.findings, Finding("synthetic", "info", words)))
    return replace(table, dialect={"separator": separator, "decimal": "comma" if comma else "point"})


def decoded(data: bytes, name: str) -> str:
    """Text by its marks, as UTF-8, or as Windows writes it.

    Raises:
        RecordingError: it is no text.
    """
    head = data[:400]
    coding = "utf-8-sig"
    if head[:2] in (b"\xff\xfe", b"\xfe\xff"):
        coding = "utf-16"
    elif len(head) > 20 and head[1::2].count(0) > 0.9 * len(head[1::2]) and head[::2].count(0) == 0:
        coding = "utf-16-le"
    try:
        text = data.decode(coding)
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    if "\0" in text:
        raise refused(
            "this kind of file is not known",
            name,
            "Give text with columns (CSV), a spreadsheet (.xlsx), MATLAB's .mat, HDF5 or JSON.",
        )
    return text


def split(line: str, separator: str) -> list[str]:
    """A line's cells."""
    return _cells(line, SEPARATORS[separator])


def _cells(line: str, mark: str | None) -> list[str]:
    if mark is None and '"' not in line:
        return line.split()
    if '"' in line:
        blank = mark is None
        read = csv.reader([line.strip() if blank else line], delimiter=mark or " ", skipinitialspace=True)
        try:
            return [cell.strip() for cell in next(read) if cell or not blank]
        except (csv.Error, StopIteration):
            return [line]
    return [cell.strip() for cell in line.split(mark)]


def _judged(rows: list[str], dialect: Dialect) -> tuple[str, bool, int]:
    """Separator, whether decimals stand behind a comma, and how many cells a row of data has.

    Every candidate splits a sample of lines from all over the file. Of those that split as many lines into equally
    many numbers as the best one does (or four fifths of them), blanks are taken last.
    """
    sample = _sampled(rows)
    quoted = any('"' in line for line in sample)
    wanted = (dialect.decimal,) if dialect.decimal else ("point", "comma")
    candidates = []
    for separator in (dialect.separator,) if dialect.separator else tuple(SEPARATORS):
        split_lines = [split(line, separator) for line in sample]
        for decimal in wanted:
            comma = decimal == "comma"
            if comma and separator == "comma" and not quoted:
                continue
            candidates.append(_Candidate.of(separator, comma, split_lines))
    for lines, width in (("all", "width"), ("most", "wide")):
        best = max((getattr(c, lines) for c in candidates if getattr(c, width) > 1), default=0)
        if best and best < _A_TABLE * len(sample):
            raise refused(
                f"only {best} of {len(sample)} lines are rows of numbers",
                hint="Give a table: time, both angles and both voltages as columns of numbers. Of a design, "
                "export csv, mat or json.",
            )
        if best:
            near = [
                c for c in candidates if getattr(c, width) > 1 and getattr(c, lines) >= _CONSISTENT * best
            ]
            # A decimal mark that more lines bear out, no blank, many lines.
            chosen = max(near, key=lambda c: (c.separator != "blank", getattr(c, lines), not c.comma))
            return chosen.separator, chosen.comma, getattr(chosen, width)
    single = max(candidates, key=lambda c: (c.all, not c.comma))
    if not single.all and len(rows) > 1:
        # No candidate tells numbers apart: the one that splits most, so that the message can name a place.
        named = max(candidates, key=lambda c: (c.common[1] * (c.common[0] > 1), c.common[0]))
        return named.separator, named.comma, named.common[0]
    return single.separator, single.comma, max(1, single.width)


@dataclass(frozen=True)
class _Candidate:
    """How a separator and a decimal mark do: lines of numbers alone, lines mostly of numbers, and their widths."""

    separator: str
    comma: bool
    all: int
    width: int
    most: int
    wide: int
    common: tuple[int, int]

    @staticmethod
    def of(separator: str, comma: bool, lines: list[list[str]]) -> _Candidate:
        pure: Counter[int] = Counter()
        mixed: Counter[int] = Counter()
        for cells in lines:
            if share_of_numbers(cells, comma) >= MOSTLY:
                mixed[len(cells)] += 1
                if all(is_empty(cell) or number(cell, comma) is not None for cell in cells):
                    pure[len(cells)] += 1
        width, count = _commonest(pure)
        wide, most = _commonest(mixed)
        common = _commonest(Counter(map(len, lines)))
        return _Candidate(separator, comma, count, width, most, wide, common)


def _commonest(counts: Counter[int]) -> tuple[int, int]:
    """The most frequent width, of equals the widest, and how often it occurs."""
    return max(counts.items(), key=lambda item: (item[1], item[0])) if counts else (0, 0)


def _sampled(rows: list[str]) -> list[str]:
    """Lines from the beginning, from all over, and from the end."""
    if len(rows) <= _SAMPLED:
        return rows
    third = _SAMPLED // 3
    step = (len(rows) - 2 * third) // third + 1
    commas = [row for row in rows if "," in row][:third]  # a decimal comma may be rare
    return [*rows[:third], *rows[third:-third:step], *rows[-third:], *commas]
