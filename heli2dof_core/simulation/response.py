"""What a simulation returns, whichever model made it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..figures import AXIS_METRICS
from ..findings import Finding
from ..frozen import Frozen
from ..kernels.layout import (
    COURSE,
    ENDED,
    HELD,
    MOTOR_METRICS,
    OUT_OF_STEPS,
    OUT_OF_SWITCHES,
    OUTCOME,
    REACHED,
    START,
)
from ..signals import INPUTS, INTEGRALS, ROTORS, STATES, Floats, Signal
from ..tables import Shown, number


@dataclass(frozen=True)
class Measured(Frozen):
    """Figures of merit as the kernels fill them, laid out as `layout` says; `metrics` gives them names.

    Attributes:
        axes: (2, AXIS_METRICS), nothing where an axis is not stepped.
        motors: (2, MOTOR_METRICS).
        course: (COURSE,).
    """

    axes: Floats
    motors: Floats
    course: Floats


def room() -> tuple[Floats, Floats, Floats]:
    """What a kernel fills with the figures of a course, to be made `Measured` then."""
    return np.empty((2, AXIS_METRICS)), np.empty((2, MOTOR_METRICS)), np.empty(COURSE)


@dataclass(frozen=True, repr=False)
class Response(Frozen, Shown):
    """Trajectories over t, all of shape (samples,).

    Attributes:
        model: which model made it.
        t: s.
        angles: θ, ψ absolute, shape (2, samples), rad.
        voltages: V_p, V_y, shape (2, samples), V; linear: deviations from the trim; nonlinear:
            what the motors get, trim included.
        reference: θ_ref, ψ_ref, absolute, rad.
        start: θ, ψ at t = 0, rad.
        saturated: share of time that each motor spends at its limit.
        findings: remarks on this response.
        states: θ, ψ absolute, θ̇, ψ̇, and z_p, z_y = ∫ error where anything integrates, shape
            (4 or 6, samples), rad, rad/s, rad·s; then the speeds of rotors that lag, V, and an estimator's states.
        measured: figures of the course itself, whatever its samples are.
        signals: what the states are.
    """

    model: Literal["linear", "nonlinear"]
    t: Floats
    angles: Floats
    voltages: Floats
    reference: tuple[float, float]
    start: tuple[float, float]
    saturated: tuple[float, float]
    findings: tuple[Finding, ...]
    states: Floats
    measured: Measured
    signals: tuple[Signal, ...] = (*STATES, *INTEGRALS)

    @property
    def theta(self) -> Floats:
        """Pitch angle, absolute, rad."""
        return self.angles[0]

    @property
    def psi(self) -> Floats:
        """Yaw angle, absolute, rad."""
        return self.angles[1]

    @property
    def V_p(self) -> Floats:
        """Voltage of the pitch motor, V; see `voltages`."""
        return self.voltages[0]

    @property
    def V_y(self) -> Floats:
        """Voltage of the yaw motor, V; see `voltages`."""
        return self.voltages[1]

    @property
    def rotors(self) -> Floats | None:
        """Speeds of both rotors, V, (2, samples), linear: deviations; None where both follow at once."""
        if self.signals[-1].name in _PAPERS:  # rotors come behind
            return None
        rows = dict(zip((signal.name for signal in self.signals), self.states, strict=False))
        if not any(rotor.name in rows for rotor in ROTORS):
            return None
        return np.array([rows.get(r.name, V) for r, V in zip(ROTORS, self.voltages, strict=True)])

    def by_signal(self) -> Iterator[tuple[Signal, Floats]]:
        """States and voltages, each with what it is."""
        yield from zip(self.signals, self.states, strict=False)
        yield from zip(INPUTS, self.voltages, strict=True)

    def columns(self) -> dict[str, Floats]:
        """t, theta, psi, V_p and V_y by name, as a data frame takes them."""
        return {"t": self.t, "theta": self.theta, "psi": self.psi, "V_p": self.V_p, "V_y": self.V_y}

    def summary(self) -> str:
        """Model, step, length and findings."""
        theta, psi = (
            f"{number(start)} → {number(end)}" for start, end in zip(self.start, self.reference, strict=True)
        )
        codes = "".join(f"; {finding.code}" for finding in self.findings)
        return f"{self.model}; θ {theta}, ψ {psi} rad; {len(self.t)} samples of {number(float(self.t[-1]))} s{codes}"


_PAPERS = {signal.name for signal in (*STATES, *INTEGRALS)}
"""The states of the paper's rig under its loops."""
_GIVEN_UP = {
    OUT_OF_STEPS: "it takes too many steps; shorten the duration or loosen the tolerance",
    OUT_OF_SWITCHES: "it switches between limits without end",
}


def course_response(
    model: Literal["linear", "nonlinear"],
    x: Sequence[float],
    t: Floats,
    found: Measured,
    *,
    states: Floats,
    signals: tuple[Signal, ...],
    voltages: Floats,
    findings: tuple[Finding, ...],
    saturated: tuple[float, float] = (0.0, 0.0),
) -> Response:
    """The course of an experiment, laid out as `layout` says, and what is to be said of it."""
    theta, psi, *start = x[: START + 2]
    ends = (theta, psi), (start[0], start[1])
    return Response(model, t, states[:2], voltages, *ends, saturated, findings, states, found, signals)


def end_of_course(
    model: Literal["linear", "nonlinear"], t: Floats, course: Sequence[float]
) -> tuple[Finding, ...]:
    """How a course ended before its time: without bound, or given up; `course` as `layout` says."""
    held, outcome = course[HELD], course[OUTCOME]
    if held >= len(t) and outcome == ENDED:
        return ()
    if held < len(t):
        message = f"The response grows without bound. It is shown until t = {t[int(held) - 1]:.3g} s."
        return (Finding("diverges", "error", message),)
    if outcome in _GIVEN_UP:
        what = "The simulation" if model == "nonlinear" else "Measuring the linear response"
        words = f"{what} stopped early, at t = {course[REACHED]:.3g} s: {_GIVEN_UP[int(outcome)]}."
        return (Finding("integration_stopped", "warning", words),)
    return ()
