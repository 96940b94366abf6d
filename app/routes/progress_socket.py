"""A socket on which one request is answered at a time, with progress: whatever comes next cancels it."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from typing import Any

import orjson
from fastapi import WebSocket, WebSocketDisconnect

from ..contract.encoding import json_text
from ..contract.problems import problem_of
from ..edge.connections import connection_of
from ..edge.messages import received

_log = logging.getLogger(__name__)
Send = Callable[[str], Awaitable[None]]


async def serve_with_progress(socket: WebSocket, answer: Callable[[Any, Send], Awaitable[None]]) -> None:
    """Lets `answer` send replies to each request, until the visitor goes; what it raises becomes a problem object."""
    connection = connection_of(socket)

    async def answered(text: str | bytes) -> None:
        await _answer(socket, text, answer)
        await connection.set_idle()

    await socket.accept()
    try:
        text = await received(socket)
        while True:
            connection.busy = True
            answering = asyncio.create_task(answered(text))
            try:
                text = await received(socket)
            finally:
                answering.cancel()
                await asyncio.wait({answering})
                if not answering.cancelled():
                    answering.exception()  # the visitor has gone; it is looked at
    except WebSocketDisconnect:
        pass


async def _answer(
    socket: WebSocket, text: str | bytes, answer: Callable[[Any, Send], Awaitable[None]]
) -> None:
    try:
        data = orjson.loads(text)
        if isinstance(data, dict) and data.get("cancel"):
            await socket.send_text(json_text({"cancelled": True}))
            return
        await answer(data, socket.send_text)
    except WebSocketDisconnect:
        raise
    except Exception as error:
        body = problem_of(error)
        if body["status"] == 500:
            _log.exception("a request on %s failed", socket.url.path)
        await socket.send_text(json_text(body))
