"""Grades on their way: each that is better arrives, in time or later, once."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from time import time
from typing import Any

import pytest
from sqlalchemy import select, update
from starlette.testclient import TestClient

from app.classes.database import Writing
from app.classes.engines import open_engines
from app.classes.schema_lti import links, outbox
from app.lti import grades
from app.lti.errors import LtiError, PlatformError
from app.lti.keys import new_key
from app.lti.outward import Answer, ask
from app.lti.services import Score, Services
from app.main import create_app
from tests.app.lti_course import Course, course_in, register, settings_in
from tests.app.test_lti_tokens import PLATFORM
from tests.loops import run as looped
from tests.lti_platform import Link, Platform
from tests.patience import PATIENCE, until
from tests.postgresql import PostgreSQL, postgresql

SLOW, FAST = [-2, -2.5, -9.25, -8.76], [-6, -7, -9.25, -8.76]


@pytest.fixture(autouse=True)
def soon(monkeypatch: pytest.MonkeyPatch) -> None:
    """Looks and tries are soon here; that they are not in earnest is a number."""
    monkeypatch.setattr(grades, "_POLL_SECONDS", 0.05)
    monkeypatch.setattr(grades, "_AWAY_SECONDS", 0.05)
    monkeypatch.setattr(grades, "_FIRST_PAUSE", 0.05)


@pytest.fixture(scope="module")
def server() -> Iterator[PostgreSQL]:
    with postgresql() as running:
        yield running


@pytest.fixture(params=["sqlite", "postgresql"])
def course(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Course]:
    more = {}
    if request.param == "postgresql":
        more["database"] = request.getfixturevalue("server").fresh("grades")
    with course_in(tmp_path, **more) as course:
        course.platform.add_link(Link("l1", custom={"lab": "small"}))
        yield course


def rows(course: Course) -> list[Any]:
    """The outbox, as another process sees it."""
    engines = open_engines(course.settings.database_address)
    try:
        with engines.reading.begin() as connection:
            return list(connection.execute(select(outbox)))
    finally:
        engines.dispose()


def test_each_better_attempt_arrives(course: Course) -> None:
    code, secret = course.land("s1", "l1")
    first = course.hand_in(code, secret, SLOW, four=4)
    (score,) = course.platform.wait_for_scores(1, PATIENCE)
    assert (score["userId"], score["scoreGiven"], score["scoreMaximum"]) == ("s1", first["points"], 17)
    assert (score["activityProgress"], score["gradingProgress"]) == ("InProgress", "FullyGraded")
    assert score["column"] == "1", "Moodle's columns have a query: /scores stands before it"
    until(
        lambda: course.ask("GET", f"{code}/mine", secret).json()["platform"].get("sent"), "it is told as sent"
    )
    mine = course.ask("GET", f"{code}/mine", secret).json()["platform"]
    assert mine == {"name": "uni", "subject": "s1", "points": first["points"], "sent": True}
    course.hand_in(code, secret, SLOW)  # worse: the best counts
    better = course.hand_in(code, secret, FAST, four=4, who=2)
    assert better["points"] > first["points"]
    scores = course.platform.wait_for_scores(2, PATIENCE)
    assert [score["scoreGiven"] for score in scores] == [first["points"], better["points"]]
    assert scores[0]["timestamp"] < scores[1]["timestamp"]
    until(lambda: all(row.sent for row in rows(course)), "the outbox is settled")


def test_nobody_gets_a_grade_for_nothing(course: Course) -> None:
    course.land("s1", "l1")
    code, secret = course.land("s2", "l1")
    course.hand_in(code, secret, FAST)
    course.platform.wait_for_scores(1, PATIENCE)
    until(lambda: all(row.sent for row in rows(course)), "the outbox is settled")
    assert {score["userId"] for score in course.platform.scores} == {"s2"} and len(rows(course)) == 1


def test_grades_wait_while_the_platform_is_away_and_the_newest_arrives(
    course: Course, tmp_path: Path
) -> None:
    code, secret = course.land("s1", "l1")
    course.platform.away = True
    course.hand_in(code, secret, SLOW, four=4)
    until(lambda: any(row.tries for row in rows(course)), "it was tried in vain")
    best = course.hand_in(code, secret, FAST, four=4, who=2)
    until(
        lambda: any(row.tries and row.points == best["points"] for row in rows(course)),
        "and the better one",
    )
    (row,) = rows(course)
    assert not row.sent and "503" in row.error and not course.platform.scores
    course.platform.away = False
    (score,) = course.platform.wait_for_scores(1, PATIENCE)
    assert score["scoreGiven"] == best["points"]
    until(lambda: rows(course)[0].sent, "it is settled")


def test_grades_outlive_the_server(tmp_path: Path) -> None:
    """Handed in while the platform was away, sent by the next process without anybody asking it anything."""
    with course_in(tmp_path) as course:
        platform = course.platform
        platform.add_link(Link("l1", custom={"lab": "small"}))
        code, secret = course.land("s1", "l1")
        platform.away = True
        best = course.hand_in(code, secret, FAST)
    second = Platform(platform.tool)  # at another port, as a moved platform
    second.links, second.columns = platform.links, platform.columns
    second.private, second.public, second.tool_keys = platform.private, platform.public, platform.tool_keys
    settings = settings_in(tmp_path)
    register(settings, second)
    engines = open_engines(settings.database_address)
    with engines.writing.begin() as connection:
        moved = {"lineitem": f"{second.address}/lineitems/1/lineitem?type_id=3"}
        connection.execute(update(links).values(**moved))
        connection.execute(update(outbox).values(due=0.0))
    engines.dispose()
    with second.running(), TestClient(create_app(settings)):
        (score,) = second.wait_for_scores(1, PATIENCE)
    assert score["scoreGiven"] == best["points"]


def test_a_column_is_made_where_the_platform_has_none(course: Course) -> None:
    course.platform.add_link(Link("l2", title="Own column", custom={"lab": "small"}, column=False))
    code, secret = course.land("s1", "l2")
    course.hand_in(code, secret, SLOW, four=4)
    (score,) = course.platform.wait_for_scores(1, PATIENCE)
    assert course.platform.columns[score["column"]]["resourceLinkId"] == "l2"
    course.land("s1", "l2")  # a launch that still names no column does not lose it
    course.hand_in(code, secret, FAST)
    scores = course.platform.wait_for_scores(2, PATIENCE)
    assert scores[0]["column"] == scores[1]["column"] and len(course.platform.columns) == 2


def test_what_a_platform_takes_for_old_is_sent_again(course: Course) -> None:
    """Its clock goes before ours, and it counts from when it took a grade, in whole seconds, as Moodle does."""
    course.platform.ahead = 2
    code, secret = course.land("s1", "l1")
    course.hand_in(code, secret, SLOW, four=4)
    course.platform.wait_for_scores(1, PATIENCE)
    best = course.hand_in(code, secret, FAST, four=4, who=2)
    assert course.platform.wait_for_scores(2, PATIENCE)[-1]["scoreGiven"] == best["points"]
    until(lambda: all(row.sent for row in rows(course)), "the outbox is settled")
    assert any(path.startswith("POST /lineitems") for path in course.platform.asked)


def test_what_an_instructor_deletes_is_sent_no_more(course: Course) -> None:
    code, key = course.land("t1", "l1")
    _, secret = course.land("s1", "l1")
    course.platform.away = True
    course.hand_in(code, secret, SLOW, four=4)
    until(lambda: rows(course), "it waits")
    assert course.ask("DELETE", code, key).status_code == 204
    assert not rows(course)


def test_a_platform_that_refuses_is_asked_ever_more_seldom() -> None:
    due = grades.Due(1, 1, 1, "l", "t", "x", "", (), 0.0, Score("s", 1, 2, 0.0), 0)
    waits = [pause_after(due, tries, PlatformError("away")) for tries in (0, 1, 5, 50)]
    assert waits == [15.0, 30.0, 480.0, 3600.0]
    assert pause_after(due, 0, PlatformError("busy", 503, 100.0)) == 100.0
    assert pause_after(due, 0, PlatformError("busy", 503, 1e6)) == 3600.0


def pause_after(due: grades.Due, tries: int, error: PlatformError) -> float:
    return grades.pause(replace(due, tries=tries), error, first=15.0)


def test_two_replicas_send_a_grade_once(
    course: Course, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, secret = course.land("s1", "l1")
    with TestClient(create_app(course.settings)) as other:
        assert other.get("/lti/keys").status_code == 200  # its grader runs
        for poles in (SLOW, FAST):
            course.hand_in(code, secret, poles, four=4)
        course.platform.wait_for_scores(1, PATIENCE)
        until(lambda: all(row.sent for row in rows(course)), "the outbox is settled")
    given = [score["scoreGiven"] for score in course.platform.scores]
    assert given == sorted(set(given)), "each once"


def test_a_grade_is_in_one_hand_at_a_time(course: Course) -> None:
    code, secret = course.land("s1", "l1")
    course.platform.away = True
    course.hand_in(code, secret, SLOW, four=4)
    until(lambda: any(row.tries for row in rows(course)), "it was tried in vain")
    engines = open_engines(course.settings.database_address)
    with engines.writing.begin() as connection:
        writing, now = Writing(connection), time() + 3600.0
        (due,) = grades.due_grades(connection, now)
        assert grades.claim(writing, due, now) and not grades.claim(writing, due, now)
        assert grades.due_grades(connection, now) == []
        later = now + 121.0  # whoever had it may have crashed
        assert grades.claim(writing, due, later)
        connection.rollback()
    engines.dispose()


# The calls of a platform, one by one.


class Wire:
    """Answers in turn, and what was asked."""

    def __init__(self, *answers: Answer) -> None:
        self.answers, self.asked = list(answers), list[tuple[str, str, dict[str, str], bytes | None]]()
        self.services = Services(new_key, self.send, lambda: 1000.0)

    def send(
        self, method: str, address: str, hosts: Any, *, headers: Any, body: bytes | None = None
    ) -> Answer:
        self.asked.append((method, address, dict(headers), body))
        return self.answers.pop(0)


TOKEN = Answer(200, {}, b'{"access_token": "abc", "expires_in": 3600}')
SCORE = Score("s1", 3.5, 10.0, 1_800_000_000.25, to_mark=1)


def test_a_token_serves_until_it_ends_and_a_lost_one_is_replaced() -> None:
    wire = Wire(
        TOKEN, Answer(200, {}, b""), Answer(204, {}, b""), Answer(401, {}, b""), TOKEN, Answer(200, {}, b"")
    )
    for _ in range(3):
        wire.services.put_score(PLATFORM, "https://moodle.example/l/1?type_id=2", SCORE)
    assert [method + address[22:] for method, address, *_ in wire.asked] == [
        "POST/mod/lti/token.php", "POST/l/1/scores?type_id=2", "POST/l/1/scores?type_id=2",
        "POST/l/1/scores?type_id=2", "POST/mod/lti/token.php", "POST/l/1/scores?type_id=2",
    ]  # fmt: skip
    assert wire.asked[1][2]["Authorization"] == "Bearer abc"
    assert b'"timestamp": "2027-01-15T08:00:00.250+00:00"' in (wire.asked[1][3] or b"")
    assert b"1 answer waits" in (wire.asked[1][3] or b"")


@pytest.mark.parametrize(
    "answers",
    [
        (Answer(400, {}, b""),),
        (Answer(200, {}, b"<html>"),),
        (Answer(200, {}, b'{"access_token": "a b"}'),),
        (Answer(200, {}, b'{"access_token": "a\\r\\nX: y"}'),),
        (TOKEN, Answer(302, {"location": "https://evil.example"}, b"")),
        (TOKEN, Answer(401, {}, b""), TOKEN, Answer(401, {}, b"")),
        (TOKEN, Answer(409, {}, b"")),
        (TOKEN, Answer(500, {}, b"")),
    ],
)
def test_what_goes_wrong_is_told(answers: tuple[Answer, ...]) -> None:
    wire = Wire(*answers)
    with pytest.raises(PlatformError):
        wire.services.put_score(PLATFORM, "https://moodle.example/l/1", SCORE)
    assert not wire.answers


def test_members_on_pages_elsewhere_are_not_fetched() -> None:
    page = Answer(200, {"link": '<https://evil.example/m?page=2>; rel="next"'}, b'{"members": []}')
    wire = Wire(TOKEN, page)
    send = wire.services._send
    wire.services._send = lambda *given, **more: (  # type: ignore[method-assign]
        ask(*given, **more) if "evil" in given[1] else send(*given, **more)
    )
    with pytest.raises(LtiError) as caught:
        wire.services.members(PLATFORM, "https://moodle.example/m")
    assert caught.value.code == "foreign_address"


def test_members_who_have_left_or_are_odd_are_left_aside() -> None:
    body = (
        b'{"members": [{"user_id": "1", "name": "A", "roles": ["Learner"]}, {"user_id": "2", "status": "Inactive"},'
        b' {"user_id": 3}, 4, {"user_id": "5", "roles": 6, "name": 7}]}'
    )
    members = Wire(TOKEN, Answer(200, {}, body)).services.members(PLATFORM, "https://moodle.example/m")
    assert [(member.subject, member.name) for member in members] == [("1", "A"), ("5", "")]


def test_a_finished_lab_is_told_as_completed() -> None:
    assert Score("s", 10.0, 10.0, 0.0).body()["activityProgress"] == "Completed"
    assert Score("s", 10.0, 10.0, 0.0, to_mark=1).body()["activityProgress"] == "InProgress"


def test_the_grader_goes_on_after_trouble(monkeypatch: pytest.MonkeyPatch) -> None:
    looks = []

    class Broken(grades.Grader):
        async def once(self) -> bool:
            looks.append(time())
            if len(looks) < 3:
                raise RuntimeError("whatever it is")
            raise asyncio.CancelledError

    async def run() -> None:
        with pytest.raises(asyncio.CancelledError):
            await Broken(None, None).run()  # type: ignore[arg-type]

    looped(run())
    assert len(looks) == 3
