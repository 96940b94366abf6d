"""The live socket: evaluate requests in, answers out, the newest request wins."""

from __future__ import annotations

import asyncio
import logging
from typing import Any

import orjson
from fastapi import APIRouter, WebSocket, WebSocketDisconnect
from pydantic import ValidationError

from heli2dof_core import Heli2DofError, evaluate

from .compute import Compute
from .encoding import BINARY_SUBPROTOCOL, binary_frame, json_bytes
from .problems import problem, problem_of
from .replies import report_reply
from .requests import LiveRequest

_log = logging.getLogger(__name__)


class Newest:
    """A mailbox for one item: a newer item replaces one that was not yet taken."""

    def __init__(self) -> None:
        self._item: str | bytes | None = None
        self._arrived = asyncio.Event()

    def put(self, item: str | bytes) -> None:
        """Leaves an item, in place of one that waits."""
        self._item = item
        self._arrived.set()

    async def take(self) -> str | bytes:
        """Waits for an item and takes it."""
        while self._item is None:
            self._arrived.clear()
            await self._arrived.wait()
        item, self._item = self._item, None
        return item


def build_router(compute: Compute) -> APIRouter:
    """The live socket's route."""
    router = APIRouter()

    @router.websocket("/api/v1/live")
    async def live(socket: WebSocket) -> None:
        binary = BINARY_SUBPROTOCOL in socket.scope["subprotocols"]
        await socket.accept(subprotocol=BINARY_SUBPROTOCOL if binary else None)
        newest = Newest()
        answers = asyncio.create_task(_answer(socket, newest, compute, binary=binary))
        try:
            while True:
                message = await socket.receive()
                if message["type"] == "websocket.disconnect":
                    break
                newest.put(message.get("text") or message.get("bytes") or "")
        except WebSocketDisconnect:
            pass
        finally:
            answers.cancel()
            await asyncio.gather(answers, return_exceptions=True)

    return router


async def _answer(socket: WebSocket, newest: Newest, compute: Compute, *, binary: bool) -> None:
    while True:
        text = await newest.take()
        try:
            answer = await compute.run(_evaluate, text, binary)
        except Exception:
            _log.exception("live request failed")
            answer = _text(problem(500, "The server failed to answer; this is a bug.", "internal_error"))
        if isinstance(answer, str):
            await socket.send_text(answer)
        else:
            await socket.send_bytes(answer)


def _text(value: Any) -> str:
    return json_bytes(value).decode()


def _evaluate(text: str | bytes, binary: bool) -> str | bytes:
    """One request's answer: JSON as text, or a binary frame as bytes."""
    seq: dict[str, Any] = {}
    try:
        data = orjson.loads(text)
        if isinstance(data, dict) and isinstance(data.get("seq"), int):
            seq = {"seq": data["seq"]}
        request = LiveRequest.model_validate(data)
        spec = request.to_spec()
        reply = {**seq, **report_reply(evaluate(spec, each_axis=request.each_axis), spec)}
    except orjson.JSONDecodeError as error:
        return _text(problem(422, f"Not JSON: {error}.", "invalid_json", hint="Send one JSON object."))
    except (ValidationError, Heli2DofError) as error:
        return _text({**problem_of(error), **seq})
    return binary_frame(reply) if binary else _text(reply)
