"""The scene over the wire: page, socket, allow-list, isolation, capacity and idle sessions."""

import asyncio
import gc
import re
import socket
import threading
import time
import urllib.error
import urllib.parse
import urllib.request
import weakref
from collections.abc import Iterator
from typing import Any

import msgspec
import pytest
import zstandard
from fastapi import FastAPI, WebSocket
from starlette.types import Message
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol

from app.scene import SceneSessions, sessions
from app.scene.relay import LARGEST_MESSAGE, admissible, relay
from tests.scene_server import SceneServer, serving, until

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


@pytest.fixture(scope="module")
def server() -> Iterator[SceneServer]:
    with serving() as running:
        yield running


def test_page_runs_the_shim_before_visers_own_script(server: SceneServer):
    with urllib.request.urlopen(f"{server.http}/scene/{session_id('page')}/") as response:
        page = response.read().decode()
    shim = page.index('<script src="../../static/scene_shim.js">')
    assert shim < page.index("<script data-p=")
    assert "[data-floating-window]" in page
    assert answer(f"{server.http}/static/scene_shim.js")[0] == 200


def test_page_is_compressed_and_not_sent_twice(server: SceneServer):
    url = f"{server.http}/scene/{session_id('page')}/"
    _, headers = answer(urllib.request.Request(url, headers={"Accept-Encoding": "gzip"}))
    assert headers["content-encoding"] == "gzip"
    again = urllib.request.Request(url, headers={"If-None-Match": headers["etag"]})
    assert answer(again)[0] == 304


def test_page_alone_starts_no_session(server: SceneServer):
    before = len(server.sessions)
    assert answer(f"{server.http}/scene/{session_id('nobody')}/")[0] == 200
    assert len(server.sessions) == before


def test_page_without_slash_redirects_to_the_page(server: SceneServer):
    url = f"{server.http}/scene/{session_id('page')}"
    with urllib.request.urlopen(url, timeout=20) as response:
        assert response.url == url + "/"


@pytest.mark.parametrize("bad", ["short", "x" * 65, "spaces%20and%20more%20characters", "ä" * 22])
def test_what_cannot_be_a_session_is_not_found(server: SceneServer, bad: str):
    bad = urllib.parse.quote(bad, safe="%")
    assert answer(f"{server.http}/scene/{bad}/")[0] == 404
    request = urllib.request.Request(
        f"{server.http}/scene/{bad}/rig",
        data=b'{"rig": "aero"}',
        method="PUT",
        headers={"Content-Type": "application/json"},
    )
    assert answer(request)[0] == 404
    with pytest.raises(Exception, match="HTTP 403"):
        connect(f"ws://127.0.0.1:{server.port}/scene/{bad}", proxy=None)


def test_visitor_is_told_the_whole_scene(server: SceneServer):
    with watch(server, "replay") as socket:
        assert socket.subprotocol == VISER
        names = {message.get("name") for message in replay(socket)}
    assert {"/rig/yoke", "/rig/yoke/body", "/rig/yoke/body/pitch_rotor"} <= names
    assert {"/rig/yoke/body/yaw_rotor", "/ghost/yoke", "/ghost/yoke/body"} <= names


def test_another_version_of_the_client_is_sent_away_with_visers_own_words(server: SceneServer):
    with watch(server, "version", "viser-v0.0.1") as socket:
        with pytest.raises(ConnectionClosed):
            socket.recv(timeout=20)
        assert socket.close_code == 1002
        assert "0.0.1" in (socket.close_reason or "")


def test_camera_reaches_viser(server: SceneServer):
    with watch(server, "camera") as socket:
        replay(socket)
        socket.send(encode({"type": "ShareUrlRequest"}))
        socket.send(encode(CAMERA))
        viser = server.sessions.server(session_id("camera"))
        assert viser is not None
        until(viser.get_clients, "viser counts the visitor")
        assert viser.request_share_url() is None


def test_camera_is_admissible():
    assert admissible(encode(CAMERA)) == encode(CAMERA)


