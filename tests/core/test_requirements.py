"""Requirements: what meets them is what is shown, of one value and of many at once; their JSON."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest

from heli2dof_core.errors import InvalidInputError
from heli2dof_core.figures.written import DASH
from heli2dof_core.many import SHARES, Measure
from heli2dof_core.measured import MEASURED, Where
from heli2dof_core.requirements import (
    Requirement,
    measure_of,
    requirements_of,
    told_measure,
    told_requirements,
)

AXES = [name for name, own in MEASURED.items() if own.has_axis]


def _measure(name: str) -> Measure:
    return Measure(name, Where("both" if name in AXES else None))


@pytest.mark.parametrize("name", [*MEASURED, *SHARES])
@pytest.mark.parametrize("side", ["max", "min"])
def test_many_values_are_judged_as_one_is(name, side):
    rng = np.random.default_rng(len(name))
    share = name in SHARES
    for limit in 10.0 ** rng.uniform(-3, 0 if share else 2, 40):
        own = Requirement(_measure(name), **{side: float(limit)})
        near = limit * (1 + rng.choice([1e-12, 1e-6, 1e-3, 1e-2, 0.1, 1.0]) * rng.uniform(-1, 1, 60))
        values = np.concatenate([near, -near, [limit, 0.0]])
        if share:
            values = np.clip(values, 0.0, 1.0)
        if MEASURED.get(name) is not None and MEASURED[name].figure.notation == "decibel":
            values = values[values > 0]
        expected = [own.meets(value) for value in values.tolist()]
        assert own.met(values).tolist() == expected
        assert [excess == 0 for excess in own.excess(values).tolist()] == expected


@pytest.mark.parametrize("name", MEASURED)
def test_what_does_not_exist_misses_and_what_has_no_limit_meets_a_least_value(name):
    values = np.array([nan, inf, -inf])
    least, most = (Requirement(_measure(name), **{side: 1.0}) for side in ("min", "max"))
    free = MEASURED[name].unlimited
    assert least.met(values).tolist() == [False, free, free]
    assert most.met(values).tolist() == [False, False, False]
    assert [least.meets(value) for value in values.tolist()] == [False, free, free]
    assert least.meets(None) is free


def test_the_excess_is_a_share_of_the_limit():
    own = Requirement(_measure("settling_time"), max=0.8)
    assert own.excess(np.array([0.4, 0.8, 1.605])).tolist() == [0.0, 0.0, pytest.approx(1.0)]
    both = Requirement(Measure("lambda_11"), min=0.9, max=1.1)
    assert both.met(np.array([0.8, 1.0, 1.2])).tolist() == [False, True, False]
    none = Requirement(_measure("steady_state_error"), max=0.0)
    assert none.excess(np.array([-0.1]))[0] == pytest.approx(
        100.0, rel=0.01
    )  # of what is worth telling apart


def test_requests_are_read_and_told_again():
    given = {
        "settling_time": [
            {"max": 0.8, "axis": "theta", "model": "linear", "steps": "alone"},
            {"max": 1.2, "share": 0.95, "axis": "psi", "model": "nonlinear", "steps": "alone"},
        ],
        "V_peak": {"max": 20.0, "motor": "V_p", "model": "nonlinear", "steps": "alone"},
        "phase_margin": {"min": 0.8},
        "share_stable": {"min": 0.95},
    }
    found = requirements_of(given)
    assert told_requirements(found) == given
    assert [own.words for own in found] == [
        "Settling time, pitch step, linear model",
        "Settling time, yaw step, on 95 % of the rigs",
        "Largest |voltage|, pitch motor, either step",
        "Phase margin, both motors",
        "Uncertain rigs, stable",
    ]
    assert [own.limit_text for own in found] == ["≤ 0.80 s", "≤ 1.20 s", "≤ 20.0 V", "≥ 45.8366°", "≥ 95 %"]
    assert [own.uncertain for own in found] == [False, True, False, False, True]
    for own in found:
        assert measure_of(told_measure(own.measure)) == own.measure
    assert measure_of("overshoot") == Measure("overshoot", Where("both"))


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"speed": {"max": 1}}, "speed"),
        ({"overshoot": {}}, "overshoot.max"),
        ({"overshoot": 5}, "overshoot"),
        ({"overshoot": {"max": nan}}, "overshoot.max"),
        ({"overshoot": {"max": 1, "min": 2}}, "overshoot.min"),
        ({"overshoot": {"max": 1, "axis": "phi"}}, "overshoot.axis"),
        ({"overshoot": {"max": 1, "motor": "V_p"}}, "overshoot.motor"),
        ({"overshoot": {"max": 1, "maximum": 2}}, "overshoot.maximum"),
        ({"overshoot": [{"max": 1}, {"max": 2, "share": 1.5}]}, "overshoot.1.share"),
        ({"disk_margin": {"min": 1, "model": "linear"}}, "disk_margin.model"),
        ({"coupling_peak": {"max": 1, "steps": "together"}}, "coupling_peak.steps"),
        ({"share_stable": {"min": 1, "share": 0.5}}, "share_stable.share"),
        ({"overshoot": [{"max": 1}] * 40}, ""),
    ],
)
def test_refusals_name_the_field(given, field):
    with pytest.raises(InvalidInputError) as caught:
        requirements_of(given)
    assert caught.value.field == field


def test_limits_on_the_better_side_are_of_each_axis_and_motor():
    def told(given: dict) -> list[tuple]:
        return [
            (own.measure.where.axis, own.measure.where.motor) for own in requirements_of(given)[0].apart()
        ]

    assert told({"rise_time": {"max": 0.2}}) == [("both", None)]
    assert told({"rise_time": {"min": 0.2}}) == [("theta", None), ("psi", None)]
    assert told({"rise_time": {"min": 0.2, "max": 0.3}}) == [("theta", None), ("psi", None)]
    assert told({"phase_margin": {"min": 0.7}}) == [(None, None)]
    assert told({"phase_margin": {"max": 0.7}}) == [(None, "V_p"), (None, "V_y")]
    assert told({"V_peak": {"min": 3, "motor": "V_p"}}) == [("theta", "V_p"), ("psi", "V_p")]
    assert told({"share_stable": {"max": 0.5}}) == [(None, None)]
    (own,) = requirements_of({"rise_time": {"min": 0.2}})[0].apart(["psi"])
    assert own.measure.where.axis == "psi"


@pytest.mark.parametrize(
    ("share", "text"), [(1.0, "100 %"), (0.9996, "99.9 %"), (0.29, "29 %"), (None, DASH)]
)
def test_a_share_is_written_rounded_down(share, text):
    own = Measure("share_stable")
    assert own.written(share) == text
