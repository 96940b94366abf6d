"""One error shape everywhere: RFC 9457 problem objects, over HTTP and WebSocket alike."""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Callable, Mapping, Sequence
from json import JSONDecodeError
from typing import Any

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, Field, ValidationError
from starlette.exceptions import HTTPException

from heli2dof_core import Heli2DofError
from heli2dof_core.request import path_of

from ..classes.errors import ClassError
from ..jobs.fair_queue import BusyError, OverdueError
from ..jobs.workers import WorkerLostError
from ..ops.logs import request_id
from .encoding import json_bytes
from .fields import Strict

_LESS = "Ask for less: fewer rigs, a shorter experiment or a looser tolerance."
Page = Callable[[Request, Mapping[str, Any]], Response | None]
_log = logging.getLogger(__name__)

_CODES = {
    "extra_forbidden": ("unknown_field", "This field does not exist here; see /docs for those that do."),
    "missing": ("missing_field", "Give this field."),
    "json_invalid": ("invalid_json", "Send one JSON object."),
}
TITLES = {
    401: "Not allowed without the token",
    403: "Not allowed",
    404: "Not found",
    405: "Method not allowed",
    408: "Too slow",
    409: "Not in this state",
    413: "Too large",
    422: "Invalid input",
    429: "Too many requests",
    502: "Another server failed",
    503: "Not available now",
}
MEDIA_TYPE = "application/problem+json"
TEXT_START = '{"type":"urn:heli2dof:problem:'
"""How a problem object begins as text."""


class Problem(BaseModel):
    """What every error reply holds (RFC 9457), with code, field, value and hint added."""

    type: str = Field(description="identifies the kind of problem")
    title: str
    status: int = Field(description="HTTP status")
    detail: str = Field(description="what is wrong, in words")
    code: str = Field(description="stable name for programs")
    field: str = Field("", description="JSON path of the offending input")
    value: Any = Field(None, description="the offending value")
    hint: str = Field("", description="what to do")
    request_id: str = Field("", description="of the request, where the server failed: its log tells more")


_SOURCES = ("body", "query", "path")
_PLAIN = ("str", "float", "int", "bool")
_HANDLED = (
    *(Heli2DofError, RequestValidationError, HTTPException, ClassError),
    *(BusyError, OverdueError, WorkerLostError, MemoryError, Exception),
)


def problem(status: int, detail: str, code: str, **more: Any) -> dict[str, Any]:
    """A problem object; `more` may give field, value, hint and request_id, and nothing empty is kept."""
    known = {"type": f"urn:heli2dof:problem:{code}", "title": TITLES.get(status, "Error"), "status": status}
    extra = {name: _finite(value) for name, value in more.items() if value not in (None, "")}
    return {**known, "detail": _whole(detail), "code": code, **extra}


def _whole(text: str) -> str:
    """Text without halves of signs, which are no UTF-8."""
    return text.encode("utf-8", "replace").decode()


def _path_of(field: str) -> str:
    """The path in a request of what the core calls `field`, in another design of the request, too."""
    other = _OTHERS.match(field)
    begin = other.end() if other else 0
    return field[:begin] + path_of(field[begin:])


_OTHERS = re.compile(r"(pins\.\d+|flight\.(design|events\[\d+\]\[2\]))\.")


def problem_of(error: Exception) -> dict[str, Any]:  # noqa: PLR0911
    """The problem object of whatever a request may raise."""
    match error:
        case Heli2DofError():
            error.name_field(_path_of(error.field))
            return problem(
                422, f"{error}.", error.code, field=error.field, value=error.value, hint=error.hint
            )
        case RequestValidationError() | ValidationError():
            return _of_validation(_first(error.errors()))
        case ClassError():
            return problem(error.status, error.detail, error.code, hint=error.hint, **error.more)
        case JSONDecodeError():
            return problem(422, f"Not JSON: {error}.", "invalid_json", hint="Send one JSON object.")
        case BusyError() | OverdueError() | WorkerLostError() | MemoryError():
            return _of_slow_work(error)
        case HTTPException(status_code=400):  # FastAPI's own, for a body that its parser gives up on
            hint = "Send one JSON object in UTF-8, not nested a thousand deep."
            return problem(422, "The body is not JSON.", "invalid_json", hint=hint)
        case HTTPException():
            return problem(error.status_code, str(error.detail), f"http_{error.status_code}")
        case _:
            known = {"request_id": request_id.get()} if request_id.get() else {}
            return problem(500, "The server failed to answer; this is a bug.", "internal_error", **known)


def _of_slow_work(error: BusyError | OverdueError | WorkerLostError | MemoryError) -> dict[str, Any]:
    match error:
        case BusyError():
            return problem(503, str(error), "busy", hint=f"Ask again in {error.retry_after} s.")
        case OverdueError():
            return problem(503, str(error), "overdue", hint=_LESS)
        case WorkerLostError():
            return problem(503, str(error), "lost", hint=f"Ask again in {error.retry_after} s, or for less.")
        case MemoryError():
            return problem(
                503, "This takes more memory than the server gives it.", "too_much_memory", hint=_LESS
            )


