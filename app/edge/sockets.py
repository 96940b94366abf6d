"""Open sockets: counted, logged at their beginning and end, and sent away when the server ends."""

from __future__ import annotations

import logging
from time import perf_counter

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ..contract.problems import problem
from ..ops.metrics import Metrics
from .connections import SCOPE_KEY, Connections
from .refusals import refuse
from .requests import route_of

_log = logging.getLogger("app.access")


class Sockets:
    """Keeps the connections; costs each message two plain calls."""

    def __init__(self, app: ASGIApp, metrics: Metrics, connections: Connections) -> None:
        self._next = app
        self._metrics = metrics
        self._connections = connections

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes on, for as long as the socket is open."""
        if scope["type"] != "websocket":
            await self._next(scope, receive, send)
            return
        if self._connections.closing_idle:
            gone = problem(503, "The server is shutting down.", "going_away", hint="Try again in a moment.")
            await refuse(scope, receive, send, gone, {"Retry-After": "1"})
            return
        await self._track(scope, receive, send)

    async def _track(self, scope: Scope, receive: Receive, send: Send) -> None:
        connections, connection = self._connections, self._connections.add(send)
        scope[SCOPE_KEY] = connection
        began, route, code = perf_counter(), "", 0

        async def receive_open() -> Message:
            nonlocal code
            while True:
                message = await receive()
                if message["type"] == "websocket.disconnect":
                    code = code or message.get("code", 0)
                elif connections.closing_idle and message["type"] == "websocket.receive":
                    continue  # too late; a page asks again where it comes next
                return message

        async def send_open(message: Message) -> None:
            nonlocal code, route
            if connection.closed:
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
            connections.remove(connection)
            if route:
                self._metrics.sockets.labels(route).dec()
                seconds, last = perf_counter() - began, 1001 if connection.closed else code
                fields = {"route": route, "event": "closed", "code": last, "s": round(seconds, 1)}
                _log.info(
                    "socket %s closed with %s after %.1f s", route, last, seconds, extra={"fields": fields}
                )
