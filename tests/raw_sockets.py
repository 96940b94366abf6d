"""WebSockets by hand: after the handshake anything may be sent, and nothing need be read."""

from __future__ import annotations

import socket
import struct
from base64 import b64encode

from tests.patience import PATIENCE


def shaken(port: int, path: str, *options: tuple[int, int, int]) -> socket.socket:
    """A socket of this machine after its handshake; `options` as for `setsockopt`, set before it connects."""
    peer = socket.socket()
    for option in options:
        peer.setsockopt(*option)
    peer.settimeout(PATIENCE)
    peer.connect(("127.0.0.1", port))
    key = b64encode(bytes(16)).decode()
    head = f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    peer.sendall(f"{head}Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
    reply = b""
    while b"\r\n\r\n" not in reply:
        reply += peer.recv(1)  # what follows is the first frame's
    assert b" 101 " in reply
    return peer


def frame(payload: bytes, opcode: int = 1) -> bytes:
    """A client's frame, its mask all zeros."""
    n = len(payload)
    head = bytes([0x80 | opcode])
    head += bytes([0x80 | n]) if n < 126 else bytes([0x80 | 127]) + struct.pack("!Q", n)
    return head + bytes(4) + payload
