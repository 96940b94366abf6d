"""Workers as processes of this machine, behind the standard `Executor`."""

from __future__ import annotations

import contextlib
import logging
import math
import os
import signal
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError, Future
from functools import partial
from multiprocessing.connection import Connection
from queue import SimpleQueue
from time import monotonic
from typing import Any

from heli2dof_core import errors

from .current import JobError, Report
from .fork_server import ForkServer
from .packed import PackingError, packed, unpacked
from .worker import CANCEL, DONE, FAILED, JOB, LEAVING, PART
from .workers import UNLIMITED, WorkerLostError, Workers

_log = logging.getLogger(__name__)
GRACE = 1.0
"""Seconds that a job has to notice that it is called off, or that its time is over; then its process is killed."""
_LOOKED_EVERY = 0.25
"""Seconds between two looks at whether that time is over."""
_TRIES = 2


def _nobody(part: Any) -> None:
    """Where no parts are wanted."""


class _Job(Future[Any]):
    """A future whose `cancel` calls off what runs, too."""

    def __init__(self, content: bytes, report: Report, seconds: float) -> None:
        super().__init__()
        self.content, self.report, self.seconds = content, report, seconds
        self.called_off_at: float | None = None
        self._tell: Callable[[], None] | None = None

    def cancel(self) -> bool:
        if super().cancel():
            return True
        if self.done():
            return False
        if self.called_off_at is None:
            self.called_off_at = monotonic()
            if self._tell is not None:
                self._tell()
        return True

    def told_by(self, tell: Callable[[], None] | None) -> None:
        """Sets how the worker that has the job now is told; whatever happens first, it is told."""
        self._tell = tell
        if tell is not None and self.called_off_at is not None:
            tell()


