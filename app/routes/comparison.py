"""POST calls that look beyond one design: other systems, other methods, other splits of the poles."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core.comparison import compare, compare_splits

from ..contract import comparison_models as models
from ..contract import comparison_replies as replies
from ..contract.encoding import json_response
from ..contract.models import described
from ..contract.placement_requests import PlaceRequest
from ..contract.requests import CompareRequest, DesignRequest
from ..jobs.compute import Compute


def build_router(compute: Compute) -> APIRouter:
    """The routes methods, place, compare and splits under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["comparison"])

    @router.get("/methods", **described(list[models.Method], "Placement methods"))
    async def methods() -> Response:
        return json_response(replies.methods_reply())

    @router.post("/place", **described(models.Placement, "State feedback for any controllable (A, B)"))
    async def place(request: PlaceRequest) -> Response:
        return json_response(await compute.run_slow(lambda: replies.assessment_reply(request.place())))

    @router.post("/compare", **described(models.Comparison, "The same poles through several methods"))
    async def compare_(request: CompareRequest) -> Response:
        def work() -> replies.Reply:
            return replies.comparison_reply(compare(request.to_spec(), request.methods))

        return json_response(await compute.run_slow(work))

    @router.post("/splits", **described(list[models.Split], "All ways to deal four poles into two pairs"))
    async def splits(request: DesignRequest) -> Response:
        return json_response(
            await compute.run_slow(lambda: replies.splits_reply(compare_splits(request.to_spec())))
        )

    return router
