"""What an instructor sees of a class and does with it, and how it ends."""

from __future__ import annotations

import json
import re
import time
from collections.abc import Iterator

import pytest
from starlette.testclient import TestClient

from app.classes import people, wall
from app.main import create_app
from tests.app.class_room import UNSOLVED, ClassRoom, class_settings, refused
from tests.children import ROOT


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with TestClient(create_app(class_settings(tmp_path_factory.mktemp("classes")))) as client:
        yield client


@pytest.fixture
def room(client: TestClient) -> ClassRoom:
    return ClassRoom.made(client)


def test_the_wall_shows_who_is_where_and_what_holds_them_up(room):
    ada, bob = room.join("Ada")["student"], room.join("Bob")["student"]
    room.hand_in(ada, answers={"why": "so"})
    room.hand_in(bob, design=UNSOLVED)
    room.hand_in(ada, "further", design=UNSOLVED)
    wall = room.wall()
    assert [student["name"] for student in wall["students"]] == ["Ada", "Bob"]
    first = wall["students"][0]
    assert first["step"] == "further" and first["online"] is True and first["stable"] is True
    assert first["steps"]["settle"]["to_mark"] == 1 and first["steps"]["further"]["attempts"] == 1
    assert wall["held_up"][0]["step"] == "settle"
    assert wall["held_up"][0] | {"goal": ""} == {
        "step": "settle",
        "goal": "",
        "students": 2,
        "tried": 2,
        "met": 1,
    }
    assert [step["name"] for step in wall["steps"]] == ["settle", "further"]
    assert wall["points"] == 17 == sum(step["points"] for step in wall["steps"])


def test_marks_by_hand_count_and_are_told(room):
    ada = room.join()
    room.hand_in(ada["student"], answers={"why": "because"})
    address = f"{room.address}/students/{ada['id']}/marks"
    mark = {"step": "settle", "question": "why", "points": 2, "comment": "Nearly:\nsay why."}
    assert room.client.post(address, headers=room.key, json=mark).status_code == 204
    assert room.client.post(address, headers=room.key, json={**mark, "points": 2.5}).status_code == 204
    (hand,) = room.mine(ada["student"])["steps"]["settle"]["hand"]
    assert (hand["points"], hand["comment"]) == (2.5, "Nearly:\nsay why.")
    (row,) = room.wall()["students"]
    assert row["points"] == 8.5 and row["steps"]["settle"]["to_mark"] == 0
    for wrong, code in (
        ({"points": 4}, "too_many_points"),
        ({"question": "four"}, "unknown_question"),
        ({"step": "none"}, "unknown_step"),
    ):
        refused(room.client.post(address, headers=room.key, json={**mark, **wrong}), 422, code)
    refused(
        room.client.post(address, headers={"Heli2dof-Secret": ada["student"]}, json=mark),
        403,
        "unknown_secret",
    )


def test_a_closed_class_takes_nothing_and_opens_again(room):
    ada = room.join()["student"]
    assert "closed_at" in room.change(open=False, title="Tuesday")
    for reply in (
        room.send(ada),
        room.draft(ada, 1),
        room.client.post(f"{room.address}/join", json={"name": "Bob"}),
        room.client.post(f"{room.address}/hints", json={"student": ada, "step": "settle", "hint": 2}),
    ):
        assert refused(reply, 409, "class_closed")["closed_at"]
    mine = room.mine(ada)
    assert (mine["open"], mine["title"]) == (False, "Tuesday") and mine["closed_at"]
    assert room.change(open=True)["open"] is True
    assert room.send(ada).status_code == 200


def test_a_class_closes_by_itself_and_opening_it_by_hand_takes_that_back(room):
    ada = room.join()["student"]
    told = room.change(closes="2020-01-01T00:00:00Z")
    assert told["open"] is False and told["closed_at"] == "2020-01-01T00:00:00.000Z"
    refused(room.send(ada), 409, "class_closed")
    told = room.change(open=True)
    assert told["open"] is True and "closes" not in told
    assert room.change(closes="2999-01-01T00:00:00Z")["open"] is True
    assert "closes" not in room.change(closes=None)
    refused(room.client.patch(room.address, headers=room.key, json={"title": None}), 422, "invalid_input")


def test_a_new_link_ends_the_old_one(room):
    ada = room.join()
    reply = room.client.post(f"{room.address}/students/{ada['id']}/link", headers=room.key).json()
    assert reply["link"] == f"#class={room.code}&me={reply['student']}"
    refused(room.send(ada["student"]), 403, "unknown_secret")
    assert room.mine(reply["student"])["id"] == ada["id"]


