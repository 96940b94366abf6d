"""How a server ends: real processes, real signals, requests in flight."""

from __future__ import annotations

import contextlib
import json
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import httpx2
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from tests.app.process import Server, served
from tests.scene_client import VISER, session_id
from tests.scene_server import until

CLOUD = {"samples": 8000, "scenario": {"model": "nonlinear"}}
"""Takes about a second."""


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Server]:
    with served(tmp_path) as server:
        until(lambda: "kernels ready" in server.log.read_text(), "the kernels are compiled", 120)
        yield server


def open_socket(server: Server, path: str, **more) -> Connection:
    return connect(f"{server.ws}{path}", compression=None, proxy=None, **more)


def farewell(socket: Connection) -> tuple[list[str | bytes], int | None]:
    """All that still comes, and the code at the end."""
    heard: list[str | bytes] = []
    with contextlib.suppress(ConnectionClosed):
        while True:
            heard.append(socket.recv(timeout=20))
    return heard, socket.close_code


def test_answers_in_flight_arrive_and_sockets_close_with_1001(server: Server):
    live = [open_socket(server, "/api/v1/live") for _ in range(20)]
    cloud = open_socket(server, "/api/v1/robustness")
    idle = [
        open_socket(server, "/api/v1/live"),
        open_socket(server, f"/scene/{session_id('ends')}/hub?page=true"),
    ]
    scene = open_socket(server, f"/scene/{session_id('ends')}", subprotocols=[VISER], max_size=None)
    replies = []

    def post() -> None:
        replies.append(httpx2.post(f"{server.http}/api/v1/robustness", json=CLOUD, timeout=30))

    posting = threading.Thread(target=post)
    posting.start()
    cloud.send(json.dumps(CLOUD))
    assert json.loads(cloud.recv(timeout=30))["done"] < CLOUD["samples"]  # it runs, and so does the other
    for seq, socket in enumerate(live):
        socket.send(json.dumps({"seq": seq, "scenario": {"digital": {}}}))
    began = time.monotonic()
    server.process.send_signal(signal.SIGTERM)

    for seq, socket in enumerate(live):
        heard, code = farewell(socket)
        assert [json.loads(answer)["seq"] for answer in heard] == [seq]
        assert "step" in json.loads(heard[0])
        assert code == 1001
    for socket in idle:
        assert farewell(socket)[1] == 1001
    assert farewell(scene)[1] == 1001
    heard, code = farewell(cloud)
    assert json.loads(heard[-1])["done"] == CLOUD["samples"]
    assert code == 1001
    posting.join(30)
    assert [reply.status_code for reply in replies] == [200]
    assert replies[0].json()["done"] == CLOUD["samples"]
    assert server.process.wait(20) == 0
    assert time.monotonic() - began < 10
    assert "Traceback" not in server.log.read_text()


def test_what_computes_for_long_does_not_hold_the_end_up(server: Server):
    body = {**CLOUD, "samples": 20_000, "scenario": {"model": "nonlinear", "duration": 60.0, "rtol": 1e-10}}
    sockets = [open_socket(server, "/api/v1/robustness") for _ in range(3)]
    for socket in sockets:
        socket.send(json.dumps(body))
    sockets[0].recv(timeout=30)
    began = time.monotonic()
    server.process.send_signal(signal.SIGTERM)
    for socket in sockets:
        assert farewell(socket)[1] == 1001
    assert server.process.wait(20) == 0
    assert time.monotonic() - began < 10.5


@pytest.mark.parametrize("first", [signal.SIGTERM, signal.SIGINT])
def test_second_signal_ends_it_at_once(tmp_path: Path, first: signal.Signals):
    with served(tmp_path, drain="30") as server:
        server.process.send_signal(first)
        until(lambda: httpx2.get(f"{server.http}/healthz").status_code == 503, "it is not ready")
        began = time.monotonic()
        server.process.send_signal(signal.SIGTERM)
        assert server.process.wait(5) == -signal.SIGTERM
        assert time.monotonic() - began < 2


def test_while_it_drains_it_is_alive_and_not_ready_and_still_serves(tmp_path: Path):
    with served(tmp_path, drain="4") as server:
        until(lambda: "kernels ready" in server.log.read_text(), "the kernels are compiled", 120)
        socket = open_socket(server, "/api/v1/live")
        began = time.monotonic()
        server.process.send_signal(signal.SIGTERM)
        until(lambda: httpx2.get(f"{server.http}/healthz").status_code == 503, "it is not ready")
        assert httpx2.get(f"{server.http}/healthz").json()["code"] == "going_away"
        assert httpx2.get(f"{server.http}/livez").status_code == 200
        socket.send('{"seq": 1}')
        assert json.loads(socket.recv(timeout=20))["seq"] == 1
        with open_socket(server, "/api/v1/live") as other:
            other.send('{"seq": 2}')
            assert json.loads(other.recv(timeout=20))["seq"] == 2
        assert time.monotonic() - began < 4
        assert farewell(socket)[1] == 1001
        assert server.process.wait(10) == 0


def test_peer_that_reads_nothing_does_not_hold_the_end_up(server: Server):
    deaf = open_socket(server, "/api/v1/live", max_queue=1)
    for seq in range(400):  # 40 kB each: more than all buffers on the way hold
        with contextlib.suppress(TimeoutError):
            deaf.send(json.dumps({"seq": seq, "scenario": {"samples": 1001}}))
        time.sleep(0.005)
    began = time.monotonic()
    server.process.send_signal(signal.SIGTERM)
    assert server.process.wait(20) == 0
    assert time.monotonic() - began < 10.5
    deaf.socket.close()
