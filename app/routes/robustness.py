"""The cloud of uncertain rigs over REST and, with progress and cancel, over a WebSocket."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fastapi import APIRouter, Response, WebSocket

from heli2dof_core.robustness import cloud, cloud_in_parts

from ..contract.encoding import json_bytes, json_text
from ..contract.model import described
from ..contract.robustness import RobustnessReply, RobustnessRequest, cloud_reply
from ..jobs.compute import Compute, check_cancelled
from ..ops.metrics import Metrics
from .progress_socket import Send, serve_with_progress


def build_router(compute: Compute, metrics: Metrics) -> APIRouter:
    """POST and WebSocket /api/v1/robustness."""
    router = APIRouter(prefix="/api/v1", tags=["robustness"])

    @router.post(
        "/robustness", **described(RobustnessReply, "Poles and responses of many rigs under one controller")
    )
    async def robustness(request: RobustnessRequest) -> Response:
        metrics.clouds.inc()

        return Response(await compute.run_slow(_cloud, request), media_type="application/json")

    @router.websocket("/robustness")
    async def progressing(socket: WebSocket) -> None:
        """One request in; clouds out, the last with done = samples. Whatever comes next cancels it."""

        async def answer(data: Any, send: Send) -> None:
            request = RobustnessRequest.model_validate(data)
            metrics.clouds.inc()
            async for part in compute.stream(_parts, request):
                await send(part)

        await serve_with_progress(socket, answer)

    return router


# Text is made in the worker, too: twelve thousand poles would hold up the event loop.


def _cloud(request: RobustnessRequest) -> bytes:
    return json_bytes(cloud_reply(cloud(request.to_spec(), request.to_uncertainty(), check_cancelled)))


def _parts(request: RobustnessRequest) -> Iterator[str]:
    for part in cloud_in_parts(request.to_spec(), request.to_uncertainty(), check_cancelled):
        yield json_text(cloud_reply(part))