def problem_response(body: Mapping[str, Any], headers: Mapping[str, str] | None = None) -> Response:
    """A problem object as an HTTP response."""
    return Response(json_bytes(body), body["status"], headers=headers, media_type=MEDIA_TYPE)


def install(app: FastAPI, page: Page = lambda _request, _body: None) -> None:
    """Makes every error of the app a problem object.

    Args:
        app: the application.
        page: makes a page of it where a person asks in a browser, else None.
    """

    async def answer(request: Request, error: Exception) -> Response:
        body = problem_of(error)
        if body["status"] == 500:
            # The template, since a scene's path is the secret of its session.
            route = getattr(request.scope.get("route"), "path", "(none)")
            _log.error("%s %s failed", request.method, route, exc_info=error)
        headers = error.headers if isinstance(error, HTTPException) else None
        wait = getattr(error, "retry_after", None)
        if not headers and (wait is not None or body["status"] == 503):
            headers = {"Retry-After": str(30 if wait is None else wait)}
        return page(request, body) or problem_response(body, headers)

    for kind in _HANDLED:
        app.add_exception_handler(kind, answer)
    _describe(app)


def _describe(app: FastAPI) -> None:
    """Puts into the OpenAPI document what each call may be refused with."""
    plain = app.openapi

    def openapi() -> dict[str, Any]:
        document = plain()
        schemas = document["components"]["schemas"]
        if "Problem" in schemas:
            return document
        schemas["Problem"] = Problem.model_json_schema()
        for name in ("HTTPValidationError", "ValidationError"):
            schemas.pop(name, None)
        content = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
        for operations in document["paths"].values():
            for operation in operations.values():
                takes_body = "requestBody" in operation
                takes_input = takes_body or operation.get("parameters")
                refusals = {413: takes_body, 422: takes_input, 429: True, 503: True}
                for status, may_be in refusals.items():
                    if may_be:
                        about = {"description": TITLES[status], "content": content}
                        if status in (429, 503):
                            about["headers"] = {
                                "Retry-After": {"schema": {"type": "integer"}, "description": "s"}
                            }
                        operation["responses"][str(status)] = about
        return document

    app.openapi = openapi


def _first(errors: Sequence[Mapping[str, Any]]) -> Mapping[str, Any]:
    """The error to tell: of a value that may be one thing or another, what is wrong with the one it is."""
    head = errors[0]
    if not (_is_branch(head["loc"][-1:]) and head["type"].endswith("_type")):
        return head
    place = head["loc"][:-1]
    same = (own for own in errors if own["loc"][: len(place)] == place)
    return next((own for own in same if not own["type"].endswith("_type")), head)


def _is_branch(parts: Sequence[Any]) -> bool:
    """Whether the last of these is no part of a request: what pydantic calls one of several kinds of a value."""
    if not parts or not isinstance(parts[-1], str):
        return False
    return parts[-1] in _PLAIN or "[" in parts[-1] or parts[-1] in _models(Strict)


def _models(base: type) -> set[str]:
    return {own.__name__ for own in base.__subclasses__()}.union(*map(_models, base.__subclasses__()))


def _of_validation(error: Mapping[str, Any]) -> dict[str, Any]:
    code, hint = _CODES.get(error["type"], ("invalid_input", ""))
    parts = error["loc"]
    own = [part for i, part in enumerate(parts) if i and not _is_branch(parts[i : i + 1])]
    if parts and parts[0] not in _SOURCES:  # else FastAPI's word for where it stood
        own.insert(0, parts[0])
    path = ".".join(map(str, own))
    field = "" if code == "invalid_json" else path
    message = error["msg"].removeprefix("Value error, ")
    detail = f"{field}: {message}." if field else f"{message}."
    return problem(422, detail, code, field=field, value=error.get("input"), hint=hint)


def _finite(value: Any, depth: int = 5) -> Any:
    """A value that JSON can carry: non-finite numbers and exotic objects as text, nothing long, nothing deep."""
    if depth == 0:
        return "…"
    if isinstance(value, Mapping):
        return {_whole(str(key)[:200]): _finite(item, depth - 1) for key, item in list(value.items())[:20]}
    if isinstance(value, (list, tuple)):
        return [_finite(item, depth - 1) for item in value[:20]]
    plain = value is None or isinstance(value, bool)
    small = (isinstance(value, float) and math.isfinite(value)) or (
        isinstance(value, int) and abs(value) < 2**63
    )
    if plain or small:
        return value
    return _whole(value[:2000] if isinstance(value, str) else str(value)[:200])
