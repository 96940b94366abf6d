"""POST export: the files, their names and their refusals; equality with the other calls."""

from __future__ import annotations

import json

import numpy as np
import pytest

from app.contract.evaluation import Evaluation
from app.contract.experiment import StepRequest
from app.contract.exports import FORMATS
from heli2dof_core import evaluate

BODY = {"poles": [-9, -8, {"re": -3, "im": 4}, {"re": -3, "im": -4}], "scenario": {"reference": {"psi": 0.4}}}
LINK = "http://127.0.0.1:8000/?projector#poles=-9,-8&x='*/"


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_is_a_file(client, name: str):
    reply = client.post(f"/api/v1/export/{name}", params={"link": LINK}, json=BODY)
    assert reply.status_code == 200, reply.text
    assert reply.headers["content-type"] == FORMATS[name].media_type
    assert reply.headers["content-disposition"] == f'attachment; filename="{FORMATS[name].filename}"'
    assert len(reply.content) > 1000


def test_json_is_the_evaluate_reply_and_makes_itself_again(client):
    file = client.post("/api/v1/export/json", params={"link": LINK}, json=BODY).json()
    origin = file.pop("origin")
    assert origin["link"] == LINK and origin["preset"]["name"] == "quanser-2dof-manual"
    assert origin["call"] == "POST /api/v1/export/json"
    again = client.post("/api/v1/export/json", json=origin["request"]).json()
    assert {**file, "origin": None} == {**again, "origin": None}
    for model in ("linear", "nonlinear"):
        assert set(file["step"][model].pop("states")) == {"theta_dot", "psi_dot", "z_p", "z_y"}
    assert file == client.post("/api/v1/evaluate", json={**BODY, "each_axis": True}).json()
    Evaluation.model_validate(file)


MACHINE = {
    "rotors": {"pitch": {"tau": 0.1, "curve": "quadratic", "dead_zone": 0.5}, "yaw": {"tau": 0.1}},
    "friction": {"yaw": {"coulomb": 0.001}},
    "scenario": {"reference": {"psi": 0.1}, "duration": 0.5, "samples": 51},
}
SIX = {**MACHINE, "place_rotors": True, "rotor_poles": [-15, -16]}


def measured(body: dict, kind: str) -> dict:
    return {**body, "scenario": {**body["scenario"], "measured": kind}}


MACHINES = {
    "rotors": MACHINE,
    "static": {**MACHINE, "outer": "none", "poles": [-4, -5, -6, -7]},
    "observer": measured(MACHINE, "observer"),
    "filtered": measured(SIX, "filtered"),
    "six": measured(SIX, "observer"),
    "six-static": {**measured(SIX, "observer"), "outer": "none"},
}


@pytest.mark.parametrize("kind", MACHINES)
@pytest.mark.parametrize("name", FORMATS)
def test_every_format_is_a_file_of_the_machine(client, name: str, kind: str):
    reply = client.post(f"/api/v1/export/{name}", json=MACHINES[kind])
    assert reply.status_code == 200, reply.text
    content = reply.content.decode("latin-1")
    if name != "mat":
        assert '"dead_zone"' in content or "&#34;dead_zone&#34;" in content
        assert name == "json" or "riction" in content


@pytest.mark.parametrize("kind", MACHINES)
def test_json_names_every_state_that_it_has(client, kind: str):
    """Each state under its own name, whatever stands beside it: no rotor's speed as an integral."""
    body = MACHINES[kind]
    file = client.post("/api/v1/export/json", json=body).json()
    spec = StepRequest.model_validate(body).to_spec()
    report = evaluate(spec)
    for model in ("linear", "nonlinear"):
        response = report.step[model].response
        rows = {signal.name: values for signal, values in response.by_signal()}
        states = file["step"][model]["states"]
        hidden = {"theta_dot", "psi_dot"} | ({"z_p", "z_y"} if body.get("outer") != "none" else set())
        estimates = [name for name in rows if name.startswith("w_")]
        assert set(states) == hidden | ({"w"} if estimates else set())
        for name in hidden:
            np.testing.assert_array_equal(states[name], rows[name])
        for name, values in zip(estimates, states.get("w", []), strict=True):
            np.testing.assert_array_equal(values, rows[name])
        for name in ("v_p", "v_y"):
            np.testing.assert_array_equal(file["step"][model]["rotors"][name], rows[name])
    observed = body["scenario"].get("measured") == "observer"
    assert ("observer" in file) == observed and len(file["gains"]["K"][0]) == (
        6 if "place_rotors" in body else 4
    )
    file.pop("origin")
    Evaluation.model_validate(file)


