"""The classes' database, SQLite and PostgreSQL alike: schemas, backups, and what is done where there is none."""

from __future__ import annotations

import asyncio
import itertools
import os
import sqlite3
import stat
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from sqlalchemy import insert, inspect, select
from starlette.testclient import TestClient

from app.classes import backups, engines, migrating
from app.classes.database import Database
from app.classes.errors import ClassError
from app.classes.keys import hash_of, new_secret
from app.classes.schema import classes, metadata, standings, students
from app.main import create_app
from app.ops.settings import Settings
from tests.app.a_lab import A_LAB
from tests.app.class_room import ClassRoom, labs_folder
from tests.children import python
from tests.loops import run
from tests.patience import PATIENCE, until
from tests.postgresql import PostgreSQL, postgresql

_names = itertools.count(1)


@pytest.fixture(scope="module")
def server() -> Iterator[PostgreSQL]:
    with postgresql() as running:
        yield running


@pytest.fixture(params=["sqlite", "postgresql"])
def empty(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """The setting of an empty database."""
    if request.param == "sqlite":
        yield f"sqlite:///{tmp_path}/own.db"
    else:
        yield request.getfixturevalue("server").fresh(f"own{next(_names)}")


def app(tmp_path: Path, setting: str, **more: object) -> TestClient:
    return TestClient(create_app(Settings(labs=labs_folder(tmp_path), database=setting, **more)))


def filled(tmp_path: Path, setting: str) -> tuple[ClassRoom, str]:
    """A class with a student, their attempts, draft, hint and hand mark; the server has ended since."""
    with app(tmp_path, setting) as client:
        room = ClassRoom.made(client)
        ada = room.join("Ada")
        room.hand_in(ada["student"], answers={"why": "because"})
        room.draft(ada["student"], 3, step="further")
        client.post(f"{room.address}/hints", json={"student": ada["student"], "step": "settle", "hint": 2})
        mark = {"step": "settle", "question": "why", "points": 2}
        client.post(f"{room.address}/students/{ada['id']}/marks", headers=room.key, json=mark)
    return room, ada["student"]


def kept(room: ClassRoom, student: str) -> dict[str, object]:
    """What matters of all that is kept, whenever it is asked for."""
    mine, wall = room.mine(student), room.wall()
    return {"steps": mine["steps"], "name": mine["name"], "students": [r["points"] for r in wall["students"]]}


# Schemas.


_PASSING_BY = """
import sqlite3, sys
connection = sqlite3.connect(sys.argv[1])
connection.execute("SELECT count(*) FROM classes").fetchall()
connection.close()
"""


def test_opening_a_database_twice_leaves_the_process_its_locks(tmp_path):
    """SQLite removes the log with the last process that has the file: what is written after must not go with it."""
    setting, file = f"sqlite:///{tmp_path}/own.db", tmp_path / "own.db"
    first = engines.open_engines(setting)
    engines.open_engines(setting).dispose()
    with first.reading.connect():
        log = Path(f"{file}-wal").stat().st_ino
        python("-c", _PASSING_BY, str(file))
        assert Path(f"{file}-wal").stat().st_ino == log
    first.dispose()


def test_the_migrations_make_what_the_tables_say(empty):
    opened = engines.open_engines(empty)
    with opened.reading.connect() as connection:
        assert migrating.revision_of(connection) == migrating.newest() == migrating.known_revisions()[-1]
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, metadata) == []
    opened.dispose()


