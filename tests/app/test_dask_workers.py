"""A cluster in the place of worker processes: a real scheduler and workers on loopback."""

from __future__ import annotations

import threading
from concurrent.futures import CancelledError, wait

import httpx2
import pytest
from distributed import Client

from app.jobs import dask_workers
from app.jobs.choice import workers_of
from app.jobs.dask_workers import DaskWorkers
from app.jobs.workers import WorkerLostError
from heli2dof_core import Spec, evaluate
from heli2dof_core.errors import CancelledError as GivenUpError
from heli2dof_core.errors import InvalidInputError
from tests import cluster_jobs as jobs
from tests import clusters
from tests.children import served
from tests.clusters import cluster
from tests.patience import PATIENCE, until

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    with cluster(tmp_path_factory.mktemp("cluster")) as found:
        yield found


@pytest.fixture(scope="module")
def workers(running):
    own = workers_of(2, 2**30, running.address, ())
    assert isinstance(own, DaskWorkers)
    own.start()
    until(lambda: own.size == 2, "both workers are there")
    yield own
    own.shutdown(cancel_futures=True)


def test_jobs_are_done_elsewhere(workers, running):
    futures = [workers.submit(jobs.where) for _ in range(20)]
    pids = {future.result(PATIENCE) for future in futures}
    assert pids <= {worker.pid for worker in running.workers}


def test_equal_calls_are_done_each_by_itself(workers):
    assert [f.result(PATIENCE) for f in [workers.submit(jobs.twice, 4) for _ in range(3)]] == [8, 8, 8]
    assert workers.submit(jobs.twice, value=5).result(PATIENCE) == 10


def test_digits_are_those_of_this_process(workers):
    spec = Spec.from_preset()
    there = workers.submit(evaluate, spec).result(PATIENCE)
    here = evaluate(spec)
    assert there.step["nonlinear"].metrics == here.step["nonlinear"].metrics
    assert there.block["poles"].tobytes() == here.block["poles"].tobytes()


def test_an_error_comes_back_as_it_is(workers):
    with pytest.raises(InvalidInputError) as refused:
        workers.submit(jobs.refuse).result(PATIENCE)
    assert (refused.value.field, refused.value.value, refused.value.hint) == ("poles", 7, "Make it smaller.")
    assert "In the worker" in refused.value.__notes__[0]


def test_all_parts_have_come_before_the_outcome(workers):
    heard = []
    assert workers.submit_reporting(heard.append, 60.0, jobs.count, 200).result(PATIENCE) is None
    assert heard == [*range(200)]
    heard.clear()
    future = workers.submit_reporting(heard.append, 60.0, jobs.told_then_returned, 3)
    assert future.result(PATIENCE) == "whole"
    assert heard == [0, 1, 2]


def test_one_that_runs_is_called_off(workers, tmp_path):
    begun, ended = tmp_path / "begun", tmp_path / "ended"
    future = workers.submit(jobs.wait_until_unwanted, str(begun), str(ended))
    until(begun.exists, "it runs")
    assert future.cancel()
    with pytest.raises(CancelledError):
        future.result(0)
    until(ended.exists, "the worker has listened")
    assert not future.cancel()
    assert workers.submit(jobs.twice, 1).result(PATIENCE) == 2
    until(lambda: not workers._running, "nothing of it is kept")


def test_one_that_waits_is_never_begun(workers, tmp_path):
    running = [
        workers.submit(jobs.wait_until_unwanted, str(tmp_path / f"begun-{k}"), str(tmp_path / f"ended-{k}"))
        for k in range(2)
    ]
    until(lambda: (tmp_path / "begun-0").exists() and (tmp_path / "begun-1").exists(), "all are busy")
    waiting = workers.submit(jobs.wait_until_unwanted, str(tmp_path / "never"), str(tmp_path / "never"))
    assert waiting.cancel()
    for future in running:
        future.cancel()
    assert workers.submit(jobs.twice, 1).result(PATIENCE) == 2
    assert not (tmp_path / "never").exists()


def test_its_time_is_over_there_too(workers, tmp_path):
    future = workers.submit_reporting(
        lambda _: None, 0.2, jobs.wait_until_unwanted, str(tmp_path / "begun"), str(tmp_path / "ended")
    )
    with pytest.raises(GivenUpError):
        future.result(PATIENCE)
    assert (tmp_path / "ended").exists()


