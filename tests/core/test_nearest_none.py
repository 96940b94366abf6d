"""Where no design near meets all: what is told of the closest, and of limits that exclude one another."""

from __future__ import annotations

import pytest

from heli2dof_core import Spec, nearest
from heli2dof_core.nearest import distance

FIRST = Spec.from_preset()


def test_the_closest_is_within_reach_and_all_that_it_misses_is_told():
    """Steps and samples go beyond what is near; of what they meet there nothing counts."""
    required = {"settling_time": {"max": 0.2}, "overshoot": {"max": 0.1}, "V_peak": {"max": 12}}
    for within in (0.01, 0.05, 0.3):
        found = nearest(FIRST, required, within=within)
        assert not found.moves and found.closest is not None
        assert distance(FIRST, found.closest.spec) == found.closest.distance <= within
        missed = [own for own, met in zip(found.requirements, found.closest.meets, strict=True) if not met]
        assert len(missed) > 1
        assert all(f"{own.words} " in found.missed and own.limit_text in found.missed for own in missed)
        assert found.missed in found.summary()
    # 0.80 s is met a tenth and more away, and no nearer
    near = nearest(FIRST, {"settling_time": {"max": 0.8}}, ["pitch-pair"], within=0.02)
    assert near.out_of_reach == (0,) and nearest(FIRST, {"settling_time": {"max": 0.8}}).moves


def test_limits_that_exclude_one_another_are_named_without_a_search():
    required = {"overshoot": [{"max": 1}, {"min": 2}], "settling_time": {"max": 1}}
    found = nearest(FIRST, required)
    assert found.excluding == ((0, 1),) and found.tried == 0
    assert not found.met and not found.moves and found.closest is None and found.missed == ""
    assert found.summary().startswith(
        "Overshoot, either step ≤ 1.0 % and Overshoot, either step ≥ 2.0 % exclude one another"
    )
    assert len(found.tables()[0].rows) == 3


def test_a_limit_that_is_said_twice_is_one():
    """The page asks for its own limits and for those of a lab."""
    once, twice = (nearest(FIRST, {"settling_time": [{"max": 0.8}] * n}, ["yaw-pi"]) for n in (1, 2))
    assert all(own.moves and not own.excluding for own in (once, twice))
    assert twice.moves[0].distance == pytest.approx(once.moves[0].distance, rel=0.02)
