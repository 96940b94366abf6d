"""Recordings as files: text in its dialects, spreadsheets, MATLAB's, Octave's and HDF5 files, JSON; CSV written."""

from __future__ import annotations

import gzip
import io
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ...errors import Wanted, nobody_leaves
from ...signals import Floats
from ..recording import Table
from .hdf5 import MARK as _HDF5
from .hdf5 import read_hdf5
from .joined import MOST_FILES, joined_tables
from .json_data import is_json, read_json
from .limits import MOST_BYTES, MOST_COLUMNS, MOST_ROWS, MOST_UNPACKED, refused
from .mat import is_v4, read_mat
from .octave import is_octave_text, read_octave
from .sheets import read_sheet
from .text import Dialect, read_text

_KNOWN_OTHERS = (
    (b"Octave-1", "the file is Octave's own binary format", "Save it again with save -v7."),
    (b"\xd0\xcf\x11\xe0", "the file is a spreadsheet of an old kind (.xls)", "Save it as .xlsx or CSV."),
    (b"TDSm", "the file is National Instruments' TDMS", "Export it as CSV."),
    (b"MDF ", "the file is a measurement file (MDF)", "Export it as CSV or .mat."),
    (b"PAR1", "the file is Parquet", "Save it as CSV, in pandas with to_csv."),
    (b"\x93NUMPY", "the file is NumPy's .npy", "Save it as CSV, in NumPy with savetxt."),
    (b"%PDF", "the file is a PDF", "Give the numbers as CSV."),
    (b"SQLite format 3", "the file is a data base", "Export the table as CSV."),
    (b"<", "the file is a web page or XML", "Give the numbers as CSV; of a design, export csv, mat or json."),
)


def read_table(
    data: bytes, name: str = "", dialect: Dialect | None = None, wanted: Wanted = nobody_leaves
) -> Table:
    """A file's columns; its kind is told by its first bytes.

    Args:
        data: the file.
        name: of the file, for messages.
        dialect: separator and decimal mark of text, where they are not to be judged.
        wanted: called now and then; what it raises ends the reading.

    Raises:
        RecordingError: the file is too large, of another kind, or malformed; it names row and column.
    """
    if not data:
        raise refused("the file is empty", name, "Record again, or choose another file.")
    if len(data) > MOST_BYTES:
        raise refused(
            f"the file has {len(data) / 2**20:.0f} MiB",
            name,
            f"At most {MOST_BYTES // 2**20} MiB are read: cut it where it is of interest, keep the columns that are "
            "needed, or write fewer digits.",
        )
    if data[:2] == b"\x1f\x8b":
        return read_table(_gunzipped(data, name), name.removesuffix(".gz"), dialect, wanted)
    return _read(data, name, dialect or Dialect(), wanted)


def _read(data: bytes, name: str, dialect: Dialect, wanted: Wanted) -> Table:
    """The reader of each kind, by the file's first bytes."""
    if data.startswith(_HDF5) or data[512:].startswith(_HDF5):  # MATLAB's begins with 512 bytes of its own
        return read_hdf5(data, name, wanted)
    if data.startswith(b"PK\x03\x04"):
        return read_sheet(data, name, wanted)
    if (
        data.startswith(b"MATLAB")
        or is_v4(data)
        or (name.lower().endswith(".mat") and not is_octave_text(data))
    ):
        return read_mat(data, name, wanted)
    for mark, words, hint in _KNOWN_OTHERS:
        if data.lstrip(b"\xef\xbb\xbf \r\n").startswith(mark):
            raise refused(words, name, hint)
    if is_octave_text(data):
        return read_octave(data, name, wanted)
    if is_json(data):
        return read_json(data, name, wanted)
    return read_text(data, name, dialect, wanted)


def read_files(paths: Sequence[str | Path], dialect: Dialect | None = None) -> Table:
    """One file, or several of one run joined, by their paths.

    Raises:
        RecordingError: a file cannot be opened or read, or they cannot be joined.
    """
    tables = []
    for path in map(Path, paths):
        try:
            if path.stat().st_size > MOST_BYTES:
                read_table(bytes(MOST_BYTES + 1), path.name)
            data = path.read_bytes()
        except OSError as error:
            raise refused(f"cannot read {path}: {error.strerror}", str(path), "Check the path.") from error
        tables.append((path.name, read_table(data, path.name, dialect)))
    return joined_tables(tables)


def write_csv(columns: Mapping[str, Floats], comments: tuple[str, ...] = ()) -> bytes:
    """Columns of equal length as CSV, with their names and with comments (#) above."""
    out = io.StringIO()
    for line in comments:
        out.write(f"# {line}\n")
    out.write(",".join(columns) + "\n")
    np.savetxt(out, np.column_stack(list(columns.values())), fmt="%.9g", delimiter=",")
    return out.getvalue().encode()


def _gunzipped(data: bytes, name: str) -> bytes:
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as file:
            content = file.read(MOST_BYTES + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise refused("the packed file is damaged", name, "Pack it again, or give it unpacked.") from error
    if content[:2] == b"\x1f\x8b":
        raise refused("the file is packed twice", name, "Unpack it.")
    return content


__all__ = [
    "MOST_BYTES",
    "MOST_COLUMNS",
    "MOST_FILES",
    "MOST_ROWS",
    "MOST_UNPACKED",
    "Dialect",
    "joined_tables",
    "read_files",
    "read_table",
    "write_csv",
]
