"""Recordings over REST and the socket: from the sample to the identified rig."""

from __future__ import annotations

import numpy as np
import pytest

from app.contract.identification import IdentificationReply
from app.contract.recordings import OverlayReply, Preview
from app.jobs.recording_store import RecordingStore
from heli2dof_core.errors import RecordingError
from heli2dof_core.recordings.recording import Table
from tests.app.test_rest import post

SHORT = {"length": 6.0, "seed": 2, "scenario": {"digital": {"sample_time": 0.005}}}
ROLES = ("time", "theta", "psi", "V_p", "V_y", "theta_ref", "psi_ref")
COLUMNS = {role: role for role in ROLES}


def upload(client, content, name="run.csv", status=200):
    reply = client.post("/api/v1/recordings", params={"name": name}, content=content)
    assert reply.status_code == status, reply.text
    return reply.json()


@pytest.fixture(scope="module")
def sample(client):
    reply = client.post("/api/v1/recordings/sample", json=SHORT)
    assert reply.status_code == 200
    assert "attachment" in reply.headers["content-disposition"]
    return reply.content


@pytest.fixture(scope="module")
def sent(client, sample):
    return upload(client, sample)["id"]


def test_a_sample_is_previewed_with_a_guess(client, sample):
    reply = upload(client, sample)
    Preview.model_validate(reply)
    assert sorted(reply["columns"]) == sorted(ROLES)
    assert reply["rows"] == 1200
    units = {
        "unit": "rad",
        "units": {},
        "time_unit": "s",
        "voltage_unit": "V",
        "sample_time": pytest.approx(0.005),
    }
    assert reply["guess"] == {"columns": COLUMNS, **units}
    assert reply["dialect"] == {"separator": "comma", "decimal": "point"}
    assert [f["code"] for f in reply["findings"]] == ["synthetic"]  # nobody has measured it, and it says so
    assert len(reply["preview"]) == 5
    again = client.post("/api/v1/recordings/sample", json=SHORT).content
    assert again == sample


@pytest.mark.parametrize("driver", ["voltages", "segments", "references"])
def test_overlay(client, sent, driver):
    reply = post(client, f"recordings/{sent}/overlay", {"columns": COLUMNS, "driver": driver})
    OverlayReply.model_validate(reply)
    assert reply["samples"] == 1200
    assert len(reply["t"]) == len(reply["simulated"]["theta"]) == 1200
    assert reply["fit"]["theta"] <= 100
    assert (reply["segments"] > 1) == (driver == "segments")


def test_problems_name_row_and_column(client, sample):
    bad = sample.decode().splitlines()
    bad[10] = bad[10].replace(",", ",x", 1)
    problem = upload(client, "\n".join(bad).encode(), status=422)
    assert problem["code"] == "unusable_recording"
    assert "row 11, column 'theta'" in problem["detail"]
    assert upload(client, b"", status=422)["field"] == "file"
    upload(client, b"1" * (33 * 2**20), status=413)


@pytest.mark.parametrize(
    ("key", "body", "field"),
    [
        ("missing", {}, "recording"),
        ("", {"columns": {**COLUMNS, "psi": "yaw"}}, "columns.psi"),
        ("", {"columns": {**COLUMNS, "theta_ref": None}, "driver": "references"}, "columns.theta_ref"),
        ("", {"columns": {**COLUMNS, "signs": {"theta": 2}}}, "columns.signs.theta"),
        ("", {"driver": "wind"}, "driver"),
    ],
)
def test_refused_overlays(client, sent, key, body, field):
    reply = post(client, f"recordings/{key or sent}/overlay", {"columns": COLUMNS, **body}, status=422)
    assert reply["field"] == field


def test_identification_tells_progress_and_finds_the_rig(client, sample, sent):
    truth = dict(
        pair.split(" = ") for pair in sample.decode().splitlines()[1].partition("SI: ")[2].split(", ")
    )
    with client.websocket_connect("/api/v1/recordings/identify") as socket:
        socket.send_json({"recording": sent, "columns": COLUMNS})
        parts = [socket.receive_json()]
        while not parts[-1]["done"]:
            parts.append(socket.receive_json())
    assert len(parts) > 1
    IdentificationReply.model_validate(parts[-1])
    for estimate in parts[-1]["estimates"]:
        true, width = float(truth[estimate["name"]]), 2 * estimate["noise"]
        assert abs(estimate["value"] - true) < 2 * width, estimate
        assert width < 0.3 * abs(true)
        assert estimate["low"] <= true <= estimate["high"], estimate
    fitted, held = parts[-1]["parts"]
    assert not fitted["held_out"] and held["held_out"]
    assert held["first"] == pytest.approx(2 / 3 * held["end"], rel=0.01)
    assert held["after"]["fit"]["theta"] > max(75, held["before"]["fit"]["theta"])
    courses = parts[-1]["courses"]
    assert {len(courses["t"])} == {
        len(c[axis]) for c in list(courses.values())[1:] for axis in ("theta", "psi")
    }
    assert len(parts[-1]["whiteness"]["theta"]["correlations"]) == 25
    assert parts[-1]["rms"]["theta"] < parts[-1]["rms_before"]["theta"]


