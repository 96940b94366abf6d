"""A Dask scheduler and its workers on loopback, as processes of their own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.children import ROOT, environment
from tests.patience import until

LIMITS = {
    "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "3",
    "DASK_DISTRIBUTED__COMM__TIMEOUTS__TCP": "120s",  # of a machine that is busy, not of a worker that is lost
}


class Cluster:
    """A scheduler and workers of one thread each."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.processes: list[subprocess.Popen[bytes]] = []
        self.workers: list[subprocess.Popen[bytes]] = []
        self.address = ""
        self.begin_scheduler()

    def begin_scheduler(self) -> None:
        """At a free port, or again at the same one."""
        about = self.folder / f"scheduler-{len(self.processes)}.json"
        port = self.address.rpartition(":")[2] or "0"
        self._scheduler = self._begin(
            "scheduler", "--port", port, "--no-show", "--scheduler-file", str(about)
        )
        until(lambda: about.exists() and about.read_text().strip(), "the scheduler tells its address")
        self.address = str(json.loads(about.read_text())["address"])

    def end_scheduler(self) -> None:
        """Kills it."""
        self._scheduler.kill()
        self._scheduler.wait()

    def add(self) -> subprocess.Popen[bytes]:
        """Another worker, which nobody begins again when it dies."""
        room = self.folder / f"worker-{len(self.workers)}"
        words = ("--nthreads", "1", "--no-nanny", "--preload", "app.jobs.dask_remote")
        self.workers.append(self._begin("worker", self.address, *words, "--local-directory", str(room)))
        return self.workers[-1]

    def _begin(self, kind: str, *words: str) -> subprocess.Popen[bytes]:
        log = (self.folder / f"{kind}-{len(self.processes)}.log").open("wb")
        command = [sys.executable, "-m", f"distributed.cli.dask_{kind}", *words]
        place = ("--host", "127.0.0.1", "--no-dashboard")
        with log:
            self.processes.append(
                subprocess.Popen(
                    [*command, *place],
                    cwd=self.folder,
                    env=environment(PYTHONPATH=str(ROOT), **LIMITS),
                    stdout=log,
                    stderr=log,
                )
            )
        return self.processes[-1]


@contextmanager
def cluster(folder: Path, workers: int = 2) -> Iterator[Cluster]:
    """Ends all of them at last."""
    found = Cluster(folder)
    try:
        for _ in range(workers):
            found.add()
        yield found
    finally:
        for process in found.processes:
            if process.poll() is None:
                os.kill(process.pid, signal.SIGKILL)
            process.wait()
