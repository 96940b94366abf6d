"""A long day in minutes: forty clients drag, play, leave and return, break connections, cancel clouds; one server.

Prints a table of the server's memory, threads, file descriptors and errors over time, and what is left at the end:

    python -m tests.bench.soak [minutes, 20 by default] [clients, 40] [seed]

Ends with status 1 where an answer was wrong, the server logged an error, or threads, descriptors or memory stay.
"""

from __future__ import annotations

import asyncio
import random
import re
import socket
import struct
import subprocess
import sys
import tempfile
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass
from time import perf_counter, sleep

import httpx2
import orjson
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from app.contract.encoding import BINARY_SUBPROTOCOL
from tests.bench.round_trip import kernels_ready
from tests.bench.scenes import ROOT, VISER, Server, shown
from tests.scene_client import CAMERA, encode

MINUTES, CLIENTS, ROWS = 20.0, 40, 20
LEAVING = 75.0
"""Seconds until the server has forgotten the last client: a session outlives it by 45 s."""
SETTLED = 0.3
"""Share of the time after which memory counts: until then, allocators and caches still fill."""
GROWTH_MB, LEFT_THREADS, LEFT_FILES = 40.0, 8, 4
"""Threads: asyncio's own pool and ours fill to their sizes as many ask at once, and stay."""
FAULT = re.compile(
    r"^(?:.*\b(?:ERROR|CRITICAL|never retrieved)\b.*|[\w.]+(?:Error|Exception|Disconnect\w*)\b.*)$", re.M
)
PRESETS = ("quanser-2dof-manual", "quanser-aero-2", "quanser-aero")
SCENARIO = {"reference": {"theta": 0.2, "psi": 0.5}, "duration": 5, "samples": 501, "rtol": 1e-5}

done: Counter[str] = Counter()
"""How often what was done."""
wrong: Counter[str] = Counter()
"""What should not have happened, by kind."""


