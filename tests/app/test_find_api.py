"""The finder over REST, its WebSocket and on the command line: the core's designs, progress, cancel, refusals."""

from __future__ import annotations

import json
from itertools import pairwise

import pytest
from click.testing import CliRunner

from app.cli.group import heli2dof
from app.contract.find import FindRequest
from app.contract.find_replies import FindProgress, FindReply
from app.jobs.current import run_job
from app.routes.find import _parts as find_parts
from heli2dof_core import Spec
from heli2dof_core.finder import Find, find, finding
from heli2dof_core.requirements import measure_of, requirements_of, told_requirements
from tests.app.test_rest import post

POLES = [-12, -10, {"re": -3, "im": 4}, {"re": -3, "im": -4}]
REQUIRE = {
    "settling_time": {"max": 1.5},
    "overshoot": [{"max": 10, "axis": "theta"}, {"max": 12, "axis": "psi"}],
}
ASKED = {
    "free": ["poles", "loops"],
    "require": REQUIRE,
    "minimize": ["settling_time", {"measure": "V_peak", "motor": "V_p"}],
    "designs": 1200,
}
BODY = {"poles": POLES, "find": ASKED}
IMPOSSIBLE = {
    "free": ["poles"],
    "require": {"disk_margin": {"min": 2.5}, "overshoot": {"max": 50}},
    "designs": 900,
}


def run(*words, status=0):
    result = CliRunner().invoke(heli2dof, words, prog_name="heli2dof")
    assert result.exit_code == status, result.output
    return result


@pytest.fixture(scope="module")
def reply(client):
    return post(client, "find", BODY)


def test_the_reply_is_the_cores_answer(reply):
    FindReply.model_validate(reply)
    spec = Spec.from_preset(poles=[-12, -10, -3 + 4j, -3 - 4j])
    minimize = tuple(map(measure_of, ASKED["minimize"]))
    own = find(spec, Find(("poles", "loops"), requirements_of(REQUIRE), minimize, designs=1200))
    assert reply["met"] is own.met is True and reply["tried"] == own.tried and not reply["stopped"]
    assert [f["minimized"] for f in reply["figures"]] == [True, True, False, False]
    assert [f["title"] for f in reply["figures"][:2]] == [
        "Settling time, either step",
        "Largest |voltage|, pitch motor, either step",
    ]
    for design, candidate in zip(reply["designs"], own.candidates, strict=True):
        assert tuple(f["value"] for f in design["figures"]) == candidate.values
        assert [complex(p["re"], p["im"]) for p in design["design"]["poles"]] == [
            *candidate.spec.poles.values
        ]
        assert design["met"] and all(one["met"] for one in design["required"])
    assert [need["figure"] for need in reply["requirements"]] == [0, 2, 3]
    told = [{k: need[k] for k in ("max", "min", "share") if k in need} for need in reply["requirements"]]
    assert told == [{"max": 1.5}, {"max": 10}, {"max": 12}]
    assert told_requirements(requirements_of(REQUIRE))["overshoot"][1]["max"] == 12
    assert len(reply["present"]["figures"]) == 4 and "why" not in reply


