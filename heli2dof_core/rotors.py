"""The rig as it is: rotors that take time to come up to speed, thrust that curves, and friction in the axes.

Rotor j turns as τ_j v̇_j = V_j − v_j, where v_j, V, is the voltage that would hold its present speed. Thrust follows
φ(v), not V; in the equations of motion (Eqs. 9–12) the torques are K φ(v).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import copysign, sqrt
from typing import Annotated, Literal

import numpy as np

from .errors import InvalidInputError
from .frozen import Frozen
from .kernels.update_layout import AT_ONCE, AT_REST
from .plant import Plant
from .quantities import Quantity, documented, require_valid
from .signals import AXES, Floats, fixed

Curve = Literal["linear", "quadratic"]
USUAL_LAG = 0.16
"""Time constant of a real rig's rotors, s: of a first-generation Aero's 0.156, of an Aero 2's 0.162 to 0.169."""


@documented
@dataclass(frozen=True)
class Rotor:
    """One motor with its rotor.

    A quadratic curve is φ(v) = s·sign(v)·max(|v| − v_d, 0)², with s so that φ(v_m) = v_m. A first-generation Aero's
    rotors reach 63 % of their speed in 0.156 s, Aero 2's in 0.162 to 0.169 s; their speeds begin near 1 V, and lift
    grows with speed².
    """

    tau: Annotated[
        float,
        Quantity(
            "time constant of the rotor's speed; 0, and what is below 1 µs, follows at once",
            "s",
            0.0,
            10.0,
            symbol="τ",
        ),
    ] = 0.0
    curve: Annotated[Curve, Quantity("thrust by rotor speed: linear, or quadratic beyond the dead zone")] = (
        "linear"
    )
    dead_zone: Annotated[
        float,
        Quantity(
            "speed, as a voltage, up to which a quadratic curve gives no thrust", "V", 0.0, 1e3, symbol="v_d"
        ),
    ] = 0.0
    matched_at: Annotated[
        float | None,
        Quantity(
            "where a quadratic curve meets the linear one",
            "V",
            1e-3,
            1e6,
            absent="the trim voltage where left out, or the limit of a motor that rests at the trim",
            symbol="v_m",
        ),
    ] = None

    def __post_init__(self) -> None:
        require_valid(self)
        if self.tau < AT_ONCE:
            object.__setattr__(self, "tau", 0.0)
        if self.matched_at is not None and not self.matched_at > self.dead_zone:
            raise InvalidInputError(
                f"the curve is matched at {self.matched_at:g} V, within the dead zone of {self.dead_zone:g} V",
                field="matched_at",
                value=self.matched_at,
                hint="Match it at a voltage above the dead zone.",
            )

    @property
    def plain(self) -> bool:
        """Whether it is the paper's: thrust follows the voltage at once."""
        return self.tau == 0.0 and self.curve == "linear"


@documented
@dataclass(frozen=True)
class Friction:
    """Coulomb friction of one axis with stiction.

    F_c acts against the motion; at rate 0 the axis holds while the rest of the torque is below F_s.
    """

    coulomb: Annotated[float, Quantity("torque against the motion", "N·m", 0.0, 1e3, symbol="F_c")] = 0.0
    static: Annotated[
        float | None,
        Quantity(
            "torque that an axis at rest withstands; less than the one against the motion counts as equal",
            "N·m",
            0.0,
            1e3,
            absent="as against the motion where left out",
            symbol="F_s",
        ),
    ] = None

    def __post_init__(self) -> None:
        require_valid(self)

    @property
    def breakaway(self) -> float:
        """F_s, N·m."""
        return max(self.coulomb, self.static or 0.0)


@dataclass(frozen=True)
class Rotors:
    """Both motors' rotors."""

    pitch: Rotor = Rotor()
    yaw: Rotor = Rotor()

    @property
    def both(self) -> tuple[Rotor, Rotor]:
        """Pitch's and yaw's."""
        return self.pitch, self.yaw

    @property
    def lag(self) -> bool:
        """Whether either takes time."""
        return self.pitch.tau > 0.0 or self.yaw.tau > 0.0


