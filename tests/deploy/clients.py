"""Clients of the live socket that come back as the page does, and remember when they were answered."""

from __future__ import annotations

import asyncio
import random
from dataclasses import dataclass, field
from time import perf_counter

import orjson
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake

BODY = {
    "preset": "quanser-2dof-manual",
    "scenario": {"reference": {"theta": 0.2, "psi": 0.5}, "duration": 3, "samples": 301},
}
FIRST, LONGEST = 0.25, 8.0
"""Seconds before a lost connection is tried again, as in static/api.js."""


@dataclass
class Client:
    """One tab's live socket: what was asked last is asked again after a loss."""

    url: str
    poles: list[float]
    pace: float = 0.1
    answered: list[float] = field(default_factory=list)
    """When, by perf_counter."""
    gains: list[list[list[float]]] = field(default_factory=list)
    lost: list[tuple[float, int]] = field(default_factory=list)
    """When a connection was lost, and the close code (1006: without one)."""
    stopped: bool = False

    async def run(self) -> None:
        seq, attempt = 0, 0
        while not self.stopped:
            try:
                async with connect(
                    self.url, compression=None, max_size=None, proxy=None, open_timeout=5
                ) as peer:
                    attempt = 0
                    while not self.stopped:
                        seq += 1
                        await self._ask(peer, seq)
                        await asyncio.sleep(self.pace)
            except ConnectionClosed as closed:
                self.lost.append((perf_counter(), closed.rcvd.code if closed.rcvd else 1006))
            except (OSError, InvalidHandshake, TimeoutError):
                pass
            await asyncio.sleep(min(LONGEST, FIRST * 2**attempt) * random.uniform(0.75, 1.25))
            attempt += 1

    async def _ask(self, peer: ClientConnection, seq: int) -> None:
        await peer.send(orjson.dumps({"seq": seq, "poles": self.poles, **BODY}).decode())
        async with asyncio.timeout(10):
            reply = orjson.loads(await peer.recv())
        assert reply["seq"] == seq, reply
        self.gains.append(reply["gains"]["K"])
        self.answered.append(perf_counter())

    def gap(self, moment: float) -> float:
        """Seconds from a moment to the next answer."""
        return next((t for t in self.answered if t > moment), float("inf")) - moment

    def longest_gap(self, moment: float) -> float:
        """The longest silence that includes or follows a moment, s."""
        times = [t for t in self.answered if t > moment]
        before = [t for t in self.answered if t <= moment][-1:]
        return max(b - a for a, b in zip((before + times)[:-1], (before + times)[1:], strict=True))
