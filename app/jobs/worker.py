"""What a worker does from its fork on: one job after the other, as the serving process sends them."""

from __future__ import annotations

import contextlib
import os
import threading
from multiprocessing.connection import Connection
from pathlib import Path
from queue import SimpleQueue
from typing import Any

from .current import portable, run_job
from .packed import packed, unpacked

JOB, CANCEL = "job", "cancel"
PART, DONE, FAILED = "part", "done", "failed"
FREE, LEAVING = "free", "leaving"
"""Told after each job: whether the worker takes another one."""
_NICENESS = 10
"""Beyond the fork server's: where processors are short, slow work has what the designs under a hand leave."""
_OOM_SCORE, _KILLED_FIRST = Path("/proc/self/oom_score_adj"), "500"
"""Where the machine's memory is short, the system ends a worker and not the server; it is forked anew."""
_GROWN = 128 * 2**20
"""Bytes by which a worker may have grown after a job; one that keeps more ends, since another one is a fork away."""


class _Worker:
    """One job at a time, while a thread listens for who calls it off."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._jobs: SimpleQueue[tuple[Any, ...]] = SimpleQueue()
        self._called_off = -1
        self._first_size = _resident()

    def serve(self) -> None:
        threading.Thread(target=self._listen, name="listening", daemon=True).start()
        while True:
            self._do(*self._jobs.get())
            leaving = _resident() - self._first_size > _GROWN
            self._tell(packed((LEAVING if leaving else FREE, None)))
            if leaving:
                os._exit(0)

    def _listen(self) -> None:
        """Ends the process once the serving one has gone, whatever is being computed."""
        try:
            while True:
                kind, number, *job = unpacked(self._connection.recv_bytes())
                if kind == JOB:
                    self._jobs.put((number, *job))
                else:
                    self._called_off = number
        except (EOFError, OSError):
            os._exit(0)

    def _do(self, number: int, job: bytes, seconds: float) -> None:
        def report(part: Any) -> None:
            self._tell(packed((PART, part)))

        try:
            function, args = unpacked(job)
            outcome = run_job(function, args, lambda: self._called_off == number, report, seconds)
            answer = packed((DONE, outcome))
        except BaseException as error:
            answer = packed((FAILED, portable(error)))
        self._tell(answer)

    def _tell(self, message: bytes) -> None:
        self._connection.send_bytes(message)


def serve(connection: Connection, memory: int) -> None:
    """Does what comes over the connection, until that closes; never returns.

    Args:
        connection: to the serving process.
        memory: bytes that may be had beyond what there is now; a job that wants more gets a `MemoryError`.
    """
    with contextlib.suppress(OSError):
        os.nice(_NICENESS)
    with contextlib.suppress(OSError):  # Linux alone has it
        _OOM_SCORE.write_text(_KILLED_FIRST)
    _bound(memory)
    _Worker(connection).serve()


def _bound(memory: int) -> None:
    """Limits what is allocated, as far as the system can."""
    import resource

    with contextlib.suppress(OSError, ValueError):
        most = _pages(5) + memory
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))


def _resident() -> int:
    """Bytes in memory that are no file's."""
    return _pages(1) - _pages(2)


def _pages(nth: int) -> int:
    """Bytes, of which Linux counts the pages in this field of a process' `statm`; 0 elsewhere."""
    try:
        fields = Path("/proc/self/statm").read_text().split()
    except OSError:
        return 0
    return int(fields[nth]) * os.sysconf("SC_PAGE_SIZE")
