"""Whether the server lives, whether it is ready, and how it does."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from ..contract.encoding import json_response
from ..contract.problems import problem, problem_response
from ..edge.connections import Connections
from ..jobs.compute import Compute
from ..ops.metrics import Metrics


def build_router(compute: Compute, connections: Connections, metrics: Metrics | None) -> APIRouter:
    """The routes livez, healthz and, where there are any, metrics."""
    router = APIRouter(tags=["health"])

    @router.get("/livez", summary="200 while the process answers at all")
    async def livez() -> Response:
        return json_response({"status": "ok"})

    @router.get("/healthz", summary="200 once ready to serve, 503 before and when it goes away")
    async def healthz() -> Response:
        if connections.shutting_down:
            gone = problem(503, "The server is shutting down.", "going_away", hint="Ask another one.")
            return problem_response(gone, {"Retry-After": "5"})
        if compute.ready:
            return json_response({"status": "ok"})
        return problem_response(
            problem(503, "The server is starting.", "starting", hint="Ask again in a second."),
            {"Retry-After": "1"},
        )

    if metrics is not None:

        @router.get("/metrics", include_in_schema=False)
        def metrics_text(
            request: Request,
        ) -> Response:  # in a thread: the process's own figures are read from the disk
            content, kind = metrics.text(request.headers.get("accept", ""))
            return Response(content, headers={"Content-Type": kind, "Cache-Control": "no-store"})

    return router
