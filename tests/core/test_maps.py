"""Maps against `evaluate` one by one, and what they say of places, planes and wrong questions."""

from __future__ import annotations

import os
from dataclasses import replace
from math import inf, isnan, nan

import numpy as np
import pytest

from heli2dof_core import (
    Digital,
    Heli2DofError,
    InvalidInputError,
    Observer,
    PIGains,
    Spec,
    Uncertainty,
    cloud,
    evaluate,
)
from heli2dof_core.many import MOST_STEPS, SHARES
from heli2dof_core.maps import DesignMap, design_map
from heli2dof_core.maps.planes import MOVES
from heli2dof_core.measured import MEASURED, worse
from heli2dof_core.placement.registry import METHODS
from tests.core.random_specs import random_specs

VALUES = int(os.environ.get("HELI2DOF_MAP_VALUES", "200"))
"""Places of ten random maps, each of which is evaluated by itself; 3072 to be sure."""


def figure_of(spec: Spec, found: DesignMap) -> float | None:
    """What `evaluate` and the registry say of one design; None: a response was given up."""
    try:
        report = evaluate(spec, each_axis=True, most_steps=MOST_STEPS)
    except Heli2DofError:
        return nan
    known, where = MEASURED[found.measure.name], found.measure.where
    if not report.judged.stable:
        return nan
    if report.given_up and known.may_have_model:
        return None
    values = known.read(report, where)
    value = worse(known, values) if values else None
    if value is None and known.unlimited:
        return inf if known.figure.better == "higher" else -inf
    return nan if value is None else value


def moved(found: DesignMap, x: float, y: float) -> Spec:
    """The design of a place, made by the public constructors alone."""
    spec, plane = found.spec, found.plane
    if plane.move.endswith("-pi"):
        gains = PIGains(x, y)
        return spec.changed(pitch=gains) if plane.axis == "pitch" else spec.changed(yaw=gains)
    pair = [x, y] if plane.real else [complex(x, y), complex(x, -y)]
    first, last = spec.poles.values[:2], spec.poles.values[2:]
    return spec.changed(poles=[*pair, *last] if plane.axis == "pitch" else [*first, *pair])


