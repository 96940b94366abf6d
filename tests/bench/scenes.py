"""Scenes beside drags: forty clients drag at twenty updates a second, alone, with a scene each, with a window too.

Then two hundred sessions come and go. Prints latencies, the server's processor time and its memory:

    python -m tests.bench.scenes [seconds per phase] [clients]
"""

from __future__ import annotations

import asyncio
import math
import os
import re
import struct
import subprocess
import sys
from collections import Counter
from collections.abc import Awaitable, Callable, Iterator
from contextlib import AsyncExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

import numpy as np
import orjson
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from app.contract.encoding import BINARY_SUBPROTOCOL
from heli2dof_core import preset
from tests.bench.round_trip import kernels_ready, live
from tests.scene_client import CAMERA, encode

SECONDS, CLIENTS, RATE = 12.0, 40, 20.0
SESSIONS, WAVE, PLACES = 200, 25, 100
QUIET_FILES = 8
"""The app's own; a scene holds four more."""
ROOT = Path(__file__).parents[2]
VISER = Subprotocol("viser-v1.1.1")


@dataclass(frozen=True)
class Server:
    """The app in a process of its own."""

    port: int
    pid: int

    def socket(self, session: str, hub: str = "") -> str:
        return f"ws://127.0.0.1:{self.port}/scene/{session}{hub}"

    def processor(self) -> float:
        """Seconds of processor time so far."""
        fields = Path(f"/proc/{self.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def status(self, name: str) -> int:
        line = re.search(rf"^{name}:\s+(\d+)", Path(f"/proc/{self.pid}/status").read_text(), re.M)
        assert line is not None
        return int(line[1])

    def standing(self) -> str:
        return (
            f"{self.status('VmRSS') / 1024:6.1f} MB, {self.status('Threads')} threads, {self.files()} files"
        )

    def files(self) -> int:
        return len(list(Path(f"/proc/{self.pid}/fd").iterdir()))


@contextmanager
def served() -> Iterator[Server]:
    command = [sys.executable, "-m", "app", "serve", "--port", "0"]
    process = subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    try:
        assert process.stdout is not None
        ready = re.search(r":(\d+)\s*$", process.stdout.readline())
        assert ready is not None, "the server does not start"
        server = Server(int(ready[1]), process.pid)
        kernels_ready(server.port)
        yield server
    finally:
        process.terminate()
        process.wait(20)


@dataclass
class Drag:
    """One client's drag: when each update was asked for, and how long its answer took; s."""

    asked: dict[int, float] = field(default_factory=dict)
    took: list[float] = field(default_factory=list)
    last: bytes = b""

    async def run(self, server: Server, seconds: float, start: float) -> None:
        rig = preset()
        scenario = {"reference": {"theta": 0.2, "psi": 0.5}, "duration": 5, "samples": 501, "rtol": 1e-5}
        async with connect(
            live(server.port), subprotocols=[Subprotocol(BINARY_SUBPROTOCOL)], compression=None, max_size=None
        ) as socket:
            reading = asyncio.create_task(self.read(socket))
            await asyncio.sleep(start)
            began = perf_counter()
            for seq in range(int(seconds * RATE)):
                await asyncio.sleep(max(0.0, began + seq / RATE - perf_counter()))
                poles = [-12.0, -10.0, -9.0 + 2.0 * math.sin(0.1 * seq), -8.5]
                self.asked[seq] = perf_counter()
                body = {
                    "seq": seq,
                    "preset": rig.name,
                    "poles": poles,
                    "scenario": scenario,
                    "each_axis": True,
                }
                await socket.send(orjson.dumps(body).decode())
            await asyncio.sleep(0.5)
            reading.cancel()

    async def read(self, socket: ClientConnection) -> None:
        while True:
            frame = await socket.recv()
            now = perf_counter()
            assert isinstance(frame, bytes)
            seq = re.search(rb'"seq":(\d+)', frame)
            assert seq is not None
            self.took.append(now - self.asked[int(seq[1])])
            self.last = frame


async def drain(
    socket: ClientConnection, heard: Callable[[str | bytes], Awaitable[None]] | None = None
) -> None:
    try:
        async for frame in socket:
            if heard:
                await heard(frame)
    except ConnectionClosed:
        pass


def name(k: int) -> str:
    return f"session-{os.getpid()}-{k}".ljust(24, "_")


received: Counter[str] = Counter()
"""Frames of scenes, counted to know when every viewer has its whole scene."""


async def viewer(stack: AsyncExitStack, server: Server, session: str) -> None:
    """A browser's view of a scene: drains it, and orbits once a second."""

    async def count(_: str | bytes) -> None:
        received["frames"] += 1

    url = server.socket(session)
    socket = await stack.enter_async_context(
        connect(url, subprotocols=[VISER], compression=None, max_size=None)
    )
    tasks = [asyncio.create_task(drain(socket, count)), asyncio.create_task(orbit(socket))]
    stack.callback(lambda: [task.cancel() for task in tasks])


async def quiet() -> None:
    """Waits until no viewer has been sent anything for a while."""
    last = -1
    while received["frames"] != last:
        last = received["frames"]
        await asyncio.sleep(1.5)


async def orbit(socket: ClientConnection) -> None:
    while True:
        await socket.send(encode(CAMERA))
        await asyncio.sleep(1.0)


async def page(stack: AsyncExitStack, server: Server, session: str, drag: Drag) -> None:
    """A page's part: shows each answer to whoever else is in the session, at the pace that the server sets."""
    others, free = asyncio.Event(), asyncio.Event()
    free.set()

    async def heard(message: str | bytes) -> None:
        if isinstance(message, bytes):
            return
        match orjson.loads(message):
            case {"type": "windows", "others": count}:
                (others.set if count else others.clear)()
            case {"type": "taken"}:
                free.set()

    async def tell() -> None:
        told = b""
        while True:
            await others.wait()
            await free.wait()
            if drag.last is not told:
                told = drag.last
                free.clear()
                await socket.send(shown())
            await asyncio.sleep(1 / RATE)

    url = server.socket(session, "/hub?page=true")
    socket = await stack.enter_async_context(connect(url, compression=None))
    tasks = [asyncio.create_task(drain(socket, heard)), asyncio.create_task(tell())]
    stack.callback(lambda: [task.cancel() for task in tasks])


def shown() -> bytes:
    """A frame as large as the page's."""
    pole, pi = [{"re": -9.0 + np.random.rand(), "im": 0.0}] * 4, {"kp": 30.0, "ti": 0.1}
    design = {"poles": pole, "loops": {"pitch": pi, "yaw": pi}, "outer": "pi", "padding": "x" * 900}
    header = orjson.dumps({"design": design, "K": np.random.rand(2, 4).tolist(), "after": 0})
    header += b" " * (-len(header) % 4)
    return struct.pack("<I", len(header)) + header + bytes(4 * 5 * 501)


async def window(stack: AsyncExitStack, server: Server, session: str) -> None:
    """A window of its own: the scene, and what the page shows."""
    await viewer(stack, server, session)
    socket = await stack.enter_async_context(connect(server.socket(session, "/hub"), compression=None))
    task = asyncio.create_task(drain(socket))
    stack.callback(task.cancel)


async def phase(
    server: Server, title: str, seconds: float, clients: int, *, scenes: bool, windows: bool
) -> None:
    drags = [Drag() for _ in range(clients)]
    async with AsyncExitStack() as stack:
        for k, drag in enumerate(drags if scenes else []):
            await viewer(stack, server, name(k))
            await page(stack, server, name(k), drag)
            if windows:
                await window(stack, server, name(k))
        await quiet()
        before, began = server.processor(), perf_counter()
        await asyncio.gather(
            *(drag.run(server, seconds, k / (RATE * clients)) for k, drag in enumerate(drags))
        )
        spent = server.processor() - before
        share = spent / (perf_counter() - began)
        standing = server.standing()
    took = 1e3 * np.array([t for drag in drags for t in drag.took])
    asked = sum(len(drag.asked) for drag in drags)
    print(
        f"{title:42} p50 {np.median(took):7.1f} ms  p99 {np.quantile(took, 0.99):7.1f} ms  "
        f"answered {len(took) / asked:4.0%}  processor {100 * share:5.1f} %, {1e3 * spent / len(took):5.2f} ms each  "
        f"{standing}",
        flush=True,
    )


async def come_and_go(server: Server, count: int, first: int) -> None:
    """So many sessions, each with its scene, a page and a window; all leave, and are stopped before the next wave."""
    for wave in range(0, count, WAVE):
        async with AsyncExitStack() as stack:
            for k in range(WAVE):
                session = name(first + wave + k)
                await viewer(stack, server, session)
                await page(stack, server, session, Drag())
                await window(stack, server, session)
        await asyncio.sleep(1.0)
    await freed(server)


async def freed(server: Server) -> None:
    """Waits until no session is left, which takes most of a minute."""
    began, threads = perf_counter(), server.status("Threads")
    while server.files() > QUIET_FILES and perf_counter() - began < 75:
        await asyncio.sleep(1.0)
    gone = threads - server.status("Threads")
    print(f"{'':42} {gone} threads gone {perf_counter() - began:.0f} s after the last client", flush=True)


async def main(server: Server, seconds: float, clients: int) -> None:
    await phase(server, "(warming up)", 3.0, clients, scenes=False, windows=False)
    print(f"{clients} clients at {RATE:.0f} Hz", flush=True)
    for _ in range(2):
        await phase(server, "drags alone", seconds, clients, scenes=False, windows=False)
        await phase(server, "with a scene each", seconds, clients, scenes=True, windows=False)
    await phase(server, "with a scene and a window each", seconds, clients, scenes=True, windows=True)
    await freed(server)
    # As many at once as ever: what the allocator keeps of that is no leak.
    await come_and_go(server, PLACES, 1000)
    print(f"{'before the sessions':42} {server.standing()}", flush=True)
    for k in (1, 2):
        await come_and_go(server, SESSIONS, 1000 * (k + 1))
        print(f"{f'after {k * SESSIONS} sessions came and went':42} {server.standing()}", flush=True)


if __name__ == "__main__":
    given = [float(value) for value in sys.argv[1:]]
    with served() as started:
        asyncio.run(
            main(started, given[0] if given else SECONDS, int(given[1]) if len(given) > 1 else CLIENTS)
        )
