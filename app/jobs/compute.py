"""The core's work off the event loop: quick and slow work in threads of their own, each client in turn."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import logging
import os
import sys
import threading
from collections.abc import Awaitable, Callable
from concurrent.futures import InvalidStateError
from contextvars import ContextVar
from dataclasses import dataclass
from functools import partial
from time import monotonic, perf_counter
from typing import Any, TypeVar

from threadpoolctl import threadpool_limits

from heli2dof_core.compiled import warm_up
from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.engine import engine
from heli2dof_core.errors import CancelledError

from .fair_queue import BusyError, Client, FairQueue, Job, OverdueError
from .kernel_compiler import KernelCompiler

_log = logging.getLogger(__name__)
T = TypeVar("T")
SWITCH_INTERVAL = 0.0005
"""Seconds for which a computing thread keeps Python's lock while the event loop wants it; Python's own 5 ms
would be most of a drag's answer."""
NICENESS = 5
"""Of the slow threads: where processors are short, the event loop goes first."""


@dataclass(frozen=True)
class Caller:
    """For whom the present task works; `disconnected` returns once an HTTP client has left."""

    client: Client = ("", 0)
    disconnected: Callable[[], Awaitable[None]] | None = None


NO_CALLER = Caller()
current_caller: ContextVar[Caller] = ContextVar("current_caller", default=NO_CALLER)
"""Set by the server for every request and socket."""
_current_job: ContextVar[tuple[Job, float] | None] = ContextVar("current_job", default=None)


def check_cancelled() -> None:
    """Long work calls this now and then.

    Raises:
        CancelledError: nobody waits for its outcome any more, or it has taken too long.
    """
    current = _current_job.get()
    if current is not None and (current[0].cancelled.is_set() or monotonic() > current[1]):
        raise CancelledError("cancelled")


class _Pool:
    """Threads that take jobs from a fair queue."""

    def __init__(self, name: str, threads: int, queue: FairQueue, seconds: float, *, nice: bool) -> None:
        self.queue, self.seconds, self._nice = queue, seconds, nice
        self.running = 0
        self.threads = [
            threading.Thread(target=self._serve, name=f"{name}-{i}", daemon=True) for i in range(threads)
        ]
        for thread in self.threads:
            thread.start()

    def _serve(self) -> None:
        if self._nice and sys.platform == "linux":  # where a thread has a niceness of its own
            with contextlib.suppress(OSError):
                os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICENESS)
        while (job := self.queue.take()) is not None:
            if job.future.set_running_or_notify_cancel():
                self.running += 1
                self._do(job)
                self.running -= 1
            del job  # nothing of it is kept until the next one comes

    def _do(self, job: Job) -> None:
        token = _current_job.set((job, monotonic() + self.seconds))
        try:
            outcome = job.work()
        except BaseException as error:
            self._deliver(job.future.set_exception, error)
        else:
            self._deliver(job.future.set_result, outcome)
        finally:
            _current_job.reset(token)

    @staticmethod
    def _deliver(how: Callable[[Any], None], outcome: Any) -> None:
        with contextlib.suppress(InvalidStateError, RuntimeError):  # the event loop may be closed by now
            how(outcome)


