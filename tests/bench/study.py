"""A study of a million rigs: on one process, and on a cluster of which a worker is killed; what a second one gains.

python -m tests.bench.study [--rigs 1000000] [--scaling 200000]

A real Dask scheduler and its workers run on loopback. Digits are compared by the digest of all rows. What a second
worker gains is told twice: by the clock, which says little where others use the processors, and as processor time:
that of one worker alone by that of the busier one of two.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import Any

from app.jobs.dask_workers import DaskWorkers
from heli2dof_core.engine import warm_up
from heli2dof_core.study import Alone, Folder, Progress, Workers, read_study, run, summarize
from tests.bench.faculty import processor
from tests.clusters import Cluster, cluster
from tests.patience import PATIENCE, until

TEXT = """
study = 1
measures = [{{ measure = "settling_time", steps = "together" }}, {{ measure = "V_peak", steps = "together" }}]
[design]
scenario.duration = 5.0
[rigs]
count = {rigs}
"""


def computed(
    path: Path, workers: Workers, rigs: int, tell: Callable[[Progress], None]
) -> tuple[str, float, Progress]:
    """The digest, seconds and the last progress."""
    folder = Folder(path, read_study(TEXT.format(rigs=rigs)))
    began = perf_counter()
    last = run(folder, workers, tell)
    return summarize(folder).digest, perf_counter() - began, last


def on_cluster(
    room: Path, count: int, rigs: int, at_half: Callable[[Cluster], None] = lambda _: None
) -> tuple[str, float, Progress, list[float]]:
    """The same on so many workers, and the processor time of each."""
    room.mkdir()
    with cluster(room, count) as running:
        workers = DaskWorkers(running.address)
        client: Any = workers.connected(PATIENCE)
        client.wait_for_workers(count, timeout=PATIENCE)
        until(lambda: workers.size == count, "all workers are counted")
        before, done = [processor(worker.pid) for worker in running.workers], []

        def tell(progress: Progress) -> None:
            if not done and 2 * progress.pairs >= progress.of:
                done.append(True)
                at_half(running)

        digest, seconds, last = computed(room / "study", workers, rigs, tell)
        alive = [worker for worker in running.workers if worker.poll() is None]
        used = [processor(worker.pid) for worker in alive]
        workers.shutdown(cancel_futures=True)
    return digest, seconds, last, [b - a for a, b in zip(before, used, strict=False)]


def main() -> None:
    """Prints a line for each run."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rigs", type=int, default=1_000_000)
    parser.add_argument("--scaling", type=int, default=200_000)
    given = parser.parse_args()
    warm_up()
    with tempfile.TemporaryDirectory() as folder:
        room = Path(folder)
        if given.scaling:
            times = {}
            for count in (1, 2):
                _, seconds, _, used = on_cluster(room / f"workers-{count}", count, given.scaling)
                times[count] = seconds, max(used)
                each = ", ".join(f"{one:.1f}" for one in used)
                print(
                    f"{given.scaling:,} rigs, {count} workers: {seconds:.1f} s; processor time {each} s",
                    flush=True,
                )
            gains = [one / two for one, two in zip(times[1], times[2], strict=True)]
            print(
                f"a second worker: {gains[0]:.2f} times as fast by the clock, {gains[1]:.2f} in processor time"
            )
        if given.rigs:
            digest, seconds, _ = computed(room / "alone", Alone(), given.rigs, lambda _: None)
            print(f"{given.rigs:,} rigs, one process: {seconds:.1f} s; {digest}", flush=True)
            there, seconds, last, _ = on_cluster(
                room / "killed", 2, given.rigs, lambda running: running.workers[0].kill()
            )
            print(f"{given.rigs:,} rigs, two workers, one killed halfway: {seconds:.1f} s; {there}")
            print(
                f"pairs {last.pairs:,} of {last.of:,}; digits {'equal' if there == digest else 'DIFFERENT'}"
            )
            raise SystemExit(there != digest)


if __name__ == "__main__":
    main()
