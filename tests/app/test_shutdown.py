"""How a server ends: real processes, real signals, requests in flight.

Each test is about an end, so that each has a server of its own.
"""

from __future__ import annotations

import array
import contextlib
import fcntl
import functools
import json
import signal
import socket as sockets_module
import sys
import termios
import threading
from pathlib import Path

import httpx2
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from tests.app.test_limits import STIFF
from tests.children import ROOT, Server, served
from tests.patience import PATIENCE, until
from tests.raw_sockets import frame, shaken
from tests.scene_client import VISER, session_id

pytestmark = pytest.mark.slow

CLOUD = {"samples": 8000, "scenario": {"model": "nonlinear"}}
"""Takes about a second."""
LARGE = {"samples": 20_000, "scenario": {"model": "linear"}}
"""Its replies take three megabytes."""


def open_socket(server: Server, path: str, **more) -> Connection:
    return connect(f"{server.ws}{path}", compression=None, proxy=None, open_timeout=PATIENCE, **more)


def enter(sockets: contextlib.ExitStack, server: Server, path: str, **more) -> Connection:
    """The same, closed with all others."""
    return sockets.enter_context(open_socket(server, path, **more))


def farewell(socket: Connection) -> tuple[list[str | bytes], int | None]:
    """All that still comes, and the code at the end."""
    heard: list[str | bytes] = []
    with contextlib.suppress(ConnectionClosed):
        while True:
            heard.append(socket.recv(timeout=PATIENCE))
    return heard, socket.close_code


def test_answers_in_flight_arrive_and_sockets_close_with_1001(tmp_path: Path):
    with served(tmp_path, drain=0.5, grace=PATIENCE) as server, contextlib.ExitStack() as sockets:
        opened = functools.partial(enter, sockets, server)
        until(lambda: server.warm, "the kernels are there")
        live = [opened("/api/v1/live") for _ in range(20)]
        cloud = opened("/api/v1/robustness")
        idle = [opened("/api/v1/live"), opened(f"/scene/{session_id('ends')}/hub?page=true")]
        scene = opened(f"/scene/{session_id('ends')}", subprotocols=[VISER], max_size=None)
        replies = []

        def post() -> None:
            replies.append(httpx2.post(f"{server.http}/api/v1/robustness", json=CLOUD, timeout=PATIENCE))

        posting = threading.Thread(target=post)
        posting.start()
        until(
            lambda: "heli2dof_robustness_runs_total 1.0" in httpx2.get(f"{server.http}/metrics").text,
            "one has begun",
        )
        cloud.send(json.dumps(CLOUD))
        assert json.loads(cloud.recv(timeout=PATIENCE))["done"] < CLOUD["samples"]  # and so has the other
        for seq, socket in enumerate(live):
            socket.send(json.dumps({"seq": seq, "scenario": {"digital": {}}}))
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
        posting.join(PATIENCE)
        assert [reply.status_code for reply in replies] == [200]
        assert replies[0].json()["done"] == CLOUD["samples"]
        assert server.process.wait(PATIENCE) == 0
        log = server.log.read_text()
        assert "ended after" in log  # by itself, not by the time's end
        assert "Traceback" not in log


def test_what_computes_for_long_does_not_hold_the_end_up(tmp_path: Path):
    with served(tmp_path, grace=1.0, slow_seconds=10 * PATIENCE) as server, contextlib.ExitStack() as sockets:
        until(lambda: server.warm, "the kernels are there")
        peers = [enter(sockets, server, "/api/v1/robustness") for _ in range(3)]
        for peer in peers:
            peer.send(json.dumps(STIFF))
        until(lambda: waiting(server) == 1, "two are computed and the third waits")
        server.process.send_signal(signal.SIGTERM)
        for peer in peers:
            assert farewell(peer)[1] == 1001
        assert server.process.wait(PATIENCE) == 0


def waiting(server: Server) -> float:
    """Slow jobs that wait, as the metrics tell."""
    lines = httpx2.get(f"{server.http}/metrics", timeout=PATIENCE).text.splitlines()
    (line,) = (line for line in lines if line.startswith('heli2dof_pool_waiting{pool="slow"}'))
    return float(line.split()[1])


@pytest.mark.parametrize("first", [signal.SIGTERM, signal.SIGINT])
def test_while_it_drains_it_serves_on_and_a_second_signal_ends_it_at_once(
    tmp_path: Path, first: signal.Signals
):
    with served(tmp_path, drain=60) as server:
        with open_socket(server, "/api/v1/live") as socket:
            server.process.send_signal(first)
            health = f"{server.http}/healthz"
            # Before it can compute it is not ready either, but does not go away.
            until(lambda: httpx2.get(health).json().get("code") == "going_away", "it goes away")
            assert httpx2.get(health).status_code == 503
            assert httpx2.get(f"{server.http}/livez").status_code == 200
            socket.send('{"seq": 1}')
            assert json.loads(socket.recv(timeout=PATIENCE))["seq"] == 1
            with open_socket(server, "/api/v1/live") as other:
                other.send('{"seq": 2}')
                assert json.loads(other.recv(timeout=PATIENCE))["seq"] == 2
            server.process.send_signal(signal.SIGTERM)
            assert server.process.wait(PATIENCE) == -signal.SIGTERM
        assert "ended after" not in server.log.read_text()


SMALL = (
    (sockets_module.SOL_SOCKET, sockets_module.SO_RCVBUF, 4096),
    (sockets_module.IPPROTO_TCP, sockets_module.TCP_MAXSEG, 536),
)
"""What the kernel then holds on the way to a peer that reads nothing is 86 kB, otherwise nearly all of the answer."""


def test_peer_that_reads_nothing_does_not_hold_the_end_up(tmp_path: Path):
    # It answers no pings either: after those it would be dropped, and its socket be none that the end has to close.
    # The grace leaves two seconds between the last goodbye and the end.
    with served(tmp_path, grace=6.0, ping=10 * PATIENCE) as server:
        until(lambda: server.warm, "the kernels are there")
        with shaken(server.port, "/api/v1/robustness", *SMALL) as deaf:
            deaf.sendall(frame(json.dumps(LARGE).encode()))
            until(lambda: unread(deaf) > 1000, "it is being answered")
            server.process.send_signal(signal.SIGTERM)
            assert server.process.wait(PATIENCE) == 0
            assert "sockets closed: 1, of which 1 without their answer" in server.log.read_text()


GREEDY = """
import sys, threading, time
sys.path.insert(0, ROOT)
from app.cli import main

def hold():
    while "end" not in {thread.name for thread in threading.enumerate()}:
        time.sleep(0.01)
    sum(range(10**15))  # days, in which no other thread runs

threading.Thread(target=hold, daemon=True).start()
main(["serve", "--port", "0"])
"""


def test_who_holds_pythons_lock_does_not_hold_the_end_up(tmp_path: Path):
    program = GREEDY.replace("ROOT", repr(str(ROOT)))
    with served(tmp_path, (sys.executable, "-c", program), drain=0.5, grace=1) as server:
        server.process.send_signal(signal.SIGTERM)
        assert server.process.wait(PATIENCE) == -signal.SIGALRM


def unread(socket: sockets_module.socket) -> int:
    """Bytes that have come and were not read."""
    size = array.array("i", [0])
    fcntl.ioctl(socket, termios.FIONREAD, size)
    return size[0]
