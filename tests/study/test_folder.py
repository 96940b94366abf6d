"""What is kept of a study, and what is said of a folder that holds something else."""

from __future__ import annotations

import json

import numpy as np
import pytest

from heli2dof_core.engine import warm_up
from heli2dof_core.study import Alone, Folder, StudyError, read_study, run, summarize
from heli2dof_core.study import folder as folder_module
from heli2dof_core.study import study as study_module

TEXT = """
study = 1
title = "A"
measures = ["settling_time", "gain_margin"]
[design]
scenario.duration = 2.0
[rigs]
count = 60
"""


@pytest.fixture(autouse=True)
def small_parts(monkeypatch):
    warm_up()
    monkeypatch.setattr(study_module, "PART", 25)


@pytest.fixture
def folder(tmp_path):
    own = Folder(tmp_path / "a.study", read_study(TEXT))
    run(own, Alone())
    return own


def test_other_tools_read_it(folder):
    from pyarrow import dataset

    table = (
        dataset.dataset(folder.path / "parts")
        .to_table()
        .sort_by([("design", "ascending"), ("rig", "ascending")])
    )
    assert table.column_names == ["design", "rig", "exists", "stable", "settling_time", "gain_margin"]
    assert table.num_rows == 61
    assert table.column("rig").to_pylist() == [*range(61)]
    parts = [folder.read(number) for number in range(3)]
    expected = np.concatenate([part.values for part in parts])
    for k, name in enumerate(("settling_time", "gain_margin")):
        np.testing.assert_array_equal(table.column(name).to_numpy(), expected[:, k])
    schema = dataset.dataset(folder.path / "parts").schema
    assert schema.field("settling_time").metadata == {b"unit": b"s", b"words": b"Settling time, either step"}


def test_none_and_unlimited_are_two_things(folder):
    part = folder.read(0)
    part.values[:3, 0], part.values[:3, 1] = np.nan, np.inf
    folder.write(part)
    from pyarrow import parquet

    table = parquet.read_table(folder.file(0))
    assert table.column("settling_time").to_pylist()[:3] == [None] * 3
    assert table.column("gain_margin").to_pylist()[:3] == [np.inf] * 3
    np.testing.assert_array_equal(folder.read(0).values, part.values)


def test_another_study_leaves_it_alone(folder):
    before = {file: file.read_bytes() for file in folder.path.rglob("*") if file.is_file()}
    with pytest.raises(StudyError, match="another study"):
        Folder(folder.path, read_study(TEXT.replace("60", "61")))
    assert before == {file: file.read_bytes() for file in folder.path.rglob("*") if file.is_file()}
    limits = TEXT + "[require]\nsettling_time = { max = 1 }"
    assert summarize(Folder(folder.path, read_study(limits))).digest == summarize(folder).digest


def test_another_version_leaves_it_alone(folder, monkeypatch):
    monkeypatch.setattr(folder_module, "package_version", lambda: "9.9")
    with pytest.raises(StudyError, match=r"this is 9\.9"):
        Folder(folder.path, folder.study)


def test_what_is_no_study_is_left_alone(tmp_path):
    (tmp_path / "thesis.tex").write_text("…")
    with pytest.raises(StudyError, match="holds something else"):
        Folder(tmp_path, read_study(TEXT))
    with pytest.raises(StudyError, match="holds something else"):
        Folder(tmp_path / "thesis.tex", read_study(TEXT))
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "study.json").write_text("{")
    with pytest.raises(StudyError, match="cannot be read"):
        Folder(tmp_path / "b", read_study(TEXT))


def test_what_a_crash_leaves_behind_counts_for_nothing(folder):
    half = folder.file(1).read_bytes()[:100]
    folder.file(1).with_name(".part-0000001.parquet.77").write_bytes(half)
    folder.file(2).unlink()
    assert folder.done() == {0, 1}
    with pytest.raises(StudyError, match="1 of 3 parts are missing"):
        summarize(folder)
    run(folder, Alone())
    assert folder.done() == {0, 1, 2}


def test_a_damaged_part_is_told(folder):
    folder.file(1).write_bytes(folder.file(1).read_bytes()[:-50])
    with pytest.raises(StudyError, match=r"part-0000001.parquet cannot be read"):
        summarize(folder)
    folder.file(1).write_bytes(folder.file(2).read_bytes())
    with pytest.raises(StudyError, match="not of this study"):
        summarize(folder)


def test_two_at_once_are_refused(folder, tmp_path):
    pytest.importorskip("fcntl")
    with folder.alone(), pytest.raises(StudyError, match="another process"):
        run(Folder(folder.path, folder.study), Alone())
    run(folder, Alone())


def test_what_it_is_of_stands_beside_it(folder):
    about = json.loads((folder.path / "study.json").read_text())
    assert about["fingerprint"] == folder.study.fingerprint
    assert about["study"]["rigs"]["count"] == 60
    assert sorted(file.name for file in folder.path.iterdir()) == ["lock", "parts", "study.json"]
