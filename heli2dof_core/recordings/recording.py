"""Recordings of a rig: columns of a file named and scaled, checked, and kept as arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import pi
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from ..checks import require_one_of, require_within
from ..errors import RecordingError
from ..findings import Finding
from ..frozen import Frozen, read_only
from ..quantities import Quantity, documented, require_valid
from ..signals import Floats
from .time_axis import judged_time, stretches, timing_remarks
from .units import (
    RADIANS,
    SECONDS,
    VOLTS,
    AngleUnit,
    Kind,
    TimeUnit,
    VoltageUnit,
    known_unit,
    split_unit,
)

ROLES = ("time", "theta", "psi", "V_p", "V_y", "theta_ref", "psi_ref")
"""What a column can be; the references may be missing, and time where the sample time is given."""
ANGLES = ("theta", "psi", "theta_ref", "psi_ref")
"""The roles that are angles."""
FEWEST_SAMPLES = 20
MOST_DECIMATED = 1000
MOST_OFFSET = 1e4
"""Largest offset of an angle, in its unit."""
LARGEST = {"rad": 1e3, "deg": 6e4, "V": 1e3, "mV": 1e6}
"""Largest angle and voltage that a recording may hold."""
_TURN = 2 * pi
_NEARLY = 0.25
"""How far from a whole turn a jump may be to be an encoder that begins anew, in turns."""


@dataclass(frozen=True)
class Table(Frozen):
    """A file's columns.

    Attributes:
        names: one per column, unique.
        values: (rows, columns), NaN where a cell is empty.
        first_row: the number that the file's reader would give to row 0: its line, or 1.
        units: of columns, as a row, a comment or a cell of the file names them; what a name holds is not repeated.
        time: the column that the file itself says is the time.
        findings: what was read in a special way, or could not be.
        dialect: how text was read: `separator`, `decimal`; empty for other files.
    """

    names: tuple[str, ...]
    values: Floats
    first_row: int = 1
    units: Mapping[str, str] = field(default_factory=dict)
    time: str | None = None
    findings: tuple[Finding, ...] = ()
    dialect: Mapping[str, str] = field(default_factory=dict)

    def unit(self, name: str, kind: Kind) -> str | None:
        """The unit of a column that measures `kind`, as the file states it."""
        told = known_unit(self.units[name]) if name in self.units else split_unit(name)[1]
        return told[1] if told and told[0] == kind else None

    def column(self, name: str, role: str) -> Floats:
        """A column's values, all finite.

        Raises:
            RecordingError: there is no such column, or a row of it holds no finite number.
        """
        if name not in self.names:
            raise RecordingError(
                f"there is no column {name!r}",
                field=f"columns.{role}",
                value=name,
                hint="Known are " + ", ".join(self.names[:20]) + ".",
            )
        values = self.values[:, self.names.index(name)]
        bad = np.flatnonzero(~np.isfinite(values))
        if len(bad):
            raise self.refused(int(bad[0]), name, role, "is empty or no finite number")
        return values

    def refused(self, row: int, name: str, role: str, words: str, hint: str = "") -> RecordingError:
        """The error that row `row` (from 0) of a column raises."""
        return RecordingError(
            f"row {row + self.first_row}, column {name!r} {words}",
            field=f"columns.{role}",
            value=float(self.values[row, self.names.index(name)]),
            hint=hint or "Correct or delete this row, or choose another column.",
        )


@documented
@dataclass(frozen=True)
class Columns:
    """Which column is what, and how the rig's signs and units become ours.

    An angle of the file is multiplied by its sign, then its offset is added, then it is converted.

    `names` is role → column (see `ROLES`); `signs` are those of the encoders of θ and ψ, ±1, and references take them
    too; `offsets` are added to θ and ψ, in their units: −40.5° where pitch counts from its lower stop; `units` is
    role → unit of angles whose unit is not `unit`, and a reference takes its axis' unit.
    """

    names: dict[str, str]
    unit: Annotated[AngleUnit, Quantity("of the file's angles, references and offsets included")] = "rad"
    signs: tuple[int, int] = (1, 1)
    offsets: tuple[float, float] = (0.0, 0.0)
    sample_time: Annotated[
        float | None, Quantity("time between two rows", "s", 1e-5, 10.0, absent="where no column is the time")
    ] = None
    time_unit: Annotated[
        TimeUnit | None,
        Quantity("of the column of time", absent="what the file states, or s, where left out"),
    ] = None
    units: Mapping[str, AngleUnit] = field(default_factory=dict)
    voltage_unit: Annotated[VoltageUnit, Quantity("of both voltages")] = "V"
    decimate: Annotated[
        int,
        Quantity("of so many rows one is kept, and the voltages between are averaged", "", 1, MOST_DECIMATED),
    ] = 1

    def __post_init__(self) -> None:
        require_valid(self)
        for role, unit in self.units.items():
            require_one_of(unit, AngleUnit, f"units.{role}")
        for sign, axis in zip(self.signs, ("theta", "psi"), strict=True):
            if sign not in (1, -1):
                raise RecordingError(
                    f"the sign of {axis} is {sign!r}, not 1 or -1",
                    field=f"signs.{axis}",
                    value=sign,
                    hint="Give 1, or -1 where the encoder counts the other way.",
                )
        for offset, axis in zip(self.offsets, ("theta", "psi"), strict=True):
            require_within(offset, f"offsets.{axis}", self.unit_of(axis), -MOST_OFFSET, MOST_OFFSET)

    def unit_of(self, role: str) -> AngleUnit:
        """The unit of an angle."""
        return self.units.get(role) or self.units.get(role.removesuffix("_ref")) or self.unit


@dataclass(frozen=True)
class Recording(Frozen):
    """What a rig did, in SI units and with our signs.

    Attributes:
        t: s from 0, increasing, (n,).
        angles: θ, ψ as measured, (n, 2), rad.
        voltages: V_p, V_y from each sample to the next, (n, 2), V.
        references: θ_ref, ψ_ref, (n, 2), rad; None where they were not recorded.
        findings: what is odd about it.
    """

    t: Floats
    angles: Floats
    voltages: Floats
    references: Floats | None = None
    findings: tuple[Finding, ...] = field(default=())

    def __post_init__(self) -> None:
        for name in ("t", "angles", "voltages", "references"):
            values = getattr(self, name)
            if values is not None:  # the compiled kernels take this layout alone
                object.__setattr__(self, name, read_only(np.ascontiguousarray(values, dtype=np.float64)))

    @property
    def sample_time(self) -> float:
        """Median time between two samples, s."""
        return float(np.median(np.diff(self.t)))


def recording_of(table: Table, columns: Columns) -> Recording:
    """The columns of a table as a recording: in SI units, times judged, angles without the encoder's whole turns.

    Raises:
        RecordingError: a column is missing, a row of it unusable (named by row and column), there are too few, or
            the times cannot be a rig's.
    """
    for role in ROLES[1:5]:
        if not columns.names.get(role):
            raise RecordingError(
                f"no column is chosen for {role}",
                field=f"columns.{role}",
                hint="Choose one of the file's columns.",
            )
    if len(table.values) < FEWEST_SAMPLES:
        rows = len(table.values)
        raise RecordingError(
            f"{rows} rows are too few",
            field="file",
            value=rows,
            hint=f"At least {FEWEST_SAMPLES} are needed.",
        )
    t, kept, findings = _time(table, columns)
    angles = [_angle(table, columns, role)[kept] for role in ANGLES[:2]]
    voltages = np.column_stack([_volts(table, columns, role)[kept] for role in ("V_p", "V_y")])
    references: list[Floats] = []
    if columns.names.get("theta_ref") and columns.names.get("psi_ref"):
        references = [_angle(table, columns, role)[kept] for role in ANGLES[2:]]
    for axis, word in enumerate(("Pitch", "Yaw")):
        findings += _without_turns(axis, word, t, angles, references)
    whole = Recording(
        t,
        np.column_stack(angles),
        np.ascontiguousarray(voltages),
        np.column_stack(references) if references else None,
        (*table.findings, *_contradicted(table, columns), *findings),
    )
    own = decimated(whole, columns.decimate)
    if len(own.t) < FEWEST_SAMPLES:
        raise RecordingError(
            f"{len(own.t)} of {len(t)} rows are left, which is too few",
            field="columns.decimate",
            value=columns.decimate,
            hint="Decimate less.",
        )
    timing = timing_remarks(own.t, averaged=columns.decimate > 1)
    return replace(own, findings=(*own.findings, *timing, *_silent(own.voltages)))


def decimated(recording: Recording, factor: int) -> Recording:
    """Every `factor`-th sample of each stretch without gaps, with the voltages' means from one to the next.

    What the motors did in between is thus kept: taking the voltages of the kept samples alone would alias it.
    """
    if factor == 1:
        return recording
    t, volts = recording.t, recording.voltages
    steps = np.diff(t, append=2 * t[-1] - t[-2])[:, None]
    rows, means = [], []
    for first, end in stretches(t).tolist():
        own = np.arange(first, end, factor)
        steps[end - 1] = np.median(steps)  # not the gap
        weights = np.add.reduceat(steps[first:end], own - first)
        means.append(np.add.reduceat(steps[first:end] * volts[first:end], own - first) / weights)
        rows.append(own)
    kept = np.concatenate(rows)
    words = f"Of {len(t)} rows every {factor}th is kept; voltages are averaged in between."
    return Recording(
        t[kept] - t[kept[0]],
        recording.angles[kept],
        np.ascontiguousarray(np.concatenate(means)),
        None if recording.references is None else recording.references[kept],
        (*recording.findings, Finding("decimated", "info", words)),
    )


def _time(table: Table, columns: Columns) -> tuple[Floats, NDArray[np.int64], list[Finding]]:
    name, rows = columns.names.get("time"), len(table.values)
    if name:
        unit = columns.time_unit or table.unit(name, "time") or "s"
        return judged_time(table.column(name, "time"), name, unit, table.refused)
    if columns.sample_time is None:
        raise RecordingError(
            "no column is chosen for time", field="columns.time", hint="Choose one, or give the sample time."
        )
    return np.arange(rows, dtype=np.float64) * columns.sample_time, np.arange(rows, dtype=np.int64), []


def _angle(table: Table, columns: Columns, role: str) -> Floats:
    axis, unit = ANGLES.index(role) % 2, columns.unit_of(role)
    values = _bounded(table, columns.names[role], role, unit) * RADIANS[unit]
    offset = columns.offsets[axis] * RADIANS[columns.unit_of(ANGLES[axis])]
    return np.asarray(columns.signs[axis] * values + offset, dtype=np.float64)


def _volts(table: Table, columns: Columns, role: str) -> Floats:
    unit = columns.voltage_unit
    return _bounded(table, columns.names[role], role, unit) * VOLTS[unit]


def _bounded(table: Table, name: str, role: str, unit: str) -> Floats:
    values = table.column(name, role)
    beyond = np.flatnonzero(np.abs(values) > LARGEST[unit])
    if len(beyond):
        raise table.refused(
            int(beyond[0]),
            name,
            role,
            f"is beyond ±{LARGEST[unit]:g} {unit}",
            "Check the column and its unit.",
        )
    return values


def _without_turns(
    axis: int, word: str, t: Floats, angles: list[Floats], references: list[Floats]
) -> list[Finding]:
    """Takes out of an angle and its reference the whole turns that an encoder of one turn drops; says so."""
    found, jumps = [], np.diff(angles[axis])
    wide = np.abs(jumps) > _TURN / 2
    turns = np.abs(np.abs(jumps[wide]) / _TURN - 1) < _NEARLY
    code = word.lower()
    if np.any(wide) and not np.all(turns):
        row = int(np.flatnonzero(wide)[int(np.argmin(turns))])
        words = (
            f"{word} jumps by {np.degrees(jumps[row]):.0f}° at {t[row + 1]:.4g} s, which is no whole turn: "
            "check its unit, and delete rows where the encoder failed."
        )
        found.append(Finding(f"{code}_jumps", "warning", words))
    elif np.any(wide):
        angles[axis] = np.unwrap(angles[axis])
        if references:
            references[axis] = _followed(references[axis], angles[axis])
        words = (
            f"{word} was recorded modulo 360°: its {int(np.sum(wide))} jumps by a whole turn were taken out."
        )
        found.append(Finding(f"{code}_unwrapped", "warning", words))
    turned = np.round(np.median(angles[axis]) / _TURN)
    if axis == 0 and turned:
        angles[0] = angles[0] - turned * _TURN
        if references:
            references[0] = _followed(references[0], angles[0])
        words = f"Pitch was recorded {turned:+g} turns from level, which were taken out.".replace("-", "−")
        found.append(Finding("pitch_turned", "warning", words))
    return found


def _followed(reference: Floats, angle: Floats) -> Floats:
    """A reference whose whole turns follow the angle's."""
    jumps = np.diff(reference)
    turned = np.abs(np.abs(jumps) / _TURN - 1) < _NEARLY
    own = reference - _TURN * np.concatenate([[0.0], np.cumsum(np.where(turned, np.sign(jumps), 0.0))])
    return own + _TURN * np.round(np.median(angle - own) / _TURN)


