"""MATLAB's files up to version 7, checked for what they would unpack to before SciPy reads them."""

from __future__ import annotations

import io
import struct
import warnings
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np

from ..errors import RecordingError
from ..recordings import Table
from .limits import DEEPEST, MOST_UNPACKED, MOST_VARIABLES, Wanted, check_unpacked, refused
from .variables import Unreadable, table_of_variables

_MATRIX, _COMPRESSED = 14, 15
_CELL, _STRUCT, _OBJECT, _CHAR, _SPARSE, _FUNCTION, _OPAQUE = 1, 2, 3, 4, 5, 16, 17
_UNREAD = {_OBJECT: "an object", _SPARSE: "a sparse matrix", _FUNCTION: "a function", _OPAQUE: "an object"}
_PART = 2**18
_DAMAGED = "Save it again with save(…, '-v7')."


def is_v4(data: bytes) -> bool:
    """Whether the bytes begin as a .mat of version 4, which has no mark: a plausible header, and room for its data."""
    return any(_v4_variable(data, 0, order) is not None for order in "<>")


def read_mat(data: bytes, name: str, wanted: Wanted) -> Table:
    """The table in a .mat of version 4 to 7.

    Raises:
        RecordingError: it is damaged, too large once unpacked, or holds no columns.
    """
    from scipy.io import loadmat

    try:
        if data.startswith(b"MATLAB") or not is_v4(data):
            known = _Walk(wanted).variables(data)
        else:
            known = [_Variable(own, 0) for own in _v4_names(data)]
        wanted()
        names = [v.name for v in known if not v.unread and v.name]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            content = loadmat(
                io.BytesIO(data),
                simplify_cells=True,
                variable_names=names,
                verify_compressed_data_integrity=False,
            )
    except RecordingError:
        raise
    except Exception as error:  # its reader raises whatever the bytes provoke
        raise refused("the .mat file is damaged or of an unknown version", name, _DAMAGED) from error
    values: dict[str, Any] = {
        key: _readable(value) for key, value in content.items() if not key.startswith("__")
    }
    values |= {v.name: Unreadable(v.unread) for v in known if v.unread and v.name}
    return table_of_variables(values, ".mat file")


def _readable(value: Any, depth: int = 0) -> Any:
    """SciPy's values as dicts, lists and arrays; what it could not read is named."""
    if depth > DEEPEST:
        return None
    if isinstance(value, dict):
        return {str(key): _readable(item, depth + 1) for key, item in value.items()}
    if isinstance(value, np.ndarray) and value.dtype.names:
        known = value.dtype.names[:3] == ("s0", "s1", "s2") and value.size
        return Unreadable(_class(value.ravel()[0]["s2"]) if known else "an object")
    if isinstance(value, np.ndarray) and value.dtype == object:
        return [_readable(item, depth + 1) for item in value.ravel()]
    if isinstance(value, list):
        return [_readable(item, depth + 1) for item in value]
    if isinstance(value, np.ndarray) and value.dtype.kind == "c":
        return Unreadable("complex numbers")
    return value


def _class(name: Any) -> str:
    text = name.decode("latin-1") if isinstance(name, bytes) else str(name)
    return f"MATLAB's {text}" if text.isidentifier() else "an object"


@dataclass(frozen=True)
class _Variable:
    name: str
    size: int
    unread: str = ""


def _v4_variable(data: bytes, place: int, order: str) -> tuple[_Variable, int] | None:
    if place + 20 > len(data):
        return None
    kind, rows, columns, imaginary, length = struct.unpack_from(order + "5i", data, place)
    machine, zero, precision, matrix = kind // 1000, kind // 100 % 10, kind // 10 % 10, kind % 10
    if not (0 <= kind < 5000 and machine == (order == ">") and zero == 0 and precision < 6 and matrix < 3):
        return None
    if min(rows, columns) < 0 or imaginary not in (0, 1) or not 1 <= length <= 64:
        return None
    size = rows * columns * (8, 4, 4, 2, 2, 1)[precision] * (1 + imaginary)
    end = place + 20 + length + size
    own = data[place + 20 : place + 20 + length].rstrip(b"\0")
    if end > len(data) or not own.isascii() or not own.decode().isidentifier():
        return None
    return _Variable(own.decode(), rows * columns * 8), end


