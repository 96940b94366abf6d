"""What routes give to workers: functions that a worker finds, their parts, and what becomes of them in a server."""

from __future__ import annotations

import ast
import asyncio
import os
import pickle
import signal
from collections.abc import AsyncIterator, Callable, Iterator
from importlib import import_module
from threading import Event
from types import MappingProxyType
from typing import Any

import httpx2
import orjson
import pytest
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from app.jobs.compute import Compute, OverdueError, WorkerLostError
from app.jobs.current import JobError, is_portable, portable
from app.jobs.fork_server import CAN_FORK
from app.jobs.kernel_compiler import KernelCompiler
from app.jobs.processes import WorkerProcesses
from heli2dof_core import evaluate, loop_of, place, preset, simulate
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.labs import LabError, read_lab
from tests import jobs_to_do
from tests.children import ROOT
from tests.loops import run
from tests.patience import PATIENCE, until
from tests.whole_server import serving

CLOSURES: set[str] = set()
"""Calls that still give a closure, which stays in a thread of the serving process; shall stay empty."""
SLOW = {"run_slow": 0, "stream": 0, "run_once": 1}
"""Methods of `Compute` whose functions go to workers, and which argument these are."""


def slow_calls() -> Iterator[tuple[str, str, str]]:
    """Module, enclosing line, and function of each call of the app that gives something to workers."""
    for path in sorted((ROOT / "app").rglob("*.py")):
        module = ".".join(path.relative_to(ROOT).with_suffix("").parts)
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in SLOW:
                owner = ast.unparse(node.func.value)
                if owner.endswith("compute"):
                    yield module, f"{path.name}:{node.lineno}", ast.unparse(node.args[SLOW[node.func.attr]])


def function_named(module: str, name: str) -> Any:
    """What a name means at a module's top level; None where it means nothing there."""
    return getattr(import_module(module), name, None)


def test_what_is_given_to_workers_is_found_there():
    calls = list(slow_calls())
    assert len(calls) >= 20  # else they are looked for in the wrong way
    lost = {line for module, line, name in calls if not is_portable(function_named(module, name))}
    assert {line.partition(":")[0] for line in lost} == CLOSURES


def test_functions_of_modules_are_portable_and_no_others():
    assert is_portable(jobs_to_do.told) and is_portable(os.getpid)
    assert not is_portable(lambda: None)
    assert not is_portable([].append)
    assert not is_portable(Compute.run)  # its name is not the module's


def test_results_and_specs_can_be_pickled(spec):
    results = [spec, place(spec), loop_of(spec), evaluate(spec), simulate(loop_of(spec), spec, "nonlinear")]
    for result in results:
        again = pickle.loads(pickle.dumps(result))
        assert type(again) is type(result)
    assert pickle.loads(pickle.dumps(spec)) == spec == type(spec).from_preset(preset())


class NeedsMoreError(Exception):
    """Cannot be made anew of its words alone."""

    def __init__(self, status: int, words: str) -> None:
        super().__init__(words)
        self.status = status


def test_errors_arrive_as_they_were():
    with pytest.raises(LabError) as refused:
        read_lab("name: [")
    lab = portable(refused.value)
    again = pickle.loads(pickle.dumps(lab))
    assert isinstance(again, LabError) and str(again) == str(refused.value)
    assert again.problems == refused.value.problems

    class LocalError(Exception):
        pass

    other = portable(LocalError("words"))
    assert isinstance(other, JobError) and "LocalError: words" in str(other)
    needs_more = portable(NeedsMoreError(404, "There is none."))
    assert isinstance(needs_more, JobError) and "There is none." in str(needs_more)
    unsendable = portable(InvalidInputError("no", field="x", value=MappingProxyType({})))
    assert isinstance(unsendable, InvalidInputError) and (unsendable.field, unsendable.value) == ("x", "{}")


@pytest.fixture(params=["threads", "processes"], scope="module")
def compute(request) -> Iterator[Compute]:
    """Slow work as one server has it, and as another."""
    if request.param == "processes" and not CAN_FORK:
        pytest.skip("slow work stays in threads here")
    compute = Compute(workers=WorkerProcesses(1) if request.param == "processes" else None, seconds=PATIENCE)
    compute.start()
    until(lambda: compute.compiled, "all is loaded")
    yield compute
    compute.close()
    compute.join()


async def collected(parts: AsyncIterator[Any]) -> list[Any]:
    return [part async for part in parts]


def test_parts_come_in_order_and_the_last_one_always(compute):
    for function, last in ((jobs_to_do.counted, 199), (jobs_to_do.told, "the end")):
        parts = run(collected(compute.stream(function, 200)))
        assert parts[-1] == last
        numbers = [part for part in parts if part != "the end"]
        assert numbers == sorted(set(numbers)) and numbers[-1] == 199


