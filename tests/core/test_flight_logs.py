"""A flight's log: whatever JSON holds it is read or refused by a named field, and any change of it is told."""

from __future__ import annotations

import json
import struct
from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from heli2dof_core.errors import CancelledError, ChangedLogError, Heli2DofError, InvalidInputError
from heli2dof_core.flight import FlightLog, checksum, fly_log, sampled_flight, simulate_flight, thin_flight
from heli2dof_core.flight.log import DEEPEST, MOST_TICKS
from tests.flown import JSON, NAMES, as_json, changed, flown, places, sealed

fuzzed = settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])


@cache
def log():
    return flown()


@cache
def whole():
    return as_json(log())


class EnoughError(Exception):
    """The flight was flown far enough."""


def judged(body: object) -> None:
    """Reads and flies it for a while: what is refused is refused on purpose."""
    looks = iter(range(20))

    def wanted() -> None:
        if next(looks, None) is None:
            raise EnoughError

    try:
        fly_log(FlightLog.read(body), lambda _t, _rows: None, wanted=wanted)
    except EnoughError:
        pass
    except Heli2DofError as refused:
        assert str(refused) and len(str(refused)) < 1000
        assert isinstance(refused.field, str)


@given(JSON)
@fuzzed
def test_whatever_json_holds_is_refused(value):
    with pytest.raises(InvalidInputError):
        FlightLog.read(value)


@given(st.data())
@fuzzed
def test_any_value_anywhere_in_a_log_is_flown_or_refused(data):
    body = whole()
    path = data.draw(st.sampled_from(places(body)[1:]))
    judged(sealed(changed(body, path, data.draw(JSON))))


@given(st.data())
@fuzzed
def test_any_design_in_a_log_is_flown_or_refused(data):
    body = whole()
    designs = ((), *((n, 2) for n, event in enumerate(body["events"]) if event[1] == "design"))
    own = data.draw(st.sampled_from(designs))
    at = ("events", *own) if own else ("design",)
    judged(sealed(changed(body, (*at, data.draw(NAMES)), data.draw(JSON))))


@given(st.data())
@settings(parent=fuzzed, max_examples=100)
def test_a_changed_leaf_does_not_fit_the_checksum(data):
    body = whole()
    path = data.draw(
        st.sampled_from([own for own in places(body) if own and own[0] not in ("checksum", "flight")])
    )
    at = body
    for name in path:
        at = at[name]
    value = data.draw(JSON.filter(lambda own: json.dumps(own) != json.dumps(at) and own != at))
    with pytest.raises(InvalidInputError) as refused:
        FlightLog.read(changed(body, path, value))
    assert isinstance(refused.value, ChangedLogError) or refused.value.field == "flight"


def test_one_bit_of_any_number_is_told():
    body = whole()
    numbers = [path for path in places(body) if path and path[0] not in ("flight", "checksum")]
    told = 0
    for path in numbers:
        at = body
        for name in path:
            at = at[name]
        if isinstance(at, float):
            for bit in range(64):
                (bits,) = struct.unpack("<q", struct.pack("<d", at))
                (other,) = struct.unpack("<d", struct.pack("<Q", (bits ^ (1 << bit)) & (2**64 - 1)))
                if other == at:  # the sign of zero, which JSON need not tell
                    continue
                with pytest.raises(ChangedLogError, match="checksum"):
                    FlightLog.read(changed(body, path, other))
                told += 1
    assert told > 3000


def test_a_sealed_log_whose_states_or_events_were_changed_is_told_by_the_flight():
    body = whole()
    for path, value in (
        (("checks", 3, 1), body["checks"][3][1] + 2e-9),
        (("events", 0, 2), body["events"][0][2] + 1e-6),
        (("seed",), body["seed"] + 1),
        (("design", "parameters", "J_p"), 0.03 * (1 + 1e-6)),
    ):
        with pytest.raises(ChangedLogError) as refused:
            simulate_flight(FlightLog.read(sealed(changed(body, path, value))))
        assert refused.value.field.startswith("checks["), path
    assert refused.value.hint


def test_a_log_that_goes_on_when_its_flight_has_ended_is_told():
    body = sealed({**whole(), "design": {"limits": {"V_y": 1e6}}, "ticks": 40_000, "checks": []})
    body = sealed({**body, "events": [[0, "hands", 1], [0, "sticks", 0.0, 1e3]]})
    with pytest.raises(ChangedLogError, match="ends by itself") as refused:
        simulate_flight(FlightLog.read(body))
    assert refused.value.field == "ticks"


