"""Ten clients drag at 20 Hz while ten others keep the server at its slowest work: how long a drag's answer takes.

python -m tests.bench.fairness [seconds [rounds]]
"""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Awaitable, Iterator
from contextlib import contextmanager, nullcontext
from time import perf_counter, sleep
from typing import Any

import httpx2
import numpy as np
import orjson
from websockets.asyncio.client import connect

from app.contract.encoding import BINARY_SUBPROTOCOL
from tests.bench.round_trip import kernels_ready
from tests.e2e.conftest import running_app

DRAGGING, RATE = 10, 20.0
COLUMNS = {"time": "time", "theta": "theta", "psi": "psi", "V_p": "V_p", "V_y": "V_y"}
finished: Counter[str] = Counter()
"""Slow work that was done, or refused."""


async def drag(port: int, seconds: float, times: list[float], nth: int) -> None:
    """A hand that moves a pole: 20 requests a second whose answers are waited for."""
    url = f"ws://127.0.0.1:{port}/api/v1/live"
    async with connect(url, subprotocols=[BINARY_SUBPROTOCOL], compression=None, max_size=None) as peer:  # pyright: ignore
        await asyncio.sleep(nth / DRAGGING / RATE)
        end, seq = perf_counter() + seconds, 0
        while (begin := perf_counter()) < end:
            seq += 1
            poles = [-12 - 0.01 * (seq % 100), -10, -9.25, -8.76]
            await peer.send(orjson.dumps({"seq": seq, "poles": poles}).decode())
            await peer.recv()
            took = perf_counter() - begin
            times.append(took)
            await asyncio.sleep(max(0.0, 1 / RATE - took))


async def clouds(port: int) -> None:
    """The socket of uncertain rigs, ten thousand at a time."""
    async with connect(f"ws://127.0.0.1:{port}/api/v1/robustness", compression=None, max_size=None) as peer:
        while True:
            await peer.send('{"samples": 10000}')
            reply: dict[str, Any] = {"done": 0}
            while reply.get("done", 10_000) < 10_000:
                reply = orjson.loads(await peer.recv())
            finished[reply.get("code", "cloud")] += 1
            if "code" in reply:
                await asyncio.sleep(1.0)


async def identifications(port: int) -> None:
    """A recording of thirty seconds, identified over and over."""
    async with httpx2.AsyncClient(base_url=f"http://127.0.0.1:{port}/api/v1", timeout=60) as http:
        file = (await http.post("/recordings/sample", json={"length": 30})).content
        key = (await http.post("/recordings", params={"name": "a.csv"}, content=file)).json()["id"]
    async with connect(f"ws://127.0.0.1:{port}/api/v1/recordings/identify", compression=None) as peer:
        while True:
            await peer.send(orjson.dumps({"recording": key, "columns": COLUMNS}).decode())
            reply: dict[str, Any] = {"done": False}
            while reply.get("done") is False:
                reply = orjson.loads(await peer.recv())
            finished[reply.get("code", "identification")] += 1
            if "code" in reply:
                await asyncio.sleep(1.0)


async def posts(port: int, path: str, body: dict) -> None:
    """A call over and over."""
    async with httpx2.AsyncClient(base_url=f"http://127.0.0.1:{port}/api/v1", timeout=120) as http:
        while True:
            reply = await http.post(path, json=body)
            finished[path if reply.status_code == 200 else f"{path} {reply.status_code}"] += 1
            if reply.status_code != 200:
                await asyncio.sleep(1.0)


def others(port: int) -> list[Awaitable[None]]:
    """Ten clients that ask for the slowest there is."""
    compared = {"scenario": {"duration": 20, "samples": 2001}}
    return [
        *(clouds(port) for _ in range(4)),
        *(identifications(port) for _ in range(2)),
        *(posts(port, "/compare", compared) for _ in range(2)),
        posts(port, "/export/report", {}),
        posts(port, "/motion", {}),
    ]


async def greedy(port: int) -> None:
    """All of them, until the input ends; then tells what was done for them."""
    os.nice(15)
    tasks = [asyncio.ensure_future(each) for each in others(port)]
    await asyncio.to_thread(sys.stdin.read)
    ended = [task.exception() for task in tasks if task.done()]
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    if ended:
        print("ended early:", ended, file=sys.stderr)
    print(orjson.dumps(finished).decode())


@contextmanager
def beside(port: int) -> Iterator[None]:
    """The greedy clients in a process of their own, which stands back: others' computers hold up nobody."""
    command = [sys.executable, "-m", __spec__.name, "greedy", str(port)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as others:
        sleep(4.0)
        yield
        told, _ = others.communicate()
    finished.update(orjson.loads(told))


async def measure(port: int, seconds: float) -> list[float]:
    """Seconds of each update."""
    times: list[float] = []
    await asyncio.gather(*(drag(port, seconds, times, i) for i in range(DRAGGING)))
    return times


def main() -> None:
    """Measures alone and beside others, in turn: a machine is never the same for long."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    for workers in (0, 2):
        finished.clear()
        times: dict[bool, list[float]] = {False: [], True: []}
        with running_app(workers=workers) as app:
            kernels_ready(app.port)
            httpx2.post(
                f"http://127.0.0.1:{app.port}/api/v1/splits", json={}, timeout=120
            )  # workers have loaded
            for _ in range(rounds):
                for busy in (False, True):
                    with beside(app.port) if busy else nullcontext():
                        times[busy] += asyncio.run(measure(app.port, seconds))
        print(f"slow work in {workers} processes:" if workers else "slow work in threads:")
        p99 = {}
        for busy, took in times.items():
            p50, p95, p99[busy] = np.percentile(took, (50, 95, 99)) * 1e3
            words = "beside ten with slow work" if busy else "alone"
            print(
                f"  {DRAGGING} drag at {RATE:g} Hz {words}: {len(took) / seconds / rounds:.0f} answers/s, "
                f"p50 {p50:.1f} ms, p95 {p95:.1f} ms, p99 {p99[busy]:.1f} ms, longest {max(took) * 1e3:.0f} ms"
            )
        done = ", ".join(f"{count} × {name}" for name, count in finished.items())
        print(f"  p99 beside others / alone: {p99[True] / p99[False]:.2f}; meanwhile: {done}", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["greedy"]:
        asyncio.run(greedy(int(sys.argv[2])))
    else:
        main()
