"""A class for its students: joined, worked in, looked at, left."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Depends, Query, Request, Response

from ..classes.errors import ClassError
from ..classes.late import Classes
from ..contract.classes import (
    AttemptReply,
    AttemptRequest,
    DraftRequest,
    HintRequest,
    JoinClassRequest,
    Joined,
    Mine,
)
from ..contract.encoding import described_files
from ..contract.labs import Hint
from ..contract.model import described
from ..ops.settings import Settings
from .class_calls import (
    Code,
    Guesses,
    OwnOrigin,
    Rates,
    Secret,
    csv_response,
    no_others,
    nothing,
    private,
    refusals,
)

_CSV = {"text/csv": {"schema": {"type": "string"}}}


def build_router(classes: Classes, settings: Settings, rates: Rates) -> APIRouter:
    """The students' routes under /api/v1/classes."""
    around = [Depends(OwnOrigin(settings.cors_origins)), Depends(Guesses(rates))]
    router = APIRouter(prefix="/api/v1/classes/{code}", tags=["classes"], dependencies=around)

    @router.post("/join", **refusals(described(Joined, "Where a student begins, or left off"), 403, 404, 409))
    async def join(code: Code, request: JoinClassRequest, asked: Request) -> Response:
        desk = await classes.desk()
        if request.student is not None:
            return private(await desk.come_back(code, request.student))
        if request.name is None:
            raise ClassError(422, "name: give your name, or your secret.", "missing_field", field="name")
        rates.try_code(asked, code)
        rates.join(code)
        told = await desk.join(code, request.name, request.email, request.login, request.id)
        rates.was_right(asked, code)
        return private(told)

    @router.post(
        "/attempts", **refusals(described(AttemptReply, "An attempt, marked and kept"), 403, 404, 409)
    )
    async def attempts(code: Code, request: AttemptRequest) -> Response:
        desk = await classes.desk()
        return private(await desk.hand_in(code, request.student, request.to_handed(), rates.attempt))

    @router.put("/draft", **refusals(nothing("Where the student is was kept"), 403, 404, 409))
    async def draft(code: Code, request: DraftRequest) -> Response:
        rates.draft(request.student)
        desk = await classes.desk()
        await desk.keep_draft(code, request.student, request.to_draft())
        return Response(status_code=204)

    @router.post("/hints", **refusals(described(Hint, "A hint's text; its cost counts once"), 403, 404, 409))
    async def hints(code: Code, request: HintRequest) -> Response:
        rates.draft(request.student)
        desk = await classes.desk()
        return private(await desk.hint(code, request.student, request.step, request.hint))

    @router.get("/mine", **refusals(described(Mine, "Everything that is kept of me"), 403, 404))
    async def mine(code: Code, secret: Secret) -> Response:
        desk = await classes.desk()
        return private(await desk.mine(code, secret))

    @router.delete("/mine", **refusals(nothing("All that was kept of me is gone"), 403, 404))
    async def leave(code: Code, secret: Secret) -> Response:
        desk = await classes.desk()
        await desk.delete_mine(code, secret)
        return Response(status_code=204)

    no_others(router, "/mine", "GET", "DELETE")

    @router.get("/recording", **refusals(described_files("A recording of the student's rig", _CSV), 403, 404))
    async def recording(
        code: Code,
        secret: Secret,
        step: Annotated[str, Query(pattern=r"^[a-z0-9-]{1,40}$")],
    ) -> Response:
        desk = await classes.desk()
        content = await desk.recording(code, secret, step)
        return csv_response(content, f"heli2dof-{step}.csv")

    return router
