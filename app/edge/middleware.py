"""What stands between the network and the routes: plain ASGI, so that sockets pass at full speed."""

from __future__ import annotations

from starlette.middleware.cors import CORSMiddleware
from starlette.types import ASGIApp

from ..ops.metrics import Metrics
from ..ops.settings import Settings
from .access import Access
from .connections import Connections
from .headers import SafeHeaders
from .limits import Limits, SocketCounts
from .origins import Origins
from .proxies import Proxies
from .requests import Requests
from .sockets import Sockets

__all__ = ["with_middleware"]


def with_middleware(
    app: ASGIApp, settings: Settings, metrics: Metrics, connections: Connections, counts: SocketCounts
) -> ASGIApp:
    """The routes with all that surrounds them; what is written last comes first."""
    app = Sockets(app, metrics, connections)
    if settings.access_token is not None:
        app = Access(app, settings.access_token.get_secret_value(), settings.frame_ancestors)
    app = Limits(app, settings, counts)
    app = Origins(app, settings.cors_origins, settings.allowed_hosts, metrics)
    if settings.cors_origins:
        app = CORSMiddleware(
            app,
            allow_origins=settings.cors_origins,
            allow_methods=["GET", "POST", "PUT"],
            allow_headers=["Authorization", "Content-Type", "X-Request-ID"],
            expose_headers=["Content-Disposition", "Retry-After", "X-Request-ID"],
        )
    app = SafeHeaders(app)
    app = Requests(app, metrics)
    return Proxies(app, settings.trusted_proxies, settings.root_path)
