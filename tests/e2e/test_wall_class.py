"""What an instructor does with a whole class: results, closing, secret links, sheets of paper, its end."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from tests.browser import GONE, opened, visited
from tests.e2e.classroom import LABS, SLOW, Classroom, calling, link, poles, wall
from tests.e2e.conftest import App, running_app

HOSTILE = '<img src=x onerror="document.title=1"> =cmd()'


def test_from_the_join_sheet_to_the_wall(chromium: Browser, lab_server: App, room: Classroom):
    """What the sheet says is what a student finds, and what a student does is what the instructor sees."""
    with (
        wall(chromium, lab_server.url, room) as page,
        opened(chromium, lab_server.url) as student,
    ):
        page.get_by_test_id("to-join").click()
        expect(page.get_by_test_id("join-sheet")).to_contain_text("Press Labs, and enter the code")
        code = page.get_by_test_id("join-code").inner_text()
        page.get_by_test_id("to-wall").click()
        student.get_by_role("link", name="Labs", exact=True).click()
        student.get_by_label("Class code").fill(code)
        student.get_by_role("button", name="Join").click()
        student.get_by_test_id("join-name").fill("Ada")
        student.get_by_role("button", name="Join").click()
        row = page.locator("[data-testid=wall-rows] tr")
        expect(row.locator(".who")).to_have_text("Ada")
        student.get_by_test_id("lab-hand-in").click()
        expect(row.locator("td").first.locator(".goal")).to_have_class(["goal missed", "goal met"])
        expect(row.locator("td").first).to_have_class("here")
        expect(page.locator(".everyone circle")).to_have_count(2)
        page.get_by_role("button", name="Ada").click()
        expect(page.get_by_test_id("work-settle").locator("details")).to_have_count(1)


@pytest.mark.parametrize("kind", ["plain", "moodle", "canvas", "json"])
def test_files_are_the_servers_bytes(chromium: Browser, lab_server: App, room: Classroom, kind: str):
    room.join("Ada", email="ada@example.edu")
    room.join("=cmd()")
    room.hand_in("Ada", "settle")
    with wall(chromium, lab_server.url, room) as page:
        page.get_by_test_id("results-open").click()
        with page.expect_download() as download:
            page.get_by_test_id(f"file-{kind}").click()
        got = Path(download.value.path()).read_bytes()
        query = "/export" if kind == "json" else f"?format=csv&for={kind}"
        told = room.client.get(room.path(query), headers=room.headers).raise_for_status().content
        times = rb"\d{4}-\d\d-\d\dT[\d:.]+Z"  # the export tells when it was made
        assert re.sub(times, b"", got) == re.sub(times, b"", told)
        assert b"Ada" in got
        assert (
            download.value.suggested_filename
            == f"class-{room.code}-{kind}.{'json' if kind == 'json' else 'csv'}"
        )


def test_close_reopen_and_close_by_the_clock(chromium: Browser, lab_server: App, room: Classroom):
    room.join("Ada")
    with wall(chromium, lab_server.url, room, timezone_id="America/New_York") as page:
        page.get_by_test_id("manage-open").click()
        page.get_by_test_id("close-class").click()
        expect(page.get_by_test_id("class-state")).to_contain_text("Closed")
        expect(page.get_by_test_id("facts")).to_contain_text("closed")
        assert room.hand_in("Ada", "settle").status_code == 409
        page.get_by_test_id("reopen-class").click()
        expect(page.get_by_test_id("class-state")).to_have_text("Open, until you close it.")
        assert room.hand_in("Ada", "settle").status_code == 200
        page.get_by_test_id("closes").fill("2027-01-20T18:30")
        page.get_by_test_id("close-at").click()
        expect(page.get_by_test_id("class-state")).to_contain_text("Open until")
        assert room.told()["closes"].startswith("2027-01-20T23:30:00"), "in the instructor's own time"
        page.get_by_test_id("reopen-class").click()
        expect(page.get_by_test_id("class-state")).to_have_text("Open, until you close it.")
        page.get_by_test_id("new-title").fill("Another title")
        page.get_by_test_id("save-title").click()
        expect(page.get_by_test_id("title")).to_have_text("Another title")


def test_delete_asks_for_the_title(chromium: Browser, lab_server: App, room: Classroom):
    with wall(chromium, lab_server.url, room) as page:
        page.get_by_test_id("manage-open").click()
        page.get_by_test_id("delete-title").fill("Control")
        expect(page.get_by_test_id("delete-class")).to_be_disabled()
        page.get_by_test_id("delete-title").fill(room.title)
        page.get_by_test_id("delete-class").click()
        expect(page.get_by_test_id("gone")).to_have_text("The class is deleted.")
        assert room.client.get(room.path(), headers=room.headers).status_code == 404
        assert page.evaluate("() => localStorage.getItem('heli2dof.classes')") == "[]"


def test_a_class_deleted_elsewhere_is_told(chromium: Browser, lab_server: App, room: Classroom):
    with wall(chromium, lab_server.url, room) as page:
        room.client.delete(room.path(), headers=room.headers).raise_for_status()
        expect(page.get_by_test_id("gone")).to_be_visible()


def test_a_new_link_for_the_instructor_and_one_for_a_student(
    chromium: Browser, lab_server: App, room: Classroom
):
    ada = room.join("Ada")
    with wall(chromium, lab_server.url, room) as page:
        page.get_by_test_id("manage-open").click()
        old = page.get_by_test_id("instructor-link").input_value()
        assert old == link(lab_server.url, room)
        page.get_by_test_id("rotate").click()
        expect(page.get_by_test_id("secret-told")).to_contain_text("The old link has ended")
        new = page.get_by_test_id("instructor-link").input_value()
        assert room.client.get(room.path(), headers=room.headers).status_code == 403
        room.key = new.partition("&key=")[2]
        assert room.told()["code"] == room.code
        page.get_by_test_id("manage-close").click()
        room.join("Bob")
        expect(page.locator("[data-testid=wall-rows] tr")).to_have_count(2)  # it goes on by itself
        page.get_by_test_id(f"student-{ada}").click()
        page.get_by_test_id("new-link").click()
        page.get_by_test_id("new-link-make").click()
        fresh = page.get_by_test_id("new-link-field").input_value()
        assert fresh.startswith(f"{lab_server.url}#class={room.code}&me=")
        before = {"Heli2dof-Secret": room.students["Ada"]["student"]}
        assert room.client.get(room.path("/mine"), headers=before).status_code == 403
        after = {"Heli2dof-Secret": fresh.partition("&me=")[2]}
        assert room.client.get(room.path("/mine"), headers=after).json()["name"] == "Ada"


def test_the_operators_key_where_the_server_asks_for_one(chromium: Browser):
    with (
        running_app(
            labs=LABS, database="memory", classes="operator", operator_key="only-for-teachers"
        ) as server,
        visited(chromium) as visit,
    ):
        visit.forgive("401")
        page = visit.page
        page.goto(server.url + "class")
        page.get_by_test_id("lab-wall").check()
        expect(page.get_by_test_id("operator-key")).to_be_hidden()
        page.get_by_test_id("make-class").click()
        page.get_by_test_id("operator-key").fill("a guess")
        page.get_by_test_id("make-class").click()
        expect(page.get_by_test_id("make-told")).to_contain_text("key")
        page.get_by_test_id("operator-key").fill("only-for-teachers")
        page.get_by_test_id("make-class").click()
        expect(page.get_by_test_id("nobody")).to_be_visible()


def test_the_secret_link_is_copied_without_being_shown(chromium: Browser, lab_server: App, room: Classroom):
    with wall(chromium, lab_server.url, room, permissions=["clipboard-read", "clipboard-write"]) as page:
        page.get_by_test_id("keep-link").click()
        expect(page.get_by_test_id("keep-told")).to_have_text("Copied.")
        assert page.evaluate("() => navigator.clipboard.readText()") == link(lab_server.url, room)
        assert room.key not in page.content()


def test_an_old_link_says_so(chromium: Browser, lab_server: App, room: Classroom):
    with visited(chromium) as visit:
        visit.forgive("403")
        visit.page.goto(link(lab_server.url, room) + "x")
        expect(visit.page.get_by_test_id("gone")).to_contain_text("replaced or deleted")


def test_removing_a_student(chromium: Browser, lab_server: App, room: Classroom):
    ada = room.join("Ada")
    with wall(chromium, lab_server.url, room) as page:
        page.get_by_test_id(f"student-{ada}").click()
        page.get_by_test_id("remove-student").click()
        page.get_by_test_id("remove-student-yes").click()
        expect(page.locator("dialog")).to_have_count(0)
        expect(page.get_by_test_id("nobody")).to_be_visible()


def test_the_labs_notes_are_for_who_has_the_secret(chromium: Browser, lab_server: App, room: Classroom):
    with wall(chromium, lab_server.url, room) as page:
        assert "slow poles" not in page.content()
        page.get_by_test_id("notes-open").click()
        expect(page.get_by_test_id("notes-text").locator("strong")).to_have_text("slow poles")


PAPER = "() => { window.print = () => { window.printed = (window.printed ?? 0) + 1; }; }"
ON_PAPER = "() => document.getElementById('sheets').innerText"


def test_sheets_of_paper(chromium: Browser, lab_server: App, room: Classroom):
    for name in ("Björn", "Ada", HOSTILE):
        room.join(name)
        room.hand_in(name, "settle", poles(*SLOW), who=1)
        room.hand_in(name, "why", why=f"Since {name} knows")
    with wall(chromium, lab_server.url, room) as page:
        page.evaluate(PAPER)
        page.get_by_test_id("results-open").click()
        for testid, sheets in (("print-class", 1), ("print-all", 3)):
            page.get_by_test_id(testid).click()
            page.wait_for_function(f"() => document.querySelectorAll('.sheet').length === {sheets}")
            page.emulate_media(media="print")
            said = page.evaluate(ON_PAPER)
            for word in ("Ada", "Björn", HOSTILE, room.title, "Settle within a second"):
                assert word in said, (testid, word)
            expect(page.locator("#content")).to_be_hidden()
            assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4"))) == sheets
            assert page.locator(".sheet").count() == 0, "they are gone after printing"
            page.emulate_media(media="screen")
        for word in ("≤ 1.00 s", "Since Ada knows", "the fastest", "not marked yet"):
            assert word in said
        assert said.index("Ada") < said.index("Björn"), "by name"
        page.get_by_test_id("results-close").click()
        page.get_by_test_id(f"student-{room.students['Ada']['id']}").click()
        page.get_by_test_id("print-student").click()
        page.emulate_media(media="print")
        assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4"))) == 1
        assert page.evaluate("() => window.printed") == 3


def test_a_server_that_goes_and_comes_back(chromium: Browser, tmp_path: Path):
    settings = {"labs": LABS, "database": f"sqlite:///{tmp_path}/classes.sqlite"}
    with visited(chromium) as visit:
        visit.forgive(GONE)
        visit.forgive("ERR_INCOMPLETE")
        page = visit.page
        with running_app(**settings) as lab_server:
            with calling(lab_server.url) as client:
                room = Classroom.made(client)
                room.join("Ada")
            page.goto(link(lab_server.url, room))
            expect(page.locator("[data-testid=wall-rows] tr")).to_have_count(1)
        expect(page.locator("#told")).to_contain_text("No connection to the server. This is the wall of")
        with running_app(lab_server.port, **settings):
            page.evaluate("() => dispatchEvent(new Event('online'))")
            expect(page.locator("#told")).to_be_empty()
            with calling(lab_server.url) as client:
                client.post(room.path("/join"), json={"name": "Bob"}).raise_for_status()
            expect(page.locator("[data-testid=wall-rows] tr")).to_have_count(2)
