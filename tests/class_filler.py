"""Fills a class with students who work: `python -m tests.class_filler ADDRESS --students 40 --lab NAME --seconds 60`.

Each joins, drags poles over the live socket, keeps drafts and hands in, as the page does: what is not answered
is sent again with its id. A wall watches by its stream. In the end everything that was answered must be there.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import random
import ssl
import sys
import uuid
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass, field
from statistics import quantiles
from time import monotonic
from typing import Any

import httpx2
import websockets

API = "/api/v1/classes"
DRAFT_EVERY = 3.0
DRAG_RATE, DRAG_SHARE = 10.0, 0.2
"""Updates a second of a drag that asks the server, and the share of time in which a hand drags."""
AGAIN = 0.5
"""Seconds after which what was not answered is sent again."""
PATIENCE = 60.0
TRUST = ssl.create_default_context()
"""For all clients: each would read all authorities anew, which takes longer than its calls."""


@dataclass
class Told:
    """What was measured: seconds, and how often something happened."""

    students: int = 0
    seconds: float = 0.0
    attempts: list[float] = field(default_factory=list)
    drafts: list[float] = field(default_factory=list)
    drags: list[float] = field(default_factory=list)
    lags: list[float] = field(default_factory=list)
    refused: dict[str, int] = field(default_factory=dict)
    again: int = 0
    walls: int = 0
    lost: list[str] = field(default_factory=list)

    def refuse(self, what: str) -> None:
        """Counts an answer that was none."""
        self.refused[what] = self.refused.get(what, 0) + 1

    def lines(self) -> list[str]:
        """All of it, for people."""
        rows = {
            "attempts": self.attempts,
            "drafts": self.drafts,
            "drags": self.drags,
            "wall's lag": self.lags,
        }
        return [
            f"{self.students} students, {self.seconds:.0f} s",
            *(f"{name:<11} {spread(times)}" for name, times in rows.items()),
            f"sent again  {self.again}, the wall's stream opened {self.walls} times",
            *(f"refused     {what}: {count}" for what, count in sorted(self.refused.items())),
            f"lost        {len(self.lost)} of {len(self.attempts)} that were answered",
        ]


def session(k: int) -> str:
    """The name of a student's tab."""
    return f"filler-{k:017d}"


def spread(times: Sequence[float]) -> str:
    """Count, median, 95 % and 99 %, ms."""
    if len(times) < 2:
        return f"{len(times)}"
    parts = quantiles(times, n=100, method="inclusive")
    p50, p95, p99, most = (1e3 * each for each in (parts[49], parts[94], parts[98], max(times)))
    return f"{len(times):>6}: p50 {p50:.1f} ms, p95 {p95:.1f} ms, p99 {p99:.1f} ms, most {most:.1f} ms"


