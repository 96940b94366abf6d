"""POST map: one figure over a plane of designs, as numbers or as a file."""

from __future__ import annotations

from fastapi import APIRouter, Response

from ..contract.encoding import described_files, json_bytes
from ..contract.maps import MEDIA_TYPES, FileFormat, MapReply, MapRequest, map_file, map_reply
from ..contract.model import described
from ..jobs.compute import Compute, check_cancelled


def build_router(compute: Compute) -> APIRouter:
    """The routes map and map/{format} under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["map"])

    @router.post("/map", **described(MapReply, "One figure at every place of a pair or of PI gains"))
    async def map_(request: MapRequest) -> Response:
        return Response(await compute.run_slow(_mapped, request), media_type="application/json")

    binary = {"schema": {"type": "string", "format": "binary"}}
    kinds = {kind.partition(";")[0]: binary for kind in MEDIA_TYPES.values()}

    @router.post("/map/{format}", **described_files("The same as a picture, or as a row per place", kinds))
    async def file(request: MapRequest, format: FileFormat) -> Response:  # noqa: A002 # as the path calls it
        content = await compute.run_slow(_drawn, request, format)
        headers = {"Content-Disposition": f'attachment; filename="heli2dof_map.{format}"'}
        return Response(content, media_type=MEDIA_TYPES[format], headers=headers)

    return router


def _mapped(request: MapRequest) -> bytes:
    return json_bytes(map_reply(request.to_map(check_cancelled)))


def _drawn(request: MapRequest, kind: FileFormat) -> bytes:
    return map_file(request.to_map(check_cancelled), kind)
