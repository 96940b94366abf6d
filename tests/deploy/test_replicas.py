"""A session stays on one replica; when that ends, killed or in good order, its tabs come back on another."""

from __future__ import annotations

import asyncio
import signal
from collections import Counter
from collections.abc import Callable
from time import perf_counter

import httpx2
import numpy as np
import pytest

from tests.deploy.clients import Client
from tests.deploy.farm import Farm, Replica
from tests.loops import run
from tests.patience import PATIENCE, until

CLIENTS, BEFORE, AFTER = 8, 3, 5
"""Clients of each replica, and answers that each has before and after the end of one."""
POSTING = 2
"""REST clients of each replica."""
CUT = 0
"""Instead of a status: the connection ended within the answer."""


def test_a_session_stays_on_one_replica_by_path_and_by_query(farm: Farm):
    put = " PUT /scene/*/rig 204 "

    def rows() -> list[str]:
        return [line for line in farm.log.read_text().splitlines() if put in line]

    for home in farm.replicas:
        first, second = farm.sessions(home, 2)
        for session in (first, second, first):
            before = len(rows())
            chosen = httpx2.put(f"{farm.url}scene/{session}/rig", json={"rig": "aero"}, timeout=PATIENCE)
            assert chosen.status_code == 204
            until(lambda before=before: len(rows()) > before, "nginx logs it")
            assert f"from {home.address}: 204" in rows()[-1]
            assert farm.home(session) is home


def test_recordings_are_found_again_by_their_session_alone(farm: Farm):
    first, second = (farm.sessions(replica, 1)[0] for replica in farm.replicas[:2])
    with httpx2.Client(base_url=f"{farm.url}api/v1/", timeout=PATIENCE) as client:
        sample = client.post("recordings/sample", json={"length": 6.0}, params={"session": first})
        assert sample.status_code == 200, sample.text
        sent = client.post(
            "recordings", content=sample.content, params={"session": first, "name": "a.csv"}
        ).json()
        body = {"columns": sent["guess"]["columns"], "driver": "segments"}
        asked = [
            client.post(f"recordings/{sent['id']}/overlay", json=body, params={"session": session})
            for session in (first, first, second)
        ]
    assert [reply.status_code for reply in asked] == [200, 200, 422], asked[0].text
    assert "does not hold" in asked[2].text  # the other replica knows nothing of it
    assert first not in farm.log.read_text() and sent["id"] not in farm.log.read_text()


@pytest.mark.parametrize("end", [Replica.kill, Replica.drain], ids=["killed", "drained"])
def test_clients_come_back_on_another_replica(
    farm: Farm, end: Callable[[Replica], None], record_property: Callable[[str, object], None]
):
    """Live sockets come back within seconds and are answered as before; no REST call is refused meanwhile.

    Only an answer of which a killed replica has sent the beginning is lost: nginx cannot ask another one for it.
    """
    victim = farm.replicas[0]
    homes = [replica for replica in farm.replicas for _ in range(CLIENTS)]
    names = [name for replica in farm.replicas for name in farm.sessions(replica, CLIENTS)]
    clients = [
        Client(f"ws://127.0.0.1:{farm.port}/api/v1/live?session={name}", [-12.0 - 0.1 * k, -10.0, -9.0, -8.0])
        for k, name in enumerate(names)
    ]
    ended, statuses = run(under_load(farm, clients, names, victim, end))
    moved = [client for client, home in zip(clients, homes, strict=True) if home is victim]
    stayed = [client for client, home in zip(clients, homes, strict=True) if home is not victim]
    gaps = sorted(1e3 * client.gap(ended) for client in moved)
    calm = max(1e3 * client.gap(ended) for client in stayed)
    codes = Counter(code for client in moved for code in client.lost)
    print(
        f"\n{len(moved)} clients answered again after {gaps[0]:.0f}…{np.median(gaps):.0f}…{gaps[-1]:.0f} ms, "
        f"close codes {dict(codes)}; the other {len(stayed)} waited {calm:.0f} ms at most; REST {dict(statuses)}"
    )
    record_property("gaps_ms", [round(gap) for gap in gaps])
    assert [len(client.lost) for client in moved] == [1] * CLIENTS
    assert all(not client.lost for client in stayed)
    assert sum(client.refused for client in clients) == 0  # nginx finds another replica at once
    for client in clients:
        assert len(client.gains) >= BEFORE + AFTER
        assert all(gains == client.gains[0] for gains in client.gains)
    assert statuses.keys() <= ({200, CUT} if end is Replica.kill else {200})
    assert statuses[CUT] <= POSTING
    assert statuses[200] > 40
    assert victim.process.wait(PATIENCE) == (-signal.SIGKILL if end is Replica.kill else 0)
    assert all(farm.home(name) is not victim for name in names[:CLIENTS])
    assert [farm.home(name) for name in names[CLIENTS:]] == homes[CLIENTS:]  # nobody else was moved


async def under_load(
    farm: Farm, clients: list[Client], names: list[str], victim: Replica, end: Callable[[Replica], None]
) -> tuple[float, Counter[int]]:
    """Runs the clients and REST calls beside them; returns when the end came, and what REST answered."""
    statuses: Counter[int] = Counter()
    over = False

    async def post(session: str) -> None:
        async with httpx2.AsyncClient(base_url=farm.url, timeout=PATIENCE) as rest:
            while not over:
                try:
                    answer = await rest.post(
                        "api/v1/gains", json={"poles": [-5, -6, -7, -8]}, params={"session": session}
                    )
                except httpx2.RemoteProtocolError:
                    statuses[CUT] += 1
                else:
                    statuses[answer.status_code] += 1

    async def rounds(count: int) -> None:
        for _ in range(count):
            await asyncio.gather(*(client.ask() for client in clients))

    async with asyncio.timeout(PATIENCE):
        posting = [asyncio.create_task(post(name)) for name in names[:: CLIENTS // POSTING]]
        await rounds(BEFORE)
        ended = perf_counter()
        end(victim)
        while victim.process.poll() is None:
            await rounds(1)
        await rounds(AFTER)
        over = True
        await asyncio.gather(*posting)
        await asyncio.gather(*(client.close() for client in clients))
    return ended, statuses
