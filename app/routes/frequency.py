"""POST calls: a design in, what it is like over frequency out."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core import interaction, loop_of, place
from heli2dof_core.evaluate import quadratic, weights_of
from heli2dof_core.lag_track import lag_track
from heli2dof_core.root_locus import symmetric_root_locus

from ..contract.design import DesignRequest
from ..contract.encoding import json_response
from ..contract.experiment import StepRequest
from ..contract.frequency import (
    Lag,
    LoopsRequest,
    OpenLoops,
    Rga,
    RgaRequest,
    RootLocus,
    lag_reply,
    locus_reply,
    open_loops_reply,
    rga_reply,
)
from ..contract.model import Reply, described
from ..jobs.compute import Compute


def build_router(compute: Compute) -> APIRouter:
    """The routes rga, loops, lag and locus under /api/v1."""
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

    @router.post("/lag", **described(Lag, "The loop's poles as the rotors' lag grows to what it is"))
    async def lag(request: StepRequest) -> Response:
        def work() -> Reply:
            return lag_reply(lag_track(loop_of(request.to_spec())))

        return json_response(await compute.run(work))

    @router.post("/locus", **described(RootLocus, "The symmetric root locus of a quadratic method"))
    async def locus(request: DesignRequest) -> Response:
        def work() -> Reply:
            spec = quadratic(request.to_spec())
            return locus_reply(symmetric_root_locus(place(spec), weights_of(spec)))

        return json_response(await compute.run(work))

    return router