def random_maps(count: int, seed: int):
    rng = np.random.default_rng(seed)
    specs = random_specs(10**6, seed, rtol=1e-6)
    made, places = 0, -(-VALUES // count)
    while made < count:
        spec = next(specs)
        move = MOVES[rng.integers(4)]
        if rng.random() < 0.2:
            spec = replace(spec, method=["tits-yang", "varga", "lqr", "bass-gura"][rng.integers(4)])
        if rng.random() < 0.2:
            scenario = replace(spec.scenario, measured="observer")
            spec = replace(spec, observer=Observer(method="kalman"), scenario=scenario)
        known = MEASURED[name := [*MEASURED][rng.integers(len(MEASURED))]]
        asked = {"measure": name}
        if known.may_have_axis:
            asked["axis"] = ("theta", "psi", "both")[rng.integers(3)]
        if known.may_have_motor and rng.random() < 0.5:
            asked["motor"] = ("V_p", "V_y")[rng.integers(2)]
        if known.may_have_model:
            asked["model"] = ("linear", "nonlinear")[rng.integers(2)]
            asked["steps"] = "alone" if known.of == "step" else ("alone", "together")[rng.integers(2)]
        pair = move.endswith("-pair")
        real = bool(pair and rng.random() < 0.4)
        own = abs(spec.poles.values[0])
        over = [[-3 * own, 0.1], [-2 * own, 0.0] if real else [0, 2 * own]] if pair else None
        nx = int(rng.integers(3, max(4, places**0.5 + 2)))
        size = (nx, max(2, -(-places // nx)))
        try:
            found = design_map(spec, move, asked, over, size, real=real, threads=1 + made % 2)
        except InvalidInputError:  # LQR has no poles to move, an axis is not stepped, no loop is closed
            continue
        made += 1
        yield found


def test_values_of_random_maps_are_those_of_evaluate():
    kinds, told, hidden = set(), 0, 0
    for found in random_maps(10, 21):
        for (j, i), value in np.ndenumerate(found.values):
            spec = moved(found, float(found.x[i]), float(found.y[j]))
            expected = figure_of(spec, found)
            if expected is None:
                hidden += 1
                continue
            assert value == expected or (isnan(value) and isnan(expected)), (found, spec, value, expected)
            told += bool(np.isfinite(value))
        kinds.add((found.spec.method, found.spec.scenario.measured, found.plane.move, found.measure.name))
    assert len(kinds) == 10
    assert told > VALUES / 4
    assert hidden < VALUES / 10


def test_a_map_says_where_the_design_itself_stands(spec):
    found = design_map(spec, "yaw-pi", {"measure": "overshoot", "axis": "psi"}, size=(5, 4))
    assert found.here == (spec.outer.yaw.kp, spec.outer.yaw.ti)
    assert found.own == figure_of(spec, found)
    real = design_map(spec, "yaw-pair", "norm", size=(4, 4), real=True)
    assert real.here == (-9.25, -8.76)
    assert design_map(spec, "yaw-pair", "norm", size=(4, 4)).here is None  # two real poles
    double = spec.changed(poles=[-12, -10, -3, -3])
    assert design_map(double, "yaw-pair", "norm", size=(4, 4)).here == (-3.0, 0.0)
    conjugates = spec.changed(poles=[-12, -10, -3 - 4j, -3 + 4j])
    assert design_map(conjugates, "yaw-pair", "norm", size=(4, 4)).here == (-3.0, 4.0)
    assert design_map(conjugates, "yaw-pair", "norm", size=(4, 4), real=True).here is None


def test_best_and_worst_are_the_extremes(spec):
    settling = {"measure": "settling_time", "axis": "theta", "model": "linear"}
    found = design_map(spec, "pitch-pair", settling, size=(12, 9))
    x, y, value = found.best
    assert value == np.nanmin(found.values)
    assert found.spec_at(x, y) == moved(found, x, y)
    assert figure_of(found.spec_at(x, y), found) == value
    assert found.worst[2] == np.nanmax(found.values)
    margin = design_map(spec, "pitch-pi", "disk_margin", size=(6, 5))
    assert margin.best[2] == np.nanmax(margin.values)
    assert margin.spec_at(margin.best[0] * 1.01, margin.best[1] * 0.99) == moved(margin, *margin.best[:2])
    assert design_map(spec, "pitch-pair", "lambda_11", size=(6, 5)).best is None


def test_unstable_places_have_no_value_and_unlimited_ones_infinity(spec):
    found = design_map(spec, "yaw-pair", "norm", [[-4, 4], [0, 3]], (9, 4))
    assert not np.any(found.stable[:, found.x >= 0])
    assert np.array_equal(found.valid, found.stable)
    lag = design_map(spec.changed(outer="none"), "yaw-pair", "gain_margin", [[-3, -1], [0, 1]], (4, 3))
    assert np.all(lag.stable)
    assert np.any(lag.unlimited)
    assert not np.any(lag.valid & lag.unlimited)
    assert lag.written(inf) == "unlimited"


def test_a_method_that_cannot_place_somewhere_has_no_value_there(spec):
    found = design_map(replace(spec, method="knv0"), "yaw-pair", "norm", [[-6, -2], [0, 2]], (3, 3))
    assert np.all(np.isnan(found.values[1:]))  # complex poles, which KNV0 does not place
    real = design_map(
        replace(spec, method="knv0"), "yaw-pair", "norm", [[-6, -5], [-3, -2]], (3, 3), real=True
    )
    assert np.all(real.valid)
    for (j, i), value in np.ndenumerate(real.values):
        assert value == figure_of(moved(real, float(real.x[i]), float(real.y[j])), real)


@pytest.mark.parametrize("name", [*SHARES])
def test_shares_of_uncertain_rigs_are_those_of_the_cloud(spec, name):
    uncertainty = Uncertainty({"J_p": 0.4, "K_pp": 0.4, "K_yy": 0.5, "B_y": 0.5}, samples=40, seed=4)
    found = design_map(spec, "pitch-pair", name, [[-6, -0.5], [0, 6]], (4, 3), uncertainty=uncertainty)
    assert found.unit == ""
    for (j, i), value in np.ndenumerate(found.values):
        own = moved(found, float(found.x[i]), float(found.y[j]))
        if found.stable[j, i]:
            assert value == getattr(cloud(own, uncertainty), name)
        else:
            assert isnan(value)
            assert not evaluate(own).judged.stable
    assert len(np.unique(found.values[found.valid])) > 2


def test_planes_are_proposed_around_the_design(spec):
    pair = design_map(spec, "pitch-pair", "norm", size=(5, 4))
    assert (pair.x[0], pair.x[-1], pair.y[0]) == (-15.0, 0.0, 0.0)
    assert np.all(np.diff(pair.x) > 0)
    gains = design_map(spec, "pitch-pi", "norm", size=(5, 4))
    kp, ti = gains.here
    assert gains.x[0] < kp < gains.x[-1]
    assert gains.y[0] < ti < gains.y[-1]
    np.testing.assert_allclose(np.diff(np.log(gains.x)), np.log(gains.x[1] / gains.x[0]))
    linear = design_map(spec, "pitch-pi", "norm", [[0, 8], [0.5, 2]], (5, 4), scale="linear")
    assert linear.x.tolist() == [0.0, 2.0, 4.0, 6.0, 8.0]


def test_results_are_frozen_and_show_themselves(spec):
    found = design_map(spec, "yaw-pair", {"measure": "settling_time", "axis": "psi"}, size=(30, 20))
    with pytest.raises(ValueError, match="read-only"):
        found.values[0, 0] = 1.0
    assert repr(found).startswith("<DesignMap: Settling time, yaw step: ")
    assert found._repr_html_().startswith(found.svg())  # a notebook shows the picture above its tables
    ends, grid = found.tables()
    assert [row[0] for row in ends.rows] == ["best", "worst", "here"]
    assert len(grid.rows) == 9
    assert len(grid.columns) == 8
    assert "unstable" in {cell for row in grid.rows for cell in row}
    best = found.written(found.best[2])
    assert any(best in row for row in ends.rows)


@pytest.mark.parametrize(
    ("field", "given"),
    [
        ("move", {"move": "pitch"}),
        ("measure", {"measure": "none such"}),
        ("axis", {"measure": {"measure": "overshoot", "axis": "pitch"}}),
        ("real", {"move": "pitch-pi", "real": True}),
        ("scale", {"scale": "log"}),
        ("scale", {"move": "pitch-pi", "scale": "cubic"}),
        ("size", {"size": (64,)}),
        ("size.1", {"size": (64, 1)}),
        ("size.0", {"size": (64.5, 2)}),
        ("size", {"size": (200, 200)}),
        ("over.0", {"over": [[1], [0, 1]]}),
        ("over.0.1", {"over": [[-3, -4], [0, 1]]}),
        ("over.1.0", {"over": [[-4, -3], [-1, 1]]}),
        ("over.0.0", {"over": [[-1e6, -3], [0, 1]]}),
        ("over.0.1", {"over": [[-3, float("nan")], [0, 1]]}),
        ("over.0.0", {"move": "pitch-pi", "over": [[0, 3], [0.1, 1]]}),
        ("over.1.0", {"move": "pitch-pi", "over": [[1, 3], [0, 1]], "scale": "linear"}),
        ("over", {"over": [[1, 2]]}),
        ("uncertainty", {"measure": "share_stable"}),
        ("uncertainty.samples", {"measure": "share_stable", "uncertainty": Uncertainty(samples=2000)}),
        ("spread.tau_p", {"measure": "share_stable", "uncertainty": Uncertainty({"tau_p": 0.1})}),
    ],
)
def test_what_makes_no_map_is_refused_by_its_field(spec, field, given):
    with pytest.raises(InvalidInputError) as refused:
        design_map(spec, **{"move": "pitch-pair", **given})
    assert refused.value.field == field


@pytest.mark.parametrize(
    ("field", "move", "change"),
    [
        ("move", "pitch-pair", {"method": "lqr"}),
        ("move", "pitch-pi", {"method": "lqr-integral"}),
        ("move", "yaw-pi", {"outer": "none"}),
        ("axis", "yaw-pair", {"reference": (0.1, None)}),
    ],
)
def test_what_a_design_does_not_depend_on_makes_no_map(spec, field, move, change):
    with pytest.raises(InvalidInputError) as refused:
        design_map(spec.changed(**change), move, {"measure": "overshoot", "axis": "psi"})
    assert refused.value.field == field
    assert refused.value.hint


def test_shares_take_no_digital_controller(spec):
    digital = replace(spec, scenario=replace(spec.scenario, digital=Digital()))
    with pytest.raises(InvalidInputError) as refused:
        design_map(digital, "pitch-pair", "share_stable", uncertainty=Uncertainty())
    assert refused.value.field == "scenario.digital"


@pytest.mark.parametrize("method", ["full-rank", "tits-yang"])
def test_who_leaves_is_not_waited_for(spec, method):
    class LeftError(Exception):
        pass

    calls = []

    def check():
        calls.append(1)
        if len(calls) > 2:
            raise LeftError

    assert method in METHODS
    with pytest.raises(LeftError):
        design_map(replace(spec, method=method), "pitch-pair", check=check)
    assert len(calls) == 3


def test_slowest_poles_are_those_of_the_loops(spec):
    found = design_map(spec, "yaw-pair", "norm", [[-4, 2], [0, 3]], (5, 3))
    for (j, i), value in np.ndenumerate(found.abscissa):
        report = evaluate(moved(found, float(found.x[i]), float(found.y[j])))
        assert value == max(p.real for p in report.judged.connected)
