"""Rotors and friction from a recording over REST, socket and command line; observers that are not used."""

from __future__ import annotations

import json

import pytest

from app.contract.identification import IdentificationReply
from heli2dof_core.recordings.identification import FREE
from tests.app.test_cli import run
from tests.app.test_recordings_api import COLUMNS, FOUR, rows, upload
from tests.app.test_rest import post

TAU = {"rotors.pitch.tau": 0.16, "rotors.yaw.tau": 0.13}
RIG = {
    "preset": "quanser-aero-2",
    "rotors": {"pitch": {"tau": 0.16}, "yaw": {"tau": 0.13}},
    "friction": {"yaw": {"coulomb": 0.0005}},
    "place_rotors": True,
}
THOUGHT = {
    "preset": "quanser-aero-2",
    "rotors": {axis: {"tau": 0.0} for axis in ("pitch", "yaw")},
    "friction": RIG["friction"],
}


@pytest.fixture(scope="module")
def sample(client):
    body = {**RIG, "length": 20.0, "seed": 3, "scenario": {"digital": {"sample_time": 0.005}}}
    reply = client.post("/api/v1/recordings/sample", json=body)
    assert reply.status_code == 200, reply.text
    return reply.content


@pytest.fixture(scope="module")
def sent(client, sample):
    return upload(client, sample)["id"]


def identified(client, body):
    with client.websocket_connect("/api/v1/recordings/identify") as socket:
        socket.send_json(body)
        while (reply := socket.receive_json()).get("done") is False:
            pass
    return reply


def truth(sample):
    said = sample.decode().splitlines()[1].partition("SI: ")[2]
    return {name: float(value) for name, value in (pair.split(" = ") for pair in said.split(", "))} | TAU


def test_lag_and_thrust_are_found_and_go_back_into_a_request(client, sample, sent):
    assert "# Rotors: pitch lags by 0.16 s; yaw lags by 0.13 s" in sample.decode()
    free = ["rotors.yaw.tau", "K_pp", "B_p", "K_yy", "B_y", "K_py", "K_yp", "K_s", "rotors.pitch.tau"]
    found = identified(client, {**THOUGHT, "recording": sent, "columns": COLUMNS, "free": free})
    IdentificationReply.model_validate(found)
    assert [e["name"] for e in found["estimates"]] == [name for name in FREE if name in free]
    right = truth(sample)
    for e in found["estimates"]:
        assert e["low"] <= right[e["name"]] <= e["high"], e
        assert 2 * e["noise"] < 0.5 * abs(right[e["name"]])
    tau = {e["name"]: e for e in found["estimates"] if e["name"] in TAU}
    assert {e["unit"] for e in tau.values()} == {"s"} and {e["before"] for e in tau.values()} == {0.0}
    assert found["rotors"]["pitch"] == {
        "tau": tau["rotors.pitch.tau"]["adopted"],
        "curve": "linear",
        "dead_zone": 0.0,
    }
    assert found["friction"] == {"pitch": {"coulomb": 0.0}, "yaw": {"coulomb": 0.0005}}
    parameters = {e["name"]: e["adopted"] for e in found["estimates"] if e["name"] not in TAU}
    new = {"preset": RIG["preset"], "parameters": parameters}
    new |= {"rotors": found["rotors"], "friction": found["friction"]}
    post(client, "evaluate", {**new, "place_rotors": True})
    for driver in ("segments", "voltages"):
        body = {"columns": COLUMNS, "driver": driver}
        after = post(client, f"recordings/{sent}/overlay", {**new, **body})["rms"]
        before = post(client, f"recordings/{sent}/overlay", {**THOUGHT, **body})["rms"]
        assert max(after.values()) < 0.6 * max(before.values()), driver


def test_curves_come_back_with_the_point_where_they_are_matched(client):
    """Another K_pp moves the trim; with what is replied the thrust curve stays what it was."""
    curve = {"curve": "quadratic", "dead_zone": 0.5}
    rig = {"rotors": {"pitch": {"tau": 0.1, **curve}, "yaw": {"tau": 0.12}}, "place_rotors": True}
    made = client.post("/api/v1/recordings/sample", json={**rig, "length": 8.0, "deviation": 0.0, "seed": 2})
    sent = upload(client, made.content)["id"]
    thought = {"rotors": {"pitch": {"tau": 0.05, **curve}, "yaw": {"tau": 0.12}}}
    found = identified(
        client, {**thought, "recording": sent, "columns": COLUMNS, "free": ["rotors.pitch.tau", "K_pp"]}
    )
    K_pp, tau = found["estimates"]
    assert abs(tau["value"] - 0.1) < 1.5 * (tau["high"] - tau["low"]) < 0.02 and tau["before"] == 0.05
    pitch = found["rotors"]["pitch"]
    trim = post(client, "evaluate", {})["trim"]["V_p"]
    assert pitch == {"tau": tau["adopted"], **curve, "matched_at": pytest.approx(trim)}
    new = {"parameters": {"K_pp": K_pp["adopted"]}, "rotors": found["rotors"]}
    reply = post(client, f"recordings/{sent}/overlay", {**new, "columns": COLUMNS})
    assert max(reply["rms"].values()) < 1.3e-3


