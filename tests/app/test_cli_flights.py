"""`heli2dof fly`: by a script, by a task, and again by its log."""

from __future__ import annotations

import json

import numpy as np
import pytest

from .test_cli import run

SCRIPT = """0 reference theta=5° psi=20°
1 gust 0.01 0.02 seconds=0.5
1.5 design {"poles": [-4, -5, -6, -7]}
"""


def test_a_script_is_flown_written_and_flown_again(tmp_path):
    path = tmp_path / "script.txt"
    path.write_text(SCRIPT, encoding="utf-8")
    words = ("fly", "--script", str(path), "--seconds", "3")
    said = run(*words).stdout
    assert "3 s, 1500 ticks, 3 events" in said and "bumpless" in said and "error RMS" in said
    log = tmp_path / "my.flight.json"
    kept = run(*words, "--log", str(log))
    assert kept.stderr.strip() == str(log) and kept.stdout == said
    assert "--force" in run(*words, "--log", str(log), status=1).stderr
    again = json.loads(run("fly", "--again", str(log), "--json").stdout)
    first = json.loads(run(*words, "--json").stdout)
    assert again["hash"] == first["hash"] and again["apart"] == 0.0 and again["ticks"] == 1500
    csv = run("fly", "--again", str(log), "--csv").stdout.splitlines()
    head = next(n for n, line in enumerate(csv) if not line.startswith("#"))
    assert csv[head].startswith("t [s],theta [rad]") and len(csv) - head - 1 == 1501
    np.testing.assert_allclose(float(csv[-1].split(",")[1]), again["theta"][-1], rtol=1e-11)


def test_the_designs_options_are_flown():
    plain, other = (
        json.loads(
            run(
                "fly", "--script", "-", "--seconds", "1", "--json", *more, given=SCRIPT.partition("1 g")[0]
            ).stdout
        )
        for more in ((), ("--poles", "-3,-4,-5,-6"))
    )
    assert plain["hash"] != other["hash"]


def test_a_task_is_flown_by_the_design_and_scored(tmp_path):
    log = tmp_path / "land.flight.json"
    said = run("fly", "--task", "land", "--seed", "3", "--log", str(log)).stdout
    assert "task land" in said and "Landing error" in said and "of 3" in said
    body = json.loads(log.read_text(encoding="utf-8"))
    assert body["task"] == "land" and body["seed"] == 3
    score = json.loads(run("fly", "--again", str(log), "--json").stdout)["score"]
    assert score["flaw"] == "" and score["done"] and f"{score['stars']} of 3" in said
    holds = [json.loads(run("fly", "--task", "hold", "--seed", n, "--json").stdout) for n in "112"]
    assert holds[0]["hash"] == holds[1]["hash"] != holds[2]["hash"]  # its gusts are its seed


def test_a_flight_has_one_origin():
    for words in (
        *(("--task", "hold", "--script", "-"), ("--task", "hold", "--seconds", "3")),
        *(
            ("--again", "-", "--poles", "-1,-2,-3,-4"),
            ("--again", "-", "--no-saturation"),
            ("--again", "-", "--seed", "3"),
        ),
        *(("-o", "no.csv"), ("--every", "2"), ("--duration", "3"), ("--csv", "--every", "0")),
    ):
        run("fly", *words, status=2, given="")
    problem = json.loads(run("fly", "--task", "dance", "--json", status=2).stderr)
    assert problem["field"] == "task" and "hold" in problem["hint"]


def test_a_long_flight_is_told_of_some_ticks(tmp_path):
    design = tmp_path / "fast.json"
    design.write_text('{"scenario": {"digital": {"sample_time": 1e-4}}}', encoding="utf-8")
    words = ("fly", "--design", str(design), "--seconds", "41")
    assert "one tick in 2" in run(*words).stdout
    reply = json.loads(run(*words, "--json").stdout)
    assert reply["ticks"] == 410_000 and "score" not in reply and len(reply["t"]) <= 2001
    assert "every: these are 410000 rows" in run(*words, "--csv", status=2).stderr
    rows = [line for line in run(*words, "--csv", "--every", "1000").stdout.splitlines() if line[0] != "#"]
    assert len(rows) == 412 and rows[-1].startswith("41,")


def test_the_reply_is_that_of_the_call(client, tmp_path):
    log = tmp_path / "own.flight.json"
    said = json.loads(run("fly", "--seconds", "5", "--json", "--log", str(log)).stdout)
    body = json.loads(log.read_text(encoding="utf-8"))
    assert client.post("/api/v1/flights", json={"flight": body}).json() == said


@pytest.mark.parametrize(
    "words", [("--seed", "-1"), ("--seconds", "1e-9"), ("--seconds", "nan"), ("--seed", "4294967296")]
)
def test_a_log_that_nobody_could_read_is_not_written(tmp_path, words):
    log = tmp_path / "own.flight.json"
    said = run("fly", "--seconds", "1", *words, "--log", str(log), status=2).stderr
    assert words[0][2:] in said and not log.exists()


def test_what_cannot_be_flown_is_refused_in_words(tmp_path):
    assert (
        "line 1, column 3: theta of push"
        in run("fly", "--script", "-", status=2, given="1 push 1000 0").stderr
    )
    gust = run("fly", "--script", "-", status=2, given="1 gust 0 0.1 seconds=-5").stderr
    assert "line 1, column 3" in gust and "-5 s" in gust
    assert "no word" in run("fly", "--script", "-", status=2, given="1 jump 0").stderr
    wrong = tmp_path / "no.json"
    wrong.write_text("1 push 0 0", encoding="utf-8")
    assert "not JSON" in run("fly", "--again", str(wrong), status=2).stderr
    assert "leave" in run("fly", "--again", str(wrong), "--seconds", "3", status=2).stderr
    body = json.loads(run("fly", "--seconds", "1", "--log", "-").stdout)
    body["ticks"] += 1
    wrong.write_text(json.dumps(body), encoding="utf-8")
    problem = json.loads(run("fly", "--again", str(wrong), "--json", status=2).stderr)
    assert problem["code"] == "changed_log" and problem["field"] == "checksum"
