"""Workers as processes: outcomes, parts, calling off, processes that end, memory."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import CancelledError, Executor, Future
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import pytest

from app.jobs.fork_server import CAN_FORK
from app.jobs.processes import WorkerProcesses
from app.jobs.workers import UNLIMITED, WorkerLostError
from heli2dof_core import errors
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.systems.text import PastedError
from tests import jobs_to_do
from tests.children import ROOT, environment
from tests.patience import PATIENCE, until

pytestmark = pytest.mark.skipif(not CAN_FORK, reason="slow work stays in threads here")
MEMORY = 2**28


@pytest.fixture(scope="module")
def workers() -> Iterator[WorkerProcesses]:
    with WorkerProcesses(2, MEMORY) as workers:
        workers.start()
        yield workers


def begun(
    workers: WorkerProcesses, function: Any, *args: Any, seconds: float = UNLIMITED
) -> tuple[Future, SimpleQueue]:
    """A job, and its parts as they come."""
    parts: SimpleQueue[Any] = SimpleQueue()
    return workers.submit_reporting(parts.put, seconds, function, *args), parts


def is_gone(pid: int) -> bool:
    """Whether none of its threads runs any more, so that its sockets are closed; it may be a zombie."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        return state == "Z" and len(list(Path(f"/proc/{pid}/task").iterdir())) <= 1
    except (FileNotFoundError, ProcessLookupError):
        return True


def test_it_is_an_executor(workers):
    assert issubclass(WorkerProcesses, Executor)
    assert workers.submit(int, "ff", base=16).result(PATIENCE) == 255
    assert list(workers.map(pow, range(5), [2] * 5)) == [0, 1, 4, 9, 16]
    assert workers.submit(os.getpid).result(PATIENCE) in workers.processes


def test_a_worker_has_everything_from_its_fork_on(workers):
    assert workers.submit(jobs_to_do.loaded).result(PATIENCE) == (True, True)


def test_a_worker_collects_its_own_garbage_and_leaves_what_is_shared(workers):
    collects, shared = workers.submit(jobs_to_do.collecting).result(PATIENCE)
    assert collects and shared > 100_000


def test_parts_come_in_order_before_the_outcome(workers):
    job, parts = begun(workers, jobs_to_do.counted, 100)
    assert job.result(PATIENCE) is None
    assert [parts.get_nowait() for _ in range(100)] == list(range(100))
    job, parts = begun(workers, jobs_to_do.told, 3)
    assert job.result(PATIENCE) == "the end"
    assert [parts.get_nowait() for _ in range(3)] == [0, 1, 2]


def test_what_is_refused_there_is_refused_here(workers):
    with pytest.raises(InvalidInputError, match="J_p must be positive") as refused:
        workers.submit(jobs_to_do.refused).result(PATIENCE)
    assert (refused.value.field, refused.value.value, refused.value.hint) == ("J_p", -1.0, "Give kg·m².")
    assert "jobs_to_do.py" in refused.value.__notes__[0]  # where it happened
    with pytest.raises(PastedError, match="line 1, column 5"):
        workers.submit(jobs_to_do.pasted).result(PATIENCE)


def test_what_cannot_be_sent_is_an_error_and_no_silence(workers):
    with pytest.raises(TypeError, match="cannot be sent to a worker"):
        workers.submit(lambda: None)
    with pytest.raises((TypeError, AttributeError), match="pickle"):
        workers.submit(jobs_to_do.unsendable).result(PATIENCE)
    assert workers.submit(int, "7").result(PATIENCE) == 7


def test_who_asks_is_called_off_and_the_process_stays(workers):
    job, parts = begun(workers, jobs_to_do.until_called_off)
    pid = parts.get(timeout=PATIENCE)
    assert job.cancel()
    with pytest.raises(CancelledError):
        job.result(PATIENCE)
    assert not job.cancel()  # it is over
    assert pid in workers.processes and not is_gone(pid)


def test_who_never_asks_loses_its_process(workers):
    job, parts = begun(workers, jobs_to_do.deaf)
    pid = parts.get(timeout=PATIENCE)
    assert job.cancel()
    with pytest.raises(CancelledError):
        job.result(PATIENCE)
    assert is_gone(pid)
    assert pid not in workers.processes


def test_a_job_that_waits_is_called_off_at_once(workers):
    busy = [begun(workers, jobs_to_do.until_called_off) for _ in range(2)]
    for _, parts in busy:
        parts.get(timeout=PATIENCE)
    waiting = workers.submit(os.getpid)
    assert waiting.cancel() and waiting.cancelled()
    for job, _ in busy:
        job.cancel()
        with pytest.raises(CancelledError):
            job.result(PATIENCE)


@pytest.mark.parametrize("function", [jobs_to_do.until_called_off, jobs_to_do.deaf])
def test_time_is_limited_whether_it_asks_or_not(workers, function):
    job, _ = begun(workers, function, seconds=0.05)
    with pytest.raises(errors.CancelledError):
        job.result(PATIENCE)


