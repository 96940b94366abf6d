"""Any system over REST and as a command; its files run in Octave's language and in Python."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import control as ct
import numpy as np
import pytest
from click.testing import CliRunner
from fastapi.testclient import TestClient

from app.cli.systems import system as command
from app.contract import systems as contract
from heli2dof_core.systems.textbook import EXAMPLES
from tests.app.test_placement_api import post

OBSERVED = {
    "A": [[0, 1], [20.6, 0]],
    "B": [[0], [1]],
    "C": [[1, 0]],
    "poles": [{"re": -1.8, "im": 2.4}, {"re": -1.8, "im": -2.4}],
    "observer_poles": [-8, -8],
}


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_example_is_read_and_designed(client: TestClient, name):
    example = next(e for e in client.get("/api/v1/system/examples").json() if e["name"] == name)
    contract.SystemExample.model_validate(example)
    read = contract.SystemRead.model_validate(post(client, "system/read", {"text": example["text"]}))
    body = {key: matrix.values for key, matrix in read.matrices.items()}
    body["poles"] = [p.model_dump() for p in read.poles]
    if read.observer_poles:
        body["observer_poles"] = [p.model_dump() for p in read.observer_poles]
    body["method"] = example["method"]
    if "weights" in example:
        body["weights"] = example["weights"]
    told = contract.SystemDesign.model_validate(post(client, "system/design", body))
    own = EXAMPLES[name]
    assert own.text == example["text"]
    n, p = np.shape(body["B"])
    assert np.shape(told.K) == (p, n)
    assert len(told.courses.step_y[0][0]) == len(told.courses.t)
    assert np.shape(told.bode.plant["gain"])[2] == len(told.bode.frequencies)


def test_design_is_the_books(client: TestClient):
    reply = post(client, "system/design", OBSERVED)
    assert np.allclose(reply["K"], [[29.6, 3.6]]) and np.allclose(reply["observer"]["L"], [[16], [84.6]])
    assert reply["scaling"] == "static" and reply["courses"]["step_y"][0][0][-1] == pytest.approx(1, abs=0.01)


def test_an_initial_state_and_the_weight_of_the_integrals_are_python_controls(client: TestClient):
    x0, weights = [0.3, -2], {"states": [2, 1], "inputs": [0.5], "integrals": [30]}
    body = {name: OBSERVED[name] for name in ("A", "B", "C", "poles")} | {"x0": x0, "weights": weights}
    reply = post(client, "system/design", body | {"method": "lqr-integral"})
    A, B, C = (np.array(OBSERVED[name], dtype=float) for name in "ABC")
    gain, *_ = ct.lqr(ct.ss(A, B, C, 0), np.diag([2, 1, 30]), [[0.5]], integral_action=C)
    assert np.allclose(reply["K"], gain[:, :2]) and np.allclose(reply["K_z"], gain[:, 2:])
    whole = ct.ss(np.block([[A - B @ gain[:, :2], -B @ gain[:, 2:]], [C, 0]]), np.zeros((3, 1)), np.eye(3), 0)
    t = np.linspace(0, reply["courses"]["t"][-1], len(reply["courses"]["t"]))  # which are short floats
    course = ct.initial_response(whole, t, [*x0, 0]).outputs
    assert np.allclose(reply["courses"]["initial_x"], course[:2], atol=1e-5)
    assert reply["courses"]["x0"] == pytest.approx(x0)
    other = post(
        client, "system/design", body | {"method": "lqr-integral", "weights": weights | {"integrals": [3]}}
    )
    assert abs(other["K_z"][0][0]) < abs(reply["K_z"][0][0])


def test_formulas(client: TestClient):
    asked = {"A": [["0", "1"], ["-k/m", "0"]], "B": [["0"], ["1/m"]], "C": [["1", "0"]]}
    reply = contract.SystemFormulas.model_validate(post(client, "system/formulas", asked))
    assert reply.K.sympy == "Matrix([[-k + m*p_1*p_2, m*(-p_1 - p_2)]])" or "p_1*p_2" in reply.K.sympy
    assert reply.L is not None and "q_1" in reply.L.sympy
    blind = contract.SystemFormulas.model_validate(
        post(client, "system/formulas", asked | {"C": [["0", "0"]]})
    )
    assert blind.L is None and blind.reason


@pytest.mark.parametrize(
    ("call", "body", "field"),
    [
        ("read", {"text": "A = [1 2; 3"}, "text"),
        ("design", OBSERVED | {"poles": [-1]}, "poles"),
        ("design", OBSERVED | {"observer_poles": [-1]}, "observer_poles"),
        ("design", OBSERVED | {"C": [[0, 0]]}, "C"),
        ("design", OBSERVED | {"B": [[0], [0]]}, "B"),
        ("design", OBSERVED | {"x0": [1]}, "x0"),
        ("design", OBSERVED | {"x0": [1, -1e300]}, "x0.1"),
        ("design", OBSERVED | {"duration": 0}, "duration"),
        ("design", {"A": [[0]], "B": [[1]], "poles": [-1], "method": "lqr-integral"}, "C"),
        ("design", OBSERVED | {"method": "none"}, "method"),
        ("formulas", {"A": [["x("]], "B": [["1"]]}, "A.0.0"),
    ],
)
def test_refusals_name_the_field(client: TestClient, call, body, field):
    assert post(client, f"system/{call}", body, status=422)["field"] == field


def python_file(tmp_path: Path, content: bytes) -> dict[str, np.ndarray]:
    file = tmp_path / "design.py"
    file.write_bytes(content + b"\nnp.savez('found.npz', K=K, poles=poles, y=y, free=free)\n")
    subprocess.run([sys.executable, file.name], cwd=tmp_path, check=True, capture_output=True)
    return dict(np.load(tmp_path / "found.npz"))


@pytest.mark.parametrize("method", ["full-rank", "lqr-integral"])
def test_the_python_file_runs(client: TestClient, tmp_path, method):
    body = OBSERVED | {"method": method}
    reply = post(client, "system/design", body)
    content = client.post(
        "/api/v1/system/export/python", json=body, params={"link": "http://a.b/#v1"}
    ).content
    assert b"http://a.b/#v1" in content
    found = python_file(tmp_path, content)
    assert np.allclose(found["K"], reply["K"])
    assert np.allclose(found["y"][0, 0], reply["courses"]["step_y"][0][0], atol=1e-5)
    if method == "full-rank":
        law = ct.ss(
            np.array(OBSERVED["A"]) - np.array(OBSERVED["B"]) @ found["K"], OBSERVED["B"], OBSERVED["C"], 0
        )
        free = ct.initial_response(law, np.linspace(0, reply["courses"]["t"][-1], 241), [1, 0]).outputs
        assert np.allclose(found["free"][0], free, atol=1e-6)


def test_the_matlab_file_has_balanced_brackets_and_the_json_file_is_the_reply(client: TestClient):
    content = client.post("/api/v1/system/export/matlab", json=OBSERVED).text
    assert all(content.count(a) == content.count(b) for a, b in ("[]", "()"))
    assert "np." not in content and "@" not in content
    told = client.post("/api/v1/system/export/json", json=OBSERVED).json()
    again = client.post("/api/v1/system/design", json=told["origin"]["request"]).json()
    assert again["K"] == told["K"]


@pytest.mark.skipif(not shutil.which("octave-cli"), reason="no Octave here")
def test_the_matlab_file_runs_in_octave(client: TestClient, tmp_path):
    for method in ("full-rank", "lqr-integral"):
        body = OBSERVED | {"method": method}
        content = client.post("/api/v1/system/export/matlab", json=body).text
        (tmp_path / "design.m").write_text(f"quiet = true;\n{content}\nsave('-ascii', 'y.txt', 'y');\n")
        subprocess.run(["octave-cli", "--norc", "design.m"], cwd=tmp_path, check=True, capture_output=True)
        reply = post(client, "system/design", body)
        assert np.allclose(np.loadtxt(tmp_path / "y.txt")[:, 0], reply["courses"]["step_y"][0][0], atol=1e-5)


def test_the_command(tmp_path):
    text = "A = [0 1; 20.6 0]; B = [0; 1]; C = [1 0]\np = [-1.8+2.4j, -1.8-2.4j]; q = [-8 -8]"
    file = tmp_path / "system.m"
    file.write_text(text)
    shown = CliRunner().invoke(command, [str(file)])
    assert shown.exit_code == 0 and "29.6" in shown.stdout and "84.6" in shown.stdout
    told = CliRunner().invoke(command, [str(file), "--json"]).stdout.splitlines()
    assert np.allclose(json.loads(told[1])["K"], [[29.6, 3.6]]) and "analysis" in json.loads(told[0])
    started = CliRunner().invoke(command, [str(file), "--json", "--x0", "0,-2"]).stdout.splitlines()
    assert json.loads(started[1])["courses"]["x0"] == [0, -2]
    short = CliRunner().invoke(command, [str(file), "--json", "--x0", "1"])
    assert short.exit_code == 2 and "x0 has 1 entries" in short.stderr
    refused = CliRunner().invoke(command, ["-"], input="A = [1")
    assert refused.exit_code == 2 and "line 1, column 5" in refused.stderr
