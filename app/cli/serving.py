"""`heli2dof serve`: the app on a port, until a signal ends it in good order."""

from __future__ import annotations

import asyncio
import atexit
import errno
import logging
import math
import os
import signal
import socket
import sys
import threading
from pathlib import Path
from time import monotonic
from types import FrameType
from typing import Any

import click
import uvicorn
from pydantic import ValidationError

from heli2dof_core.version import package_version

from ..edge.connections import Connections
from ..edge.protocol import SocketProtocol
from ..main import create_app
from ..ops import logs
from ..ops.settings import Settings, complaint

_log = logging.getLogger(__name__)
_LARGEST_MESSAGE = 1 << 20
_FOR_SOCKETS, _FOR_REQUESTS = 0.63, 0.84
"""Shares of the settings' `grace` by which sockets are closed, and requests are answered or given up."""
_AT_LEAST = 0.1
"""The share that the sockets get on a machine so busy that the end begins late."""
_FOR_THE_LOCK = 2.0
"""Seconds more after which the process ends even where Python's lock is held."""
_ANY = ("0.0.0.0", "::")
_CONTAINERS = (Path("/.dockerenv"), Path("/run/.containerenv"))
"""There in a container, whose own address is of no use outside."""


def own_address() -> str | None:
    """The address that other machines of this network reach this one by; None where it cannot be told."""
    if any(mark.exists() for mark in _CONTAINERS):
        return None
    # A UDP socket that connects sends nothing: it asks which of the machine's addresses leads outside.
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asking:
        try:
            asking.connect(("10.255.255.255", 9))
        except OSError:  # no network
            return None
        address = str(asking.getsockname()[0])
    return None if address.startswith("127.") else address


class Server(uvicorn.Server):
    """Prints the address once the server answers, and ends in good order.

    After SIGTERM or SIGINT it is not ready any more (`/healthz`), but serves on for `drain` seconds, so that
    a proxy sees it. Then it listens no more; sockets get the answer that they wait for and a close with 1001,
    requests are answered. After `grace` seconds the process ends, whatever still computes; at a second signal at
    once.
    """

    def __init__(self, config: uvicorn.Config, connections: Connections, settings: Settings) -> None:
        super().__init__(config)
        self._connections = connections
        self._drain, self._grace = settings.drain, settings.grace
        self._prefix = settings.root_path
        self._until = math.inf

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Starts, then says where."""
        await super().startup(sockets)
        if self.started and sockets:
            host, port = sockets[0].getsockname()[:2]
            shown = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, host)
            print(f"heli2dof {package_version()} is ready: http://{shown}:{port}{self._prefix}", flush=True)
            if host in _ANY and (there := own_address()):
                print(f"From other machines of this network: http://{there}:{port}{self._prefix}", flush=True)

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """Ends in good order; at the second signal at once, by that signal."""
        if self.should_exit:
            signal.signal(sig, signal.SIG_DFL)
            signal.raise_signal(sig)
        # Not kept in uvicorn's list of signals, which it would raise again: this is a good end, with status 0.
        self.should_exit = True
        self._until = monotonic() + self._drain
        # Should something hold Python's lock, the thread below never runs. The system's alarm needs none: unhandled,
        # it ends the process.
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_REAL, self._drain + self._grace + _FOR_THE_LOCK)
            # Once all threads have ended, what is left is Python's own tidying up, and the end a good one.
            atexit.register(signal.setitimer, signal.ITIMER_REAL, 0)
        threading.Thread(target=self._end, name="end", daemon=True).start()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Says goodbye to sockets before uvicorn, which would cut them off, sees to the rest."""
        began = min(self._until, monotonic() + self._drain)  # infinite where no signal came, as in tests
        self._connections.shutting_down = True
        _log.info("ending: %d sockets are open", len(self._connections))
        await asyncio.sleep(max(began - monotonic(), 0.0))
        for server in self.servers:
            server.close()
        left = began + _FOR_SOCKETS * self._grace - monotonic()
        await self._connections.close_all(max(left, _AT_LEAST * self._grace))
        left = began + _FOR_REQUESTS * self._grace - monotonic()
        self.config.timeout_graceful_shutdown = max(math.ceil(left), 1)
        await super().shutdown(sockets)
        _log.info("ended after %.1f s", monotonic() - began)

    def _end(self) -> None:
        """Ends the process when its time is up: Python waits for threads that compute, however long."""
        threading.Event().wait(self._drain + self._grace)
        _log.warning("ending while something still computes")
        logging.shutdown()
        os._exit(0)


def listen(settings: Settings) -> int:
    """Serves until interrupted; returns the exit status."""
    try:
        bound = listener(settings)
    except OSError as error:
        why = "it is in use" if error.errno == errno.EADDRINUSE else error.strerror
        port = settings.port
        other = f"Try another one, as with --port {port + 1} (make serve: PORT={port + 1})."
        print(f"heli2dof: cannot listen on {settings.host} port {port}: {why}. {other}", file=sys.stderr)
        return 1
    app = create_app(settings)
    Server(server_config(app, settings), app.state.connections, settings).run([bound])
    # Python's own end waits for no daemon; who then still computes in LAPACK crashes, as it is unloaded under them.
    app.state.compute.close()  # once more where the start has failed
    app.state.compute.join()
    return 0


def listener(settings: Settings) -> socket.socket:
    """A socket bound to the settings' host and port.

    The connections that it accepts inherit TCP_NODELAY, without which an answer's body waits 40 ms for the client's
    acknowledgement of the header. asyncio sets it only on sockets that name their protocol, which these do not.

    Raises:
        OSError: the address is not to be had.
    """
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    bound = socket.socket(family, socket.SOCK_STREAM)
    bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    bound.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    try:
        bound.bind((settings.host, settings.port))
    except OSError:
        bound.close()
        raise
    return bound


def server_config(app: Any, settings: Settings) -> uvicorn.Config:
    """How uvicorn serves the app; the scene's relay relies on the socket settings."""
    return uvicorn.Config(
        app,
        log_config=None,
        log_level="warning",
        access_log=False,  # its lines hold addresses and queries; ours do not
        proxy_headers=False,  # see middleware.proxies
        server_header=False,
        ws=SocketProtocol,
        ws_max_size=_LARGEST_MESSAGE,
        ws_per_message_deflate=False,  # five times slower, and the frames are small
        ws_ping_interval=settings.ping,  # a client that is gone is dropped after twice that
        ws_ping_timeout=settings.ping,
        timeout_graceful_shutdown=5,
    )


@click.command()
@click.option("--host", help="Address to listen on, instead of $HELI2DOF_HOST or 127.0.0.1.")
@click.option("--port", type=int, help="TCP port, instead of $HELI2DOF_PORT, $PORT or 8000.")
@click.option("--scenes", type=int, help="Most 3D scenes at once, instead of $HELI2DOF_SCENES or 100.")
def serve(**options: Any) -> None:
    """Start the app and print its address; the README lists what the environment can set."""
    try:
        settings = Settings(**{name: value for name, value in options.items() if value is not None})
    except ValidationError as error:
        print(f"heli2dof: {complaint(error)}", file=sys.stderr)
        sys.exit(2)
    logs.configure(settings.log_format, settings.log_level)
    sys.exit(listen(settings))
