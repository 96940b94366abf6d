"""What the columns of a file probably are: roles by name, units by what the file states or by the numbers' size."""

from __future__ import annotations

import re
from math import radians
from typing import Any

import numpy as np

from ..signals import ROTORS
from .recording import ANGLES, Columns, Table
from .time_axis import likely_unit
from .units import split_unit

_MEASURED = r"(angle|meas|measured|enc|encoder|pos|position|deg|rad)?"
_WANTED = r"(ref|reference|d|des|desired|cmd|command|setpoint|sp|target)"
_NAMES = {
    "time": r"t|time|times|zeit|sec|seconds|timestamp|elapsed|elapsedtime|ms|millis|micros|clock|simtime",
    "theta": rf"(theta|pitch|elevation|th){_MEASURED}",
    "psi": rf"(psi|yaw|travel|azimuth){_MEASURED}",
    "V_p": r"(v|u|um|volt|voltage|vm|motor)(p|pitch|theta|main|1|0)|(pitch|main)(motor)?(v|volt|voltage|u)|vmp",
    "V_y": r"(v|u|um|volt|voltage|vm|motor)(y|yaw|psi|tail|2)|(yaw|tail)(motor)?(v|volt|voltage|u)|vmy",
    "theta_ref": rf"(theta|pitch){_WANTED}|(r|ref|des|cmd)(theta|pitch)",
    "psi_ref": rf"(psi|yaw){_WANTED}|(r|ref|des|cmd)(psi|yaw)",
}
_GREEK = str.maketrans({"θ": "theta", "ψ": "psi", "ϑ": "theta"})
_PARTS = re.compile(r"(?:^|.*[./])(?:out|log|logsout|data|simout|nonlinear|table|ans)[./]", re.IGNORECASE)
_MODEL = re.compile(r"[_ .]nonlinear$")
_FIRST = re.compile(r"(^|[._ ])(nonlinear|measured)([._ ]|$)")
"""Of our own exports: voltages of the nonlinear model hold the trim."""
_SPEEDS = tuple(signal.name for signal in ROTORS)
"""Of our own exports: rotors' speeds, whose names differ from the voltages' by their case alone."""
_LARGE_PITCH, _LARGE_YAW = radians(115), 10.0
"""Angles beyond which numbers are no radians."""


def role_of(name: str) -> str | None:
    """What a column of this name probably is."""
    bare = _bare(name)
    plain = re.sub(r"[^a-z0-9()]", "", bare.lower().translate(_GREEK))
    plain = re.sub(r"[()]", "", plain) if re.fullmatch(r"[vu]m?\(\d\)", plain) else plain
    for role, pattern in _NAMES.items():
        if re.fullmatch(pattern, plain):
            return role
    last = re.split(r"[./:]", bare)[-1]
    return role_of(last) if last not in (bare, "") else None


def _bare(name: str) -> str:
    """The name without its unit and what it is a part of."""
    return _MODEL.sub("", _PARTS.sub("", split_unit(name)[0].strip()))


def _rank(name: str) -> tuple[bool, bool]:
    """Which of several columns of one role comes first: measured ones, and voltages before rotors' speeds."""
    return not _FIRST.search(name), re.split(r"[./:]", _bare(name))[-1] in _SPEEDS


def guess_columns(table: Table) -> Columns:
    """What the columns probably are, by their names, and in which units."""
    chosen: dict[str, str] = {}
    if table.time is not None:
        chosen["time"] = table.time
    for name in sorted(table.names, key=_rank):
        role = role_of(name)
        if role and (
            role not in chosen or (role == "time" and _rises(table, name) > _rises(table, chosen[role]))
        ):
            chosen[role] = name
    unit, units = _angle_units(table, chosen)
    volts: Any = {table.unit(chosen[role], "voltage") for role in ("V_p", "V_y") if role in chosen} - {None}
    time: Any = None
    if "time" in chosen:
        raw = table.values[:, table.names.index(chosen["time"])]
        time = table.unit(chosen["time"], "time") or likely_unit(raw)
    return Columns(
        {role: chosen[role] for role in (*_NAMES,) if role in chosen},
        unit,
        time_unit=time,
        units=units,
        voltage_unit="mV" if volts == {"mV"} else "V",
    )


def _rises(table: Table, name: str) -> bool:
    """Whether a column can be the time: two in three of its steps go forward at least."""
    steps = np.diff(table.values[:, table.names.index(name)])
    return name == table.time or (len(steps) > 0 and float(np.mean(steps > 0)) > 0.67)


def _angle_units(table: Table, chosen: dict[str, str]) -> tuple[Any, dict[str, Any]]:
    """Pitch's unit, and what differs from it."""
    told = {role: table.unit(chosen[role], "angle") for role in ANGLES if role in chosen}
    sizes = {
        role: float(np.nanmax(np.abs(table.values[:, table.names.index(chosen[role])]), initial=0.0))
        for role in told
    }
    large = sizes.get("theta", 0.0) > _LARGE_PITCH or sizes.get("psi", 0.0) > _LARGE_YAW
    stated = [unit for unit in told.values() if unit]
    usual = stated[0] if stated else "deg" if large else "rad"
    own = {role: unit or told.get(role.removesuffix("_ref")) or usual for role, unit in told.items()}
    unit = own.get("theta", usual)

    def implied(role: str) -> str:  # a reference takes its axis' unit
        return own.get(role.removesuffix("_ref"), unit) if role.endswith("_ref") else unit

    return unit, {role: value for role, value in own.items() if value != implied(role)}
