"""Open sockets, so that a server that ends can let each finish its answer and then say goodbye."""

from __future__ import annotations

import asyncio
import contextlib
import logging

from fastapi import WebSocket
from starlette.types import Send

_log = logging.getLogger(__name__)
GOING_AWAY = 1001
SCOPE_KEY = "heli2dof.connection"
"""Where a socket's scope holds its connection."""
_INTAKE = 0.25
"""Seconds for which what was sent before the end is still taken in."""
_CLOSE_TIMEOUT, _SHARE = 0.5, 0.25
"""Seconds for the closes themselves, and the share of all the time that they may take at most; a peer that reads
nothing may not take one."""


class Connection:
    """One open socket.

    A handler that owes an answer says so by `busy` and calls `set_idle` when it owes none; one that never
    does may be closed at any time.
    """

    __slots__ = ("_connections", "_send", "busy", "closed")

    def __init__(self, connections: Connections, send: Send) -> None:
        self.busy = False
        self.closed = False
        self._connections = connections
        self._send = send

    async def set_idle(self) -> None:
        """Nothing is owed now; where the server ends, the socket does."""
        self.busy = False
        if self._connections.closing_idle:
            await self.close()

    async def close(self) -> None:
        """Closes the socket with 1001; the handler then sees it disconnected."""
        if self.closed:
            return
        self.closed = True
        with contextlib.suppress(Exception):  # gone already
            await self._send(
                {"type": "websocket.close", "code": GOING_AWAY, "reason": "the server goes away; come back"}
            )


class Connections:
    """The open sockets of an app; belongs to one event loop.

    Attributes:
        shutting_down: whether the server ends: it is not ready for anything new.
        closing_idle: whether sockets are closed as soon as they owe nothing.
    """

    def __init__(self) -> None:
        self.shutting_down = False
        self.closing_idle = False
        self._open: set[Connection] = set()
        self._empty = asyncio.Event()

    def __len__(self) -> int:
        return len(self._open)

    def add(self, send: Send) -> Connection:
        """A socket was opened."""
        connection = Connection(self, send)
        self._open.add(connection)
        self._empty.clear()
        return connection

    def remove(self, connection: Connection) -> None:
        """Its handler has returned."""
        self._open.discard(connection)
        if not self._open:
            self._empty.set()

    async def close_all(self, seconds: float) -> None:
        """Lets every socket finish what it owes, then closes it with 1001; over after `seconds` come what may."""
        self.shutting_down = True
        if not self._open:
            self.closing_idle = True
            return
        began, count = asyncio.get_running_loop().time(), len(self._open)
        timeout = min(_CLOSE_TIMEOUT, _SHARE * seconds)
        await asyncio.sleep(min(_INTAKE, _SHARE * seconds))
        self.closing_idle = True
        await self._close_each([connection for connection in self._open if not connection.busy], timeout)
        left = began + seconds - timeout - asyncio.get_running_loop().time()
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self._all_removed(), max(left, 0.0))
        late = len(self._open)
        await self._close_each(list(self._open), timeout)
        _log.info("sockets closed: %d, of which %d without their answer", count, late)

    async def _all_removed(self) -> None:
        while self._open:
            self._empty.clear()
            await self._empty.wait()

    async def _close_each(self, connections: list[Connection], seconds: float) -> None:
        closes = [asyncio.create_task(connection.close()) for connection in connections]
        if closes:
            await asyncio.wait(closes, timeout=seconds)


def connection_of(socket: WebSocket) -> Connection:
    """The socket's connection; one of its own where no middleware has made it, as in tests of a router alone."""
    return socket.scope.get(SCOPE_KEY) or Connection(Connections(), socket.send)
