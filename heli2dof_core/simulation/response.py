"""What a simulation returns, whichever model made it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..findings import Finding
from ..signals import Floats


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


def divergence(t: Floats, held: int) -> tuple[Finding, ...]:
    """The remark on a response that is held from sample `held` on; none where that is behind its end."""
    if held >= len(t):
        return ()
    message = f"The response grows without bound; it is shown until t = {t[held - 1]:.3g} s and held there."
    return (Finding("diverges", "error", message),)