@dataclass
class Filler:
    """A class, and those who work in it.

    Attributes:
        addresses: of the server, or of replicas among which the students are dealt.
        lab: its name.
        every: seconds between a student's attempts.
    """

    addresses: Sequence[str]
    lab: str
    students: int
    seconds: float
    every: float = 30.0
    headers: dict[str, str] = field(default_factory=dict)
    told: Told = field(default_factory=Told)
    _answered: dict[str, list[str]] = field(default_factory=dict)
    _at: dict[tuple[int, int], float] = field(default_factory=dict)
    _counts: dict[int, int] = field(default_factory=dict)
    _seen: dict[int, int] = field(default_factory=dict)
    _ending: float = 0.0

    async def run(self) -> Told:
        """Makes the class, lets all work, checks in the end."""
        async with self._client(0) as client:
            made = await client.post(API, json={"lab": self.lab, "title": "Filled"}, headers=self.headers)
            made.raise_for_status()
            code, key = made.json()["code"], {"Heli2dof-Secret": made.json()["instructor"]}
            self._ending = monotonic() + self.seconds
            watching = asyncio.create_task(self._watch(code, key))
            await asyncio.gather(*(self._work(code, k) for k in range(self.students)))
            await self._until_told()
            watching.cancel()
            with suppress(asyncio.CancelledError):
                await watching
            for secret, attempts in self._answered.items():
                mine = await self._asked(client, "GET", f"{API}/{code}/mine", key={"Heli2dof-Secret": secret})
                kept = {one["id"] for step in mine.json()["steps"].values() for one in step["tries"]}
                self.told.lost += [one for one in attempts if one not in kept]
            await self._asked(client, "DELETE", f"{API}/{code}", key=key)
        self.told.students, self.told.seconds = self.students, self.seconds
        return self.told

    @asynccontextmanager
    async def _client(self, k: int) -> AsyncIterator[httpx2.AsyncClient]:
        base = self.addresses[k % len(self.addresses)]
        own = {"session": session(k)}  # by which nginx deals the tabs
        options = {"timeout": PATIENCE, "trust_env": False, "verify": TRUST}
        async with httpx2.AsyncClient(base_url=base, params=own, **options) as client:
            yield client

    async def _asked(
        self,
        client: httpx2.AsyncClient,
        method: str,
        path: str,
        *,
        key: dict[str, str] | None = None,
        body: Any = None,
    ) -> httpx2.Response:
        """A call that is sent again until it is answered, as the page's outbox does."""
        deadline = monotonic() + PATIENCE
        while True:
            try:
                reply = await client.request(method, path, json=body, headers=key)
                if reply.status_code < 500 and reply.status_code != 429:
                    if reply.status_code >= 400:
                        self.told.refuse(f"{method} {path.rpartition('/')[2]} {reply.status_code}")
                    return reply
                self.told.refuse(f"{method} {path.rpartition('/')[2]} {reply.status_code}")
            except httpx2.TransportError as error:
                self.told.refuse(type(error).__name__)
            if monotonic() > deadline:
                raise TimeoutError(f"no answer to {method} {path}; so far {self.told.refused}")
            self.told.again += 1
            await asyncio.sleep(AGAIN)

    async def _work(self, code: str, k: int) -> None:
        """One student."""
        own = random.Random(k)
        await asyncio.sleep(own.uniform(0, min(5.0, self.seconds / 4)))
        async with self._client(k) as client:
            request = {"name": f"Student {k}", "id": str(uuid.UUID(int=own.getrandbits(128), version=4))}
            joined = (await self._asked(client, "POST", f"{API}/{code}/join", body=request)).json()
            step = joined["lab"]["steps"][0]["name"]
            dragging = asyncio.create_task(self._drag(k, joined["rig"], own))
            seq, next_attempt = 0, monotonic() + own.uniform(0, min(self.every, self.seconds / 2))
            while monotonic() < self._ending:
                design = {"poles": [round(-own.uniform(1, 12), 2) for _ in range(4)]}
                seq += 1
                body = {"student": joined["student"], "step": step, "design": design, "answers": {}}
                began = monotonic()
                await self._asked(client, "PUT", f"{API}/{code}/draft", body={**body, "seq": seq})
                self.told.drafts.append(monotonic() - began)
                if monotonic() >= next_attempt:
                    next_attempt += self.every
                    await self._hand_in(client, code, joined, body)
                await asyncio.sleep(own.uniform(0.7, 1.3) * DRAFT_EVERY)
            dragging.cancel()
            with suppress(asyncio.CancelledError):
                await dragging

    async def _hand_in(self, client: httpx2.AsyncClient, code: str, joined: Any, body: Any) -> None:
        own, began = str(uuid.uuid4()), monotonic()
        reply = await self._asked(client, "POST", f"{API}/{code}/attempts", body={**body, "id": own})
        self.told.attempts.append(monotonic() - began)
        if reply.status_code == 200:
            self._answered.setdefault(joined["student"], []).append(own)
            count = self._counts[joined["id"]] = self._counts.get(joined["id"], 0) + 1
            if self._seen.get(joined["id"], 0) >= count:
                self.told.lags.append(0.0)  # the wall was faster than the answer
            else:
                self._at[joined["id"], count] = monotonic()

    async def _drag(self, k: int, rig: Any, own: random.Random) -> None:
        """Now and then a hand that asks the server at every move."""
        base = self.addresses[k % len(self.addresses)].replace("http", "ws", 1)
        while True:
            try:
                async with websockets.connect(
                    f"{base}/api/v1/live?session={session(k)}",
                    proxy=None,
                    subprotocols=["heli2dof.v1+binary"],
                ) as socket:
                    seq = 0
                    while True:
                        for _ in range(int(2 * DRAG_RATE)):
                            seq += 1
                            poles = [round(-own.uniform(1, 12), 2) for _ in range(4)]
                            began = monotonic()
                            await socket.send(json.dumps({**rig, "poles": poles, "seq": seq}))
                            await socket.recv()
                            self.told.drags.append(monotonic() - began)
                            await asyncio.sleep(1 / DRAG_RATE)
                        await asyncio.sleep(2.0 / DRAG_SHARE - 2.0)
            except (OSError, websockets.WebSocketException):
                await asyncio.sleep(AGAIN)

    async def _watch(self, code: str, key: dict[str, str]) -> None:
        """The wall's stream, opened again where it breaks."""
        k = 0
        while True:
            with suppress(httpx2.TransportError):
                async with (
                    self._client(k) as client,
                    client.stream("GET", f"{API}/{code}/events", headers=key) as reply,
                ):
                    self.told.walls += 1
                    async for line in reply.aiter_lines():
                        if line.startswith("data: "):
                            self._hear(json.loads(line.removeprefix("data: ")))
            k += 1
            await asyncio.sleep(AGAIN)

    def _hear(self, told: Any) -> None:
        now = monotonic()
        for student in told.get("students", ()):
            count = sum(step["attempts"] for step in student["steps"].values())
            before = self._seen.get(student["id"], 0)
            self._seen[student["id"]] = max(before, count)
            for k in range(before + 1, count + 1):
                if (since := self._at.pop((student["id"], k), None)) is not None:
                    self.told.lags.append(now - since)

    async def _until_told(self) -> None:
        deadline = monotonic() + PATIENCE
        while self._at and monotonic() < deadline:
            await asyncio.sleep(0.1)
        if self._at:
            self.told.refuse(f"the wall never heard of {len(self._at)} attempts")


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description="Fill a class with students who work.")
    parser.add_argument("address", nargs="+", help="as http://127.0.0.1:8000; several: replicas")
    parser.add_argument("--students", type=int, default=40)
    parser.add_argument("--lab", required=True)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--every", type=float, default=30.0, help="seconds between a student's attempts")
    parser.add_argument("--operator", default="", help="the operator's key, where the server asks for it")
    given = parser.parse_args()
    headers = {"Heli2dof-Operator": given.operator} if given.operator else {}
    filler = Filler(given.address, given.lab, given.students, given.seconds, given.every, headers)
    told = asyncio.run(filler.run())
    print("\n".join(told.lines()))
    return 1 if told.lost or any(what.startswith("the wall") for what in told.refused) else 0


if __name__ == "__main__":
    sys.exit(main())
