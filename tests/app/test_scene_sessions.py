"""Sessions of scenes: capacity, idleness, slow and killed visitors, and what a stopped rig leaves."""

import asyncio
import gc
import socket
import threading
import weakref
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from typing import Any

import pytest
from fastapi import FastAPI, WebSocket
from starlette.types import Message
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from app.scene import SceneSessions
from app.scene.panel import Panel
from app.scene.relay import relay
from app.scene.rig import RigServer
from tests.patience import PATIENCE, until
from tests.scene_client import (
    VISER,
    closed,
    put_rig,
    replay,
    session_id,
    watch,
)
from tests.scene_server import SceneServer, serving


@pytest.fixture(scope="module")
def server() -> Iterator[SceneServer]:
    with serving() as running:
        yield running


def test_full_server_says_so_and_makes_room_when_someone_leaves():
    with serving(capacity=1, evict_after_seconds=0.0) as small:
        with watch(small, "first") as first:
            replay(first)
            with watch(small, "second") as second:
                with pytest.raises(ConnectionClosed):
                    second.recv(timeout=PATIENCE)
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
    with ExitStack() as watching:
        with serving() as server:
            socket = watching.enter_context(watch(server, "last"))
            replay(socket)
            viser = server.sessions.server(session_id("last"))
            assert viser is not None
            port = viser.get_port()
        with pytest.raises(ConnectionClosed):
            socket.recv(timeout=PATIENCE)
    assert len(server.sessions) == 0
    with pytest.raises(ConnectionRefusedError), connect(f"ws://127.0.0.1:{port}", proxy=None):
        pass


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


def test_making_a_rig_leaves_the_event_loop_free():
    async def scenario() -> None:
        async with SceneSessions().running() as scenes:
            making, turns = asyncio.create_task(scenes.set_rig("x" * 22, "aero")), 0
            while not making.done():
                await asyncio.sleep(0)
                turns += 1
            await making
            assert scenes.server("x" * 22) is not None
        assert turns > 20  # some milliseconds' work in the loop itself would take two or three

    run_apart(scenario())


def test_slow_visitor_slows_the_source_instead_of_filling_memory():
    """Of 64 MiB that a source has, it is never ahead of a slow visitor by more than the buffers on the way."""
    frame, frames, most = bytes(256 * 1024), 256, 32 * 1024 * 1024
    sent, taken, lead = 0, 0, 0

    async def flood(connection: ServerConnection) -> None:
        nonlocal sent, lead
        for _ in range(frames):
            await connection.send(frame)
            sent += 1
            lead = max(lead, sent - taken)

    async def scenario() -> None:
        async with serve(flood, "127.0.0.1", 0, compression=None) as source:
            port = source.sockets[0].getsockname()[1]

            async def receive() -> Message:
                return await asyncio.get_running_loop().create_future()  # a visitor who says nothing

            async def send(message: Message) -> None:
                nonlocal taken
                for _ in range(50):  # turns in which the source sends what it can
                    await asyncio.sleep(0)
                taken += message["type"] == "websocket.send"

            scope = {"type": "websocket", "app": FastAPI(), "subprotocols": [], "headers": []}
            visitor = WebSocket(scope, receive, send)
            visitor.client_state = visitor.application_state = visitor.client_state.CONNECTED
            await asyncio.wait_for(relay(visitor, port), PATIENCE)
        assert taken == frames
        assert lead * len(frame) < most

    run_apart(scenario())


def test_stopped_rig_lets_go_of_its_scene_at_once():
    rig = RigServer("aero")
    Panel(rig, lambda _: None)
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
    with serving(idle_seconds=0.3) as server, watch(server, "killed") as rude:
        rude.recv(timeout=PATIENCE)
        raw = rude.socket
        raw.sendall(b"\x82\xfe\x10\x00")  # a frame's head that promises 4096 bytes, of which none come
        raw.shutdown(socket.SHUT_RDWR)
        until(lambda: len(server.sessions) == 0, "the session is stopped")
        until(
            lambda: not [t for t in threading.enumerate() if "_background_worker" in t.name],
            "its thread ends",
        )