def test_references_drive_the_loop_with_its_rotors(client):
    digital = {"digital": {"sample_time": 0.005, "encoders": {"theta": 0, "psi": 0}}}
    body = {**RIG, "length": 10.0, "deviation": 0.0, "noise": 0.0, "scenario": digital}
    sent = upload(client, client.post("/api/v1/recordings/sample", json=body).content)["id"]
    about = {"columns": COLUMNS, "driver": "references", "scenario": digital}
    fits = [
        min(post(client, f"recordings/{sent}/overlay", {**body, **about})["fit"].values())
        for body in (RIG, {**RIG, "rotors": {axis: {"tau": 0.4} for axis in ("pitch", "yaw")}})
    ]
    assert fits[0] > 99.5 and fits[1] < 95


def test_a_step_of_a_rig_with_lag_opens_where_it_was_exported(client):
    body = {**RIG, "scenario": {"samples": 2001, "reference": {"theta": 0.2, "psi": 0.3}}}
    preview = upload(client, client.post("/api/v1/export/csv", json=body).content)
    for driver in ("segments", "voltages"):
        ask = {**body, "columns": preview["guess"]["columns"], "driver": driver}
        assert min(post(client, f"recordings/{preview['id']}/overlay", ask)["fit"].values()) >= 99.0, driver


@pytest.mark.parametrize(
    ("free", "words"),
    [
        (["rotors.pitch.lag"], "rotors.pitch.tau"),
        (["rotors.pitch.dead_zone"], "friction.yaw.coulomb"),
        (["friction.pitch"], "K_pp"),
        (["tau"], "rotors.yaw.tau"),
    ],
)
def test_unknown_names_are_refused_with_those_that_are_known(client, sent, free, words):
    problem = identified(client, {**RIG, "recording": sent, "columns": COLUMNS, "free": free})
    assert (problem["status"], problem["field"]) == (422, "free")
    assert words in problem["hint"] and free[0] in problem["detail"]


def test_lag_of_a_motor_that_never_moved_is_refused(client):
    """Its voltage is the same all the time; the other's lag is there to be found."""
    lines = [line.split(",") for line in rows([0.01 * k for k in range(40)]).decode().splitlines()]
    still = "\n".join(
        ",".join([*line[:3], "V_p" if i == 0 else "12.5", line[4]]) for i, line in enumerate(lines)
    )
    sent = upload(client, still.encode())["id"]
    problem = identified(client, {"recording": sent, "columns": FOUR, "free": ["rotors.pitch.tau"]})
    assert (problem["status"], problem["field"]) == (422, "free")
    assert "nothing about rotors.pitch.tau" in problem["detail"] and "Leave some out" in problem["hint"]


def test_the_command_line_finds_the_same(client, sample, sent, tmp_path):
    path, design = tmp_path / "run.csv", tmp_path / "design.json"
    path.write_bytes(sample)
    design.write_text(json.dumps(THOUGHT))
    free = ["K_pp", "K_yy", "rotors.pitch.tau"]
    ask = [
        "identify",
        str(path),
        "--design",
        str(design),
        "--rotor-tau-yaw",
        "0.13",
        "--free",
        ",".join(free),
    ]
    own = json.loads(run(*ask, "--json").stdout)
    rotors = {**THOUGHT["rotors"], "yaw": {"tau": 0.13}}
    body = {**THOUGHT, "rotors": rotors, "recording": sent, "columns": COLUMNS, "free": free}
    other = identified(client, body)
    assert own["estimates"] == other["estimates"] and own["rotors"] == other["rotors"]
    assert own["rotors"]["yaw"]["tau"] == 0.13
    refused = run("identify", str(path), "--free", "K_pp,rotors.tau", status=2).stderr
    assert "--free (free): 'rotors.tau' cannot be identified" in refused and "rotors.pitch.tau" in refused
    assert "rotors.pitch.tau" in run(*ask).stdout


UNSOLVED = {"observer": {"method": "kalman", "voltage_noise": 1e-9, "angle_noise": 1e3}}
USED = {**UNSOLVED, "scenario": {"measured": "observer"}}


@pytest.mark.parametrize("call", ["evaluate", "gains", "export/json"])
def test_an_observer_that_nothing_acts_on_refuses_nothing(client, call):
    reply = post(client, call, UNSOLVED)
    gains, findings = reply.get("gains", reply), reply["findings"]
    (said,) = [f for f in findings if f["code"] == "observer_unavailable"]
    assert "Riccati" in said["message"] and "closer" in said["message"]
    assert "observer" not in gains
    solved = post(client, call, {"observer": {"method": "kalman"}})
    assert "L" in solved.get("gains", solved)["observer"]
    assert "observer_unavailable" not in {f["code"] for f in solved["findings"]}


@pytest.mark.parametrize("measured", ["states", "filtered"])
def test_nor_does_it_on_the_live_socket(client, measured):
    with client.websocket_connect("/api/v1/live") as socket:
        socket.send_json({"seq": 1, **UNSOLVED, "scenario": {"measured": measured}})
        reply = socket.receive_json()
    assert reply["seq"] == 1 and "observer_unavailable" in {f["code"] for f in reply["findings"]}


@pytest.mark.parametrize("call", ["evaluate", "step", "robustness", "export/csv", "export/c-source"])
def test_where_it_is_used_it_does(client, call):
    problem = post(client, call, USED, status=422)
    assert "Riccati" in problem["detail"] and problem["field"] == "observer.angle_noise"
    reply = client.post(f"/api/v1/{call}", json={**UNSOLVED, "scenario": {"measured": "filtered"}})
    assert reply.status_code == 200
