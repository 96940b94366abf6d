"""Recordings as files: CSV in its dialects and MATLAB's .mat, read into tables within fixed limits; CSV written."""

from __future__ import annotations

import csv
import io
import struct
import zlib
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from .errors import RecordingError
from .recordings import Table
from .signals import Floats

MOST_BYTES = 32 * 2**20
MOST_UNPACKED = 128 * 2**20
"""Bytes of a .mat file's variables after decompression."""
MOST_ROWS = 300_000
MOST_COLUMNS = 64
_EMPTY = ("", "nan", "na", "null", "none")


def read_table(data: bytes, name: str = "") -> Table:
    """A file's columns: .mat by its first bytes, all else as text.

    Raises:
        RecordingError: the file is too large, of another kind, or malformed; it names row and column.
    """
    if not data:
        raise RecordingError("the file is empty", field="file", value=name)
    if len(data) > MOST_BYTES:
        raise RecordingError(
            f"the file has {len(data) / 2**20:.0f} MiB",
            field="file",
            value=name,
            hint=f"At most {MOST_BYTES // 2**20} MiB are read: keep every second or tenth row.",
        )
    if data.startswith(b"\x89HDF") or b"MATLAB 7.3" in data[:128]:
        raise RecordingError(
            "the file is a .mat of version 7.3",
            field="file",
            value=name,
            hint="Save it again with save(…, '-v7').",
        )
    if data.startswith(b"MATLAB 5.0") or name.lower().endswith(".mat"):
        return _mat(data, name)
    return _csv(data, name)


def write_csv(columns: Mapping[str, Floats], comments: tuple[str, ...] = ()) -> bytes:
    """Columns of equal length as CSV, with their names and with comments (#) above."""
    out = io.StringIO()
    for line in comments:
        out.write(f"# {line}\n")
    out.write(",".join(columns) + "\n")
    np.savetxt(out, np.column_stack(list(columns.values())), fmt="%.9g", delimiter=",")
    return out.getvalue().encode()


def _csv(data: bytes, name: str) -> Table:
    try:
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    if "\0" in text:
        raise RecordingError(
            "the file is no text", field="file", value=name, hint="Give a CSV or a .mat file."
        )
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if _counts(line)]
    if not lines:
        raise RecordingError("the file holds no rows", field="file", value=name)
    separator = _separator(lines[0][1])
    comma = separator != "," and any("," in line for _, line in lines[1:3])
    cells = [_split(line, separator) for _, line in lines[:2]]
    headed = any(_number(cell, comma) is None for cell in cells[0])
    names = _unique(cells[0]) if headed else [f"column {i}" for i in range(1, len(cells[0]) + 1)]
    body = lines[1:] if headed else lines
    _check_size(len(body), len(names))
    values = np.array([_row(number, line, separator, names, comma) for number, line in body], dtype=float)
    return Table(tuple(names), values.reshape(len(body), len(names)), body[0][0] if body else 1)


def _counts(line: str) -> bool:
    return bool(line.strip()) and line.lstrip()[0] not in "#%"


def _separator(line: str) -> str | None:
    """The separator that splits the line into most cells; None is any white space."""
    return max((";", "\t", ",", None), key=lambda mark: len(_split(line, mark)))


def _split(line: str, separator: str | None) -> list[str]:
    if separator is None:
        return line.split()
    if '"' in line:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
    return [cell.strip() for cell in line.split(separator)]


def _number(cell: str, comma: bool) -> float | None:
    if cell.lower() in _EMPTY:
        return float("nan")
    try:
        return float(cell.replace(",", ".") if comma else cell)
    except ValueError:
        return None


def _row(number: int, line: str, separator: str | None, names: list[str], comma: bool) -> list[float]:
    cells = _split(line, separator)
    if len(cells) == len(names) + 1 and not cells[-1]:
        cells.pop()  # a separator at the end of each line
    if len(cells) != len(names):
        raise RecordingError(
            f"row {number} has {len(cells)} cells and the first one {len(names)}",
            field="file",
            value=line[:100],
            hint="Give every row as many cells as there are columns.",
        )
    row = []
    for cell, name in zip(cells, names, strict=True):
        value = _number(cell, comma)
        if value is None:
            raise RecordingError(
                f"row {number}, column {name!r} holds {cell[:40]!r}, not a number",
                field="file",
                value=cell[:100],
                hint="Correct the file; empty cells may stay empty.",
            )
        row.append(value)
    return row


