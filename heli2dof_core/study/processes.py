"""Worker processes on this machine for a study."""

from __future__ import annotations

import os
import signal
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context, parent_process
from threading import Thread

from threadpoolctl import threadpool_limits

from .running import Pool


def processes(count: int) -> Pool:
    """So many processes, each with kernels of its own, loaded when its first part comes."""

    def make() -> ProcessPoolExecutor:
        # spawned: a process that has begun threads, as a progress bar does, is not safely forked
        return ProcessPoolExecutor(count, get_context("spawn"), _begin)

    return Pool(make, count)


def usable_cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _begin() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that has the folder
    threadpool_limits(limits=1, user_api="blas")
    Thread(target=_end_with_parent, name="parent", daemon=True).start()


def _end_with_parent() -> None:
    """Ends this process when the one that has begun it dies, which its queue alone would not tell."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
