"""The nearest design over REST and on the command line."""

from __future__ import annotations

import json

import pytest

from app.cli.group import main
from app.contract.nearest import NearestReply
from tests.app.test_rest import post

SETTLING = {"settling_time": {"max": 0.8}}


def asked(required: dict, **more: object) -> dict:
    return {"nearest": {"require": required, **more}}


def test_a_move_makes_a_design_that_meets_everything(client):
    """Its poles and loops, sent back, are replied figures within the limits."""
    reply = post(client, "nearest", asked({**SETTLING, "overshoot": {"max": 3}}))
    NearestReply.model_validate(reply)
    assert not reply["met"] and reply["moves"] and "closest" not in reply
    assert reply["free"] == ["pitch-pair", "yaw-pair", "pitch-pi", "yaw-pi"]
    assert [own["limit"] for own in reply["requirements"]] == ["≤ 0.80 s", "≤ 3.0 %"]
    assert [own["now"]["met"] for own in reply["requirements"]] == [False, False]
    for move in reply["moves"]:
        told = post(client, "evaluate", {**move["design"], "each_axis": True})
        steps = [told["axis_steps"][axis]["nonlinear"]["metrics"][axis] for axis in ("theta", "psi")]
        assert max(own["settling_time"] for own in steps) == move["figures"][0]["value"] <= 0.8
        assert max(own["overshoot"] for own in steps) == move["figures"][1]["value"] <= 3.0
        assert told["stable"]


def test_what_may_not_move_stays(client):
    own = {
        "poles": [-12, -10, -9.25, -8.76],
        "loops": {"pitch": {"kp": 30, "ti": 0.1}, "yaw": {"kp": 30, "ti": 0.1}},
    }
    reply = post(client, "nearest", {**own, **asked(SETTLING, free=["yaw-pi"])})
    (move,) = reply["moves"]
    assert move["handles"] == ["yaw-pi"] and move["design"]["loops"]["pitch"] == own["loops"]["pitch"]
    assert [p["re"] for p in move["design"]["poles"]] == own["poles"]


def test_where_there_is_none_the_closest_is_told(client):
    reply = post(client, "nearest", asked({"settling_time": {"max": 0.1}}, free=["loops"]))
    NearestReply.model_validate(reply)
    assert reply["moves"] == [] and reply["out_of_reach"] == [0]
    assert reply["closest"]["figures"][0]["met"] is False


def test_limits_that_exclude_one_another_are_named(client):
    reply = post(client, "nearest", asked({"overshoot": [{"max": 1}, {"min": 2}]}))
    NearestReply.model_validate(reply)
    assert reply["excluding"] == [[0, 1]] and reply["moves"] == [] and not reply["met"]
    assert "exclude one another" in reply["summary"] and "closest" not in reply


def test_the_command_without_options_says_which_one_to_give(capsys):
    for words in (["nearest"], ["nearest", "--free", "poles"], ["nearest", "--json"]):
        with pytest.raises(SystemExit) as ended:
            main(words)
        told = capsys.readouterr().err
        assert ended.value.code == 2 and "nearest.require" in told
        assert "Give --require" in told and "settling_time<=0.8" in told


def test_rotors_that_are_placed_move_with_their_axis(client):
    body = {"preset": "quanser-aero-2", "place_rotors": True, "outer": "none"}
    reply = post(client, "nearest", {**body, **asked({"lag_margin": {"min": 0.5}}, free=["poles"])})
    NearestReply.model_validate(reply)
    for move in [*reply["moves"], *([reply["closest"]] if "closest" in reply else [])]:
        assert len(move["design"]["rotor_poles"]) == 2
        assert "nearest" not in post(client, "gains", {**body, **move["design"]})


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "nearest"),
        (asked({"speed": {"max": 1}}), "nearest.require.speed"),
        (asked({"settling_time": {}}), "nearest.require.settling_time.max"),
        (
            asked({"settling_time": [{"max": 1}, {"max": 1, "motor": "V_p"}]}),
            "nearest.require.settling_time.1.motor",
        ),
        (asked({"share_stable": {"min": 0.9}}), "nearest.require.share_stable"),
        (asked(SETTLING, free=["poles", "rotors"]), "nearest.free.1"),
        (asked(SETTLING, within=0), "nearest.within"),
        ({"outer": "none", **asked(SETTLING, free=["loops"])}, "nearest.free"),
        ({"parameters": {"J_p": -1}, **asked(SETTLING)}, "parameters.J_p"),
        ({"coupling": "triangular", "parameters": {"K_pp": 0}, **asked(SETTLING)}, None),
    ],
)
def test_what_cannot_be_asked_is_refused_by_its_path(client, body, field):
    problem = post(client, "nearest", body, status=422)
    assert field is None or problem["field"] == field
    assert not problem.get("field", "").startswith("nearest") or field is not None


def test_the_command_gives_the_rest_apis_json_and_tables(client, capsys):
    words = ["--require", "settling_time:psi<=0.8,overshoot<=5", "--free", "yaw-pi,yaw-pair"]
    required = {"settling_time": {"max": 0.8, "axis": "psi"}, "overshoot": {"max": 5}}
    with pytest.raises(SystemExit) as ended:
        main(["nearest", *words, "--json"])
    assert ended.value.code == 0
    assert json.loads(capsys.readouterr().out) == post(
        client, "nearest", asked(required, free=["yaw-pi", "yaw-pair"])
    )
    with pytest.raises(SystemExit):
        main(["nearest", *words])
    shown = capsys.readouterr().out
    assert "moves that meet all" in shown and "Settling time, yaw step" in shown
