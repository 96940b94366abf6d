"""POST track: a design and one of its numbers in, the loop's poles and figures over it out, or as a file."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core.export.tracks import track_csv, track_svg

from ..contract.encoding import described_files, json_bytes
from ..contract.model import described
from ..contract.tracks import TrackReply, TrackRequest, track_reply
from ..jobs.compute import Compute, check_cancelled


def build_router(compute: Compute) -> APIRouter:
    """The routes track, track/csv and track/svg under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["design"])

    @router.post("/track", **described(TrackReply, "The loop's poles, and figures, as one number is swept"))
    async def track(request: TrackRequest) -> Response:
        return Response(await compute.run_slow(_tracked, request), media_type="application/json")

    @router.post(
        "/track/csv", **described_files("A track as numbers, one row per value", {"text/csv": _TEXT})
    )
    async def csv(request: TrackRequest) -> Response:
        return _file(
            await compute.run_slow(_numbers, request), "text/csv; charset=utf-8", "heli2dof_track.csv"
        )

    @router.post("/track/svg", **described_files("A track as a picture", {"image/svg+xml": _TEXT}))
    async def svg(request: TrackRequest) -> Response:
        return _file(await compute.run_slow(_picture, request), "image/svg+xml", "heli2dof_track.svg")

    return router


_TEXT = {"schema": {"type": "string", "format": "binary"}}


def _file(content: str, media_type: str, name: str) -> Response:
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(content, media_type=media_type, headers=headers)


def _tracked(request: TrackRequest) -> bytes:
    return json_bytes(track_reply(request.to_track(check_cancelled)))


def _numbers(request: TrackRequest) -> str:
    return track_csv(request.to_track(check_cancelled), request.to_spec())


def _picture(request: TrackRequest) -> str:
    return track_svg(request.to_track(check_cancelled), request.to_spec())
