"""The rig's parts, each a list of meshes with their materials, in the frame of the part.

Frames: `base` and `yoke` stand on the ground under the mast, `body` sits on the pitch axle, a rotor
in its hub. All are drawn at θ = ψ = 0; lengths are in metres.
"""

from __future__ import annotations

import math

from heli2dof_core.geometry import RigGeometry, Rotor

from .glb import Material, Part
from .shapes import (
    Mesh,
    blade,
    box,
    cylinder,
    extruded,
    hoop,
    lathe,
    merged,
    rod,
    rounded,
    torus,
)

PITCH_COLOR = "#c8553d"
"""The colour of the pitch axis throughout the page: its rotor, its curves, its poles."""
YAW_COLOR = "#2f6f9f"
"""The colour of the yaw axis throughout the page."""

ALUMINIUM = Material("#aab0b7", metallic=0.7, roughness=0.42)
STEEL = Material("#83888f", metallic=0.85, roughness=0.35)
ANODISED = Material("#272a2f", metallic=0.3, roughness=0.55)
PLASTIC = Material("#1f2226", roughness=0.5)
RUBBER = Material("#15171a", roughness=0.9)
BRASS = Material("#a98a52", metallic=0.8, roughness=0.4)


def base_parts(rig: RigGeometry) -> list[Part]:
    """Return what stands on the table."""
    base = rig.base
    foot = 0.006
    outline = rounded(base.length, base.width, base.corner_radius)
    body = extruded(outline, base.height - foot, bevel=0.0025).moved(z=foot)
    parts: list[Part] = [(ANODISED, body)]
    for sx in (-1, 1):
        for sy in (-1, 1):
            x, y = sx * (base.length / 2 - 0.028), sy * (base.width / 2 - 0.028)
            parts.append((RUBBER, cylinder(0.013, foot + 0.001, segments=20).moved(x, y)))
            screw = cylinder(0.0048, 0.0032, bevel=0.001, segments=14)
            parts.append((STEEL, screw.moved(x, y, base.height - 0.001)))
    top = base.height
    if rig.name == "aero":
        plate = extruded(rounded(base.length * 0.86, base.width * 0.86, 0.018), 0.004, bevel=0.001)
        parts.append((ALUMINIUM, plate.moved(z=top - 0.001)))
        stripe = box(0.0016, base.width * 0.62, 0.006, bevel=0.0004)
        parts.append((Material("#9fc7e8", roughness=0.4), stripe.moved(base.length / 2, 0, 0.055)))
    return parts


def mast_parts(rig: RigGeometry) -> list[Part]:
    """Return the fixed column: flange, slip ring and mast."""
    mast, top = rig.mast, rig.base.height
    flange = cylinder(mast.radius * 2.6, 0.010, bevel=0.002).moved(z=top)
    column = cylinder(mast.radius, mast.height, segments=36).moved(z=top)
    neck = cylinder(mast.radius * 1.7, 0.036, bevel=0.003).moved(z=top + 0.010)
    collar = cylinder(mast.radius * 1.55, 0.030, bevel=0.003)
    return [
        (STEEL, flange),
        (ANODISED if rig.name == "aero" else ALUMINIUM, column),
        (ANODISED, neck),
        (ANODISED, collar.moved(z=top + mast.height - 0.044)),
    ]


def yoke_parts(rig: RigGeometry) -> list[Part]:
    """Return what turns with ψ: fork, bearing and pitch encoder."""
    yoke, pivot = rig.yoke, rig.pivot_height
    parts: list[Part] = [(ALUMINIUM, fork(rig))]
    bearing = cylinder(rig.mast.radius * 1.35, 0.014, bevel=0.002)
    parts.append((STEEL, bearing.moved(z=pivot - yoke.height - 0.013)))
    face = yoke.width / 2
    encoder = cylinder(0.0175, 0.026, bevel=0.002).turned("x", -math.pi / 2)
    parts.append((PLASTIC, encoder.moved(y=face, z=pivot)))
    return parts


def body_parts(rig: RigGeometry) -> list[Part]:
    """Return what tilts with θ, without the propellers: beam, axle, motors and guards."""
    body, yoke = rig.body, rig.yoke
    middle = (rig.pitch_rotor.distance + rig.yaw_rotor.distance) / 2
    beam = box(body.length, body.width, body.height, bevel=0.0016).moved(x=middle * 0.1)
    hub = box(0.062, body.width * 1.7, body.height * 1.5, bevel=0.003)
    reach = yoke.width / 2 + 0.006
    axle = rod((0, -reach, 0), (0, yoke.width / 2, 0), 0.0052, segments=16)
    knob = cylinder(0.010, 0.005, bevel=0.0012).turned("x", math.pi / 2).moved(y=-reach + 0.003)
    parts: list[Part] = [
        (ALUMINIUM, beam),
        (ANODISED, hub),
        (STEEL, axle),
        (BRASS, knob),
    ]
    for rotor, color in ((rig.pitch_rotor, PITCH_COLOR), (rig.yaw_rotor, YAW_COLOR)):
        for material, mesh in _mount(rotor, color):
            parts.append((material, placed(mesh, rotor)))
    return parts


