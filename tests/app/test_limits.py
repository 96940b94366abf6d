"""What one client may take: each limit with its answer, and turns among those who wait."""

from __future__ import annotations

import asyncio
import itertools
import socket
import threading
from contextlib import ExitStack

import httpx2
import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from app.edge.limits import Buckets, Limits, SocketCounts, address_of
from app.jobs.compute import Compute, current_caller
from app.jobs.fair_queue import BusyError, FairQueue, Job
from app.jobs.recording_store import RecordingStore
from app.ops.settings import Settings
from heli2dof_core.errors import RecordingError
from heli2dof_core.recordings.recording import Table
from tests.loops import run
from tests.patience import PATIENCE, until
from tests.whole_server import serving

SMALL = {
    "body_bytes": 2000,
    "body_seconds": 1.0,
    "request_rate": 5.0,
    "request_burst": 30,
    "sockets": 6,
    "sockets_per_address": 4,
    "workers": 1,
    "slow_waiting": 3,
    "slow_each": 2,
    "slow_seconds": 10 * PATIENCE,
    "scenes": 1,
}
STIFF = {
    "samples": 20_000,
    "scenario": {"duration": 600, "rtol": 1e-12},
}
"""A cloud that would take minutes."""
addresses = (f"192.0.2.{k}" for k in itertools.count(1))


@pytest.fixture(scope="module")
def server():
    with serving(**SMALL | {"body_seconds": PATIENCE}) as server:
        yield server


@pytest.fixture
def http(server):
    """A client with an address of its own, whose bucket nobody else empties."""
    headers = {"X-Forwarded-For": next(addresses)}
    with httpx2.Client(base_url=server.http, headers=headers, timeout=PATIENCE, trust_env=False) as http:
        yield http


def refused(reply, status: int, code: str) -> dict:
    problem = reply.json()
    assert (reply.status_code, problem["status"], problem["code"]) == (status, status, code)
    assert reply.headers["content-type"] == "application/problem+json"
    return problem


def test_large_bodies_are_refused_announced_or_not(http):
    refused(http.post("/api/v1/gains", content=b" " * 2001), 413, "body_too_large")
    refused(http.post("/api/v1/gains", content=(b" " * 500 for _ in range(5))), 413, "body_too_large")
    assert http.post("/api/v1/gains", json={"lead": None, "preset": "quanser-aero"}).status_code == 200


def test_a_body_that_does_not_come_is_given_up():
    with (
        serving(body_seconds=0.05) as server,
        socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) as peer,
    ):
        head = "POST /api/v1/gains HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
        peer.sendall(f"{head}Content-Length: 100\r\n\r\n{{".encode())
        assert b" 408 " in peer.recv(4096)


def test_too_many_requests_are_told_when_to_come_back(http):
    count = 0
    while (late := http.get("/api/v1/presets")).status_code == 200:
        count += 1
        assert count < 1000
    assert count >= SMALL["request_burst"]
    refused(late, 429, "too_many_requests")
    assert int(late.headers["Retry-After"]) >= 1
    # The page's own files and the health check are not counted.
    assert http.get("/healthz").status_code == http.get("/static/css/style.css").status_code == 200


def test_too_many_sockets_are_closed_with_1013(server):
    url = server.socket("/api/v1/live")
    with ExitStack() as peers:
        for _ in range(SMALL["sockets_per_address"]):
            peers.enter_context(connect(url, compression=None, proxy=None))
        with connect(url, compression=None, proxy=None) as late, pytest.raises(ConnectionClosed) as closed:
            late.recv(10)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1013
        assert "4 sockets open" in closed.value.rcvd.reason
    until(lambda: server.app.state.socket_counts.total == 0, "all sockets are forgotten")


def test_slow_work_is_given_up_after_its_time():
    with serving(slow_seconds=0.2) as server:
        problem = refused(
            httpx2.post(f"{server.http}/api/v1/robustness", json=STIFF, timeout=PATIENCE), 503, "overdue"
        )
        assert problem["hint"]
        until(lambda: server.app.state.compute.running["slow"] == 0, "the thread is free again")


def slow_request(server) -> socket.socket:
    """One who has asked for what takes minutes."""
    peer = socket.create_connection(("127.0.0.1", server.port))
    body = b'{"samples": 20000, "scenario": {"duration": 600, "rtol": 1e-12}}'
    head = "POST /api/v1/robustness HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: "
    peer.sendall(f"{head}{len(body)}".encode() + b"\r\n\r\n" + body)
    return peer


def test_when_too_much_waits_more_is_refused_and_who_goes_makes_room(server, http):
    compute = server.app.state.compute
    first = slow_request(server)
    until(lambda: compute.running["slow"] == 1, "the work begins")
    others = [slow_request(server) for _ in range(SMALL["slow_waiting"])]
    until(lambda: compute.waiting["slow"] == SMALL["slow_waiting"], "the others wait")
    busy = http.post("/api/v1/robustness", json=STIFF)
    refused(busy, 503, "busy")
    assert int(busy.headers["Retry-After"]) >= 1
    for peer in others:
        peer.close()
    until(lambda: compute.waiting["slow"] == 0, "who has gone waits no more")
    assert compute.running["slow"] == 1
    first.close()
    until(lambda: compute.running["slow"] == 0, "the work ends with its client, long before its time")


def test_clients_take_turns_whoever_has_how_many_waiting():
    queue = FairQueue(most=100, most_each=20)
    for name in ["a1", "a1", "a1", "a2", "b1", "b1", "c1"]:
        queue.put(Job((name[0], int(name[1])), None))
    order = [job.client for _ in range(len(queue)) if (job := queue.take())]
    assert [f"{address}{connection}" for address, connection in order] == [
        "a1",
        "b1",
        "c1",
        "a2",
        "b1",
        "a1",
        "a1",
    ]


