"""The kernels that are made of the derivation: `python -m tests.kernel_formulas` writes them, as ruff has them."""

from __future__ import annotations

import subprocess
import sys

from heli2dof_core.symbolic.kernel_code import modules
from tests.children import ROOT

FOLDER = ROOT / "heli2dof_core" / "kernels"


def files() -> dict[str, str]:
    """Texts by name."""
    return {name: _formatted(text, name) for name, text in modules().items()}


def _formatted(text: str, name: str) -> str:
    command = [sys.executable, "-m", "ruff", "format", "--stdin-filename", str(FOLDER / name), "-"]
    return subprocess.run(
        command, input=text, cwd=ROOT, capture_output=True, text=True, encoding="utf-8", check=True
    ).stdout


if __name__ == "__main__":
    for name, text in files().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
