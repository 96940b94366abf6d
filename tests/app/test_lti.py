"""Launches out of a platform: who lands where, and who does not."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from typing import Any

import pytest
from starlette.testclient import TestClient

from app.main import create_app
from app.ops.settings import Settings
from tests.app.lti_course import TOOL, Course, course_in, landed, settings_in
from tests.app.test_page_types import misplaced, replied
from tests.lti_platform import Link, Person
from tests.postgresql import postgresql

CLAIM = "https://purl.imsglobal.org/spec/lti/claim/"


@pytest.fixture(scope="module", params=["sqlite", "postgresql"])
def course(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> Iterator[Course]:
    with ExitStack() as stack:
        more = {}
        if request.param == "postgresql":
            more["database"] = stack.enter_context(postgresql()).url()
        yield stack.enter_context(course_in(tmp_path_factory.mktemp("lti"), **more))


@pytest.fixture
def link(course: Course, request: pytest.FixtureRequest) -> str:
    """A link to the small lab, for one test."""
    return course.platform.add_link(Link(request.node.name, custom={"lab": "small"})).id


def test_an_instructor_and_students_land_in_one_class(course: Course, link: str) -> None:
    code, key = course.land("t1", link)
    ada, bo = course.land("s1", link), course.land("s2", link)
    assert ada[0] == bo[0] == code and ada[1] != bo[1]
    told = course.ask("GET", code, key).json()
    assert [student["name"] for student in told["students"]] == ["Ada Student", "Bo Student"]
    assert told["title"] == "Poles of a helicopter" and "email" not in told["students"][0]
    mine = course.ask("GET", f"{code}/mine", ada[1])
    assert mine.status_code == 200 and mine.json()["name"] == "Ada Student"


def test_each_launch_leads_to_the_same_place(course: Course, link: str) -> None:
    student, teacher = course.land("s1", link), course.land("t1", link)
    assert course.land("s1", link) == student and course.land("t1", link) == teacher


def test_links_have_classes_of_their_own(course: Course, link: str) -> None:
    other = course.platform.add_link(Link(link + "-2", custom={"lab": "small"})).id
    assert course.land("s1", link)[0] != course.land("s1", other)[0]


def test_one_class_comes_of_many_first_launches(course: Course, link: str) -> None:
    platform = course.platform
    for number in range(12):
        platform.people[f"x{number}"] = Person(f"x{number}", f"Student {number}", "Learner")
    forms = [
        (browser := course.browser(), course.launch(browser, f"x{number}", link)) for number in range(12)
    ]
    cookies = [dict(browser.cookies) for browser, _ in forms]

    def post(number: int) -> Any:
        head = {"Cookie": "; ".join(f"{name}={value}" for name, value in cookies[number].items())}
        return course.client.post("/lti/launch", data=forms[number][1], headers=head, follow_redirects=False)

    with ThreadPoolExecutor(12) as pool:
        replies = list(pool.map(post, range(12)))
    assert len({landed(reply, instructor=False)[0] for reply in replies}) == 1
    assert len({landed(reply, instructor=False)[1] for reply in replies}) == 12


def test_without_a_lab_students_wait_for_the_instructor_who_chooses(course: Course) -> None:
    link = course.platform.add_link(Link("no-lab", custom={})).id
    early = course.open(course.browser(), "s1", link)
    assert early.status_code == 409 and "has not chosen a lab" in early.text
    teacher = course.browser()
    page = course.open(teacher, "t1", link)
    assert page.status_code == 200 and "A small lab" in page.text
    ticket = hidden(page.text, "ticket")
    assert (
        course.browser().ask("POST", "/lti/choose", data={"ticket": "x" * 43, "lab": "small"}).status_code
        == 403
    )
    assert teacher.ask("POST", "/lti/choose", data={"ticket": ticket, "lab": "no-such"}).status_code == 404
    reply = teacher.ask("POST", "/lti/choose", data={"ticket": ticket, "lab": "small"})
    code, _ = landed(reply, instructor=True)
    assert course.land("s1", link)[0] == code
    again = teacher.ask("POST", "/lti/choose", data={"ticket": ticket, "lab": "small"})
    assert again.status_code == 403 and "used already" in again.text


def test_a_lab_is_chosen_into_the_course(course: Course) -> None:
    teacher = course.browser()
    page = course.open(teacher, "t1", "choice")
    assert page.status_code == 200, page.text
    form = {"ticket": hidden(page.text, "ticket"), "lab": "small"}
    sent = teacher.ask("POST", "/lti/choose", data=form)
    assert f'action="{course.platform.address}/chosen"' in sent.text
    assert f"form-action {course.platform.address};" in sent.headers["content-security-policy"]
    (item,) = course.platform.chosen(hidden(sent.text, "JWT"))
    assert item["type"] == "ltiResourceLink" and item["custom"] == {"lab": "small"}
    assert item["url"] == f"{TOOL}/lti/launch" and item["lineItem"]["scoreMaximum"] == 17
    link = course.platform.add_link(Link("chosen", title=item["title"], custom=item["custom"])).id
    assert course.land("s2", link)[0] == course.land("t1", link)[0]


def test_students_choose_nothing(course: Course) -> None:
    assert course.open(course.browser(), "s1", "choice").status_code == 403


def test_a_deleted_class_makes_room_for_another(course: Course, link: str) -> None:
    code, key = course.land("t1", link)
    course.land("s1", link)
    assert course.ask("DELETE", code, key).status_code == 204
    assert course.land("s1", link)[0] != code


def test_a_deleted_student_may_come_again(course: Course, link: str) -> None:
    code, secret = course.land("s1", link)
    assert course.ask("DELETE", f"{code}/mine", secret).status_code == 204
    code_again, secret_again = course.land("s1", link)
    assert code_again == code and secret_again != secret


def test_after_new_links_a_launch_still_opens(course: Course, link: str) -> None:
    code, key = course.land("t1", link)
    _, secret = course.land("s1", link)
    (student,) = course.ask("GET", code, key).json()["students"]
    assert course.ask("POST", f"{code}/students/{student['id']}/link", key).status_code == 200
    rotated = course.ask("POST", f"{code}/instructor", key).json()["instructor"]
    assert course.ask("GET", code, key).status_code == 403
    _, newer = course.land("s1", link)
    assert newer != secret and course.ask("GET", f"{code}/mine", newer).status_code == 200
    assert course.ask("GET", f"{code}/mine", secret).status_code == 403
    _, newer_key = course.land("t1", link)
    assert newer_key not in (key, rotated) and course.ask("GET", code, newer_key).status_code == 200
    assert course.land("s1", link)[1] == newer and course.land("t1", link)[1] == newer_key


def test_a_closed_class_tells_who_comes_late(course: Course, link: str) -> None:
    code, key = course.land("t1", link)
    known = course.land("s1", link)
    assert course.ask("PATCH", code, key, json={"open": False}).status_code == 200
    late = course.open(course.browser(), "s2", link)
    assert late.status_code == 409 and "closed" in late.text
    assert course.land("s1", link) == known


def test_names_are_optional_and_follow_the_platform(course: Course, link: str) -> None:
    code, key = course.land("t1", link)
    platform = course.platform
    platform.people["n1"] = Person("n1", "", "Learner")
    course.land("n1", link)
    names = lambda: [student["name"] for student in course.ask("GET", code, key).json()["students"]]  # noqa: E731
    assert names() == ["Student 1"]
    platform.people["n1"].name = "<b>Nora</b>\u202e"
    course.land("n1", link)
    assert names() == ["<b>Nora</b>"]


def test_members_of_the_course(course: Course, link: str) -> None:
    code, key = course.land("t1", link)
    _, secret = course.land("s1", link)
    told = course.ask("GET", f"{code}/members", key)
    assert told.status_code == 200, told.text
    by_name = {member["name"]: member for member in told.json()["members"]}
    assert list(misplaced(told.json(), replied("/api/v1/classes/{code}/members", "get"))) == []
    assert by_name["Theresa Teacher"]["instructor"] and "student" not in by_name["Bo Student"]
    assert by_name["Ada Student"]["student"] > 0
    pages = [path for path in course.platform.asked if path.startswith("GET /members")]
    assert "GET /members?page=2" in pages, "the platform tells them page by page"
    assert course.ask("GET", f"{code}/members", secret).status_code == 403
    assert "s1" not in {str(value) for member in told.json()["members"] for value in member.values()}


# What is refused.


def refused(reply: Any, status: int, words: str) -> None:
    assert reply.status_code == status, reply.text
    assert words in html.unescape(reply.text)
    assert "location" not in reply.headers and "#class=" not in reply.text


def test_a_launch_counts_once(course: Course, link: str) -> None:
    browser = course.browser()
    form = course.launch(browser, "s1", link)
    cookies = dict(browser.cookies)
    assert browser.ask("POST", "/lti/launch", data=form).status_code == 303
    assert not any(browser.cookies.values()), "the cookie has done its work"
    browser.cookies = cookies
    refused(browser.ask("POST", "/lti/launch", data=form), 403, "used already")


def test_a_token_under_another_state(course: Course, link: str) -> None:
    browser = course.browser()
    first, second = course.launch(browser, "s1", link), course.launch(browser, "s1", link)
    form = {"id_token": first["id_token"], "state": second["state"]}
    refused(browser.ask("POST", "/lti/launch", data=form), 403, "another launch")
    assert browser.ask("POST", "/lti/launch", data=second).status_code == 303, "that one stays good"


def test_a_launch_of_another_browser(course: Course, link: str) -> None:
    attacker, victim = course.browser(), course.browser()
    form = course.launch(attacker, "s1", link)
    reply = victim.ask("POST", "/lti/launch", data=form)
    refused(reply, 200, "in a new window")
    victim.cookies = dict.fromkeys(attacker.cookies, "y" * 43)
    refused(victim.ask("POST", "/lti/launch", data=form), 200, "in a new window")
    refused(victim.ask("POST", "/lti/launch", data={**form, "proof": "z" * 43}), 200, "in a new window")
    own = html.unescape(re.search(r'href="([^"]*lti/login[^"]*)"', reply.text).group(1))  # type: ignore[union-attr]
    assert own.startswith(f"{TOOL}/lti/login?")
    begun = victim.ask("GET", own.removeprefix(TOOL))
    assert begun.status_code == 302 and begun.headers["location"].startswith(
        f"{course.platform.address}/auth?"
    )


def test_a_frame_of_the_platform_keeps_what_binds_a_launch(course: Course, link: str) -> None:
    browser = course.browser()
    page = course.begin(browser, "s1", link, lti_storage_target="_parent")
    said = dict(re.findall(r'data-(\w+)="([^"]*)"', page.text))
    assert page.status_code == 200 and said["do"] == "put" and said["origin"] == course.platform.address
    data = course.platform.launch(html.unescape(said["following"]))
    browser.cookies = {}  # blocked
    form = {"id_token": data["id_token"], "state": data["state"]}
    asking = browser.ask("POST", "/lti/launch", data=form)
    again = dict(re.findall(r'data-(\w+)="([^"]*)"', asking.text))
    assert (again["do"], again["key"]) == ("get", said["key"]) and said["value"] not in asking.text
    assert hidden(asking.text, "state") == form["state"]
    assert browser.ask("POST", "/lti/launch", data={**form, "proof": said["value"]}).status_code == 303


@pytest.mark.parametrize(
    ("claims", "status", "words"),
    [
        ({f"{CLAIM}deployment_id": "other"}, 403, "deployment"),
        ({f"{CLAIM}target_link_uri": "https://evil.example/"}, 403, "another server"),
        ({"iss": "https://evil.example"}, 401, "another platform"),
        ({"aud": "other"}, 401, "somebody else"),
        ({"nonce": "other"}, 403, "another launch"),
    ],
)
def test_claims_that_are_refused(
    course: Course,
    link: str,
    monkeypatch: pytest.MonkeyPatch,
    claims: dict[str, str],
    status: int,
    words: str,
) -> None:
    from lti1p3platform.registration import Registration

    sign = Registration.platform_encode_and_sign
    monkeypatch.setattr(
        Registration,
        "platform_encode_and_sign",
        lambda self, payload, expiration=None: sign(self, {**payload, **claims}, expiration),
    )
    refused(course.open(course.browser(), "s1", link), status, words)


def test_an_invented_state(course: Course, link: str) -> None:
    browser = course.browser()
    form = course.launch(browser, "s1", link)
    refused(browser.ask("POST", "/lti/launch", data={**form, "state": "x" * 43}), 403, "not begun here")
    refused(browser.ask("POST", "/lti/launch", data={"state": form["state"]}), 400, "has not said which")
    refused(browser.ask("POST", "/lti/launch", data={"error": "login_required", **form}), 403, "logged out")
    refused(browser.ask("POST", "/lti/launch", json=form), 400, "has not said which")


def test_launches_begun_in_vain_give_way(course: Course, link: str, monkeypatch: pytest.MonkeyPatch) -> None:
    from app.lti import tool

    monkeypatch.setattr(tool, "_MOST_WAITING", 3)
    old, new = course.browser(), course.browser()
    first = course.launch(old, "s1", link)
    for _ in range(3):
        course.begin(course.browser(), "s1", link)
    last = course.launch(new, "s1", link)
    refused(old.ask("POST", "/lti/launch", data=first), 403, "not begun here")
    assert new.ask("POST", "/lti/launch", data=last).status_code == 303


def test_unknown_platforms_begin_nothing(course: Course, link: str) -> None:
    for changes in ({"iss": "https://evil.example"}, {"client_id": "other"}, {"lti_deployment_id": "9"}):
        refused(course.begin(course.browser(), "s1", link, **changes), 403, "not registered here")
    foreign = course.begin(course.browser(), "s1", link, target_link_uri="https://evil.example/x")
    refused(foreign, 403, "another server")


def test_a_platform_that_is_away_during_a_launch(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.lti.keys._AWAY_SECONDS", 0.0)  # else it would have to be waited for
    with course_in(tmp_path_factory.mktemp("away")) as other:  # whose keys were not fetched yet
        link = other.platform.add_link(Link("l", custom={"lab": "small"})).id
        other.platform.away = True
        browser = other.browser()
        form = other.launch(browser, "s1", link)
        refused(browser.ask("POST", "/lti/launch", data=form), 502, "keys cannot be read")
        other.platform.away = False
        assert browser.ask("POST", "/lti/launch", data=form).status_code == 303, "the launch was not used up"


def test_launch_pages_may_be_framed_by_the_platform_alone(course: Course, link: str) -> None:
    page = course.begin(course.browser(), "s1", link, lti_storage_target="_parent")
    policy = page.headers["content-security-policy"]
    assert f"frame-ancestors 'self' {course.platform.address}" in policy and "script-src 'self';" in policy
    assert page.headers["cache-control"] == "no-store"


def test_who_lands_may_come_in_where_others_need_the_token(tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("token")
    with course_in(folder, access_token="t" * 20) as course:
        course.platform.add_link(Link("l", custom={"lab": "small"}))
        browser, stranger = course.browser(), course.browser()
        assert browser.ask("GET", "/").status_code == 401
        reply = browser.ask("POST", "/lti/launch", data=course.launch(browser, "s1", "l"))
        landed(reply, instructor=False)
        assert browser.ask("GET", "/").status_code == 200
        refused(
            stranger.ask("POST", "/lti/launch", data=course.launch(browser, "s1", "l")), 200, "new window"
        )
        assert stranger.ask("GET", "/").status_code == 401


def test_nothing_is_there_unless_registered(tmp_path_factory: pytest.TempPathFactory) -> None:
    with TestClient(create_app(settings_in(tmp_path_factory.mktemp("none")))) as client:
        for method, path in (
            ("GET", "/lti/login"), ("POST", "/lti/login"), ("POST", "/lti/launch"), ("POST", "/lti/choose"),
            ("GET", "/lti/keys"),
        ):  # fmt: skip
            assert client.request(method, path).status_code == 404
        members = client.get("/api/v1/classes/BCDFGHJ/members", headers={"Heli2dof-Secret": "x"})
        assert members.status_code == 404


def test_nothing_is_there_where_classes_are_off(tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("off")
    with course_in(folder):
        pass
    settings = Settings(**{**settings_in(folder).model_dump(), "classes": "off"})
    with TestClient(create_app(settings)) as client:
        assert client.get("/lti/keys").status_code == 404


def hidden(text: str, name: str) -> str:
    """The value of a hidden field."""
    found = re.search(rf'name="{name}" value="([^"]*)"', text)
    assert found, text
    return html.unescape(found.group(1))