def test_a_worker_that_is_killed_is_replaced_and_nobody_else_notices(workers, tmp_path):
    (mine, parts), (other, others_parts) = (
        begun(workers, jobs_to_do.until_there, str(tmp_path / "go")) for _ in range(2)
    )
    first, others = parts.get(timeout=PATIENCE), others_parts.get(timeout=PATIENCE)
    before = workers.died
    os.kill(first, signal.SIGKILL)
    again = parts.get(timeout=PATIENCE)  # it has begun anew
    assert again != first
    (tmp_path / "go").touch()
    assert mine.result(PATIENCE) == again
    assert other.result(PATIENCE) == others and others_parts.empty()
    assert workers.died == before + 1


def test_a_worker_that_is_killed_while_it_has_no_job_costs_no_try(workers):
    before = workers.died
    for pid in workers.processes:
        os.kill(pid, signal.SIGKILL)
        until(lambda pid=pid: is_gone(pid), "it has ended")
    assert list(workers.map(int, "1234")) == [1, 2, 3, 4]
    assert workers.died == before


def test_a_job_that_ends_every_process_is_given_up(workers):
    before = workers.died
    with pytest.raises(WorkerLostError):
        workers.submit(jobs_to_do.killed).result(PATIENCE)
    assert workers.died == before + 2
    assert workers.submit(int, "7").result(PATIENCE) == 7


def test_a_fork_server_that_is_killed_is_started_again(workers):
    workers.submit(os.getpid).result(PATIENCE)
    server = workers._fork_server._child
    server.kill()
    for pid in workers.processes:
        os.kill(pid, signal.SIGKILL)
    assert list(workers.map(int, "1234", timeout=PATIENCE)) == [1, 2, 3, 4]
    assert workers._fork_server._child.pid != server.pid


def test_a_fork_server_that_ends_and_still_looks_alive_is_started_again(workers, monkeypatch):
    workers.submit(os.getpid).result(PATIENCE)
    fork_server = workers._fork_server
    server, died = fork_server._child, workers.died
    server.kill()
    server.wait()
    monkeypatch.setattr(server, "poll", lambda: None)
    connection, pid = fork_server.fork()
    connection.close()
    until(lambda: is_gone(pid), "it has ended")
    assert fork_server._child.pid != server.pid
    assert workers.died == died


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the system does not bound it")
def test_memory_is_bounded(workers):
    assert workers.submit(jobs_to_do.of_size, MEMORY // 2).result(PATIENCE) == MEMORY // 2
    with pytest.raises(MemoryError):
        workers.submit(jobs_to_do.of_size, 2 * MEMORY).result(PATIENCE)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nobody knows how large a process is")
def test_a_worker_that_keeps_much_is_replaced_after_its_job(workers):
    before = workers.died
    pid = workers.submit(jobs_to_do.kept, 3 * MEMORY // 4).result(PATIENCE)
    until(lambda: is_gone(pid), "it has ended")
    assert list(workers.map(int, "1234", timeout=PATIENCE)) == [1, 2, 3, 4]
    assert workers.died == before


@pytest.mark.skipif(sys.platform != "linux", reason="Linux tells both")
def test_slow_work_stands_back(workers):
    niceness, killed_first = workers.submit(jobs_to_do.standing).result(PATIENCE)
    assert niceness >= min(os.nice(0) + 15, 19)
    assert killed_first >= 500


def test_a_shutdown_calls_everything_off_and_ends_the_processes():
    workers = WorkerProcesses(1)
    job, parts = begun(workers, jobs_to_do.deaf)
    waiting = workers.submit(os.getpid)
    pid = parts.get(timeout=PATIENCE)
    workers.shutdown(cancel_futures=True)
    until(lambda: is_gone(pid), "it has ended")
    with pytest.raises(CancelledError):
        job.result(0)
    assert waiting.cancelled()
    with pytest.raises(RuntimeError, match="shut down"):
        workers.submit(os.getpid)


def test_a_shutdown_while_it_loads_waits_for_nothing():
    workers = WorkerProcesses(1)
    job = workers.submit(os.getpid)
    workers.shutdown(cancel_futures=True)
    with pytest.raises(CancelledError):
        job.result(0)


KILLED = """
import sys, time
from app.jobs.processes import WorkerProcesses
from tests import jobs_to_do
workers = WorkerProcesses(1)
tell = lambda pid: print(workers._fork_server._child.pid, pid, flush=True)
workers.submit_reporting(tell, 1e9, jobs_to_do.deaf).result()
"""


def test_no_process_outlives_the_serving_one():
    with subprocess.Popen(
        [sys.executable, "-c", KILLED], cwd=ROOT, env=environment(), stdout=subprocess.PIPE, text=True
    ) as server:
        assert server.stdout is not None
        pids = [int(pid) for pid in server.stdout.readline().split()]
        server.kill()
    assert len(pids) == 2
    until(lambda: all(is_gone(pid) for pid in pids), "fork server and worker end by themselves")
