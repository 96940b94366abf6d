"""Recordings over REST: what is asked about a file, and what is replied."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from heli2dof_core import Spec, loop_of
from heli2dof_core.errors import within_field
from heli2dof_core.recordings.files import MOST_FILES
from heli2dof_core.recordings.guess import guess_columns
from heli2dof_core.recordings.overlay import (
    Overlay,
    driven_by_references,
    driven_by_voltages,
    driven_in_segments,
)
from heli2dof_core.recordings.recording import ROLES, AngleUnit, Columns, Recording, Table
from heli2dof_core.recordings.time_axis import likely_unit
from heli2dof_core.recordings.units import SECONDS
from heli2dof_core.signals import Floats

from .experiment import StepRequest
from .fields import Strict, Whole, asked
from .model import Finding, Model, Reply
from .places import COLUMNS

PREVIEWED = 5


MOST_POINTS = 1500
"""Points of a curve that are sent; more make no other picture."""


Driver = Literal["voltages", "segments", "references"]


class Signs(Strict):
    """Of the encoders, 1 or −1."""

    theta: Literal[-1, 1] = Field(default=1, description="of pitch's")
    psi: Literal[-1, 1] = Field(default=1, description="of yaw's")


class Offsets(Strict):
    """Added to the file's angles after their signs, in its unit."""

    theta: float = Field(default=0.0, description="to pitch, in the file's unit")
    psi: float = Field(default=0.0, description="to yaw, in the file's unit")


class AngleUnits(Strict):
    """Units of single angles, where they are not the file's usual one; a reference takes its axis' unit."""

    theta: AngleUnit | None = Field(default=None, description="of pitch")
    psi: AngleUnit | None = Field(default=None, description="of yaw")
    theta_ref: AngleUnit | None = Field(default=None, description="of pitch's reference")
    psi_ref: AngleUnit | None = Field(default=None, description="of yaw's reference")


class Mapping(asked(COLUMNS)):
    """Which column is what, and how its angles become ours."""

    time: str | None = None
    theta: str | None = None
    psi: str | None = None
    V_p: str | None = None
    V_y: str | None = None
    theta_ref: str | None = None
    psi_ref: str | None = None
    units: AngleUnits = AngleUnits()
    signs: Signs = Signs()
    offsets: Offsets = Offsets()

    def to_columns(self) -> Columns:
        """The core's mapping."""
        names = {role: name for role in ROLES if (name := getattr(self, role)) is not None}
        with within_field(COLUMNS.attribute):
            return Columns(
                names,
                **COLUMNS.given(self.model_dump(exclude_unset=True)),
                signs=(self.signs.theta, self.signs.psi),
                offsets=(self.offsets.theta, self.offsets.psi),
                units=self.units.model_dump(exclude_none=True),
            )


class JoinRequest(Strict):
    """Files of one run, sent before, to be joined into one recording."""

    recordings: list[Annotated[str, Field(max_length=64)]] = Field(
        min_length=1, max_length=MOST_FILES, description="their ids"
    )


class SampleRequest(StepRequest):
    """A design whose digital rig is to be recorded while its references step."""

    length: float = Field(default=30.0, ge=2.0, le=600.0, description="of the recording, s")
    deviation: float = Field(
        default=0.15, ge=0, le=0.5, description="largest deviation of the recorded rig's parameters, relative"
    )
    noise: float = Field(default=1e-3, ge=0, le=0.1, description="standard deviation on the angles, rad")
    seed: Whole = Field(default=0, ge=0, le=2**32 - 1, description="of steps, deviations and noise")


class OverlayRequest(StepRequest):
    """A design to lay over a recording."""

    columns: Mapping
    driver: Driver = Field(
        default="segments",
        description="voltages: one run under the recorded voltages; segments: begun anew every few seconds; "
        "references: the design's loop under the recorded references",
    )
    segment: float | None = Field(
        default=None, ge=0.1, le=1e4, description="s; by default by the rig's stability"
    )


class Guess(Model):
    """What the columns probably are."""

    columns: dict[str, str]
    unit: str = Field(description="of the angles: rad or deg")
    units: dict[str, str] = Field(default={}, description="of angles whose unit is another one")
    time_unit: str | None = Field(default=None, description="of the column of time")
    voltage_unit: str = Field(default="V", description="of both voltages")
    sample_time: float | None = Field(default=None, description="usual time between two rows in that unit, s")


class Dialect(Model):
    """How text was split into cells."""

    separator: str
    decimal: str


class Preview(Model):
    """A recording as it was read; `id` is kept for half an hour after its last use."""

    id: str
    name: str
    columns: list[str]
    rows: int = Field(description="of numbers")
    first_row: int = Field(description="line of the file where they begin")
    preview: list[list[float | None]] = Field(description="the first rows, in the file's own units")
    guess: Guess
    units: dict[str, str] = Field(
        default={}, description="of columns, where rows or cells of the file state them"
    )
    dialect: Dialect | None = Field(default=None, description="of text; null of other files")
    findings: list[Finding] = Field(default=[], description="what was left out or read in a special way")


class PerAxis(Model):
    """A number per axis; null where it is not defined."""

    theta: float | None = Field(description="of pitch; % or rad, as the field says")
    psi: float | None = Field(description="of yaw")


class Courses(Model):
    """Angles, rad; null where nothing was simulated."""

    theta: list[float | None] = Field(description="rad")
    psi: list[float | None] = Field(description="rad")


