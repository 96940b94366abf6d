"""The examples of docs/study.md are read as they stand."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from heli2dof_core.study import Alone, Folder, read_study, run, summarize

TEXT = (Path(__file__).parents[2] / "docs" / "study.md").read_text(encoding="utf-8")
FILES = re.findall(r"```toml\n(.*?)```", TEXT, re.DOTALL)


@pytest.mark.parametrize("number", range(3))
def test_files_are_studies(number, tmp_path):
    assert len(FILES) == 3
    few = re.sub(r"^count = \d+", "count = 2", FILES[number], flags=re.MULTILINE)
    assert read_study(FILES[number]).pairs >= 500
    folder = Folder(tmp_path / "a", read_study(few))
    run(folder, Alone())
    assert all(own.exists for own in summarize(folder).designs)


def test_python_runs_as_it_stands(tmp_path, monkeypatch):
    (code,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "gains.toml").write_text("study = 1\n[rigs]\ncount = 3\n")
    names: dict[str, object] = {}
    exec(code, names)
    assert names["best"].design == 0
