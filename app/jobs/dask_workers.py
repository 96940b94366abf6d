"""A Dask cluster in the place of worker processes (`HELI2DOF_DASK`)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from functools import partial
from itertools import count
from typing import Any
from uuid import uuid4

from distributed import Client, KilledWorker, Queue
from distributed import Future as DaskFuture
from distributed.protocol.serialize import deserialize_bytes

from heli2dof_core.version import package_version

from .current import Report
from .dask_remote import Asked, do
from .workers import UNLIMITED, WorkerLostError, Workers

_log = logging.getLogger(__name__)
_ANSWERED = 10.0
"""Seconds in which a scheduler has to answer."""
_WAITS = 20.0
"""Seconds for which a job waits for one."""
_LOOKED_EVERY = 1.0
"""Seconds between two looks how many workers there are."""
_MOST_PARTS = 64
"""Parts that wait at the scheduler; who tells more waits."""
_PARTS_LATE = 10.0
"""Seconds for which an outcome waits for parts that were told before it."""


def _nobody(part: Any) -> None:
    """Where no parts are wanted."""


class _Job(Future[Any]):
    """A future whose `cancel` calls off what runs, too."""

    def __init__(self, report: Report) -> None:
        super().__init__()
        self.report = report
        self.heard = 0
        self.remote: DaskFuture | None = None

    def cancel(self) -> bool:
        if self.done():
            return False
        _end(self, CancelledError())  # the task is told by Dask, and nobody waits until it has listened
        if self.remote is not None:
            self.remote.cancel()
        return True


class DaskWorkers(Workers):
    """The workers of a cluster, as many as it has at the moment.

    A job whose worker is lost is begun again by Dask itself, up to its `allowed-failures`. A job that runs is called
    off by `check_cancelled` alone: a cluster's process is others', too, and is not killed for it.

    Args:
        address: of the scheduler, as ``tcp://host:8786``.
        priority: of jobs against those of other clients: the higher first.
    """

    lost: tuple[type[BaseException], ...] = (WorkerLostError, CancelledError)

    def __init__(self, address: str, priority: int = 0) -> None:
        self.address, self._priority = address, priority
        self._changed = threading.Condition()
        self._client: Client | None = None
        self._size = 1
        self._closed = threading.Event()
        self._running: dict[int, _Job] = {}
        self._numbers = count()
        self._parts = f"heli2dof-{uuid4().hex}"
        self._thread: threading.Thread | None = None

    @property
    def size(self) -> int:
        """Threads of all workers, one at least: jobs may wait for the first worker."""
        return self._size

    def start(self) -> None:
        """Connects, in the background."""
        with self._changed:
            if self._thread is None and not self._closed.is_set():
                self._thread = threading.Thread(target=self._keep, name="cluster", daemon=True)
                self._thread.start()

    def connected(self, seconds: float = _WAITS) -> Client:
        """The client, once the scheduler has answered.

        Raises:
            WorkerLostError: it does not.
        """
        self.start()
        with self._changed:
            self._changed.wait_for(lambda: self._client is not None or self._closed.is_set(), seconds)
            if self._client is None:
                raise WorkerLostError(f"The cluster at {self.address} does not answer.")
            return self._client

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """See `Executor`."""
        return self.submit_reporting(_nobody, UNLIMITED, partial(fn, **kwargs) if kwargs else fn, *args)

    def submit_reporting(
        self, report: Report, seconds: float, fn: Callable[..., Any], /, *args: Any
    ) -> Future[Any]:
        """See `Workers`."""
        if self._closed.is_set():
            raise RuntimeError("the workers take no new jobs: they are shut down")
        job, number = _Job(report), next(self._numbers)
        job.set_running_or_notify_cancel()
        with self._changed:
            self._running[number] = job
        try:
            asked = Asked(number, self._parts, seconds, package_version())
            # not pure: equal calls would run once, and a job called off would take its twins along
            job.remote = self.connected().submit(do, fn, args, asked, pure=False, priority=self._priority)
        except WorkerLostError as error:
            self._forget(number, error)
        except TypeError as error:
            self._forget(number, CancelledError())
            name = getattr(fn, "__qualname__", fn)
            raise TypeError(f"{name} and its arguments cannot be sent to a worker: {error}") from error
        except Exception as error:  # the connection was closed at this moment
            self._forget(number, WorkerLostError(f"The cluster at {self.address} is lost: {error}"))
        else:
            if job.done():  # called off meanwhile
                job.remote.cancel()
            job.remote.add_done_callback(partial(self._done, number))
        return job

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Takes no new jobs; calls off those that run, where futures are cancelled, or waits for them."""
        with self._changed:
            running = [*self._running.values()]
        if cancel_futures:
            for job in running:
                job.cancel()
        elif wait:
            for job in running:
                job.exception()
        self._closed.set()
        with self._changed:
            self._changed.notify_all()
        if wait and self._thread is not None:
            self._thread.join()

    def _keep(self) -> None:
        """Connects, looks at the workers' number, and connects again where the scheduler was lost."""
        told = False
        while not self._closed.is_set():
            try:
                client = Client(self.address, timeout=_ANSWERED, set_as_default=False, name="heli2dof")
            except (OSError, TimeoutError) as error:
                if not told:
                    _log.warning("the cluster at %s does not answer: %s", self.address, error)
                    told = True
                self._closed.wait(_LOOKED_EVERY)
                continue
            told = False
            with self._changed:
                self._client = client
                self._changed.notify_all()
            listening = threading.Thread(target=self._listen, args=(client,), name="parts", daemon=True)
            listening.start()
            self._look(client)
            with self._changed:
                self._client = None
                lost = [] if self._closed.is_set() else [*self._running]
            for number in lost:
                self._forget(number, WorkerLostError(f"The cluster at {self.address} is lost."))
            client.close(timeout=2)
            listening.join()

    def _look(self, client: Client) -> None:
        """Counts threads, until the scheduler is lost or nobody wants it any more."""
        while not self._closed.wait(0):
            try:
                threads: Any = client.nthreads()
                self._size = max(1, sum(threads.values()))
            except (OSError, TimeoutError, RuntimeError, ValueError):
                if client.status != "running":
                    return
            if client.status in ("closed", "closing"):
                return
            self._closed.wait(_LOOKED_EVERY)

    def _listen(self, client: Client) -> None:
        """Takes parts to those who want them."""
        try:
            queue = Queue(self._parts, client=client, maxsize=_MOST_PARTS)
            while client.status == "running" and not self._closed.is_set():
                try:
                    part: Any = queue.get(timeout=_LOOKED_EVERY)
                except TimeoutError:
                    continue
                self._hear(*part)
        except Exception:  # of a connection that is closed meanwhile: what is told then is told again or lost
            _log.debug("the queue of parts is closed", exc_info=True)

    def _hear(self, number: int, packed: bytes) -> None:
        with self._changed:
            job = self._running.get(number)
        if job is None:
            return
        try:
            job.report(deserialize_bytes(packed))
        except Exception:
            _log.exception("a part was told to nobody")
        with self._changed:
            job.heard += 1
            self._changed.notify_all()

    def _done(self, number: int, remote: DaskFuture) -> None:
        """What has come of a job; called in a thread of Dask's client."""
        with self._changed:
            job = self._running.get(number)
        if job is None or job.done():
            self._forget(number, CancelledError())
            return
        try:
            succeeded, outcome, told = remote.result()
        except KilledWorker as error:
            self._forget(number, WorkerLostError(f"The work was lost with its workers: {error}"))
        except (
            BaseException
        ) as error:  # cancelled by a scheduler that was restarted, or closed with the client
            self._forget(number, WorkerLostError(f"The work was lost: {error}"))
        else:
            with self._changed:
                self._changed.wait_for(lambda: job.heard >= told, _PARTS_LATE)
            self._forget(number, outcome, succeeded=succeeded)

    def _forget(self, number: int, outcome: Any, *, succeeded: bool = False) -> None:
        with self._changed:
            job = self._running.pop(number, None)
        if job is not None:
            _end(job, outcome, succeeded=succeeded)


def _end(job: _Job, outcome: Any, *, succeeded: bool = False) -> None:
    """Sets what has come of a job, unless it was called off at this moment."""
    try:
        (job.set_result if succeeded else job.set_exception)(outcome)
    except Exception:  # InvalidStateError: the other one was first
        _log.debug("a job had ended already")
