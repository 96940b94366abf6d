"""What the handlers of sockets share: receiving, a mailbox where the newest wins, ends."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Coroutine
from typing import Any, Generic, TypeVar

from fastapi import WebSocket, WebSocketDisconnect

T = TypeVar("T")


class Mailbox(Generic[T]):
    """Of each topic only the newest item waits; belongs to one event loop."""

    def __init__(self) -> None:
        self._waiting: dict[str, T] = {}
        self._arrived = asyncio.Event()

    def put(self, item: T, topic: str = "") -> None:
        """Leaves an item, in place of one on the same topic that was not yet taken."""
        self._waiting[topic] = item
        self._arrived.set()

    @property
    def empty(self) -> bool:
        """Whether nothing waits."""
        return not self._waiting

    async def take(self) -> T:
        """Waits for an item and takes that of the topic that has waited longest."""
        while not self._waiting:
            self._arrived.clear()
            await self._arrived.wait()
        return self._waiting.pop(next(iter(self._waiting)))


async def received(socket: WebSocket) -> str | bytes:
    """The next message; JSON may come in binary frames too.

    Raises:
        WebSocketDisconnect: the visitor has gone.
    """
    message = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1000))
    return message.get("text") or message.get("bytes") or ""


async def first_to_end(*works: Coroutine[Any, Any, T]) -> asyncio.Task[T]:
    """Runs all until one ends, and cancels the others; returns that one."""
    tasks = [asyncio.create_task(work) for work in works]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    return done.pop()


async def close(socket: WebSocket, code: int, reason: str) -> None:
    """Closes the socket unless it is closed already; a close frame carries at most 123 bytes of reason."""
    with contextlib.suppress(RuntimeError, WebSocketDisconnect):
        await socket.close(code, reason.encode()[:123].decode(errors="ignore"))
