"""Edges of a design: the largest step and the largest gain, against closed forms."""

from __future__ import annotations

import pytest

from heli2dof_core.labs.edges import largest_gain, largest_step
from heli2dof_core.request import spec_of

SLOW = [{"re": -3, "im": 4}, {"re": -3, "im": -4}, -9.25, -8.76]


def test_a_gain_beyond_the_largest_makes_the_loop_unstable() -> None:
    """By Routh pitch alone, s(s² + 6s + 25) + b kp (s + 10), is stable while b kp < 37.5."""
    spec = spec_of({"poles": SLOW, "loops": {"pitch": {"kp": 30, "ti": 0.1}}})
    by_routh = 37.5 * spec.parameters.alpha / spec.parameters.K_pp
    assert largest_gain(spec, "pitch") == pytest.approx(by_routh, rel=1e-3)


def test_there_is_no_largest_gain_where_every_one_is_stable() -> None:
    """With the zero at −1 the same loop bears any gain: 6 b kp + 150 exceeds b kp."""
    spec = spec_of({"poles": SLOW, "loops": {"pitch": {"kp": 30, "ti": 1.0}, "yaw": {"kp": 0.0, "ti": 1.0}}})
    assert largest_gain(spec, "pitch") is None


def test_the_largest_step_begins_at_the_limit() -> None:
    spec = spec_of({"loops": {"yaw": {"kp": 30, "ti": 0.1}}})
    step = largest_step(spec, -3.8, "yaw")
    assert step is not None
    assert -3.8 + 30 * step == pytest.approx(spec.limits.V_y)


def test_without_a_gain_no_step_is_the_largest() -> None:
    assert largest_step(spec_of({"loops": {"pitch": {"kp": 0, "ti": 1}}}), 12.5, "pitch") is None
