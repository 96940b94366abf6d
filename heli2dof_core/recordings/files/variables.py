"""Variables of a workspace as a table: vectors, matrices either way up, [t; value] arrays, structures with time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...findings import Finding
from ...frozen import Frozen
from ...signals import Floats
from ..guess import role_of
from ..recording import FEWEST_SAMPLES, Table
from .grid import left_out_finding, unique_names
from .limits import DEEPEST, MOST_COLUMNS, check_size, refused


@dataclass(frozen=True)
class Unreadable:
    """A variable that is known but cannot be read; `what` names its kind."""

    what: str


@dataclass(eq=False)
class Series(Frozen):
    """One signal.

    Attributes:
        name: of the column that it becomes.
        values: (n,).
        time: of its samples, where it came with them, (n,).
        time_name: of that column.
    """

    name: str
    values: Floats
    time: Floats | None = None
    time_name: str = ""


@dataclass
class _Found:
    series: list[Series] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)


def table_of_variables(content: Mapping[str, Any], kind: str) -> Table:
    """The table in a workspace: dicts are structures, lists cells, arrays numbers.

    Raises:
        RecordingError: it holds no columns of numbers.
    """
    found = _Found()
    for name, value in content.items():
        _collect(name, value, found)
    return table_of_series(found.series, found.left_out, kind)


def table_of_series(series: list[Series], left_out: list[str], kind: str) -> Table:
    """Signals as the columns of one table: on the time that they share, interpolated on it where they do not.

    Raises:
        RecordingError: there are none, or their times do not overlap.
    """
    timed = [s for s in series if s.time is not None and len(s.values) > 1]
    bare = [s for s in series if s.time is None and len(s.values) > 1]
    lengths = Counter(len(s.values) for s in bare)
    rows = max(lengths, key=lambda n: lengths[n] * n, default=0)
    findings: list[Finding] = []
    if timed and sum(len(s.values) for s in timed) >= rows * lengths[rows]:
        columns, time = _on_one_time(timed, findings)
        rows = len(columns[0].values)
        columns += [s for s in bare if len(s.values) == rows]
    else:
        columns, time = [], None
        for s in bare:
            if len(s.values) == rows:
                columns.append(s)
            elif len(s.values) == rows + 1 and lengths[rows] > 1:
                columns.append(Series(s.name, s.values[:rows]))
                words = f"{s.name!r} has {rows + 1} rows, the others {rows}: its last one is left out."
                findings.append(Finding("one_row_longer", "warning", words))
        # What carries its own time may still have the others' length.
        columns += [s for s in timed if len(s.values) == rows]
    kept = {s.name for s in columns}
    others = [s for s in (*bare, *timed) if s.name not in kept and len(s.values) >= FEWEST_SAMPLES]
    left_out = left_out + [f"{s.name} ({len(s.values)} rows)" for s in others]
    if not columns:
        named = f": {', '.join(left_out[:8])}" if left_out else ""
        raise refused(
            f"the {kind} holds no columns of numbers{named}",
            hint="Save time, angles and voltages as vectors of numbers. In MATLAB: a timetable T by "
            "writetimetable(T, 'run.csv'), a timeseries x as [x.Time, x.Data].",
        )
    columns = columns[:MOST_COLUMNS] if len(columns) > MOST_COLUMNS else columns
    check_size(rows, len(columns))
    names = unique_names([s.name for s in columns])
    return Table(
        tuple(names),
        np.column_stack([s.values for s in columns]),
        time=names[columns.index(time)] if time else None,
        findings=(*findings, *left_out_finding(left_out)),
    )


def _on_one_time(timed: list[Series], findings: list[Finding]) -> tuple[list[Series], Series | None]:
    """The time that all share, first, and the signals on it."""
    axes: list[Floats] = []
    for s in timed:
        assert s.time is not None
        if not any(
            len(s.time) == len(axis) and np.allclose(s.time, axis, rtol=0, atol=1e-9) for axis in axes
        ):
            axes.append(s.time)
    base = max(axes, key=len)
    if len(axes) == 1:
        time = Series(next(s.time_name for s in timed), base)
        return [time, *timed], time
    low, high = max(float(axis[0]) for axis in axes), min(float(axis[-1]) for axis in axes)
    base = base[(base >= low) & (base <= high)]
    if len(base) < FEWEST_SAMPLES:
        raise refused(
            "the signals' times do not overlap", hint="Join files of one run, with times of one clock."
        )
    time = Series("time", base)
    words = f"The signals have {len(axes)} different times and were brought to the finest (voltages held)."
    findings.append(Finding("joined_times", "warning", words))
    return [time, *(Series(s.name, _resampled(s, base)) for s in timed)], time


def _resampled(s: Series, t: Floats) -> Floats:
    assert s.time is not None
    if role_of(s.name) in ("V_p", "V_y", "theta_ref", "psi_ref"):
        return s.values[np.clip(np.searchsorted(s.time, t + 1e-9, side="right") - 1, 0, None)]
    return np.interp(t, s.time, s.values)


def _collect(name: str, value: Any, found: _Found, depth: int = 0) -> None:
    if depth > DEEPEST or len(found.series) > 4 * MOST_COLUMNS:
        return
    if isinstance(value, Unreadable):
        found.left_out.append(f"{name} ({value.what})")
    elif isinstance(value, Mapping):
        _structure(name, value, found, depth)
    elif isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object):
        items = list(np.ravel(value)) if isinstance(value, np.ndarray) else value
        if len(items) > FEWEST_SAMPLES and all(isinstance(item, int | float) for item in items):
            found.series.append(Series(name, np.array(items, dtype=np.float64)))
        elif len(items) > FEWEST_SAMPLES and all(isinstance(item, int | float | None) for item in items):
            found.series.append(
                Series(name, np.array([np.nan if v is None else v for v in items], dtype=np.float64))
            )
        elif items and isinstance(items[0], list) and len(items) >= 2:
            _collect_rows(name, items, found, depth)
        else:
            for place, item in enumerate(items[: 4 * MOST_COLUMNS], 1):
                _collect(f"{name}{place}", item, found, depth + 1)
    elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub" and value.size > 1:
        found.series += list(_series(name, value.astype(np.float64)))


def _collect_rows(name: str, items: list[Any], found: _Found, depth: int) -> None:
    """Lists of equally long lists of numbers are a matrix."""
    try:
        matrix = np.array(items, dtype=np.float64)
    except (ValueError, TypeError):
        for place, item in enumerate(items[: 4 * MOST_COLUMNS], 1):
            _collect(f"{name}{place}", item, found, depth + 1)
        return
    if matrix.ndim == 2:
        found.series += list(_series(name, matrix))


def _structure(name: str, value: Mapping[str, Any], found: _Found, depth: int) -> None:
    keys = {key.lower(): key for key in value}
    time = next((_vector(value[keys[key]]) for key in ("time", "t") if key in keys), None)
    time_name = f"{name}.{keys.get('time', keys.get('t', 'time'))}"
    if time is not None and "signals" in keys:
        for s in _signals(name, value[keys["signals"]]):
            _add_timed(s, time, time_name, found)
        return
    if time is not None and ("data" in keys or "values" in keys):
        data = value[keys.get("data", keys.get("values", ""))]
        label = value.get(keys.get("name", ""), "")
        own = label if isinstance(label, str) and label.strip() else name
        if isinstance(data, np.ndarray):
            for s in _series(own, data, plain=True):
                _add_timed(s, time, time_name, found)
            return
    before = len(found.series)
    for key, item in value.items():
        _collect(f"{name}.{key}", item, found, depth + 1)
    if time is not None:
        for s in found.series[before:]:
            if s.time is None and s.name != time_name and len(s.values) == len(time):
                s.time, s.time_name = time, time_name
        found.series[before:] = [
            s for s in found.series[before:] if s.name != time_name or s.time is not None
        ]


def _signals(name: str, signals: Any) -> Iterator[Series]:
    """The signals of a structure with time: one, a list of them, or a structure of lists."""
    if isinstance(signals, np.ndarray) and signals.dtype == object:
        signals = list(signals.ravel())
    if isinstance(signals, Mapping) and isinstance(signals.get("values"), list):
        count = len(signals["values"])
        signals = [
            {key: item[i] for key, item in signals.items() if isinstance(item, list) and len(item) == count}
            for i in range(count)
        ]
    several = isinstance(signals, list)
    for place, signal in enumerate(signals if several else [signals], 1):
        if not isinstance(signal, Mapping) or not isinstance(signal.get("values"), np.ndarray):
            continue
        label = signal.get("label")
        usual = f"{name}{place}" if several else name
        own = label.strip() if isinstance(label, str) and label.strip() else usual
        yield from _series(own, signal["values"], plain=True)


def _add_timed(s: Series, time: Floats, time_name: str, found: _Found) -> None:
    if len(s.values) == len(time):
        s.time, s.time_name = time, time_name
    found.series.append(s)


def _vector(value: Any) -> Floats | None:
    if isinstance(value, list) and len(value) > 1 and all(isinstance(item, int | float) for item in value):
        value = np.array(value, dtype=np.float64)
    if (
        isinstance(value, np.ndarray)
        and value.dtype.kind in "fiu"
        and value.size == max((1, *value.shape)) > 1
    ):
        return value.astype(np.float64).ravel()
    return None


def _series(name: str, values: Any, *, plain: bool = False) -> Iterator[Series]:
    """The columns of an array. Unless `plain`, a first column that only rises is the time of the others."""
    if values.dtype.kind not in "fiub":
        return
    values = np.squeeze(values.astype(np.float64))
    if values.ndim == 1:
        yield Series(name, values)
    if values.ndim != 2:
        return
    columns = values.T if values.shape[0] < values.shape[1] else values
    rows, count = columns.shape
    names = [f"{name}({place})" for place in range(1, min(count, MOST_COLUMNS) + 1)]
    if not plain and rows >= FEWEST_SAMPLES and np.all(np.diff(columns[:, 0]) > 0):
        names = names if count > 2 else [f"{name}.time", name]
        for own, column in zip(names[1:], columns.T[1:], strict=False):
            yield Series(own, column.copy(), columns[:, 0].copy(), names[0])
        return
    for own, column in zip(names, columns.T, strict=False):
        yield Series(own, column.copy())
