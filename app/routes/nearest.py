"""POST nearest: a design and what is required of it in, the smallest moves that meet it out."""

from __future__ import annotations

from fastapi import APIRouter, Response

from ..contract.encoding import json_bytes, json_content
from ..contract.model import described
from ..contract.nearest import NearestReply, NearestRequest, nearest_reply
from ..jobs.compute import Compute, check_cancelled


def build_router(compute: Compute) -> APIRouter:
    """The route nearest under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["design"])

    @router.post("/nearest", **described(NearestReply, "The smallest moves that meet what is required"))
    async def nearest(request: NearestRequest) -> Response:
        return json_content(await compute.run_slow(_nearest, request))

    return router


def _nearest(request: NearestRequest) -> bytes:
    return json_bytes(nearest_reply(request.to_nearest(check_cancelled)))
