"""The application: routes, page, scene and what lives as long as the server does."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator
from typing import Any

from fastapi import FastAPI, Request, Response
from starlette.types import ASGIApp

from heli2dof_core.version import package_version

from . import scene
from .classes.late import Classes
from .contract import examples, problems
from .edge import policies
from .edge.connections import Connections
from .edge.limits import SocketCounts, read_in_small_parts
from .edge.middleware import with_middleware
from .edge.problem_page import problem_page
from .jobs.choice import workers_of
from .jobs.compute import Compute
from .lti.late import Lti
from .ops.cached_files import CachedFiles
from .ops.metrics import Metrics
from .ops.settings import Settings
from .routes import (
    catalogue,
    class_calls,
    class_members,
    classes,
    comparison,
    derivation,
    design,
    exports,
    find,
    flights,
    frequency,
    health,
    labs,
    live,
    lti,
    maps,
    motion,
    nearest,
    recordings,
    robustness,
    students,
    systems,
    tracks,
)

_DESCRIPTION = (
    "Pole placement for a two-degree-of-freedom laboratory helicopter. SI units: radians, volts, seconds. "
    "The live socket is at /api/v1/live."
)
_COMPUTED = (
    *(design, frequency, tracks, find, nearest, derivation),
    *(systems, comparison, maps, motion, flights),
)
"""Routes that need nothing but the core."""


class App(FastAPI):
    """FastAPI with what surrounds it: outside of starlette's own stack, so that its 500s pass there, too."""

    def __init__(
        self,
        settings: Settings,
        metrics: Metrics,
        connections: Connections,
        counts: SocketCounts,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self._middleware_options = (settings, metrics, connections, counts)

    def build_middleware_stack(self) -> ASGIApp:
        """Starlette's stack, with our middleware around it."""
        return with_middleware(super().build_middleware_stack(), *self._middleware_options)


def create_app(settings: Settings | None = None) -> FastAPI:
    """Builds the application; all state hangs on it, nothing is global."""
    settings = settings or Settings()
    metrics, connections, counts = Metrics(), Connections(), SocketCounts()
    compute = Compute(
        workers=workers_of(settings.workers, settings.worker_bytes, settings.dask, (__name__,)),
        most_waiting=settings.slow_waiting,
        most_each=settings.slow_each,
        seconds=settings.slow_seconds,
    )
    sessions = scene.SceneSessions(capacity=settings.scenes)
    kept = Classes(settings, compute)
    launches = Lti(settings, compute, kept)
    metrics.watch_sessions(lambda: len(sessions))
    metrics.watch_pools(lambda: compute.waiting, lambda: compute.running, lambda: compute.died)

    @contextlib.asynccontextmanager
    async def lifespan(_app: FastAPI) -> AsyncIterator[None]:
        read_in_small_parts()
        compute.start()
        async with sessions.running(), kept.running(), launches.running():
            yield
        compute.close()

    app = App(
        settings,
        metrics,
        connections,
        counts,
        title="heli2dof",
        version=package_version(),
        description=_DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
    )
    app.state.compute, app.state.metrics, app.state.connections = compute, metrics, connections
    app.state.socket_counts, app.state.sessions, app.state.classes = counts, sessions, kept
    app.state.lti = launches
    own_policy = {"Content-Security-Policy": policies.WORKER}
    files = CachedFiles(directory=settings.static, headers={"kernel/rigs_worker.js": own_policy})
    # First: these are asked for most, and each route that is tried costs time.
    app.mount("/static", files, name="static")
    app.include_router(health.build_router(compute, connections, metrics if settings.metrics else None))
    app.include_router(catalogue.build_router())
    for part in _COMPUTED:
        app.include_router(part.build_router(compute))
    app.include_router(recordings.build_router(compute, settings))
    app.include_router(exports.build_router(compute))
    rates = class_calls.Rates(settings)
    app.include_router(labs.build_router(kept))
    app.include_router(students.build_router(kept, settings, rates))
    app.include_router(class_members.build_router(kept, settings, rates))
    streams = class_calls.Streams(settings, counts)
    app.include_router(classes.build_router(kept, settings, rates, streams, lambda: connections.closing_idle))
    app.include_router(lti.build_router(launches, settings, rates))
    app.include_router(live.build_router(compute, metrics))
    app.include_router(robustness.build_router(compute, metrics))
    app.include_router(scene.build_views_router())
    app.include_router(scene.build_router(sessions, metrics, settings.frame_ancestors))
    problems.install(app, problem_page(settings.frame_ancestors))
    examples.install(app)

    _add_pages(app, settings, files)
    return app


def _add_pages(app: FastAPI, settings: Settings, files: CachedFiles) -> None:
    """The page, that of the API, and the icon; each with its policy."""

    def page_of(name: str, request: Request, policy: str) -> Response:
        return files.content(name).response(request.headers, {"Content-Security-Policy": policy})

    @app.get("/", include_in_schema=False)
    async def page(request: Request) -> Response:
        return page_of("index.html", request, policies.page(settings.frame_ancestors))

    @app.get("/class", include_in_schema=False)
    async def wall(request: Request) -> Response:
        return page_of("class.html", request, policies.page(settings.frame_ancestors))

    @app.get("/docs", include_in_schema=False)
    async def docs(request: Request) -> Response:
        return page_of("api_docs.html", request, policies.api_docs(settings.frame_ancestors))

    @app.get("/favicon.ico", include_in_schema=False)
    async def favicon(request: Request) -> Response:
        return files.content("favicon.svg").response(request.headers)