@pytest.mark.parametrize(
    "frame",
    [
        pytest.param(encode({"type": "ShareUrlRequest"}), id="share tunnel"),
        pytest.param(encode({"type": "GuiFormDirtyMessage", "uuid": "x"}), id="made-up form"),
        pytest.param(encode(CAMERA | {"extra": 1}), id="unknown field"),
        pytest.param(encode(CAMERA | {"fov": "wide"}), id="wrong kind"),
        pytest.param(encode({k: v for k, v in CAMERA.items() if k != "far"}), id="field missing"),
        pytest.param(encode([CAMERA]), id="not a map"),
        pytest.param(encode(CAMERA)[:-3], id="cut off"),
        pytest.param(b"", id="empty"),
        pytest.param(encode(CAMERA | {"wxyz": [0.0] * LARGEST_MESSAGE}), id="large"),
    ],
)
def test_nothing_else_is_admissible(frame: bytes):
    assert admissible(frame, lambda _id, updates: None) is None


@pytest.mark.parametrize(("frame", "code"), [(b"\0" * LARGEST_MESSAGE, 1009), ("text", 1003)])
def test_frames_that_no_viewer_sends_end_the_connection(server: SceneServer, frame: str | bytes, code: int):
    with watch(server, "rude") as socket:
        replay(socket)
        socket.send(frame)
        until(lambda: closed(socket), "the connection ends")
        assert socket.close_code == code


def closed(socket: Connection) -> bool:
    try:
        socket.recv(timeout=0.01)
    except TimeoutError:
        return False
    except ConnectionClosed:
        return True
    return False


def test_sessions_have_their_own_rigs(server: SceneServer):
    assert put_rig(server, "apart-a", '{"rig": "aero"}')[0] == 204
    with watch(server, "apart-a") as aero, watch(server, "apart-b") as helicopter:
        pivots = []
        for socket in (aero, helicopter):
            told = replay(socket)
            pivots += [
                message["position"][2]
                for message in told
                if message["type"] == "SetPositionMessage" and message["name"] == "/rig/yoke/body"
            ]
    assert pivots == pytest.approx([0.295, 0.364])


def test_rig_changes_for_those_who_watch_and_only_when_it_differs(server: SceneServer):
    with watch(server, "change") as socket:
        replay(socket)
        assert put_rig(server, "change", '{"rig": "helicopter"}')[0] == 204
        assert put_rig(server, "change", '{"rig": "aero"}')[0] == 204
        told: list[dict[str, Any]] = []
        while not any(m.get("name") == "/ghost/yoke/body/shape" for m in told):
            told += messages(socket.recv(timeout=20))
    created = [m for m in told if m["type"] == "FrameMessage" and m["name"] == "/rig/yoke/body"]
    assert len(created) == 1


@pytest.mark.parametrize("body", ['{"rig": "submarine"}', "{}", '{"rig": "aero", "x": 1}', "no"])
def test_unknown_rigs_are_refused(server: SceneServer, body: str):
    assert put_rig(server, "refused", body)[0] == 422


def test_everything_works_under_a_path_prefix():
    with serving(prefix="/lab/one") as mounted:
        url = f"{mounted.http}/scene/{session_id('prefix')}"
        with urllib.request.urlopen(url, timeout=20) as response:
            page, address = response.read().decode(), response.url
        (shim,) = re.findall(r'<script src="([^"]+)">', page)
        assert answer(urllib.parse.urljoin(address, shim))[0] == 200
        assert put_rig(mounted, "prefix", '{"rig": "aero"}')[0] == 204
        with watch(mounted, "prefix") as socket:
            assert replay(socket)