def test_a_new_instructors_link_ends_the_old_one(room):
    reply = room.client.post(f"{room.address}/instructor", headers=room.key).json()
    assert reply["instructor_link"] == f"class#class={room.code}&key={reply['instructor']}"
    refused(room.client.get(room.address, headers=room.key), 403, "unknown_secret")
    refused(room.client.post(f"{room.address}/instructor", headers=room.key), 403, "unknown_secret")
    assert ClassRoom(room.client, room.code, reply["instructor"]).wall()["students"] == []


def test_what_is_deleted_is_gone(room):
    ada, bob, eve = (room.join(name) for name in ("Ada", "Bob", "Eve"))
    for student in (ada, bob, eve):
        room.hand_in(student["student"])
    version = room.wall()["version"]
    assert room.client.delete(f"{room.address}/students/{ada['id']}", headers=room.key).status_code == 204
    own = {"Heli2dof-Secret": bob["student"]}
    assert room.client.delete(f"{room.address}/mine", headers=own).status_code == 204
    refused(room.send(ada["student"]), 403, "unknown_secret")
    refused(room.client.get(f"{room.address}/mine", headers=own), 403, "unknown_secret")
    refused(room.client.get(f"{room.address}/students/{ada['id']}", headers=room.key), 404, "unknown_student")
    wall = room.wall()
    assert [row["name"] for row in wall["students"]] == ["Eve"] and wall["version"] > version
    assert room.client.delete(room.address, headers=room.key).status_code == 204
    refused(room.send(eve["student"]), 404, "unknown_class")
    refused(room.client.get(room.address, headers=room.key), 404, "unknown_class")


def test_the_instructor_sees_all_of_one_student_and_takes_all_out(room):
    ada = room.join("Ada")
    room.hand_in(ada["student"], answers={"why": "because"})
    room.draft(ada["student"], 1, UNSOLVED, step="further")
    one = room.client.get(f"{room.address}/students/{ada['id']}", headers=room.key).json()
    (kept,) = one["steps"]["settle"]["tries"]
    assert kept["answers"] == {"why": "because"} and kept["result"]["goals"][0]["value"] > 0
    assert one["steps"]["further"]["draft"]["design"] == UNSOLVED
    whole = room.client.get(f"{room.address}/export", headers=room.key).json()
    assert whole["students"][0]["steps"]["settle"]["tries"] == [kept]
    assert "SECRET-OF-THE-INSTRUCTOR" in whole["lab_text"]
    assert "SECRET-OF-THE-INSTRUCTOR" in room.client.get(f"{room.address}/lab", headers=room.key).text


def test_a_student_sees_themselves_alone(room):
    ada, bob = room.join("Ada", email="ada@example.org"), room.join("Bob")
    room.hand_in(ada["student"])
    for address in ("", "/events", "/lab", "/export", f"/students/{bob['id']}"):
        reply = room.client.get(f"{room.address}{address}", headers={"Heli2dof-Secret": bob["student"]})
        refused(reply, 403, "unknown_secret")
    told = json.dumps(room.mine(bob["student"])) + json.dumps(bob)
    assert "Ada" not in told and "ada@" not in told and "SECRET" not in told
    other = ClassRoom.made(room.client)
    refused(
        room.client.get(f"{other.address}/mine", headers={"Heli2dof-Secret": bob["student"]}),
        403,
        "unknown_secret",
    )
    refused(room.client.get(other.address, headers=room.key), 403, "unknown_secret")


# Its end.


def test_classes_end_by_themselves(client, monkeypatch):
    room = ClassRoom.made(client)
    ada = room.join()["student"]
    desk = client.portal.call(client.app.state.classes.desk)
    later = time.time() + 91 * 24 * 3600
    monkeypatch.setattr("app.classes.rows.time", lambda: later)
    refused(room.send(ada), 404, "unknown_class")  # even before anybody has cleared it away
    count = client.portal.call(desk.database.write, lambda writing: people.purge(writing, later))
    assert count >= 1
    assert client.portal.call(desk.database.write, lambda writing: people.purge(writing, later + 60)) is None
    monkeypatch.undo()
    refused(room.client.get(room.address, headers=room.key), 404, "unknown_class")


def test_who_only_reads_counts_as_there():
    page = (ROOT / "static/labs/class.js").read_text("utf-8")
    found = re.search(r"CALM_MS = ([\d_]+);", page)
    assert found and int(found[1]) / 1000 + 10 < wall.ONLINE, (
        "the page looks again before the wall calls it away"
    )
