"""How a request or a handshake is refused: with a problem object."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from typing import Any

from starlette.types import Receive, Scope, Send

from ..contract.problems import problem_response


async def refuse(
    scope: Scope,
    receive: Receive,
    send: Send,
    body: Mapping[str, Any],
    headers: Mapping[str, str] | None = None,
) -> None:
    """Answers with the problem object; a handshake, too, where the server can."""
    if scope["type"] == "websocket" and "websocket.http.response" not in scope.get("extensions", {}):
        await send({"type": "websocket.close", "code": 1008})
        return
    await problem_response(body, headers)(scope, receive, send)
    if scope["type"] == "websocket":
        await asyncio.sleep(0)  # uvicorn logs an error where the app returns before the transport has closed
