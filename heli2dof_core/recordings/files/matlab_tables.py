"""MATLAB's tables and timetables, by mat-io where it is installed (extra `matlab`), in a process of its own.

They are objects, kept in MATLAB's undocumented way. mat-io reads through SciPy, whose reader ends the whole process
on some damaged files: so it has one that may end, with little memory and little time.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import Wanted
from .limits import MOST_UNPACKED
from .variables import Unreadable

READ = ("MATLAB's table", "MATLAB's timetable")
"""What `Unreadable` calls them."""
SECONDS = 20.0
_PROGRAM = """
import sys, warnings
path, out, seconds, size, *names = sys.argv[1:]
try:
    import resource
    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds),) * 2)
    resource.setrlimit(resource.RLIMIT_DATA, (int(size),) * 2)
except ImportError:  # not on Windows
    pass
warnings.simplefilter("ignore")
import numpy as np
from matio import load_from_mat
found = {}
for place, (name, frame) in enumerate(load_from_mat(path, variable_names=names).items()):
    if not hasattr(frame, "columns") or name not in names:
        continue
    columns = dict(frame.items())
    if frame.index.dtype.kind in "mM":
        columns = {"Time": frame.index.to_series(), **columns}
    for column, values in columns.items():
        values = values.to_numpy()
        if values.dtype.kind in "mM":
            unit = "timedelta64[ns]" if values.dtype.kind == "m" else "datetime64[ns]"
            values = values.astype(unit).astype(np.int64) / 1e9
        if values.dtype.kind in "fiub":
            found[f"{names.index(name)}/{column}"] = values
np.savez(out, **found)
"""


def with_tables(content: Mapping[str, Any], data: bytes, wanted: Wanted) -> dict[str, Any]:
    """The same variables with tables and timetables as dicts of their columns, times in seconds.

    What mat-io does not read, or not in time, stays `Unreadable`.

    Args:
        content: the file's variables by name.
        data: the whole file; what it unpacks to has been held against the limits.
        wanted: called now and then; what it raises ends the reading.
    """
    names = [name for name, value in content.items() if isinstance(value, Unreadable) and value.what in READ]
    if not names:
        return dict(content)
    if find_spec("matio") is None:
        hint = "; pip install 'heli2dof[matlab]' reads it"
        return {**content, **{name: Unreadable(content[name].what + hint) for name in names}}
    return {**content, **_read(names, data, wanted)}


def _read(names: list[str], data: bytes, wanted: Wanted) -> dict[str, dict[str, Any]]:
    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder, "recording.mat"), Path(folder, "tables.npz")
        path.write_bytes(data)
        numbers = (str(int(SECONDS)), str(8 * MOST_UNPACKED))
        command = [sys.executable, "-I", "-c", _PROGRAM, str(path), str(out), *numbers, *names]
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            _wait(child, wanted)
        finally:
            child.kill()
            child.wait()
        if child.returncode != 0 or not out.is_file():
            return {}
        with np.load(out) as found:
            tables: dict[str, dict[str, Any]] = {}
            for key in found:
                place, _, column = key.partition("/")
                tables.setdefault(names[int(place)], {})[column] = found[key]
        return tables


def _wait(child: subprocess.Popen[bytes], wanted: Wanted) -> None:
    end = time.monotonic() + 2 * SECONDS
    while child.poll() is None and time.monotonic() < end:
        wanted()
        try:
            child.wait(0.1)
        except subprocess.TimeoutExpired:
            continue
