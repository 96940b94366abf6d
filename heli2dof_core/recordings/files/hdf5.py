"""HDF5: MATLAB's files of version 7.3, Octave's save -hdf5, and files with plain data sets."""

from __future__ import annotations

import io
from math import prod
from typing import Any

import numpy as np

from ...errors import Heli2DofError, Wanted
from ..recording import Table
from .limits import DEEPEST, MOST_VARIABLES, check_unpacked, refused
from .matlab_tables import with_tables
from .variables import Unreadable, table_of_variables

MARK = b"\x89HDF\r\n\x1a\n"
_INNER = ("#refs#", "#subsystem#")
_MOST_RANGE = 1_000_000


def read_hdf5(data: bytes, name: str, wanted: Wanted) -> Table:
    """The table in an HDF5 file; sizes are checked before anything is unpacked.

    Raises:
        RecordingError: it is damaged, too large once unpacked, or holds no columns.
    """
    import h5py

    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            content = _Reader(h5py, file, wanted).content()
    except Heli2DofError:
        raise
    except Exception as error:  # the library raises whatever the bytes provoke
        raise refused(
            "the HDF5 file is damaged or of an unknown kind",
            name,
            "Save it again, in MATLAB with save(…, '-v7').",
        ) from error
    return table_of_variables(with_tables(content, data, wanted), "HDF5 file")


class _Reader:
    """Reads one open file; links out of it are not followed."""

    def __init__(self, h5py: Any, file: Any, wanted: Wanted) -> None:
        self.h5py, self.file, self.wanted = h5py, file, wanted
        self.unpacked = self.parts = 0

    def content(self) -> dict[str, Any]:
        """The file's variables."""
        return {key: self._read(item, 0) for key, item in self._items(self.file)}

    def _items(self, group: Any) -> list[tuple[str, Any]]:
        links = [(key, group.get(key, getlink=True)) for key in group if key not in _INNER]
        if len(links) > MOST_VARIABLES:
            raise refused("the file holds too many variables", hint="Save only those of the recording.")
        hard = self.h5py.HardLink
        return [(key, group[key] if isinstance(link, hard) else None) for key, link in links]

    def _read(self, item: Any, depth: int) -> Any:
        self.parts += 1
        self.wanted()
        if item is None:
            return Unreadable("a link")
        if depth > 3 * DEEPEST or self.parts > MOST_VARIABLES:
            return Unreadable("nested too deep")
        octave = "OCTAVE_NEW_FORMAT" in item.attrs
        if isinstance(item, self.h5py.Group):
            if octave:
                return self._octave(item, depth)
            return {key: self._read(child, depth + 1) for key, child in self._items(item)}
        return self._data(item, depth) if isinstance(item, self.h5py.Dataset) else Unreadable("a type")

    def _data(self, data: Any, depth: int) -> Any:
        kind = _text(data.attrs.get("MATLAB_class", b""))
        if "MATLAB_object_decode" in data.attrs or kind in (
            "function_handle",
            "string",
            "table",
            "timetable",
        ):
            return Unreadable(f"MATLAB's {kind}" if kind.isidentifier() else "an object")
        if data.attrs.get("MATLAB_empty", 0):
            return None
        values = self._values(data)
        if isinstance(values, Unreadable | str):
            return values
        if values.dtype == object:
            read = [self._of_reference(ref, depth) for ref in values.ravel()]
            return read[0] if len(read) == 1 and kind != "cell" else read
        if kind == "char":
            return "".join(map(chr, values.ravel().tolist()[:200]))
        return values.T if kind else values  # MATLAB's come with their dimensions turned round

    def _of_reference(self, reference: Any, depth: int) -> Any:
        if not isinstance(reference, self.h5py.Reference) or not reference:
            return None
        return self._read(self.file[reference], depth + 1)

    def _values(self, data: Any) -> Any:
        """A data set's numbers or references, where it lies within the file and is not too large."""
        if data.is_virtual or data.external:
            return Unreadable("stored in another file")
        dtype = data.dtype
        each = max(8, dtype.itemsize)
        self.unpacked += each * int(data.size or 0)
        check_unpacked(self.unpacked + each * prod(data.chunks or ()), data.name)  # unpacked as a whole, each
        if self.h5py.check_string_dtype(dtype) or dtype.kind == "S":
            return Unreadable("text") if data.shape else _text(data[()])
        if dtype.kind == "O":
            return data[()] if self.h5py.check_ref_dtype(dtype) else Unreadable("no numbers")
        if dtype.names:
            values = _Compound(data).read()
            if not isinstance(values, Unreadable):
                self.unpacked += values.nbytes
                check_unpacked(self.unpacked, data.name)
            return values
        return np.asarray(data[()]) if dtype.kind in "fiub" else Unreadable("no numbers")

    def _octave(self, group: Any, depth: int) -> Any:
        kind = _text(group["type"][()])
        if "OCTAVE_EMPTY_MATRIX" in group.attrs:
            return None
        value = group["value"]
        if kind in ("struct", "scalar struct"):
            return {key: self._read(child, depth + 1) for key, child in self._items(value)}
        if kind == "cell":
            keys = sorted((key for key in value if key.startswith("_")), key=lambda key: int(key[1:]))
            return [self._read(value[key], depth + 1) for key in keys[:MOST_VARIABLES]]
        if "string" in kind:
            return "".join(chr(code & 0xFF) for code in np.ravel(self._values(value)).tolist()[:200])
        if not isinstance(value, self.h5py.Dataset):
            return Unreadable(kind)
        values = self._values(value)
        return values.T if isinstance(values, np.ndarray) else values


class _Compound:
    """A record: Octave keeps an unmodified range as base, limit and increment."""

    def __init__(self, data: Any) -> None:
        self.data = data

    def read(self) -> Any:
        """The range's numbers, or why there are none."""
        names = set(self.data.dtype.names)
        if {"real", "imag"} <= names:
            return Unreadable("complex numbers")
        if not {"base", "limit", "increment"} <= names or self.data.shape:
            return Unreadable("records")
        record = self.data[()]
        count = self.data.attrs.get("OCTAVE_RANGE_NELEM")
        base, limit, step = (float(record[key]) for key in ("base", "limit", "increment"))
        return range_of(base, limit, step, None if count is None else int(count))


def range_of(base: float, limit: float, step: float, count: int | None = None) -> np.ndarray:
    """Octave's range base : step : limit.

    Raises:
        RecordingError: it has too many elements.
    """
    if count is None:
        count = int(np.floor((limit - base) / step * (1 + 1e-15) + 1e-10)) + 1 if step else 0
    if count > _MOST_RANGE:
        raise refused(f"a range of {count} numbers is too long", hint="Save the recording's own times.")
    return base + step * np.arange(max(0, count))


def _text(value: Any) -> str:
    return value.decode("utf-8", errors="replace") if isinstance(value, bytes) else str(value)
