"""The generated meshes: closed where they should be, faces turned outwards, files that are glTF."""

import json
import math
import struct

import numpy as np
import pytest

from app.scene import graphics, machine, shapes
from app.scene.glb import Material, glb
from app.scene.markings import text, yaw_scale
from heli2dof_core.geometry import RIG_NAMES, geometry

FINE = 400  # segments around, for round bodies
HOOP_SECTION = 0.1 * 0.2 - 2 * 0.035**2  # four broken edges
WIRE_SECTION = 5 * 0.1**2 * math.sin(math.radians(36))  # a regular decagon
SOLIDS = {
    "cylinder": (shapes.cylinder(0.3, 0.7, segments=FINE), math.pi * 0.3**2 * 0.7),
    "hoop": (shapes.hoop(1.0, 0.2, 0.1, segments=FINE), 2 * math.pi * HOOP_SECTION),
    "torus": (shapes.torus(1.0, 0.2, segments=FINE), 2 * math.pi * WIRE_SECTION),
    "box": (shapes.box(0.3, 0.4, 0.5), 0.06),
    "rod": (shapes.rod((1, 0, 0), (0, 2, 2), 0.1, segments=FINE), math.pi * 0.01 * 3),
}


def enclosed_volume(mesh: shapes.Mesh) -> float:
    """Volume by the divergence theorem; negative if the faces look inwards."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


@pytest.mark.parametrize("name", SOLIDS)
def test_solids_enclose_their_volume(name: str):
    mesh, volume = SOLIDS[name]
    assert enclosed_volume(mesh) == pytest.approx(volume, rel=0.002)


@pytest.mark.parametrize("rig", RIG_NAMES)
def test_normals_are_unit_vectors_on_the_side_the_faces_show(rig):
    shape = geometry(rig)
    parts = [
        *machine.base_parts(shape),
        *machine.mast_parts(shape),
        *machine.yoke_parts(shape),
        *machine.body_parts(shape),
        *machine.rotor_parts(shape.pitch_rotor, machine.PITCH_COLOR),
    ]
    drawn = [graphics.yaw_scale(shape), graphics.pitch_scale(shape), graphics.nose_pointer(shape)]
    drawn += [graphics.arrow_shaft(), graphics.arrow_head(), graphics.arrow_cap(), graphics.stop(shape, 1)]
    for mesh in [*(mesh for _, mesh in parts), *drawn]:
        length = np.linalg.norm(mesh.normals, axis=1)
        a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
        across = np.cross(b - a, c - a)
        real = np.linalg.norm(across, axis=1) > 1e-12
        shown = mesh.normals[mesh.faces].sum(axis=1)
        assert np.allclose(length[mesh.faces[real]], 1.0, atol=1e-6)
        assert (np.einsum("ij,ij->i", across, shown)[real] > 0).all()


def test_a_blade_that_turns_about_its_thrust_leads_with_the_raised_edge():
    blade = shapes.blade(0.1, 1.0, 0.2, twist=0.6)
    root = blade.vertices[np.abs(blade.vertices[:, 0] - 0.1) < 1e-9]
    leading, trailing = root[root[:, 1].argmax()], root[root[:, 1].argmin()]
    assert leading[2] > trailing[2] + 0.02


def test_yaw_scale_puts_positive_angles_clockwise():
    vertices = yaw_scale(1.0).vertices
    angle = -np.degrees(np.arctan2(vertices[:, 1], vertices[:, 0]))
    # Only one of the two numbers at ±90° carries a minus sign.
    right = ((angle > 80) & (angle < 100)).sum()
    left = ((angle < -80) & (angle > -100)).sum()
    assert left - right == len(text("-90°", 1.0).vertices) - len(text("90°", 1.0).vertices)


@pytest.mark.parametrize("viewer", [(0.36, -0.94), (1.0, 0.0), (-0.5, 0.5)])
def test_numbers_of_the_yaw_scale_stand_upright_for_their_viewer(viewer: tuple[float, float]):
    vertices = yaw_scale(1.0, viewer).vertices[:, :2]
    away = -np.array(viewer) / np.hypot(*viewer)
    for degrees in (-150, -120, -90, -60, -30, 0, 30, 60, 90, 120, 150, 180):
        out = np.array([np.cos(-np.radians(degrees)), np.sin(-np.radians(degrees))])
        inside = vertices[(np.abs(vertices - 1.046 * out) < 0.06).all(axis=1) & (vertices @ out > 1.025)]
        if abs(out @ away) < 0.1:
            continue  # seen from the side
        up = np.sign(out @ away) * out
        right = np.array([up[1], -up[0]])
        # the degree sign stands last, and raised
        last = inside[inside @ right > np.quantile(inside @ right, 0.93)]
        assert (last @ up).mean() > (inside @ up).mean(), degrees


def test_glb_is_binary_gltf_whose_lengths_agree():
    red, blue = Material("#ff0000"), Material("#0000ff", opacity=0.5)
    cube = shapes.box(1, 1, 1)
    data = glb([(red, cube), (blue, cube.moved(x=2)), (red, cube.moved(x=4))])
    magic, version, total = struct.unpack_from("<4sII", data)
    length, kind = struct.unpack_from("<I4s", data, 12)
    document = json.loads(data[20 : 20 + length])
    assert (magic, version, total, kind) == (b"glTF", 2, len(data), b"JSON")
    assert len(document["meshes"][0]["primitives"]) == 2
    assert [m.get("alphaMode") for m in document["materials"]] == [None, "BLEND"]
    assert document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == [1, 0, 0, 1]
    positions = document["accessors"][0]
    assert positions["count"] == 2 * len(cube.vertices)
    assert (positions["min"][0], positions["max"][0]) == (-0.5, 4.5)
    body = document["buffers"][0]["byteLength"]
    assert 20 + length + 8 + body == len(data)
