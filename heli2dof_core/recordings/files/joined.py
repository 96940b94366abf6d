"""Several files of one run, one signal each, as one table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import PurePath

import numpy as np

from ...findings import merged
from ..guess import guess_columns, role_of
from ..recording import Table
from ..time_axis import likely_unit
from ..units import SECONDS
from .limits import refused
from .variables import Series, table_of_series

MOST_FILES = 16


def joined_tables(tables: Sequence[tuple[str, Table]]) -> Table:
    """Files by name as one table; where each has a time of its own, the signals are brought to the finest, in s.

    A file with one signal gives it the file's name, unless the column's own name says what it is.

    Raises:
        RecordingError: there are too many, or they have neither times nor equally many rows.
    """
    if not tables:
        raise refused("no file is given", hint="Give one file, or one per signal.")
    if len(tables) == 1:
        return tables[0][1]
    if len(tables) > MOST_FILES:
        raise refused(f"{len(tables)} files are too many", len(tables), f"At most {MOST_FILES} are joined.")
    series: list[Series] = []
    units: dict[str, str] = {}
    for name, table in tables:
        series += _series(PurePath(name.replace("\\", "/")).stem or "file", table, units, series)
    untimed = {len(s.values) for s in series if s.time is None}
    timed = any(s.time is not None for s in series)
    if len(untimed) > 1 or (untimed and timed and untimed != {len(s.values) for s in series}):
        raise refused(
            "the files have neither a time each nor equally many rows",
            [f"{name}: {len(table.values)} rows" for name, table in tables],
            "Give every file a column of time.",
        )
    own = table_of_series(series, [], "files")
    findings = merged(*(table.findings for _, table in tables), own.findings)
    kept = {name: units[name] for name in own.names if name in units}
    if own.time:
        kept[own.time] = "s"
    return replace(own, units=kept, findings=findings)


def _series(stem: str, table: Table, units: dict[str, str], before: list[Series]) -> list[Series]:
    guess = guess_columns(table).names
    time_name = guess.get("time") or _rising(table)
    time = None
    if time_name:
        raw = table.values[:, table.names.index(time_name)]
        time = raw * SECONDS[table.unit(time_name, "time") or likely_unit(raw)]
    signals = [name for name in table.names if name != time_name]
    taken = {s.name for s in before}
    found = []
    for name in signals:
        own = name
        if role_of(name) is None or name in taken:
            own = stem if len(signals) == 1 else f"{stem}.{name}"
        while own in taken:
            own += "'"
        taken.add(own)
        kinds = ("angle", "voltage", "time")
        unit = table.units.get(name) or next((u for kind in kinds if (u := table.unit(name, kind))), None)
        if unit:
            units[own] = unit
        values = table.values[:, table.names.index(name)]
        if time is None:
            found.append(Series(own, values))
        else:
            kept = np.isfinite(values) & np.isfinite(time)
            found.append(Series(own, values[kept], time[kept], "time"))
    return found


def _rising(table: Table) -> str | None:
    """A first column without a telling name whose numbers only rise is the time, where others stand beside it."""
    first = table.values[:, 0]
    if len(table.names) < 2 or len(first) < 2 or role_of(table.names[0]) not in (None, "time"):
        return None
    return table.names[0] if bool(np.all(np.diff(first) > 0)) else None
