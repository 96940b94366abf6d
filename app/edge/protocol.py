"""uvicorn's WebSockets, with less work for each message."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from typing import Any

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.http11 import Request
from websockets.protocol import State

_EXTENSION = "heli2dof.waiting"
"""Where a socket's scope says whether messages wait."""
_BINARY, _SHORT, _MEDIUM = 0x82, 126, 1 << 16
"""First byte of a whole binary message, and the lengths from which a header is longer (RFC 6455, section 5.2)."""


class SocketProtocol(WebSocketsSansIOProtocol):
    """One socket of the server.

    uvicorn stops reading at every message until it is taken, at two calls of the system each; this one at the second
    that waits. Binary messages are copied once.
    """

    def handle_connect(self, event: Request) -> None:
        """Opens the socket; its scope says whether messages wait."""
        super().handle_connect(event)
        if self.response.status_code == 101:
            self.scope["extensions"][_EXTENSION] = {"waiting": self._waiting}  # pyright: ignore[reportOptionalSubscript, reportTypedDictNotRequiredAccess]

    def send_receive_event_to_app(self) -> None:
        """Leaves a message to be taken."""
        first = not self.read_paused and self.queue.empty()
        self.read_paused = self.read_paused or first  # which keeps uvicorn from stopping
        super().send_receive_event_to_app()
        if first:
            self.read_paused = False

    async def send(self, message: Any) -> None:
        """Sends a message."""
        data = message.get("bytes")
        if data is None or not self._open or not self.writable.is_set():
            await super().send(message)
            return
        size = len(data)
        if size < _SHORT:
            head = struct.pack("!BB", _BINARY, size)
        elif size < _MEDIUM:
            head = struct.pack("!BBH", _BINARY, 126, size)
        else:
            head = struct.pack("!BBQ", _BINARY, 127, size)
        self.transport.write(head + data)

    @property
    def _open(self) -> bool:
        whole = self.handshake_complete and self.initial_response is None and not self.conn.extensions
        return whole and not (self.disconnected or self.close_sent) and self.conn.state is State.OPEN

    def _waiting(self) -> bool:
        return not self.queue.empty()


def waiting_of(scope: Mapping[str, Any]) -> Callable[[], bool]:
    """Whether more messages of a socket wait to be received; that they do where nobody knows, as in tests."""
    known = scope.get("extensions", {}).get(_EXTENSION)
    return (lambda: True) if known is None else known["waiting"]