@dataclass
class Visitor:
    """One student, who does this and that until the time is up."""

    port: int
    number: int
    chance: random.Random
    visits: int = 0

    @property
    def session(self) -> str:
        return f"soak-{self.number}-{self.visits // 3}".ljust(24, "_")  # returns twice to each

    def address(self, path: str) -> str:
        return f"ws://127.0.0.1:{self.port}/{path}"

    async def stay(self, end: float) -> None:
        ways = (
            [self.drag] * 5
            + [self.scene] * 2
            + [self.cloud, self.rest, self.half_a_handshake, self.half_a_frame]
        )
        while perf_counter() < end:
            self.visits += 1
            way = self.chance.choice(ways)
            try:
                async with asyncio.timeout(60):
                    await way()
                done[way.__name__] += 1
            except TimeoutError:
                wrong[f"{way.__name__}: no answer in 60 s"] += 1
            except (ConnectionClosed, InvalidHandshake, OSError, httpx2.HTTPError) as error:
                wrong[f"{way.__name__}: {type(error).__name__} {str(error)[:60]}"] += 1
            await asyncio.sleep(self.chance.expovariate(1.0))

    def design(self, seq: int) -> str:
        first = -3.0 - 6.0 * self.chance.random()
        preset = self.chance.choice(PRESETS)
        body = {"seq": seq, "preset": preset, "poles": [first, -10, -9, -8.5], "scenario": SCENARIO}
        return orjson.dumps({**body, "each_axis": True}).decode()

    async def drag(self) -> None:
        """Some seconds at twenty updates a second; one drag in three ends with a reset connection."""
        async with connect(
            self.address("api/v1/live"),
            subprotocols=[Subprotocol(BINARY_SUBPROTOCOL)],
            compression=None,
            max_size=None,
            proxy=None,
        ) as peer:
            for seq in range(self.chance.randint(20, 160)):
                await peer.send(self.design(seq))
                frame = await peer.recv()
                if not (isinstance(frame, bytes) and b'"seq":%d,' % seq in frame[:100]):
                    wrong[
                        f"drag: {bytes(frame[:80], 'utf-8') if isinstance(frame, str) else frame[:80]!r}"
                    ] += 1
                done["updates"] += 1
                await asyncio.sleep(0.05)
            if self.chance.random() < 0.33:
                await peer.send(self.design(0))  # and gone before the answer
                reset(peer)

    async def scene(self) -> None:
        """Opens the rig, shares a motion with a window, plays; leaves without a word every other time."""
        scene, hub = self.address(f"scene/{self.session}"), self.address(f"scene/{self.session}/hub")
        async with (
            connect(scene, subprotocols=[VISER], compression=None, max_size=None, proxy=None) as viewer,
            connect(f"{hub}?page=true", compression=None, proxy=None) as page,
            connect(hub, compression=None, proxy=None) as window,
        ):
            reading = [asyncio.create_task(drain(peer)) for peer in (viewer, page, window)]
            try:
                for k in range(self.chance.randint(3, 12)):
                    await viewer.send(encode(CAMERA))
                    await page.send(shown())
                    await page.send(
                        orjson.dumps(
                            {
                                "type": "transport",
                                "playing": k % 2 == 0,
                                "time": 0.1 * k,
                                "speed": 1,
                                "loop": True,
                                "at": 1.0,
                            }
                        ).decode()
                    )
                    await asyncio.sleep(0.5)
                if self.chance.random() < 0.5:
                    for peer in (viewer, window):
                        reset(peer)
            finally:
                for task in reading:
                    task.cancel()
                await asyncio.gather(*reading, return_exceptions=True)

    async def cloud(self) -> None:
        """A robustness run: cancelled by a message, by the next request, by leaving, or heard to its end."""
        async with connect(
            self.address("api/v1/robustness"), compression=None, max_size=None, proxy=None
        ) as peer:
            run = {"preset": PRESETS[0], "uncertainty": {"J_p": 0.2, "J_y": 0.2}, "samples": 2000}
            await peer.send(orjson.dumps(run).decode())
            first = orjson.loads(await peer.recv())
            if "status" in first:
                wrong[f"cloud: {first.get('code')} {str(first.get('detail'))[:60]}"] += 1
                return
            match self.chance.randrange(4):
                case 0:
                    await peer.send('{"cancel": true}')
                case 1:
                    await peer.send(orjson.dumps({**run, "samples": 200}).decode())
                    while orjson.loads(await peer.recv()).get("done") != 200:
                        pass
                case 2:
                    reset(peer)
                case _:
                    while orjson.loads(await peer.recv()).get("done", 2000) < 2000:
                        pass

    async def rest(self) -> None:
        """Opens the page's first calls and files."""
        async with httpx2.AsyncClient(base_url=f"http://127.0.0.1:{self.port}/", timeout=30) as client:
            for path in ("", "static/main.js", "api/v1/presets", "healthz"):
                answer = await client.get(path)
                if answer.status_code != 200:
                    wrong[f"GET {path}: {answer.status_code}"] += 1
            answer = await client.post("api/v1/compare", json={"poles": [-12, -10, -9, -8]})
            if answer.status_code != 200:
                wrong[f"POST compare: {answer.status_code}"] += 1

    async def half_a_handshake(self) -> None:
        """Half of a handshake, then a reset."""
        with socket.create_connection(("127.0.0.1", self.port)) as raw:
            raw.sendall(b"GET /api/v1/live HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: webso")
            await asyncio.sleep(self.chance.random())
            linger(raw)

    async def half_a_frame(self) -> None:
        """A frame that promises more than comes, then a reset."""
        peer = await connect(self.address("api/v1/live"), compression=None, proxy=None)
        peer.transport.write(b"\x81\xfe\x10\x00" + bytes(4) + b"half of a fra")
        await asyncio.sleep(self.chance.random())
        reset(peer)


async def drain(peer: ClientConnection) -> None:
    with suppress(ConnectionClosed):
        async for _ in peer:
            done["frames of scenes and hubs"] += 1


def linger(raw: socket.socket) -> None:
    """Makes the coming close a reset."""
    raw.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))


def reset(peer: ClientConnection) -> None:
    """Breaks a connection with RST, as a laptop's lid does not even do."""
    raw = peer.transport.get_extra_info("socket")
    raw.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    peer.transport.abort()


@dataclass(frozen=True)
class Standing:
    """The server at one moment."""

    minute: float
    megabytes: float
    threads: int
    files: int
    sockets: float

    @classmethod
    def of(cls, server: Server, began: float) -> Standing:
        return cls(
            (perf_counter() - began) / 60,
            server.status("VmRSS") / 1024,
            server.status("Threads"),
            server.files(),
            open_sockets(server.port),
        )

    def __str__(self) -> str:
        return (
            f"| {self.minute:.1f} | {self.megabytes:.0f} | {self.threads} | {self.files} | {self.sockets:.0f} "
            f"| {done['updates']} | {done['scene']} | {done['cloud']} | {sum(wrong.values())} |"
        )


