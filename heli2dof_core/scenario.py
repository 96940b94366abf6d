"""What is asked of a simulation: outer loop, motor limits, scenario. Frozen and validated."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import hypot
from typing import Annotated, Literal

import numpy as np

from .errors import InvalidInputError
from .frozen import frozen
from .quantities import Quantity, documented, require_valid
from .signals import Floats

Outer = Literal["pi", "none"]
Pairing = Literal["diagonal", "cross"]
Model = Literal["linear", "nonlinear"]
Rates = Literal["filtered", "true"]
Measured = Literal["states", "filtered", "observer"]
AntiWindup = Literal["none", "clamping", "back-calculation"]

MOST_SAMPLES = 20_001
MOST_SAMPLE_TIMES = 100_000
"""Most samples of a digital controller in one simulation."""
LONGEST = 600.0
"""Longest simulation, s."""


@documented
@dataclass(frozen=True)
class PIGains:
    """PI(s) = kp (1 + 1/(ti s)) (Section IV of the paper)."""

    kp: Annotated[float, Quantity("proportional gain", "V/rad", -1e6, 1e6, symbol="k_p")]
    ti: Annotated[float, Quantity("integral time", "s", 1e-6, 1e6, symbol="T_i")]

    def __post_init__(self) -> None:
        require_valid(self)


@documented
@dataclass(frozen=True)
class OuterLoop:
    """What drives v: two PI loops (Fig. 3), or the constant Ĝ(0)⁻¹ r of the inner loop alone (Fig. 2).

    `pitch` and `yaw` are the PI controllers of the pitch and the yaw error. With the cross pairing the pitch error
    drives the yaw motor and the other way round, each loop's gain times the sign of its ĝᵢⱼ(0).
    """

    outer: Annotated[Outer, Quantity("pi: two PI loops (Fig. 3); none: inner loop alone (Fig. 2)")] = "pi"
    pitch: PIGains = PIGains(30.0, 0.1)
    yaw: PIGains = PIGains(30.0, 0.1)
    pairing: Annotated[Pairing, Quantity("which error drives which motor")] = "diagonal"
    decoupler: Annotated[
        bool, Quantity("static decoupler Ĝ(0)⁻¹ diag(|ĝ|) between the PI controllers and the motors")
    ] = False

    def __post_init__(self) -> None:
        require_valid(self)


@documented
@dataclass(frozen=True)
class Limits:
    """Limits of the rig."""

    V_p: Annotated[float, Quantity("largest voltage of the pitch motor, either way", "V", 1e-3, 1e6)]
    V_y: Annotated[float, Quantity("largest voltage of the yaw motor, either way", "V", 1e-3, 1e6)]
    theta: Annotated[
        float | None,
        Quantity("pitch travel to either side of level", "rad", 1e-3, 3.2, absent="none where it is free"),
    ] = None

    def __post_init__(self) -> None:
        require_valid(self)


@documented
@dataclass(frozen=True)
class Digital:
    """How the rig's own controller differs from the continuous one of the theory.

    With `delay` the first voltages, too, come one sample late: until then the motors have the trim.
    """

    sample_time: Annotated[
        float, Quantity("time between two samples; voltages are held between them", "s", 1e-4, 1.0)
    ] = 0.002
    delay: Annotated[
        bool, Quantity("voltages reach the motors one sample after the one that they were computed from")
    ] = False
    encoders: Annotated[
        tuple[int, int],
        Quantity(
            "counts per revolution of pitch's and yaw's encoder; 0 measures exactly",
            parts={
                "theta": Quantity(
                    "of pitch's encoder; 0 measures exactly", "counts per revolution", 0, 10**7
                ),
                "psi": Quantity("of yaw's encoder; 0 measures exactly", "counts per revolution", 0, 10**7),
            },
        ),
    ] = (4096, 8192)
    rates: Annotated[
        Rates, Quantity("filtered: from the angles, second order, 2π·20 rad/s, damping 0.85; true: exact")
    ] = "filtered"
    noise: Annotated[
        float, Quantity("standard deviation of white noise on the measured angles", "rad", 0.0, 1.0)
    ] = 0.0
    seed: Annotated[int, Quantity("of the noise", "", 0, 2**32 - 1)] = 0

    def __post_init__(self) -> None:
        require_valid(self)


@documented
@dataclass(frozen=True)
class Disturbance:
    """Volts that act on the motors besides the controller's, beyond the limits.

    A digital controller's rig feels them from its next sample.
    """

    V_p: Annotated[float, Quantity("added to the pitch motor's voltage", "V", -1e3, 1e3)] = 0.0
    V_y: Annotated[float, Quantity("added to the yaw motor's voltage", "V", -1e3, 1e3)] = 0.0
    time: Annotated[float, Quantity("when they begin to act", "s", 0.0, LONGEST)] = 0.0

    def __post_init__(self) -> None:
        require_valid(self)


SAMPLED = 0.002
"""Sample time of a controller that has to sample for its noise alone, s."""

_REST = "at rest at the operating point (θ₀, 0) where left out"


@documented
@dataclass(frozen=True)
class Scenario:
    """One experiment: references step at t = 0 from the initial state. Angles are absolute.

    `digital` makes the nonlinear rig's controller a digital one, None a continuous one; `disturbance` acts on the
    nonlinear rig's motors. t = linspace(0, duration, samples).
    """

    theta: Annotated[float | None, Quantity("pitch reference", "rad", -100.0, 100.0, absent=_REST)] = None
    psi: Annotated[float | None, Quantity("yaw reference", "rad", -100.0, 100.0, absent=_REST)] = None
    duration: Annotated[float, Quantity("length of the experiment", "s", 1e-3, LONGEST)] = 5.0
    samples: Annotated[int, Quantity("number of times, both ends among them", "", 2, MOST_SAMPLES)] = 501
    initial: Annotated[
        tuple[float | None, float | None, float, float],
        Quantity(
            "θ, ψ, θ̇, ψ̇ at t = 0, rad and rad/s; an angle None is " + _REST.removesuffix(" where left out"),
            parts={
                "theta": Quantity("pitch at t = 0", "rad", -100.0, 100.0, absent=_REST),
                "psi": Quantity("yaw at t = 0", "rad", -100.0, 100.0, absent=_REST),
                "theta_dot": Quantity("rate of pitch at t = 0", "rad/s", -100.0, 100.0),
                "psi_dot": Quantity("rate of yaw at t = 0", "rad/s", -100.0, 100.0),
            },
        ),
    ] = (None, None, 0.0, 0.0)
    saturation: Annotated[bool, Quantity("the voltages are limited")] = True
    anti_windup: Annotated[AntiWindup, Quantity("what the PI integrators do at a limit")] = "clamping"
    tracking_time: Annotated[
        float | None,
        Quantity(
            "of back-calculation: how fast the integrals follow what the limits leave",
            "s",
            1e-4,
            1e4,
            absent="each loop's integral time where left out",
        ),
    ] = None
    travel_stops: Annotated[bool, Quantity("pitch is stopped at its limit, without rebound")] = True
    trim_feedforward: Annotated[
        bool, Quantity("the trim voltages are added, so that the rig starts at rest")
    ] = True
    rtol: Annotated[
        float,
        Quantity(
            "tolerance of the nonlinear integration, relative and (rad, rad/s) absolute", "", 1e-12, 1e-2
        ),
    ] = 1e-8
    measured: Annotated[
        Measured,
        Quantity(
            "what the state feedback acts on: the states (a digital controller: as its `rates` say), angles with "
            "filtered rates, or an observer's estimate"
        ),
    ] = "states"
    noise: Annotated[
        tuple[float, float],
        Quantity(
            "standard deviation of white noise on the measured angles at each sample; without a digital controller "
            "one that samples every 2 ms is simulated",
            parts={
                "theta": Quantity("of the noise on measured pitch", "rad", 0.0, 1.0),
                "psi": Quantity("of the noise on measured yaw", "rad", 0.0, 1.0),
            },
        ),
    ] = (0.0, 0.0)
    digital: Digital | None = None
    disturbance: Disturbance | None = None

    def __post_init__(self) -> None:
        require_valid(self)
        if self.digital is not None and self.duration / self.digital.sample_time > MOST_SAMPLE_TIMES:
            raise InvalidInputError(
                f"{self.duration / self.digital.sample_time:.0f} samples of the controller are too many",
                field="digital.sample_time",
                value=self.digital.sample_time,
                hint=f"At most {MOST_SAMPLE_TIMES} fit in the duration.",
            )

    @property
    def controller(self) -> Digital | None:
        """The digital controller that is simulated: the scenario's own, or one that samples for the noise alone."""
        if self.digital is not None or not any(self.noise):
            return self.digital
        return Digital(SAMPLED, encoders=(0, 0), rates="true" if self.measured == "states" else "filtered")

    @property
    def noises(self) -> tuple[float, float]:
        """Standard deviation of the noise on θ and ψ, that of the digital controller among it, rad."""
        own = 0.0 if self.digital is None else self.digital.noise
        theta, psi = self.noise
        return hypot(theta, own), hypot(psi, own)

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