def _unique(names: list[str]) -> list[str]:
    seen: Counter[str] = Counter()
    result = []
    for place, given in enumerate(names, 1):
        name = given[:60] or f"column {place}"
        seen[name] += 1
        result.append(name if seen[name] == 1 else f"{name} ({seen[name]})")
    return result


def _check_size(rows: int, columns: int) -> None:
    for count, most, what in ((rows, MOST_ROWS, "rows"), (columns, MOST_COLUMNS, "columns")):
        if count > most:
            raise RecordingError(
                f"{count} {what} are too many", field="file", value=count, hint=f"At most {most}."
            )


def _mat(data: bytes, name: str) -> Table:
    from scipy.io import loadmat, whosmat

    _check_unpacked(data, name)
    try:
        for variable, shape, _ in whosmat(io.BytesIO(data)):
            if np.prod(shape, dtype=float) > MOST_UNPACKED / 8:
                raise RecordingError(f"the variable {variable!r} is too large", field="file", value=variable)
        content = loadmat(io.BytesIO(data), simplify_cells=True)
    except RecordingError:
        raise
    except Exception as error:  # its reader raises whatever the bytes provoke
        raise RecordingError(
            "the .mat file is damaged or of an unknown version",
            field="file",
            value=name,
            hint="Save it again with save(…, '-v7').",
        ) from error
    found = [
        item for key, value in content.items() if not key.startswith("__") for item in _vectors(key, value)
    ]
    lengths = Counter(len(values) for _, values in found if len(values) > 1)
    if not lengths:
        raise RecordingError("the .mat file holds no columns of numbers", field="file", value=name)
    rows = max(lengths, key=lambda length: lengths[length] * length)
    kept = [(label, values) for label, values in found if len(values) == rows]
    _check_size(rows, len(kept))
    return Table(
        tuple(_unique([label for label, _ in kept])), np.column_stack([values for _, values in kept])
    )


def _check_unpacked(data: bytes, name: str) -> None:
    """Refuses what would fill the memory: the sizes of a compressed file's variables are only known unpacked."""
    order = ">" if data[126:128] == b"MI" else "<"
    place, total = 128, 0
    while data.startswith(b"MATLAB 5.0") and place + 8 <= len(data):
        kind, size = struct.unpack_from(order + "II", data, place)
        if kind == 15:  # miCOMPRESSED
            unpacker, rest = zlib.decompressobj(), data[place + 8 : place + 8 + size]
            while rest and total <= MOST_UNPACKED:
                try:
                    total += len(unpacker.decompress(rest, 2**20))
                except zlib.error as error:
                    raise RecordingError("the .mat file is damaged", field="file", value=name) from error
                rest = unpacker.unconsumed_tail
        if total > MOST_UNPACKED:
            raise RecordingError(
                "the .mat file is too large when unpacked",
                field="file",
                value=name,
                hint=f"At most {MOST_UNPACKED // 2**20} MiB.",
            )
        place += 8 + size


def _vectors(name: str, value: Any, depth: int = 0) -> Iterator[tuple[str, Floats]]:
    """Columns of numbers within a variable: vectors, matrices either way up, structs, Simulink's logged signals."""
    if depth > 6:
        return
    if isinstance(value, dict):
        label = value.get("label")
        for key, item in value.items():
            own = label if key == "values" and isinstance(label, str) and label else f"{name}.{key}"
            yield from _vectors(name if key == "signals" else own, item, depth + 1)
    elif isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object):
        for place, item in enumerate(value, 1):
            yield from _vectors(f"{name}{place}", item, depth + 1)
    elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub" and value.ndim in (1, 2):
        if value.ndim == 1:
            yield name, value.astype(float)
        else:
            columns = value.T if value.shape[0] < value.shape[1] else value
            for place, column in enumerate(columns.T[:MOST_COLUMNS], 1):
                yield (name if columns.shape[1] == 1 else f"{name}({place})"), column.astype(float)
