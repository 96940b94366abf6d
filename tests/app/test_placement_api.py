"""Placement, comparison and derivation over REST: any system, other methods, splits, the paper."""

from __future__ import annotations

import json

import numpy as np
import pytest
import sympy as sp
from pydantic import TypeAdapter

from app.contract.comparison import Comparison, Split
from app.contract.derivation import Symbolic, Walkthrough
from app.contract.evaluation import Evaluation
from app.contract.frequency import Rga
from app.contract.paper import Paper
from app.contract.placement import Method, Placement
from app.contract.problems import Problem
from app.contract.symbols import SymbolicPlacementReply
from heli2dof_core import METHODS, PRESETS, pole_error
from tests.app.test_rest import COMPLEX, PAPER, poles, post

# x₁ ← x₂ ← x₃, driven at both ends of the chain's tail
SYSTEM = {"A": [[0, 1, 0], [0, 0, 1], [1, 2, 3]], "B": [[0, 0], [1, 0], [0, 1]]}
WANTED = [-1, {"re": -2, "im": 1}, {"re": -2, "im": -1}]


def closed_loop(body, reply):
    A, B = np.array(body["A"], dtype=float), np.array(body["B"], dtype=float)
    return np.linalg.eigvals(A - B @ np.array(reply["K"]))


@pytest.mark.parametrize("method", [name for name, m in METHODS.items() if m.places_poles and name != "knv0"])
def test_any_system_is_placed_by_any_method(client, method):
    body = {**SYSTEM, "poles": WANTED, "method": method}
    reply = post(client, "place", body)
    Placement.model_validate(reply)
    assert pole_error([-1, -2 + 1j, -2 - 1j], closed_loop(body, reply)) < 1e-6
    assert ("T" in reply) == (method == "full-rank")


def test_full_rank_tells_its_construction_and_takes_it_back(client):
    reply = post(client, "place", {**SYSTEM, "poles": WANTED})
    assert reply["controllability_indices"] == [2, 1]
    assert reply["groups"] == [{"inputs": [0], "poles": [1, 2]}, {"inputs": [1], "poles": [0]}]
    again = post(client, "place", {**SYSTEM, "poles": WANTED, "groups": reply["groups"]})
    assert again == reply
    T, B = np.array(reply["T"]), np.array(SYSTEM["B"], dtype=float)
    np.testing.assert_allclose((T @ B)[[1, 2]], reply["Q"], atol=1e-12)
    for more in ({"input_order": [1, 0]}, {"triangle": "lower"}, {"triangle": "upper"}):
        other = post(client, "place", {**SYSTEM, "poles": WANTED, **more})
        assert pole_error([-1, -2 + 1j, -2 - 1j], closed_loop(SYSTEM, other)) < 1e-9


def test_quadratic_methods_take_weights_and_choose_their_own_poles(client):
    body = {**SYSTEM, "poles": WANTED, "method": "lqr", "weights": {"states": [9, 1, 1], "inputs": [1, 2]}}
    reply = post(client, "place", body)
    assert "pole_error" not in reply
    assert max(p["re"] for p in reply["closed_loop_poles"]) < 0
    integral = post(
        client, "place", {**SYSTEM, "poles": WANTED, "method": "lqr-integral", "C": [[1, 0, 0], [0, 1, 1]]}
    )
    assert np.shape(integral["integral"]) == (2, 2)


PLACE_PROBLEMS = [
    ({"A": [[0, 1], [0]]}, "invalid_input", "A"),
    ({"A": [[0, 1, 2]]}, "invalid_input", "A"),
    ({"B": [[0, 0], [1, 0]]}, "invalid_input", "B"),
    ({"B": [[1, 1], [0, 0], [0, 0]]}, "invalid_input", "B"),
    ({"A": [[0] * 21] * 21}, "invalid_input", "A"),
    ({"A": [[-1, 0, 0], [0, -1, 0], [0, 0, -1]]}, "uncontrollable", "B"),
    ({"poles": [-1, -2]}, "invalid_input", "poles"),
    ({"poles": [-1, -2, {"re": -2, "im": 1}]}, "unpaired_poles", "poles.2"),
    ({"groups": [{"inputs": [0], "poles": [0]}]}, "invalid_input", "groups"),
    ({"groups": [{"inputs": [0, 1]}]}, "missing_field", "groups.0.poles"),
    ({"input_order": [1, 1]}, "invalid_input", "input_order"),
    ({"triangle": "both"}, "invalid_input", "triangle"),
    ({"shift": [[1, 1], [0, 1]]}, "invalid_input", "shift"),
    ({"method": "magic"}, "invalid_input", "method"),
    ({"method": "knv0"}, "method_unavailable", "poles"),
    ({"method": "lqr", "triangle": "none"}, "invalid_input", "triangle"),
    ({"method": "lqr", "weights": {"states": [1]}}, "invalid_input", "weights.states"),
    ({"method": "lqr", "weights": {"inputs": [1, 0]}}, "invalid_input", "weights.inputs.1"),
    ({"method": "lqr-integral"}, "method_unavailable", "C"),
    ({"method": "lqr-integral", "C": [[1, 0]]}, "invalid_input", "C"),
    ({"C": [[1, 0, 0]], "D": 1}, "unknown_field", "D"),
]


