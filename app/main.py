"""The application: routes, page, scene and what lives as long as the server does."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator
from typing import Any

from fastapi import FastAPI, Response
from fastapi.openapi.docs import get_swagger_ui_html
from fastapi.responses import FileResponse
from fastapi.staticfiles import StaticFiles

from heli2dof_core.version import package_version

from . import examples, live, problems, robustness, scene
from .compute import Compute
from .limits import Limits, OpenSockets, read_in_small_parts
from .routes import catalogue, comparison, derivation, design, exports, frequency, recording, recordings
from .settings import Settings

_DESCRIPTION = (
    "Pole placement for a two-degree-of-freedom laboratory helicopter. SI units: radians, volts, seconds. "
    "The live socket is at /api/v1/live."
)


def create_app(settings: Settings | None = None) -> FastAPI:
    """Builds the application; all state hangs on it, nothing is global."""
    settings = settings or Settings()
    compute = Compute(
        slow_threads=settings.slow_threads,
        most_waiting=settings.slow_waiting,
        most_each=settings.slow_each,
        seconds=settings.slow_seconds,
    )
    sessions = scene.SceneSessions(capacity=settings.scenes)

    @contextlib.asynccontextmanager
    async def lifespan(_app: FastAPI) -> AsyncIterator[None]:
        read_in_small_parts()
        compute.start()
        async with sessions.running():
            yield
        compute.close()

    app = FastAPI(
        title="heli2dof",
        version=package_version(),
        description=_DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
    )
    app.state.compute, app.state.sessions = compute, sessions
    app.include_router(catalogue.build_router(compute))
    app.include_router(design.build_router(compute))
    app.include_router(frequency.build_router(compute))
    app.include_router(derivation.build_router(compute))
    app.include_router(comparison.build_router(compute))
    app.include_router(recording.build_router(compute))
    app.include_router(recordings.build_router(compute, settings))
    app.include_router(exports.build_router(compute))
    app.include_router(live.build_router(compute))
    app.include_router(robustness.build_router(compute))
    app.include_router(scene.build_views_router())
    app.include_router(scene.build_router(sessions))
    app.mount("/static", RevalidatedFiles(directory=settings.static), name="static")
    problems.install(app)
    examples.install(app)
    app.state.limits = OpenSockets()
    app.add_middleware(Limits, settings=settings, sockets=app.state.limits)

    @app.get("/", include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(settings.static / "index.html", headers={"Cache-Control": "no-cache"})

    @app.get("/docs", include_in_schema=False)
    async def docs() -> Response:
        swagger = "static/vendor/swagger-ui-dist"
        return get_swagger_ui_html(
            openapi_url="openapi.json",
            title="heli2dof: REST API",
            swagger_js_url=f"{swagger}/swagger-ui-bundle.js",
            swagger_css_url=f"{swagger}/swagger-ui.css",
            swagger_favicon_url="static/favicon.svg",
        )

    @app.get("/favicon.ico", include_in_schema=False)
    async def favicon() -> FileResponse:
        return FileResponse(settings.static / "favicon.svg", media_type="image/svg+xml")

    return app


class RevalidatedFiles(StaticFiles):
    """Static files that browsers ask about again (ETag), so that an upgrade shows at once."""

    def file_response(self, *args: Any, **kwargs: Any) -> Response:
        """As starlette does, with no-cache."""
        response = super().file_response(*args, **kwargs)
        response.headers["Cache-Control"] = "no-cache"
        return response