def test_who_is_slow_gets_the_newest_part(compute):
    async def slow() -> list[int]:
        parts = []
        async for part in compute.stream(jobs_to_do.counted, 1000):
            parts.append(part)
            if part < 999:
                # All others are made meanwhile: nobody else has work here.
                while compute.running["slow"]:
                    await asyncio.sleep(0)
        return parts

    parts = run(slow())
    assert parts[-1] == 999 and len(parts) <= 3


def test_who_leaves_the_loop_calls_the_work_off(compute):
    async def leave() -> None:
        async for _ in compute.stream(jobs_to_do.until_called_off):
            break
        while compute.running["slow"]:
            await asyncio.sleep(0)

    run(asyncio.wait_for(leave(), PATIENCE))


def test_what_a_job_raises_ends_its_parts(compute):
    with pytest.raises(InvalidInputError, match="J_p must be positive"):
        run(collected(compute.stream(jobs_to_do.refused)))
    with pytest.raises(InvalidInputError, match="J_p must be positive"):
        run(compute.run_slow(jobs_to_do.refused))


def test_a_closure_stays_in_a_thread(compute):
    seen = []
    assert run(compute.run_slow(lambda: seen.append(os.getpid()))) is None
    assert seen == [os.getpid()]


def test_only_processes_are_processes(compute):
    pid = run(compute.run_slow(os.getpid))
    assert (pid == os.getpid()) == (compute.workers is None)


@pytest.mark.skipif(not CAN_FORK, reason="slow work stays in threads here")
@pytest.mark.parametrize("compiles", [False, True])
def test_a_job_of_the_first_second_waits_for_workers_unless_kernels_are_compiled(compiles, monkeypatch):
    looked, known, done = Event(), Event(), Event()

    def load(_self: KernelCompiler, whole: Callable[[], None], compiling: Callable[[], None]) -> None:
        looked.set()
        known.wait(PATIENCE)
        if compiles:
            compiling()
            done.wait(PATIENCE)
        whole()

    monkeypatch.setattr(KernelCompiler, "run", load)
    compute = Compute(workers=WorkerProcesses(1), seconds=PATIENCE)
    compute.start()

    async def asked() -> int:
        job = asyncio.ensure_future(compute.run_slow(os.getpid))
        while not compute.waiting["slow"] and not job.done():  # until it is put
            await asyncio.sleep(0)
        while compute.waiting["slow"]:  # until a thread has it
            await asyncio.sleep(0)
        known.set()
        return await job

    try:
        assert looked.wait(PATIENCE)
        assert (run(asked()) == os.getpid()) == compiles
    finally:
        done.set()
        compute.close()
        compute.join()


@pytest.mark.skipif(not CAN_FORK, reason="slow work stays in threads here")
def test_lost_work_is_told_and_the_next_is_done():
    compute = Compute(workers=WorkerProcesses(1), seconds=PATIENCE)
    compute.start()
    try:
        until(lambda: compute.compiled, "all is loaded")
        with pytest.raises(WorkerLostError):
            run(compute.run_slow(jobs_to_do.killed))
        assert run(compute.run_slow(int, "7")) == 7
    finally:
        compute.close()
        compute.join()


@pytest.mark.skipif(not CAN_FORK, reason="slow work stays in threads here")
def test_time_is_limited_even_for_who_never_asks():
    workers = WorkerProcesses(1)
    workers.submit(int).result(PATIENCE)  # all is loaded
    compute = Compute(workers=workers, seconds=0.5)
    compute.start()
    try:
        until(lambda: compute.compiled, "the server's own are loaded")
        with pytest.raises(OverdueError):
            run(compute.run_slow(jobs_to_do.deaf))
    finally:
        compute.close()
        compute.join()


@pytest.mark.skipif(not CAN_FORK, reason="slow work stays in threads here")
def test_a_server_does_the_work_of_a_killed_worker_again():
    """Whoever asked gets what they would have got, to the last digit."""
    asked = '{"samples": 4000, "scenario": {"duration": 10}}'

    def last_part(peer: Connection, first: str | bytes) -> dict[str, Any]:
        part = orjson.loads(first)
        while part["done"] < 4000:
            part = orjson.loads(peer.recv(PATIENCE))
        return part

    with serving(workers=1) as server:
        url, workers = server.socket("/api/v1/robustness"), server.app.state.compute.workers
        with connect(url, compression=None, proxy=None, max_size=None) as peer:
            peer.send(asked)
            expected = last_part(peer, peer.recv(PATIENCE))
            peer.send(asked)
            begun = peer.recv(PATIENCE)
            (pid,) = workers.processes
            os.kill(pid, signal.SIGKILL)
            assert last_part(peer, begun) == expected
        assert workers.processes != [pid]
        assert (
            "heli2dof_workers_died_total 1.0" in httpx2.get(f"{server.http}/metrics", timeout=PATIENCE).text
        )
