"""What waits for threads and workers: bounded, and in turn, so that nobody takes more than a share."""

from __future__ import annotations

import threading
from collections import Counter, OrderedDict, deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Any

Client = tuple[str, int]
"""Who asks: an address, and which request or socket from it."""


class BusyError(Exception):
    """There is no room for more work; the message says whose fault it is, `retry_after` when to ask again (s)."""

    def __init__(self, message: str, retry_after: int) -> None:
        super().__init__(message)
        self.retry_after = retry_after


class OverdueError(Exception):
    """The work was given up: it took too long."""


@dataclass(eq=False)
class Job:
    """A piece of work: `future` becomes its outcome, and once `cancelled` is set nobody wants it any more."""

    client: Client
    function: Any
    args: tuple[Any, ...] = ()
    report: Callable[[Any], None] = lambda _part: None
    future: Future[Any] = field(default_factory=Future)
    cancelled: threading.Event = field(default_factory=threading.Event)
    _call_off: Callable[[], object] | None = None

    def call_off(self) -> None:
        """Nobody wants it any more: whoever does it is told, now or when it begins."""
        self.cancelled.set()
        if self._call_off is not None:
            self._call_off()

    def call_off_by(self, call_off: Callable[[], object]) -> None:
        """Sets how whoever does it now is told."""
        self._call_off = call_off
        if self.cancelled.is_set():
            call_off()


class FairQueue:
    """Jobs by address, and within it by connection; each in turn gives one, whoever has how many waiting.

    Args:
        most: jobs that may wait in all.
        most_each: jobs that may wait for one connection.
    """

    def __init__(self, most: int, most_each: int) -> None:
        self._most, self._most_each = most, most_each
        self._addresses: OrderedDict[str, OrderedDict[int, deque[Job]]] = OrderedDict()
        self._count: Counter[Client] = Counter()
        self._changed = threading.Condition()
        self._closed = False

    def __len__(self) -> int:
        return self._count.total()

    def put(self, job: Job) -> None:
        """Lets a job wait.

        Raises:
            BusyError: too many wait already.
        """
        address, connection = job.client
        with self._changed:
            if len(self) >= self._most:
                raise BusyError("The server is busy: too many slow requests are waiting.", 5)
            if self._count[job.client] >= self._most_each:
                raise BusyError(f"{self._most_each} of your requests are waiting already.", 2)
            self._count[job.client] += 1
            own = self._addresses.setdefault(address, OrderedDict())
            own.setdefault(connection, deque()).append(job)
            self._changed.notify()

    def take(self) -> Job | None:
        """The next job, waited for; None once the queue is closed."""
        with self._changed:
            while not self._addresses and not self._closed:
                self._changed.wait()
            if self._closed:
                return None
            address, own = self._addresses.popitem(last=False)
            connection, jobs = own.popitem(last=False)
            job = jobs.popleft()
            # Whoever has been served stands behind all others, at both levels.
            if jobs:
                own[connection] = jobs
            if own:
                self._addresses[address] = own
            self._forget(job)
            return job

    def drop(self, job: Job) -> None:
        """Takes a job out if it still waits."""
        address, connection = job.client
        with self._changed:
            own = self._addresses.get(address, OrderedDict())
            jobs = own.get(connection, deque())
            if job in jobs:
                jobs.remove(job)
                self._forget(job)
                if not jobs:
                    del own[connection]
                if not own:
                    del self._addresses[address]

    def close(self) -> list[Job]:
        """Lets nobody wait any longer; returns the jobs that did."""
        with self._changed:
            self._closed = True
            left = [job for own in self._addresses.values() for jobs in own.values() for job in jobs]
            self._addresses.clear()
            self._count.clear()
            self._changed.notify_all()
        return left

    def _forget(self, job: Job) -> None:
        self._count[job.client] -= 1
        if not self._count[job.client]:
            del self._count[job.client]
