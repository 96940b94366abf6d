"""What a Dask worker does with a job; `dask worker --preload` of this module loads the kernels beforehand."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import Any, NamedTuple

from distributed import Queue, get_worker
from distributed.protocol.serialize import serialize_bytes
from threadpoolctl import threadpool_limits

from heli2dof_core.engine import warm_up
from heli2dof_core.version import package_version

from .current import portable, run_job

ASKED_EVERY = 0.05
"""Seconds between two looks whether the job is still wanted."""
PATIENCE = 60.0
"""Seconds for which a part waits to be taken; who takes none for so long has gone."""


class VersionError(RuntimeError):
    """A worker has another version than the process that gives it jobs: its numbers might be others."""


def dask_setup(worker: Any) -> None:
    """Loads the kernels before the worker takes jobs; the first time on a machine they are compiled.

    Args:
        worker: Dask's, which calls this.
    """
    threadpool_limits(limits=1, user_api="blas")
    warm_up()


class Asked(NamedTuple):
    """What is asked of a worker beside the job itself.

    Attributes:
        number: of the job, in its parts.
        parts: name of the queue into which these go.
        seconds: after which the job gives up.
        version: that the other side has.
    """

    number: int
    parts: str
    seconds: float
    version: str


def do(function: Callable[..., Any], args: tuple[Any, ...], asked: Asked) -> tuple[bool, Any, int]:
    """Does a job in this worker.

    Args:
        function: what to call.
        args: what with.
        asked: see there.

    Returns:
        Whether it has succeeded, what has come of it, and how many parts it has told.
    """
    told = 0
    queue: Queue | None = None

    def report(part: Any) -> None:
        nonlocal told, queue
        queue = queue or Queue(asked.parts)
        queue.put((asked.number, serialize_bytes(part)), timeout=PATIENCE)
        told += 1

    try:
        own = package_version()
        if own != asked.version:
            raise VersionError(
                f"A worker has heli2dof {own}, and {asked.version} gives it jobs: install the same there."
            )
        warm_up()
        return True, run_job(function, args, _Unwanted(), report, asked.seconds), told
    except BaseException as error:
        return False, portable(error), told


class _Unwanted:
    """Whether the scheduler has cancelled this task: its client has called it off, or has gone.

    Dask lets a task that runs go on and drops its outcome; only the worker's own state says so.
    """

    def __init__(self) -> None:
        self._worker = get_worker()
        self._key = self._worker.get_current_task()
        self._next, self._known = 0.0, False

    def __call__(self) -> bool:
        now = monotonic()
        if not self._known and now >= self._next:
            self._next = now + ASKED_EVERY
            task = self._worker.state.tasks.get(self._key)
            self._known = task is None or task.state == "cancelled"
        return self._known
