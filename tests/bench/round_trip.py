"""A full update over the live socket on loopback, against the update's own time plus a bare exchange.

The bare exchange sends the same request to a socket that answers at once with as many bytes.
"""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from time import monotonic, perf_counter, sleep

import orjson
from websockets.asyncio.client import connect

from app.encoding import BINARY_SUBPROTOCOL
from app.live import _evaluate
from app.requests import LiveRequest
from heli2dof_core import evaluate, preset
from tests.e2e.conftest import running_app

EXCHANGES = 300
ECHO = """
import sys, uvicorn
async def app(scope, receive, send):
    if scope["type"] != "websocket":
        return
    await receive()
    await send({"type": "websocket.accept"})
    answer = bytes(int(sys.argv[1]))
    while (await receive())["type"] == "websocket.receive":
        await send({"type": "websocket.send", "bytes": answer})
options = {"host": "127.0.0.1", "port": int(sys.argv[2]), "log_level": "error"}
uvicorn.run(app, **options, ws="websockets-sansio", ws_per_message_deflate=False, lifespan="off")
"""


def request() -> bytes:
    rig = preset()
    poles = [p.real for p in rig.poles.values]
    scenario = {"reference": {"theta": 0.5, "psi": 1.0}, "duration": 5, "samples": 501, "rtol": 1e-6}
    return orjson.dumps({"seq": 1, "preset": rig.name, "poles": poles, "scenario": scenario})


@contextmanager
def echo(size: int, port: int) -> Iterator[None]:
    process = subprocess.Popen([sys.executable, "-c", ECHO, str(size), str(port)])
    try:
        yield
    finally:
        process.terminate()
        process.wait(10)


async def exchanges(url: str, text: bytes, subprotocols: list | None = None) -> tuple[list[float], int]:
    """Seconds of each exchange, and the size of the last answer."""
    times, answer = [], b""
    async with connect(url, subprotocols=subprotocols, compression=None, max_size=None) as socket:
        for _ in range(EXCHANGES + 20):
            begin = perf_counter()
            await socket.send(text.decode())
            answer = await socket.recv()
            times.append(perf_counter() - begin)
    return times[20:], len(answer)


def kernels_ready(port: int) -> None:
    """Until updates are as quick as compiled ones are."""
    deadline = monotonic() + 120
    while monotonic() < deadline:
        times, _ = asyncio.run(exchanges_few(port))
        if median(times) < 0.05:
            return
        sleep(1.0)
    raise TimeoutError("the kernels were not compiled in time")


async def exchanges_few(port: int) -> tuple[list[float], int]:
    times = []
    async with connect(f"ws://127.0.0.1:{port}/api/v1/live", subprotocols=[BINARY_SUBPROTOCOL]) as socket:
        for _ in range(3):
            begin = perf_counter()
            await socket.send(request().decode())
            await socket.recv()
            times.append(perf_counter() - begin)
    return times, 0


def resident(pid: int) -> float:
    """Resident memory, MB."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def round_trips() -> dict[str, float]:
    """Medians, s: a full update over the socket, a bare exchange, and the update alone."""
    text = request()
    spec = LiveRequest.model_validate(orjson.loads(text)).to_spec()
    with running_app() as app:
        kernels_ready(app.port)
        times, size = asyncio.run(
            exchanges(f"ws://127.0.0.1:{app.port}/api/v1/live", text, [BINARY_SUBPROTOCOL])
        )
        free = app.port + 1
        with echo(size, free):
            deadline = monotonic() + 20
            while monotonic() < deadline:
                try:
                    bare, _ = asyncio.run(exchanges(f"ws://127.0.0.1:{free}/", text))
                    break
                except OSError:
                    sleep(0.1)
        again, _ = asyncio.run(
            exchanges(f"ws://127.0.0.1:{app.port}/api/v1/live", text, [BINARY_SUBPROTOCOL])
        )
    return {
        f"full update over the socket ({size / 1e3:.0f} kB)": median([*times, *again]),
        "bare exchange of the same size": median(bare),
        "evaluate alone, at the same pace": median(paced(lambda: evaluate(spec))),
        "request → evaluate → frame alone, at the same pace": median(paced(lambda: _evaluate(text, True))),
    }


def paced(work: Callable[[], object]) -> Iterator[float]:
    """Seconds per call with a pause before each, as between requests: caches cool down as they do there."""
    for _ in range(EXCHANGES):
        sleep(0.002)
        begin = perf_counter()
        work()
        yield perf_counter() - begin


if __name__ == "__main__":
    from heli2dof_core import warm_up

    warm_up()
    found = round_trips()
    for name, seconds in found.items():
        print(f"{name:45} {1e3 * seconds:8.3f} ms")
    whole, bare, own, work = found.values()
    print(
        "ratio to exchange and evaluate", whole / (bare + own), "to exchange and work", whole / (bare + work)
    )
