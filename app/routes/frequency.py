"""POST calls: a design in, what it is like over frequency out."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core import interaction, loop_of, place

from ..contract.encoding import json_response
from ..contract.frequency import LoopsRequest, OpenLoops, Rga, RgaRequest, open_loops_reply, rga_reply
from ..contract.model import Reply, described
from ..jobs.compute import Compute


def build_router(compute: Compute) -> APIRouter:
    """The routes rga and loops under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["design"])

    @router.post("/rga", **described(Rga, "Relative gain array, pairing and Niederlinski index"))
    async def rga(request: RgaRequest) -> Response:
        def work() -> Reply:
            spec = request.to_spec()
            design = place(spec)
            return rga_reply(design, interaction(design, spec.outer.pairing), request.frequencies)

        return json_response(await compute.run(work))

    @router.post(
        "/loops",
        **described(OpenLoops, "Frequency responses of the loops opened at each motor"),
    )
    async def loops(request: LoopsRequest) -> Response:
        def work() -> Reply:
            spec = request.to_spec()
            return open_loops_reply(loop_of(spec), request.frequencies)

        return json_response(await compute.run(work))

    return router