class Compute:
    """Runs functions of the core in threads.

    Interpreted kernels answer from the start. `start` loads the compiled ones in the background (see
    `kernel_compiler`), then runs the derivation, which imports SymPy and takes a second or two, so that no
    formula waits for it.

    Args:
        threads: for quick work.
        slow_threads: for what takes seconds; they yield to all others where processors are short.
        most_waiting, most_each: jobs that may wait in each of the two queues, in all and for one connection.
        seconds: after which slow work is given up.
    """

    def __init__(
        self,
        threads: int = 2,
        slow_threads: int = 2,
        *,
        most_waiting: int = 256,
        most_each: int = 8,
        seconds: float = 60.0,
    ) -> None:
        self._quick = _Pool("compute", threads, FairQueue(most_waiting, most_each), seconds, nice=False)
        self._slow = _Pool("slow", slow_threads, FairQueue(most_waiting, most_each), seconds, nice=True)
        self._kernels = KernelCompiler()
        self._compiled = False
        self._once: dict[Any, asyncio.Task[Any]] = {}
        self._warming: threading.Thread | None = None

    @property
    def ready(self) -> bool:
        """Whether it takes work."""
        return self._warming is not None

    @property
    def compiled(self) -> bool:
        """Whether all is derived and compiled: a common update then takes a millisecond or two."""
        return self._compiled

    @property
    def waiting(self) -> dict[str, int]:
        """Jobs that wait, quick and slow."""
        return {"quick": len(self._quick.queue), "slow": len(self._slow.queue)}

    @property
    def running(self) -> dict[str, int]:
        """Jobs that are being done, quick and slow."""
        return {"quick": self._quick.running, "slow": self._slow.running}

    def start(self) -> None:
        """Begins to load the compiled kernels and to derive, in the background.

        BLAS is kept to one thread: on matrices of six rows its own threads only wait for one
        another, which costs three times the processor time of the work itself.
        """
        threadpool_limits(limits=1, user_api="blas")
        sys.setswitchinterval(SWITCH_INTERVAL)
        self._warming = threading.Thread(target=self._warm_up, name="warming", daemon=True)
        self._warming.start()

    async def run(self, function: Callable[..., T], *args: object) -> T:
        """`function(*args)` in a thread.

        Raises:
            BusyError: too much waits already.
            OverdueError: it took too long.
        """
        return await self._run(self._quick, function, args)

    async def run_slow(self, function: Callable[..., T], *args: object) -> T:
        """As `run`, for what takes seconds: in threads of its own, so that no design waits for it."""
        return await self._run(self._slow, function, args)

    async def run_once(self, key: object, function: Callable[..., T], *args: object) -> T:
        """As `run_slow`, for what is always the same: derived by the first who asks, and kept."""
        task: asyncio.Task[T] | None = self._once.get(key)
        if task is None:
            task = self._once[key] = asyncio.create_task(self._run_without_caller(function, args))
            task.add_done_callback(partial(self._forget, key))
        # Shielded: who leaves meanwhile leaves the others their answer.
        return await asyncio.shield(task)

    async def _run_without_caller(self, function: Callable[..., T], args: tuple[object, ...]) -> T:
        current_caller.set(NO_CALLER)
        return await self._run(self._slow, function, args)

    def _forget(self, key: object, task: asyncio.Task[Any]) -> None:
        if task.cancelled() or task.exception() is not None:
            self._once.pop(key, None)

    async def _run(self, pool: _Pool, function: Callable[..., T], args: tuple[object, ...]) -> T:
        caller = current_caller.get()
        job = Job(caller.client, partial(function, *args))
        pool.queue.put(job)
        outcome = asyncio.wrap_future(job.future)
        disconnect = asyncio.ensure_future(caller.disconnected()) if caller.disconnected else None
        try:
            either = {outcome} if disconnect is None else {outcome, disconnect}
            await asyncio.wait(either, timeout=2 * pool.seconds, return_when=asyncio.FIRST_COMPLETED)
            if not outcome.done():
                raise OverdueError(f"This took longer than the {pool.seconds:g} s that the server gives it.")
            try:
                return outcome.result()
            except CancelledError as error:
                raise OverdueError(f"This took longer than {pool.seconds:g} s and was given up.") from error
        finally:
            if not outcome.done():
                job.cancelled.set()
                pool.queue.drop(job)
                outcome.cancel()
            if disconnect is not None:
                disconnect.cancel()

    def close(self) -> None:
        """Drops what waits and stops the threads."""
        self._kernels.close()
        for task in self._once.values():
            task.cancel()
        for pool in (self._quick, self._slow):
            for job in pool.queue.close():
                job.cancelled.set()
                job.future.cancel()

    def join(self) -> None:
        """Waits, after `close`, until no thread computes any more."""
        for thread in (*self._quick.threads, *self._slow.threads, self._warming):
            if thread is not None:
                thread.join()

    def _warm_up(self) -> None:
        self._kernels.run()
        began = perf_counter()
        warm_up(STRUCTURES)
        _log.info("derivation ready after %.2f s", perf_counter() - began)
        if engine().compiled:
            # What lives as long as the process is not looked through again: a full collection would
            # stop every client for an eighth of a second.
            gc.collect()
            gc.freeze()
            self._compiled = True


__all__ = ["BusyError", "Caller", "Compute", "OverdueError", "check_cancelled", "current_caller"]
