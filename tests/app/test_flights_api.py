"""Flights over REST: made again from their log, told where that was changed, and taken away as files."""

from __future__ import annotations

import base64
import io
import json
from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.io import loadmat

from app.contract.examples import EXAMPLES
from app.contract.flights import ControllerReply, FlightReply, FlightTask
from app.contract.recordings import Preview
from app.ops.settings import Settings
from app.routes.flights import FILM_FRAMES
from app.scene.motion import frame_times
from heli2dof_core import spec_of
from heli2dof_core.flight import FlightController, FlightLog, simulate_flight, thin_flight
from heli2dof_core.flight.scores import score
from heli2dof_core.flight.task_flights import flown_by_design
from heli2dof_core.flight.tasks import TASKS
from heli2dof_core.kernels.flight_layout import OUTSIDE, SENSED, SPEED, STATE, UNLIMITED, VOLTAGE, WISH
from heli2dof_core.kernels.update_layout import NUMBERS
from tests.flown import DESIGN, JSON, as_json, changed, flown, places, sealed

URL = "/api/v1/flights"
FILES = ("", "/csv", "/mat", "/recording", "/film")


@cache
def log():
    return flown()


def flight(client, path="", status=200, **more):
    body = {"flight": as_json(log()), **more}
    reply = client.post(URL + path, json=body)
    assert reply.status_code == status, reply.text[:500]
    return reply


def test_a_flight_is_made_again_by_the_same_kernel(client):
    reply = flight(client, samples=20_001).json()
    FlightReply.model_validate(reply)
    course = simulate_flight(log())
    assert reply["every"] == 1 and len(reply["t"]) == len(course.t) + 1
    places_ = {
        **{"theta": STATE, "psi": STATE + 1, "theta_dot": STATE + 2, "psi_dot": STATE + 3},
        **{"V_p": VOLTAGE, "V_y": VOLTAGE + 1, "measured.theta": SENSED, "measured.psi_dot": SENSED + 3},
        **{"asked.V_y": UNLIMITED + 1, "speeds.v_p": SPEED, "references.psi": WISH + 1},
        **{"torques.theta": OUTSIDE, "torques.psi": OUTSIDE + 1},
    }
    for name, at in places_.items():
        own = reply
        for part in name.split("."):
            own = own[part]
        np.testing.assert_array_equal(own[:-1], course.rows[:, at])
    assert reply["hash"] == thin_flight(log()).digest and reply["apart"] <= 1e-9
    assert reply["ticks"] == log().ticks and reply["ended"] == ""
    np.testing.assert_array_equal(
        [reply[name][-1] for name in ("theta", "psi", "theta_dot", "psi_dot")], log().checks[-1][1:]
    )


def test_the_tasks_are_told(client):
    tasks = client.get(URL + "/tasks").json()
    assert [FlightTask.model_validate(task).name for task in tasks] == list(TASKS)


def test_the_course_is_thinned_and_its_hash_is_not(client):
    whole, thin = flight(client).json(), flight(client, samples=50).json()
    n = thin["every"]
    assert n > 1 and len(thin["t"]) <= 50 and thin["hash"] == whole["hash"]
    np.testing.assert_array_equal(thin["theta"][:-1], whole["theta"][:-1:n])
    assert thin["t"][-1] == whole["t"][-1] == pytest.approx(thin["duration"])


def test_a_flight_is_told_what_it_is_worth(client):
    reply = flight(client, samples=50).json()["score"]
    own = score(simulate_flight(log()))
    assert reply["values"] == own.values and len(own.values) > 4
    assert (reply["stars"], reply["flaw"]) == (0, "")
    long = sealed({"flight": 1, "design": {}, "ticks": 400_001})
    body = {**long["design"], "scenario": {"digital": {"sample_time": 1e-4}}}
    reply = client.post(URL, json={"flight": sealed({**long, "design": body})}).json()
    assert "score" not in reply and reply["ticks"] == 400_001
    FlightReply.model_validate(reply)


