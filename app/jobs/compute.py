"""The core's work off the event loop: quick work in threads, slow work in worker processes, each client in turn."""

from __future__ import annotations

import asyncio
import concurrent.futures
import contextlib
import gc
import logging
import os
import sys
import threading
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable
from concurrent.futures import InvalidStateError
from contextvars import ContextVar
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from typing import Any, TypeVar

from threadpoolctl import threadpool_limits

from heli2dof_core.compiled import warm_up
from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.engine import engine
from heli2dof_core.errors import CancelledError

from .current import Report, check_cancelled, is_portable, report, run_job, seconds_left
from .fair_queue import BusyError, Client, FairQueue, Job, OverdueError
from .kernel_compiler import KernelCompiler
from .workers import WorkerLostError, Workers

_log = logging.getLogger(__name__)
T = TypeVar("T")
SWITCH_INTERVAL = 0.0005
"""Seconds for which a computing thread keeps Python's lock while the event loop wants it; Python's own 5 ms
would be most of a drag's answer."""
NICENESS = 5
"""Of threads with slow work: where processors are short, the event loop goes first."""
_IN_THREADS = 2
"""Threads for slow work where there are no worker processes."""
_MOST_SEATS = 64
"""Jobs of this server that workers do at once, however many there are."""


@dataclass(frozen=True)
class Caller:
    """For whom the present task works; `disconnected` returns once an HTTP client has left."""

    client: Client = ("", 0)
    disconnected: Callable[[], Awaitable[None]] | None = None


NO_CALLER = Caller()
current_caller: ContextVar[Caller] = ContextVar("current_caller", default=NO_CALLER)
"""Set by the server for every request and socket."""


class _Pool:
    """Threads that take jobs from a fair queue, and do them or have workers do them."""

    def __init__(self, name: str, queue: FairQueue, seconds: float, *, nice: bool) -> None:
        self.queue, self.seconds, self._name, self._nice = queue, seconds, name, nice
        self.running = 0
        self.workers: Workers | None = None
        self.may_begin = threading.Event()  # not while it is unknown who shall do the work
        self.may_begin.set()
        self.threads: list[threading.Thread] = []

    def grow(self, threads: int) -> None:
        """Has at least so many threads from now on."""
        while len(self.threads) < threads:
            name = f"{self._name}-{len(self.threads)}"
            self.threads.append(threading.Thread(target=self._serve, name=name, daemon=True))
            self.threads[-1].start()

    def put(self, job: Job) -> None:
        """Lets a job wait for its turn.

        Raises:
            BusyError: too many wait already.
        """
        if self.workers is not None:  # a cluster may have grown
            self.grow(min(self.workers.size, _MOST_SEATS))
        self.queue.put(job)

    def _serve(self) -> None:
        if self._nice and sys.platform == "linux":  # where a thread has a niceness of its own
            with contextlib.suppress(OSError):
                os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICENESS)
        while (job := self.queue.take()) is not None:
            self.may_begin.wait()
            if job.future.set_running_or_notify_cancel():
                self.running += 1
                self._do(job)
                self.running -= 1
            del job  # nothing of it is kept until the next one comes

    def _do(self, job: Job) -> None:
        try:
            outcome = self._outcome(job)
        except BaseException as error:
            self._deliver(job.future.set_exception, error)
        else:
            self._deliver(job.future.set_result, outcome)

    def _outcome(self, job: Job) -> Any:
        workers = self.workers
        if workers is None or not is_portable(job.function):
            return run_job(job.function, job.args, job.cancelled.is_set, job.report, self.seconds)
        future = workers.submit_reporting(job.report, self.seconds, job.function, *job.args)
        job.call_off_by(future.cancel)
        try:
            return future.result()
        except concurrent.futures.CancelledError as error:
            raise CancelledError("cancelled") from error

    @staticmethod
    def _deliver(how: Callable[[Any], None], outcome: Any) -> None:
        with contextlib.suppress(InvalidStateError, RuntimeError):  # the event loop may be closed by now
            how(outcome)


def _nobody(part: Any) -> None:
    """Where no parts are wanted."""


