"""GNU Octave's own text format, which `save` writes where no other is asked for."""

from __future__ import annotations

from math import prod
from typing import Any

import numpy as np

from ...errors import Heli2DofError, Wanted
from ..recording import Table
from .hdf5 import range_of
from .limits import DEEPEST, MOST_VARIABLES, check_unpacked, refused
from .text import decoded
from .variables import Unreadable, table_of_variables

_AT_A_TIME = 20_000
_MOST_LINES = 2_000_000
_LONGEST_LINE = 10_000_000


def is_octave_text(data: bytes) -> bool:
    """Whether a file begins as Octave's text does."""
    head = data[:4000]
    return head.startswith(b"# Created by Octave") or (head.startswith(b"# name: ") and b"\n# type: " in head)


def read_octave(data: bytes, name: str, wanted: Wanted) -> Table:
    """The table in a file of Octave's text format.

    Raises:
        RecordingError: it is damaged or holds no columns.
    """
    try:
        content = _Reader(decoded(data, name), wanted).content()
    except Heli2DofError:
        raise
    except (ValueError, IndexError, TypeError, OverflowError) as error:
        raise refused("Octave's file is damaged", name, "Save it again, or with save -v7.") from error
    return table_of_variables(content, "file")


class _Reader:
    """Reads line by line; `# key: value` lines describe what follows."""

    def __init__(self, text: str, wanted: Wanted) -> None:
        if text.count("\n") > _MOST_LINES:
            raise refused("the file has too many lines", hint="Save only the recording's variables.")
        self.lines = [line for line in text.split("\n") if line.strip()]
        self.place = self.parts = self.size = 0
        self.wanted = wanted

    def content(self) -> dict[str, Any]:
        """The file's variables."""
        found: dict[str, Any] = {}
        while (name := self._next("name")) is not None:
            found[name] = self._value(0)
        return found

    def _next(self, key: str) -> str | None:
        """The value of the next line `# key: value`; what lies before it is left out."""
        mark = f"# {key}:"
        while self.place < len(self.lines):
            line = self.lines[self.place]
            self.place += 1
            if line.startswith(mark):
                return line[len(mark) :].strip()
        return None

    def _count(self, key: str) -> int:
        """A number that must stand in the next line."""
        line = self.lines[self.place]
        if not line.startswith(f"# {key}:"):
            raise ValueError(key)
        self.place += 1
        return int(line.partition(":")[2])

    def _row(self) -> list[float]:
        self.place += 1
        if self.place % _AT_A_TIME == 0:
            self.wanted()
        line = self.lines[self.place - 1]
        if len(line) > _LONGEST_LINE:
            raise refused("a line of the file is too long", hint="Save only the recording's variables.")
        return [float(word) for word in line.split()]

    def _value(self, depth: int) -> Any:  # noqa: PLR0911
        self.parts += 1
        if depth > 2 * DEEPEST or self.parts > MOST_VARIABLES:
            raise ValueError("nested too deep")
        self.wanted()
        kind = self._next("type") or ""
        if "complex" in kind:
            return Unreadable("complex numbers")
        if kind in ("scalar struct", "struct"):
            self._shape()
            return {self._next("name") or "": self._value(depth + 1) for _ in range(self._count("length"))}
        if kind == "cell":
            count = prod(self._shape())
            cells = []
            for _ in range(min(count, MOST_VARIABLES)):
                self._next("name")
                cells.append(self._value(depth + 1))
            return cells
        if "string" in kind:
            return self._string()
        if kind in ("range", "double_range"):
            self.place += self.lines[self.place].startswith("# base")
            base, limit, step = self._row()[:3]
            values = range_of(base, limit, step)
            self._allow(len(values))
            return values
        if kind.endswith("matrix") and "sparse" not in kind and "diagonal" not in kind:
            return self._matrix()
        if kind in ("scalar", "bool", "float scalar") or kind.endswith("scalar"):
            return np.array(self._row())
        return Unreadable(kind or "of an unknown kind")

    def _shape(self) -> tuple[int, ...]:
        if self.lines[self.place].startswith("# ndims:"):
            self._count("ndims")
            return tuple(int(n) for n in self._row())
        return self._count("rows"), self._count("columns")

    def _allow(self, numbers: int) -> None:
        self.size += 8 * numbers
        check_unpacked(self.size)

    def _string(self) -> str:
        parts = []
        for _ in range(self._count("elements")):
            self._count("length")
            parts.append(self.lines[self.place].strip("\r") if self.place < len(self.lines) else "")
            self.place += 1
        return " ".join(parts)

    def _matrix(self) -> Any:
        flat = self.lines[self.place].startswith("# ndims:")
        shape = self._shape()
        if min(shape, default=0) < 0:
            raise ValueError("a negative size")
        total = prod(shape)
        self._allow(total)
        if not total:
            return None
        if flat:  # one number a line, columns first
            return np.array([self._row()[0] for _ in range(total)]).reshape(shape, order="F")
        rows = [np.array(self._row()) for _ in range(shape[0])]
        whole = all(len(row) == shape[1] for row in rows)
        return np.array(rows) if whole else Unreadable("a damaged matrix")
