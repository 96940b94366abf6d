"""A class for its instructor: made, shown, watched, changed, taken out, deleted."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query, Request, Response
from fastapi.responses import StreamingResponse

from ..classes.errors import ClassError
from ..classes.late import Classes
from ..contract.classes import (
    ClassAbout,
    ClassChanges,
    ClassExport,
    ClassHead,
    ClassReply,
    ClassRequest,
    NewClassReply,
    NewInstructorLink,
)
from ..contract.labs import LabView
from ..contract.model import described
from ..ops.settings import Settings
from .class_calls import (
    Code,
    Guesses,
    MayMake,
    OwnOrigin,
    Rates,
    Secret,
    Streams,
    csv_response,
    no_others,
    nothing,
    private,
    refusals,
)

Format = Annotated[str, Query(pattern="^(json|csv)$", description="`json` or `csv`")]
Target = Annotated[
    str, Query(alias="for", pattern="^(plain|moodle|canvas)$", description="of CSV: whose columns")
]


def build_router(
    classes: Classes, settings: Settings, rates: Rates, streams: Streams, ending: Callable[[], bool]
) -> APIRouter:
    """The routes of a class as a whole, under /api/v1/classes.

    Args:
        classes: the server's.
        settings: the server's.
        rates: how often calls are answered.
        streams: that are open.
        ending: whether the server ends, and with it every stream.
    """
    around = [Depends(OwnOrigin(settings.cors_origins)), Depends(Guesses(rates))]
    router = APIRouter(prefix="/api/v1/classes", tags=["classes"], dependencies=around)
    _add_making(router, classes, settings, rates)
    _add_showing(router, classes, streams, ending)
    _add_changing(router, classes)
    no_others(router, "/{code}", "GET", "PATCH", "DELETE")
    return router


def _add_making(router: APIRouter, classes: Classes, settings: Settings, rates: Rates) -> None:
    @router.post(
        "",
        dependencies=[Depends(MayMake(settings))],
        **refusals(described(NewClassReply, "A new class; its secret is told this once"), 401, 403, 404),
    )
    async def make(request: ClassRequest, asked: Request) -> Response:
        rates.make(asked)
        desk = await classes.desk()
        return private(await desk.make(request.lab, request.title, request.closes))

    @router.get(
        "/{code}/about", **refusals(described(ClassAbout, "What anyone is told who has the code"), 403, 404)
    )
    async def about(code: Code, asked: Request) -> Response:
        rates.try_code(asked, code)
        desk = await classes.desk()
        told = await desk.about(code)
        rates.was_right(asked, code)
        return private(told)


def _add_showing(router: APIRouter, classes: Classes, streams: Streams, ending: Callable[[], bool]) -> None:
    @router.get("/{code}", **refusals(_whole(), 403, 404))
    async def whole(
        code: Code,
        secret: Secret,
        format: Format = "json",  # noqa: A002
        target: Target = "plain",
    ) -> Response:
        desk = await classes.desk()
        if format == "csv":
            return csv_response(*await desk.sheet(code, secret, target))
        return private(await desk.snapshot(code, secret))

    @router.get("/{code}/events", **refusals(_stream(), 403, 404))
    async def events(code: Code, secret: Secret, asked: Request) -> Response:
        desk = await classes.desk()
        stream = streams.counted(asked, await desk.events(code, secret, ending))
        first = await anext(stream)  # what is refused is refused with its status
        headers = {"Cache-Control": "no-store, no-transform", "X-Accel-Buffering": "no"}
        return StreamingResponse(_joined(first, stream), media_type="text/event-stream", headers=headers)

    @router.get(
        "/{code}/lab",
        **refusals(described(LabView, "The lab with solutions and the instructor's text"), 403, 404),
    )
    async def lab(code: Code, secret: Secret) -> Response:
        desk = await classes.desk()
        return private(await desk.instructor_view(code, secret))

    @router.get("/{code}/export", **refusals(described(ClassExport, "All of the class"), 403, 404))
    async def export(code: Code, secret: Secret) -> Response:
        desk = await classes.desk()
        told = await desk.export(code, secret)
        name = {"Content-Disposition": f'attachment; filename="heli2dof-{told["code"]}.json"'}
        return private(told, name)


def _add_changing(router: APIRouter, classes: Classes) -> None:
    @router.patch("/{code}", **refusals(described(ClassHead, "The class as it is now"), 403, 404))
    async def change(code: Code, request: ClassChanges, secret: Secret) -> Response:
        changes = {name: getattr(request, name) for name in request.model_fields_set}
        for name in ("title", "open"):
            if name in changes and changes[name] is None:
                hint = "Leave it out to keep it."
                raise ClassError(422, f"{name}: null is none.", "invalid_input", hint=hint, field=name)
        desk = await classes.desk()
        return private(await desk.change(code, secret, changes))

    @router.post(
        "/{code}/instructor",
        **refusals(described(NewInstructorLink, "A new instructor's link; the old one ends"), 403, 404),
    )
    async def rotate(code: Code, secret: Secret) -> Response:
        desk = await classes.desk()
        return private(await desk.rotate(code, secret))

    @router.delete("/{code}", **refusals(nothing("The class is gone, with all that was in it"), 403, 404))
    async def delete(code: Code, secret: Secret) -> Response:
        desk = await classes.desk()
        await desk.delete_class(code, secret)
        return Response(status_code=204)


def _whole() -> dict[str, Any]:
    csv = {"text/csv": {"schema": {"type": "string"}}}
    told = {"model": ClassReply, "description": "The whole class", "content": csv}
    return {"summary": "The whole class; as CSV, too", "responses": {200: told}}


def _stream() -> dict[str, Any]:
    content = {"text/event-stream": {"schema": {"type": "string"}}}
    told = {"description": "A stream that goes on as long as somebody listens", "content": content}
    summary = "The class as server-sent events: `class` with all of it, then each `change`"
    return {"summary": summary, "responses": {200: told}, "response_class": Response}


async def _joined(first: bytes, rest: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
    yield first
    async for event in rest:
        yield event
