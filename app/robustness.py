"""The cloud of uncertain rigs over REST and, with progress and cancel, over a WebSocket."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Iterator

import orjson
from fastapi import APIRouter, Response, WebSocket, WebSocketDisconnect
from pydantic import ValidationError

from heli2dof_core import Heli2DofError
from heli2dof_core.robustness import Cloud, cloud, cloud_in_parts

from .compute import Compute
from .encoding import json_bytes, json_response
from .models import described
from .problems import problem, problem_of
from .replies import Reply
from .robustness_requests import RobustnessReply, RobustnessRequest, cloud_reply

_log = logging.getLogger(__name__)


def build_router(compute: Compute) -> APIRouter:
    """POST and WebSocket /api/v1/robustness."""
    router = APIRouter(prefix="/api/v1", tags=["robustness"])

    @router.post(
        "/robustness", **described(RobustnessReply, "Poles and responses of many rigs under one controller")
    )
    async def robustness(request: RobustnessRequest) -> Response:
        def work() -> Reply:
            return cloud_reply(cloud(request.to_spec(), request.to_uncertainty()))

        return json_response(await compute.run(work))

    @router.websocket("/robustness")
    async def progressing(socket: WebSocket) -> None:
        """One request in; clouds out, the last with done = samples. Whatever comes next cancels it."""
        await socket.accept()
        try:
            text = await socket.receive_text()
            while True:
                answering = asyncio.create_task(_answer(socket, text, compute))
                try:
                    text = await socket.receive_text()
                finally:
                    answering.cancel()
                    await asyncio.gather(answering, return_exceptions=True)
        except WebSocketDisconnect:
            pass

    return router


def _following(parts: Iterator[Cloud]) -> str | None:
    """The next part as text, made in the pool too: twelve thousand poles would hold up the event loop."""
    part = next(parts, None)
    return None if part is None else json_bytes(cloud_reply(part)).decode()


async def _answer(socket: WebSocket, text: str, compute: Compute) -> None:
    try:
        data = orjson.loads(text)
        if isinstance(data, dict) and data.get("cancel"):
            await socket.send_text(json_bytes({"cancelled": True}).decode())
            return
        request = RobustnessRequest.model_validate(data)
        parts = await compute.run(lambda: cloud_in_parts(request.to_spec(), request.to_uncertainty()))
        while (part := await compute.run(_following, parts)) is not None:
            await socket.send_text(part)
    except orjson.JSONDecodeError as error:
        refused = problem(422, f"Not JSON: {error}.", "invalid_json", hint="Send one JSON object.")
        await socket.send_text(json_bytes(refused).decode())
    except (ValidationError, Heli2DofError) as error:
        await socket.send_text(json_bytes(problem_of(error)).decode())
    except (asyncio.CancelledError, WebSocketDisconnect):
        raise
    except Exception:
        _log.exception("robustness request failed")
        failed = problem(500, "The server failed to answer; this is a bug.", "internal_error")
        await socket.send_text(json_bytes(failed).decode())
