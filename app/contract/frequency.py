"""Relative gains and loops over frequency, margins: what is asked and what is replied."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Annotated

import numpy as np
from pydantic import Field

from heli2dof_core import (
    Design,
    Interaction,
    Loop,
    rga_over_frequency,
)
from heli2dof_core import Finding as CoreFinding
from heli2dof_core.figures import MARGINS, SENSITIVITY
from heli2dof_core.interaction import dominance_over_frequency
from heli2dof_core.lag_track import LagTrack
from heli2dof_core.margins import loop_margins, open_loop_response
from heli2dof_core.root_locus import RootLocus as CoreLocus
from heli2dof_core.sensitivity import Sensitivity as CoreSensitivity
from heli2dof_core.signals import AXES

from .design import DesignRequest
from .experiment import StepRequest
from .model import Complex, Finding, Model, Reply, findings_reply, poles_reply, present, reply_of, told_by


class RgaRequest(DesignRequest):
    """A design, and frequencies at which |RGA(jω)| is wanted."""

    frequencies: list[Annotated[float, Field(ge=0, le=1e6)]] = Field(
        default=[], max_length=2000, description="rad/s"
    )


class LoopsRequest(StepRequest):
    """A design with its outer loop, and frequencies at which L(jω) is wanted; of the scenario `measured` counts."""

    frequencies: list[Annotated[float, Field(ge=1e-9, le=1e6)]] = Field(
        min_length=1, max_length=2000, description="rad/s"
    )


class Lag(Model):
    """The poles of the whole loop as the rotors' lag grows from nothing to what it is."""

    tau: list[float] = Field(description="time constants at the end, pitch's and yaw's rotor, s")
    assumed: bool = Field(description="whether these are a real rig's, 0.16 s, as the rig given has none")
    share: list[float] = Field(description="of these, from nearly 0 to 1")
    poles: list[list[Complex]] = Field(description="per pole its course over `share`, rad/s")


def lag_reply(track: LagTrack) -> Reply:
    """The track, pole by pole."""
    return reply_of(Lag, track, poles=[poles_reply(course) for course in track.poles.T])


class RootLocus(Model):
    """The poles of a quadratic method as R is multiplied by ρ; LQR's where the request's method has no weights."""

    rho: list[float] = Field(description="factor on R, from large to small; 1 in the middle")
    poles: list[list[Complex]] = Field(description="per pole its course over `rho`, rad/s")


def locus_reply(locus: CoreLocus) -> Reply:
    """The locus, pole by pole."""
    return reply_of(RootLocus, locus, poles=[poles_reply(course) for course in locus.poles.T])


class Dominance(Model):
    """Off-diagonal over diagonal size of Ĝ(jω), by rows and by columns; below 1: dominant."""

    rows: list[list[float]] = Field(description="per frequency, row θ and row ψ")
    columns: list[list[float]] = Field(description="per frequency, column V_p and column V_y")


class Rga(Model):
    """RGA at s = 0, rows θ, ψ, columns V_p, V_y; left out without steady state."""

    rga: list[list[float]] | None = Field(None, description="RGA at s = 0; rows θ, ψ, columns V_p, V_y")
    pairing: list[list[str]] | None = None
    reason: str | None = None
    niederlinski: float | None = Field(None, description="index of the diagonal pairing")
    niederlinski_cross: float | None = Field(None, description="index of the cross pairing")
    dominance: Dominance | None = None
    frequencies: list[float] | None = Field(None, description="rad/s")
    rga_magnitude: list[list[list[float]]] | None = Field(None, description="|RGA(jω)|, 2×2 per frequency")
    findings: list[Finding]


class Margins(told_by(MARGINS)):
    """Margins at one motor's input: factors, rad, s; left out where unlimited."""


class LoopMargins(Model):
    """Margins at each motor; left out where the loop is unstable."""

    pitch: Margins | None = None
    yaw: Margins | None = None


class FrequencyResponse(Model):
    """L(jω) of the loop opened at one motor's input, the rest closed; the phase without jumps, rad."""

    gain: list[float] = Field(description="|L(jω)|")
    phase: list[float] = Field(description="without jumps, rad")


class OpenLoops(Model):
    """The loops opened at each motor, over frequency, rad/s; −1 is critical."""

    frequencies: list[float] = Field(description="rad/s")
    pitch: FrequencyResponse
    yaw: FrequencyResponse
    margins: LoopMargins
    stable: bool


class Sensitivity(told_by(SENSITIVITY)):
    """Sensitivity peak and disk margin at both motors at once, rad/s; what the disk margin guarantees."""


def rga_reply(design: Design, gains: Interaction, frequencies: Sequence[float] = ()) -> Reply:
    """As `relative_gains_reply`, and |RGA(jω)| at frequencies."""
    reply = relative_gains_reply(design.findings, gains)
    if frequencies and gains.relative_gain is not None:
        at = np.array(frequencies)
        rows, columns = dominance_over_frequency(design, at)
        reply["frequencies"] = list(frequencies)
        reply["rga_magnitude"] = np.abs(rga_over_frequency(design, at)).tolist()
        if np.all(np.isfinite(rows)) and np.all(np.isfinite(columns)):
            reply["dominance"] = {"rows": rows.tolist(), "columns": columns.tolist()}
    return reply


def relative_gains_reply(of_design: Iterable[CoreFinding], gains: Interaction) -> Reply:
    """RGA, pairing and Niederlinski index; without steady state only the findings, those of the design among them."""
    no_steady_state = [f for f in of_design if f.code == "no_steady_state"]
    reply: Reply = {"findings": findings_reply([*no_steady_state, *gains.findings])}
    rga, index, cross = gains.entries, gains.niederlinski, gains.niederlinski_cross
    if rga:
        reply["rga"] = rga
        reply["pairing"] = gains.pairing
        reply["reason"] = gains.reason
    if index is not None:
        reply["niederlinski"] = index
    if cross is not None:
        reply["niederlinski_cross"] = cross
    return reply


def open_loops_reply(loop: Loop, frequencies: Sequence[float]) -> Reply:
    """L(jω) at each motor and its margins; the phase starts between −2π and 0 and has no jumps."""
    responses = open_loop_response(loop, np.array(frequencies))
    reply: Reply = {"frequencies": list(frequencies), "stable": loop.stable}
    for axis, response in zip(AXES, responses, strict=True):
        phase = np.unwrap(np.angle(response))
        phase -= 2 * np.pi * np.ceil(phase[0] / (2 * np.pi))
        reply[axis] = {"gain": np.abs(response).tolist(), "phase": phase.tolist()}
    margins = loop_margins(loop)
    own = None if margins is None else (present(vars(margins[0])), present(vars(margins[1])))
    return reply | {"margins": margins_reply(own)}


def margins_reply(margins: tuple[Reply, Reply] | None) -> Reply:
    """Margins at each motor, those that exist; empty where the loop is unstable."""
    return {} if margins is None else dict(zip(AXES, margins, strict=True))


def sensitivity_reply(sensitivity: CoreSensitivity | None) -> Reply:
    """Disk margin and sensitivity peak under ``sensitivity``; nothing where the loop is unstable."""
    if sensitivity is None:
        return {}
    low, high = sensitivity.gain_range
    return {
        "sensitivity": present(
            {**vars(sensitivity), "gain_low": low, "gain_high": high, "phase": sensitivity.phase}
        )
    }
