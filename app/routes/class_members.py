"""One student of a class, for its instructor."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Depends, Path, Response

from ..classes.late import Classes
from ..contract.classes import LARGEST_ID, HandMark, NewLink, StudentReply
from ..contract.model import described
from ..ops.settings import Settings
from .class_calls import Code, Guesses, OwnOrigin, Rates, Secret, no_others, nothing, private, refusals

StudentId = Annotated[int, Path(alias="student", ge=1, le=LARGEST_ID, description="as the class tells it")]


def build_router(classes: Classes, settings: Settings, rates: Rates) -> APIRouter:
    """The routes under /api/v1/classes/{code}/students."""
    around = [Depends(OwnOrigin(settings.cors_origins)), Depends(Guesses(rates))]
    router = APIRouter(
        prefix="/api/v1/classes/{code}/students/{student}", tags=["classes"], dependencies=around
    )

    @router.get("", **refusals(described(StudentReply, "Everything of one student"), 403, 404))
    async def student(code: Code, student_id: StudentId, secret: Secret) -> Response:
        desk = await classes.desk()
        return private(await desk.student(code, secret, student_id))

    @router.post("/marks", **refusals(nothing("A mark by hand was kept"), 403, 404))
    async def mark(code: Code, student_id: StudentId, request: HandMark, secret: Secret) -> Response:
        desk = await classes.desk()
        await desk.mark_by_hand(code, secret, student_id, request.model_dump())
        return Response(status_code=204)

    @router.post("/link", **refusals(described(NewLink, "A new personal link; the old one ends"), 403, 404))
    async def link(code: Code, student_id: StudentId, secret: Secret) -> Response:
        desk = await classes.desk()
        return private(await desk.new_link(code, secret, student_id))

    @router.delete("", **refusals(nothing("The student is gone"), 403, 404))
    async def remove(code: Code, student_id: StudentId, secret: Secret) -> Response:
        desk = await classes.desk()
        await desk.delete_student(code, secret, student_id)
        return Response(status_code=204)

    no_others(router, "", "GET", "DELETE")
    return router
