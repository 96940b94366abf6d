"""What students hand in to a class, and what they are told."""

from __future__ import annotations

import json
import uuid
from collections.abc import Iterator
from typing import Any

import pytest
from starlette.testclient import TestClient

from app.main import create_app
from tests.app.a_lab import SOLVED
from tests.app.class_room import API, UNSOLVED, ClassRoom, class_settings, refused


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with TestClient(create_app(class_settings(tmp_path_factory.mktemp("classes")))) as client:
        yield client


@pytest.fixture
def room(client: TestClient) -> ClassRoom:
    return ClassRoom.made(client)


# Labs, alone.


def test_labs_are_listed_in_the_courses_order(client):
    labs = client.get("/api/v1/labs").json()
    own = [lab for lab in labs if lab["source"] == "own"]
    assert [lab["name"] for lab in own] == ["small"]
    assert own[0] == {
        "name": "small",
        "title": "A small lab",
        "summary": "Two steps for tests.",
        "minutes": 10,
        "points": 17,
        "steps": 2,
        "source": "own",
    }
    numbers = [lab["number"] for lab in labs if "number" in lab]
    assert numbers == sorted(numbers)


def test_a_student_alone_sees_the_lab_and_a_rig_but_no_answer(client):
    reply = client.get("/api/v1/labs/small", params={"seed": 7})
    assert reply.status_code == 200
    assert "SECRET" not in reply.text and '"answer"' not in reply.text and "solution" not in reply.text
    rig = reply.json()["rig"]
    assert rig["preset"] == "quanser-2dof-manual" and set(rig["parameters"]) == {"B_p", "K_pp"}
    assert client.get("/api/v1/labs/small", params={"seed": 7}).json()["rig"] == rig
    assert client.get("/api/v1/labs/small", params={"seed": 8}).json()["rig"] != rig
    assert "rig" not in client.get("/api/v1/labs/small").json()


def test_an_attempt_alone_is_marked(client):
    body = {"seed": 7, "step": "settle", "design": SOLVED, "answers": {"who": 2, "four": "4,0"}}
    marked = client.post("/api/v1/labs/small/mark", json=body).json()
    assert [goal["met"] for goal in marked["goals"]] == [True, True]
    assert (marked["points"], marked["of"]) == (9, 12)
    dearer = client.post("/api/v1/labs/small/mark", json={**body, "hints": [1, 2]}).json()
    assert dearer["points"] == 8
    assert client.get("/api/v1/labs/small/steps/settle/hints/2").json()["text"] == "SECRET-HINT"
    refused(client.get("/api/v1/labs/small/steps/settle/hints/9"), 404, "unknown_hint")
    refused(client.get("/api/v1/labs/none"), 404, "unknown_lab")
    refused(client.post("/api/v1/labs/small/mark", json={"step": "none", "design": {}}), 422, "unknown_step")


# Joining and coming back.


def test_who_has_the_code_joins_and_comes_back_by_their_secret(room):
    typed = f" {room.code[:3].lower()}-{room.code[3:]}"
    about = room.client.get(f"{API}/{typed}/about").json()
    assert about["code"] == room.code and about["open"] is True and about["lab"]["name"] == "small"
    ada = room.join("  Ada\u00a0 Lovelace ", email="ada@example.org", login="al1")
    assert ada["name"] == "Ada Lovelace" and ada["number"] == 1
    assert ada["rig"]["parameters"] != room.join("Bob")["rig"]["parameters"]
    room.draft(ada["student"], 5, UNSOLVED)
    again = room.client.post(f"{room.address}/join", json={"student": ada["student"]}).json()
    assert (again["id"], again["rig"], again["email"]) == (ada["id"], ada["rig"], "ada@example.org")
    assert again["steps"]["settle"]["design"] == UNSOLVED and again["step"] == "settle"
    assert len(room.wall()["students"]) == 2


