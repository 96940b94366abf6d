"""Carries viser's WebSocket between a client and the session's own server on the loopback.

Towards the client everything passes. From the client only what a viewer must send passes: viser
trusts its clients, so made-up messages could open a public tunnel or fill its memory.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import msgspec
from fastapi import WebSocket, WebSocketDisconnect
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from ..edge.bucket import Bucket
from ..edge.messages import close, first_to_end
from ..ops.metrics import Metrics

LARGEST_MESSAGE = 64 * 1024
"""Bytes; a viewer's own messages take a few hundred."""

_UNSUPPORTED_DATA, _TOO_BIG, _TRY_LATER = 1003, 1009, 1013
_QUEUED_FRAMES = 4
RATE, BURST = 120.0, 240.0
"""Messages a second that a client may send, and how many at once; a viewer that is turned sends thirty. Whoever comes
too fast waits, so that the network's own buffers fill and the sender waits, too."""
_Quaternion = tuple[float, float, float, float]
_Vector = tuple[float, float, float]


class _ViewerCamera(msgspec.Struct, tag_field="type", tag="ViewerCameraMessage", forbid_unknown_fields=True):
    """Where the client looks from; viser counts a client as present from its first one."""

    wxyz: _Quaternion
    position: _Vector
    fov: float
    near: float
    far: float
    image_height: int
    image_width: int
    look_at: _Vector
    up_direction: _Vector


class _GuiUpdate(msgspec.Struct, tag_field="type", tag="GuiUpdateMessage", forbid_unknown_fields=True):
    """Something was set at the panel."""

    uuid: str
    updates: dict[str, Any]


UpdateFilter = Callable[[str, dict[str, Any]], dict[str, Any] | None]
"""Returns what may be set of an element with this id, or None."""

# The allow-list.
_decoder = msgspec.msgpack.Decoder(_ViewerCamera | _GuiUpdate)
_encoder = msgspec.msgpack.Encoder()


def allowed_frame(frame: bytes, filter_update: UpdateFilter = lambda _id, _updates: None) -> bytes | None:
    """Return what viser may have of a client's frame, or None.

    A well-formed message that a viewer must send passes as it is. What is set at the panel is written
    anew, as far as `filter_update` lets it.
    """
    if len(frame) >= LARGEST_MESSAGE:
        return None
    try:
        message = _decoder.decode(frame)
    except msgspec.MsgspecError:
        return None
    if isinstance(message, _ViewerCamera):
        return frame
    updates = filter_update(message.uuid, message.updates)
    return None if updates is None else _encoder.encode(_GuiUpdate(message.uuid, updates))


def viser_subprotocol(offered: list[str]) -> str | None:
    """Return the offered subprotocol by which viser compares versions, if there is one."""
    return next((name for name in offered if name.startswith("viser-v")), None)


async def relay(
    client: WebSocket,
    port: int,
    filter_update: UpdateFilter = lambda _id, _updates: None,
    metrics: Metrics | None = None,
) -> None:
    """Carry frames both ways until either side closes, then close the other.

    Args:
        client: an accepted WebSocket.
        port: of the viser server on the loopback.
        filter_update: says what may be set at the panel.
        metrics: counts what passes and what does not.
    """
    metrics = metrics or Metrics()
    protocol = viser_subprotocol(client.scope["subprotocols"])
    try:
        upstream = await connect(
            f"ws://127.0.0.1:{port}",
            subprotocols=[Subprotocol(protocol)] if protocol else None,
            compression=None,
            max_size=None,
            # A slow client stops our reading, the kernel's buffers fill, and viser waits.
            max_queue=_QUEUED_FRAMES,
            proxy=None,
        )
    except (OSError, InvalidHandshake, TimeoutError):
        await close(client, _TRY_LATER, "the scene is not reachable")
        return
    async with upstream:
        ended = await first_to_end(
            _to_client(upstream, client, metrics), _to_viser(client, upstream, filter_update, metrics)
        )
    code, reason = ended.result()
    await close(client, code, reason)


async def _to_client(upstream: ClientConnection, client: WebSocket, metrics: Metrics) -> tuple[int, str]:
    """Carry viser's frames to the client; return how to close the client."""
    try:
        async for frame in upstream:
            if isinstance(frame, bytes):
                await client.send_bytes(frame)
                metrics.scene_down.inc()
    except (ConnectionClosed, WebSocketDisconnect, RuntimeError):
        pass
    # 1005 and 1006 describe a missing close frame and may not be sent in one.
    code = upstream.close_code
    if code is None or code in (1005, 1006):
        code = 1001
    return code, upstream.close_reason or "the scene was stopped"


async def _to_viser(
    client: WebSocket, upstream: ClientConnection, filter_update: UpdateFilter, metrics: Metrics
) -> tuple[int, str]:
    """Carry the client's admissible frames to viser; return how to close the client."""
    bucket = Bucket(RATE, BURST)
    while True:
        message = await client.receive()
        if message["type"] == "websocket.disconnect":
            return 1000, ""
        frame = message.get("bytes")
        if frame is None:
            return _UNSUPPORTED_DATA, "binary frames only"
        if len(frame) >= LARGEST_MESSAGE:
            return _TOO_BIG, f"messages of {LARGEST_MESSAGE} bytes or more are refused"
        if wait := bucket.take(in_advance=True):
            await asyncio.sleep(wait)
        passed = allowed_frame(frame, filter_update)
        (metrics.scene_refused if passed is None else metrics.scene_up).inc()
        if passed is not None:
            try:
                await upstream.send(passed)
            except ConnectionClosed:
                return 1001, "the scene was stopped"
