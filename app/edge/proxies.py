"""What a proxy in front says of the client: believed of known proxies alone."""

from __future__ import annotations

from starlette.types import ASGIApp, Receive, Scope, Send
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware


class Proxies:
    """Puts the client's address and scheme (uvicorn's part), host and the path prefix into the scope.

    Args:
        app: what comes next.
        trusted: addresses or networks of proxies.
        root_path: prefix of all addresses, whether the proxy strips it or not.
    """

    def __init__(self, app: ASGIApp, trusted: tuple[str, ...], root_path: str) -> None:
        # uvicorn's types of ASGI and starlette's differ by name alone.
        self._next = ProxyHeadersMiddleware(app, list(trusted))  # pyright: ignore[reportArgumentType]
        self._root_path = root_path

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes on what is asked, as the client asked it."""
        if scope["type"] in ("http", "websocket"):
            client = scope.get("client")
            if client and client[0] in self._next.trusted_hosts:
                _forward_host(scope)
            prefix = self._root_path
            if prefix:
                path = scope["path"]
                if path != prefix and not path.startswith(f"{prefix}/"):
                    scope["path"] = prefix + path
                scope["root_path"] = prefix
        await self._next(scope, receive, send)  # pyright: ignore[reportArgumentType]


def _forward_host(scope: Scope) -> None:
    forwarded = next((value for name, value in scope["headers"] if name == b"x-forwarded-host"), None)
    if forwarded:
        host = forwarded.split(b",")[0].strip()  # the first is what the client asked for
        scope["headers"] = [(b"host", host), *((n, v) for n, v in scope["headers"] if n != b"host")]
