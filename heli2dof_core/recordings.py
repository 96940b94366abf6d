"""Recordings of a rig: columns of a file named and scaled, checked, and kept as arrays."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from math import radians
from typing import Literal

import numpy as np

from .checks import require_one_of, require_within
from .errors import RecordingError
from .findings import Finding
from .signals import Floats

AngleUnit = Literal["rad", "deg"]
ROLES = ("time", "theta", "psi", "V_p", "V_y", "theta_ref", "psi_ref")
"""What a column can be; the references may be missing, and time where the sample time is given."""
FEWEST_SAMPLES = 20
JITTER = 0.2
"""Deviation from the median sample time, as a share of it, beyond which the samples count as irregular."""
LARGEST = {"rad": 1e3, "deg": 6e4, "V": 1e3}
"""Largest angle and voltage that a recording may hold."""


@dataclass(frozen=True)
class Table:
    """A file's columns.

    Attributes:
        names: one per column, unique.
        values: (rows, columns), NaN where a cell is empty.
        first_row: the number that the file's reader would give to row 0: its line, or 1.
    """

    names: tuple[str, ...]
    values: Floats
    first_row: int = 1

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

    def refused(self, row: int, name: str, role: str, words: str) -> RecordingError:
        """The error that row `row` (from 0) of a column raises."""
        return RecordingError(
            f"row {row + self.first_row}, column {name!r} {words}",
            field=f"columns.{role}",
            value=float(self.values[row, self.names.index(name)]),
            hint="Correct the file, or choose another column.",
        )


@dataclass(frozen=True)
class Columns:
    """Which column is what, and how the rig's signs and units become ours.

    An angle of the file is multiplied by its sign, then its offset is added, then it is converted.

    Attributes:
        names: role → column; see `ROLES`.
        unit: of the angles, references and offsets included.
        signs: of the encoders of θ and ψ, ±1; references take them too.
        offsets: added to θ and ψ, in `unit`: −40.5° where pitch counts from its lower stop.
        sample_time: s, where there is no column of time.
    """

    names: dict[str, str]
    unit: AngleUnit = "rad"
    signs: tuple[int, int] = (1, 1)
    offsets: tuple[float, float] = (0.0, 0.0)
    sample_time: float | None = None

    def __post_init__(self) -> None:
        require_one_of(self.unit, AngleUnit, "columns.unit")
        for sign, axis in zip(self.signs, ("theta", "psi"), strict=True):
            if sign not in (1, -1):
                raise RecordingError(
                    f"the sign of {axis} is {sign!r}, not 1 or -1", field=f"columns.signs.{axis}", value=sign
                )
        for offset, axis in zip(self.offsets, ("theta", "psi"), strict=True):
            require_within(offset, f"columns.offsets.{axis}", self.unit, -1e4, 1e4)
        if self.sample_time is not None:
            require_within(self.sample_time, "columns.sample_time", "s", 1e-5, 10.0)


@dataclass(frozen=True)
class Recording:
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

    @property
    def sample_time(self) -> float:
        """Median time between two samples, s."""
        return float(np.median(np.diff(self.t)))


def recording_of(table: Table, columns: Columns) -> Recording:
    """The columns of a table as a recording.

    Raises:
        RecordingError: a column is missing, a row of it unusable (named by row and column), or there are too few.
    """
    for role in ROLES[1:5]:
        if not columns.names.get(role):
            raise RecordingError(
                f"no column is chosen for {role}",
                field=f"columns.{role}",
                hint="Choose one of the file's columns.",
            )
    rows = len(table.values)
    if rows < FEWEST_SAMPLES:
        raise RecordingError(
            f"{rows} rows are too few",
            field="file",
            value=rows,
            hint=f"At least {FEWEST_SAMPLES} are needed.",
        )
    t = _time(table, columns)
    angles = np.column_stack([_angle(table, columns, axis, "") for axis in (0, 1)])
    voltages = np.column_stack([_bounded(table, columns.names[role], role, "V") for role in ("V_p", "V_y")])
    references = None
    if columns.names.get("theta_ref") and columns.names.get("psi_ref"):
        references = np.column_stack([_angle(table, columns, axis, "_ref") for axis in (0, 1)])
    return Recording(t, angles, np.ascontiguousarray(voltages), references, tuple(_remarks(t, voltages)))


def _time(table: Table, columns: Columns) -> Floats:
    name = columns.names.get("time")
    if not name:
        if columns.sample_time is None:
            raise RecordingError(
                "no column is chosen for time",
                field="columns.time",
                hint="Choose one, or give the sample time.",
            )
        return np.arange(len(table.values), dtype=np.float64) * columns.sample_time
    t = table.column(name, "time")
    back = np.flatnonzero(np.diff(t) <= 0)
    if len(back):
        raise table.refused(int(back[0]) + 1, name, "time", "does not come after the row before it")
    return t - t[0]


def _angle(table: Table, columns: Columns, axis: int, suffix: str) -> Floats:
    role = ("theta", "psi")[axis] + suffix
    values = (
        columns.signs[axis] * _bounded(table, columns.names[role], role, columns.unit) + columns.offsets[axis]
    )
    return np.asarray(values * (radians(1.0) if columns.unit == "deg" else 1.0), dtype=np.float64)


def _bounded(table: Table, name: str, role: str, unit: str) -> Floats:
    values = table.column(name, role)
    beyond = np.flatnonzero(np.abs(values) > LARGEST[unit])
    if len(beyond):
        raise table.refused(int(beyond[0]), name, role, f"is beyond ±{LARGEST[unit]:g} {unit}")
    return values


def _remarks(t: Floats, voltages: Floats) -> list[Finding]:
    found, steps = [], np.diff(t)
    typical = float(np.median(steps))
    odd = int(np.sum(np.abs(steps - typical) > JITTER * typical))
    if odd:
        words = f"{odd} of {len(steps)} sample times differ from the usual {1e3 * typical:.3g} ms by more than 20 %."
        found.append(Finding("irregular_samples", "warning", words))
    for i, motor in enumerate(("pitch", "yaw")):
        if np.ptp(voltages[:, i]) == 0:
            words = f"The {motor} motor's voltage never changes: what it does cannot be told apart."
            found.append(Finding(f"{motor}_not_excited", "warning", words))
    return found


_NAMES = {
    "time": r"t|time|times|zeit|sec|seconds|timestamp",
    "theta": r"(theta|pitch|elevation|th)(angle|meas|measured|enc|encoder|pos|position)?",
    "psi": r"(psi|yaw|travel|azimuth)(angle|meas|measured|enc|encoder|pos|position)?",
    "V_p": r"(v|u|um|volt|voltage|vm|motor)(p|pitch|theta|main|1|0)|(pitch|main)(motor)?(v|volt|voltage|u)|vmp",
    "V_y": r"(v|u|um|volt|voltage|vm|motor)(y|yaw|psi|tail|2)|(yaw|tail)(motor)?(v|volt|voltage|u)|vmy",
    "theta_ref": r"(theta|pitch)(ref|reference|d|des|desired|cmd|command|setpoint|sp)|(r|ref|des|cmd)(theta|pitch)",
    "psi_ref": r"(psi|yaw)(ref|reference|d|des|desired|cmd|command|setpoint|sp)|(r|ref|des|cmd)(psi|yaw)",
}
_GREEK = str.maketrans({"θ": "theta", "ψ": "psi", "°": "deg"})
_UNITS = re.compile(r"[\[(]\s*([^\])]*)\s*[\])]|_(deg|rad|s|v|volts)$")


def guess_columns(table: Table) -> Columns:
    """What the columns probably are, by their names; degrees where a name says so or pitch exceeds 2 rad."""
    chosen: dict[str, str] = {}
    for name in table.names:
        bare = re.sub(r"[^a-z0-9]", "", _UNITS.sub("", name.strip().lower().translate(_GREEK)))
        for role, pattern in _NAMES.items():
            if role not in chosen and re.fullmatch(pattern, bare):
                chosen[role] = name
                break
    named = " ".join(chosen.get(role, "") for role in ("theta", "psi")).lower().translate(_GREEK)
    if "deg" in named:
        return Columns(chosen, "deg")
    if "rad" not in named and "theta" in chosen:
        values = np.abs(table.values[:, table.names.index(chosen["theta"])])
        if np.nanmax(values, initial=0.0) > radians(115):
            return Columns(chosen, "deg")
    return Columns(chosen)
