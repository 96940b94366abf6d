"""REST as other tools see it: the contract's replies, defaults and errors."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
import sympy as sp
from pydantic import TypeAdapter

from app.contract.derivation import Symbolic
from app.contract.design import Gains, Suggestion
from app.contract.evaluation import Evaluation
from app.contract.experiment import Step
from app.contract.frequency import OpenLoops, Rga
from app.contract.presets import Preset
from app.contract.problems import Problem
from heli2dof_core import PRESETS

PAPER = {"preset": "quanser-2dof-manual", "poles": [-12, -10, -9.25, -8.76]}
COMPLEX = [{"re": -3, "im": 4}, {"re": -3, "im": -4}, {"re": -5, "im": 2}, {"re": -5, "im": -2}]


def post(client, call, body=None, status=200):
    reply = client.post(f"/api/v1/{call}", json={} if body is None else body)
    assert reply.status_code == status, reply.text
    assert "NaN" not in reply.text and "Infinity" not in reply.text
    return reply.json()


def poles(reply):
    return [complex(p["re"], p["im"]) for p in reply]


def test_gains_of_the_papers_example(client):
    reply = post(client, "gains", PAPER)
    expected = [[51.170053, -3.455990, 5.458165, -0.619410], [-10.544461, 103.679711, -1.889862, 18.582295]]
    np.testing.assert_allclose(reply["K"], expected, atol=1e-6, rtol=0)
    np.testing.assert_allclose(poles(reply["closed_loop_poles"]), [-12, -10, -9.25, -8.76], atol=1e-9)
    assert reply["controllability_indices"] == [2, 2]
    assert reply["norm"] == pytest.approx(np.linalg.norm(expected), abs=1e-5)


def test_complex_poles_land(client):
    reply = post(client, "gains", {"poles": COMPLEX})
    np.testing.assert_allclose(
        poles(reply["closed_loop_poles"]), [-3 + 4j, -3 - 4j, -5 + 2j, -5 - 2j], atol=1e-9
    )


def test_an_empty_body_is_the_default_design(client):
    assert post(client, "gains") == post(client, "gains", PAPER)


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize(
    ("call", "model"),
    [
        ("gains", Gains),
        ("rga", Rga),
        ("step", Step),
        ("evaluate", Evaluation),
        ("suggest", Suggestion),
    ],
)
def test_every_reply_is_as_its_model_says(client, preset, call, model):
    model.model_validate(post(client, call, {"preset": preset}))


def test_replies_without_steady_state_or_stability_are_as_their_models_say(client):
    body = {"poles": [0, -3, -4, 5], "outer": "none"}
    rga = post(client, "rga", body)
    Rga.model_validate(rga)
    assert "rga" not in rga
    assert "no_steady_state" in {f["code"] for f in rga["findings"]}
    reply = post(client, "evaluate", {**body, "each_axis": True})
    Evaluation.model_validate(reply)
    assert reply["stable"] is False
    assert reply["margins"] == {}


def test_presets_are_complete_and_each_names_its_source(client):
    reply = client.get("/api/v1/presets").json()
    TypeAdapter(list[Preset]).validate_python(reply)
    assert reply[0]["name"] == "quanser-2dof-manual"
    assert {p["name"] for p in reply} == set(PRESETS)
    assert all(p["source"] for p in reply)
    assert "theta" in reply[0]["limits"]
    assert "theta" not in next(p for p in reply if p["name"] == "quanser-aero")["limits"]


def test_what_a_preset_says_reproduces_it(client):
    for preset in client.get("/api/v1/presets").json():
        own = {k: preset[k] for k in ("parameters", "limits", "poles", "coupling", "lead", "outer", "loops")}
        body = {"preset": preset["name"], **own, "operating_point": preset["operating_point"]}
        assert post(client, "step", body) == post(client, "step", {"preset": preset["name"]})


def test_parameters_and_operating_point_reach_the_plant(client):
    reply = post(client, "gains", {"parameters": {"B_y": 0.5, "K_s": 0.1}, "operating_point": {"theta": 0.3}})
    beta_0 = 0.0432 + 1.3872 * 0.186**2 * math.cos(0.3) ** 2
    alpha = 0.0384 + 1.3872 * 0.186**2
    assert reply["A"][3][3] == pytest.approx(-0.5 / beta_0)
    assert reply["A"][2][0] == pytest.approx((1.3872 * 9.81 * 0.186 * math.sin(0.3) - 0.1) / alpha)


def test_structures_differ_in_the_rga(client):
    triangular = post(client, "rga", {"poles": COMPLEX})["rga"][0][0]
    diagonal = post(client, "rga", {"poles": COMPLEX, "coupling": "input-diagonal"})["rga"][0][0]
    assert diagonal == pytest.approx(1 + 73 / 7127, abs=1e-9)
    assert triangular == pytest.approx(1 + 73 / 7127 * 29 / 25, abs=1e-9)


def test_loops_over_frequency(client):
    frequencies = np.logspace(-1, 2, 61).tolist()
    reply = post(client, "loops", {**PAPER, "frequencies": frequencies})
    OpenLoops.model_validate(reply)
    margins = post(client, "evaluate", PAPER)["margins"]
    assert reply["margins"] == margins
    for axis in ("pitch", "yaw"):
        gain, phase = np.array(reply[axis]["gain"]), np.array(reply[axis]["phase"])
        assert gain[0] > 10 and gain[-1] < 1 and -2 * np.pi < phase[0] <= 0
        assert np.max(np.abs(np.diff(phase))) < 1
        k = int(np.argmin(np.abs(np.log(gain))))
        assert np.pi + phase[k] == pytest.approx(margins[axis]["phase_margin"], abs=0.1)


def test_loops_need_frequencies_above_zero(client):
    for frequencies in ([], [0.0], [-1.0]):
        assert client.post("/api/v1/loops", json={"frequencies": frequencies}).status_code == 422


def test_rga_over_frequency(client):
    reply = post(client, "rga", {**PAPER, "frequencies": [0, 1, 100]})
    assert np.shape(reply["rga_magnitude"]) == (3, 2, 2)
    np.testing.assert_allclose(reply["rga_magnitude"][0], np.abs(reply["rga"]), atol=1e-9)
    assert reply["pairing"] == [["theta", "V_p"], ["psi", "V_y"]]
    assert reply["niederlinski"] == pytest.approx(1 / reply["rga"][0][0])


def test_step_honours_its_scenario(client):
    scenario = {
        "model": "nonlinear",
        "reference": {"theta": 1.0},
        "duration": 3.0,
        "samples": 301,
        "anti_windup": "none",
    }
    reply = post(client, "step", {**PAPER, "scenario": scenario})
    assert len(reply["t"]) == 301 and reply["t"][0] == 0 and reply["t"][-1] == 3
    assert reply["reference"] == {"theta": 1.0, "psi": 0.0}
    assert max(reply["V_p"]) == 24
    assert "psi" not in reply["metrics"] and "coupling_peak" in reply["metrics"]
    linear = post(client, "step", {**PAPER, "scenario": {**scenario, "model": "linear"}})
    assert linear["V_p"][0] == pytest.approx(30)
    assert linear["trim"]["V_p"] == pytest.approx(12.535, abs=1e-3)


def assert_alike(one, other):
    """To rounding: the steps one by one add in another order than the kernel of the whole."""
    assert type(one) is type(other)
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        for name, value in one.items():
            assert_alike(value, other[name])
    elif isinstance(one, list):
        assert len(one) == len(other)
        for own, others in zip(one, other, strict=True):
            assert_alike(own, others)
    else:
        assert one == pytest.approx(other, rel=1e-6, abs=1e-9) if isinstance(one, float) else one == other


def test_evaluate_is_its_parts_together(client):
    body = {**PAPER, "scenario": {"reference": {"theta": 0.1, "psi": 0.2}}}
    whole = post(client, "evaluate", {**body, "each_axis": True})
    assert_alike(whole["gains"], post(client, "gains", PAPER))
    assert_alike(whole["rga"], post(client, "rga", PAPER))
    assert_alike(whole["step"]["nonlinear"], post(client, "step", body))
    alone = post(client, "step", {**PAPER, "scenario": {"reference": {"psi": 0.2}, "model": "linear"}})
    assert_alike(whole["axis_steps"]["psi"]["linear"], alone)
    assert whole["axis_steps"]["theta"]["linear"]["reference"] == {"theta": 0.1, "psi": 0.0}


def test_suggestion_is_stable_when_used(client):
    suggestion = post(client, "suggest", {"poles": COMPLEX})
    assert post(client, "evaluate", {"poles": COMPLEX})["stable"] is False
    assert post(client, "evaluate", {"poles": COMPLEX, "loops": suggestion["loops"]})["stable"] is True


@pytest.mark.parametrize("coupling", ["triangular", "input-diagonal", "axis-decoupled"])
def test_symbolic_gives_formulas_that_parse(client, coupling):
    reply = client.get("/api/v1/symbolic", params={"coupling": coupling}).json()
    Symbolic.model_validate(reply)
    assert reply["controllability_indices"] == [2, 2]
    K = sp.Matrix(sp.sympify(reply["K"]["sympy"]))
    assert K.shape == (2, 4)
    assert K[1, 3] == sp.sympify(reply["entries"]["K"]["k_24"]["sympy"])


PROBLEMS = [
    ({"poles": [-1, -2, {"re": -3, "im": 4}, -3]}, "unpaired_poles", "poles.3"),
    ({"poles": [-1, -2, -3]}, "invalid_input", "poles"),
    ({"poles": [-1, -2, -3, 2e5]}, "invalid_input", "poles.3"),
    ({"poles": [-1, -2, -3, "4"]}, "invalid_input", "poles.3"),
    ({"poles": [-1, -2, -3, {"re": 1}]}, "invalid_input", "poles.3"),
    ({"parameters": {"J_p": 0}}, "invalid_input", "parameters.J_p"),
    ({"parameters": {"mass": 1}}, "unknown_field", "parameters.mass"),
    ({"parameters": {"m": "1"}}, "invalid_input", "parameters.m"),
    ({"preset": "nobody"}, "invalid_input", "preset"),
    ({"colour": "red"}, "unknown_field", "colour"),
    ({"coupling": "loose"}, "invalid_input", "coupling"),
    ({"loops": {"pitch": {"ti": 0}}}, "invalid_input", "loops.pitch.ti"),
    ({"limits": {"V_y": -1}}, "invalid_input", "limits.V_y"),
    ({"operating_point": {"theta": 1.6}}, "invalid_input", "operating_point.theta"),
    ({"parameters": {"K_yy": 0.00073}}, "uncontrollable", "parameters"),
    ({"parameters": {"K_pp": 0}}, "structure_unavailable", "lead"),
    ({"scenario": {"samples": 100_000}}, "invalid_input", "scenario.samples"),
    ({"scenario": {"reference": {"theta": 1e9}}}, "invalid_input", "scenario.reference.theta"),
    ([], "invalid_input", ""),
]


@pytest.mark.parametrize(("body", "code", "field"), PROBLEMS, ids=lambda x: json.dumps(x)[:40])
def test_bad_input_is_a_problem_that_names_its_field(client, body, code, field):
    reply = client.post("/api/v1/step", json=body)
    assert reply.status_code == 422
    assert reply.headers["content-type"] == "application/problem+json"
    problem = Problem.model_validate(reply.json())
    assert (problem.status, problem.code, problem.field) == (422, code, field)
    assert problem.detail


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_none_are_refused(client, number):
    for body, field in (
        (f'{{"poles":[-1,-2,-3,{number}]}}', "poles.3"),
        (f'{{"parameters":{{"m":{number}}}}}', "parameters.m"),
    ):
        reply = client.post("/api/v1/gains", content=body, headers={"content-type": "application/json"})
        assert reply.status_code == 422
        assert reply.json()["field"] == field


def test_broken_json_and_unknown_paths_are_problems_too(client):
    broken = client.post("/api/v1/gains", content="{", headers={"content-type": "application/json"})
    assert (broken.status_code, broken.json()["code"]) == (422, "invalid_json")
    for method, path, status in (
        ("GET", "/api/v1/nothing", 404),
        ("GET", "/api/v1/gains", 405),
        ("GET", "/static/none.js", 404),
    ):
        reply = client.request(method, path)
        assert reply.status_code == status
        assert reply.headers["content-type"] == "application/problem+json"


def test_docs_and_schema_need_no_other_host(client):
    page = client.get("/docs").text
    assert "http://" not in page and "https://" not in page
    schema = client.get("/openapi.json").json()
    assert {"/api/v1/gains", "/api/v1/rga", "/api/v1/step", "/api/v1/evaluate", "/healthz"} <= set(
        schema["paths"]
    )
    assert client.get("/static/vendor/swagger-ui-dist/swagger-ui-bundle.js").status_code == 200


def test_page_and_favicon_are_served(client):
    page = client.get("/")
    assert page.status_code == 200 and "<title>" in page.text
    assert client.get("/favicon.ico").headers["content-type"] == "image/svg+xml"


def test_a_digital_controller_and_a_disturbance_are_options_of_the_same_step(client):
    scenario = {"reference": {"theta": 0.1}, "duration": 1.0, "samples": 101}
    plain = post(client, "step", {**PAPER, "scenario": scenario})
    digital = post(client, "step", {**PAPER, "scenario": {**scenario, "digital": {"sample_time": 0.05}}})
    Step.model_validate(digital)
    assert digital["V_p"][1] == digital["V_p"][4] != digital["V_p"][6]
    assert "slow_sampling" in {f["code"] for f in digital["findings"]}
    pushed = post(
        client, "step", {**PAPER, "scenario": {**scenario, "disturbance": {"V_p": 5.0, "time": 0.5}}}
    )
    assert pushed["theta"][:50] == pytest.approx(plain["theta"][:50], abs=1e-9)
    assert max(pushed["theta"]) > max(plain["theta"]) + 0.01
    for body, field in (
        ({"digital": {"sample_time": 0}}, "scenario.digital.sample_time"),
        ({"digital": {"rates": "guessed"}}, "scenario.digital.rates"),
        ({"digital": {"encoders": {"theta": -1}}}, "scenario.digital.encoders.theta"),
        ({"disturbance": {"V_y": 1e9}}, "scenario.disturbance.V_y"),
        ({"tracking_time": 0}, "scenario.tracking_time"),
        ({"tracking_time": "quick"}, "scenario.tracking_time"),
    ):
        assert post(client, "step", {"scenario": body}, status=422)["field"] == field


@pytest.mark.parametrize("digital", [None, {"sample_time": 0.005}])
def test_the_tracking_time_reaches_the_simulation(client, digital):
    scenario = {"reference": {"theta": 0.6}, "anti_windup": "back-calculation", "digital": digital}
    own, same, quick = (
        post(client, "step", {**PAPER, "scenario": {**scenario, **more}})
        for more in ({}, {"tracking_time": 0.1}, {"tracking_time": 0.02})
    )
    assert own["theta"] == same["theta"]  # the loops' integral time
    assert max(quick["theta"]) < max(own["theta"]) - 1e-3


@pytest.mark.parametrize("scenario", [{"model": "linear"}, {}, {"digital": {}}], ids=str)
def test_states_are_replied_where_they_are_asked_for(client, scenario):
    body = {**PAPER, "scenario": {"samples": 3001, **scenario}}
    plain, full = post(client, "step", body), post(client, "step", {**body, "states": True})
    Step.model_validate(full)
    states = full.pop("states")
    assert full == plain
    rate = np.gradient(full["theta"], full["t"][1])
    np.testing.assert_allclose(states["theta_dot"][5:-5], rate[5:-5], atol=5e-3)
    error = full["reference"]["psi"] - np.array(full["psi"])
    assert states["z_y"][-1] == pytest.approx(np.trapezoid(error, full["t"]), abs=2e-3)
    bare = post(client, "step", {**body, "states": True, "outer": "none"})
    assert set(bare["states"]) == {"theta_dot", "psi_dot"}


def test_what_is_called_at_every_drag_knows_no_states(client):
    assert post(client, "evaluate", {"states": True}, status=422)["field"] == "states"


def test_motion_is_a_file_and_refuses_what_is_wrong(client):
    body = {"scenario": {"duration": 0.5, "reference": {"theta": 0.1}}}
    page = client.post("/api/v1/motion", json=body)
    assert page.status_code == 200
    assert page.headers["content-type"].startswith("text/html")
    assert page.headers["content-disposition"] == 'attachment; filename="heli2dof-motion.html"'
    assert "poles −12, −10, −9.25, −8.76 rad/s</title>" in page.text
    file = client.post("/api/v1/motion?format=viser", json=body)
    assert file.content[8:12] == b"\x28\xb5\x2f\xfd"  # Zstandard, behind the length
    assert client.post("/api/v1/motion?format=avi", json=body).json()["field"] == "format"
    wrong = client.post("/api/v1/motion", json={"poles": [-1, -2]})
    assert (wrong.status_code, wrong.json()["field"]) == (422, "poles")


@pytest.mark.parametrize(
    "query", ["", "?format=viser", "?format=viser&session=a_b-c", "?name=%C3%A4+%26%3D%2Fb"]
)
def test_former_address_of_the_motion_redirects(client, query):
    reply = client.post(f"/api/v1/recording{query}", json={}, follow_redirects=False)
    assert (reply.status_code, reply.headers["location"]) == (308, f"motion{query}")
    assert client.get(f"/api/v1/recording{query}").status_code == 405
    assert "/api/v1/recording" not in client.get("/openapi.json").json()["paths"]


def test_who_follows_the_former_address_gets_the_file(client):
    body = {"scenario": {"duration": 0.5, "reference": {"theta": 0.1}}}
    for kind, at, mark in (("html", 0, b"<!doctype html>"), ("viser", 8, b"\x28\xb5\x2f\xfd")):
        reply = client.post(f"/api/v1/recording?format={kind}", json=body, follow_redirects=True)
        assert [(r.status_code, r.request.method) for r in reply.history] == [(308, "POST")]
        assert (reply.status_code, reply.request.method) == (200, "POST")
        assert reply.headers["content-disposition"] == f'attachment; filename="heli2dof-motion.{kind}"'
        assert reply.content[at : at + len(mark)].lower() == mark
    wrong = client.post("/api/v1/recording", json={"poles": [-1, -2]}, follow_redirects=True)
    assert (wrong.status_code, wrong.json()["field"]) == (422, "poles")
