"""Sessions of scenes: capacity, idleness, slow and killed visitors, and what a stopped rig leaves."""

import asyncio
import gc
import socket
import threading
import time
import weakref
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from fastapi import FastAPI, WebSocket
from starlette.types import Message
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from app.scene import SceneSessions, sessions
from app.scene.relay import relay
from tests.scene_client import (
    VISER,
    closed,
    put_rig,
    replay,
    session_id,
    watch,
)
from tests.scene_server import SceneServer, serving, until


@pytest.fixture(scope="module")
def server() -> Iterator[SceneServer]:
    with serving() as running:
        yield running


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


def run_apart(work: Coroutine[Any, Any, None]) -> None:
    """Run in an event loop of its own thread: a browser's tests before may have left one in this."""
    with ThreadPoolExecutor(1) as pool:
        pool.submit(asyncio.run, work).result()


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

    run_apart(scenario())


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

    run_apart(scenario())


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