def test_identification_can_be_cancelled_and_goes_on(client, sent):
    with client.websocket_connect("/api/v1/recordings/identify") as socket:
        socket.send_json({"recording": sent, "columns": COLUMNS})
        assert socket.receive_json()["done"] is False
        socket.send_json({"cancel": True})
        while "cancelled" not in (reply := socket.receive_json()):
            assert not reply["done"]
        socket.send_json({"recording": sent, "columns": COLUMNS, "free": ["B_p"]})
        while not (reply := socket.receive_json())["done"]:
            pass
        assert [e["name"] for e in reply["estimates"]] == ["B_p"]
        socket.send_json({"recording": sent, "columns": COLUMNS, "free": ["B_p"], "held_out": 0})
        while not (reply := socket.receive_json())["done"]:
            pass
        assert [part["held_out"] for part in reply["parts"]] == [False]


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"recording": "gone"}, "recording"),
        ({"free": ["m"]}, "free"),
        ({"free": []}, "free"),
        ({"segment": 0}, "segment"),
        ({"held_out": 0.9}, "held_out"),
    ],
)
def test_refused_identifications(client, sent, body, field):
    with client.websocket_connect("/api/v1/recordings/identify") as socket:
        socket.send_json({"recording": sent, "columns": COLUMNS, **body})
        assert socket.receive_json()["field"] == field
        socket.send_text("{")
        assert socket.receive_json()["code"] == "invalid_json"


def rows(time, volts=1.0, count=40):
    k = np.arange(count)
    table = [
        time,
        0.1 * np.sin(0.1 * k),
        0.2 * np.cos(0.1 * k),
        volts * (12.5 + np.sin(k)),
        volts * np.cos(k),
    ]
    lines = [",".join(f"{v:.16g}" for v in row) for row in zip(*table, strict=True)]
    return "\n".join(["time,theta,psi,V_p,V_y", *lines]).encode()


K = np.arange(40)
FOUR = {role: role for role in ROLES[:5]}


@pytest.mark.parametrize("driver", ["voltages", "segments"])
@pytest.mark.parametrize(
    ("time", "volts", "columns", "field"),
    [
        (1714564800000 + 10 * K, 1, {}, "columns.time_unit"),
        (10_000 * K, 1, {}, "columns.time_unit"),
        (10_000 * K, 1, {"time_unit": "ms"}, "columns.time_unit"),
        (np.where(K > 0, 1714564800 + 0.01 * K, 0), 1, {}, "columns.time"),
        (0.01 * K, 900, {}, "columns.V_p"),
        (np.where(K > 20, 0.01 * K - 3, 0.01 * K), 1, {}, "columns.time"),
        (0.01 * K, 1, {"time_unit": "h"}, "columns.time_unit"),
        (0.01 * K, 1, {"decimate": 30}, "columns.decimate"),
    ],
)
def test_implausible_recordings_are_refused_before_anything_is_simulated(
    client, driver, time, volts, columns, field
):
    sent = upload(client, rows(time, volts))["id"]
    body = {"columns": {**FOUR, **columns}, "driver": driver}
    problem = post(client, f"recordings/{sent}/overlay", body, status=422)
    assert problem["field"] == field
    assert problem["hint"]
    if field.startswith("columns.time"):
        assert "'time'" in problem["detail"] and ("unit" in problem["detail"] or "row" in problem["detail"])


@pytest.mark.parametrize("driver", ["voltages", "segments"])
@pytest.mark.parametrize("volts", [30.0, 75.0])
def test_no_recording_makes_the_server_fail(client, driver, volts):
    """Voltages in another unit: refused, or shown as far as the model goes."""
    sent = upload(client, rows(0.5 * K, volts))["id"]
    reply = client.post(f"/api/v1/recordings/{sent}/overlay", json={"columns": FOUR, "driver": driver})
    assert reply.status_code in (200, 422)
    if reply.status_code == 422:
        assert any(words in reply.json()["detail"] for words in ("runs away", "beyond ±1000 V"))
        assert reply.json()["hint"]


