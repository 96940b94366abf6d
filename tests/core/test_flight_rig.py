"""The rig in hand: what is done to it in a notebook, what it refuses, and what another rig in the air does."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import heli2dof_core as heli
from heli2dof_core.errors import ChangedLogError
from heli2dof_core.flight import FlightCourse, Rig, simulate_flight, thin_flight
from heli2dof_core.flight.log import MOST_TICKS
from heli2dof_core.flight.rows import FlightRows
from tests.children import ROOT

PRESET = "quanser-2dof-manual"


def rig_of(sample_time: float = 0.002, **limits: float) -> Rig:
    return Rig(spec_of(sample_time, **limits))


def spec_of(sample_time: float = 0.002, **limits: float) -> heli.Spec:
    spec = heli.Spec.from_preset(PRESET)
    digital = heli.Digital(sample_time, encoders=(0, 0), rates="true")
    return replace(
        spec,
        limits=replace(spec.limits, **limits),
        scenario=replace(spec.scenario, digital=digital, theta=None, psi=None),
    )


def thrown() -> Rig:
    """One whose flight ends by itself."""
    rig = rig_of(V_y=1e6)
    rig.do("hands", 1)
    rig.do("sticks", 0.0, 1000.0)
    rig.fly(30.0)
    return rig


def test_a_course_has_its_columns_by_name():
    rig = rig_of(0.005)
    rig.do("reference", 0.1, 0.2)
    rig.fly(0.3)
    rows = rig.step((9.0, -2.0))
    assert len(rows.t) == 3  # ticks in a sample of 5 ms
    np.testing.assert_array_equal(rows.voltages, [[9.0, -2.0]] * 3)
    np.testing.assert_array_equal(rows.references, [[0.1, 0.2]] * 3)
    assert rows.t[0] == pytest.approx(0.3) and rig.time == pytest.approx(0.305)
    assert rows.theta[0] != rig.theta and rig.volts == (9.0, -2.0)
    for name in ("measured", "asked", "speeds", "torques", "rates"):
        assert len(getattr(rows, name)) == 3
    assert "3 ticks" in repr(rows) and "array" not in repr(rows)
    assert "0.305 s" in repr(rig) and "9 V" in rig._repr_html_()
    assert len(repr(simulate_flight(heli.FlightLog.of(rig)))) < 200


@pytest.mark.parametrize("volts", [(9, -2), [9.0, -2.0], np.array([9, -2]), np.float32([9, -2])])
def test_voltages_are_any_two_numbers(volts):
    assert rig_of().step(volts).voltages[0].tolist() == [9.0, -2.0]


@pytest.mark.parametrize("volts", [5, (1,), (1, 2, 3), "ab", (float("nan"), 0.0), (0.0, 1e300), (None, 0)])
def test_what_are_no_two_voltages_is_refused_and_leaves_the_controller_on(volts):
    rig = rig_of()
    with pytest.raises(heli.InvalidInputError, match="sticks"):
        rig.step(volts)
    assert not rig.events and rig.tick == 0


@pytest.mark.parametrize("seconds", [-1.0, float("nan"), float("inf"), 661.0, "1"])
def test_no_time_is_not_flown(seconds):
    with pytest.raises(heli.InvalidInputError) as refused:
        rig_of().fly(seconds)
    assert refused.value.field == "seconds"


@pytest.mark.parametrize("seed", [-1, 2**32, 0.5, None, "1"])
def test_a_seed_that_no_log_holds_is_refused(seed):
    with pytest.raises(heli.InvalidInputError) as refused:
        Rig(spec_of(), seed=seed)
    assert refused.value.field == "seed"


@pytest.mark.parametrize(
    ("word", "values"),
    [("hands", [0.5]), ("stuck", [0, 0.5]), ("gust", [0.1, 0.0, 1.5]), ("gust", [0, 0, 0])],
)
def test_counts_and_switches_are_whole_numbers(word, values):
    with pytest.raises(heli.InvalidInputError, match="whole number"):
        rig_of().do(word, *values)


def test_a_flight_that_has_ended_flies_no_more_and_says_so():
    rig = thrown()
    assert "150 times" in rig.ended and "150 times" in repr(rig)
    assert len(rig.step().t) == len(rig.fly(1.0).t) == 0
    assert rig.row() is None
    course = simulate_flight(heli.FlightLog.read(heli.FlightLog.of(rig).body()))
    assert course.ended == rig.ended and len(course.t) == rig.tick


RUNAWAY = {"observer": {"poles": [900, 900, 800, 800]}, "scenario": {"measured": "observer"}}


@pytest.mark.parametrize(
    "events",
    [
        (),
        ((0, "hands", 1.0), (0, "sticks", 12.5, -3.8)),
        ((0, "hands", 1.0), (0, "sticks", 12.5, -3.8), (395, "hands", 0.0)),
    ],
)
def test_an_observer_that_runs_away_ends_the_flight_before_a_number_is_none(events):
    log = heli.FlightLog(RUNAWAY, 1)
    ticks = [385, *range(390, 400)]
    for n in ticks:
        log = heli.FlightLog(RUNAWAY, n, tuple(event for event in events if event[0] <= n))
        try:
            flight = thin_flight(log)
        except ChangedLogError as refused:
            assert "ends by itself" in str(refused)
            break
        assert np.isfinite(flight.rows).all() and len(flight.rows) in (n, n + 1)
        for change in flight.flown.takeovers:
            assert np.isfinite((*change.jump, *change.jump_without)).all()
    else:
        pytest.fail("it flies on")
    assert log.ticks > 385
    rig = Rig(heli.spec_of(RUNAWAY))
    rows = rig.fly(5.0)
    assert "cannot be followed" in rig.ended and len(rows.t) == rig.tick and rig.row() is None
    assert np.isfinite(rig.y[:4]).all()
    assert simulate_flight(heli.FlightLog.of(rig)).flown.ticks == rig.tick


def test_a_log_is_of_what_was_flown_and_holds_no_more_than_it_may():
    rig = rig_of()
    with pytest.raises(heli.InvalidInputError, match="nothing was flown"):
        heli.FlightLog.of(rig)
    rig.fly(0.5)
    rig.change(spec_of(0.004))
    rig.fly(0.5)
    log = heli.FlightLog.of(rig)
    assert heli.spec_of(log.design).scenario == rig.spec.scenario and log.checks[-1][0] == rig.tick
    assert simulate_flight(log).apart == 0.0
    rig.s[21] = MOST_TICKS + 1
    with pytest.raises(heli.InvalidInputError, match="at most"):
        heli.FlightLog.of(rig)


def test_another_rigs_stop_that_is_farther_away_lets_go():
    rig = rig_of()
    first = rig.controller.spec.limits.theta
    assert first is not None
    rig.step((24.0, 0.0))
    rig.fly(3.0)
    assert rig.theta == first
    rig.change(spec_of(theta=1.2))
    rows = rig.fly(0.1)
    assert rows.stops[0] == 0.0 and rig.theta > first
    rig.fly(2.0)
    assert rig.theta == 1.2
    rig.change(spec_of(theta=0.1))  # who is beyond a stop stands at it
    rig.fly(0.01)
    assert rig.theta == 0.1


@pytest.mark.parametrize("sample_time", [0.001, 0.0015, 0.0001])
def test_a_gust_lasts_as_long_when_ticks_become_shorter(sample_time):
    impulses, ends = [], []
    for change in (False, True):
        rig = rig_of()
        rig.do("gust", 0.0, 0.1, 250)
        parts = [rig.fly(0.15)]
        if change:
            rig.change(spec_of(sample_time))
        parts.append(rig.fly(0.6))
        own = FlightRows(np.concatenate([p.t for p in parts]), np.concatenate([p.rows for p in parts]))
        lasts = np.diff(own.t, append=rig.time)
        impulses.append(float(own.torques[:, 1] @ lasts))
        ends.append(float(own.t[own.torques[:, 1] != 0.0][-1]))
    assert impulses[1] == pytest.approx(impulses[0], rel=5e-3) == pytest.approx(0.025, rel=5e-3)
    assert abs(ends[1] - ends[0]) <= 0.0021


def test_a_gust_that_begins_with_new_ticks_is_told_in_these():
    rig = rig_of()
    rig.change(spec_of(0.001))
    rig.do("gust", 0.0, 0.1, 250)
    rows = rig.fly(0.6)
    assert np.count_nonzero(rows.torques[:, 1]) == 249


def test_what_the_docs_do_in_python_works_as_it_stands(capsys):
    text = (ROOT / "docs" / "flights-tools.md").read_text(encoding="utf-8")
    rig, environment = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    names: dict[str, object] = {}
    exec(rig, names)
    said = capsys.readouterr().out
    assert "bumpless=True" in said and "(9.0, -2.0)" in said
    course = names["course"]
    assert isinstance(course, FlightCourse) and course.apart == 0.0 and len(course.t) == 1002
    exec(environment.replace("seconds=20.0", "seconds=0.5"), names)
    assert names["done"] and names["env"].unwrapped.log().ticks == 250  # type: ignore[attr-defined]
