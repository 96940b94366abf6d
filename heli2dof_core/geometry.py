"""What each rig looks like, in metres: all that a scene needs to draw it, and nothing about how.

Axes: the origin is on the ground under the mast, x points forward (from the yaw rotor to the pitch
rotor) at ψ = 0, y to the left, z up. The body's own origin is the pitch axis. Positive pitch lifts
the pitch rotor; positive yaw turns the nose clockwise as seen from above, so that the centre of
mass is at l·(cos ψ cos θ, −sin ψ cos θ, sin θ) from the pivot.

Lengths marked *documented* are Quanser's; the others were estimated from the published photographs
of the rigs and only serve the eye. No dynamics may be taken from here.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

from .presets import RigName

"""The rigs that can be drawn."""

Axis = Literal["y", "z"]
"""A rotor's axis in the body's frame: z for a horizontal disk, y for a vertical one."""


@dataclass(frozen=True, slots=True)
class Base:
    """The plate or box that stands on the table; lengths in metres."""

    length: float
    width: float
    height: float
    corner_radius: float


@dataclass(frozen=True, slots=True)
class Mast:
    """The fixed column between base and yoke; lengths in metres."""

    height: float
    radius: float


@dataclass(frozen=True, slots=True)
class Yoke:
    """The fork that turns about the mast by ψ and carries the pitch axle; lengths in metres."""

    width: float
    """Between the outer faces of the two arms."""
    depth: float
    """Of an arm, along x."""
    height: float
    """From the top of the mast to the pitch axle."""
    arm_thickness: float


@dataclass(frozen=True, slots=True)
class Rotor:
    """A propeller with its motor and its guard; lengths in metres, in the body's frame."""

    distance: float
    """Along x from the pitch axle, negative towards the tail; the thrust's lever arm."""
    axis: Axis
    offset: float
    """Of the propeller's plane from the body's axis, along the rotor's axis."""
    radius: float
    guard_radius: float
    guard_height: float
    guard_thickness: float
    blades: int
    motor_radius: float
    motor_length: float


@dataclass(frozen=True, slots=True)
class Body:
    """The beam that tilts about the pitch axle by θ; lengths in metres."""

    length: float
    width: float
    height: float


@dataclass(frozen=True, slots=True)
class RigGeometry:
    """One rig: its parts from the table upwards; lengths in metres, angles in radians."""

    name: RigName
    title: str
    source: str
    base: Base
    mast: Mast
    yoke: Yoke
    body: Body
    pitch_rotor: Rotor
    yaw_rotor: Rotor
    pitch_stop: float | None
    """Largest |θ| that the travel stops allow; None where no source gives one."""

    @property
    def pivot_height(self) -> float:
        """Height of the pitch axle above the ground in metres."""
        return self.base.height + self.mast.height + self.yoke.height

    @property
    def reach(self) -> float:
        """Largest distance of a guard's rim from the pitch axle in metres."""
        rotors = (self.pitch_rotor, self.yaw_rotor)
        return max(abs(rotor.distance) + rotor.guard_radius for rotor in rotors)


_HELICOPTER = RigGeometry(
    name="helicopter",
    title="Quanser 2-DOF Helicopter",
    source=(
        "Quanser 2-DOF Helicopter user manual: mast 0.28 m, body 0.483 m, thrust arms r_p = "
        "0.19685 m (7.75 in) and r_y = 0.168275 m (6.625 in), propellers 0.20 m across, pitch "
        "travel ±40.5°; the rest estimated from photographs"
    ),
    base=Base(length=0.26, width=0.26, height=0.022, corner_radius=0.018),
    mast=Mast(height=0.28, radius=0.0145),
    yoke=Yoke(width=0.098, depth=0.042, height=0.062, arm_thickness=0.009),
    body=Body(length=0.483, width=0.022, height=0.025),
    pitch_rotor=Rotor(
        distance=0.19685, axis="z", offset=0.046, radius=0.100,
        guard_radius=0.1155, guard_height=0.030, guard_thickness=0.0035,
        blades=2, motor_radius=0.0185, motor_length=0.068,
    ),
    yaw_rotor=Rotor(
        distance=-0.168275, axis="y", offset=-0.046, radius=0.100,
        guard_radius=0.1155, guard_height=0.030, guard_thickness=0.0035,
        blades=2, motor_radius=0.0185, motor_length=0.068,
    ),
    pitch_stop=math.radians(40.5),
)  # fmt: skip

_AERO = RigGeometry(
    name="aero",
    title="Quanser Aero",
    source=(
        "Quanser Aero 2: two equal rotors at 0.16743 m from the pitch axle (documented), turned "
        "to horizontal front and vertical rear as its 2-DOF helicopter; the rest estimated from "
        "photographs"
    ),
    base=Base(length=0.20, width=0.20, height=0.085, corner_radius=0.022),
    mast=Mast(height=0.115, radius=0.026),
    yoke=Yoke(width=0.120, depth=0.050, height=0.095, arm_thickness=0.014),
    body=Body(length=0.178, width=0.036, height=0.036),
    pitch_rotor=Rotor(
        distance=0.16743, axis="z", offset=0.0, radius=0.066,
        guard_radius=0.078, guard_height=0.046, guard_thickness=0.0065,
        blades=8, motor_radius=0.019, motor_length=0.040,
    ),
    yaw_rotor=Rotor(
        distance=-0.16743, axis="y", offset=0.0, radius=0.066,
        guard_radius=0.078, guard_height=0.046, guard_thickness=0.0065,
        blades=8, motor_radius=0.019, motor_length=0.040,
    ),
    pitch_stop=None,
)  # fmt: skip

_RIGS: dict[RigName, RigGeometry] = {"helicopter": _HELICOPTER, "aero": _AERO}
RIG_NAMES: tuple[RigName, ...] = get_args(RigName)
"""Every name that :func:`geometry` knows."""


def geometry(rig: RigName) -> RigGeometry:
    """Return what the named rig looks like.

    Raises:
        ValueError: if there is no rig of that name; the message lists those there are.
    """
    try:
        return _RIGS[rig]
    except KeyError:
        known = ", ".join(RIG_NAMES)
        raise ValueError(f"no rig is called {rig!r}; there are {known}") from None
