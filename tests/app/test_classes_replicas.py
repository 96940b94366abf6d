"""Real processes on one database: killed, told to end, beside one another; and the walls that watch."""

from __future__ import annotations

import json
import signal
import threading
import uuid
from collections import defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import httpx2
import pytest

from app.classes import feeds
from tests.app.class_room import UNSOLVED, ClassRoom, labs_folder, refused
from tests.children import Server, served
from tests.patience import PATIENCE, until
from tests.postgresql import postgresql
from tests.whole_server import serving

pytestmark = pytest.mark.slow


def client(server: Any) -> httpx2.Client:
    return httpx2.Client(base_url=server.http, timeout=PATIENCE, trust_env=False)


@contextmanager
def replicas(folder: Path, setting: str, count: int) -> Iterator[list[Server]]:
    """So many processes on one database."""
    with ExitStack() as stack:
        found = []
        for k in range(count):
            own = folder / f"replica{k}"
            own.mkdir(exist_ok=True)
            settings = {"database": setting, "labs": labs_folder(folder), "request_rate": 100_000}
            found.append(stack.enter_context(served(own, **settings)))
        yield found


@pytest.fixture(params=["sqlite", "postgresql"])
def setting(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    if request.param == "sqlite":
        yield f"sqlite:///{tmp_path}/classes.db"
    else:
        with postgresql() as server:
            yield server.fresh("classes")


def test_a_killed_server_has_lost_nothing_that_it_has_answered(tmp_path):
    setting = f"sqlite:///{tmp_path}/classes.db"
    answered: dict[str, tuple[str, bytes]] = {}

    def works(room: ClassRoom, student: str) -> None:
        with client(server) as own:
            while True:
                attempt = str(uuid.uuid4())
                try:
                    reply = room.on(own).send(student, id=attempt, design=UNSOLVED)
                except httpx2.TransportError:
                    return
                assert reply.status_code == 200, reply.text
                answered[attempt] = (student, reply.content)

    with replicas(tmp_path, setting, 1) as (server,), client(server) as first:
        room = ClassRoom.made(first)
        joined = [room.join(f"S{k}")["student"] for k in range(4)]
        workers = [threading.Thread(target=works, args=(room, student)) for student in joined]
        for worker in workers:
            worker.start()
        until(lambda: len(answered) >= 30, "attempts are answered")
        server.process.send_signal(signal.SIGKILL)
        for worker in workers:
            worker.join(PATIENCE)
    assert len(answered) >= 30
    with replicas(tmp_path, setting, 1) as (server,), client(server) as second:
        room = room.on(second)
        for student in joined:
            kept = {one["id"] for one in room.mine(student)["steps"]["settle"]["tries"]}
            assert kept >= {attempt for attempt, (whose, _) in answered.items() if whose == student}
        for attempt, (student, content) in [*answered.items()][:8]:
            assert room.send(student, id=attempt, design=UNSOLVED).content == content


def test_replicas_on_one_database_are_one_server(tmp_path, setting):
    with (
        replicas(tmp_path, setting, 2) as both,
        client(both[0]) as one,
        client(both[1]) as other,
        ThreadPoolExecutor(8) as pool,
    ):
        room = ClassRoom.made(one)
        ada = room.on(other).join("Ada")
        # The same attempt on both at one moment is one attempt, and has one answer.
        for _ in range(6):
            attempt = str(uuid.uuid4())
            sent = [
                pool.submit(room.on(replica).send, ada["student"], id=attempt) for replica in (one, other) * 3
            ]
            assert len({future.result().content for future in sent}) == 1
        assert room.mine(ada["student"])["steps"]["settle"]["attempts"] == 6
        # So is the same request to join.
        request = str(uuid.uuid4())
        joined = [pool.submit(room.on(replica).join, "Bob", id=request) for replica in (one, other) * 3]
        assert len({future.result()["student"] for future in joined}) == 1
        # Different ones at one moment all come in, each with a number of its own.
        many = [pool.submit(room.on((one, other)[k % 2]).join, f"S{k}") for k in range(16)]
        numbers = [future.result()["number"] for future in many]
        assert len(set(numbers)) == 16 and room.wall()["students"][1]["name"] == "Bob"
        # The wall on one hears what is handed in on the other.
        with Wall(room) as wall:
            until(lambda: wall.events, "the wall has the class")
            room.on(other).hand_in(ada["student"], design=UNSOLVED)
            until(lambda: wall.student(ada["id"])["steps"]["settle"]["attempts"] == 7, "the wall hears of it")
            room.on(other).change(open=False)
            until(lambda: wall.head["open"] is False, "the wall hears that the class is closed")
            other.delete(room.address, headers=room.key)
            until(lambda: wall.events[-1] == "deleted", "the wall hears that the class is gone")


class Wall:
    """An instructor's wall: keeps what its stream tells."""

    def __init__(self, room: ClassRoom) -> None:
        self.events: list[str] = []
        self.head: dict[str, Any] = {}
        self.seen_online: dict[int, list[bool]] = defaultdict(list)
        self._students: dict[int, dict[str, Any]] = {}
        self._room = room
        self._thread = threading.Thread(target=self._listen, daemon=True)

    def __enter__(self) -> Wall:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._client.close()
        self._thread.join(PATIENCE)

    @property
    def over(self) -> bool:
        return not self._thread.is_alive()

    def student(self, number: int) -> dict[str, Any]:
        return self._students[number]

    def _listen(self) -> None:
        self._client = httpx2.Client(
            base_url=str(self._room.client.base_url), timeout=PATIENCE, trust_env=False
        )
        try:
            with self._client.stream("GET", f"{self._room.address}/events", headers=self._room.key) as reply:
                assert reply.headers["content-type"].startswith("text/event-stream")
                name = ""
                for line in reply.iter_lines():
                    kind, _, value = line.partition(": ")
                    if kind == "event":
                        name = value
                    elif kind == "data":
                        self._take(name, json.loads(value))
        except (httpx2.TransportError, httpx2.StreamError, RuntimeError):
            return  # closed by the test

    def _take(self, name: str, told: dict[str, Any]) -> None:
        for student in told.pop("students", []):
            self._students[student["id"]] = student
            self.seen_online[student["id"]].append(student["online"])
        for number in told.pop("gone", []):
            del self._students[number]
        self.head |= told
        self.events.append(name)

    @property
    def names(self) -> list[str]:
        return sorted(student["name"] for student in self._students.values())


def test_a_server_that_ends_ends_its_streams(tmp_path):
    with replicas(tmp_path, f"sqlite:///{tmp_path}/classes.db", 1) as (server,), client(server) as own:
        room = ClassRoom.made(own)
        with Wall(room) as wall:
            until(lambda: wall.events, "the wall has the class")
            until(lambda: server.warm, "nothing is derived any more, which may take longer than the end")
            server.process.send_signal(signal.SIGTERM)
            assert server.process.wait(PATIENCE) == 0
            until(lambda: wall.over, "the stream ends")
        log = server.log.read_text()
        assert "still computes" not in log and "Traceback" not in log


def test_many_walls_cost_one_look(tmp_path, monkeypatch):
    looks: list[int] = []
    plain = feeds.Feed._look

    def counted(self, connection, since):
        looks.append(since)
        return plain(self, connection, since)

    monkeypatch.setattr(feeds.Feed, "_look", counted)
    monkeypatch.setattr(feeds, "PERIOD", 0.02)
    database = f"sqlite:///{tmp_path}/classes.db"
    with serving(labs=labs_folder(tmp_path), database=database) as server, client(server) as own:
        room = ClassRoom.made(own)
        with ExitStack() as stack:
            walls = [stack.enter_context(Wall(room)) for _ in range(8)]
            until(lambda: all(wall.events for wall in walls), "all walls have the class")
            desk = server.app.state.classes._desk
            assert len(desk._feeds._by_class) == 1
            room.join("Ada")
            bob = room.join("Bob")
            until(lambda: all(wall.names == ["Ada", "Bob"] for wall in walls), "all hear of all")
            own.delete(f"{room.address}/students/{bob['id']}", headers=room.key)
            until(lambda: all(wall.names == ["Ada"] for wall in walls), "all hear who has gone")
            # Versions are looked at one after the other, not once for each wall.
            assert looks[1:] == sorted(looks[1:])
            reply = own.get(f"{room.address}/events", headers={"Heli2dof-Secret": "x" * 32})
            assert reply.status_code == 403
            room.client.post(f"{room.address}/instructor", headers=room.key)
            until(
                lambda: all(wall.events[-1] == "rotated" for wall in walls),
                "a new link ends the old one's walls",
            )
        until(lambda: not desk._feeds._by_class, "nobody looks any more")
        count = len(looks)
        room_again = ClassRoom.made(own)
        assert len(looks) == count and room_again.wall()["students"] == []


def test_a_wall_hears_who_leaves(tmp_path, monkeypatch):
    monkeypatch.setattr("app.classes.wall.ONLINE", 0.5)
    monkeypatch.setattr(feeds, "PERIOD", 0.02)
    database = f"sqlite:///{tmp_path}/classes.db"
    with serving(labs=labs_folder(tmp_path), database=database) as server, client(server) as own:
        room = ClassRoom.made(own)
        with Wall(room) as wall:
            until(lambda: wall.events, "the wall has the class")
            ada = room.join("Ada")
            # What was told, not what is: she leaves again while a busy machine looks elsewhere.
            seen = wall.seen_online[ada["id"]]
            until(lambda: seen and seen[-1] is False, "the wall hears that she has come and left")
            so_far = len(seen)
            room.draft(ada["student"], 1)
            until(lambda: True in seen[so_far:], "and that she is back")


def test_streams_count_as_sockets_do(tmp_path):
    settings = {"database": f"sqlite:///{tmp_path}/classes.db", "sockets_per_address": 2}
    with serving(labs=labs_folder(tmp_path), **settings) as server, client(server) as own:
        room, other = ClassRoom.made(own), ClassRoom.made(own)
        with Wall(room) as first, Wall(other) as second:
            until(lambda: first.events and second.events, "both walls have their class")
            reply = own.get(f"{room.address}/events", headers=room.key)
            refused(reply, 503, "too_many_walls")
            assert reply.headers["retry-after"]
        counts = server.app.state.socket_counts
        until(lambda: counts.total == 0, "the streams have ended")
        with Wall(other) as third:
            until(lambda: third.events, "there is room again")
