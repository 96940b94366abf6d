"""The notebook runs from top to bottom and shows what it promises, in a kernel as in Jupyter."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
FILE = ROOT / "examples" / "pole_placement.ipynb"
NOTEBOOK = json.loads(FILE.read_text(encoding="utf-8"))
CODE = [cell for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"]


def test_outputs_are_not_kept():
    assert len(CODE) > 8
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in CODE)


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")
def test_it_runs_in_a_kernel(monkeypatch: pytest.MonkeyPatch):
    """In Jupyter's own kernel, with its displays: tables, typeset formulas, figures."""
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    notebook = nbformat.reads(FILE.read_text(encoding="utf-8"), as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(ROOT)}}).execute()
    shown: list[dict[str, Any]] = [
        output.get("data", {})
        for cell in notebook.cells
        if cell.cell_type == "code"
        for output in cell.outputs
    ]
    assert sum("image/png" in data for data in shown) == 2
    assert any(">51.17</td>" in data.get("text/html", "") for data in shown)
    assert any(r"\begin{matrix}" in data.get("text/latex", "") for data in shown)
    assert not any("array(" in data.get("text/plain", "")[:40] for data in shown if "text/html" in data)


def test_it_runs_cell_by_cell(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    """Without a kernel: the names that it leaves hold the paper's numbers."""
    monkeypatch.setenv("MPLBACKEND", "agg")
    import matplotlib as mpl

    mpl.use("agg")
    names: dict[str, Any] = {}
    for cell in CODE:
        exec(compile("".join(cell["source"]), FILE.name, "exec"), names)
    assert names["report"].design.K[0, 0] == pytest.approx(51.170053, abs=1e-6)
    assert names["whole"].nstates == 6
    assert names["cloud"].done == 50
    first, _, last = (
        line for line in capsys.readouterr().out.split("\n") if line.startswith(("<Loop", "<Sugg"))
    )
    assert "unstable" in first and "<Loop: stable" in last
    import matplotlib.pyplot as plt

    assert len(plt.get_fignums()) == 2
    plt.close("all")
