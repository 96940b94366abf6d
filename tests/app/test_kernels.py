"""The child process that compiles a server's kernels."""

from __future__ import annotations

import subprocess

import heli2dof_core
from app.kernels import compiler


def test_it_compiles_the_package_that_serves_and_not_one_in_the_working_directory(tmp_path, monkeypatch):
    other = tmp_path / "heli2dof_core"
    other.mkdir()
    (other / "__init__.py").write_text("raise SystemExit('another one')")
    monkeypatch.chdir(tmp_path)
    command, environment = compiler("import heli2dof_core; print(heli2dof_core.__file__)")
    shown = subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout
    assert shown.strip() == heli2dof_core.__file__