def _v4_names(data: bytes) -> list[str]:
    order = "<" if _v4_variable(data, 0, "<") else ">"
    names, place, total = [], 0, 0
    while place < len(data):
        found = _v4_variable(data, place, order)
        if found is None:
            raise refused("the .mat file is damaged", hint=_DAMAGED)
        variable, place = found
        total += variable.size
        check_unpacked(total)
        names.append(variable.name)
    return names


class _Walk:
    """Goes through a file of version 5 to 7 without unpacking more than is allowed, whatever its headers claim."""

    def __init__(self, wanted: Wanted) -> None:
        self.wanted, self.order = wanted, "<"
        self.unpacked = self.numbers = self.parts = 0

    def variables(self, data: bytes) -> list[_Variable]:
        """Names, and what cannot be read."""
        self.order = ">" if data[126:128] == b"MI" else "<"
        if data[126:128] not in (b"MI", b"IM"):
            raise refused("the .mat file is damaged", hint=_DAMAGED)
        found = []
        for kind, start, end in self._elements(data, 128, len(data)):
            self.wanted()
            own, first, last = data, start, end
            if kind == _COMPRESSED:
                own = self._unpacked(data[start:end])
                kind, first, last = next(self._elements(own, 0, len(own)), (0, 0, 0))
            if kind == _MATRIX:
                found.append(self._matrix(own, first, last, 0))
        return found

    def _unpacked(self, packed: bytes) -> bytes:
        unpacker, parts, rest = zlib.decompressobj(), [], packed
        while rest:
            try:
                part = unpacker.decompress(rest, _PART)
            except zlib.error as error:
                raise refused("the .mat file is damaged", hint=_DAMAGED) from error
            if not part:
                break
            self.unpacked += len(part)
            check_unpacked(self.unpacked)
            parts.append(part)
            rest = unpacker.unconsumed_tail
            self.wanted()
        return b"".join(parts)

    def _elements(self, data: bytes, place: int, end: int) -> Iterator[tuple[int, int, int]]:
        """Kind, start and end of each element; a damaged length ends them."""
        while place + 8 <= end:
            self.parts += 1
            if self.parts > 20 * MOST_VARIABLES:
                raise refused(
                    "the .mat file holds too many parts", hint="Save only the variables of the recording."
                )
            kind, size = struct.unpack_from(self.order + "II", data, place)
            if kind >> 16:  # a small element: length and data within these eight bytes
                yield kind & 0xFFFF, place + 4, min(place + 4 + (kind >> 16), place + 8)
                place += 8
                continue
            start = place + 8
            if size > end - start:
                raise refused("the .mat file is damaged", hint=_DAMAGED)
            yield kind, start, start + size
            place = start + size + (0 if kind == _COMPRESSED else -size % 8)

    def _matrix(self, data: bytes, start: int, end: int, depth: int) -> _Variable:
        if depth > 4 * DEEPEST:
            raise refused("the .mat file is nested too deep", hint="Save plain vectors.")
        parts = self._elements(data, start, end)
        flags = next(parts, None)
        if flags is None or flags[2] - flags[1] < 4:
            return _Variable("", 0)
        kind = struct.unpack_from(self.order + "I", data, flags[1])[0] & 0xFF
        if kind == _OPAQUE:
            own, _, what = ([data[a:b] for _, a, b in parts] + [b""] * 3)[:3]
            return _Variable(own.decode("latin-1"), 0, _class(what))
        dims = next(parts, (0, 0, 0))
        count = (dims[2] - dims[1]) // 4
        shape = struct.unpack_from(self.order + f"{count}i", data, dims[1])
        named = next(parts, (0, 0, 0))
        name = data[named[1] : named[2]].decode("latin-1")
        if min(shape, default=0) < 0:
            raise refused("the .mat file is damaged", hint=_DAMAGED)
        if kind in (_FUNCTION, _SPARSE):
            return _Variable(name, 0, _UNREAD[kind])
        size = prod(shape)
        if kind in (_CELL, _STRUCT, _OBJECT):
            # What a cell or a structure claims to hold takes eight bytes each at least.
            if size > (end - start) // 8 + 1:
                raise refused("the .mat file is damaged", hint=_DAMAGED)
            for part, first, last in parts:
                if part == _MATRIX:
                    self._matrix(data, first, last, depth + 1)
            return _Variable(name, size, _UNREAD.get(kind, ""))
        self.numbers += 8 * size
        check_unpacked(self.numbers, name)
        if self.numbers > MOST_UNPACKED or size > 8 * (end - start):
            raise refused("the .mat file is damaged", name, _DAMAGED)
        return _Variable(name, size)