def test_a_filled_database_of_the_first_schema_opens_with_the_newest(tmp_path, empty):
    """Every schema there was, filled as its time would have, goes all the way and keeps what it holds."""
    opened = engines.open_engines(empty, migrate=False)
    assert migrating.upgrade(opened.writing, "0001") == (None, "0001")
    now, secret, own = time.time(), new_secret(), new_secret()
    with opened.writing.begin() as connection:
        there = {name: inspect(connection).get_columns(name) for name in ("classes", "students", "standings")}
        rows = {
            "classes": {
                **{"code": "BCDFGHJ", "lab_name": "small", "lab_text": A_LAB, "title": "Yesterday"},
                **{"instructor_hash": hash_of(secret), "seed": "s", "created": now - 86_400, "open": True},
                **{"ends": now + 86_400, "joined": 1, "version": 7},
            },
            "students": {
                **{
                    "class_id": 1,
                    "number": 1,
                    "name": "Ada",
                    "secret_hash": hash_of(own),
                    "seed": 5,
                },
                **{"joined": now, "seen": now, "version": 7},
            },
            "standings": {
                **{"student_id": 1, "step": "settle", "attempts": 3, "best_id": 9, "points": 6.0},
                **{"met": "[true,true]", "last_met": "[false,true]", "texts": "[]", "at": now},
            },
        }
        for table in (classes, students, standings):
            known = {column["name"] for column in there[table.name]}
            assert rows[table.name].keys() <= known
            connection.execute(insert(table).values(rows[table.name]))
    for revision in migrating.known_revisions():
        migrating.upgrade(opened.writing, revision)
        with opened.reading.connect() as connection:
            assert connection.execute(select(students.c.name)).scalars().all() == ["Ada"]
    opened.dispose()
    with app(tmp_path, empty) as client:
        room = ClassRoom(client, "BCDFGHJ", secret)
        assert room.wall()["students"][0]["points"] == 6.0
        assert room.hand_in(own)["points"] >= 0
        assert room.join("Bob")["number"] == 2


def test_a_database_of_a_newer_program_is_left_alone(tmp_path, empty):
    opened = engines.open_engines(empty)
    with opened.writing.begin() as connection:
        connection.exec_driver_sql("UPDATE alembic_version SET version_num = '9999'")
    opened.dispose()
    with app(tmp_path, empty) as client:
        reply = client.post("/api/v1/classes", json={"lab": "small", "title": "Monday"})
        assert (reply.status_code, reply.json()["code"]) == (503, "no_database")
        assert "9999" in reply.json()["detail"] and reply.headers["retry-after"]
        assert client.post("/api/v1/gains", json={}).status_code == 200


