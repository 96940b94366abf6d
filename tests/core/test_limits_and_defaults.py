"""What is taken and what is refused at the edges, and what is meant where nothing is given."""

from __future__ import annotations

from math import pi

import pytest

from heli2dof_core import InvalidInputError, OuterLoop, PIGains, PoleSet, design, plant, suggest_pi
from heli2dof_core.paper.printed import PI
from heli2dof_core.scenario import Limits


def test_the_outer_loop_of_who_names_none_is_the_papers():
    loop = OuterLoop()
    assert (loop.pitch, loop.yaw) == (PIGains(*(p.value for p in PI)),) * 2


@pytest.mark.parametrize("poles", [[1, -3, -4, -5], [-3, -4, -5, 1e-9], [0, -3, -4, -5], [2j, -2j, -4, -5]])
def test_pi_is_suggested_for_stable_poles_alone(spec, poles):
    """One pole that is not left of the axis is enough, and it is the poles that are to be changed."""
    with pytest.raises(InvalidInputError) as caught:
        suggest_pi(design(plant(spec.parameters), PoleSet(poles)))
    assert caught.value.field == "poles"


def test_pitch_travels_half_a_turn_to_either_side_at_most():
    """Half a turn is level again, upside down: a stop beyond it cannot be met."""
    assert Limits(24.0, 15.0, pi).theta == pi
    assert Limits(24.0, 15.0).theta is None
    for theta in (1.1 * pi, 2 * pi, 0.0, -0.5):
        with pytest.raises(InvalidInputError) as caught:
            Limits(24.0, 15.0, theta)
        assert caught.value.field == "theta"
    for name in ("V_p", "V_y"):
        for volts in (0.0, -24.0, float("inf"), None):
            with pytest.raises(InvalidInputError) as caught:
                Limits(**{"V_p": 24.0, "V_y": 15.0, name: volts})
            assert caught.value.field == name
