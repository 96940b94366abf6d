"""POST calls: a design in, numbers out."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core import evaluate, loop_of, place, simulate, suggest_pi

from ..contract.design import (
    DesignRequest,
    Gains,
    Suggestion,
    gains_of,
    suggestion_reply,
)
from ..contract.encoding import json_response
from ..contract.evaluation import EvaluateRequest, Evaluation, report_reply
from ..contract.experiment import ResponseRequest, Step, states_reply, step_reply
from ..contract.model import Reply, described
from ..jobs.compute import Compute


def build_router(compute: Compute) -> APIRouter:
    """The routes gains, step, evaluate and suggest under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["design"])

    @router.post("/gains", **described(Gains, "K of u = −Kx + v and the poles that it gives"))
    async def gains(request: DesignRequest) -> Response:
        return json_response(await compute.run(lambda: gains_of(request.to_spec())))

    @router.post("/step", **described(Step, "Step response of the whole loop"))
    async def step(request: ResponseRequest) -> Response:
        def work() -> Reply:
            spec = request.to_spec()
            loop = loop_of(spec)
            step = simulate(loop, spec, request.scenario.model)
            return step_reply(step, loop) | (states_reply(step) if request.states else {})

        return json_response(await compute.run(work))

    @router.post("/evaluate", **described(Evaluation, "Everything that a design changes, at once"))
    async def evaluate_(request: EvaluateRequest) -> Response:
        def work() -> Reply:
            spec = request.to_spec()
            return report_reply(evaluate(spec, each_axis=request.each_axis), spec)

        return json_response(await compute.run(work))

    @router.post("/suggest", **described(Suggestion, "PI values that suit the placed poles"))
    async def suggest(request: DesignRequest) -> Response:
        def work() -> Reply:
            spec = request.to_spec()
            return suggestion_reply(suggest_pi(place(spec), spec.outer))

        return json_response(await compute.run(work))

    return router