@pytest.mark.parametrize(("change", "code", "field"), PLACE_PROBLEMS, ids=lambda x: json.dumps(x)[:40])
def test_bad_systems_are_problems_that_name_their_field(client, change, code, field):
    reply = post(client, "place", {**SYSTEM, "poles": WANTED, **change}, status=422)
    assert (reply["code"], reply["field"]) == (code, field)
    Problem.model_validate(reply)


def test_a_dyadic_method_on_the_helicopter_explains_why_it_cannot_be(client):
    gains = post(client, "gains", PAPER)
    body = {"A": gains["A"], "B": gains["B"], "poles": PAPER["poles"], "method": "ackermann"}
    problem = post(client, "place", body, status=422)
    assert problem["code"] == "method_unavailable"
    assert "2 independent eigenvectors" in problem["detail"] and "several inputs" in problem["hint"]


@pytest.mark.parametrize("preset", PRESETS)
def test_comparison_is_the_single_designs_side_by_side(client, preset):
    reply = post(client, "compare", {"preset": preset})
    Comparison.model_validate(reply)
    assert len(reply["rows"]) == 3 + len(METHODS)
    for row in reply["rows"]:
        body = {"preset": preset, "method": row["method"]}
        body |= {key: row[key] for key in ("coupling", "lead") if key in row}
        if "unavailable" in row:
            refused = post(client, "gains", body, status=422)
            assert refused["code"] == row["unavailable"]["code"]
        else:
            whole = post(client, "evaluate", {**body, "each_axis": True})
            assert row["K"] == whole["gains"]["K"]
            assert row.get("rga") == whole["rga"].get("rga")
            assert row["metrics"] == whole["step"]["nonlinear"]["metrics"]
            assert row["axis_metrics"]["psi"] == whole["axis_steps"]["psi"]["nonlinear"]["metrics"]
            assert row["margins"] == whole["margins"]
            np.testing.assert_allclose(row["norm"], np.linalg.norm(row["K"]))
            np.testing.assert_allclose(row["spectral_norm"], np.linalg.svd(row["K"])[1][0])


def test_comparison_of_chosen_methods(client):
    reply = post(client, "compare", {"methods": ["varga", "lqr"], "scenario": {"reference": {"theta": 0.1}}})
    assert [row["method"] for row in reply["rows"]] == ["varga", "lqr"]
    assert reply["claim"] == ""
    assert "psi" not in reply["rows"][0]["metrics"]
    assert post(client, "compare", {"methods": ["magic"]}, status=422)["field"] == "method"


def test_splits_reproduce_themselves_by_their_split(client):
    reply = post(client, "splits", PAPER)
    TypeAdapter(list[Split]).validate_python(reply)
    assert len(reply) == 6
    for split in reply:
        gains = post(client, "gains", {**PAPER, "split": split["split"]})
        assert gains["K"] == split["K"]
        assert gains["poles"] == split["poles"]
    assert len(post(client, "splits", {"poles": COMPLEX})) == 2


DESIGN_PROBLEMS = [
    ({"split": [[0, 1], [1, 2]]}, "invalid_input", "split"),
    ({"split": [[0, 1, 2], [3]]}, "invalid_input", "split"),
    ({"split": [[0, 4], [1, 2]]}, "invalid_input", "split.0.1"),
    ({"split": [[0, 2], [1, 3]], "poles": COMPLEX}, "unpaired_poles", "poles.1"),
    ({"shift": 1e7}, "invalid_input", "shift"),
    ({"shift": 0.1, "coupling": "axis-decoupled"}, "invalid_input", "shift"),
    ({"method": "magic"}, "invalid_input", "method"),
    ({"method": "bass-gura"}, "method_unavailable", "method"),
    ({"method": "knv0", "poles": COMPLEX}, "method_unavailable", "poles"),
    ({"weights": {"inputs": {"V_p": 0}}}, "invalid_input", "weights.inputs.V_p"),
    ({"weights": {"speed": 1}}, "unknown_field", "weights.speed"),
]