def test_a_task_has_stars_where_it_was_flown_as_it_is(client):
    own = as_json(flown_by_design("hold", {}, seed=3))
    reply = client.post(URL, json={"flight": own}).json()["score"]
    assert (
        reply["done"]
        and not reply["flaw"]
        and reply["stars"] == score(simulate_flight(FlightLog.read(own))).stars
    )
    assert reply["stars"] > 0
    calm = [event for event in own["events"] if event[1] != "gust"]
    for unfair in ({"events": calm}, {"seed": 4}, {"task": "no such task"}):
        reply = client.post(URL, json={"flight": sealed({**own, **unfair, "checks": []})}).json()["score"]
        assert reply["flaw"] and reply["stars"] == 0


def test_changes_tell_their_jumps(client):
    changes = flight(client).json()["changes"]
    assert [change["tick"] for change in changes] == [own.tick for own in simulate_flight(log()).takeovers]
    for change in changes:
        assert change["bumpless"] and all(abs(jump) < 1e-9 for jump in change["jump"].values())
    assert any(abs(change["jump_without"]["V_p"]) > 0.1 for change in changes)
    assert [change["time"] for change in changes] == sorted(change["time"] for change in changes)


@pytest.mark.parametrize("path", FILES)
def test_a_log_that_was_changed_is_told_by_every_call(client, path):
    body = as_json(log())
    reply = client.post(URL + path, json={"flight": changed(body, ("events", 0, 2), 0.1000001)})
    assert (reply.status_code, reply.json()["code"]) == (422, "changed_log")
    assert reply.json()["field"] == "flight.checksum"
    made_up = sealed(changed(body, ("events", 0, 2), 0.1000001))
    reply = client.post(URL + path, json={"flight": made_up})
    assert (reply.status_code, reply.json()["code"]) == (422, "changed_log")
    assert reply.json()["field"].startswith("flight.checks[") and reply.json()["hint"]


def test_a_bad_value_is_named_by_its_path_in_the_request(client):
    for path, value, field in (
        (("design", "parameters", "J_p"), -1.0, "flight.design.parameters.J_p"),
        (("events", 2, 2), 1e9, "flight.events[2][2]"),
        (("ticks",), 0, "flight.ticks"),
    ):
        reply = client.post(URL, json={"flight": sealed(changed(as_json(log()), path, value))})
        assert (reply.status_code, reply.json()["code"]) == (422, "invalid_input")
        assert reply.json()["field"] == field
    for body, field in (
        ({}, "flight"),
        ({"flight": 3}, "flight.flight"),
        ({"flight": None}, "flight.flight"),
    ):
        reply = client.post(URL, json=body)
        assert (reply.status_code, reply.json()["field"]) == (422, field)


