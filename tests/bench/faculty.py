"""A faculty's drags: clients at twenty updates a second on one process, behind nginx, and on two behind nginx.

Each client does as the page does: one request in flight, the next at its tick or when the answer is there. They run
in a process of their own, which takes its share of the machine's cores; where other work runs beside, the processor
time of an update is what holds. Prints a row for each number of clients:

    python -m tests.bench.faculty [seconds each] [clients …]
"""

from __future__ import annotations

import asyncio
import json
import multiprocessing
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

import numpy as np
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from app.contract.encoding import BINARY_SUBPROTOCOL
from tests.bench.round_trip import kernels_ready
from tests.deploy.farm import Farm, farm

SECONDS, CLIENTS, RATE, WARM = 10.0, (20, 40, 80, 160), 20.0, 2.0
SCENARIO = {"reference": {"theta": 0.2, "psi": 0.5}, "duration": 5, "samples": 501, "rtol": 1e-5}
NAMES = (f"student-{k}".ljust(24, "_") for k in range(1_000_000))


@dataclass
class Load:
    """What the clients saw: seconds of each update, and how often something went wrong."""

    took: list[float] = field(default_factory=list)
    asked: int = 0
    errors: int = 0


def request(seq: int) -> str:
    poles = [-12.0, -10.0, -9.0 + (seq % 40) / 20, -8.5]
    body = {"preset": "quanser-2dof-manual", "poles": poles, "scenario": SCENARIO, "each_axis": True}
    return json.dumps({"seq": seq, **body})


REQUESTS = [request(seq) for seq in range(400)]
MARKS = [b'"seq":%d,' % seq for seq in range(400)]


async def client(url: str, start: float, end: float, phase: float, load: Load) -> None:
    """One tab's drag; what is measured begins after the warming up."""
    try:
        async with connect(
            url,
            subprotocols=[Subprotocol(BINARY_SUBPROTOCOL)],
            compression=None,
            max_size=None,
            open_timeout=30,
            proxy=None,
        ) as peer:
            tick = start + phase
            for seq in range(10**9):
                await asyncio.sleep(max(0.0, tick - perf_counter()))
                asked = perf_counter()
                if asked > end:
                    return
                tick = max(tick + 1 / RATE, asked)
                load.asked += 1
                await peer.send(REQUESTS[seq % 400])
                frame = await peer.recv()
                now = perf_counter()
                # Of the answer only its number is read: these clients are to cost as little as they can.
                load.errors += not (isinstance(frame, bytes) and MARKS[seq % 400] in frame[:100])
                if asked > start + WARM:
                    load.took.append(now - asked)
    except (ConnectionClosed, InvalidHandshake, OSError, TimeoutError):
        load.errors += 1


def crowd(urls: list[str], seconds: float) -> Load:
    """All clients, in a process of their own."""

    async def everyone() -> Load:
        load = Load()
        start = perf_counter() + 2.0
        count = len(urls)
        await asyncio.gather(
            *(
                client(url, start, start + WARM + seconds, k / (RATE * count), load)
                for k, url in enumerate(urls)
            )
        )
        return load

    return asyncio.run(everyone())


def processor(pid: int) -> float:
    """Seconds of processor time of a process and its children so far."""
    total = 0.0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(folder.name) == pid or int(fields[1]) == pid:
            total += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return total


def measure(title: str, urls: list[str], pids: list[int], seconds: float) -> None:
    """Runs the clients and prints a row."""
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        pool.apply(int)
        before, began = [processor(pid) for pid in pids], perf_counter()
        load = pool.apply(crowd, (urls, seconds))
        spent = perf_counter() - began
    used = [processor(pid) - b for pid, b in zip(pids, before, strict=True)]
    took = 1e3 * np.array(load.took)
    busy = ", ".join(f"{100 * seconds / spent:.0f} %" for seconds in used)
    print(
        f"| {title} | {len(urls)} | {len(took) / seconds:.0f} of {len(urls) * RATE:.0f} | {np.median(took):.1f} | "
        f"{np.quantile(took, 0.99):.1f} | {load.errors} | {busy} | {1e3 * sum(used) / load.asked:.2f} |",
        flush=True,
    )


@contextmanager
def ready(count: int) -> Iterator[Farm]:
    with tempfile.TemporaryDirectory() as folder, farm(Path(folder), count) as running:
        for replica in running.replicas:
            kernels_ready(replica.port)
        yield running


def main(seconds: float, counts: list[int]) -> None:
    print(
        "| servers | clients | updates/s | p50, ms | p99, ms | errors | processor | per update, ms |\n"
        "|---|---|---|---|---|---|---|---|"
    )
    with ready(1) as one:
        pids = [one.replicas[0].process.pid]
        for count in counts:
            direct = f"ws://{one.replicas[0].address}/api/v1/live"
            measure("one process", [direct] * count, pids, seconds)
        measure("one, behind nginx", behind(one, counts[-1]), pids, seconds)
    with ready(2) as two:
        pids = [replica.process.pid for replica in two.replicas]
        for count in counts:
            measure("two, behind nginx", behind(two, count), pids, seconds)


def behind(running: Farm, count: int) -> list[str]:
    return [f"ws://127.0.0.1:{running.port}/api/v1/live?session={next(NAMES)}" for _ in range(count)]


if __name__ == "__main__":
    given = [float(value) for value in sys.argv[1:]]
    main(given[0] if given else SECONDS, [int(value) for value in given[1:]] or list(CLIENTS))
