"""Who may do what with classes, from where and how often; and what nobody reads in a log."""

from __future__ import annotations

import logging
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from app.classes import keys
from app.classes.errors import ClassError
from app.edge.bucket import Bucket
from app.main import create_app
from app.ops.settings import Settings
from app.routes import class_calls
from tests.app.class_room import API, ClassRoom, labs_folder
from tests.app.test_classes import refused

KEY = "an-operators-own-key"


@contextmanager
def serving(folder: Path, **settings: object) -> Iterator[TestClient]:
    with TestClient(create_app(Settings(labs=labs_folder(folder), database="memory", **settings))) as client:
        yield client


def test_the_operator_says_who_makes_classes(tmp_path):
    body = {"lab": "small", "title": "Monday"}
    with serving(tmp_path, classes="operator", operator_key=KEY) as client:
        refused(client.post(API, json=body), 401, "operator_key_needed")
        for wrong in ("", "x", KEY + "x", "ä"):
            headers = {"Heli2dof-Operator": wrong.encode()}
            refused(client.post(API, json=body, headers=headers), 401, "operator_key_needed")
        made = client.post(API, json=body, headers={"Heli2dof-Operator": KEY})
        assert made.status_code == 200
        assert ClassRoom(client, made.json()["code"], made.json()["instructor"]).join()["number"] == 1
    for settings in ({"classes": "off"}, {"classes": "operator"}):
        with serving(tmp_path, **settings) as client:
            told = client.post(API, json=body, headers={"Heli2dof-Operator": KEY})
            assert "HELI2DOF_" in refused(told, 403, "classes_closed")["hint"]


def test_foreign_pages_use_no_class(tmp_path):
    with serving(tmp_path, cors_origins="https://tools.example") as client:
        room = ClassRoom.made(client)
        own = room.join()["student"]
        for origin, allowed in (
            ("https://evil.example", False),
            ("null", False),
            ("http://testserver:81", False),
            ("http://testserver", True),
            ("https://tools.example", True),
        ):
            headers = {"Origin": origin, "Heli2dof-Secret": own}
            reply = client.get(f"{room.address}/mine", headers=headers)
            assert (reply.status_code == 200) is allowed, origin
            if not allowed:
                refused(reply, 403, "foreign_origin")
                assert "access-control-allow-origin" not in reply.headers
                told = {"lab": "small", "title": "theirs"}
                refused(client.post(API, json=told, headers={"Origin": origin}), 403, "foreign_origin")
            assert "set-cookie" not in reply.headers


def until_refused(ask: Callable[[], Any]) -> list[Any]:
    """All answers up to the first that is too many; a slow machine asks more often before it comes."""
    replies: list[Any] = []
    while not replies or replies[-1].status_code != 429:
        replies.append(ask())
        assert len(replies) < 5000
    return replies


def test_guesses_are_bounded(tmp_path, monkeypatch):
    monkeypatch.setattr(class_calls, "Bucket", lambda rate, burst: Bucket(rate, burst, lambda: 0.0))
    with serving(tmp_path) as client:
        room, other = ClassRoom.made(client), ClassRoom.made(client)
        room.join("First")
        replies = until_refused(lambda: client.get(f"{API}/{keys.new_code()}/about"))
        last = replies[-1]
        assert last.json()["code"] == "too_many_requests" and int(last.headers["retry-after"]) >= 1
        assert len(replies) == 301 and {reply.status_code for reply in replies[:-1]} == {404}
        # Whoever guesses is not told when they are right: not by the form, not by joining, not by a wrong secret.
        for ask in (
            lambda code: client.get(f"{API}/{code}/about"),
            lambda code: client.post(f"{API}/{code}/join", json={"name": "Guess"}),
            lambda code: client.post(f"{API}/{code}/join", json={"student": "x" * 32}),
            lambda code: client.get(f"{API}/{code}", headers={"Heli2dof-Secret": "x" * 32}),
        ):
            right, wrong = ask(other.code), ask(keys.new_code())
            assert right.status_code == wrong.status_code == 429
            assert right.json()["detail"] == wrong.json()["detail"]
        assert other.wall()["students"] == []
        # A class that is there goes on, from the same address, too.
        typed = f"{room.code[:3]}-{room.code[3:]}".lower()
        assert client.post(f"{API}/{typed}/join", json={"name": "Late"}).json()["number"] == 2
        assert room.mine(room.join("Later")["student"])["number"] == 3


