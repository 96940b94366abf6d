"""LTI 1.3: where platforms send browsers to, and this server's public keys. There is nothing here unless registered.

What is said to people are pages: a launch is a browser's own way, not a call of a program.
"""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import parse_qsl

from fastapi import APIRouter, Depends, Request, Response
from starlette.exceptions import HTTPException

from ..classes.errors import ClassError
from ..contract.encoding import json_response
from ..contract.lti import MembersReply
from ..contract.model import described
from ..edge.access import let_in
from ..lti.errors import LtiError
from ..lti.late import Lti
from ..ops.settings import Settings
from .class_calls import Code, Guesses, OwnOrigin, Rates, Secret, private, refusals

if TYPE_CHECKING:  # imported when the first platform asks
    from ..lti.pages import Pages
    from ..lti.tool import Tool

_MOST_FIELDS = 50
_KEYS_KEPT = {"Cache-Control": "public, max-age=600"}


def build_router(lti: Lti, settings: Settings, rates: Rates) -> APIRouter:
    """The routes of launches, and the call that tells who is in a course."""
    router = _launches(lti, settings)
    around = [Depends(OwnOrigin(settings.cors_origins)), Depends(Guesses(rates))]

    @router.get(
        "/api/v1/classes/{code}/members",
        tags=["classes"],
        dependencies=around,
        **refusals(
            described(MembersReply, "Who is in the course that the class is for (LTI)"), 403, 404, 502
        ),
    )
    async def members(code: Code, secret: Secret) -> Response:
        tool, _ = await _there(lti, settings)
        try:
            return private(await tool.members(code, secret))
        except LtiError as error:
            raise ClassError(error.status, error.message, error.code, hint=error.hint) from None

    return router


def _launches(lti: Lti, settings: Settings) -> APIRouter:
    router = APIRouter()

    @router.get("/lti/login", include_in_schema=False)
    @router.post("/lti/login", include_in_schema=False)
    async def login(request: Request) -> Response:
        """A platform says that somebody comes."""
        tool, pages = await _there(lti, settings)
        given = dict(request.query_params) | (await _form(request) if request.method == "POST" else {})
        try:
            return pages.begun(await tool.begin(given))
        except (LtiError, ClassError) as error:
            return _told(pages, error)

    @router.post("/lti/launch", include_in_schema=False)
    async def launch(request: Request) -> Response:
        """A platform says who it is."""
        tool, pages = await _there(lti, settings)
        reply = await _landed(tool, pages, request, await _form(request))
        _let_in(reply, request, settings)
        return reply

    @router.post("/lti/choose", include_in_schema=False)
    async def choose(request: Request) -> Response:
        """An instructor has chosen a lab."""
        from ..lti.tool import Landing

        tool, pages = await _there(lti, settings)
        form = await _form(request)
        try:
            made = await tool.choose(form.get("ticket", ""), form.get("lab", ""))
        except (LtiError, ClassError) as error:
            return _told(pages, error)
        reply = pages.landing(made) if isinstance(made, Landing) else pages.reply(made)
        _let_in(reply, request, settings)
        return reply

    @router.get("/lti/keys", include_in_schema=False)
    async def keys() -> Response:
        """This server's public keys."""
        from ..lti.keys import public_keys

        tool, _ = await _there(lti, settings)
        reply = json_response(public_keys(await tool.public_keys()))
        reply.headers.update(_KEYS_KEPT)
        return reply

    return router


async def _there(lti: Lti, settings: Settings) -> tuple[Tool, Pages]:
    """The tool and its pages.

    Raises:
        HTTPException: 404, where no platform is registered.
        ClassError: there is no database.
    """
    tool = await lti.tool()
    if tool is None or not await tool.platforms():
        raise HTTPException(404)
    from ..lti.pages import Pages

    return tool, Pages(settings.frame_ancestors)


def _let_in(reply: Response, request: Request, settings: Settings) -> None:
    """Opens a server that asks for an access token to who lands: the platform has said who they are."""
    if reply.status_code == 303 and settings.access_token is not None:
        token = settings.access_token.get_secret_value()
        let_in(reply, request.scope, token, settings.frame_ancestors)


async def _landed(tool: Tool, pages: Pages, request: Request, form: dict[str, str]) -> Response:
    """On to the place where somebody lands, or what is to be done before."""
    from ..lti.pages import key_of
    from ..lti.tool import Choice, Unbound

    token, state = form.get("id_token", ""), form.get("state", "")
    if "error" in form:
        words = "The platform does not say who you are: you may have been logged out there."
        return pages.told("Not opened", words, "Log in there and launch once more.", 403)
    if not token or not state:
        words = "This is where a learning platform opens a lab; it has not said which."
        return pages.told("Not opened", words, "Open the lab by its link in your course.", 400)
    proofs = [request.cookies.get(key_of(state), ""), form.get("proof", "")]
    try:
        landed = await tool.land(token, state, filter(None, proofs))
    except (LtiError, ClassError) as error:
        return _told(pages, error)
    if isinstance(landed, Unbound):
        return pages.unbound(landed, form)
    reply = pages.choice(landed) if isinstance(landed, Choice) else pages.landing(landed)
    pages.forget(reply, landed.platform, state)
    return reply


async def _form(request: Request) -> dict[str, str]:
    """The fields of a form, each once; empty where the body is none. The server's limits hold for its size."""
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind != "application/x-www-form-urlencoded":
        return {}
    try:
        text = (await request.body()).decode("utf-8")
        return dict(parse_qsl(text, keep_blank_values=True, max_num_fields=_MOST_FIELDS))
    except ValueError:
        return {}


def _told(pages: Pages, error: LtiError | ClassError) -> Response:
    if isinstance(error, ClassError):
        return pages.told("Not opened", error.detail, error.hint, error.status)
    return pages.told("Not opened", error.message, error.hint, error.status)
