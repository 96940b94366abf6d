"""The rigs' drawn proportions: documented lengths, and parts that fit one another."""

import dataclasses
import math

import pytest

from heli2dof_core.geometry import RIG_NAMES, RigGeometry, geometry


@pytest.fixture(params=RIG_NAMES)
def rig(request: pytest.FixtureRequest) -> RigGeometry:
    return geometry(request.param)


def test_helicopter_has_the_documented_lengths():
    rig = geometry("helicopter")
    assert rig.mast.height == 0.28
    assert rig.body.length == 0.483
    assert rig.pitch_rotor.distance == 7.75 * 0.0254
    assert rig.yaw_rotor.distance == pytest.approx(-6.625 * 0.0254, abs=1e-12)
    assert rig.pitch_stop == pytest.approx(math.radians(40.5))


def test_aero_has_two_equal_rotors():
    rig = geometry("aero")
    mirrored = dataclasses.replace(rig.yaw_rotor, distance=-rig.yaw_rotor.distance, axis=rig.pitch_rotor.axis)
    assert mirrored == rig.pitch_rotor
    assert rig.pitch_rotor.distance == 0.16743


def test_front_rotor_lies_flat_and_rear_one_stands(rig: RigGeometry):
    assert (rig.pitch_rotor.axis, rig.yaw_rotor.axis) == ("z", "y")
    assert rig.yaw_rotor.distance < 0 < rig.pitch_rotor.distance


def test_propellers_turn_inside_their_guards(rig: RigGeometry):
    for rotor in (rig.pitch_rotor, rig.yaw_rotor):
        assert rotor.radius < rotor.guard_radius - rotor.guard_thickness / 2


def test_guards_clear_the_yoke(rig: RigGeometry):
    for rotor in (rig.pitch_rotor, rig.yaw_rotor):
        inner_edge = abs(rotor.distance) - rotor.guard_radius - rotor.guard_thickness / 2
        assert inner_edge > rig.yoke.depth / 2


def test_body_clears_the_table_at_its_stops(rig: RigGeometry):
    lowest = rig.pivot_height - rig.reach * math.sin(rig.pitch_stop or math.radians(45.0))
    assert lowest > rig.base.height


def test_body_swings_inside_the_fork(rig: RigGeometry):
    assert rig.body.width < rig.yoke.width - 2 * rig.yoke.arm_thickness


def test_geometry_cannot_be_changed(rig: RigGeometry):
    with pytest.raises(dataclasses.FrozenInstanceError):
        rig.name = "other"  # type: ignore[misc]


def test_unknown_rig_is_refused_with_the_known_names():
    with pytest.raises(ValueError, match="'submarine'; there are helicopter, aero"):
        geometry("submarine")  # type: ignore[arg-type]