def test_a_code_typed_otherwise_is_the_same_class():
    rates = class_calls.Rates(Settings(request_rate=0.001))  # one at once, then hardly ever another
    rates.join("BCDFGHJ")
    for typed in ("BCDFGHJ", "bcdfghj", " bcd-fghj"):
        with pytest.raises(ClassError, match="in a short time"):
            rates.join(typed)


def test_a_class_behind_one_address_meets_no_limit_and_a_flood_does(tmp_path):
    with serving(tmp_path) as client:
        room = ClassRoom.made(client)
        joined = [room.join(f"S{k}")["student"] for k in range(200)]
        for student in joined:
            room.hand_in(student)
            assert room.draft(student, 1).status_code == 204
        flood = until_refused(lambda: room.draft(joined[0], 2))
        assert len(flood) > 55 and {reply.status_code for reply in flood[:-1]} == {204}
        assert room.draft(joined[1], 2).status_code == 204  # others are not held up by it
        attempts = until_refused(lambda: room.send(joined[2], step="further"))
        assert len(attempts) > 38 and {reply.status_code for reply in attempts[:-1]} == {200}
        assert room.send(joined[3]).status_code == 200


def test_the_codes_and_secrets():
    codes = {keys.new_code() for _ in range(2000)}
    assert len(codes) > 1995 and all(len(code) == 7 for code in codes)
    assert not set("".join(codes)) & set("AEIOUL01")
    secrets = {keys.new_secret() for _ in range(1000)}
    assert len(secrets) == 1000 and {len(secret) for secret in secrets} == {32}
    request = str(uuid.uuid4())
    assert keys.secret_for("a", request) == keys.secret_for("a", request) != keys.secret_for("b", request)
    assert len(keys.secret_for("a", request)) == 32
    assert keys.fits("x", keys.hash_of("x")) and not keys.fits("y", keys.hash_of("x"))
    assert keys.code_of(" bcd-fg hj") == "BCDFGHJ"


def test_names_and_secrets_stand_in_no_log(tmp_path, caplog):
    caplog.set_level(logging.DEBUG)
    with serving(tmp_path, log_level="debug") as client:
        room = ClassRoom.made(client, "Title-Of-The-Class")
        ada = room.join("Ada Lovelace", email="ada@example.org", login="login-of-ada")
        room.hand_in(ada["student"], answers={"why": "answer-of-ada"})
        room.draft(ada["student"], 1)
        room.wall()
        room.mine(ada["student"])
        client.get(f"{room.address}/students/{ada['id']}", headers=room.key)
        room.send("x" * 32)
        client.get(f"{API}/XXXXXXX/about")
        client.post(f"{room.address}/join", json={"name": "Bad\u0000Name"})
        client.delete(f"{room.address}/students/{ada['id']}", headers=room.key)
        # The tests' own client tells what it asks for, which is none of the server's lines.
        lines = [record for record in caplog.records if not record.name.startswith("http")]
        form = logging.Formatter()
        text = "\n".join(map(form.format, lines)) + client.get("/metrics").text
    assert "/api/v1/classes/{code}/attempts" in text
    for own in (
        *("Ada", "Lovelace", "ada@", "login-of-ada", "answer-of-ada", "Title-Of", "Bad"),
        *(room.code, room.instructor, ada["student"], keys.hash_of(ada["student"]), "x" * 32, "XXXXXXX"),
    ):
        assert own not in text, own


def test_what_fails_in_the_database_is_logged_without_its_values(tmp_path, caplog, monkeypatch):
    from sqlalchemy.exc import IntegrityError

    from app.classes import people

    name = "Lovelace"

    def fails(*_: object) -> None:
        raise IntegrityError("INSERT", {"name": name}, Exception(f"DETAIL: Key (name)=({name}) is there."))

    with serving(tmp_path) as client:
        room = ClassRoom.made(client)
        monkeypatch.setattr(people, "join", fails)
        reply = TestClient(client.app, raise_server_exceptions=False).post(
            f"{room.address}/join", json={"name": name}
        )
        assert reply.status_code == 500 and name not in reply.text
    assert "RuntimeError: Exception" in caplog.text and name not in caplog.text


@pytest.mark.parametrize(
    ("path", "most"),
    [("", 2**16), ("/join", 2**16), ("/draft", 2**16), ("/hints", 2**16), ("/attempts", 2**22)],
)
def test_bodies_are_small(tmp_path, path, most):
    """But those of attempts, of which a flight's log is marked and not kept."""
    with serving(tmp_path) as client:
        room = ClassRoom.made(client)
        address = f"{room.address}{path}" if path else API
        send = client.put if path == "/draft" else client.post
        assert send(address, json={"title": "x" * most}).status_code == 413
