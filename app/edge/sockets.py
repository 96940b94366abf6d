"""Open sockets: counted, logged at their beginning and end, and sent away when the server ends."""

from __future__ import annotations

import logging
from time import perf_counter

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ..contract.problems import problem
from ..ops.metrics import Metrics
from .refusals import refuse
from .requests import route_of
from .visits import KEY, Visits

_log = logging.getLogger("app.access")


class Sockets:
    """Keeps the visits; costs each message two plain calls."""

    def __init__(self, app: ASGIApp, metrics: Metrics, visits: Visits) -> None:
        self._next = app
        self._metrics = metrics
        self._visits = visits

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes on, for as long as the socket is open."""
        if scope["type"] != "websocket":
            await self._next(scope, receive, send)
            return
        if self._visits.leaving:
            gone = problem(503, "The server is shutting down.", "going_away", hint="Try again in a moment.")
            await refuse(scope, receive, send, gone, {"Retry-After": "1"})
            return
        await self._attend(scope, receive, send)

    async def _attend(self, scope: Scope, receive: Receive, send: Send) -> None:
        visits, visit = self._visits, self._visits.enter(send)
        scope[KEY] = visit
        began, route, code = perf_counter(), "", 0

        async def receive_open() -> Message:
            nonlocal code
            while True:
                message = await receive()
                if message["type"] == "websocket.disconnect":
                    code = code or message.get("code", 0)
                elif visits.leaving and message["type"] == "websocket.receive":
                    continue  # too late; a page asks again where it comes next
                return message

        async def send_open(message: Message) -> None:
            nonlocal code, route
            if visit.left:
                return  # nobody hears it any more
            kind = message["type"]
            if kind == "websocket.accept":
                route = route_of(scope)
                self._metrics.sockets.labels(route).inc()
                _log.info("socket %s opened", route, extra={"fields": {"route": route, "event": "opened"}})
            elif kind == "websocket.close":
                code = code or message.get("code", 1000)
            await send(message)

        try:
            await self._next(scope, receive_open, send_open)
        finally:
            visits.exit(visit)
            if route:
                self._metrics.sockets.labels(route).dec()
                seconds, last = perf_counter() - began, 1001 if visit.left else code
                fields = {"route": route, "event": "closed", "code": last, "s": round(seconds, 1)}
                _log.info(
                    "socket %s closed with %s after %.1f s", route, last, seconds, extra={"fields": fields}
                )
