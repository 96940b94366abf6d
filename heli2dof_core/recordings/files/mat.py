"""MATLAB's files of version 4 to 7, within limits that hold before anything is unpacked.

They are read here and not by SciPy, whose reader ends the whole process on some damaged files. Formats: MathWorks,
MAT-File Format.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from itertools import islice
from math import prod
from types import MappingProxyType
from typing import Any

import numpy as np

from ...errors import Heli2DofError, RecordingError, Wanted
from ..recording import Table
from .limits import DEEPEST, MOST_VARIABLES, check_unpacked, refused
from .matlab_tables import with_tables
from .variables import Unreadable, table_of_variables

_MATRIX, _COMPRESSED = 14, 15
_CELL, _STRUCT, _OBJECT, _CHAR, _SPARSE, _FUNCTION, _OPAQUE = 1, 2, 3, 4, 5, 16, 17
_COMPLEX = 0x800
_STORED = MappingProxyType(
    {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
)
"""How numbers are stored, by the type of their element."""
_V4_STORED = ("f8", "f4", "i4", "i2", "u2", "u1")
_PART = 2**18
_LONGEST_NAME = 256
"""Bytes. MATLAB's own names have at most 63, Octave's may be longer."""
_MOST_DIMENSIONS = 32
_WAY_OUT = "Save it again with save(…, '-v7')."


def is_v4(data: bytes) -> bool:
    """Whether the bytes begin as a .mat of version 4, which has no mark: by its first header."""
    return any(_v4_header(data, 0, order) is not None for order in "<>")


def read_mat(data: bytes, name: str, wanted: Wanted) -> Table:
    """The table in a .mat of version 4 to 7.

    Raises:
        RecordingError: it is damaged, too large once unpacked, or holds no columns.
    """
    try:
        own = data.startswith(b"MATLAB") or not is_v4(data)
        values = _Reader(wanted).variables(data) if own else _v4_variables(data, wanted)
    except Heli2DofError:
        raise
    except (struct.error, ValueError, IndexError, OverflowError) as error:
        raise refused("the .mat file is damaged or of an unknown version", name, _WAY_OUT) from error
    return table_of_variables(with_tables(values, data, wanted), ".mat file")


def _damaged() -> RecordingError:
    return refused("the .mat file is damaged", hint=_WAY_OUT)


def _too_many(what: str) -> RecordingError:
    return refused(f"the .mat file holds too many {what}", hint="Save the recording's variables only.")


def _v4_header(data: bytes, place: int, order: str) -> tuple[str, str, int, tuple[int, int], int] | None:
    """Name, dtype, kind, shape and end of a variable; None where there is none."""
    head = data[place : place + 20].ljust(20, b"\xff")
    kind, rows, columns, imaginary, length = struct.unpack(order + "5i", head)
    machine, zero, precision, matrix = kind // 1000, kind // 100 % 10, kind // 10 % 10, kind % 10
    plausible = machine == (order == ">") and zero == 0 and precision < 6 and matrix < 3
    if not (0 <= kind < 5000 and plausible and min(rows, columns) >= 0 and imaginary in (0, 1)):
        return None
    dtype = np.dtype(order + _V4_STORED[precision])
    end = place + 20 + length + rows * columns * dtype.itemsize * (1 + imaginary)
    if not 1 <= length <= _LONGEST_NAME or end > len(data):
        return None
    own = data[place + 20 : place + 20 + length].rstrip(b"\0")
    if not own.isascii() or not own.decode().isidentifier():
        return None
    return own.decode(), dtype.str, matrix + 10 * imaginary, (rows, columns), end


def _v4_variables(data: bytes, wanted: Wanted) -> dict[str, Any]:
    order = "<" if _v4_header(data, 0, "<") else ">"
    found: dict[str, Any] = {}
    place = total = count = 0
    while place < len(data):
        wanted()
        count += 1
        if count > MOST_VARIABLES:
            raise _too_many("variables")
        header = _v4_header(data, place, order)
        if header is None:
            raise _damaged()
        name, dtype, kind, shape, end = header
        total += 8 * prod(shape)
        check_unpacked(total)
        if kind == 0:
            start = end - prod(shape) * np.dtype(dtype).itemsize
            found[name] = np.frombuffer(data[start:end], dtype).astype(float).reshape(shape, order="F")
        elif kind != 1:
            found[name] = Unreadable("a sparse matrix" if kind % 10 == 2 else "complex numbers")
        place = end
    return found


class _Reader:
    """Reads a file of version 5 to 7; what its headers claim is held against the bytes that are there."""

    def __init__(self, wanted: Wanted) -> None:
        self.wanted, self.order = wanted, "<"
        self.unpacked = self.numbers = self.parts = 0

    def variables(self, data: bytes) -> dict[str, Any]:
        """By name: arrays of numbers, texts, lists for cells, dicts for structures, or why a variable is not read."""
        if data[126:128] not in (b"MI", b"IM"):
            raise _damaged()
        self.order = ">" if data[126:128] == b"MI" else "<"
        found: dict[str, Any] = {}
        for kind, start, end in self._elements(data, 128, len(data)):
            self.wanted()
            own, part = data, (kind, start, end)
            if kind == _COMPRESSED:
                own = self._unpacked(data[start:end])
                part = next(self._elements(own, 0, len(own)), (0, 0, 0))
            if part[0] == _MATRIX:
                name, value = self._matrix(own, part[1], part[2], 0)
                if name:  # what has none holds the objects' insides
                    found[name] = value
        return found

    def _unpacked(self, packed: bytes) -> bytes:
        """What a compressed element holds; a part at a time, so that the limit holds before the rest is unpacked."""
        unpacker, whole = zlib.decompressobj(), bytearray()
        for place in range(0, len(packed), _PART):
            rest = packed[place : place + _PART]
            while rest and not unpacker.eof:
                try:
                    part = unpacker.decompress(rest, _PART)
                except zlib.error as error:
                    raise _damaged() from error
                self.unpacked += len(part)
                check_unpacked(self.unpacked)
                whole += part
                rest = unpacker.unconsumed_tail
                self.wanted()
        if not unpacker.eof:
            raise _damaged()
        return bytes(whole)

    def _elements(self, data: bytes, place: int, end: int) -> Iterator[tuple[int, int, int]]:
        """Kind, start and end of each element."""
        while place + 8 <= end:
            self.parts += 1
            if self.parts > 20 * MOST_VARIABLES:
                raise _too_many("parts")
            kind, size = struct.unpack_from(self.order + "II", data, place)
            if kind >> 16:  # a small element: length and data within these eight bytes
                yield kind & 0xFFFF, place + 4, min(place + 4 + (kind >> 16), place + 8)
                place += 8
                continue
            start = place + 8
            if size > end - start:
                raise _damaged()
            yield kind, start, start + size
            place = start + size + (0 if kind == _COMPRESSED else -size % 8)

    def _matrix(self, data: bytes, start: int, end: int, depth: int) -> tuple[str, Any]:
        """Name and value of an array."""
        if depth > 4 * DEEPEST:
            raise refused("the .mat file is nested too deep", hint="Save plain vectors.")
        parts = self._elements(data, start, end)
        flags = next(parts, None)
        if flags is None:
            return "", None
        word = struct.unpack_from(self.order + "I", data, flags[1])[0]
        kind = word & 0xFF
        if kind == _OPAQUE:
            name, _, what = ([_name(data, a, b) for _, a, b in islice(parts, 3)] + [""] * 3)[:3]
            return name, Unreadable(_class(what))
        _, first, last = next(parts, (0, 0, 0))
        dimensions = (last - first) // 4
        if dimensions > _MOST_DIMENSIONS:
            raise _damaged()
        shape = struct.unpack_from(f"{self.order}{dimensions}i", data, first)
        _, first, last = next(parts, (0, 0, 0))
        name = _name(data, first, last)
        if min(shape, default=0) < 0:
            raise _damaged()
        return name, self._value(
            data, parts, (kind, word, prod(shape) if shape else 0, shape), end - start, depth
        )

    def _value(  # noqa: PLR0911
        self, data: bytes, parts: Any, about: tuple[int, int, int, tuple[int, ...]], room: int, depth: int
    ) -> Any:
        kind, word, size, shape = about
        if kind in (_FUNCTION, _SPARSE):
            return Unreadable("a function" if kind == _FUNCTION else "a sparse matrix")
        if kind == _OBJECT:
            _, first, last = next(parts, (0, 0, 0))
            return Unreadable(_class(_name(data, first, last)))
        if kind in (_CELL, _STRUCT):
            if size > room // 8:  # each takes eight bytes at least
                raise _damaged()
            if kind == _CELL:
                return [self._inner(data, part, depth) for part in islice(parts, size)]
            return self._structures(data, parts, size, room, depth)
        self.numbers += 8 * size
        check_unpacked(self.numbers)
        stored, first, last = next(parts, (0, 0, 0))
        if kind == _CHAR:
            return _text(data[first : min(last, first + _LONGEST_NAME)], stored, self.order)
        if word & _COMPLEX:
            return Unreadable("complex numbers")
        if stored not in _STORED:
            return None if not size else Unreadable("of an unknown kind")
        dtype = np.dtype(self.order + _STORED[stored])
        if last - first != size * dtype.itemsize:  # before the numbers are widened
            raise _damaged()
        flat = np.frombuffer(data, dtype, size, first)
        return flat.astype(np.float64).reshape(shape, order="F")

    def _structures(self, data: bytes, parts: Any, size: int, room: int, depth: int) -> Any:
        _, first, last = next(parts, (0, 0, 0))
        width = struct.unpack_from(self.order + "i", data, first)[0] if last - first >= 4 else 0
        _, first, last = next(parts, (0, 0, 0))
        if width <= 0 or last == first:
            return None
        count = -(-(last - first) // width)
        if count > MOST_VARIABLES:
            raise _too_many("fields")
        if count * size > room // 8:
            raise _damaged()
        names = [_name(data, place, place + width) for place in range(first, last, width)]
        found = [
            {key: self._inner(data, next(parts, (0, 0, 0)), depth) for key in names} for _ in range(size)
        ]
        return found[0] if size == 1 else found

    def _inner(self, data: bytes, part: tuple[int, int, int], depth: int) -> Any:
        kind, first, last = part
        return self._matrix(data, first, last, depth + 1)[1] if kind == _MATRIX else None


def _text(data: bytes, stored: int, order: str) -> str:
    wide = {4: "utf-16", 17: "utf-16", 18: "utf-32"}.get(stored)
    coding = f"{wide}-{'le' if order == '<' else 'be'}" if wide else "utf-8"
    return data.decode(coding, errors="replace")


def _name(data: bytes, first: int, last: int) -> str:
    return data[first : min(last, first + _LONGEST_NAME)].partition(b"\0")[0].decode("latin-1")


def _class(name: str) -> str:
    return f"MATLAB's {name}" if name.isidentifier() else "an object"
