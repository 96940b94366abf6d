"""The cloud of uncertain rigs over REST and, with progress and cancel, over a WebSocket."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fastapi import APIRouter, Response, WebSocket

from heli2dof_core.robustness import Cloud, cloud, cloud_in_parts

from .compute import Compute
from .conversation import Send, converse
from .encoding import json_bytes, json_response
from .metrics import Metrics
from .models import described
from .replies import Reply
from .robustness_requests import RobustnessReply, RobustnessRequest, cloud_reply


def build_router(compute: Compute, metrics: Metrics) -> APIRouter:
    """POST and WebSocket /api/v1/robustness."""
    router = APIRouter(prefix="/api/v1", tags=["robustness"])

    @router.post(
        "/robustness", **described(RobustnessReply, "Poles and responses of many rigs under one controller")
    )
    async def robustness(request: RobustnessRequest) -> Response:
        metrics.clouds.inc()

        def work() -> Reply:
            return cloud_reply(cloud(request.to_spec(), request.to_uncertainty()))

        return json_response(await compute.run(work))

    @router.websocket("/robustness")
    async def progressing(socket: WebSocket) -> None:
        """One request in; clouds out, the last with done = samples. Whatever comes next cancels it."""

        async def answer(data: Any, send: Send) -> None:
            request = RobustnessRequest.model_validate(data)
            metrics.clouds.inc()
            parts = await compute.run(lambda: cloud_in_parts(request.to_spec(), request.to_uncertainty()))
            while (part := await compute.run(_following, parts)) is not None:
                await send(part)

        await converse(socket, answer)

    return router


def _following(parts: Iterator[Cloud]) -> str | None:
    """The next part as text, made in the pool too: twelve thousand poles would hold up the event loop."""
    part = next(parts, None)
    return None if part is None else json_bytes(cloud_reply(part)).decode()