@pytest.mark.parametrize(("body", "code", "field"), DESIGN_PROBLEMS, ids=lambda x: json.dumps(x)[:40])
def test_bad_choices_of_method_split_and_shift_are_problems(client, body, code, field):
    reply = post(client, "gains", body, status=422)
    assert (reply["code"], reply["field"]) == (code, field)


def test_weights_and_methods_reach_the_design(client):
    plain = post(client, "gains", {"method": "lqr"})
    cheap = post(client, "gains", {"method": "lqr", "weights": {"inputs": {"V_p": 10.0, "V_y": 10.0}}})
    assert plain["method"] == "lqr" and "pole_error" not in plain
    assert cheap["norm"] < plain["norm"]
    integral = post(client, "evaluate", {"method": "lqr-integral"})
    Evaluation.model_validate(integral)
    assert np.shape(integral["gains"]["integral"]) == (2, 2)
    assert integral["stable"] is True


def test_methods_are_listed_with_their_sources(client):
    reply = client.get("/api/v1/methods").json()
    TypeAdapter(list[Method]).validate_python(reply)
    assert [method["name"] for method in reply] == list(METHODS)
    assert all(method["source"] and method["available"] for method in reply)
    assert reply[0]["couplings"] == ["triangular", "input-diagonal", "axis-decoupled"]
    assert all(not method["couplings"] for method in reply[1:])


def test_rga_gives_its_reason_and_dominance_over_frequency(client):
    reply = post(client, "rga", {**PAPER, "frequencies": [0.1, 10]})
    Rga.model_validate(reply)
    assert "near 1" in reply["reason"]
    assert np.shape(reply["dominance"]["rows"]) == (2, 2)
    assert reply["niederlinski"] > 0 > reply["niederlinski_cross"]
    aero = post(client, "rga", {"preset": "quanser-aero"})
    assert "does not make diagonal pairing unstable" in aero["reason"]
    assert aero["niederlinski_cross"] == pytest.approx(1 / aero["rga"][0][1])


def test_symbolic_shift_stays_a_symbol(client):
    reply = client.get("/api/v1/symbolic", params={"coupling": "input-diagonal", "shifted": "true"}).json()
    Symbolic.model_validate(reply)
    assert sp.Symbol("c") in sp.sympify(reply["K"]["sympy"]).free_symbols
    plain = client.get("/api/v1/symbolic", params={"coupling": "input-diagonal"}).json()
    shifted = sp.Matrix(sp.sympify(reply["K"]["sympy"])).subs(sp.Symbol("c"), 0)
    difference = shifted - sp.Matrix(sp.sympify(plain["K"]["sympy"]))
    assert all(sp.cancel(entry) == 0 for entry in difference)
    assert sp.Symbol("s") in sp.sympify(client.get("/api/v1/symbolic").json()["RGA_s"]["sympy"]).free_symbols
    refused = client.get("/api/v1/symbolic", params={"coupling": "axis-decoupled", "shifted": "true"})
    assert (refused.status_code, refused.json()["field"]) == (422, "shifted")


def test_walkthrough_gives_the_numbers_of_the_derivation(client):
    reply = post(client, "walkthrough", PAPER)
    Walkthrough.model_validate(reply)
    gains = post(client, "gains", PAPER)
    assert reply["K"] == gains["K"] and reply["A"] == gains["A"]
    Q, T = np.array(reply["Q"]), np.array(reply["T"])
    closed = np.linalg.inv(T) @ np.array(reply["closed_loop_bar"]) @ T
    assert pole_error(poles(gains["closed_loop_poles"]), np.linalg.eigvals(closed)) < 1e-6
    assert Q[0, 1] == pytest.approx(0.0068 / 0.204)
    np.testing.assert_allclose(np.linalg.solve(Q, np.array(reply["K_bar"]) @ T), reply["K"])  # Eq. 19
    assert reply["controllability_indices"] == [2, 2]
    assert pole_error(poles(reply["closed_loop_poles"]), poles(gains["closed_loop_poles"])) < 1e-9
    other = post(client, "walkthrough", {"method": "lqr"})
    Walkthrough.model_validate(other)
    assert {"A", "B", "trim", "constants", "controllability_matrix", "K", "G_0", "rga"} <= set(other)
    assert not {"T", "Q", "A_bar", "B_bar", "K_bar", "coefficients", "closed_loop_bar"} & set(other)
    assert "G_0" not in post(client, "walkthrough", {"poles": [0, -1, -2, -3]})


