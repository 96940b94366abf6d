"""Whose pages may open sockets, and under which names the server answers.

A browser lets any page open a socket to any server and tells the page's origin; tools tell none.
"""

from __future__ import annotations

import logging
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from ..contract.problems import problem
from ..ops.metrics import Metrics
from .refusals import refuse

_log = logging.getLogger(__name__)
_PORTS = {"http": 80, "https": 443}


class Origins:
    """Refuses sockets of foreign origins with 403, and unknown hosts with 421.

    Args:
        app: what comes next.
        listed: origins that are allowed besides the server's own; `*`: all.
        hosts: names that are answered, `*.` before one for all below it; empty: any.
        metrics: counts what is refused.
    """

    def __init__(
        self, app: ASGIApp, listed: tuple[str, ...], hosts: tuple[str, ...], metrics: Metrics
    ) -> None:
        self._next = app
        self._listed = frozenset(listed)
        self._hosts = hosts
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes on what may come in."""
        if scope["type"] not in ("http", "websocket"):
            await self._next(scope, receive, send)
            return
        headers = Headers(scope=scope)
        host = headers.get("host", "")
        if self._hosts and not self._allows_host(host):
            await refuse(scope, receive, send, problem(421, "This server has another name.", "unknown_host"))
            return
        if scope["type"] == "websocket" and not self._allows_origin(
            headers.getlist("origin"), host, scope["scheme"]
        ):
            self._metrics.refused.labels("origin").inc()
            _log.warning("a socket of a foreign origin was refused")
            detail = "Pages of this origin may not open sockets here."
            hint = "The server's setting cors_origins lists those that may."
            await refuse(scope, receive, send, problem(403, detail, "foreign_origin", hint=hint))
            return
        await self._next(scope, receive, send)

    def _allows_origin(self, origins: list[str], host: str, scheme: str) -> bool:
        if not origins:
            return True
        if "*" in self._listed or all(origin.lower() in self._listed for origin in origins):
            return True
        return len(origins) == 1 and is_own(origins[0], host, scheme)

    def _allows_host(self, host: str) -> bool:
        name = _host_and_port(host, 0)
        if name is None:
            return False
        known = name[0]
        return any(known == h.strip("[]") or (h[0] == "*" and known.endswith(h[1:])) for h in self._hosts)


def is_own(origin: str, host: str, scheme: str) -> bool:
    """Whether an origin is the server's own.

    A server behind TLS that it does not know of sees plain requests, so that only an unencrypted page on
    an encrypted server is told by its scheme.

    Args:
        origin: of the Origin header, as https://lab.example:8443.
        host: of the Host header, as lab.example:8443.
        scheme: by which the server was asked: ws, wss, http or https.
    """
    kind, separator, rest = origin.partition("://")
    port = _PORTS.get(kind.lower())
    if not separator or port is None or (scheme in ("wss", "https") and kind.lower() != "https"):
        return False
    theirs = _host_and_port(rest, port)
    return theirs is not None and theirs == _host_and_port(host, port)


def _host_and_port(text: str, default: int) -> tuple[str, int] | None:
    """Name in lower case and port; None of what is none."""
    try:
        parts = urlsplit(f"//{text}")
        if parts.netloc != text or "@" in text or not parts.hostname:
            return None
        return parts.hostname, default if parts.port is None else parts.port
    except ValueError:
        return None
