"""What a simulation returns, whichever model made it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..engine import engine
from ..findings import Finding
from ..signals import Floats

DIVERGED = 1e3
"""An angle (rad) beyond which a response counts as diverged and is held at its last value."""


@dataclass(frozen=True)
class Response:
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
            (4 or 6, samples), rad, rad/s, rad·s.
    """

    model: Literal["linear", "nonlinear"]
    t: Floats
    angles: Floats
    voltages: Floats
    reference: tuple[float, float]
    start: tuple[float, float]
    saturated: tuple[float, float]
    findings: tuple[Finding, ...] = ()
    states: Floats | None = None


def hold_when_diverged(t: Floats, states: Floats, voltages: Floats) -> list[Finding]:
    """Freezes a response at its last finite sample, in place, so that every number stays finite.

    `states`, whose first two rows are the angles, and `voltages` are of shape (n, samples).
    """
    first = engine().hold(states, voltages, DIVERGED)
    if first == len(t):
        return []
    message = f"The response grows without bound; it is shown until t = {t[first - 1]:.3g} s and held there."
    return [Finding("diverges", "error", message)]
