"""What a simulation returns, whichever model made it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..findings import Finding
from ..signals import Floats
from ..tables import Shown, number


@dataclass(frozen=True, repr=False)
class Response(Shown):
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


def divergence(t: Floats, held: int) -> tuple[Finding, ...]:
    """The remark on a response that is held from sample `held` on; none where that is behind its end."""
    if held >= len(t):
        return ()
    message = f"The response grows without bound. It is shown until t = {t[held - 1]:.3g} s."
    return (Finding("diverges", "error", message),)
