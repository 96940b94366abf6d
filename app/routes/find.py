"""The finder over REST and, with progress and cancel, over a WebSocket."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fastapi import APIRouter, Response, WebSocket

from heli2dof_core.finder import Designs

from ..contract.encoding import json_bytes, json_text
from ..contract.find import FindRequest
from ..contract.find_replies import FindReply, find_reply, part_reply
from ..contract.model import described
from ..jobs.compute import Compute, check_cancelled, seconds_left
from .progress_socket import Send, serve_with_progress


def build_router(compute: Compute) -> APIRouter:
    """POST and WebSocket /api/v1/find."""
    router = APIRouter(prefix="/api/v1", tags=["design"])

    @router.post("/find", **described(FindReply, "Designs that meet what is required, along a front"))
    async def find(request: FindRequest) -> Response:
        return Response(await compute.run_slow(_found, request), media_type="application/json")

    @router.websocket("/find")
    async def progressing(socket: WebSocket) -> None:
        """One request in; progress out, and the answer last. Whatever comes next cancels it."""

        async def answer(data: Any, send: Send) -> None:
            request = FindRequest.model_validate(data)
            async for part in compute.stream(_parts, request):
                await send(part)

        await serve_with_progress(socket, answer)

    return router


SEARCHED = 0.75
"""Share of a job's time in which a search ends by itself; in the rest its designs are proved."""


def _found(request: FindRequest) -> bytes:
    *_, last = request.in_parts(check_cancelled, SEARCHED * seconds_left())
    assert isinstance(last, Designs)  # a search ends with its designs
    return json_bytes(find_reply(last))


def _parts(request: FindRequest) -> Iterator[str]:
    for part in request.in_parts(check_cancelled, SEARCHED * seconds_left()):
        yield json_text(part_reply(part))
