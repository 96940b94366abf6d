"""Recordings over REST and the socket: from the sample to the identified rig."""

from __future__ import annotations

import numpy as np
import pytest

from app.recording_models import IdentificationReply, OverlayReply, Preview
from app.recording_store import RecordingStore
from heli2dof_core.errors import RecordingError
from heli2dof_core.recordings import Table
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
    assert reply["guess"] == {"columns": COLUMNS, "unit": "rad"}
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
        true, width = float(truth[estimate["name"]]), estimate["high"] - estimate["low"]
        assert abs(estimate["value"] - true) < 2 * width, estimate
        assert width < 0.3 * abs(true)
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


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"recording": "gone"}, "recording"),
        ({"free": ["m"]}, "free"),
        ({"free": []}, "free"),
        ({"segment": 0}, "segment"),
    ],
)
def test_refused_identifications(client, sent, body, field):
    with client.websocket_connect("/api/v1/recordings/identify") as socket:
        socket.send_json({"recording": sent, "columns": COLUMNS, **body})
        assert socket.receive_json()["field"] == field
        socket.send_text("{")
        assert socket.receive_json()["code"] == "invalid_json"


def test_the_store_forgets_the_longest_unused():
    store = RecordingStore(most=100, most_bytes=2500)
    keys = [store.put(Table(("x",), np.zeros((100, 1)))) for _ in range(3)]
    assert store.get(keys[0]).names == ("x",)
    store.put(Table(("x",), np.zeros((100, 1))))
    store.get(keys[0])
    with pytest.raises(RecordingError):
        store.get(keys[1])
