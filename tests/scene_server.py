"""A small app with nothing but the scene, on a free port of the loopback, for several tests."""

from __future__ import annotations

import threading
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass
from pathlib import Path

import uvicorn
from fastapi import FastAPI
from fastapi.responses import HTMLResponse
from fastapi.staticfiles import StaticFiles

from app.scene import SceneSessions, build_router
from tests.patience import PATIENCE, until

STATIC = Path(__file__).resolve().parent.parent / "static"


@dataclass(frozen=True)
class SceneServer:
    """Where the app listens, below which path, and its sessions."""

    port: int
    sessions: SceneSessions
    prefix: str = ""

    @property
    def http(self) -> str:
        return f"http://127.0.0.1:{self.port}{self.prefix}"

    def socket(self, session: str) -> str:
        return f"ws://127.0.0.1:{self.port}{self.prefix}/scene/{session}"


@contextmanager
def serving(
    capacity: int = 8,
    idle_seconds: float = 45.0,
    evict_after_seconds: float = 5.0,
    host_page: str = "",
    prefix: str = "",
) -> Iterator[SceneServer]:
    """Run the app in a thread for as long as the context lasts."""
    sessions = SceneSessions(capacity, idle_seconds, evict_after_seconds)

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        async with sessions.running():
            yield

    app = FastAPI(lifespan=lifespan)
    app.include_router(build_router(sessions))
    app.mount("/static", StaticFiles(directory=STATIC))
    if host_page:
        app.add_route("/", lambda _: HTMLResponse(host_page))
    if prefix:
        inner, app = app, FastAPI(lifespan=lifespan)
        app.mount(prefix, inner)
    config = uvicorn.Config(app, host="127.0.0.1", port=0, log_level="warning", ws_per_message_deflate=False)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()
    until(lambda: server.started or not thread.is_alive(), "the server starts")
    try:
        yield SceneServer(server.servers[0].sockets[0].getsockname()[1], sessions, prefix)
    finally:
        server.should_exit = True
        thread.join(PATIENCE)
        assert not thread.is_alive(), "the server does not stop"
