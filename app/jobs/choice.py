"""Who does slow work: processes of this machine, a cluster, or threads of the serving process."""

from __future__ import annotations

from collections.abc import Sequence

from .workers import Workers


def workers_of(count: int, memory: int, dask: str, modules: Sequence[str]) -> Workers | None:
    """What the settings ask for, as far as this system can; None: threads.

    Args:
        count: of processes.
        memory: bytes that a job may have beyond what all workers share.
        dask: address of a scheduler; empty: none.
        modules: that hold the jobs' functions, to be imported beforehand.
    """
    if dask:
        from .dask_workers import DaskWorkers

        return DaskWorkers(dask, priority=1)  # before studies, which take hours
    from .fork_server import CAN_FORK

    if count == 0 or not CAN_FORK:
        return None
    from .processes import WorkerProcesses

    return WorkerProcesses(count, memory, modules)
