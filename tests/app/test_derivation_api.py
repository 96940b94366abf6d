"""What is replied beyond the paper's model: formulas of six states and of the observer, and their numbers."""

from __future__ import annotations

import json

import numpy as np
import pytest
import sympy as sp

from app.contract.derivation import SymbolicObserver, SymbolicRotors, Walkthrough
from tests.app.test_cli import run

LAG = {"pitch": {"tau": 0.16}, "yaw": {"tau": 0.2}}
SIX = {"rotors": LAG, "place_rotors": True, "rotor_poles": [-18, -19]}


@pytest.mark.parametrize("coupling", ["triangular", "input-diagonal", "axis-decoupled"])
def test_six_states_and_the_observer_in_formulas(client, coupling):
    reply = client.get("/api/v1/symbolic", params={"coupling": coupling, "model": "rotors"}).json()
    SymbolicRotors.model_validate(reply)
    assert reply["controllability_indices"] == [3, 3]
    K = sp.Matrix(sp.sympify(reply["K"]["sympy"]))
    assert K.shape == (2, 6)
    assert K[1, 5] == sp.sympify(reply["entries"]["K"]["k_26"]["sympy"])
    observers = [
        client.get("/api/v1/symbolic", params={"coupling": coupling, "what": "L", "model": model}).json()
        for model in ("paper", "rotors")
    ]
    SymbolicObserver.model_validate(observers[0])
    assert observers[0] == observers[1]
    assert sp.Matrix(sp.sympify(observers[0]["L"]["sympy"])).shape == (4, 2)


@pytest.mark.parametrize(
    ("query", "field"),
    [
        ({"model": "four"}, "model"),
        ({"what": "M"}, "what"),
        ({"model": "rotors", "coupling": "axis-decoupled", "shifted": True}, "shifted"),
        ({"what": "L", "coupling": "axis-decoupled", "shifted": True}, "shifted"),
    ],
)
def test_what_is_not_derived_is_refused(client, query, field):
    answer = client.get("/api/v1/symbolic", params=query)
    assert answer.status_code == 422 and answer.json()["field"] == field


@pytest.mark.parametrize("shift", [None, 0.3])
@pytest.mark.parametrize("lead", ["pitch", "yaw"])
def test_formulas_with_the_replied_names_are_the_replied_gain(client, lead, shift):
    """A reader who puts the walkthrough's names into the formulas gets K of POST gains."""
    query = {"lead": lead, "model": "rotors", "shifted": shift is not None}
    body = {**SIX, "lead": lead, **({} if shift is None else {"shift": shift})}
    entries = client.get("/api/v1/symbolic", params=query).json()["entries"]["K"]
    steps = client.post("/api/v1/walkthrough", json=body).json()
    Walkthrough.model_validate(steps)
    known = {**steps["rotors"]["names"], "c": shift or 0.0, "a": steps["constants"]["a"]}
    K = client.post("/api/v1/gains", json=body).json()["K"]
    assert steps["rotors"]["placed"] and steps["rotors"]["K"] == K
    for i in range(2):
        for j in range(6):
            value = float(sp.sympify(entries[f"k_{i + 1}{j + 1}"]["sympy"]).subs(known))
            assert value == pytest.approx(K[i][j], rel=1e-11, abs=1e-12 * np.max(np.abs(K)))


def test_the_papers_steps_stay_the_papers_where_the_rotors_are_placed(client):
    plain = client.post("/api/v1/walkthrough", json={"rotors": LAG}).json()
    placed = client.post("/api/v1/walkthrough", json={**SIX, "rotor_poles": [-15, -16]}).json()
    changed = ("rotors",)
    assert {k: v for k, v in plain.items() if k not in changed} == {
        k: v for k, v in placed.items() if k not in changed
    }
    assert {**plain["rotors"], "placed": True} == placed["rotors"]
    assert np.shape(placed["K"]) == (2, 4) and np.shape(placed["rotors"]["K"]) == (2, 6)


def test_a_motor_without_crosstalk_leaves_every_other_method_its_numbers(client):
    """The paper's basis does not exist there; another method needs none of it."""
    body = {"method": "knv0", "parameters": {"K_pp": 0.0}, "rotors": LAG}
    steps = client.post("/api/v1/walkthrough", json=body).json()
    assert "T" not in steps and steps["constants"]["gamma_"] != 0
    assert np.shape(steps["rotors"]["K"]) == (2, 6) and "h_1" not in steps["rotors"]["names"]


def test_what_six_states_cannot_have_is_told_and_hides_nothing_else(client):
    body = {"preset": "quanser-aero-2", "rotors": {"pitch": {"tau": 0.16, "curve": "quadratic"}}}
    steps = client.post("/api/v1/walkthrough", json=body).json()
    assert "does not change" in steps["rotors"]["refused"] and "K" not in steps["rotors"]
    assert steps["K"] and steps["observer"]["L"]


def test_the_observers_numbers_are_those_of_the_gains(client):
    for own in ({"poles": [-30, -31, -32, -33]}, {"method": "kalman", "angle_noise": 1e-3}):
        body = {"observer": own}
        found = client.post("/api/v1/walkthrough", json=body).json()["observer"]
        assert found["L"] == client.post("/api/v1/gains", json=body).json()["observer"]["L"]
        assert ("asked" in found) == ("poles" in own) and not found["used"]


def test_command_line_tells_the_same(client):
    shown = json.loads(run("symbolic", "--model", "rotors", "--lead", "yaw", "--json").stdout)
    assert shown == client.get("/api/v1/symbolic?lead=yaw&model=rotors").json()
    assert run("symbolic", "--what", "L").stdout.startswith("L = Matrix([[-nu_p - q_1 - q_2, 0]")
    assert run("symbolic", "K", "h_1", "b_11", "--model", "rotors").stdout.count("\n") == 3
