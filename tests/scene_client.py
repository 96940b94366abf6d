"""What a visitor of a scene does over the wire."""

import urllib.error
import urllib.parse
import urllib.request
from typing import Any

import msgspec
import zstandard
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol

from tests.scene_server import SceneServer

VISER = "viser-v1.1.1"
CAMERA: dict[str, Any] = {
    "type": "ViewerCameraMessage",
    "wxyz": [1.0, 0.0, 0.0, 0.0],
    "position": [1, 0, 0.5],
    "fov": 0.7,
    "near": 0.01,
    "far": 100,
    "image_height": 330,
    "image_width": 420,
    "look_at": [0.0, 0.0, 0.3],
    "up_direction": [0.0, 0.0, 1.0],
}
encode = msgspec.msgpack.encode


def session_id(name: str) -> str:
    return name.ljust(22, "_")


def watch(server: SceneServer, name: str, protocol: str = VISER) -> Connection:
    return connect(
        server.socket(session_id(name)),
        subprotocols=[Subprotocol(protocol)],
        compression=None,
        max_size=None,
        proxy=None,
    )


def messages(frame: str | bytes) -> list[dict[str, Any]]:
    """The messages in one of viser's frames, without their binary buffers."""
    assert isinstance(frame, bytes)
    size = int.from_bytes(frame[8:16], "little")
    header = zstandard.ZstdDecompressor().decompress(
        frame[16 : 16 + size], max_output_size=int.from_bytes(frame[:8], "little")
    )
    return msgspec.msgpack.decode(header)["messages"]


def replay(socket: Connection) -> list[dict[str, Any]]:
    """Everything a new visitor is told until the scene is complete."""
    told: list[dict[str, Any]] = []
    while not any(message["type"] == "ReplayDoneMessage" for message in told):
        told += messages(socket.recv(timeout=20))
    return told


def put_rig(server: SceneServer, name: str, body: str) -> tuple[int, dict[str, str]]:
    request = urllib.request.Request(
        f"{server.http}/scene/{session_id(name)}/rig", data=body.encode(), method="PUT"
    )
    request.add_header("Content-Type", "application/json")
    return answer(request)


def answer(request: str | urllib.request.Request) -> tuple[int, dict[str, str]]:
    try:
        with urllib.request.urlopen(request, timeout=20) as response:
            return response.status, dict(response.headers)
    except urllib.error.HTTPError as error:
        with error:
            return error.code, dict(error.headers)


def closed(socket: Connection) -> bool:
    try:
        socket.recv(timeout=0.01)
    except TimeoutError:
        return False
    except ConnectionClosed:
        return True
    return False
