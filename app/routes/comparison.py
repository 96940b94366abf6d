"""POST calls that look beyond one design: other systems, other methods, other splits of the poles."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core.comparison import compare, compare_splits

from ..contract.comparison import CompareRequest, Comparison, Split, comparison_reply, splits_reply
from ..contract.design import DesignRequest
from ..contract.encoding import json_bytes, json_content, json_response
from ..contract.model import described
from ..contract.placement import Method, Placement, PlaceRequest, assessment_reply, methods_reply
from ..jobs.compute import Compute


def build_router(compute: Compute) -> APIRouter:
    """The routes methods, place, compare and splits under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["comparison"])

    @router.get("/methods", **described(list[Method], "Placement methods"))
    async def methods() -> Response:
        return json_response(methods_reply())

    @router.post("/place", **described(Placement, "State feedback for any controllable (A, B)"))
    async def place(request: PlaceRequest) -> Response:
        return json_content(await compute.run_slow(_placement, request))

    @router.post("/compare", **described(Comparison, "The same poles through several methods"))
    async def compare_(request: CompareRequest) -> Response:
        return json_content(await compute.run_slow(_comparison, request))

    @router.post("/splits", **described(list[Split], "All ways to deal four poles into two pairs"))
    async def splits(request: DesignRequest) -> Response:
        return json_content(await compute.run_slow(_splits, request))

    return router


def _placement(request: PlaceRequest) -> bytes:
    return json_bytes(assessment_reply(request.place()))


def _comparison(request: CompareRequest) -> bytes:
    return json_bytes(comparison_reply(compare(request.to_spec(), request.methods, request.tuning)))


def _splits(request: DesignRequest) -> bytes:
    return json_bytes(splits_reply(compare_splits(request.to_spec())))
