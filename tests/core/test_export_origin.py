"""What an exported file says of its origin."""

from __future__ import annotations

from dataclasses import replace

import pytest

from heli2dof_core import PRESETS, Heli2DofError, PoleSet, Spec, spec_of
from heli2dof_core.export.origin import origin, preset_of


def test_the_preset_is_the_nearest_one_and_changes_are_told():
    paper = Spec.from_preset(PRESETS["paper-as-computed"])
    spec = replace(paper, parameters=paper.parameters.replaced({"B_p": 0.9}), poles=PoleSet([-1, -2, -3, -4]))
    assert preset_of(spec).name == "paper-as-computed"
    text = "\n".join(origin(spec, "csv", "http://127.0.0.1:8000/#x"))
    assert text.isascii()
    for said in (
        "B_p = 0.9",
        "-1, -2, -3, -4 rad/s",
        "POST /api/v1/export/csv",
        "Link: http://127.0.0.1:8000/#x",
    ):
        assert said in text


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"pole": []}, "pole"),
        ({"scenario": {"digital": {"rate": "true"}}}, "scenario.digital.rate"),
        ({"loops": {"roll": {}}}, "loops.roll"),
        ({"weights": {"states": {"phi": 1.0}}}, "weights.states.phi"),
        ({"scenario": {"digital": {"encoders": {"theta": -1}}}}, "scenario.digital.encoders.theta"),
        ({"scenario": {"reference": {"psi": 1e3}}}, "scenario.psi"),
    ],
)
def test_a_body_that_stands_for_no_design_is_refused_by_its_field(body, field):
    with pytest.raises(Heli2DofError) as caught:
        spec_of(body)
    assert caught.value.field == field
