"""The whole app as `heli2dof serve` runs it, on a free port of the loopback, in a thread."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import uvicorn

from app.cli.serving import listener, server_config
from app.main import create_app
from app.ops.settings import Settings
from tests.patience import PATIENCE, until


@dataclass(frozen=True)
class WholeServer:
    """Where the app listens, and the app."""

    port: int
    app: Any

    @property
    def http(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    def socket(self, path: str) -> str:
        return f"ws://127.0.0.1:{self.port}{path}"


@contextmanager
def serving(**settings: Any) -> Iterator[WholeServer]:
    """Run the app for as long as the context lasts; it has derived and compiled everything when it begins."""
    chosen = Settings(host="127.0.0.1", port=0, **settings)
    app = create_app(chosen)
    server = uvicorn.Server(server_config(app, chosen))
    bound = listener(chosen)
    port = bound.getsockname()[1]
    thread = threading.Thread(target=server.run, args=([bound],), daemon=True)
    thread.start()
    until(lambda: server.started or not thread.is_alive(), "the server starts")
    try:
        until(lambda: app.state.compute.compiled, "all is derived and compiled")
        yield WholeServer(port, app)
    finally:
        server.should_exit = True
        thread.join(PATIENCE)
        assert not thread.is_alive(), "the server does not stop"