@dataclass(frozen=True)
class AxisFriction:
    """Both axes' friction."""

    pitch: Friction = Friction()
    yaw: Friction = Friction()

    @property
    def both(self) -> tuple[Friction, Friction]:
        """Pitch's and yaw's."""
        return self.pitch, self.yaw


@dataclass(frozen=True)
class Actuators(Frozen):
    """Rotors and friction as numbers, on one rig at its operating point.

    Attributes:
        tau: time constants, (2,), s.
        dead_zone: v_d, (2,), V; 0 of a linear curve.
        square: s of the quadratic curves, (2,), 1/V; 0 of a linear one.
        coulomb, breakaway: F_c and F_s of both axes, (2,), N·m.
        trim: voltages at rest, (2,), V: those whose thrusts φ are the linear rig's trim voltages.
        slope: φ′ there, (2,): how much harder the motors act on small changes than the linear curve says.
        plain: whether all is as in the paper's model.
    """

    tau: Floats
    dead_zone: Floats
    square: Floats
    coulomb: Floats
    breakaway: Floats
    trim: Floats
    slope: Floats
    plain: bool

    @classmethod
    def none(cls, plant: Plant) -> Actuators:
        """Those of the paper's rig."""
        return actuators(plant, Rotors(), AxisFriction(), (1.0, 1.0))

    @cached_property
    def lags(self) -> bool:
        """Whether either rotor takes time."""
        return bool(self.tau.any())

    @cached_property
    def idle(self) -> tuple[str, ...]:
        """The axes whose motors' thrust has no slope at the trim."""
        return tuple(axis for axis, slope in zip(AXES, self.slope.tolist(), strict=True) if slope == 0.0)

    @cached_property
    def constants(self) -> Floats:
        """Their part of `kernels.rig`'s constants, (10,)."""
        return fixed(np.concatenate((self.tau, self.dead_zone, self.square, self.coulomb, self.breakaway)))


def actuators(plant: Plant, rotors: Rotors, friction: AxisFriction, limits: tuple[float, float]) -> Actuators:
    """The numbers of rotors and friction on a rig.

    Args:
        plant: the rig at its operating point.
        rotors: both.
        friction: of both axes.
        limits: of both voltages, V.

    Raises:
        InvalidInputError: a curve cannot be matched, as its dead zone reaches beyond the motor's limit.
    """
    square, dead, trim, slope = [0.0, 0.0], [0.0, 0.0], plant.trim.tolist(), [1.0, 1.0]
    for i, (rotor, limit, axis) in enumerate(zip(rotors.both, limits, AXES, strict=True)):
        if rotor.curve == "linear":
            continue
        u, v_d = trim[i], rotor.dead_zone
        v_m = rotor.matched_at or (abs(u) if abs(u) > max(v_d, AT_REST * limit) else limit)
        if not v_m > v_d:
            raise InvalidInputError(
                f"the dead zone of the {axis} motor's rotor, {v_d:g} V, reaches beyond its limit of {limit:g} V",
                field=f"rotors.{axis}.dead_zone",
                value=v_d,
                hint="Make it smaller, or say where the curve is matched.",
            )
        s = v_m / (v_m - v_d) ** 2
        square[i], dead[i], slope[i] = s, v_d, 2.0 * sqrt(s * abs(u))
        trim[i] = copysign(v_d + sqrt(abs(u) / s), u) if u else 0.0
    both = friction.both
    return Actuators(
        tau=np.array([rotor.tau for rotor in rotors.both]),
        dead_zone=np.array(dead),
        square=np.array(square),
        coulomb=np.array([own.coulomb for own in both]),
        breakaway=np.array([own.breakaway for own in both]),
        trim=np.array(trim),
        slope=np.array(slope),
        plain=all(r.plain for r in rotors.both) and not any(own.breakaway for own in both),
    )
