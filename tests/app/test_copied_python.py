"""What the page puts into the clipboard as Python runs, and means what the server said."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp
from starlette.testclient import TestClient

ROOT = Path(__file__).parents[2]

SCRIPT = """
import { allOf, textOf } from "./static/ui/copy_formats.js";
const { items, all } = JSON.parse(await new Response(process.stdin).text());
console.log(JSON.stringify({ each: items.map((item) => textOf(item, "Python")), all: allOf(all, "Python") }));
"""


def node() -> str:
    beside = Path(sys.executable).with_name("node")
    found = str(beside) if beside.exists() else shutil.which("node")
    if not found:
        pytest.skip("no Node here")
    return found


def texts(items: list[dict[str, Any]], together: list[dict[str, Any]]) -> dict[str, Any]:
    """The page's own formatter, run by Node."""
    command = [node(), "--input-type=module", "--eval", SCRIPT]
    stdin = json.dumps({"items": items, "all": together})
    done = subprocess.run(command, cwd=ROOT, input=stdin, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def executed(text: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(compile(text, "copied", "exec"), names)
    return names


def test_copied_numbers_are_the_servers_to_the_last_digit(client: TestClient):
    reply = client.post(
        "/api/v1/gains", json={"poles": [{"re": -3, "im": 4}, {"re": -3, "im": -4}, -9, -0.7]}
    ).json()
    items = [{"name": name, "note": "a note", "matrix": reply[name]} for name in ("K", "A", "B")]
    items.append({"name": "poles", "poles": reply["closed_loop_poles"]})
    names = executed(texts([], items)["all"])
    for name in ("K", "A", "B"):
        assert names[name].dtype == float
        np.testing.assert_array_equal(names[name], reply[name])
    expected = [complex(p["re"], p["im"]) for p in reply["closed_loop_poles"]]
    np.testing.assert_array_equal(names["poles"], expected)


@pytest.mark.parametrize("coupling", ["triangular", "input-diagonal", "axis-decoupled"])
def test_copied_formulas_are_the_servers(client: TestClient, coupling: str):
    symbolic = client.get("/api/v1/symbolic", params={"coupling": coupling, "lead": "pitch"}).json()
    definitions = {name: d["sympy"] for name, d in symbolic["definitions"].items()}
    formulas = {name: symbolic[name] for name in ("K", "A", "B", "T", "Q", "G", "RGA") if name in symbolic}
    formulas |= symbolic.get("entries", {}).get("K", {})
    items = [{"name": name, **formula, "definitions": definitions} for name, formula in formulas.items()]
    for (name, formula), text in zip(formulas.items(), texts(items, [])["each"], strict=True):
        assert executed(text)[name] == sp.sympify(formula["sympy"]), name
