"""`heli2dof lab`: what it writes passes its own check; exit statuses; refusals with line, column and field."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from app.cli.group import heli2dof
from heli2dof_core.labs import LOCKS, read_file, student_rig
from heli2dof_core.labs.quantities import QUANTITIES
from heli2dof_core.labs.schema import schema_text
from heli2dof_core.measured import MEASURED

SMALL = Path(__file__).with_name("small.yaml")


def run(*words, status: int = 0, given: str | None = None) -> str:
    result = CliRunner().invoke(heli2dof, ["lab", *map(str, words)], input=given, prog_name="heli2dof")
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    assert result.exit_code == status, result.output
    return result.output


def test_what_new_writes_passes_check(tmp_path):
    file = tmp_path / "my-first-lab.yaml"
    assert str(file) in run("new", file)
    assert read_file(file).name == "my-first-lab"
    assert run("check", "--strict", file) == "1 file, 0 errors, 0 warnings\n"
    assert "exists already" in run("new", file, status=2)
    run("new", tmp_path / "another")
    assert (tmp_path / "another.yaml").exists()
    assert "my-lab-2" in run("new", tmp_path / "My Lab 2", status=2)
    assert "cannot be written" in run("new", tmp_path / "none" / "lab", status=1)


def test_check_tells_all_with_lines_and_ends_with_2(tmp_path):
    broken = tmp_path / "small.yaml"
    broken.write_text(
        SMALL.read_text("utf-8").replace("max: 1.5 s", "max: 1.5 V").replace("cost: 1}", "cost: x}"), "utf-8"
    )
    told = run("check", broken, SMALL, status=2)
    assert f"{broken}:24:" in told and "steps[0].goals[0].max" in told and "steps[0].hints[0].cost" in told
    assert "2 files, 2 errors, 0 warnings" in told
    problems = json.loads(run("check", "--json", broken, status=2))
    assert [own["path"] for own in problems] == ["steps[0].goals[0].max", "steps[0].hints[0].cost"]
    assert all(
        own["line"] and own["column"] and own["hint"] and own["severity"] == "error" for own in problems
    )


def test_a_broken_file_is_told_before_kernels_are_compiled(tmp_path, monkeypatch):
    loaded = []
    monkeypatch.setattr("app.cli.labs.load_kernels", lambda: loaded.append(True))
    broken = tmp_path / "small.yaml"
    for change in (("cost: 1}", "cost: x}"), ("steps:", "steps: [")):
        broken.write_text(SMALL.read_text("utf-8").replace(*change), "utf-8")
        run("check", broken, status=2)
    assert not loaded
    run("check", SMALL)
    assert loaded


def test_warnings_are_errors_where_it_is_strict(tmp_path):
    file = tmp_path / "small.yaml"
    file.write_text(SMALL.read_text("utf-8").replace("max: 1.5 s", "max: 0.1 s"), "utf-8")
    assert "0 errors, 1 warning" in run("check", file)
    run("check", "--strict", file, status=2)
    other = tmp_path / "other.yaml"
    shutil.copy(SMALL, other)
    assert "the lab is called small, its file other" in run("check", other, status=2)


def test_try_shows_texts_rig_and_what_is_reached():
    told = run("try", SMALL, "--seed", 3, "--step", "settle", "--answer", "slowest=-6,0")
    for part in (
        "Drag pitch's pair.",
        "rig of seed 3",
        "0.8086",
        "≤ 1.50 s",
        "✓",
        "−6 rad/s",
        "hint 1 (1 point)",
        "13 of 17",
    ):
        assert part in told, part
    assert "Now with PI" not in told
    found = json.loads(run("try", SMALL, "--seed", 3, "--json"))
    assert found["rig"] == student_rig(read_file(SMALL), 3)
    assert [step["step"] for step in found["steps"]] == ["settle", "loop"]
    assert found["steps"][0]["right"]["slowest"]["value"] == pytest.approx(-6)
    assert "no step 'other'" in run("try", SMALL, "--step", "other", status=2)
    assert "no lab of that name ships" in run("try", "nothing", status=2)


def test_a_design_is_tried_in_place_of_the_solution(tmp_path):
    file = tmp_path / "design.json"
    file.write_text(json.dumps({"poles": [-2, -2, -1, -1]}), "utf-8")
    told = run("try", SMALL, "--step", "settle", "--design", file)
    assert "Locked, and taken from the start: yaw-poles." in told
    file.write_text("{", "utf-8")
    assert "no JSON" in run("try", SMALL, "--design", file, status=2)


def test_mark_prints_a_table_of_attempts(tmp_path):
    good = {"name": "Ada", "seed": 4, "step": "settle", "design": {"poles": [-6, -7, -9.25, -8.76]}}
    attempts = [
        good | {"answers": {"who": 2, "slowest": "-6"}, "hints": [1]},
        good | {"name": "Bo", "design": {}},
    ]
    file = tmp_path / "attempts.json"
    file.write_text(json.dumps(attempts), "utf-8")
    told = run("mark", SMALL, file)
    assert "Ada" in told and "14 of 17" in told and "Bo" in told
    found = json.loads(run("mark", SMALL, file, "--json"))
    assert found[0]["points"] == 14 and found[0]["goals"][0]["met"] is True
    alone = json.loads(
        run("mark", SMALL, "-", "--step", "settle", "--seed", 4, "--json", given=json.dumps(good["design"]))
    )
    assert alone[0]["goals"] == found[0]["goals"]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("", "no JSON"),
        ("3", "no JSON object"),
        ('{"poles": [-1, -2]}', "at least 4 items"),
        ('{"poles": "x"}', "poles"),
        ('{"design": {"nothing": 1}}', "nothing"),
        ('{"design": {}, "step": "other"}', "no step 'other'"),
        ('{"design": {}, "hints": [9]}', "no hint 9"),
        ('{"design": {}, "seed": "x"}', "seed of attempt 1"),
        ('{"design": {}, "answers": 3}', "answers of attempt 1"),
    ],
)
def test_an_attempt_that_is_none_is_refused_with_words(given, words):
    assert words in run("mark", SMALL, "-", "--step", "settle", status=2, given=given)


def test_an_attempt_says_its_step():
    assert "names no step" in run("mark", SMALL, "-", status=2, given='{"design": {}}')


def test_schema_and_figures_are_the_registries():
    assert run("schema") == schema_text()
    told = run("figures")
    assert all(name in told for name in ("settling_time", "slowest_pole", "pitch-poles", "K[i,j]"))
    found = json.loads(run("figures", "--json"))
    assert [own["name"] for own in found["figures"]] == [*MEASURED]
    assert len(found["quantities"]) == len(QUANTITIES) and found["locks"].keys() == LOCKS.keys()
