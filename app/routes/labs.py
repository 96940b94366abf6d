"""Labs: what there is, and an attempt alone, which nobody keeps."""

from __future__ import annotations

import asyncio
from typing import Annotated

from fastapi import APIRouter, Path, Query, Response

from ..classes.late import Classes
from ..contract.encoding import described_files, json_response
from ..contract.labs import LARGEST_SEED, Hint, LabSummary, LabView, Marked, MarkRequest
from ..contract.model import described
from .class_calls import csv_response, refusals

LabName = Annotated[str, Path(alias="lab", pattern=r"^[a-z0-9-]{1,40}$")]
Seed = Annotated[int | None, Query(ge=0, le=LARGEST_SEED, description="of the rig; left out: none is told")]


def build_router(classes: Classes) -> APIRouter:
    """The routes under /api/v1/labs."""
    router = APIRouter(prefix="/api/v1/labs", tags=["labs"])

    @router.get("", **described(list[LabSummary], "The labs, in the course's order"))
    async def labs() -> Response:
        desk = await classes.desk()
        known = await asyncio.to_thread(desk.labs.all)
        return json_response([await asyncio.to_thread(lambda one=one: one.summary) for one in known])

    @router.get("/{lab}", **refusals(described(LabView, "A lab as a student may see it"), 404))
    async def one(lab: LabName, seed: Seed = None) -> Response:
        desk = await classes.desk()
        known = await asyncio.to_thread(desk.labs.named, lab)
        return json_response(await asyncio.to_thread(desk.view_alone, known, seed))

    @router.post(
        "/{lab}/mark", **refusals(described(Marked, "An attempt alone: marked, and not kept"), 403, 404)
    )
    async def mark(lab: LabName, request: MarkRequest) -> Response:
        desk = await classes.desk()
        known = await asyncio.to_thread(desk.labs.named, lab)
        return json_response(
            await desk.mark_alone(
                known,
                request.step,
                seed=request.seed,
                body=request.design,
                answers=request.answers,
                hints=request.hints,
                flight=request.flight,
            )
        )

    @router.get("/{lab}/steps/{step}/hints/{hint}", **refusals(described(Hint, "A hint, alone"), 403, 404))
    async def hint(lab: LabName, step: str, hint: Annotated[int, Path(ge=1, le=100)]) -> Response:
        desk = await classes.desk()
        known = await asyncio.to_thread(desk.labs.named, lab)
        return json_response(await asyncio.to_thread(desk.hint_alone, known, step, hint))

    @router.get(
        "/{lab}/recording",
        **refusals(
            described_files("A recording of the seed's rig", {"text/csv": {"schema": {"type": "string"}}}),
            403,
            404,
        ),
    )
    async def recording(lab: LabName, step: str, seed: Seed = 0) -> Response:
        desk = await classes.desk()
        known = await asyncio.to_thread(desk.labs.named, lab)
        desk.require_alone(known)
        return csv_response(await desk.record(known, step, seed or 0), f"heli2dof-{lab}.csv")

    return router
