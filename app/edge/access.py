"""One token for the whole server: asked of pages by a form, of tools in a header."""

from __future__ import annotations

import hashlib
import hmac
from urllib.parse import parse_qsl, urlencode

from starlette.datastructures import Headers
from starlette.requests import Request, cookie_parser
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from ..contract.problems import problem
from . import policies
from .login_form import login_form
from .refusals import refuse

COOKIE = "heli2dof-access"
_PUBLIC_PATHS = frozenset(
    (
        *("/livez", "/healthz", "/favicon.ico", "/static/favicon.svg", "/static/css/login.css"),
        # Who comes from a registered platform has shown that already, and is let in as they land.
        *("/lti/login", "/lti/launch", "/lti/choose", "/lti/keys"),
        *("/static/lti/launch.js", "/static/lti/launch.css"),
    )
)
_MOST_FORM_BYTES = 4096
_COOKIE_SECONDS = 180 * 24 * 3600
"""Seconds that a browser keeps the cookie: a term."""


class Access:
    """Lets in who knows the token.

    A browser gets a cookie for it, which holds not the token but what only the token yields, and is the
    same on every replica. It goes to this server alone and no script can read it.

    Args:
        app: what comes next.
        token: the secret.
        ancestors: who may show the form in a frame; where that is another site, the cookie must be one
            that browsers send from there.
    """

    def __init__(self, app: ASGIApp, token: str, ancestors: tuple[str, ...]) -> None:
        self._next = app
        self._token = token.encode()
        self._cookie_value = _cookie_value(token).encode()
        self._ancestors = ancestors

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes on what may come in."""
        if scope["type"] not in ("http", "websocket") or self._is_authorized(scope):
            await self._next(scope, receive, send)
            return
        if (
            scope["type"] == "http"
            and (reply := await self._login_reply(Request(scope, receive))) is not None
        ):
            await reply(scope, receive, send)
            return
        body = problem(
            401,
            "This server asks for its access token.",
            "unauthorized",
            hint="Send Authorization: Bearer <token>.",
        )
        await refuse(scope, receive, send, body, {"WWW-Authenticate": 'Bearer realm="heli2dof"'})

    def _is_authorized(self, scope: Scope) -> bool:
        path = scope["path"].removeprefix(scope.get("root_path", ""))
        if path in _PUBLIC_PATHS:
            return True
        headers = Headers(scope=scope)
        kind, _, given = headers.get("authorization", "").partition(" ")
        if kind.lower() == "bearer" and self._is_token(given.strip()):
            # A link with the token in it still ends at an address without.
            return True
        cookie = cookie_parser(headers.get("cookie", "")).get(COOKIE, "")
        known = hmac.compare_digest(cookie.encode("utf-8", "replace"), self._cookie_value)
        return known and not (scope["type"] == "http" and _token_of(scope["query_string"]))

    def _is_token(self, given: str) -> bool:
        return hmac.compare_digest(given.encode("utf-8", "replace"), self._token)

    async def _login_reply(self, request: Request) -> Response | None:
        """What a person gets: the way in, or the form; None where a tool asks."""
        given = _token_of(request.scope["query_string"])
        form = request.headers.get("content-type", "").startswith("application/x-www-form-urlencoded")
        if request.method == "POST" and form:
            body = b""
            async for part in request.stream():
                body += part
                if len(body) > _MOST_FORM_BYTES:
                    return None
            given = dict(parse_qsl(body.decode("utf-8", "replace"))).get("token", "").strip() or " "
        elif request.method not in ("GET", "HEAD") or "text/html" not in request.headers.get("accept", ""):
            return None
        if given and self._is_token(given):
            return self._log_in(request)
        text = login_form(
            wrong=bool(given), root=request.scope.get("root_path", ""), path=request.scope["path"]
        )
        headers = {
            "Cache-Control": "no-store",
            "Content-Security-Policy": policies.login(self._ancestors),
            "WWW-Authenticate": 'Bearer realm="heli2dof"',
        }
        return Response(text, 401, headers, media_type="text/html")

    def _log_in(self, request: Request) -> Response:
        """Back to the same address, without the token; relative, since a proxy's prefix may be unknown."""
        query = urlencode([pair for pair in _pairs(request.scope["query_string"]) if pair[0] != "token"])
        last = request.scope["path"].rpartition("/")[2]
        reply = RedirectResponse(f"./{last}{'?' if query else ''}{query}", 303, {"Cache-Control": "no-store"})
        let_in(reply, request.scope, self._token.decode(), self._ancestors)
        return reply


def let_in(reply: Response, scope: Scope, token: str, ancestors: tuple[str, ...]) -> None:
    """Gives a browser the cookie with which it comes in.

    Args:
        reply: that sets it.
        scope: of the request.
        token: the server's.
        ancestors: who may show this server's pages in a frame.
    """
    secure = scope["scheme"] == "https"
    elsewhere = secure and any(not ancestor.startswith("'") for ancestor in ancestors)
    reply.set_cookie(
        COOKIE,
        _cookie_value(token),
        max_age=_COOKIE_SECONDS,
        path=scope.get("root_path", "") or "/",
        secure=secure,
        httponly=True,
        samesite="none" if elsewhere else "lax",
    )
    if elsewhere:
        # Of the site that frames this one: browsers drop other cookies there. The newest header is this one's.
        name, value = reply.raw_headers[-1]
        reply.raw_headers[-1] = name, value + b"; Partitioned"


def _cookie_value(token: str) -> str:
    return hmac.new(token.encode(), b"heli2dof cookie", hashlib.sha256).hexdigest()


def _pairs(query: bytes) -> list[tuple[str, str]]:
    return parse_qsl(query.decode("latin-1"), keep_blank_values=True)


def _token_of(query: bytes) -> str:
    return dict(_pairs(query)).get("token", "") if b"token=" in query else ""