def test_what_is_wrong_is_a_problem_that_names_its_field(client):
    for path, params, body, field in (
        ("export/pascal", {}, {}, "format"),
        ("export/csv", {"link": "javascript:alert(1)"}, {}, "link"),
        ("export/csv", {"link": 'http://x/"\n'}, {}, "link"),
        ("export/csv", {"link": "http://x/" + "a" * 4000}, {}, "link"),
        ("export/c-source", {}, {"poles": [1, 2]}, "poles"),
        ("export/report", {}, {"scenario": {"samples": 1}}, "scenario.samples"),
    ):
        reply = client.post(f"/api/v1/{path}", params=params, json=body)
        assert (reply.status_code, reply.json()["field"]) == (422, field), path
        assert reply.headers["content-type"] == "application/problem+json"


def test_the_schema_tells_the_formats(client):
    schema = client.get("/openapi.json").json()["paths"]["/api/v1/export/{format}"]["post"]
    names = next(p for p in schema["parameters"] if p["name"] == "format")["schema"]["enum"]
    assert names == [*FORMATS]
    assert "application/json" in schema["responses"]["200"]["content"]


def test_json_is_finite(client):
    reply = client.post("/api/v1/export/json", json={"poles": [0, -1, 5, -3], "outer": "none"})
    json.loads(reply.text, parse_constant=pytest.fail)


def test_requirements_stand_in_the_report_and_remarks_stay_away(client):
    asked = {"settling": 0.8, "overshoot": None, "lag": 0.1}
    report = client.post("/api/v1/export/report", json={**BODY, "required": asked, "remarks": False})
    assert "Requirements" in report.text and "≤ 0.80 s" in report.text and "≥ 0.10 s" in report.text
    assert "<h2>Findings</h2>" not in report.text
    for wrong in ({"settling": 0}, {"overshoot": 101}, {"lag": True}, {"rise": 1}):
        reply = client.post("/api/v1/export/report", json={**BODY, "required": wrong})
        assert reply.status_code == 422 and reply.json()["field"] == f"required.{next(iter(wrong))}"


def test_pins_stand_in_the_report_with_their_figures(client):
    slow = {"poles": [-8, -9, -10, -11], "name": "A <slow>"}
    unstable = {"poles": [{"re": -3, "im": 4}, {"re": -3, "im": -4}, -5, -6], "name": "B"}
    report = client.post("/api/v1/export/report", json={**BODY, "pins": [slow, unstable]})
    assert report.status_code == 200
    assert "Pinned designs" in report.text and "A &lt;slow&gt;" in report.text
    own = client.post("/api/v1/evaluate", json={"poles": slow["poles"], "each_axis": True}).json()
    steps = own["axis_steps"]
    settling = " · ".join(
        f"{steps[axis]['nonlinear']['metrics'][axis]['settling_time']:.2f} s" for axis in ("theta", "psi")
    )
    assert settling in report.text
    plain = client.post("/api/v1/export/report", json=BODY).text
    assert "Pinned designs" not in plain
    for name in ("csv", "matlab"):
        beside = client.post(f"/api/v1/export/{name}", json={**BODY, "pins": [slow]}).text
        assert beside == client.post(f"/api/v1/export/{name}", json=BODY).text


def test_a_pin_that_is_no_design_is_refused_by_its_place(client):
    reply = client.post(
        "/api/v1/export/report", json={"pins": [{"name": "A"}, {"name": "B", "poles": [1, 2]}]}
    )
    assert reply.status_code == 422 and reply.json()["field"] == "pins.1.poles"
    shifted = {"name": "A", "coupling": "axis-decoupled", "shift": 0.1}
    reply = client.post("/api/v1/export/report", json={"pins": [shifted]})
    assert reply.status_code == 422 and reply.json()["field"] == "pins.0.shift"  # as it stands in the request
    seven = [{"name": "A"}] * 7
    assert client.post("/api/v1/export/report", json={"pins": seven}).status_code == 422
