"""Files of a flight: its course as numbers, and the recording from which the rig that was flown is identified."""

from __future__ import annotations

import io
import json
import tracemalloc
from functools import cache

import numpy as np
import pytest
from scipy.io import loadmat

from heli2dof_core import spec_of
from heli2dof_core.errors import RecordingError
from heli2dof_core.export.flights import COLUMNS, flight_csv, flight_mat, flight_recording
from heli2dof_core.flight import FlightLog, Rig, sampled_flight, simulate_flight, thin_flight
from heli2dof_core.kernels.flight_layout import SENSED, VOLTAGE
from heli2dof_core.recordings.files import read_table
from heli2dof_core.recordings.guess import guess_columns
from heli2dof_core.recordings.identification import identify
from heli2dof_core.recordings.recording import recording_of
from heli2dof_core.recordings.samples import deviating_rig
from tests.flown import as_json, flown

SEED = 2


@cache
def log():
    return flown()


def table_of(text):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return lines[0].split(","), np.array([line.split(",") for line in lines[1:]], dtype=float)


def test_a_csv_has_the_course_and_says_where_it_comes_from():
    flight = thin_flight(log())
    text = flight_csv(flight)
    names, rows = table_of(text)
    assert names[:3] == ["t [s]", "theta [rad]", "psi [rad]"] and len(names) == len(COLUMNS) + 1
    np.testing.assert_allclose(rows[:, 0], flight.t, rtol=1e-11)
    for i, (_, _, at) in enumerate(COLUMNS):
        np.testing.assert_allclose(rows[:, i + 1], flight.rows[:, at], rtol=1e-11)
    assert flight.digest in text and as_json(log())["checksum"] in text
    assert all(line.isascii() for line in text.splitlines() if line.startswith("#"))
    every = flight_csv(thin_flight(log(), 10))
    np.testing.assert_array_equal(table_of(every)[1][:-1], rows[:-1:10])
    assert "one in 10" in every


def test_a_mat_file_has_the_course_the_changes_and_the_log():
    flight = thin_flight(log())
    found = loadmat(io.BytesIO(flight_mat(flight)))
    for name, _, at in COLUMNS:
        np.testing.assert_array_equal(found[name][:, 0], flight.rows[:, at])
    np.testing.assert_array_equal(found["t"][:, 0], flight.t)
    changes = found["changes"][0, 0]
    assert len(changes["t"]) == len(flight.flown.takeovers) == 3
    np.testing.assert_array_equal(changes["jump"], [own.jump for own in flight.flown.takeovers])
    again = FlightLog.read(json.loads(str(found["log"][0])))
    assert simulate_flight(again).apart == 0.0
    assert flight_mat(flight) == flight_mat(thin_flight(log()))
    alone = FlightLog({}, 100)
    assert loadmat(io.BytesIO(flight_mat(thin_flight(alone))))["changes"][0, 0]["t"].shape[0] == 0


def test_a_recording_has_a_row_for_each_sample_and_what_acted_until_the_next():
    flight = thin_flight(log(), last=False)
    names, rows = table_of(flight_recording(log(), whole=True).decode())
    assert names == ["time", "theta", "psi", "theta_ref", "psi_ref", "V_p", "V_y"]
    at = np.searchsorted(flight.t, rows[:, 0] - 1e-6)
    steps = np.unique(np.round(np.diff(rows[:, 0]), 6)).tolist()
    assert steps == [0.002, 0.004], "both designs' sample times, and nothing else"
    np.testing.assert_allclose(rows[:, 1:3], flight.rows[at][:, SENSED : SENSED + 2], rtol=1e-8)
    np.testing.assert_allclose(rows[:, 5:], flight.rows[at][:, VOLTAGE : VOLTAGE + 2], rtol=1e-8)
    # Within a sample nothing that is recorded changes.
    volts = flight.rows[:, VOLTAGE : VOLTAGE + 2]
    others = np.setdiff1d(np.arange(len(volts)), at)
    np.testing.assert_array_equal(volts[others], volts[others - 1])


