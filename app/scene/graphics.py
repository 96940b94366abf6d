"""What is drawn about the rig and not built: scales, stops, pointers, thrust arrows, ghosts, blur.

Frames and lengths as in :mod:`.machine`. Meshes here have one colour each, which the page sets.
"""

from __future__ import annotations

import math

from heli2dof_core.geometry import RigGeometry, Rotor

from . import markings
from .glb import Material, Part
from .machine import facing, fork, hub_position, placed
from .shapes import Mesh, box, cylinder, lathe, merged, ring, sector, triangle
from .views import first_view

_PITCH_LIMIT = 60
"""Degrees that the pitch scale shows where no source gives the rig's travel."""
_SMEAR = ((0.16, 0.13), (0.34, 0.10), (0.56, 0.07), (0.80, 0.05))
"""Half-angles in radians and opacities of the fans that make up a blurred blade."""

SHAFT_RADIUS, HEAD_RADIUS, HEAD_LENGTH = 0.0052, 0.0125, 0.026
"""Of a thrust arrow, in metres; static/scene/pose.js knows HEAD_LENGTH too."""


def yaw_radius(rig: RigGeometry) -> float:
    """Return the ground scale's radius in metres: around the base, and whole in the first view."""
    return min(rig.reach + 0.02, 0.285)


def pitch_radius(rig: RigGeometry) -> float:
    """Return the pitch scale's radius in metres: just clear of the nose."""
    return rig.reach + 0.035


def yaw_scale(rig: RigGeometry) -> Mesh:
    """Return the scale of ψ on the ground."""
    radius = yaw_radius(rig)
    circle = ring(radius - 0.0018, radius, segments=96)
    x, y, _ = first_view(rig)["position"]
    return merged([circle, markings.yaw_scale(radius, (x, y))]).moved(z=0.0012)


def pitch_scale(rig: RigGeometry) -> Mesh:
    """Return the scale of θ about the pitch axle; it turns with the yoke."""
    stop = rig.pitch_stop
    limit = _PITCH_LIMIT if stop is None else 10 * int(math.degrees(stop) / 10)
    return markings.pitch_scale(pitch_radius(rig), limit)


def stop(rig: RigGeometry, side: int) -> Mesh:
    """Return a travel stop about the pitch axle at θ = 0, above (side 1) or below (-1) the nose."""
    block = box(0.034, 0.022, 0.009, bevel=0.001)
    return block.moved(pitch_radius(rig) - 0.012, 0.0, side * 0.0045)


def nose_pointer(rig: RigGeometry) -> Mesh:
    """Return the arrow head at the nose that points at the pitch scale, in the body's frame."""
    radius = pitch_radius(rig)
    front = triangle(radius - 0.001, rig.reach - 0.002, 0.020)
    back = front.turned("x", math.pi)
    return merged([front, back]).turned("x", math.pi / 2)


def yaw_pointer(rig: RigGeometry) -> Mesh:
    """Return the arrow head that follows the nose along the inside of the yaw scale."""
    radius = yaw_radius(rig)
    return triangle(radius - 0.004, radius - 0.042, 0.030).moved(z=0.0020)


def arrow_shaft() -> Mesh:
    """Return a thrust arrow's shaft along +z, one metre long: the page scales it."""
    return cylinder(SHAFT_RADIUS, 1.0, segments=16)


def arrow_head() -> Mesh:
    """Return a thrust arrow's head along +z, its foot at the origin."""
    return lathe([(0.0, 0.0), (HEAD_RADIUS, 0.0), (0.0, HEAD_LENGTH)], 20)


def arrow_cap() -> Mesh:
    """Return the disk at the tip of an arrow that can grow no further."""
    return cylinder(HEAD_RADIUS * 1.7, 0.004, bevel=0.001, segments=28).moved(z=HEAD_LENGTH)


def arrow_starts(rotor: Rotor) -> dict[str, tuple[tuple[float, float, float], float]]:
    """Return where thrust arrows start in the body's frame and how +z turns into them.

    Returns:
        By sign of the voltage: the start in metres and the turn about x in radians. A positive
        pitch voltage lifts the nose; a positive yaw voltage pushes the tail to +y.
    """
    x, y, z = hub_position(rotor)
    nose, motor = 0.020, rotor.motor_length + 0.006
    if rotor.axis == "z":
        return {"positive": ((x, y, z + nose), 0.0), "negative": ((x, y, z - motor), math.pi)}
    return {
        "positive": ((x, y + motor, z), -math.pi / 2),
        "negative": ((x, y - nose, z), math.pi / 2),
    }


def blur_parts(rotor: Rotor, color: str) -> list[Part]:
    """Return what the eye sees of fast blades: a faint disk, denser where the blades pass."""
    root, tip = rotor.radius * 0.14, rotor.radius * 0.99
    parts: list[Part] = []
    for half, opacity in _SMEAR[: 4 if rotor.blades == 2 else 1]:
        fans = [
            sector(root, tip, middle - half, middle + half, steps=12)
            for middle in (2 * math.pi * k / rotor.blades for k in range(rotor.blades))
        ]
        parts.append((_haze(color, opacity), facing(merged(fans), rotor)))
    parts.append((_haze(color, 0.14), facing(ring(root, tip), rotor)))
    return parts


def ghost_yoke(rig: RigGeometry) -> Mesh:
    """Return a ghost's pointer on the yaw scale."""
    return yaw_pointer(rig).moved(z=-0.0006)


def reference_yoke(rig: RigGeometry) -> Mesh:
    """Return the reference's fork and its pointer on the yaw scale."""
    return merged([fork(rig), ghost_yoke(rig)])


def ghost_body(rig: RigGeometry) -> Mesh:
    """Return a ghost's body: beam, guards as thin bands and the nose's pointer.

    A little larger than the rig's own, so that the two do not flicker where they coincide.
    """
    beam = box(rig.body.length + 0.002, rig.body.width + 0.002, rig.body.height + 0.002)
    bands = []
    for rotor in (rig.pitch_rotor, rig.yaw_rotor):
        radius, half = rotor.guard_radius + rotor.guard_thickness, 0.55 * rotor.guard_height
        bands.append(placed(lathe([(radius, -half), (radius, half)], 40), rotor))
    return merged([beam, *bands, nose_pointer(rig)])


def ghost_label(rig: RigGeometry, place: int) -> tuple[float, float, float]:
    """Return where a ghost's name stands in the body's frame (metres).

    Each place is higher than the one before, so that names of ghosts that fly together are apart.
    """
    nose = rig.pitch_rotor
    return (nose.distance + nose.guard_radius, 0.0, nose.guard_height + 0.040 + 0.034 * place)


def _haze(color: str, opacity: float) -> Material:
    return Material(color, roughness=0.9, opacity=opacity, double_sided=True)