def rotor_parts(rotor: Rotor, color: str) -> list[Part]:
    """Return the propeller alone, in its hub's frame and about its own axis."""
    root, tip = 0.008, rotor.radius
    chord = 0.026 if rotor.blades == 2 else 0.020
    one = blade(root, tip, chord, twist=math.radians(38.0))
    blades = merged(one.turned("z", 2 * math.pi * k / rotor.blades) for k in range(rotor.blades))
    nose = lathe([(0.0125, -0.004), (0.0125, 0.004), (0.0105, 0.010), (0.006, 0.0145), (0, 0.016)])
    surface = Material(color, roughness=0.42)
    return [(surface, facing(blades, rotor)), (PLASTIC, facing(nose, rotor))]


def hub_position(rotor: Rotor) -> tuple[float, float, float]:
    """Return where the propeller's hub is in the body's frame (metres)."""
    if rotor.axis == "z":
        return (rotor.distance, 0.0, rotor.offset)
    return (rotor.distance, rotor.offset, 0.0)


def fork(rig: RigGeometry) -> Mesh:
    """Return the yoke's U: a floor on the mast and two arms with round heads."""
    yoke, pivot = rig.yoke, rig.pivot_height
    floor = box(yoke.depth, yoke.width, yoke.arm_thickness, bevel=0.0012)
    arms = []
    height = yoke.height + yoke.depth / 2
    for side in (-1, 1):
        arm = extruded(
            rounded(yoke.depth, height, yoke.depth / 2, steps=10), yoke.arm_thickness, bevel=0.0012
        )
        upright = arm.turned("x", math.pi / 2).moved(y=yoke.arm_thickness / 2)
        centre = pivot + yoke.depth / 2 - height / 2
        arms.append(upright.moved(y=side * (yoke.width - yoke.arm_thickness) / 2, z=centre))
    return merged([floor.moved(z=pivot - yoke.height + yoke.arm_thickness / 2), *arms])


def _guard(rotor: Rotor) -> Mesh:
    """Return the guard's ring about z, in the rotor's own frame."""
    wall = hoop(rotor.guard_radius, rotor.guard_height, rotor.guard_thickness)
    return wall.moved(z=-rotor.guard_height * 0.12)


def _mount(rotor: Rotor, color: str) -> list[Part]:
    """Return motor, clamp, spokes and guard in the rotor's own frame: z is the axis of spin."""
    low = -rotor.guard_height * 0.62 + rotor.guard_height * 0.06
    rim = torus(rotor.guard_radius, rotor.guard_thickness * 1.7)
    top = rotor.guard_height * 0.38
    motor = cylinder(rotor.motor_radius, rotor.motor_length - 0.010, bevel=0.002)
    boss = cylinder(rotor.motor_radius * 0.55, 0.012, bevel=0.001, segments=20)
    shaft = cylinder(0.0025, 0.012, segments=10)
    spokes = []
    for k in range(4):
        angle = math.pi / 4 + k * math.pi / 2
        c, s = math.cos(angle), math.sin(angle)
        near, far = rotor.motor_radius * 0.9, rotor.guard_radius
        spokes.append(rod((near * c, near * s, low), (far * c, far * s, low), 0.0026))
    clamp = hoop(rotor.motor_radius + 0.003, 0.014, 0.007, segments=32)
    return [
        (STEEL, motor.moved(z=-rotor.motor_length)),
        (BRASS, boss.moved(z=-0.019)),
        (STEEL, shaft.moved(z=-0.012)),
        (PLASTIC, clamp.moved(z=low)),
        (PLASTIC, merged(spokes)),
        (PLASTIC, _guard(rotor)),
        (Material(color, roughness=0.5), rim.moved(z=top)),
    ]


def facing(mesh: Mesh, rotor: Rotor) -> Mesh:
    """Turn a mesh from the rotor's own frame (spin about z) into the body's directions."""
    return mesh if rotor.axis == "z" else mesh.turned("x", math.pi / 2)


def placed(mesh: Mesh, rotor: Rotor) -> Mesh:
    """Put a mesh from the rotor's own frame where the rotor is in the body's frame."""
    return facing(mesh, rotor).moved(*hub_position(rotor))
