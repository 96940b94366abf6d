"""Requirements that are said twice, and limits that exclude one another."""

from __future__ import annotations

from math import nan

import pytest

from heli2dof_core import InvalidInputError
from heli2dof_core.exclusion import excluding, exclusion_text, meant, require_distinct
from heli2dof_core.many import SHARES, Measure
from heli2dof_core.measured import MEASURED, Where
from heli2dof_core.requirements import measure_of, requirements_of


@pytest.mark.parametrize(
    ("required", "pairs"),
    [
        ({"overshoot": [{"max": 1}, {"min": 2}]}, ((0, 1),)),
        ({"overshoot": [{"min": 2}, {"max": 1}, {"max": 5}]}, ((0, 1),)),
        ({"overshoot": [{"max": 1, "axis": "theta"}, {"min": 2, "axis": "psi"}]}, ()),  # another response
        ({"overshoot": [{"max": 1, "axis": "theta"}, {"min": 2, "axis": "both"}]}, ((0, 1),)),
        ({"overshoot": [{"max": 1}, {"min": 2, "model": "linear"}]}, ()),
        ({"overshoot": [{"max": 1}, {"min": 2, "steps": "together"}]}, ()),
        ({"overshoot": [{"max": 1}, {"min": 1}]}, ()),
        ({"overshoot": [{"max": 1}, {"min": 1.03}]}, ((0, 1),)),  # 1.0 % is shown, or 1.1 %
        ({"overshoot": [{"max": 1}, {"min": 1.2}]}, ((0, 1),)),
        ({"overshoot": [{"max": 1, "share": 0.9}, {"min": 2}]}, ((0, 1),)),  # beside the nominal rig
        ({"steady_state_error": [{"max": 0.01}, {"min": 0.1}]}, ((0, 1),)),  # sizes
        ({"gain_margin": [{"max": 2, "motor": "V_p"}, {"min": 4}]}, ((0, 1),)),
        ({"gain_margin": [{"max": 2, "motor": "V_p"}, {"min": 4, "motor": "V_y"}]}, ()),
        (
            {"V_peak": [{"max": 8, "steps": "together"}, {"min": 9, "steps": "together", "axis": "psi"}]},
            ((0, 1),),
        ),
        ({"share_stable": [{"max": 0.5}, {"min": 0.9}]}, ((0, 1),)),
        ({"settling_time": {"max": 1}, "rise_time": {"min": 2}}, ()),  # other figures are for a search
    ],
)
def test_limits_of_one_figure_that_no_value_meets(required, pairs):
    own = requirements_of(required)
    assert excluding(own) == pairs
    for i, j in pairs:
        words = exclusion_text(own, pairs)
        assert all(f"{own[k].words} {own[k].limit_text}" in words for k in (i, j)) and "exclude" in words


def test_an_axis_that_is_not_stepped_has_no_response_to_exclude():
    own = requirements_of({"overshoot": [{"max": 1}, {"min": 2, "axis": "psi"}]})
    assert excluding(own, ["theta"]) == () and excluding(own, ["theta", "psi"]) == ((0, 1),)


def test_what_is_left_out_is_what_is_meant():
    for name in (*MEASURED, *SHARES):
        own = measure_of(name)
        assert meant(own) == meant(meant(own))
    assert meant(Measure("V_peak")) == meant(Measure("V_peak", Where("both", "both")))
    assert meant(Measure("V_peak")) != meant(Measure("V_peak", Where("theta", "both")))
    assert meant(Measure("gain_margin")) == meant(Measure("gain_margin", Where(motor="both")))


def test_a_requirement_that_is_repeated_is_refused():
    with pytest.raises(
        InvalidInputError, match=r"Overshoot, either step ≤ 1\.0 % is required twice"
    ) as caught:
        require_distinct(
            requirements_of({"overshoot": [{"max": 1}, {"max": 2}, {"max": 1.0, "axis": "both"}]})
        )
    assert caught.value.field == "require.overshoot.2" and caught.value.hint
    require_distinct(requirements_of({"overshoot": [{"max": 1}, {"max": 1, "model": "linear"}]}))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("settling_time", "not settled"),
        ("rise_time", "not reached"),
        ("overshoot", "none"),
        ("gain_margin", "none"),
        ("V_peak", "none"),
        ("share_stable", "–"),
    ],
)
def test_what_does_not_exist_is_written_in_words(name, text):
    assert measure_of(name).written(nan) == text


def test_what_has_no_limit_is_written_so():
    assert [measure_of("gain_margin").written(v) for v in (None, float("inf"))] == ["unlimited"] * 2
    assert measure_of("settling_time").written(float("inf")) == "not settled"