def open_sockets(port: int) -> float:
    """Sockets that the server counts as open, each with its tasks; NaN where its metrics are off."""
    with suppress(httpx2.HTTPError):
        text = httpx2.get(f"http://127.0.0.1:{port}/metrics", timeout=30).text
        counts = re.findall(r"^heli2dof_sockets_open\{.*\} ([\d.e+]+)$", text, re.M)
        return sum(map(float, counts)) if counts else float("nan")
    return float("nan")


async def day(server: Server, minutes: float, clients: int, seed: int) -> list[Standing]:
    began = perf_counter()
    standings = [Standing.of(server, began)]
    print(
        "| minute | MB | threads | files | sockets | updates | scenes | clouds | wrong |\n|" + 9 * "---|",
        flush=True,
    )
    print(standings[0], flush=True)
    end = began + 60 * minutes
    visitors = [Visitor(server.port, k, random.Random(1000 * seed + k)) for k in range(clients)]
    staying = [asyncio.create_task(visitor.stay(end)) for visitor in visitors]
    for k in range(1, ROWS + 1):
        await asyncio.sleep(max(0.0, began + 60 * minutes * k / ROWS - perf_counter()))
        standings.append(await asyncio.to_thread(Standing.of, server, began))
        print(standings[-1], flush=True)
    await asyncio.gather(*staying)
    return standings


def main(minutes: float, clients: int, seed: int) -> int:
    with tempfile.NamedTemporaryFile(prefix="soak-", suffix=".log", delete=False) as log:
        command = [sys.executable, "-m", "app", "serve", "--port", "0"]
        process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=log)
        try:
            assert process.stdout is not None
            ready = re.search(rb":(\d+)\s*$", process.stdout.readline())
            assert ready is not None, "the server does not start"
            server = Server(int(ready[1]), process.pid)
            started = server.files()
            kernels_ready(server.port)
            asyncio.run(once(server))
            gone(server, started)
            standings = asyncio.run(day(server, minutes, clients, seed))
            spent = gone(server, standings[0].files)
            left = Standing.of(server, perf_counter() - spent - 60 * standings[-1].minute)
            print(left)
        finally:
            process.terminate()
            status = process.wait(30)
        log.seek(0)
        text = log.read().decode(errors="replace")
    print(f"\nthe server's log: {log.name}")
    return verdict(standings, left, text, status)


async def once(server: Server) -> None:
    """Everything once, so that what is made at first use is there: pools, viser's modules."""
    visitor = Visitor(server.port, 0, random.Random(0))
    for way in (visitor.drag, visitor.scene, visitor.rest, *[visitor.cloud] * 4):
        await way()


def gone(server: Server, files: int) -> float:
    """Waits until the server has forgotten all its clients; returns after how many seconds."""
    began = perf_counter()
    while perf_counter() - began < LEAVING and server.files() > files + LEFT_FILES:
        sleep(1.0)
    return perf_counter() - began


def verdict(standings: list[Standing], left: Standing, log: str, status: int) -> int:
    """Prints what to know and says whether all is well."""
    first, whole = standings[0], standings[-1].minute
    settled = [s for s in standings if s.minute >= SETTLED * whole]
    growth = settled[-1].megabytes - settled[0].megabytes
    errors = Counter(FAULT.findall(log))
    print(f"\ndone: {dict(done)}")
    print(
        f"memory, MB: {first.megabytes:.0f} at first, {standings[len(standings) // 2].megabytes:.0f} in the middle, "
        f"{standings[-1].megabytes:.0f} at the end, {left.megabytes:.0f} when all had gone; "
        f"{growth:+.0f} after the first {100 * SETTLED:.0f} %"
    )
    print(
        f"threads {first.threads} → {left.threads}, files {first.files} → {left.files}, "
        f"errors in the log {errors.total()}, server's status {status}"
    )
    bad = {
        **wrong,
        **{f"log: {line[:160]}": count for line, count in errors.most_common(20)},
        **({"memory grows": 1} if growth > GROWTH_MB else {}),
        **({"threads stay": 1} if left.threads > first.threads + LEFT_THREADS else {}),
        **({"sockets stay": 1} if left.sockets > 0 else {}),
        **({"files stay": 1} if left.files > first.files + LEFT_FILES else {}),
    }
    for what, count in bad.items():
        print(f"WRONG {count} × {what}")
    return 1 if bad else 0


if __name__ == "__main__":
    given = [float(value) for value in sys.argv[1:]]
    sys.exit(
        main(
            given[0] if given else MINUTES,
            int(given[1]) if len(given) > 1 else CLIENTS,
            int(given[2]) if len(given) > 2 else 1,
        )
    )
