"""A full update over the live socket on loopback, against the update's own time plus a bare exchange.

The bare exchange sends the same request to a socket that answers at once with as many bytes.
"""

from __future__ import annotations

import asyncio
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from socket import socket
from statistics import median
from time import perf_counter, sleep

import orjson
from threadpoolctl import threadpool_limits
from websockets.asyncio.client import connect

from app.contract.encoding import BINARY_SUBPROTOCOL
from app.contract.evaluation import LiveReader, LiveRequest
from app.routes.live import _evaluate
from heli2dof_core import evaluate, preset
from tests.e2e.conftest import running_app
from tests.patience import until

EXCHANGES, WARM = 300, 20
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


async def exchanges(
    url: str, text: bytes, subprotocols: list | None = None, count: int = EXCHANGES
) -> tuple[list[float], int]:
    """Seconds of each exchange, and the size of the last answer."""
    times, answer = [], b""
    async with connect(url, subprotocols=subprotocols, compression=None, max_size=None) as peer:
        for _ in range(count + WARM):
            begin = perf_counter()
            await peer.send(text.decode())
            answer = await peer.recv()
            times.append(perf_counter() - begin)
    return times[WARM:], len(answer)


def kernels_ready(port: int) -> None:
    """Until updates are as quick as compiled ones are."""

    def quick() -> bool:
        times, _ = asyncio.run(exchanges(live(port), request(), [BINARY_SUBPROTOCOL], 3))
        return median(times) < 0.05

    until(quick, "the kernels are compiled", 120)


def answers(port: int) -> bool:
    with socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def live(port: int) -> str:
    return f"ws://127.0.0.1:{port}/api/v1/live"


def round_trips() -> dict[str, float]:
    """Medians, s: a full update over the socket, a bare exchange, and the update alone."""
    text, reader = request(), LiveReader()
    spec = LiveRequest.model_validate(orjson.loads(text)).to_spec()
    with running_app(message_rate="100000") as app:
        kernels_ready(app.port)
        for _ in range(2):  # while the first ones run, the server derives the other structures
            times, size = asyncio.run(exchanges(live(app.port), text, [BINARY_SUBPROTOCOL], 3 * EXCHANGES))
        port = app.port + 1
        with echo(size, port):
            until(lambda: answers(port), "the bare socket answers")
            bare, _ = asyncio.run(exchanges(f"ws://127.0.0.1:{port}/", text))
    return {
        f"full update over the socket ({size / 1e3:.0f} kB)": median(times),
        "bare exchange of the same size": median(bare),
        "evaluate alone, at the same pace": median(paced(lambda: evaluate(spec))),
        "request → evaluate → frame alone, at the same pace": median(
            paced(lambda: _evaluate(reader, text, True))
        ),
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
    threadpool_limits(1, "blas")
    found = round_trips()
    for name, seconds in found.items():
        print(f"{name:45} {1e3 * seconds:8.3f} ms")
    whole, bare, own, work = found.values()
    print(
        "ratio to exchange and evaluate", whole / (bare + own), "to exchange and work", whole / (bare + work)
    )