class Volts(Model):
    """V."""

    V_p: list[float] = Field(description="V")
    V_y: list[float] = Field(description="V")


class Driving(Model):
    """V; null where nothing was simulated."""

    V_p: list[float | None] = Field(description="V")
    V_y: list[float | None] = Field(description="V")


class OverlayReply(Model):
    """Measured and simulated, at no more than 1500 of the recording's times."""

    driver: str
    samples: Whole = Field(description="of the recording")
    sample_time: float = Field(description="s")
    duration: float = Field(description="s")
    fit: PerAxis
    rms: PerAxis
    segments: int = Field(description="how often the simulation was begun anew")
    t: list[float] = Field(description="s")
    measured: Courses
    simulated: Courses
    residuals: Courses
    references: Courses | None = None
    voltages: Volts
    driving: Driving
    findings: list[Finding]


def overlaid(
    request: OverlayRequest, recording: Recording, wanted: Callable[[], None] = lambda: None
) -> Overlay:
    """The design's rig under what was recorded.

    Raises:
        RecordingError: the rig runs away, or what drives it was not recorded.
    """
    spec = request.to_spec()
    rig, machine = (spec.parameters, recording), machine_of(spec)
    if request.driver == "voltages":
        return driven_by_voltages(*rig, spec.limits.theta, wanted, **machine)
    if request.driver == "segments":
        return driven_in_segments(*rig, request.segment, spec.limits.theta, wanted, **machine)
    loop = loop_of(spec)
    return driven_by_references(loop, spec.limits, recording, spec.scenario.digital, wanted)


def machine_of(spec: Spec) -> dict[str, Any]:
    """Rotors and friction, and what matches thrust curves that do not say it themselves."""
    limits = spec.limits.V_p, spec.limits.V_y
    return {"rotors": spec.rotors, "friction": spec.friction, "theta_0": spec.theta_0, "limits": limits}


def preview_reply(key: str, name: str, table: Table) -> Reply:
    """What was read."""
    guess = guess_columns(table)
    rows = [[v if np.isfinite(v) else None for v in row] for row in table.values[:PREVIEWED].tolist()]
    about = {"id": key, "name": name, "columns": list(table.names), "rows": len(table.values)}
    return {
        **about,
        "first_row": table.first_row,
        "preview": rows,
        "guess": {
            "columns": guess.names,
            "unit": guess.unit,
            "units": dict(guess.units),
            "time_unit": guess.time_unit,
            "voltage_unit": guess.voltage_unit,
            "sample_time": _sample_time(table, guess),
        },
        "units": dict(table.units),
        "dialect": dict(table.dialect) or None,
        "findings": [vars(finding) for finding in table.findings],
    }


def _sample_time(table: Table, guess: Columns) -> float | None:
    """The usual time between two rows, s, by the guess."""
    if "time" not in guess.names:
        return None
    raw = table.values[:, table.names.index(guess.names["time"])]
    steps = np.diff(raw[np.isfinite(raw)])
    return float(np.median(steps)) * SECONDS[guess.time_unit or likely_unit(raw)] if len(steps) else None


def overlay_reply(driver: Driver, recording: Recording, overlay: Overlay) -> Reply:
    """Both courses, thinned out."""
    n, kept = len(recording.t), kept_rows(recording)
    references, simulated = recording.references, gapped(overlay.angles, overlay.segments, kept)
    return {
        "driver": driver,
        "samples": n,
        "sample_time": recording.sample_time,
        "duration": float(recording.t[-1]),
        "fit": per_axis(overlay.fit),
        "rms": per_axis(overlay.rms),
        "segments": len(overlay.segments),
        "t": recording.t[kept],
        "measured": courses(recording.angles[kept]),
        "simulated": courses(simulated),
        "residuals": courses((recording.angles - overlay.angles)[kept]),
        **({} if references is None else {"references": courses(references[kept])}),
        "voltages": _volts(recording.voltages[kept]),
        "driving": _volts(overlay.voltages[kept]),
        "findings": [vars(finding) for finding in (*recording.findings, *overlay.findings)],
    }


def kept_rows(recording: Recording) -> NDArray[np.int64]:
    """Rows that are sent."""
    n = len(recording.t)
    return np.unique(np.linspace(0, n - 1, min(n, MOST_POINTS)).round().astype(np.int64))


def gapped(angles: Floats, segments: NDArray[np.int64], kept: NDArray[np.int64]) -> Floats:
    """Simulated angles at these rows, with a gap in the curve where a segment begins."""
    shown = angles[kept]
    part = np.searchsorted(segments[:, 0], kept, side="right")
    shown[1:][np.diff(part) > 0] = np.nan
    return shown


def per_axis(values: tuple[float | None, float | None]) -> Reply:
    """Pitch's and yaw's; None where they are no numbers."""
    theta, psi = (v if v is not None and np.isfinite(v) else None for v in values)
    return {"theta": theta, "psi": psi}


def courses(angles: Floats) -> Reply:
    """Angles (n, 2), an array per axis."""
    return {name: np.ascontiguousarray(angles[:, i]) for i, name in enumerate(("theta", "psi"))}


def _volts(volts: Floats) -> Reply:
    return {name: np.ascontiguousarray(volts[:, i]) for i, name in enumerate(("V_p", "V_y"))}
