"""`heli2dof study` as users call it: killed in the middle, resumed, on several processes and on a cluster."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from heli2dof_core.study import read_study
from tests.children import ROOT, environment
from tests.clusters import cluster
from tests.patience import PATIENCE, until

TEXT = """
study = 1
title = "Gains"
measures = ["disk_margin"]
[design]
scenario.duration = 2.0
[designs.grid]
"loops.pitch.kp" = [5, 8, 11]
[rigs]
count = 6000
[require]
settling_time = { max = 1.5, share = 0.9, steps = "together" }
"""


@pytest.fixture
def file(tmp_path):
    own = tmp_path / "gains.toml"
    own.write_text(TEXT)
    return own


def command(*words: object) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "app", "study", *map(str, words)],
        cwd=ROOT,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # who runs the tests in the background ignores it, and so would this process
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),  # noqa: PLW1509
    )


def done(*words: object, status: int = 0) -> tuple[str, str]:
    process = command(*words)
    out, err = process.communicate(timeout=2 * PATIENCE)
    assert process.returncode == status, err
    return out, err


def parts(folder: Path) -> list[bytes]:
    return [file.read_bytes() for file in sorted((folder / "parts").glob("part-*.parquet"))]


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The whole study on one process: its folder."""
    folder = tmp_path_factory.mktemp("alone")
    (folder / "gains.toml").write_text(TEXT)
    done(folder / "gains.toml", "--processes", 1)
    assert len(parts(folder / "gains.study")) == read_study(TEXT).parts == 10
    return folder / "gains.study"


@pytest.mark.slow
def test_killed_in_the_middle_it_goes_on_and_the_digits_are_the_same(file, alone):
    folder = file.with_suffix(".study")
    process = command(file, "--processes", 1)
    try:
        until(lambda: folder.exists() and any(folder.glob("parts/part-*.parquet")), "a part is kept")
    finally:
        os.kill(process.pid, signal.SIGKILL)
        process.communicate()
    kept = len(parts(folder))
    assert 1 <= kept < 10
    out, err = done(file, "--processes", 2)
    assert "are there already; going on." in err
    assert "3 designs on 6,000 uncertain rigs each" in out
    assert parts(folder) == parts(alone)


@pytest.mark.slow
def test_on_a_cluster_of_which_a_worker_is_killed_the_digits_are_the_same(file, alone, tmp_path):
    folder = file.with_suffix(".study")
    with cluster(tmp_path) as running:
        process = command(file, "--cluster", running.address)
        until(lambda: folder.exists() and any(folder.glob("parts/part-*.parquet")), "a part is kept")
        running.workers[0].kill()
        out, err = process.communicate(timeout=2 * PATIENCE)
    assert process.returncode == 0, err
    assert parts(folder) == parts(alone)
    assert "meet all requirements" in out


@pytest.mark.slow
def test_ctrl_c_ends_it_and_keeps_what_is_done(file):
    folder = file.with_suffix(".study")
    process = command(file, "--processes", 2)
    until(lambda: folder.exists() and any(folder.glob("parts/part-*.parquet")), "a part is kept")
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=2 * PATIENCE)
    assert process.returncode == 1
    assert "Traceback" not in err
    assert parts(folder)


@pytest.mark.slow
def test_its_workers_do_not_outlive_it(file):
    folder = file.with_suffix(".study")
    process = command(file, "--processes", 2)
    until(lambda: folder.exists() and any(folder.glob("parts/part-*.parquet")), "a part is kept")
    os.kill(process.pid, signal.SIGKILL)
    process.communicate(timeout=2 * PATIENCE)  # returns once nobody has its outputs open any more


def test_what_is_done_is_told_again_at_once(alone, tmp_path):
    file = alone.with_suffix(".toml")
    out, err = done(file, "--json", "--csv", tmp_path / "all.csv")
    assert err == ""
    told = json.loads(out)
    assert (told["title"], told["pairs"], len(told["designs"])) == ("Gains", 18_003, 3)
    assert told["requirements"] == [
        {"words": "Settling time, both stepped, on 90 % of the rigs", "limit": "≤ 1.50 s", "share": 0.9}
    ]
    with (tmp_path / "all.csv").open() as source:
        rows = [*csv.DictReader(source)]
    assert [row["loops.pitch.kp"] for row in rows] == ["5", "8", "11"]
    assert float(rows[1]["disk_margin_p5"]) == told["designs"][1]["disk_margin_p5"]


def test_what_is_refused_is_told_with_its_field(file, tmp_path, alone):
    file.write_text(TEXT.replace("loops.pitch.kp", "loops.pitch.kq"))
    _, err = done(file, status=2)
    assert err.splitlines()[0].startswith("heli2dof: designs.grid.loops.pitch.kq: there is no number")
    assert "loops.pitch.kp" in err.splitlines()[1]
    file.write_text(TEXT.replace("6000", "6001"))
    _, err = done(file, "--into", alone, status=2)
    assert "holds the numbers of another study" in err
    _, err = done(tmp_path / "none.toml", status=2)
    assert "does not exist" in err
