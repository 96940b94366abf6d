"""GET calls: what there is. Presets and health."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core import PRESETS

from .. import models, replies
from ..compute import Compute
from ..encoding import json_response
from ..problems import problem, problem_response


def build_router(compute: Compute) -> APIRouter:
    """The routes healthz and presets."""
    router = APIRouter(tags=["catalogue"])

    @router.get("/healthz", summary="200 once ready to serve")
    async def healthz() -> Response:
        if compute.ready:
            return json_response({"status": "ok"})
        return problem_response(
            problem(503, "The derivation is not ready yet.", "starting", hint="Ask again in a second."),
            {"Retry-After": "1"},
        )

    @router.get("/api/v1/presets", **models.described(list[models.Preset], "The rigs, the default one first"))
    async def presets() -> Response:
        return json_response([replies.preset_reply(preset) for preset in PRESETS.values()])

    return router