@pytest.mark.parametrize(("unit", "factor"), [("ms", 1e3), ("us", 1e6), ("s", 1.0)])
def test_a_unit_of_time_is_guessed_shown_and_taken(client, unit, factor):
    preview = upload(client, rows(1.7e9 * factor + 0.01 * factor * K))
    assert preview["guess"]["time_unit"] == unit
    assert preview["guess"]["sample_time"] == pytest.approx(0.01, rel=1e-3)
    body = {"columns": {**FOUR, "time_unit": unit}}
    reply = post(client, f"recordings/{preview['id']}/overlay", body)
    assert reply["sample_time"] == pytest.approx(0.01, rel=1e-3)


def test_what_the_file_states_is_taken_where_nothing_is_said(client):
    content = rows(10.0 * K).replace(b"time,", b"time (ms),", 1)
    sent = upload(client, content)["id"]
    reply = post(client, f"recordings/{sent}/overlay", {"columns": {**FOUR, "time": "time (ms)"}})
    assert reply["duration"] == pytest.approx(0.39)


def test_the_separator_may_be_said(client):
    content = rows(0.01 * K).replace(b",", b"; ")
    assert upload(client, content)["dialect"]["separator"] == "semicolon"
    ask = {"name": "run.csv", "separator": "blank"}
    reply = client.post("/api/v1/recordings", params=ask, content=content)
    assert reply.status_code == 422
    assert (
        client.post("/api/v1/recordings", params={"separator": "slash"}, content=content).json()["field"]
        == "separator"
    )


def test_one_signal_per_file_is_joined(client):
    lines = [line.split(",") for line in rows(0.01 * K).decode().splitlines()[1:]]
    keys = []
    for j, name in enumerate(("pitch", "yaw", "Vp", "Vy"), 1):
        content = "\n".join(["time,value", *(f"{line[0]},{line[j]}" for line in lines)]).encode()
        keys.append(upload(client, content, f"{name}.csv")["id"])
    reply = post(client, "recordings/join", {"recordings": keys})
    Preview.model_validate(reply)
    assert reply["guess"]["columns"] == {
        "time": "time",
        "theta": "pitch",
        "psi": "yaw",
        "V_p": "Vp",
        "V_y": "Vy",
    }
    assert (
        post(client, f"recordings/{reply['id']}/overlay", {"columns": reply["guess"]["columns"]})["samples"]
        == 40
    )
    assert (
        post(client, "recordings/join", {"recordings": [keys[0], "gone"]}, status=422)["field"] == "recording"
    )


def test_our_own_exports_open(client):
    for name in ("csv", "mat", "json"):
        file = client.post(f"/api/v1/export/{name}", json={"scenario": {"reference": {"theta": 0.1}}})
        preview = upload(client, file.content, f"run.{name}")
        columns = preview["guess"]["columns"]
        assert set(FOUR) <= set(columns), name
        reply = post(client, f"recordings/{preview['id']}/overlay", {"columns": columns})
        assert min(reply["fit"].values()) > 98, name  # the model under its own voltages
    for name in ("python", "matlab", "c-source", "report"):
        file = client.post(f"/api/v1/export/{name}", json={})
        assert "csv" in upload(client, file.content, name, status=422)["hint"]


@pytest.mark.parametrize("measured", ["states", "filtered", "observer"])
@pytest.mark.parametrize("name", ["csv", "mat", "json"])
def test_our_own_exports_of_the_machine_open(client, name: str, measured: str):
    """Rotors' speeds, whose names differ from the voltages' by their case, are not taken for them."""
    rotors = {"pitch": {"tau": 0.1, "curve": "quadratic", "dead_zone": 0.5}, "yaw": {"tau": 0.1}}
    body = {"rotors": rotors, "place_rotors": True, "rotor_poles": [-15, -16]}
    body["scenario"] = {"reference": {"theta": 0.1}, "measured": measured}
    preview = upload(client, client.post(f"/api/v1/export/{name}", json=body).content, f"run.{name}")
    columns = preview["guess"]["columns"]
    assert "V_p" in columns["V_p"] and "V_y" in columns["V_y"] and set(FOUR) <= set(columns)
    post(client, f"recordings/{preview['id']}/overlay", {**body, "columns": columns})


def test_the_store_forgets_the_longest_unused():
    store = RecordingStore(most=100, most_bytes=2500)
    keys = [store.put(Table(("x",), np.zeros((100, 1)))) for _ in range(3)]
    assert store.get(keys[0]).names == ("x",)
    store.put(Table(("x",), np.zeros((100, 1))))
    store.get(keys[0])
    with pytest.raises(RecordingError):
        store.get(keys[1])