def test_what_cannot_be_sent_is_refused_at_once(workers):
    with pytest.raises(TypeError, match="cannot be sent"):
        workers.submit(jobs.twice, threading.Lock())


def test_a_worker_of_another_version_does_nothing(workers, monkeypatch):
    monkeypatch.setattr(dask_workers, "package_version", lambda: "0.0.1")
    with pytest.raises(RuntimeError, match=r"0\.0\.1 gives it jobs"):
        workers.submit(jobs.twice, 1).result(PATIENCE)


def test_a_servers_slow_work_is_done_by_the_cluster(running, tmp_path):
    def done_there() -> int:
        with Client(running.address, set_as_default=False) as client:
            return client.run_on_scheduler(_done)

    with served(tmp_path, dask=running.address, database="memory") as server:
        before, seed = done_there(), iter(range(1000))

        def answered_by_the_cluster() -> bool:  # threads have it while the kernels load
            body = {"samples": 20, "seed": next(seed)}
            reply = httpx2.post(f"{server.http}/api/v1/robustness", json=body, timeout=PATIENCE)
            assert reply.status_code == 200, reply.text
            return done_there() > before

        until(answered_by_the_cluster, "a worker of the cluster has computed")


def _done(dask_scheduler) -> int:
    prefix = dask_scheduler.task_prefixes.get("do")
    return 0 if prefix is None else prefix.state_counts["released"] + prefix.state_counts["memory"]


def test_a_job_whose_worker_dies_is_done_again(tmp_path):
    with cluster(tmp_path, 2) as own:
        workers = DaskWorkers(own.address)
        try:
            future = workers.submit(jobs.die_once, str(tmp_path / "died"))
            others = [workers.submit(jobs.twice, k) for k in range(50)]
            assert future.result(PATIENCE) in {worker.pid for worker in own.workers}
            assert [other.result(PATIENCE) for other in others] == [2 * k for k in range(50)]
            until(lambda: sum(worker.poll() is not None for worker in own.workers) == 1, "one has died")
        finally:
            workers.shutdown(cancel_futures=True)


def test_one_that_kills_every_worker_is_given_up(tmp_path, monkeypatch):
    monkeypatch.setitem(clusters.LIMITS, "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES", "1")
    with cluster(tmp_path, 3) as own:
        workers = DaskWorkers(own.address)
        try:
            with pytest.raises(WorkerLostError, match="lost with its workers"):
                workers.submit(jobs.always_die, str(tmp_path / "died")).result(PATIENCE)
            assert (tmp_path / "died").read_text() == "xx"
            assert workers.submit(jobs.twice, 1).result(PATIENCE) == 2
        finally:
            workers.shutdown(cancel_futures=True)


def test_a_scheduler_that_was_begun_again_is_found_again(tmp_path):
    with cluster(tmp_path, 1) as own:
        workers = DaskWorkers(own.address)
        try:
            future = workers.submit(
                jobs.wait_until_unwanted, str(tmp_path / "begun"), str(tmp_path / "ended")
            )
            until((tmp_path / "begun").exists, "it runs")
            own.end_scheduler()
            with pytest.raises(WorkerLostError, match="lost"):
                future.result(PATIENCE)
            own.begin_scheduler()
            own.add()

            def answers() -> bool:
                try:
                    return workers.submit(jobs.twice, 2).result(PATIENCE) == 4
                except WorkerLostError:
                    return False

            until(answers, "it works again")
        finally:
            workers.shutdown(cancel_futures=True)


def test_a_scheduler_that_does_not_answer_is_told(monkeypatch):
    monkeypatch.setattr(dask_workers, "_ANSWERED", 0.2)
    workers = DaskWorkers("tcp://127.0.0.1:9")
    with pytest.raises(WorkerLostError, match="does not answer"):
        workers.connected(0.5)
    workers.shutdown()
    with pytest.raises(RuntimeError, match="shut down"):
        workers.submit(jobs.twice, 1)


def test_jobs_end_when_the_workers_are_shut_down(running, tmp_path):
    own = DaskWorkers(running.address)
    ended = tmp_path / "ended"
    future = own.submit(jobs.wait_until_unwanted, str(tmp_path / "begun"), str(ended))
    until((tmp_path / "begun").exists, "it runs")
    own.shutdown(cancel_futures=True)
    assert wait([future], 0).done
    until(ended.exists, "the worker has listened")
