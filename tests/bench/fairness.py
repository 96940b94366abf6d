"""Ten clients drag at 20 Hz while ten others keep the server at its slowest work: how long a drag's answer takes.

python -m tests.bench.fairness [seconds]
"""

from __future__ import annotations

import asyncio
import sys
from collections import Counter
from collections.abc import Awaitable
from time import perf_counter

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
            reply = {"done": 0}
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
            reply = {"done": False}
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


async def measure(port: int, seconds: float, *, busy: bool) -> list[float]:
    """Seconds of each update."""
    times: list[float] = []
    tasks = [asyncio.ensure_future(each) for each in (others(port) if busy else [])]
    if busy:
        await asyncio.sleep(3.0)
    await asyncio.gather(*(drag(port, seconds, times, i) for i in range(DRAGGING)))
    ended = [task.exception() for task in tasks if task.done()]
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    if ended:
        print("ended early:", ended)
    return times


def main() -> None:
    """Measures alone and beside others."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    with running_app() as app:
        port = app.port
        kernels_ready(port)
        for busy in (False, True):
            times = asyncio.run(measure(port, seconds, busy=busy))
            p50, p95, p99 = np.percentile(times, (50, 95, 99)) * 1e3
            words = "beside ten with slow work" if busy else "alone"
            print(
                f"{DRAGGING} drag at {RATE:g} Hz {words}: {len(times) / seconds:.0f} answers/s, "
                f"p50 {p50:.1f} ms, p95 {p95:.1f} ms, p99 {p99:.1f} ms, longest {max(times) * 1e3:.0f} ms",
                flush=True,
            )
    print("meanwhile:", ", ".join(f"{count} × {name}" for name, count in finished.items()))


if __name__ == "__main__":
    main()