def test_joining_twice_by_one_request_makes_one_student(room):
    request = str(uuid.uuid4())
    first, second = room.join("Ada", id=request), room.join("Ada", id=request)
    assert (first["student"], first["id"], first["rig"]) == (second["student"], second["id"], second["rig"])
    assert room.join("Ada", id=str(uuid.uuid4()))["student"] != first["student"]
    other = ClassRoom.made(room.client)
    assert other.join("Ada", id=request)["student"] != first["student"]
    assert len(room.wall()["students"]) == 2


@pytest.mark.parametrize(
    "name",
    [
        "",
        "   ",
        "x" * 81,
        "a\x00b",
        "a\nb",
        "a\x7f",
        "a\u202eb",
        "a\u2066b",
        "\u200b",
        "\ufeff",
        "\ud800",
        "a\x85b",
    ],
)
def test_names_that_could_deceive_are_refused(room, name):
    reply = room.client.post(
        f"{room.address}/join",
        content=json.dumps({"name": name}),
        headers={"Content-Type": "application/json"},
    )
    assert reply.status_code == 422 and reply.json()["field"] == "name", reply.text
    assert room.wall()["students"] == []


def test_names_of_the_world_are_taken(room):
    for name in ("José", "李小龍", "O’Neil-Søren", "नीरज", "=1+1", "x" * 80, "👩‍🔬 Ada"):
        assert room.join(name)["name"] == name
    assert room.join("Jose\u0301")["name"] == "José"


def test_a_class_is_full_at_its_bound(room):
    for k in range(30):
        room.join(f"S{k}")
    reply = room.client.post(f"{room.address}/join", json={"name": "one more"})
    refused(reply, 409, "class_full")
    gone = room.wall()["students"][0]["id"]
    assert room.client.delete(f"{room.address}/students/{gone}", headers=room.key).status_code == 204
    assert room.join("one more")["number"] > 30  # no number is given twice


# Attempts.


def test_an_attempt_is_marked_on_the_students_own_rig_and_kept(room):
    ada = room.join()
    answers = {"who": 2, "four": 4.0, "why": "because"}
    told = room.hand_in(ada["student"], answers=answers, design={**SOLVED, "parameters": {"K_pp": 9.0}})
    assert [goal["met"] for goal in told["goals"]] == [True, True]
    assert (told["points"], told["of"], told["best"]["points"]) == (9, 12, 9)
    assert told["ignored"] == ["parameters"]
    (kept,) = room.mine(ada["student"])["steps"]["settle"]["tries"]
    assert kept["design"]["parameters"]["K_pp"] == ada["rig"]["parameters"]["K_pp"]
    assert kept["answers"] == answers and kept["result"]["points"] == 9


def test_the_same_attempt_again_is_the_same_answer_and_counts_once(room):
    ada, own = room.join(), str(uuid.uuid4())
    first = room.send(ada["student"], id=own, design=UNSOLVED)
    room.hand_in(ada["student"])  # a better one in between
    again = room.send(ada["student"], id=own, design=UNSOLVED)
    assert again.content == first.content
    room.change(open=False)
    assert room.send(ada["student"], id=own).content == first.content  # what was answered stays answered
    assert room.mine(ada["student"])["steps"]["settle"]["attempts"] == 2


def test_the_best_counts_and_the_newest_is_where_one_goes_on(room):
    ada = room.join()
    best = room.hand_in(ada["student"], answers={"who": 2})
    worse = room.hand_in(ada["student"], design=UNSOLVED)
    assert worse["points"] < best["points"] and worse["best"]["points"] == best["points"]
    step = room.mine(ada["student"])["steps"]["settle"]
    assert step["best"]["points"] == best["points"]
    assert step["design"]["poles"] == [-2.0, -2.5, -9.25, -8.76]
    (row,) = room.wall()["students"]
    assert row["steps"]["settle"]["goals"] == [True, True] and row["points"] == best["points"]
    assert row["steps"]["settle"]["last"] == [goal["met"] for goal in worse["goals"]] != [True, True]