def test_what_no_recording_tells_is_left_out_as_gaps():
    flight = thin_flight(log(), last=False)
    text = flight_recording(log()).decode()
    whole, kept = table_of(flight_recording(log(), whole=True).decode())[1], table_of(text)[1]
    times = {event[1:]: flight.t[event[0]] for event in log().events if event[1] != "design"}
    pushed = times["push", 0.02, 0.0], times["push", 0.0, 0.0]
    stuck = times["stuck", 0.0, 1.0], times["stuck", 0.0, 0.0]
    for begin, end in (pushed, stuck):
        assert np.any((whole[:, 0] > begin) & (whole[:, 0] < end))
        assert not np.any((kept[:, 0] > begin) & (kept[:, 0] < end))
    assert "Left out" in text and "hung" in text and "another thrust" in text
    short = FlightLog({}, 600, ((0, "push", 0.01, 0.0),))
    with pytest.raises(RecordingError, match="too few"):
        flight_recording(short)
    with pytest.raises(RecordingError, match="ticks") as refused:
        flight_recording(FlightLog({}, 400_001))
    assert refused.value.field == "ticks"


def own_flight(body, base, gust):
    """Set points like a student's, with a gust and an encoder that sticks for a while."""
    rng, rig = np.random.default_rng(SEED), Rig(spec_of(body), seed=SEED)
    for k in range(14):
        rig.do("reference", base.theta_0 + rng.uniform(-0.25, 0.25), rng.uniform(-0.6, 0.6))
        rig.fly(rng.uniform(1.0, 2.0))
        if k in (5, 9):
            rig.do("gust", *gust, 400)
            rig.fly(1.0)
        if k == 8:
            rig.do("stuck", 1, 0)
            rig.fly(0.3)
            rig.do("stuck", 0, 0)
    return FlightLog.of(rig, body)


@pytest.mark.parametrize(
    ("preset", "gust"), [("quanser-2dof-manual", (0.3, -0.2)), ("quanser-aero", (0.03, -0.02))]
)
def test_the_rig_that_was_flown_is_identified_from_ones_own_flight(preset, gust):
    scenario = {"digital": {"sample_time": 0.002}, "noise": {"theta": 5e-4, "psi": 5e-4}}
    base = spec_of({"preset": preset, "scenario": scenario})
    true = deviating_rig(base.parameters, 0.12, SEED)
    changes = {n: v for n, v in true.as_dict().items() if v != getattr(base.parameters, n)}
    own = own_flight({"preset": preset, "scenario": scenario, "parameters": changes}, base, gust)

    def found(whole):
        table = read_table(flight_recording(own, whole=whole), "flight.csv")
        limits = (base.limits.V_p, base.limits.V_y)
        about = {"theta_0": base.theta_0, "limits": limits, "travel": base.limits.theta}
        recording = recording_of(table, guess_columns(table))
        return identify(base.parameters, recording, None, base.rotors, base.friction, **about).estimates

    estimates = found(whole=False)
    assert {own.name for own in estimates} == set(changes)
    for estimate in estimates:
        assert estimate.low <= changes[estimate.name] <= estimate.high, estimate.name
        assert estimate.value == pytest.approx(changes[estimate.name], rel=0.01), estimate.name
        assert estimate.high - estimate.low < 0.2 * abs(estimate.value), estimate.name
    if preset == "quanser-2dof-manual":  # with the gusts taken for the rig's own doing it would not be
        worst = max(abs(own.value / changes[own.name] - 1.0) for own in found(whole=True))
        assert worst > 3 * max(abs(own.value / changes[own.name] - 1.0) for own in estimates)


def test_a_flight_of_a_million_ticks_takes_no_more_memory_than_a_short_one():
    design = {"scenario": {"digital": {"sample_time": 1e-4}}}
    peaks = []
    for ticks in (50_000, 1_000_000):
        tracemalloc.start()
        flight = sampled_flight(FlightLog(design, ticks, ((0, "turn", 0.0, 0.1),)), 2001)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        assert flight.flown.ticks == ticks and len(flight.t) <= 2001
    assert peaks[1] < 1.2 * peaks[0] + 2**18
