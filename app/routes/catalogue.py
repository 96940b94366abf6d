"""GET calls: what there is."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core import PRESETS

from ..contract.encoding import json_response
from ..contract.model import described
from ..contract.presets import Preset, preset_reply


def build_router() -> APIRouter:
    """The route presets."""
    router = APIRouter(tags=["catalogue"])

    @router.get("/api/v1/presets", **described(list[Preset], "The rigs, the default one first"))
    async def presets() -> Response:
        return json_response([preset_reply(preset) for preset in PRESETS.values()])

    return router
