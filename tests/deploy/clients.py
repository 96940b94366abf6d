"""Clients of the live socket that come back when they lose it, and remember when they were answered."""

from __future__ import annotations

from dataclasses import dataclass, field
from time import perf_counter

import orjson
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake

BODY = {
    "preset": "quanser-2dof-manual",
    "scenario": {"reference": {"theta": 0.2, "psi": 0.5}, "duration": 3, "samples": 301},
}


@dataclass
class Client:
    """One tab's live socket: what was asked last is asked again after a loss."""

    url: str
    poles: list[float]
    answered: list[float] = field(default_factory=list)
    """When, by perf_counter."""
    gains: list[list[list[float]]] = field(default_factory=list)
    lost: list[int] = field(default_factory=list)
    """Close codes of the connections that were lost (1006: without one)."""
    refused: int = 0
    """How often a new connection was not to be had."""
    peer: ClientConnection | None = None

    async def ask(self) -> None:
        """One answer, over as many connections as it takes."""
        seq, count = len(self.answered) + 1, len(self.answered)
        while len(self.answered) == count:
            try:
                if self.peer is None:
                    self.peer = await connect(self.url, compression=None, max_size=None, proxy=None)
                await self.peer.send(orjson.dumps({"seq": seq, "poles": self.poles, **BODY}).decode())
                reply = orjson.loads(await self.peer.recv())
            except ConnectionClosed as closed:
                self.lost.append(closed.rcvd.code if closed.rcvd else 1006)
                self.peer = None
            except (OSError, InvalidHandshake, TimeoutError):
                self.refused += 1
                self.peer = None
            else:
                assert reply["seq"] == seq, reply
                assert "gains" in reply, reply
                self.gains.append(reply["gains"]["K"])
                self.answered.append(perf_counter())

    async def close(self) -> None:
        if self.peer is not None:
            await self.peer.close()

    def gap(self, moment: float) -> float:
        """Seconds from a moment to the next answer."""
        return next(t for t in self.answered if t > moment) - moment
