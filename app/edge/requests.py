"""Each request's id, its line in the log and its place in the metrics."""

from __future__ import annotations

import logging
from time import perf_counter

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ..ops.logs import id_for, request_id
from ..ops.metrics import Metrics

_log = logging.getLogger("app.access")
_QUIET = frozenset(("/livez", "/healthz", "/metrics", "/static"))


def route_of(scope: Scope) -> str:
    """The template of the route that a request has found; few values, whatever is asked."""
    template = getattr(scope.get("route"), "path", None)
    if isinstance(template, str) and template:
        return template
    return "/static" if scope["path"].startswith(f"{scope.get('app_root_path', '')}/static/") else "(none)"


class Requests:
    """Gives every request and socket an id, and counts and logs requests when they are answered."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._next = app
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes on; a socket's frames pass untouched."""
        if scope["type"] not in ("http", "websocket"):
            await self._next(scope, receive, send)
            return
        known = id_for(Headers(scope=scope).get("x-request-id"))
        token = request_id.set(known)
        try:
            if scope["type"] == "http":
                await self._answer(scope, receive, send, known)
            else:
                await self._next(scope, receive, send)
        finally:
            request_id.reset(token)

    async def _answer(self, scope: Scope, receive: Receive, send: Send, known: str) -> None:
        began, status = perf_counter(), 0

        async def send_named(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                MutableHeaders(scope=message)["X-Request-ID"] = known
            await send(message)

        try:
            await self._next(scope, receive, send_named)
        except Exception:
            # Starlette raises again what it has answered and logged (see problems); nobody above needs it.
            if not status:
                raise
        finally:
            seconds, route = perf_counter() - began, route_of(scope)
            if status:  # none where the client has gone before
                self._metrics.request(scope["method"], route, status, seconds)
            quiet = route in _QUIET and (status < 400 or status == 503)
            self._log(scope, route, status, seconds, logging.DEBUG if quiet else logging.INFO)

    def _log(self, scope: Scope, route: str, status: int, seconds: float, level: int) -> None:
        if _log.isEnabledFor(level):
            method, told = scope["method"][:10], status or "unanswered"
            fields = {"method": method, "route": route, "status": status, "ms": round(seconds * 1e3, 2)}
            line = (level, "%s %s %s %.1f ms", method, route, told, seconds * 1e3)
            _log.log(*line, extra={"fields": fields})