def _contradicted(table: Table, columns: Columns) -> list[Finding]:
    """Where the chosen unit is not the one that the file states."""
    chosen: list[tuple[str, Kind, str]] = [(role, "angle", columns.unit_of(role)) for role in ANGLES]
    chosen.extend((role, "voltage", columns.voltage_unit) for role in ("V_p", "V_y"))
    if columns.time_unit is not None:
        chosen.append(("time", "time", columns.time_unit))
    odd = []
    for role, kind, unit in chosen:
        name = columns.names.get(role)
        told = table.unit(name, kind) if name else None
        if told and told != unit:
            odd.append(f"{name!r} says {told} and is taken for {unit}")
    return (
        [Finding("units_differ", "warning", "The file contradicts: " + "; ".join(odd) + ".")] if odd else []
    )


def _silent(voltages: Floats) -> list[Finding]:
    found = []
    for i, motor in enumerate(("pitch", "yaw")):
        if np.ptp(voltages[:, i]) == 0:
            words = f"The {motor} motor's voltage never changes: what it does cannot be told apart."
            found.append(Finding(f"{motor}_not_excited", "warning", words))
    return found


__all__ = [
    "ROLES",
    "SECONDS",
    "AngleUnit",
    "Columns",
    "Recording",
    "Table",
    "TimeUnit",
    "VoltageUnit",
    "decimated",
    "recording_of",
]