def test_a_design_put_over_the_request_has_the_figures_told(client, reply):
    for design in reply["designs"][:: max(1, len(reply["designs"]) // 4)]:
        evaluated = post(client, "evaluate", {"poles": POLES, **design["design"], "each_axis": True})
        steps = evaluated["axis_steps"]
        settling = max(
            steps[axis]["nonlinear"]["metrics"][axis]["settling_time"] for axis in ("theta", "psi")
        )
        peak = max(steps[axis]["nonlinear"]["metrics"]["V_p"]["peak"] for axis in ("theta", "psi"))
        assert [f["value"] for f in design["figures"][:2]] == [settling, peak]


def test_contradictions_are_told(client):
    reply = post(client, "find", {"find": IMPOSSIBLE})
    FindReply.model_validate(reply)
    assert not reply["met"] and reply["why"]["alone"] == [0] and reply["designs"]
    assert reply["why"]["requirements"] == [] and "excluding" not in reply["why"]
    (give,) = reply["why"]["gives"]
    assert give["requirement"] == 0 and 0.5 < give["value"] < 2 and give["others"]
    assert give["by"] == pytest.approx(2.5 - give["value"])
    assert give["message"].startswith("Disk margin: ") and give["text"] in give["message"]


def test_limits_that_exclude_one_another_are_told_at_once(client):
    reply = post(client, "find", {"find": {"require": {"overshoot": [{"max": 1}, {"min": 2}]}}})
    FindReply.model_validate(reply)
    assert reply["designs"] == [] and reply["tried"] == 0 and not reply["met"]
    assert reply["why"]["excluding"] == [[0, 1]] and reply["why"]["gives"] == []
    assert "exclude one another" in reply["why"]["message"]


def test_socket_tells_progress_and_the_same_answer(client, reply):
    with client.websocket_connect("/api/v1/find") as socket:
        socket.send_json(BODY)
        parts = [socket.receive_json()]
        while not parts[-1]["done"]:
            parts.append(socket.receive_json())
        for part in parts[:-1]:
            FindProgress.model_validate(part)
        tried = [part["tried"] for part in parts]
        assert tried == sorted(tried) and parts[-1]["designs"] == reply["designs"]


def test_progress_holds_the_front_so_far(monkeypatch):
    monkeypatch.setattr(finding, "PAUSE", 0.0)
    texts: list[str] = []
    body = {**BODY, "find": {**ASKED, "designs": 3000}}
    run_job(find_parts, (FindRequest.model_validate(body),), lambda: False, texts.append, 60.0)
    *told, last = map(json.loads, texts)
    fronts = [part["points"] for part in told if part["points"]]
    assert len(fronts) > 3 and all(0 < len(front) <= finding.MOST_POINTS for front in fronts)
    for before, after in pairwise(fronts):
        # what was on the front stays there, or something as good in both has taken its place
        assert all(any(a <= x and b <= y for a, b in after) for x, y in before)
    found = [[figure["value"] for figure in design["figures"][:2]] for design in last["designs"]]
    assert all(any(a <= x and b <= y for a, b in found) for x, y in fronts[0])


def test_socket_can_be_called_off_and_goes_on(client):
    with client.websocket_connect("/api/v1/find") as socket:
        socket.send_json({"find": {**ASKED, "designs": 1_000_000, "seconds": 600}})
        assert socket.receive_json()["done"] is False
        socket.send_json({"cancel": True})
        replies = [socket.receive_json()]
        while "cancelled" not in replies[-1]:
            replies.append(socket.receive_json())
        assert not any(part["done"] for part in replies[:-1])
        socket.send_text('{"find": {"free": ["loop"]}}')
        assert socket.receive_json()["status"] == 422


@pytest.mark.parametrize(
    ("find", "field"),
    [
        ({"free": []}, "find.free"),
        ({"free": ["gains"]}, "find.free.0"),
        ({"free": ["poles", "weights"], "minimize": ["norm"]}, "find.free"),
        ({}, "find.require"),
        ({"require": {"speed": {"max": 1}}}, "find.require.speed"),
        ({"require": {"overshoot": {}}}, "find.require.overshoot.max"),
        ({"require": {"overshoot": 3}}, "find.require.overshoot"),
        ({"require": {"overshoot": {"max": 3, "axis": "V_p"}}}, "find.require.overshoot.axis"),
        ({"require": {"overshoot": [{"max": 3, "top": 1}]}}, "find.require.overshoot.0.top"),
        ({"require": {"overshoot": [{"max": 3}] * 33}}, "find.require.overshoot"),
        ({"minimize": [{"measure": "overshoot", "axis": "no"}]}, "find.minimize.0.axis"),
        ({"minimize": [3]}, "find.minimize.0"),
        ({"require": {"overshoot": [{"max": 1}, {"max": 1, "axis": "phi"}]}}, None),
        ({"require": {"disk_margin": {"min": 1, "axis": "theta"}}}, "find.require.disk_margin.axis"),
        ({"require": {"overshoot": {"max": 1, "share": 0.5}}}, "find.uncertainty"),
        ({"minimize": ["speed"]}, "find.minimize.0.measure"),
        ({"minimize": ["norm", {"measure": "lambda_11"}]}, "find.minimize.1"),
        ({"minimize": ["norm", "V_peak", {"measure": "V_peak"}]}, "find.minimize.2"),
        ({"require": {"overshoot": [{"max": 3}, {"max": 3, "axis": "both"}]}}, "find.require.overshoot.1"),
        ({"minimize": ["norm"], "designs": 3}, "find.designs"),
        ({"minimize": ["norm"], "seconds": 1e6}, "find.seconds"),
        ({"minimize": ["norm"], "bounds": {"poles": [5, 1]}}, "find.bounds.poles"),
        ({"minimize": ["norm"], "uncertainty": {"spread": {"mass": 0.1}}}, "find.uncertainty.spread.mass"),
        (
            {"minimize": ["share_stable"], "uncertainty": {"spread": {"tau_p": 0.1}}},
            "find.uncertainty.spread.tau_p",
        ),
    ],
)
def test_refusals_name_the_field(client, find, field):
    problem = post(client, "find", {"find": find}, status=422)
    if field is not None:
        assert problem["field"] == field


def test_the_experiment_of_uncertain_rigs_is_named(client):
    uncertain = {"minimize": ["norm"], "require": {"share_stable": {"min": 0.5}}, "uncertainty": {}}
    problem = post(client, "find", {"find": uncertain, "scenario": {"digital": {}}}, status=422)
    assert problem["field"] == "scenario.digital"


@pytest.mark.parametrize(
    ("body", "free", "changed"),
    [
        ({"preset": "quanser-aero-2"}, ["pairing", "decoupler"], {"pairing", "decoupler"}),
        ({}, ["structure", "shift"], {"coupling", "lead"}),
        ({"method": "lqr"}, ["weights"], {"weights"}),
        ({"scenario": {"measured": "observer"}, "observer": {}}, ["observer"], {"observer"}),
        (
            {"preset": "quanser-aero-2", "place_rotors": True, "rotor_poles": [-6, -7]},
            ["rotor_poles"],
            {"rotor_poles"},
        ),
    ],
)
def test_what_was_free_is_told_as_a_request_takes_it(client, body, free, changed):
    asked = {"find": {"free": free, "minimize": ["norm"], "designs": 200}}
    reply = post(client, "find", {**body, **asked})
    FindReply.model_validate(reply)
    for design in reply["designs"][:3]:
        assert changed <= set(design["design"]) <= changed | {"shift"}
        post(client, "gains", {**{k: v for k, v in body.items() if k != "scenario"}, **design["design"]})


def test_the_command_prints_designs_or_why_there_are_none():
    words = ("find", "--free", "poles,loops", "--designs", "500")
    told = run(*words, "--require", "settling_time<=1.5,overshoot:theta≤10", "--minimize", "V_peak:V_p")
    assert "designs on the front" in told.output and "3 of 3" not in told.output and "2 of 2" in told.output
    none = run(*words, "--require", "disk_margin>=2.5")
    assert "No design of" in none.output and "would have to give" in none.output
    reply = json.loads(run(*words, "--require", "overshoot<=5@0.9", "--uncertainty", "J_p=0.1", "--rigs", "5",
                           "--json").stdout)  # fmt: skip
    FindReply.model_validate(reply)
    assert reply["requirements"][0]["share"] == 0.9
    lost = run("find", status=2).output
    assert "--require or --minimize" in lost and 'heli2dof find --require "' in lost
    assert "find.require.speed" in run("find", "--require", "speed<=1", status=2).output
    assert "settling_time<=0.8" in run("find", "--require", "speed<1", status=2).output
    assert "no number" in run("find", "--require", "speed<=fast", status=2).output


def test_a_list_that_is_too_long_is_called_that(client):
    asked = {**ASKED, "require": {"overshoot": [{"max": 3}] * 33}}
    assert "at most 32 items" in post(client, "find", {"find": asked}, 422)["detail"]


def test_a_search_ends_before_its_job_is_given_up(monkeypatch):
    request = FindRequest.model_validate({"find": {**ASKED, "designs": 1_000_000}})
    asked = []

    def find_in_parts(spec, ask, *_):
        asked.append(ask.seconds)
        yield from ()

    monkeypatch.setattr("app.contract.find.find_in_parts", find_in_parts)
    for seconds in (8.0, 1e4, 0.0):
        run_job(find_parts, (request,), lambda: False, lambda _part: None, seconds)
    assert 5.5 < asked[0] < 6.0 and asked[1:] == [60.0, 0.1]  # three quarters; what is asked; the least
