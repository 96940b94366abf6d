"""What is asked of a simulation: outer loop, motor limits, scenario. Frozen and validated."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from .checks import require_one_of, require_within
from .signals import Floats

Outer = Literal["pi", "none"]
Pairing = Literal["diagonal", "cross"]
Model = Literal["linear", "nonlinear"]
AntiWindup = Literal["none", "clamping", "back-calculation"]

MOST_SAMPLES = 20_001
LONGEST = 600.0
"""Longest simulation, s."""


@dataclass(frozen=True)
class PIGains:
    """PI(s) = kp (1 + 1/(ti s)): kp in V/rad, ti in s (Section IV of the paper)."""

    kp: float
    ti: float


@dataclass(frozen=True)
class OuterLoop:
    """What drives v: two PI loops (Fig. 3), or the constant Ĝ(0)⁻¹ r of the inner loop alone (Fig. 2).

    Attributes:
        outer: ``pi`` or ``none``.
        pitch, yaw: gains of the PI controllers of the pitch and the yaw error.
        pairing: ``diagonal``, or ``cross``: pitch error to the yaw motor and the other way round,
            each loop's gain times the sign of its ĝᵢⱼ(0).
        decoupler: put the static decoupler Ĝ(0)⁻¹ diag(|ĝ|) between the PI controllers and v.
    """

    outer: Outer = "pi"
    pitch: PIGains = PIGains(30.0, 0.1)
    yaw: PIGains = PIGains(30.0, 0.1)
    pairing: Pairing = "diagonal"
    decoupler: bool = False

    def __post_init__(self) -> None:
        require_one_of(self.outer, Outer, "outer")
        require_one_of(self.pairing, Pairing, "pairing")
        for axis, gains in (("pitch", self.pitch), ("yaw", self.yaw)):
            require_within(gains.kp, f"loops.{axis}.kp", "V/rad", -1e6, 1e6)
            require_within(gains.ti, f"loops.{axis}.ti", "s", 1e-6, 1e6)


@dataclass(frozen=True)
class Limits:
    """Limits of the rig: |V_p|, |V_y| in V; pitch travel ±theta in rad, None where it is free."""

    V_p: float
    V_y: float
    theta: float | None = None

    def __post_init__(self) -> None:
        require_within(self.V_p, "limits.V_p", "V", 1e-3, 1e6)
        require_within(self.V_y, "limits.V_y", "V", 1e-3, 1e6)
        if self.theta is not None:
            require_within(self.theta, "limits.theta", "rad", 1e-3, 3.2)


@dataclass(frozen=True)
class Scenario:
    """One experiment: references step at t = 0 from the initial state. Angles in rad, absolute.

    Attributes:
        theta, psi: references; None stays at rest at the operating point (θ₀, 0).
        duration, samples: t = linspace(0, duration, samples), s.
        initial: θ, ψ, θ̇, ψ̇ at t = 0; an angle None is at rest at the operating point.
        saturation: voltages are limited to `Limits`.
        anti_windup: what the PI integrators do at a limit.
        travel_stops: pitch is stopped at ±`Limits.theta`, without rebound.
        trim_feedforward: the constant trim voltages are added, so that the rig starts at rest.
        rtol: tolerance of the adaptive integration, relative and (in rad, rad/s) absolute.
    """

    theta: float | None = None
    psi: float | None = None
    duration: float = 5.0
    samples: int = 501
    initial: tuple[float | None, float | None, float, float] = field(default=(None, None, 0.0, 0.0))
    saturation: bool = True
    anti_windup: AntiWindup = "clamping"
    travel_stops: bool = True
    trim_feedforward: bool = True
    rtol: float = 1e-8

    def __post_init__(self) -> None:
        names = ("scenario.reference.theta", "scenario.reference.psi")
        for value, name in zip((self.theta, self.psi), names, strict=True):
            if value is not None:
                require_within(value, name, "rad", -100.0, 100.0)
        for value, name in zip(self.initial, ("theta", "psi", "theta_dot", "psi_dot"), strict=True):
            if value is not None:
                require_within(value, f"scenario.initial.{name}", "SI", -100.0, 100.0)
        require_within(self.duration, "scenario.duration", "s", 1e-3, LONGEST)
        require_within(self.samples, "scenario.samples", "", 2, MOST_SAMPLES)
        require_one_of(self.anti_windup, AntiWindup, "scenario.anti_windup")
        require_within(self.rtol, "scenario.rtol", "", 1e-12, 1e-2)

    def resolved(self, theta_0: float) -> tuple[Floats, Floats]:
        """References [θ, ψ] and start [θ, ψ, θ̇, ψ̇] with the operating point (θ₀, 0) filled in, rad."""
        rest = (theta_0, 0.0)
        reference = [r if v is None else v for v, r in zip((self.theta, self.psi), rest, strict=True)]
        angles = [r if v is None else v for v, r in zip(self.initial[:2], rest, strict=True)]
        return np.array(reference), np.array([*angles, *self.initial[2:]], dtype=float)