def test_many_behind_one_proxy_and_address_are_many():
    """A proxy that says for whom it asks says no port; forty tabs of one lab may each have work that waits."""
    callers = []

    async def app(*_: object) -> None:
        callers.append(current_caller.get().client)

    async def unasked(*_: object) -> None:
        raise AssertionError("the app neither reads nor answers")

    async def three() -> None:
        limits = Limits(app, Settings(), SocketCounts())
        for kind in ("websocket", "websocket", "http"):
            scope = {"type": kind, "path": "/api/v1/live", "headers": [], "client": ("192.0.2.1", 0)}
            await limits(scope, receive=unasked, send=unasked)

    run(three())
    assert {address for address, _ in callers} == {"192.0.2.1"}
    assert len({connection for _, connection in callers}) == 3


def test_the_queue_is_bounded_in_all_and_for_each():
    queue = FairQueue(most=3, most_each=2)
    jobs = [Job(("a", 1), None), Job(("a", 1), None)]
    for job in jobs:
        queue.put(job)
    with pytest.raises(BusyError, match="of your requests"):
        queue.put(Job(("a", 1), None))
    queue.put(Job(("a", 2), None))
    with pytest.raises(BusyError, match="The server"):
        queue.put(Job(("b", 1), None))
    queue.drop(jobs[0])
    queue.put(Job(("b", 1), None))
    assert len(queue.close()) == 3
    assert queue.take() is None


def test_what_is_always_the_same_is_derived_once(client):
    compute: Compute = client.app.state.compute
    ran, release = [], threading.Event()

    async def both():
        begun, loop = asyncio.Event(), asyncio.get_running_loop()

        def work():
            loop.call_soon_threadsafe(begun.set)
            assert release.wait(PATIENCE)
            ran.append(threading.current_thread().name)
            return len(ran)

        impatient = asyncio.create_task(compute.run_once("test", work))
        await begun.wait()
        impatient.cancel()  # who leaves leaves the others their answer
        others = [asyncio.create_task(compute.run_once("test", work)) for _ in range(2)]
        await asyncio.wait([impatient])
        assert impatient.cancelled()
        release.set()
        return await asyncio.gather(*others)

    assert client.portal.call(both) == [1, 1]
    assert len(ran) == 1 and ran[0].startswith("slow")


def test_tokens_come_back():
    now = 10.0
    buckets = Buckets(rate=100.0, burst=2, clock=lambda: now)
    assert [buckets.take("a") for _ in range(2)] == [0, 0]
    assert buckets.take("a") == pytest.approx(0.01)
    assert buckets.take("b") == 0
    now += 0.0101
    assert buckets.take("a") == 0 < buckets.take("a")
    now += 3600.0  # no more than the burst
    assert [bool(buckets.take("a")) for _ in range(3)] == [False, False, True]


@pytest.mark.parametrize(
    ("host", "address"),
    [
        ("192.0.2.7", "192.0.2.7"),
        ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::"),
        ("::ffff:192.0.2.7", "192.0.2.7"),
        ("testclient", "testclient"),
    ],
)
def test_an_ipv6_network_counts_as_one_client(host, address):
    assert address_of({"client": (host, 1)}) == address


def test_who_sends_many_recordings_loses_its_own():
    store = RecordingStore(most=4, most_bytes=10**6)
    table = Table(("x",), np.zeros((10, 1)))
    own = store.put(table, "student")
    first, *_ = [store.put(table, "greedy") for _ in range(10)]
    assert store.get(own) is table
    assert len(store) == 4
    with pytest.raises(RecordingError):
        store.get(first)


def test_a_class_behind_one_address_meets_no_limit():
    """Forty students: two windows each with four sockets, a page's twenty calls at once, then four asks a second."""
    usual, students, now = Settings(), 40, 0.0
    sent: list[dict] = []
    peers = [
        {"type": "websocket", "path": "/api/v1/live", "client": ("192.0.2.1", 1000 + k)}
        for k in range(8 * students)
    ]

    async def scenario() -> None:
        inside, all_in, end = 0, asyncio.Event(), asyncio.Event()

        async def app(scope, _receive, _send) -> None:
            nonlocal inside
            inside += 1
            if scope["type"] == "websocket":
                all_in.set() if inside == len(peers) else None
                await end.wait()

        async def send(message) -> None:
            sent.append(message)

        async def receive():
            return {"type": "http.request"}

        limits = Limits(app, usual, SocketCounts(), lambda: now)
        open_sockets = [asyncio.create_task(limits(peer, receive, send)) for peer in peers]
        await asyncio.wait(
            {asyncio.create_task(all_in.wait()), *open_sockets}, return_when=asyncio.FIRST_COMPLETED
        )
        assert inside == len(peers) and sent == []

        async def call() -> None:
            await limits(
                {"type": "http", "path": "/api/v1/gains", "headers": [], "client": ("192.0.2.1", 1)},
                receive,
                send,
            )

        for _ in range(20 * students):
            await call()
        nonlocal now
        for _ in range(60 * 4 * students):
            now += 1 / (4 * students)
            await call()
        end.set()
        await asyncio.gather(*open_sockets)

    run(scenario())
    assert sent == []
    queue = FairQueue(usual.slow_waiting, usual.slow_each)
    store = RecordingStore(usual.recordings, usual.recordings_bytes)
    table = Table(
        ("t", "theta", "psi", "V_p", "V_y"), np.zeros((60_000, 5))
    )  # a minute at a thousand a second
    kept = []
    for k in range(students):
        queue.put(Job(("192.0.2.1", k), None))
        kept.append(store.put(table, f"student {k}"))
    assert all(store.get(key) is table for key in kept)
