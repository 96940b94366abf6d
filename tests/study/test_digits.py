"""The same digits however a study is divided, on one process, on several, and after one was killed."""

from __future__ import annotations

import os
import signal

import numpy as np
import pytest

from heli2dof_core import cloud
from heli2dof_core.engine import warm_up
from heli2dof_core.errors import CancelledError
from heli2dof_core.many import Many
from heli2dof_core.on_rigs import OnRigs
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.robustness import Uncertainty, random_factors
from heli2dof_core.study import (
    Alone,
    Folder,
    Pool,
    StudyError,
    compute,
    processes,
    read_study,
    run,
    summarize,
)
from heli2dof_core.study import study as study_module
from heli2dof_core.study.rigs import Rigs

TEXT = """
study = 1
measures = ["settling_time", "disk_margin", { measure = "iae", axis = "theta", steps = "together" }]
[design]
scenario.duration = 2.0
[designs.grid]
"loops.pitch.kp" = [4, 9]
"pitch-pair.re" = [-3, -9]
[rigs]
count = 90
seed = 4
"""


@pytest.fixture(autouse=True)
def small_parts(monkeypatch):
    """So that a small study has many."""
    warm_up()
    monkeypatch.setattr(study_module, "PART", 50)


def whole(folder):
    return [folder.file(number).read_bytes() for number in range(folder.study.parts)]


@pytest.fixture
def alone(tmp_path):
    """The study on one process."""
    folder = Folder(tmp_path / "alone", read_study(TEXT))
    run(folder, Alone())
    return folder


@pytest.mark.parametrize("distribution", ["uniform", "normal"])
def test_a_rig_is_the_same_in_whichever_part(distribution):
    spread = {"J_p": 0.3, "K_yy": 0.2, "tau_p": 0.4}
    rigs = Rigs(Uncertainty(spread, distribution, samples=1, seed=9), 10**9)
    whole = rigs.factors(0, 300)
    np.testing.assert_array_equal(np.vstack([rigs.factors(k, k + 7) for k in range(0, 300, 7)])[:300], whole)
    assert rigs.factors(10**9 - 1, 10**9).shape == (1, 14)
    varied = [[*PARAMETER_INFO].index("J_p"), [*PARAMETER_INFO].index("K_yy"), 12]
    assert np.all(np.delete(whole, varied, axis=1) == 1.0)
    expected = [0.3 / 3**0.5, 0.2 / 3**0.5, 0.4 / 3**0.5] if distribution == "uniform" else [0.3, 0.2, 0.4]
    many = rigs.factors(0, 40_000)[:, varied]
    np.testing.assert_allclose(np.std(many, axis=0), expected, rtol=0.03)
    np.testing.assert_allclose(np.mean(many, axis=0), 1.0, atol=0.01)


def test_uniform_rigs_are_those_of_robustness():
    uncertainty = Uncertainty(samples=500, seed=11)
    np.testing.assert_array_equal(Rigs(uncertainty, 500).factors(0, 500), random_factors(uncertainty))


def test_values_are_those_of_the_library():
    study = read_study(TEXT)
    part = compute(study.task(2))  # of rigs 9 and on of the second design
    assert part.design.tolist() == [1] * 50
    assert part.rig.tolist() == [*range(9, 59)]
    factors = random_factors(Uncertainty(samples=90, seed=4))
    own = OnRigs(study.spec(1), study.measures, unstable=False)
    np.testing.assert_array_equal(part.values, own.values(factors[8:58]))
    first = compute(study.task(0))
    many = Many(study.spec(0), study.measures)
    row = many.row[np.newaxis]
    np.testing.assert_array_equal(first.values[:1], many.values(row, many.run(row)))


def test_the_share_of_stable_rigs_is_that_of_the_cloud(alone):
    summary = summarize(alone)
    uncertainty = Uncertainty(samples=90, seed=4)
    shares = [cloud(alone.study.spec(i), uncertainty).share_stable for i in range(4)]
    assert [own.stable for own in summary.designs] == shares
    assert min(shares) < 1  # else it says little


def test_another_division_has_the_same_rows(alone, tmp_path, monkeypatch):
    monkeypatch.setattr(study_module, "PART", 77)
    other = Folder(tmp_path / "other", read_study(TEXT))
    run(other, Alone())
    assert other.study.parts != 8
    assert summarize(other).digest == summarize_with(monkeypatch, 50, alone)


def summarize_with(monkeypatch, part, folder):
    monkeypatch.setattr(study_module, "PART", part)
    return summarize(folder).digest


def test_a_design_that_does_not_exist_is_told_and_the_others_are_there(tmp_path):
    study = read_study("""
study = 1
measures = ["settling_time"]
[design]
scenario.duration = 2.0
parameters = { K_pp = 0.2, K_yy = 0.2, K_py = 0.0, K_yp = 0.0 }
[designs.grid]
"parameters.K_py" = [0.0, 0.2]
"parameters.K_yp" = [0.0, 0.2]
[rigs]
count = 3
""")
    folder = Folder(tmp_path / "some", study)
    run(folder, Alone())
    part, summary = folder.read(0), summarize(folder)
    assert part.exists.tolist() == [True] * 12 + [False] * 4
    assert not part.stable[12:].any()
    assert np.isnan(part.values[12:]).all()
    assert "1 do not exist: design 3:" in summary.summary()
    assert "controllable" in summary.reason


def test_it_ends_when_nobody_wants_it_any_more():
    asked = []

    def check():
        asked.append(1)
        if len(asked) == 4:
            raise CancelledError("cancelled")

    with pytest.raises(CancelledError):
        compute(read_study(TEXT).task(0), check)


def test_what_is_there_is_not_computed_again(alone, tmp_path):
    """Called off in the middle, it goes on with what is missing."""
    study, folder = alone.study, Folder(tmp_path / "again", alone.study)
    told = []

    def stop() -> None:
        if len(told) == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(folder, Alone(), told.append, stop)
    assert folder.done() == {0, 1, 2}
    times = {n: folder.file(n).stat().st_mtime_ns for n in folder.done()}
    last = run(Folder(tmp_path / "again", study), Alone(), told.append)
    assert (last.pairs, last.earlier) == (study.pairs, 150)
    assert times == {n: folder.file(n).stat().st_mtime_ns for n in times}
    assert whole(folder) == whole(alone)


@pytest.mark.slow
def test_two_processes_one_of_them_killed(alone, tmp_path):
    folder, pool, killed = Folder(tmp_path / "two", alone.study), processes(2), []

    def kill_one(progress):
        if progress.pairs and not killed:
            killed.append(min(pool.executor._processes))
            os.kill(killed[0], signal.SIGKILL)

    try:
        last = run(folder, pool, kill_one)
    finally:
        pool.close()
    assert killed and last.again > 0
    assert whole(folder) == whole(alone)


class Dying:
    """Workers that are always lost."""

    lost = (BrokenPipeError,)
    size = 2

    def submit(self, function, task, /):
        from concurrent.futures import Future

        future = Future()
        future.set_exception(BrokenPipeError("gone"))
        return future


def test_a_part_that_always_loses_its_worker_is_given_up(tmp_path):
    with pytest.raises(StudyError, match="lost its worker 4 times: gone"):
        run(Folder(tmp_path / "dying", read_study(TEXT)), Dying())


def test_an_executor_can_be_any():
    from concurrent.futures import ThreadPoolExecutor

    pool = Pool(lambda: ThreadPoolExecutor(1), 1)
    assert pool.submit(compute, read_study(TEXT).task(0)).result().number == 0
    pool.close()