def test_the_paper_is_complete_and_every_erratum_holds(client):
    reply = client.get("/api/v1/paper").json()
    Paper.model_validate(reply)
    assert all(erratum["proof"]["holds"] for erratum in reply["errata"])
    assert len(reply["errata"]) == 12
    gain = [row for row in reply["numbers"] if row["name"].startswith("k_") and row["formula"]]
    assert len(gain) == 8
    assert all(row["digits"] == row["digits_printed"] and row["verdict"] == "reproduced" for row in gain)
    assert reply["consequence"][-1]["poles"][2]["im"] == pytest.approx(6.268, abs=1e-3)
    assert all("<math" in e["derived"]["mathml"] for e in reply["equations"] if "derived" in e)


def test_components_are_open(client):
    presets = {p["name"]: p for p in client.get("/api/v1/presets").json()}
    file = presets["quanser-2dof-design-file"]
    own = file["components"]
    assert own["K_fp"] * own["r_p"] == pytest.approx(file["parameters"]["K_pp"], abs=1e-15)
    assert file["component_info"]["R_p"] == {
        "meaning": "armature resistance of the pitch motor",
        "unit": "Ω",
        "printed": "R_m,p",
    }
    assert presets["quanser-aero"]["components"] == {}


SPRING = {"A": [["0", "1"], ["-k/m", "-b/m"]], "B": [["0"], ["1/m"]]}


def test_any_plant_is_placed_in_symbols(client):
    reply = post(client, "symbolic/place", SPRING)
    SymbolicPlacementReply.model_validate(reply)
    assert reply["controllability_indices"] == [2]
    assert [condition["sympy"] for condition in reply["holds_unless"]] == ["m"]
    k, m, b, p_1, p_2 = sp.symbols("k m b p_1 p_2")
    K = sp.Matrix(sp.sympify(reply["K"]["sympy"]))
    assert (K - sp.Matrix([[m * p_1 * p_2 - k, -m * (p_1 + p_2) - b]])).expand() == sp.zeros(1, 2)
    assert all(reply[name]["mathml"].startswith("<math") for name in ("A", "B", "T", "Q", "K", "closed_loop"))
    numbers = post(client, "symbolic/place", {**SPRING, "poles": WANTED[1:]})
    closed = sp.Matrix(sp.sympify(numbers["closed_loop"]["sympy"]))
    assert closed.charpoly().all_coeffs() == [1, 4, 5]
    greek = post(client, "symbolic/place", {"A": [["β"]], "B": [["lambda"]]})
    assert greek["letters"]["beta"]["sympy"] == "beta_" and greek["A"]["latex"].count(r"\beta") == 1
    assert greek["holds_unless"][0]["latex"] == r"\lambda"


SYMBOLIC_PROBLEMS = [
    ({"A": [["0", "1"], ["a*", "0"]]}, "invalid_input", "A.1.0"),
    ({"B": [["0"], ["import os"]]}, "invalid_input", "B.1.0"),
    ({"A": [["0", "1"], [None, "0"]]}, "invalid_input", "A.1.0"),
    ({"A": [["0", "1"], ["0"]]}, "invalid_input", "A"),
    ({"A": [["a", "0"], ["0", "a"]], "B": [["1"], ["1"]]}, "uncontrollable", "B"),
    ({"poles": [-1]}, "invalid_input", "poles"),
    ({"poles": [-1, {"re": -2, "im": 1}]}, "unpaired_poles", "poles.1"),
    ({"C": [[1]]}, "unknown_field", "C"),
]


@pytest.mark.parametrize(("change", "code", "field"), SYMBOLIC_PROBLEMS, ids=lambda x: json.dumps(x)[:40])
def test_bad_plants_in_symbols_are_problems_that_name_their_field(client, change, code, field):
    reply = post(client, "symbolic/place", {**SPRING, **change}, status=422)
    assert (reply["code"], reply["field"].removesuffix(".str").removesuffix(".float")) == (code, field)
    Problem.model_validate(reply)