@given(st.data())
@settings(
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
def test_no_log_makes_the_server_fail(client, data):
    body = as_json(log())
    path = data.draw(st.sampled_from([own for own in places(body)[1:] if own[0] != "ticks"]))
    kind = data.draw(st.sampled_from(FILES[:4]))
    content = json.dumps({"flight": sealed(changed(body, path, data.draw(JSON)))})
    reply = client.post(URL + kind, content=content, headers={"Content-Type": "application/json"})
    assert reply.status_code in (200, 422), reply.text
    if reply.status_code == 422:
        assert reply.json()["detail"] and len(reply.content) < 10_000


def test_a_body_of_four_mebibytes_is_taken_and_no_larger_one(client):
    events = [[0, "push", 0.001, 0.001]] * 80_000
    body = sealed(
        {"flight": 1, "design": {}, "ticks": 100, "events": events, "seed": 0, "checks": [], "task": ""}
    )
    content = json.dumps({"flight": body})
    assert Settings().body_bytes < len(content) < 4 * 2**20

    def status(path, content):
        headers = {"Content-Type": "application/json"}
        return client.post(path, content=content, headers=headers).status_code

    assert status(URL, content) == 200
    assert status(URL, content + " " * 2**22) == 413
    assert status("/api/v1/gains", "{}" + " " * (len(content) - 2)) == 413


def test_files_have_names_and_hold_the_course(client):
    course = simulate_flight(log())
    csv = flight(client, "/csv")
    assert 'filename="heli2dof-flight.csv"' in csv.headers["content-disposition"]
    rows = [line for line in csv.text.splitlines() if not line.startswith("#")]
    assert len(rows) == len(course.t) + 2
    mat = loadmat(io.BytesIO(flight(client, "/mat", every=5).content))
    np.testing.assert_array_equal(mat["theta"][:-1, 0], course.theta[::5])
    long = sealed({**as_json(log()), "ticks": 6_000_000, "checks": []})
    reply = client.post(URL + "/csv", json={"flight": long})
    assert (reply.status_code, reply.json()["field"]) == (422, "every")


def test_a_film_plays_the_flight_or_a_part_of_it(client):
    film = flight(client, "/film")
    assert film.headers["content-type"].startswith("text/html") and "flight.html" in str(film.headers)
    assert "<title>Quanser Aero" in film.text and len(film.content) > 500_000
    part = flight(client, "/film", begin=0.2, end=0.5)
    assert len(part.content) < len(film.content)
    for begin, end in ((5.0, None), (0.4, 0.3)):
        problem = flight(client, "/film", 422, begin=begin, end=end).json()
        assert problem["field"] == "begin"
    assert len(frame_times(60.0, FILM_FRAMES)) == 1801 and len(frame_times(600.0, FILM_FRAMES)) == 5401


def test_a_controller_is_told_by_its_numbers(client):
    reply = client.post(URL + "/controller", json=DESIGN).json()
    ControllerReply.model_validate(reply)
    content = base64.b64decode(reply["numbers"])
    own = FlightController.of(spec_of(DESIGN))
    np.testing.assert_array_equal(np.frombuffer(content, "<f8"), own.numbers)
    assert len(content) == 8 * NUMBERS == 976 and reply["stable"] is own.stable is True
    slow = client.post(URL + "/controller", json={"loops": {"pitch": {"kp": 1e5, "ti": 0.001}}}).json()
    assert slow["stable"] is False


def test_ones_own_flight_is_sent_as_a_recording_and_identified(client):
    steps = [[500 * k, "reference", 0.2 * (-1) ** k, 0.4 * (-1) ** (k // 2)] for k in range(12)]
    true = {"K_pp": 0.23, "K_yy": 0.066}
    body = {"flight": 1, "design": {"preset": "quanser-2dof-manual", "parameters": true}, "ticks": 6000}
    own = FlightLog.read(sealed({**body, "events": steps, "seed": 0, "checks": [], "task": ""}))
    recording = client.post(URL + "/recording", json={"flight": as_json(own)})
    assert recording.headers["content-type"].startswith("text/csv")
    preview = client.post("/api/v1/recordings", params={"name": "mine.csv"}, content=recording.content).json()
    Preview.model_validate(preview)
    assert {"theta", "V_y", "psi_ref"} <= set(preview["guess"]["columns"])
    assert preview["guess"]["sample_time"] == pytest.approx(0.002)
    request = {"preset": "quanser-2dof-manual", "recording": preview["id"], "free": ["K_pp", "K_yy"]}
    with client.websocket_connect("/api/v1/recordings/identify") as socket:
        socket.send_text(json.dumps({**request, "columns": preview["guess"]["columns"]}))
        while "estimates" not in (found := json.loads(socket.receive_text())):
            assert "status" not in found, found
    for estimate in found["estimates"]:
        assert estimate["low"] <= true[estimate["name"]] <= estimate["high"], estimate


def test_the_example_tells_its_states():
    ((_, body),) = EXAMPLES["FlightRequest"].values()
    assert simulate_flight(FlightLog.read(body["flight"])).apart <= 1e-9 and body["flight"]["checks"]
