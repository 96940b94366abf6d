"""A recording by its path, in one call."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from ..guess import guess_columns
from ..recording import Columns, Recording, recording_of
from . import Dialect, read_files


def read_recording(
    *paths: str | Path, columns: Columns | None = None, dialect: Dialect | None = None, **changes: Any
) -> Recording:
    """What a rig did, of one file or of several with a signal each; columns and units by their names.

    >>> read_recording("run.csv", time_unit="ms", units={"psi": "deg"})  # doctest: +SKIP

    Args:
        paths: CSV, .xlsx, .mat, HDF5, Octave's text, JSON.
        columns: which column is what; guessed by default.
        dialect: of text; judged by default.
        changes: fields of `Columns` to change in the guess; `names` adds to the guessed ones.

    Raises:
        RecordingError: a file cannot be read, a role has no column, or the times cannot be a rig's.
    """
    table = read_files(paths, dialect)
    chosen = columns or guess_columns(table)
    if "names" in changes:
        changes["names"] = {**chosen.names, **changes["names"]}
    return recording_of(table, replace(chosen, **changes) if changes else chosen)
