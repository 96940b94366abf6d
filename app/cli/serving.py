"""`heli2dof serve`: the app on a port."""

from __future__ import annotations

import errno
import logging
import socket
import sys

import click
import uvicorn

from heli2dof_core.version import package_version

from ..main import create_app
from ..settings import Settings

_LARGEST_MESSAGE = 1 << 20


class AnnouncingServer(uvicorn.Server):
    """Prints the address once the server answers."""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Starts, then says where."""
        await super().startup(sockets)
        if self.started and sockets:
            host, port = sockets[0].getsockname()[:2]
            shown = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, host)
            print(f"heli2dof {package_version()} is ready: http://{shown}:{port}", flush=True)


def listen(host: str, port: int, settings: Settings) -> int:
    """Serves until interrupted; returns the exit status."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
    except OSError as error:
        listener.close()
        why = "it is in use" if error.errno == errno.EADDRINUSE else error.strerror
        other = f"Try another one, as with --port {port + 1} (make serve: PORT={port + 1})."
        print(f"heli2dof: cannot listen on {host} port {port}: {why}. {other}", file=sys.stderr)
        return 1
    AnnouncingServer(server_config(settings)).run([listener])
    return 0


def server_config(settings: Settings) -> uvicorn.Config:
    """How uvicorn serves the app; the scene's relay relies on the socket settings."""
    return uvicorn.Config(
        create_app(settings),
        log_level="warning",
        ws="websockets-sansio",
        ws_max_size=_LARGEST_MESSAGE,
        ws_per_message_deflate=False,  # five times slower, and the frames are small
        ws_ping_interval=5.0,  # a client that is gone is dropped after 10 s
        ws_ping_timeout=5.0,
        timeout_graceful_shutdown=5,
    )


@click.command()
@click.option("--host", default="127.0.0.1", show_default=True, help="Address to listen on.")
@click.option(
    "--port", type=int, default=8000, envvar="PORT", show_default="8000, or $PORT", help="TCP port."
)
@click.option("--scenes", type=int, help="Most 3D scenes at once, instead of $HELI2DOF_SCENES or 100.")
def serve(host: str, port: int, scenes: int | None) -> None:
    """Start the app and print its address."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s")
    logging.getLogger("websockets").setLevel(logging.WARNING)
    try:
        status = listen(host, port, Settings() if scenes is None else Settings(scenes=scenes))
    except KeyboardInterrupt:  # uvicorn has shut down in good order and raises it again
        status = 0
    sys.exit(status)