def test_processes_that_open_it_at_one_moment_migrate_once(empty):
    failed: list[BaseException] = []

    def opening() -> None:
        try:
            engines.open_engines(empty).dispose()
        except BaseException as error:
            failed.append(error)

    threads = [threading.Thread(target=opening) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(PATIENCE)
    assert failed == []


# A class of yesterday, backups.


def test_a_class_of_yesterday_opens_today(tmp_path, empty):
    room, ada = filled(tmp_path, empty)
    # Its lab is another one since: the class keeps the lab that it was made of.
    own = labs_folder(tmp_path) / "small.yaml"
    own.write_text(A_LAB.replace("title: A small lab", "title: Another lab"), encoding="utf-8")
    with TestClient(create_app(Settings(labs=own.parent, database=empty))) as client:
        room = room.on(client)
        assert room.wall()["lab"]["title"] == "A small lab"
        assert client.get("/api/v1/labs/small").json()["title"] == "Another lab"
        step = room.mine(ada)["steps"]["settle"]
        assert (step["attempts"], step["hints"], step["hand"][0]["points"]) == (1, [2], 2.0)
        own.unlink()
        assert room.hand_in(ada)["points"] == 5.0


def test_a_backup_holds_one_moment_and_comes_back(tmp_path, empty):
    room, ada = filled(tmp_path, empty)
    copy = tmp_path / "backup.db"
    assert backups.backup(empty, copy) == 1
    assert stat.S_IMODE(copy.stat().st_mode) == 0o600 and list(tmp_path.glob(".backup*")) == []
    with app(tmp_path, empty) as client:
        before = kept(room.on(client), ada)
        client.delete(room.address, headers=room.key)
        later = ClassRoom.made(client, "Tuesday")
    with pytest.raises(ClassError, match="There are classes"):
        backups.restore(empty, copy)
    assert backups.restore(empty, copy, replace=True) == 1
    with app(tmp_path, empty) as client:
        assert kept(room.on(client), ada) == before
        assert client.get(later.address, headers=later.key).status_code == 404
        assert room.on(client).join("Bob")["number"] == 2  # rows that come after have ids of their own
        assert room.on(client).hand_in(ada)["points"] == 5.0
    with pytest.raises(ClassError, match="exists already"):
        backups.backup(empty, copy)


def test_a_backup_is_taken_while_students_hand_in(tmp_path, empty):
    with app(tmp_path, empty, request_rate=100_000) as client:
        room, ending, done = ClassRoom.made(client), threading.Event(), []
        ada = room.join("Ada")["student"]

        def works() -> None:
            while not ending.is_set():
                done.append(room.hand_in(ada)["id"])

        worker = threading.Thread(target=works)
        worker.start()
        until(lambda: len(done) > 2, "attempts are handed in")
        for k in range(4):
            answered = list(done)
            backups.backup(empty, tmp_path / f"{k}.db")
            reply = sqlite3.connect(tmp_path / f"{k}.db")
            there = {row[0] for row in reply.execute("SELECT client_id FROM attempts")}
            assert set(answered) <= there
            # One moment: what is counted is what is there.
            counted = reply.execute("SELECT attempts FROM standings").fetchone()[0]
            assert counted == len(there)
            reply.close()
        ending.set()
        worker.join(PATIENCE)


def test_classes_move_from_sqlite_to_postgresql_and_back(tmp_path, server):
    first, second = f"sqlite:///{tmp_path}/a.db", server.fresh(f"own{next(_names)}")
    room, ada = filled(tmp_path, first)
    backups.backup(first, tmp_path / "1.db")
    backups.restore(second, tmp_path / "1.db")
    backups.backup(second, tmp_path / "2.db")
    backups.restore(third := f"sqlite:///{tmp_path}/c.db", tmp_path / "2.db")
    found = []
    for setting in (first, second, third):
        with app(tmp_path, setting) as client:
            found.append(kept(room.on(client), ada))
    assert found[0] == found[1] == found[2]


@pytest.mark.parametrize("content", [b"", b"no database", None])
def test_what_is_no_backup_is_not_put_back(tmp_path, content):
    path = tmp_path / "x.db"
    if content is not None:
        path.write_bytes(content)
    setting = f"sqlite:///{tmp_path}/own.db"
    room, ada = filled(tmp_path, setting)
    with pytest.raises(ClassError, match="no backup"):
        backups.restore(setting, path, replace=True)
    with app(tmp_path, setting) as client:
        assert room.on(client).mine(ada)["name"] == "Ada"


def test_the_command_line_does_all_that(tmp_path):
    own = {"HELI2DOF_DATABASE": f"sqlite:///{tmp_path}/own.db"}
    assert "none yet" in python("-m", "app", "db", "current", **own)
    assert migrating.newest() in python("-m", "app", "db", "upgrade", **own)
    filled(tmp_path, own["HELI2DOF_DATABASE"])
    assert "1 classes" in python("-m", "app", "db", "backup", str(tmp_path / "b.db"), **own)
    assert "1 classes" in python("-m", "app", "db", "restore", "--replace", str(tmp_path / "b.db"), **own)
    hidden = {"HELI2DOF_DATABASE": "postgresql://heli2dof:very-secret@127.0.0.1:1/none"}
    told = python("-m", "app", "db", "current", **own)
    assert "own.db" in told and migrating.newest() in told
    assert "very-secret" not in backups.where(hidden["HELI2DOF_DATABASE"])


# Where there is none.


@pytest.mark.parametrize(
    "setting",
    [
        "sqlite:////proc/none/classes.db",
        "sqlite:////proc/version",
        "nonsense",
        "mysql://localhost/x",
        "postgresql://heli2dof:very-secret@127.0.0.1:1/none",
    ],
)
def test_a_server_without_a_database_serves_all_else_and_says_what_to_set(tmp_path, setting, caplog):
    with app(tmp_path, setting) as client:
        assert client.post("/api/v1/gains", json={}).status_code == 200
        assert client.get("/api/v1/labs").status_code == 200
        body = {"seed": 1, "step": "settle", "design": {}}
        assert client.post("/api/v1/labs/small/mark", json=body).status_code == 200
        for _ in range(2):
            reply = client.post("/api/v1/classes", json={"lab": "small", "title": "Monday"})
            told = reply.json()
            assert (reply.status_code, told["code"]) == (503, "no_database"), told
            assert "HELI2DOF_DATABASE" in told["hint"]
            assert "very-secret" not in reply.text
    assert "very-secret" not in caplog.text


def test_the_file_is_its_owners_alone(tmp_path):
    path = tmp_path / "new" / "own.db"
    engines.open_engines(f"sqlite:///{path}").dispose()
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700


def test_nothing_is_made_before_the_first_class(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    with app(tmp_path, "") as client:
        until(lambda: client.app.state.compute.compiled, "the start is over")
        assert client.get("/api/v1/labs").status_code == 200
        assert not (tmp_path / "heli2dof").exists()
        ClassRoom.made(client)
        if os.name == "posix" and "darwin" not in os.uname().sysname.lower():
            assert (tmp_path / "heli2dof" / "classes.db").is_file()


# Writing.


def test_of_many_writes_in_one_transaction_each_may_fail_alone(empty):
    database = Database(empty)

    def fails(_writing: object) -> None:
        raise ClassError(409, "no", "no")

    async def all_at_once() -> list[object]:
        works = [fails if k % 3 == 0 else (lambda writing, k=k: adds(writing, k)) for k in range(60)]
        return await asyncio.gather(*(database.write(work) for work in works), return_exceptions=True)

    def adds(writing, k: int) -> int:
        values = {
            "code": f"C{k}",
            "lab_name": "small",
            "lab_text": "",
            "title": "",
            "instructor_hash": str(k),
        }
        values |= {"seed": "", "created": 0.0, "open": True, "ends": 1.0, "joined": 0, "version": 1}
        writing.connection.execute(insert(classes).values(values))
        return k

    outcomes = run(all_at_once())
    assert [isinstance(outcome, ClassError) for outcome in outcomes] == [k % 3 == 0 for k in range(60)]
    found = run(database.read(lambda connection: connection.execute(select(classes.c.code)).all()))
    assert {row.code for row in found} == {f"C{k}" for k in range(60) if k % 3}
    database.close()


def test_a_connection_that_the_server_ends_costs_nothing(tmp_path, server):
    setting = server.fresh(name := f"own{next(_names)}")
    with app(tmp_path, setting) as client:
        room = ClassRoom.made(client)
        ada = room.join("Ada")["student"]
        for _ in range(3):
            server.execute(
                "SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
                f"WHERE datname = '{name}' AND application_name = 'heli2dof'"
            )
            room.hand_in(ada)
        assert room.mine(ada)["steps"]["settle"]["attempts"] == 3


def test_a_database_that_goes_away_and_comes_back(tmp_path, monkeypatch):
    """As a server that restarts: calls say that nothing was kept, and go on when it is there again."""
    with app(tmp_path, f"sqlite:///{tmp_path}/own.db") as client:
        room = ClassRoom.made(client)
        ada = room.join("Ada")["student"]
        desk = client.portal.call(client.app.state.classes.desk)
        monkeypatch.setattr("app.classes.database._PAUSES", (0.0, 0.0))
        blocker = sqlite3.connect(tmp_path / "own.db", isolation_level=None)
        monkeypatch.setattr("app.classes.engines._PRAGMAS", ("foreign_keys=ON", "busy_timeout=1"))
        desk.database.engines().dispose()
        blocker.execute("BEGIN EXCLUSIVE")
        reply = room.send(ada, id="00000000-0000-4000-8000-000000000001")
        assert (reply.status_code, reply.json()["code"]) == (503, "database_away")
        assert reply.headers["retry-after"]
        blocker.execute("ROLLBACK")
        blocker.close()
        assert room.send(ada, id="00000000-0000-4000-8000-000000000001").status_code == 200
        assert room.mine(ada)["steps"]["settle"]["attempts"] == 1
