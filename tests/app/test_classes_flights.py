"""Attempts that carry a flight: marked alone and in a class, once, and the log not kept."""

from __future__ import annotations

import sqlite3
import uuid
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from app.main import create_app
from heli2dof_core.flight import checksum
from heli2dof_core.labs import read_lab, student_rig
from heli2dof_core.labs.bodies import body_of_flat
from heli2dof_core.labs.flights import tried_flight
from heli2dof_core.labs.rigs import solution_flat
from tests.app.class_room import API, class_settings, refused
from tests.labs.test_flight_goals import LAB, SEED


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("flown")


@pytest.fixture(scope="module")
def client(folder: Path) -> Iterator[TestClient]:
    settings = class_settings(folder)
    (settings.labs / "flown.yaml").write_text(LAB, encoding="utf-8")
    with TestClient(create_app(settings)) as client:
        yield client


def flown_on(rig: dict) -> tuple[dict, dict]:
    """The lab's solution on a rig, and its flight."""
    lab = read_lab(LAB)
    body = body_of_flat(solution_flat(lab, lab.steps[0], rig, SEED))
    return body, tried_flight(lab.steps[0], body)


@pytest.fixture(scope="module")
def alone() -> tuple[dict, dict]:
    return flown_on(student_rig(read_lab(LAB), SEED))


def test_an_attempt_alone_is_marked_with_its_flight(client, alone):
    body, log = alone
    asked = {"seed": SEED, "step": "calm", "design": body, "flight": log}
    marked = client.post("/api/v1/labs/flown/mark", json=asked).json()
    assert [goal["met"] for goal in marked["goals"]] == [True, True] and marked["points"] == 4
    assert marked["flight"]["checksum"] == log["checksum"] and marked["flight"]["task"] == "hold"
    without = client.post("/api/v1/labs/flown/mark", json={**asked, "flight": None}).json()
    assert without["goals"][0]["value_text"] == "not flown" and "flight" not in without
    other = client.post("/api/v1/labs/flown/mark", json={**asked, "seed": SEED + 1}).json()
    assert other["goals"][0]["value_text"] == "not counted"  # of another student's rig
    edited = {**log, "ticks": log["ticks"] - 1}
    told = client.post("/api/v1/labs/flown/mark", json={**asked, "flight": edited}).json()
    assert told["points"] == 1 and "checksum" in told["goals"][0]["message"]


def test_what_is_no_flight_at_all_is_refused_or_does_not_count(client, alone):
    body, _ = alone
    asked = {"seed": SEED, "step": "calm", "design": body}
    for flight in ([1], "log", 3):
        reply = client.post("/api/v1/labs/flown/mark", json={**asked, "flight": flight})
        assert reply.status_code == 422 and reply.json()["field"] == "flight"
    for flight in ({"flight": 1, "design": 3, "ticks": "x"}, {"flight": 1, "events": {}}):
        for own in (flight, {**flight, "checksum": checksum(flight)}):
            told = client.post("/api/v1/labs/flown/mark", json={**asked, "flight": own})
            assert told.status_code == 200, told.text
            assert told.json()["goals"][0]["value_text"] == "not counted"


def joined(client: TestClient) -> tuple[str, str, dict]:
    made = client.post(API, json={"lab": "flown", "title": "Monday"}).json()
    ada = client.post(f"{API}/{made['code']}/join", json={"name": "Ada"}).json()
    return made["code"], made["instructor"], ada


def test_a_class_keeps_the_figures_and_the_checksum_and_not_the_log(client, folder):
    code, secret, ada = joined(client)
    body, log = flown_on(ada["rig"])
    attempt = {
        "student": ada["student"],
        "id": str(uuid.uuid4()),
        "step": "calm",
        "design": body,
        "flight": log,
    }
    path = f"{API}/{code}/attempts"
    first = client.post(path, json=attempt).json()
    assert first["points"] == 4 and first["best"]["flight"]["checksum"] == log["checksum"]
    again = client.post(path, json={**attempt, "flight": None})  # what comes twice counts once
    assert again.json()["flight"] == first["flight"]
    mine = client.get(f"{API}/{code}/mine", headers={"Heli2dof-Secret": ada["student"]}).json()
    assert mine["steps"]["calm"]["best"]["flight"] == first["flight"]
    told = client.get(f"{API}/{code}/students/{ada['id']}", headers={"Heli2dof-Secret": secret})
    assert log["checksum"] in told.text
    kept = b"".join(path.read_bytes() for path in folder.glob("classes.db*"))
    assert log["checksum"].encode() in kept
    with sqlite3.connect(folder / "classes.db") as database:
        (rows,) = database.execute("SELECT count(*) FROM attempts WHERE result LIKE '%gust%'").fetchone()
        (size,) = database.execute("SELECT max(length(design) + length(result)) FROM attempts").fetchone()
    assert rows == 0 and size < 8000


def test_a_flight_may_be_long_and_what_is_kept_may_not(client):
    code, _, ada = joined(client)
    body, log = flown_on(ada["rig"])
    busy = deepcopy(log)
    busy["events"] += [[log["ticks"], "sticks", 0.123456789, -0.987654321 - n / 1e4] for n in range(5000)]
    del busy["checksum"]
    busy["checksum"] = checksum(busy)
    attempt = {"student": ada["student"], "step": "calm", "design": body, "flight": busy}
    sent = client.post(f"{API}/{code}/attempts", json={**attempt, "id": str(uuid.uuid4())})
    assert len(sent.request.content) > 150_000 and sent.status_code == 200, sent.text
    assert sent.json()["points"] == 4
    answers = {f"q{n}": "x" * 4000 for n in range(20)}
    wordy = client.post(
        f"{API}/{code}/attempts", json={**attempt, "id": str(uuid.uuid4()), "answers": answers}
    )
    assert wordy.status_code == 422 and "answers" in wordy.json()["field"]
    draft = {"student": ada["student"], "step": "calm", "design": body, "seq": 1, "answers": answers}
    refused(client.put(f"{API}/{code}/draft", json=draft), 413, "body_too_large")
    huge = {**attempt, "id": str(uuid.uuid4()), "flight": {"events": ["x" * 2**20]}}
    refused(client.post(f"{API}/{code}/attempts", json=huge), 413, "body_too_large")