class Compute:
    """Runs functions of the core: quick ones in threads, slow ones in worker processes.

    Interpreted kernels answer from the start. `start` loads the compiled ones in the background (see
    `kernel_compiler`), and lets the workers load theirs, with the derivation, so that no formula waits for it.

    Args:
        threads: for quick work.
        workers: processes for what takes seconds; None: it stays in threads, which yield to all others where
            processors are short.
        most_waiting, most_each: jobs that may wait in each of the two queues, in all and for one connection.
        seconds: after which slow work is given up.
    """

    def __init__(
        self,
        threads: int = 2,
        workers: Workers | None = None,
        *,
        most_waiting: int = 256,
        most_each: int = 8,
        seconds: float = 60.0,
    ) -> None:
        self._quick = _Pool("compute", FairQueue(most_waiting, most_each), seconds, nice=False)
        self._quick.grow(threads)
        self._slow = _Pool("slow", FairQueue(most_waiting, most_each), seconds, nice=True)
        self._slow.grow(_IN_THREADS if workers is None else min(workers.size, _MOST_SEATS))
        self._workers = workers
        self._kernels = KernelCompiler()
        self._compiled = self._closed = False
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
    def workers(self) -> Workers | None:
        """Who does slow work; None where threads of this process do."""
        return self._workers

    @property
    def died(self) -> int:
        """Workers that have ended while they had a job."""
        return 0 if self._workers is None else self._workers.died

    @property
    def waiting(self) -> dict[str, int]:
        """Jobs that wait, quick and slow."""
        return {"quick": len(self._quick.queue), "slow": len(self._slow.queue)}

    @property
    def running(self) -> dict[str, int]:
        """Jobs that are being done, quick and slow."""
        return {"quick": self._quick.running, "slow": self._slow.running}

    def start(self) -> None:
        """Begins to load the compiled kernels, and the workers, in the background.

        BLAS is kept to one thread: on matrices of six rows its own threads only wait for one
        another, which costs three times the processor time of the work itself.
        """
        threadpool_limits(limits=1, user_api="blas")
        sys.setswitchinterval(SWITCH_INTERVAL)
        if self._workers is not None:
            self._slow.may_begin.clear()
        self._warming = threading.Thread(target=self._warm_up, name="warming", daemon=True)
        self._warming.start()

    async def run(self, function: Callable[..., T], *args: object) -> T:
        """`function(*args)` in a thread.

        Raises:
            BusyError: too much waits already.
            OverdueError: it took too long.
        """
        return await self._run(self._quick, _nobody, function, args)

    async def run_slow(self, function: Callable[..., T], *args: object) -> T:
        """As `run`, for what takes seconds: in a worker process, so that no design waits for it.

        Function, arguments and outcome are pickled; where the function is none of a module's own, as a closure, it
        stays in a thread of this process. It is called off when the caller has left (`check_cancelled`), by force
        where it does not notice.

        Raises:
            WorkerLostError: the workers that had it have ended.
            TypeError: its arguments cannot be pickled.
        """
        return await self._run(self._slow, _nobody, function, args)

    async def stream(self, function: Callable[..., Any], *args: object) -> AsyncIterator[Any]:
        """As `run_slow`, in parts: what a generator function yields, or what a function `report`s and then returns.

        Where the caller is slower than the work older parts are left out, so each must stand alone; the last one
        always comes. Who leaves the loop calls the work off.
        """
        loop, parts, news = asyncio.get_running_loop(), deque[Any](maxlen=1), asyncio.Event()

        def put(part: Any) -> None:
            parts.append(part)
            news.set()

        def report_part(part: Any) -> None:
            with contextlib.suppress(RuntimeError):  # the event loop may be closed by now
                loop.call_soon_threadsafe(put, part)

        running = asyncio.ensure_future(self._run(self._slow, report_part, function, args))

        def ended(task: asyncio.Future[Any]) -> None:
            if not task.cancelled():
                task.exception()  # it is looked at, though nobody may be there any more
            news.set()

        running.add_done_callback(ended)
        try:
            while parts or not running.done():
                await news.wait()
                news.clear()
                while parts:
                    yield parts.popleft()
            if (last := await running) is not None:
                yield last
        finally:
            running.cancel()

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
        return await self._run(self._slow, _nobody, function, args)

    def _forget(self, key: object, task: asyncio.Task[Any]) -> None:
        if task.cancelled() or task.exception() is not None:
            self._once.pop(key, None)

    async def _run(
        self, pool: _Pool, report_part: Report, function: Callable[..., T], args: tuple[object, ...]
    ) -> T:
        caller = current_caller.get()
        job = Job(caller.client, function, args, report_part)
        pool.put(job)
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
                pool.queue.drop(job)
                job.call_off()
                outcome.cancel()
            if disconnect is not None:
                disconnect.cancel()

    def close(self) -> None:
        """Drops what waits and stops threads and workers."""
        self._closed = True
        self._kernels.close()
        self._slow.may_begin.set()
        for task in self._once.values():
            task.cancel()
        for pool in (self._quick, self._slow):
            for job in pool.queue.close():
                job.call_off()
                job.future.cancel()
        if self._workers is not None:
            self._workers.shutdown(wait=False, cancel_futures=True)

    def join(self) -> None:
        """Waits, after `close`, until no thread computes any more."""
        for thread in (*self._quick.threads, *self._slow.threads, self._warming):
            if thread is not None:
                thread.join()
        if self._workers is not None:
            self._workers.shutdown(wait=True, cancel_futures=True)

    def _warm_up(self) -> None:
        # A job of the first second waits until it is known whether the kernels are there: workers then do it sooner
        # than threads with interpreted ones, which would hold up this process, too. While they are compiled, which
        # takes minutes, threads do it.
        self._kernels.run(self._start_workers, self._slow.may_begin.set)
        self._start_workers()  # with interpreted kernels, where it has failed
        if self._workers is None:
            began = perf_counter()
            warm_up(STRUCTURES)
            _log.info("derivation ready after %.2f s", perf_counter() - began)
        if engine().compiled:
            # What lives as long as the process is not looked through again: a full collection would
            # stop every client for an eighth of a second.
            gc.collect()
            gc.freeze()
            self._compiled = True

    def _start_workers(self) -> None:
        """From now on they have the slow work; until then, while kernels are compiled, threads do it."""
        if self._workers is not None and self._slow.workers is None and not self._closed:
            try:
                self._workers.start()
            except OSError as error:
                if not self._closed:  # meanwhile
                    _log.warning("slow work stays in threads: no worker can be started: %s", error)
            else:
                self._slow.workers = self._workers
        self._slow.may_begin.set()


__all__ = [
    "BusyError",
    "Caller",
    "Compute",
    "OverdueError",
    "WorkerLostError",
    "check_cancelled",
    "current_caller",
    "report",
    "seconds_left",
]