@pytest.mark.parametrize(
    ("path", "value", "field"),
    [
        (("ticks",), 0, "ticks"),
        (("ticks",), True, "ticks"),
        (("ticks",), MOST_TICKS + 1, "ticks"),
        (("ticks",), 10.5, "ticks"),
        (("seed",), -1, "seed"),
        (("seed",), None, "seed"),
        (("task",), "x" * 101, "task"),
        (("design",), None, "design"),
        (("events",), None, "events"),
        (("events", 1, 0), 10**6, "events[1][0]"),
        (("events", 1, 0), 0.5, "events[1][0]"),
        (("events", 2, 1), "no", "events[2][1]"),
        (("events", 2, 2), "1", "events[2][2]"),
        (("events", 2), [1, "push"], "events[2]"),
        (("checks", 0, 0), -1, "checks[0]"),
        (("checks", 0, 1), None, "checks[0]"),
        (("checks", 1, 0), 1, "checks[1]"),
        (("flight",), 2, "flight"),
        (("flight",), "1", "flight"),
        (("note",), 1, "note"),
        (("design", "poles"), 3, "design.poles"),
        (("design", "poles", 1), [1], "design.poles.1"),
        (("design", "poles", 2), {"re": 1}, "design.poles.2"),
        (("design", "scenario", "digital"), 1, "design.scenario.digital"),
        (("design", "scenario", "samples"), 10.0, "design.scenario.samples"),
        (("design", "decoupler"), "yes", "design.decoupler"),
        (("design", "split"), [[0, 1], [2, True]], "design.split.1.1"),
        (("design", "preset"), ["paper"], "design.preset"),
    ],
)
def test_what_is_wrong_is_named(path, value, field):
    with pytest.raises(InvalidInputError) as refused:
        FlightLog.read(sealed(changed(whole(), path, value))).first()
    assert refused.value.field == field


def test_a_log_of_a_later_format_says_so_and_a_design_in_the_air_is_named_by_its_place():
    with pytest.raises(InvalidInputError, match="format 2, and this version of heli2dof reads format 1"):
        FlightLog.read(sealed(changed(whole(), ("flight",), 2)))
    body = sealed({**whole(), "events": [[3, "design", {"poles": [-1, -2, -3, "x"]}]], "checks": []})
    with pytest.raises(InvalidInputError) as refused:
        simulate_flight(FlightLog.read(body))
    assert refused.value.field == "events[0][2].poles.3"


def test_nothing_deep_is_followed():
    deep = []
    for _ in range(5000):
        deep = [deep]
    for path in (("design", "poles"), ("task",), ("events", 0), ("deep",)):
        body = changed(whole(), path, deep)
        with pytest.raises(InvalidInputError, match=f"{DEEPEST} levels"):
            FlightLog.read(body)


def test_a_log_outlives_its_way_through_json():
    own = log()
    assert FlightLog.read(as_json(own)).body() == own.body()
    minus = {**whole(), "events": [[0, "push", -0.0, 0.0]]}
    assert checksum(minus) == checksum({**minus, "events": [[0, "push", 0, 0.0]]})


def test_a_thinned_flight_has_the_rows_of_the_whole_one():
    course, wholly = simulate_flight(log()), thin_flight(log(), last=False)
    np.testing.assert_array_equal(wholly.rows, course.rows)
    for every in (1, 3, 7, 1000):
        thin = thin_flight(log(), every)
        np.testing.assert_array_equal(thin.rows[:-1], course.rows[::every])
        np.testing.assert_array_equal(thin.t[:-1], course.t[::every])
        assert thin.digest == wholly.digest
        assert (
            thin.t[-1] == thin.flown.duration == pytest.approx(log().checks[-1][0] and course.t[-1], abs=5e-3)
        )
        np.testing.assert_array_equal(thin.rows[-1, :4], log().checks[-1][1:])
    for samples in (2, 50, 2001):
        assert len(sampled_flight(log(), samples).t) <= samples


def test_a_row_more_than_is_kept_is_refused_and_who_leaves_ends_the_flight():
    long = FlightLog({}, MOST_TICKS)
    with pytest.raises(InvalidInputError, match="rows") as refused:
        thin_flight(long)
    assert refused.value.field == "every" and "15" in refused.value.hint

    looks = []

    def leave() -> None:
        looks.append(1)
        if len(looks) > 5:
            raise CancelledError("left")

    with pytest.raises(CancelledError):
        thin_flight(long, 100, wanted=leave)
    assert len(looks) == 6