def test_old_attempts_keep_their_marks_and_lose_their_designs(room):
    ada = room.join()
    best = room.hand_in(ada["student"], answers={"who": 2})["id"]
    others = [room.hand_in(ada["student"], design=UNSOLVED)["id"] for _ in range(23)]
    step = room.mine(ada["student"])["steps"]["settle"]
    assert step["attempts"] == 24 and [kept["id"] for kept in step["tries"]] == [best, *others]
    whole = [kept["id"] for kept in step["tries"] if "design" in kept]
    assert whole == [best, *others[-20:]]
    assert all(kept["result"]["goals"] for kept in step["tries"])


def test_what_no_attempt_is_is_refused(room):
    ada = room.join()["student"]
    refused(room.send(ada, step="none"), 422, "unknown_step")
    refused(room.send("x" * 32), 403, "unknown_secret")
    refused(room.send(ada, id="no-uuid"), 422, "invalid_input")
    assert refused(room.send(ada, design={"poles": 3}), 422, "invalid_input")["field"].startswith(
        "design.poles"
    )
    assert refused(room.send(ada, design={"x": 3}), 422, "unknown_field")["field"] == "design.x"
    for poles in ([1, 2, 3], [{"re": -1, "im": 1}, -2, -3, -4]):
        assert room.send(ada, design={"poles": poles}).status_code in (200, 422)
    refused(room.send(ada, answers={"why": "x" * 4001}), 422, "invalid_input")
    refused(_raw(room, ada), 422, "invalid_input")
    refused(room.send(ada, answers={"why": "x" * 70_000}), 422, "invalid_input")
    assert room.send(ada, answers={"why": "x" * 2**22}).status_code == 413  # a flight's log may come with it
    assert room.wall()["students"][0]["steps"]["settle"]["attempts"] <= 2


def _raw(room: ClassRoom, student: str) -> Any:
    """An attempt with half a sign in an answer."""
    body = {
        "student": student,
        "id": str(uuid.uuid4()),
        "step": "settle",
        "design": {},
        "answers": {"why": "\ud83d"},
    }
    headers = {"Content-Type": "application/json"}
    return room.client.post(f"{room.address}/attempts", content=json.dumps(body), headers=headers)


def test_an_attempt_made_offline_tells_both_times(room):
    ada = room.join()["student"]
    told = room.hand_in(ada, at="2026-11-01T10:00:00+01:00")
    assert told["handed_at"] == "2026-11-01T09:00:00.000Z" and told["at"] > told["handed_at"]
    for wrong in ("yesterday", "2026-11-01T10:00:00", "2026-13-01T10:00:00Z", 5):
        refused(room.send(ada, at=wrong), 422, "invalid_input")


# Drafts and hints.


def test_an_older_draft_never_replaces_a_newer_one(room):
    ada = room.join()["student"]
    assert room.draft(ada, 7, SOLVED).status_code == 204
    assert room.draft(ada, 6, UNSOLVED).status_code == 204
    assert room.mine(ada)["steps"]["settle"]["design"] == SOLVED
    room.draft(ada, 8, UNSOLVED)
    step = room.mine(ada)["steps"]["settle"]
    assert step["design"] == UNSOLVED and step["seq"] == 8
    (row,) = room.wall()["students"]
    assert [pole["re"] for pole in row["poles"]] == UNSOLVED["poles"] and row["step"] == "settle"


def test_a_hint_costs_once_and_its_text_is_there_when_one_comes_back(room):
    ada = room.join()
    assert "SECRET-HINT" not in json.dumps(ada["lab"])
    body = {"student": ada["student"], "step": "settle", "hint": 2}
    for _ in range(2):
        told = room.client.post(f"{room.address}/hints", json=body).json()
        assert (told["text"], told["cost"]) == ("SECRET-HINT", 1)
    assert room.hand_in(ada["student"])["points"] == 6 - 1
    back = room.client.post(f"{room.address}/join", json={"student": ada["student"]}).json()
    assert back["lab"]["steps"][0]["hints"][1]["text"] == "SECRET-HINT"
    assert back["steps"]["settle"]["hints"] == [2]
    refused(room.client.post(f"{room.address}/hints", json={**body, "hint": 3}), 404, "unknown_hint")
