"""What is drawn about the rig: scales that tell the truth, arrows that push as the model does, views that fit."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from app.scene import graphics
from app.scene.markings import pitch_scale, text
from app.scene.shapes import Mesh
from app.scene.views import first_view, rig_view
from heli2dof_core.geometry import RIG_NAMES, geometry

STATIC = Path(__file__).parents[2] / "static"


def facing(mesh: Mesh, side: int) -> np.ndarray:
    """The vertices of the faces that look to +y (side 1) or -y (-1)."""
    normal = mesh.normals[mesh.faces[:, 0]]
    return mesh.vertices[mesh.faces[np.sign(normal[:, 1]) == side]].reshape(-1, 3)


def numerals(side: int) -> tuple[np.ndarray, np.ndarray]:
    """The vertices of the numbers that are read from a side, and their angles in degrees."""
    vertices = facing(pitch_scale(1.0, 40), side)
    vertices = vertices[np.hypot(vertices[:, 0], vertices[:, 2]) > 1.0200]
    return vertices, np.degrees(np.arctan2(vertices[:, 2], vertices[:, 0]))


@pytest.mark.parametrize("side", [-1, 1])
def test_pitch_scale_counts_upwards_from_either_side(side: int):
    _, angle = numerals(side)
    digits = [3 * len(text(word, 1.0).faces) for word in ("-40°", "40°")]
    assert [(angle < -35).sum(), (angle > 35).sum()] == digits


@pytest.mark.parametrize(("side", "right"), [(-1, 1), (1, -1)])
def test_numbers_of_the_pitch_scale_read_to_the_right_from_either_side(side: int, right: int):
    vertices, angle = numerals(side)
    zero = vertices[np.abs(angle) < 5]
    digit = zero[zero[:, 2] < 0]  # the degree sign stands above
    middle = (zero[:, 0].min() + zero[:, 0].max()) / 2
    assert right * (middle - digit[:, 0].mean()) > 0.002


@pytest.mark.parametrize("rig", RIG_NAMES)
def test_pointers_end_at_their_scales(rig):
    shape = geometry(rig)
    nose = graphics.nose_pointer(shape).vertices
    assert 0 < graphics.pitch_radius(shape) - nose[:, 0].max() < 0.004
    assert nose[:, 0].min() < shape.reach
    yaw = graphics.yaw_pointer(shape).vertices
    assert 0 < graphics.yaw_radius(shape) - yaw[:, 0].max() < 0.006


def test_pitch_scale_of_the_helicopter_reaches_its_stops():
    shape = geometry("helicopter")
    vertices = graphics.pitch_scale(shape).vertices
    angle = np.degrees(np.arctan2(vertices[:, 2], vertices[:, 0]))
    assert shape.pitch_stop is not None
    assert angle.max() > math.degrees(shape.pitch_stop) > 40


@pytest.mark.parametrize("side", [1, -1])
def test_a_stop_lies_beyond_the_angle_that_it_ends(side: int):
    vertices = graphics.stop(geometry("helicopter"), side).vertices
    assert (side * vertices[:, 2]).min() == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("rig", RIG_NAMES)
def test_arrows_push_as_the_model_does(rig):
    """A positive pitch voltage lifts the nose, a positive yaw voltage turns it clockwise from above."""
    shape = geometry(rig)
    up = np.array([0.0, 0.0, 1.0])
    for rotor, axis in ((shape.pitch_rotor, "pitch"), (shape.yaw_rotor, "yaw")):
        starts = graphics.arrow_starts(rotor)
        for name, sign in (("positive", 1), ("negative", -1)):
            start, turn = starts[name]
            c, s = math.cos(turn), math.sin(turn)
            push = np.array([0.0, -s * up[2], c * up[2]])
            torque = np.cross(start, push)
            # Pitch lifts the nose about -y; yaw turns clockwise, about -z.
            assert np.sign(-torque[1 if axis == "pitch" else 2]) == sign
            hub = np.array([rotor.distance, 0.0, 0.0])
            assert (np.array(start) - hub) @ push > 0  # clear of the motor


def test_page_and_server_agree_on_the_arrow_head():
    written = re.search(r"const HEAD_LENGTH = ([\d.]+);", (STATIC / "scene/pose.js").read_text())
    assert written is not None
    assert float(written[1]) == graphics.HEAD_LENGTH
    assert graphics.arrow_head().vertices[:, 2].max() == graphics.HEAD_LENGTH


@pytest.mark.parametrize("rig", RIG_NAMES)
@pytest.mark.parametrize("aspect", [1.2, 1.6])
def test_the_first_view_shows_the_rig_and_its_scales(rig, aspect: float):
    shape = geometry(rig)
    view = first_view(shape)
    eye, target = np.array(view["position"]), np.array(view["look_at"])
    ahead = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    pivot = np.array([0.0, 0.0, shape.pivot_height])
    points = np.concatenate(
        [graphics.pitch_scale(shape).vertices + pivot, graphics.yaw_scale(shape).vertices]
    )
    depth = (points - eye) @ ahead * math.tan(view["fov"] / 2)
    across = (points - eye) @ right / depth / aspect
    upwards = (points - eye) @ np.cross(right, ahead) / depth
    assert np.abs(across).max() < 1
    assert np.abs(upwards).max() < 1


def test_aero_has_two_equal_rotors_at_equal_arms():
    shape = geometry("aero")
    front, rear = shape.pitch_rotor, shape.yaw_rotor
    assert (front.axis, rear.axis, front.distance) == ("z", "y", -rear.distance)
    assert (front.radius, front.blades, front.guard_radius) == (rear.radius, rear.blades, rear.guard_radius)


def test_views_are_told_for_every_rig():
    assert rig_view(geometry("aero"))["pivot_height"] == pytest.approx(0.295)
    assert rig_view(geometry("helicopter"))["reach"] < rig_view(geometry("helicopter"))["outer"]
    # what a hand can hold: the nose is as far out as the longer of the arms and a guard
    for rig in map(geometry, RIG_NAMES):
        told = rig_view(rig)
        assert told["arms"]["yaw"] < 0.0 < told["arms"]["pitch"]
        assert told["arms"]["pitch"] + told["guard"] == pytest.approx(told["reach"])
        assert told["offsets"] == {"pitch": rig.pitch_rotor.offset, "yaw": rig.yaw_rotor.offset}
