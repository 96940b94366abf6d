"""Open sockets, so that a server that ends can let each finish its answer and then say goodbye."""

from __future__ import annotations

import asyncio
import contextlib
import logging

from fastapi import WebSocket
from starlette.types import Send

_log = logging.getLogger(__name__)
GOING_AWAY = 1001
KEY = "heli2dof.visit"
"""Where a socket's scope holds its visit."""
_LATE = 0.25
"""Seconds for which what was sent before the end is still taken in."""
_LAST_WORDS, _SHARE = 0.5, 0.25
"""Seconds for the goodbyes themselves, and the share of all the time that they may take at most; a peer that reads
nothing may not take one."""


class Visit:
    """One open socket.

    A handler that owes an answer says so by `busy` and calls `rest` when it owes none; one that never
    does may be closed at any time.
    """

    __slots__ = ("_send", "_visits", "busy", "left")

    def __init__(self, visits: Visits, send: Send) -> None:
        self.busy = False
        self.left = False
        self._visits = visits
        self._send = send

    async def rest(self) -> None:
        """Nothing is owed now; where the server ends, the socket does."""
        self.busy = False
        if self._visits.leaving:
            await self.leave()

    async def leave(self) -> None:
        """Closes the socket with 1001; the handler then sees it disconnected."""
        if self.left:
            return
        self.left = True
        with contextlib.suppress(Exception):  # gone already
            await self._send(
                {"type": "websocket.close", "code": GOING_AWAY, "reason": "the server goes away; come back"}
            )


class Visits:
    """The open sockets of an app; belongs to one event loop.

    Attributes:
        closing: whether the server ends: it is not ready for anything new.
        leaving: whether sockets are closed as soon as they owe nothing.
    """

    def __init__(self) -> None:
        self.closing = False
        self.leaving = False
        self._open: set[Visit] = set()
        self._empty = asyncio.Event()

    def __len__(self) -> int:
        return len(self._open)

    def enter(self, send: Send) -> Visit:
        """A socket was opened."""
        visit = Visit(self, send)
        self._open.add(visit)
        self._empty.clear()
        return visit

    def exit(self, visit: Visit) -> None:
        """Its handler has returned."""
        self._open.discard(visit)
        if not self._open:
            self._empty.set()

    async def farewell(self, seconds: float) -> None:
        """Lets every socket finish what it owes, then closes it with 1001; over after `seconds` come what may."""
        self.closing = True
        if not self._open:
            self.leaving = True
            return
        began, count = asyncio.get_running_loop().time(), len(self._open)
        words = min(_LAST_WORDS, _SHARE * seconds)
        await asyncio.sleep(min(_LATE, _SHARE * seconds))
        self.leaving = True
        await self._close([visit for visit in self._open if not visit.busy], words)
        left = began + seconds - words - asyncio.get_running_loop().time()
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self._gone(), max(left, 0.0))
        late = len(self._open)
        await self._close(list(self._open), words)
        _log.info("sockets closed: %d, of which %d without their answer", count, late)

    async def _gone(self) -> None:
        while self._open:
            self._empty.clear()
            await self._empty.wait()

    async def _close(self, visits: list[Visit], seconds: float) -> None:
        goodbyes = [asyncio.create_task(visit.leave()) for visit in visits]
        if goodbyes:
            await asyncio.wait(goodbyes, timeout=seconds)


def visit_of(socket: WebSocket) -> Visit:
    """The socket's visit; one of its own where no middleware has made it, as in tests of a router alone."""
    return socket.scope.get(KEY) or Visit(Visits(), socket.send)