def test_full_server_says_so_and_makes_room_when_someone_leaves(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(sessions, "_SPARE_AFTER", 0.0)
    with serving(capacity=1) as small:
        with watch(small, "first") as first:
            replay(first)
            with watch(small, "second") as second:
                with pytest.raises(ConnectionClosed):
                    second.recv(timeout=20)
                assert second.close_code == 1013
                assert "1 scenes of this server are in use" in (second.close_reason or "")
            status, headers = put_rig(small, "second", '{"rig": "aero"}')
            assert (status, headers["retry-after"]) == (503, "30")
        until(lambda: put_rig(small, "second", '{"rig": "aero"}')[0] == 204, "there is room")
        assert len(small.sessions) == 1


def test_session_lives_while_it_is_watched_and_not_much_longer():
    with serving(idle_seconds=0.3) as server:
        with watch(server, "brief") as watcher:
            replay(watcher)
            assert put_rig(server, "unwatched", '{"rig": "aero"}')[0] == 204
            until(lambda: len(server.sessions) == 1, "the unwatched session is stopped")
            assert not closed(watcher)
        until(lambda: len(server.sessions) == 0, "the session is stopped after its last client")


def test_stopping_the_app_stops_every_rig_and_tells_the_watchers():
    with serving() as server:
        socket = watch(server, "last")
        replay(socket)
        viser = server.sessions.server(session_id("last"))
        assert viser is not None
        port = viser.get_port()
    with pytest.raises(ConnectionClosed):
        socket.recv(timeout=20)
    assert len(server.sessions) == 0
    with pytest.raises(ConnectionRefusedError):
        connect(f"ws://127.0.0.1:{port}", proxy=None)


def test_watcher_is_told_when_its_rig_stops(server: SceneServer):
    with watch(server, "stopped") as socket:
        replay(socket)
        viser = server.sessions.server(session_id("stopped"))
        assert viser is not None
        viser.stop()
        until(lambda: closed(socket), "the connection ends")
        assert socket.close_code == 1001


def test_making_a_rig_leaves_the_event_loop_free(monkeypatch: pytest.MonkeyPatch):
    release = threading.Event()

    class Stub:
        def stop(self) -> None:
            pass

    def slow(_: str) -> Stub:
        assert release.wait(20)
        return Stub()

    monkeypatch.setattr(sessions, "_make_server", slow)

    async def scenario() -> None:
        async with SceneSessions().running() as scenes:
            making = asyncio.create_task(scenes.set_rig("x" * 22, "aero"))
            for _ in range(50):
                await asyncio.sleep(0)
            assert not making.done()
            release.set()  # only reached if the loop still turns
            await asyncio.wait_for(making, 20)

    asyncio.run(scenario())


def test_slow_visitor_slows_the_source_instead_of_filling_memory():
    frame, sent = bytes(256 * 1024), 0
    held = asyncio.Event()

    async def flood(connection: ServerConnection) -> None:
        nonlocal sent
        while True:
            await connection.send(frame)
            sent += 1

    async def scenario() -> None:
        async with serve(flood, "127.0.0.1", 0, compression=None) as source:
            port = source.sockets[0].getsockname()[1]

            async def receive() -> Message:
                await held.wait()
                return {"type": "websocket.disconnect", "code": 1000}

            async def send(_: Message) -> None:
                await held.wait()  # a visitor whose buffers are full

            scope = {"type": "websocket", "app": FastAPI(), "subprotocols": [], "headers": []}
            visitor = WebSocket(scope, receive, send)
            visitor.client_state = visitor.application_state = visitor.client_state.CONNECTED
            relaying = asyncio.create_task(relay(visitor, port))
            deadline, quiet, last = time.monotonic() + 20, 0, -1
            while quiet < 20:
                assert time.monotonic() < deadline, "the source is never slowed"
                await asyncio.sleep(0.02)
                quiet, last = (quiet + 1, last) if sent == last and sent else (0, sent)
            held.set()
            await asyncio.wait_for(relaying, 20)
        assert sent * len(frame) < 32 * 1024 * 1024

    asyncio.run(scenario())


def test_stopped_rig_lets_go_of_its_scene_at_once():
    rig = sessions._make_server("aero")
    sessions._make_panel(rig, lambda _: None)
    body = weakref.ref(rig.scene.get_handle_by_name("/rig/yoke/body"))
    with connect(
        f"ws://127.0.0.1:{rig.get_port()}", subprotocols=[Subprotocol(VISER)], compression=None
    ) as viewer:
        assert replay(viewer)
        told = [weakref.ref(m) for m in rig._websock_server._broadcast_buffer.message_from_id.values()]
    threads = threading.active_count()
    gc.collect()
    gc.disable()
    try:
        rig.stop()
        rig.stop()  # twice does no harm
        assert body() is None
        kept = [m() for m in told if m() is not None]
        assert not any(vars(m) for m in kept)
        assert threading.active_count() < threads
    finally:
        gc.enable()


def test_client_that_is_killed_in_mid_frame_leaves_nothing():
    with serving(idle_seconds=0.3) as server:
        rude = watch(server, "killed")
        rude.recv(timeout=20)
        raw = rude.socket
        raw.sendall(b"\x82\xfe\x10\x00")  # a frame's head that promises 4096 bytes, of which none come
        raw.shutdown(socket.SHUT_RDWR)
        until(lambda: len(server.sessions) == 0, "the session is stopped")
        until(
            lambda: not [t for t in threading.enumerate() if "_background_worker" in t.name],
            "its thread ends",
        )
