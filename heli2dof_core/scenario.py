"""What is asked of a simulation: outer loop, motor limits, scenario. Frozen and validated."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, Literal

import numpy as np

from .checks import require_one_of, require_within
from .errors import InvalidInputError
from .frozen import frozen
from .signals import Floats

Outer = Literal["pi", "none"]
Pairing = Literal["diagonal", "cross"]
Model = Literal["linear", "nonlinear"]
Rates = Literal["filtered", "true"]
AntiWindup = Literal["none", "clamping", "back-calculation"]

MOST_SAMPLES = 20_001
MOST_SAMPLE_TIMES = 100_000
"""Most samples of a digital controller in one simulation."""
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


LIMIT_INFO: dict[str, dict[str, Any]] = {
    "V_p": {
        "meaning": "largest voltage of the pitch motor, either way",
        "unit": "V",
        "low": 1e-3,
        "high": 1e6,
    },
    "V_y": {"meaning": "largest voltage of the yaw motor, either way", "unit": "V", "low": 1e-3, "high": 1e6},
    "theta": {"meaning": "pitch travel to either side of level", "unit": "rad", "low": 1e-3, "high": 3.2},
}
"""Per limit: meaning, unit, the lowest and the highest value allowed."""


@dataclass(frozen=True)
class Limits:
    """Limits of the rig: |V_p|, |V_y| in V; pitch travel ±theta in rad, None where it is free."""

    V_p: float
    V_y: float
    theta: float | None = None

    def __post_init__(self) -> None:
        for name, info in LIMIT_INFO.items():
            value = getattr(self, name)
            if value is not None or name != "theta":
                require_within(value, f"limits.{name}", info["unit"], info["low"], info["high"])


@dataclass(frozen=True)
class Digital:
    """How the rig's own controller differs from the continuous one of the theory.

    Attributes:
        sample_time: between two samples; the voltages are held, s.
        delay: the voltages reach the motors one sample after the one that they were computed from; the first
            ones too, so that until then the motors have the trim.
        encoders: counts per revolution of pitch and yaw; 0 measures exactly.
        rates: ``filtered`` from the angles (second order, 2π·20 rad/s, ζ 0.85), or ``true``.
        noise: standard deviation of white noise on the measured angles, rad.
        seed: of the noise.
    """

    sample_time: float = 0.002
    delay: bool = False
    encoders: tuple[int, int] = (4096, 8192)
    rates: Rates = "filtered"
    noise: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        require_within(self.sample_time, "scenario.digital.sample_time", "s", 1e-4, 1.0)
        require_one_of(self.rates, Rates, "scenario.digital.rates")
        require_within(self.noise, "scenario.digital.noise", "rad", 0.0, 1.0)
        for counts, axis in zip(self.encoders, ("theta", "psi"), strict=True):
            require_within(counts, f"scenario.digital.encoders.{axis}", "counts", 0, 10**7)


@dataclass(frozen=True)
class Disturbance:
    """Volts that act on the motors besides the controller's, beyond the limits, from `time` (s) on.

    A digital controller's rig feels them from its next sample.
    """

    V_p: float = 0.0
    V_y: float = 0.0
    time: float = 0.0

    def __post_init__(self) -> None:
        for value, name in ((self.V_p, "V_p"), (self.V_y, "V_y")):
            require_within(value, f"scenario.disturbance.{name}", "V", -1e3, 1e3)
        require_within(self.time, "scenario.disturbance.time", "s", 0.0, LONGEST)


@dataclass(frozen=True)
class Scenario:
    """One experiment: references step at t = 0 from the initial state. Angles in rad, absolute.

    Attributes:
        theta, psi: references; None stays at rest at the operating point (θ₀, 0).
        duration, samples: t = linspace(0, duration, samples), s.
        initial: θ, ψ, θ̇, ψ̇ at t = 0; an angle None is at rest at the operating point.
        saturation: voltages are limited to `Limits`.
        anti_windup: what the PI integrators do at a limit.
        tracking_time: of back-calculation, s: how fast the integrals follow what the limits leave; None
            is each loop's integral time.
        travel_stops: pitch is stopped at ±`Limits.theta`, without rebound.
        trim_feedforward: the constant trim voltages are added, so that the rig starts at rest.
        rtol: tolerance of the adaptive integration, relative and (in rad, rad/s) absolute.
        digital: the nonlinear rig's controller is a digital one; None is continuous.
        disturbance: of the nonlinear rig's motors.
    """

    theta: float | None = None
    psi: float | None = None
    duration: float = 5.0
    samples: int = 501
    initial: tuple[float | None, float | None, float, float] = field(default=(None, None, 0.0, 0.0))
    saturation: bool = True
    anti_windup: AntiWindup = "clamping"
    tracking_time: float | None = None
    travel_stops: bool = True
    trim_feedforward: bool = True
    rtol: float = 1e-8
    digital: Digital | None = None
    disturbance: Disturbance | None = None

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
        if self.tracking_time is not None:
            require_within(self.tracking_time, "scenario.tracking_time", "s", 1e-4, 1e4)
        require_within(self.rtol, "scenario.rtol", "", 1e-12, 1e-2)
        if self.digital is not None and self.duration / self.digital.sample_time > MOST_SAMPLE_TIMES:
            raise InvalidInputError(
                f"{self.duration / self.digital.sample_time:.0f} samples of the controller are too many",
                field="scenario.digital.sample_time",
                value=self.digital.sample_time,
                hint=f"At most {MOST_SAMPLE_TIMES} fit in the duration.",
            )

    @property
    def times(self) -> Floats:
        """linspace(0, duration, samples), s."""
        return _times(self.duration, self.samples)

    def resolved(self, theta_0: float) -> tuple[float, ...]:
        """References θ, ψ and start θ, ψ, θ̇, ψ̇ with the operating point (θ₀, 0) filled in, rad and rad/s."""
        theta, psi, theta_dot, psi_dot = self.initial
        return (
            theta_0 if self.theta is None else self.theta,
            0.0 if self.psi is None else self.psi,
            theta_0 if theta is None else theta,
            0.0 if psi is None else psi,
            theta_dot,
            psi_dot,
        )


@lru_cache(maxsize=64)  # hardly ever does it change from one update to the next
def _times(duration: float, samples: int) -> Floats:
    return frozen(np.linspace(0.0, duration, samples))
