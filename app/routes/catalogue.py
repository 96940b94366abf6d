"""GET calls: what there is."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core import PRESETS

from ..contract import models, replies
from ..contract.encoding import json_response


def build_router() -> APIRouter:
    """The route presets."""
    router = APIRouter(tags=["catalogue"])

    @router.get("/api/v1/presets", **models.described(list[models.Preset], "The rigs, the default one first"))
    async def presets() -> Response:
        return json_response([replies.preset_reply(preset) for preset in PRESETS.values()])

    return router