class WorkerProcesses(Workers):
    """Some processes, forked when the first jobs come; each does one job at a time.

    Args:
        count: of processes.
        memory: bytes that each may have beyond what all share; a job that wants more gets a `MemoryError`.
        modules: that are imported once for all of them.

    Raises:
        TypeError: by `submit`, where function or arguments cannot be pickled.
    """

    def __init__(self, count: int, memory: int = 2**30, modules: Sequence[str] = ()) -> None:
        self._fork_server = ForkServer(memory, modules)
        self._jobs: SimpleQueue[_Job | None] = SimpleQueue()
        self._closed = False
        self._seats = [_Seat(self._fork_server, self._jobs, f"worker-{i}") for i in range(count)]

    @property
    def size(self) -> int:
        """Processes."""
        return len(self._seats)

    @property
    def processes(self) -> list[int]:
        """Numbers of the processes that run."""
        return [pid for seat in self._seats if (pid := seat.pid) is not None]

    @property
    def died(self) -> int:
        """Workers that have ended by themselves while they had a job."""
        return sum(seat.died for seat in self._seats)

    def start(self) -> None:
        """Lets the fork server load, in the background."""
        self._fork_server.start()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """See `Executor`."""
        return self.submit_reporting(_nobody, UNLIMITED, partial(fn, **kwargs) if kwargs else fn, *args)

    def submit_reporting(
        self, report: Report, seconds: float, fn: Callable[..., Any], /, *args: Any
    ) -> Future[Any]:
        """See `Workers`."""
        if self._closed:
            raise RuntimeError("the workers take no new jobs: they are shut down")
        try:
            content = packed((fn, args))
        except PackingError as error:
            name = getattr(fn, "__qualname__", fn)
            raise TypeError(f"{name} and its arguments cannot be sent to a worker: {error}") from error
        job = _Job(content, report, seconds)
        self._jobs.put(job)
        return job

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Takes no new jobs; ends the processes once all are done, or at once where futures are cancelled."""
        if not self._closed:
            self._closed = True
            for _ in self._seats:
                self._jobs.put(None)
        if cancel_futures:
            self._fork_server.close()
            for seat in self._seats:
                seat.close()
        if wait:
            for seat in self._seats:
                seat.thread.join()
            self._fork_server.close()


class _Seat:
    """A thread that has a worker process, or none yet, and waits for what it tells."""

    def __init__(self, fork_server: ForkServer, jobs: SimpleQueue[_Job | None], name: str) -> None:
        self._fork_server, self._jobs = fork_server, jobs
        self._connection: Connection | None = None
        self._sending = threading.Lock()
        self._number = 0
        self._closed = False
        self.pid: int | None = None
        self.died = 0
        self.thread = threading.Thread(target=self._serve, name=name, daemon=True)
        self.thread.start()

    def close(self) -> None:
        """Ends what runs here, and does nothing more."""
        self._closed = True
        self._kill()

    def _serve(self) -> None:
        while (job := self._jobs.get()) is not None:
            if self._closed:
                job.cancel()
            elif job.set_running_or_notify_cancel():
                self._do(job)
            del job  # nothing of it is kept until the next one comes
        self._drop()

    def _do(self, job: _Job) -> None:
        for _ in range(_TRIES):
            try:
                self._try(job)
                return
            except (OSError, EOFError) as error:
                status = self._drop()
                if self._closed or job.called_off_at is not None:
                    job.set_exception(CancelledError())
                    return
                self.died += 1
                told = error if status is None else f"status {status}"
                _log.warning("a worker has ended (%s); its job is begun again", told)
        job.set_exception(WorkerLostError())

    def _try(self, job: _Job) -> None:
        """Has the job done.

        Raises:
            OSError, EOFError: the worker has ended.
        """
        connection = self._worker()
        self._number = number = self._number + 1
        self._send(JOB, number, job.content, job.seconds)
        job.told_by(lambda: self._call_off(number))
        try:
            deliver = self._awaited(job, connection, monotonic() + job.seconds + GRACE)
        finally:
            job.told_by(None)
        deliver()
        try:
            if self._connection is not None and unpacked(connection.recv_bytes())[0] == LEAVING:
                self._drop()
        except (OSError, EOFError):  # it has ended, but no job with it
            self._drop()

    def _worker(self) -> Connection:
        """The connection to a worker that has nothing to do."""
        if (
            self._connection is not None and self._connection.poll()
        ):  # it has ended: nothing else is told unasked
            self._drop()
        if self._connection is None:
            self._connection, self.pid = self._fork_server.fork()
            if self._closed:  # while it was forked
                self._kill()
        return self._connection

    def _awaited(self, job: _Job, connection: Connection, until: float) -> Callable[[], None]:
        """What to do with the job's future, once the worker has told it, or has been killed for telling nothing."""
        while self._heard(job, connection, until):
            try:
                kind, value = unpacked(connection.recv_bytes())
            except (EOFError, OSError):
                raise
            except Exception as error:  # an outcome that can be pickled, but not be read
                kind, value = FAILED, JobError(f"the outcome cannot be read: {error}")
            if job.called_off_at is not None:
                if kind != PART:
                    return lambda: job.set_exception(CancelledError())
            elif kind == PART:
                job.report(value)
            else:
                end = job.set_result if kind == DONE else job.set_exception
                return lambda: end(value)
        self._drop()
        late = errors.CancelledError("cancelled") if job.called_off_at is None else CancelledError()
        return lambda: job.set_exception(late)

    @staticmethod
    def _heard(job: _Job, connection: Connection, until: float) -> bool:
        """Waits until the worker tells something; False where the time for it is over."""
        while not connection.poll(_LOOKED_EVERY):
            called_off = job.called_off_at
            if monotonic() > min(until, math.inf if called_off is None else called_off + GRACE):
                return False
        return True

    def _send(self, *message: Any) -> None:
        with self._sending:
            if self._connection is not None:
                self._connection.send_bytes(packed(message))

    def _call_off(self, number: int) -> None:
        with contextlib.suppress(OSError):  # it has ended
            self._send(CANCEL, number)

    def _kill(self) -> None:
        pid = self.pid
        if pid is not None:  # a zombie at most until `_drop` has reaped it, so the number is no other's
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)

    def _drop(self) -> int | None:
        """Ends the worker, if there is one; returns its status where that is known."""
        if self._connection is None:
            return None
        self._kill()
        pid, self.pid = self.pid, None
        with self._sending:
            self._connection.close()
            self._connection = None
        return None if pid is None or self._closed else self._fork_server.reap(pid)
