"""The instructor's page: a class in three clicks, the living wall, a student's work, marks, the projector, forty."""

from __future__ import annotations

import json
import re

import httpx2
import pytest
from playwright.sync_api import Browser, Page, Response, expect

from tests.browser import FRAME, settled, state, visited
from tests.e2e.classroom import FAST, SLOW, Classroom, filled, poles, wall
from tests.e2e.conftest import App
from tests.e2e.test_axe import RUN, violations

HOSTILE = '<img src=x onerror="document.title=1"> =cmd()'
LONG = "Maximiliane-Theodora von und zu Hohenlohe-Waldenburg-Schillingsfürst"


def row(page: Page, student: int) -> str:
    return f'tr[data-id="{student}"]'


def marks(page: Page, student: int, step: int) -> list[str]:
    """How a student stands to the goals of a step, by the wall."""
    cell = page.locator(f"{row(page, student)} td").nth(step)
    return [str(mark.get_attribute("class")).split()[-1] for mark in cell.locator(".goal").all()]


def until_marks(page: Page, student: int, step: int, wanted: list[str]) -> None:
    cell = page.locator(f"{row(page, student)} td").nth(step)
    expect(cell.locator(".goal")).to_have_class([f"goal {mark}" for mark in wanted])


def test_a_class_in_three_clicks(chromium: Browser, lab_server: App, rest: httpx2.Client):
    with visited(chromium) as visit:
        page = visit.page
        page.goto(lab_server.url + "class")
        page.get_by_test_id("lab-wall").check()
        expect(page.get_by_test_id("class-title")).to_have_value(re.compile("^A lab for the wall, "))
        page.get_by_test_id("make-class").click()
        expect(page.get_by_test_id("nobody")).to_be_visible()
        page.get_by_test_id("to-join").click()
        code = page.get_by_test_id("join-code").inner_text()
        assert re.fullmatch("[A-Z0-9]{7}", code)
        expect(page.get_by_test_id("join-address")).to_have_text(f"127.0.0.1:{lab_server.port}")
        expect(page.get_by_test_id("own-machine")).to_be_visible()
        (kept,) = json.loads(page.evaluate("() => localStorage.getItem('heli2dof.classes')"))
        assert kept["code"] == code and len(kept["key"]) >= 22
        assert kept["key"] not in page.url + page.content()
        expect(page.get_by_test_id("join-title")).to_have_text(re.compile("^A lab for the wall"))
        room = Classroom(rest, code, kept["key"], "")
        room.join("Ada")
        expect(page.locator(".join-state")).to_have_text("1 has joined.")
        page.goto(lab_server.url + "class")  # and it is found again
        page.get_by_test_id(f"known-{code}").click()
        expect(page.locator("[data-testid=wall-rows] tr")).to_have_count(1)


def test_the_page_may_load_and_be_framed_as_the_other(lab_server: App, rest: httpx2.Client):
    page, own = rest.get(""), rest.get("class")
    assert own.status_code == 200 and own.headers["content-type"].startswith("text/html")
    for name in ("content-security-policy", "referrer-policy", "x-content-type-options", "cache-control"):
        assert own.headers.get(name) == page.headers.get(name), name


def test_nothing_but_labs_is_told_without_a_secret(chromium: Browser, lab_server: App, room: Classroom):
    with visited(chromium) as visit:
        page = visit.page
        replies: list[Response] = []

        def heard(reply: Response) -> None:
            replies.append(reply)

        page.on("response", heard)
        with page.expect_response("**/api/v1/labs"):
            page.goto(lab_server.url + "class")
        page.get_by_test_id("lab-wall").wait_for()
        told = "".join(reply.text() for reply in replies if "/api/" in reply.url)
        assert "A lab for the wall" in told and "slow poles" not in told and "carries the weight" not in told
        page.goto(f"{lab_server.url}class#class={room.code}")
        expect(page.get_by_test_id("no-key")).to_be_visible()


def test_the_wall_follows_the_class(chromium: Browser, lab_server: App, room: Classroom):
    with wall(chromium, lab_server.url, room) as page:
        assert page.url.endswith(f"#class={room.code}"), "the secret does not stay in the address"
        expect(page.get_by_test_id("nobody")).to_contain_text(room.code)
        ada, bob = room.join("Ada", email="ada@example.edu"), room.join(HOSTILE)
        expect(page.get_by_test_id(f"student-{ada}")).to_have_text("Ada")
        expect(page.get_by_test_id(f"student-{bob}")).to_have_text(HOSTILE)
        assert marks(page, ada, 0) == ["open", "open"]
        room.hand_in("Ada", "settle", poles(*SLOW), who=1)
        until_marks(page, ada, 0, ["missed", "met"])
        expect(page.get_by_test_id("held-up")).to_contain_text("Step 1, “Settling time")
        room.hand_in("Ada", "settle", poles(*FAST), who=2)
        until_marks(page, ada, 0, ["met", "met"])
        expect(page.get_by_test_id("held-up")).to_contain_text("Nothing at present")
        expect(page.locator(f"{row(page, ada)} .sum")).to_have_text("8 36 %")
        assert marks(page, bob, 0) == ["open", "open"]
        expect(page.get_by_test_id("facts")).to_contain_text("2 students")
        # their poles, and whose they are
        expect(page.locator(f".class-plane [data-id='{ada}'] .pitch")).to_have_count(2)
        page.get_by_test_id(f"student-{ada}").hover()
        expect(page.locator(f".class-plane [data-id='{ada}']")).to_have_class("pointed")
        expect(page.get_by_test_id("plane-words")).to_have_text("Ada")
        page.locator(f".class-plane [data-id='{ada}'] .pitch").first.hover()
        expect(page.locator(row(page, ada))).to_have_class(re.compile("pointed"))
        room.client.delete(room.path(f"/students/{bob}"), headers=room.headers).raise_for_status()
        expect(page.locator("[data-testid=wall-rows] tr")).to_have_count(1)
        assert page.title() == "heli2dof: classes"


def test_order_and_search(chromium: Browser, lab_server: App, room: Classroom):
    first, second = room.join("Zoë"), room.join("Émile")
    room.hand_in("Zoë", "settle", poles(*SLOW))
    with wall(chromium, lab_server.url, room) as page:
        rows = page.locator("[data-testid=wall-rows] tr")

        def ids() -> list[int]:
            page.evaluate(FRAME)
            return [int(str(one.get_attribute("data-id"))) for one in rows.all()]

        assert ids() == [first, second]
        page.get_by_test_id("order").select_option("name")
        assert ids() == [second, first]
        page.get_by_test_id("order").select_option("help")
        assert ids() == [first, second]
        page.get_by_test_id("search").fill("emi")
        assert ids() == [second]
        page.get_by_test_id("search").fill("nobody")
        expect(page.get_by_test_id("nobody-found")).to_be_visible()


def test_a_students_work_and_design(chromium: Browser, lab_server: App, room: Classroom):
    ada = room.join("Ada", login="ada1")
    room.hand_in("Ada", "settle", poles(*SLOW), who=1)
    with wall(chromium, lab_server.url, room) as page:
        page.get_by_test_id(f"student-{ada}").focus()
        page.keyboard.press("Enter")
        dialog = page.get_by_test_id("student")
        expect(dialog.get_by_role("heading", name="Ada")).to_be_visible()
        work = page.get_by_test_id("work-settle")
        expect(work.locator("tbody tr").first).to_contain_text("≤ 1.00 s")
        expect(work).to_contain_text("the fastest")
        room.hand_in("Ada", "settle", poles(*FAST), who=2)  # while one looks
        expect(work.locator("details")).to_have_count(2)
        expect(work).to_contain_text("the slowest")
        attempt = work.locator("details").last
        attempt.locator("summary").click()
        expect(attempt).to_contain_text("0 of 4")
        expect(attempt).to_contain_text("the fastest")
        with page.expect_popup() as popup:
            page.get_by_test_id("open-newest").click()
        instrument = popup.value
        settled(instrument)
        assert "Ada" not in instrument.url
        shown = state(instrument)
        assert sorted(p["re"] for p in shown["poles"]) == pytest.approx([-9.25, -8.76, -7, -6])
        rig = room.students["Ada"]["rig"]["parameters"]
        assert {name: shown["parameters"][name] for name in rig} == rig, "on the student's own rig"
        instrument.close()
        page.keyboard.press("Escape")
        expect(dialog).to_have_count(0)
        expect(page.get_by_test_id(f"student-{ada}")).to_be_focused()


def test_marks_by_hand_one_after_the_other(chromium: Browser, lab_server: App, room: Classroom):
    for name in ("Ada", "Bob"):
        room.join(name)
        assert room.hand_in(name, "why", why=f"{name} says: {HOSTILE}").status_code == 200
    ids = [student["id"] for student in room.students.values()]
    with wall(chromium, lab_server.url, room) as page:
        expect(page.get_by_test_id("to-mark")).to_have_text("2 to mark")
        page.get_by_test_id("to-mark").click()
        form = page.get_by_test_id("mark-why-why")
        expect(page.get_by_test_id("work-why")).to_contain_text(f"Ada says: {HOSTILE}")
        expect(form).to_contain_text("It carries the weight.")
        for wrong in ("7", "-1", "many", ""):
            page.get_by_test_id("mark-why-why-points").fill(wrong)
            page.get_by_test_id("mark-why-why-save").click()
            expect(page.get_by_test_id("mark-why-why-told")).to_have_text("Points are a number from 0 to 6.")
        page.get_by_test_id("mark-why-why-points").fill("4,5")
        page.get_by_test_id("mark-why-why-comment").fill("Good; and the trim?")
        room.hand_in("Ada", "settle")  # what is being written stays
        expect(page.get_by_test_id("work-settle").locator("details")).to_have_count(1)
        expect(page.get_by_test_id("mark-why-why-comment")).to_have_value("Good; and the trim?")
        # the body scrolls, never the dialog: whose answer it is stays in sight
        page.set_viewport_size({"width": 1280, "height": 320})
        scrolled = "dialog => { dialog.scrollTop = 1000; return dialog.scrollTop; }"
        assert page.get_by_test_id("student").evaluate(scrolled) == 0
        page.set_viewport_size({"width": 1280, "height": 800})
        page.get_by_test_id("mark-why-why-save").click()
        expect(page.get_by_test_id("mark-why-why-told")).to_have_text("Saved. The student sees it.")
        expect(page.get_by_test_id("to-mark")).to_have_text("1 to mark")
        secret = {"Heli2dof-Secret": room.students["Ada"]["student"]}
        mine = room.client.get(room.path("/mine"), headers=secret).raise_for_status().json()
        (mark,) = mine["steps"]["why"]["hand"]
        assert (mark["points"], mark["comment"]) == (4.5, "Good; and the trim?")
        page.get_by_test_id("next-to-mark").click()
        expect(page.get_by_test_id("student").get_by_role("heading", level=2)).to_have_text("Bob")
        expect(page.get_by_test_id("work-why")).to_contain_text("Bob says")
        page.get_by_test_id("mark-why-why-points").fill("6")
        page.get_by_test_id("mark-why-why-save").click()
        expect(page.get_by_test_id("to-mark")).to_be_hidden()
        assert [student["points"] for student in room.told()["students"] if student["id"] == ids[1]] == [6]


def test_the_projectors_wall_has_no_names(chromium: Browser, lab_server: App, room: Classroom):
    names = ["Ada", "Björn", HOSTILE]
    for name in names:
        room.join(name, email=f"{len(name)}@example.edu", login=f"login{len(name)}")
        room.hand_in(name, "settle", poles(*SLOW))
    room.hand_in("Ada", "why", why="Because Ada says so")
    with wall(chromium, lab_server.url, room) as page:
        page.get_by_test_id("to-projector").click()
        expect(page.locator(".who")).to_have_text(["Student 1", "Student 2", "Student 3"])
        page.locator(".everyone g").first.dispatch_event("pointerenter")
        expect(page.get_by_test_id("plane-words")).to_have_text("Student 1")
        page.locator("[data-testid=wall-rows] tr").first.click()
        page.locator(".everyone g").first.dispatch_event("click")
        room.hand_in("Björn", "settle")
        until_marks(page, room.students["Björn"]["id"], 0, ["met", "met"])
        said = page.content() + page.title() + page.url
        for word in (*names, "onerror", "example.edu", "login3", "says so"):
            assert word not in said, word
        assert page.locator("dialog").count() == 0
        page.reload()
        expect(page.locator(".who").first).to_have_text("Student 1")
        assert "Björn" not in page.content()


@pytest.fixture(scope="module")
def forty(rest: httpx2.Client) -> Classroom:
    room = Classroom.made(rest, "Forty of them")
    filled(room, 39)
    room.join(LONG)
    return room


def test_a_change_costs_what_it_changes(chromium: Browser, lab_server: App, forty: Classroom):
    """One row, whatever there is beside it."""
    with wall(chromium, lab_server.url, forty) as page:
        page.locator("[data-testid=wall-rows] tr").first.wait_for()
        page.evaluate(
            """() => {
              window.changes = 0;
              const rows = document.querySelector('[data-testid=wall-rows]');
              const counted = (all) => { window.changes += all.length; };
              new MutationObserver(counted).observe(rows, {subtree: true, childList: true, attributes: true,
                                                           characterData: true});
            }"""
        )
        name = next(iter(forty.students))
        before = page.locator(f"{row(page, forty.students[name]['id'])} .points").inner_text()
        forty.hand_in(name, "both", poles(-9, -10, yaw=(-9.5, -10.5)))
        expect(page.locator(f"{row(page, forty.students[name]['id'])} .points")).not_to_have_text(before)
        assert 0 < page.evaluate("() => window.changes") < 60


@pytest.mark.parametrize("size", [(1280, 800), (820, 1180), (390, 844)])
def test_forty_students_fit(chromium: Browser, lab_server: App, forty: Classroom, size: tuple[int, int]):
    with wall(chromium, lab_server.url, forty, size=size) as page:
        expect(page.locator("[data-testid=wall-rows] tr")).to_have_count(40)
        for place in ("", "&view=projector", "&view=join"):
            page.goto(f"{lab_server.url}class#class={forty.code}{place}")
            page.locator(".join-code, .wall-grid tbody tr").first.wait_for()
            wide = "() => document.documentElement.scrollWidth - innerWidth"
            assert page.evaluate(wide) <= 0, place
        page.goto(f"{lab_server.url}class#class={forty.code}")
        name = page.get_by_test_id(f"student-{forty.students[LONG]['id']}")
        expect(name).to_have_attribute("title", LONG)
        name.click()
        expect(page.get_by_test_id("student").get_by_role("heading", level=2)).to_have_text(LONG)
        box = page.get_by_test_id("student").bounding_box()
        assert box is not None and box["x"] >= 0 and box["x"] + box["width"] <= size[0]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_no_violation(
    chromium: Browser, lab_server: App, forty: Classroom, scheme: str, size: tuple[int, int]
):
    with wall(chromium, lab_server.url, forty, size=size, color_scheme=scheme) as page:
        page.locator("[data-testid=wall-rows] tr").first.wait_for()
        assert violations(page) == []
        for testid in ("results", "manage", "notes"):
            page.get_by_test_id(f"{testid}-open").click()
            page.get_by_test_id(testid).wait_for()
            assert page.evaluate(RUN) == [], testid
            page.get_by_test_id(f"{testid}-close").click()
        page.get_by_test_id("to-mark").click()
        page.get_by_test_id("mark-why-why").wait_for()
        page.locator(".attempt summary").first.click()
        assert page.evaluate(RUN) == [], "a student"
        page.get_by_test_id("student-close").click()
        for place in ("#", f"#class={forty.code}&view=join", f"#class={forty.code}&view=projector"):
            page.evaluate("(place) => { location.hash = place; }", place)
            page.locator(".join-title, .lab-title, .wall-grid tbody tr").first.wait_for()
            assert page.evaluate(RUN) == [], place


def test_every_word_can_be_translated(chromium: Browser, lab_server: App, forty: Classroom):
    untranslated = """() => {
      const out = new Set();
      const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      while (walker.nextNode()) {
        const { nodeValue: text, parentElement: node } = walker.currentNode;
        const ours = node.checkVisibility() && !node.closest('[translate=no]');
        if (ours && /\\p{L}{3}/u.test(text) && !text.includes('⟦')) out.add(text.trim());
      }
      return [...out];
    }"""
    lab = {step["title"] for step in forty.told()["steps"]} | {"A lab for the wall"}
    with visited(chromium) as visit:
        page = visit.page
        page.goto(f"{lab_server.url}class?lang=qps-ploc#class={forty.code}&key={forty.key}")
        page.locator("[data-testid=wall-rows] tr").first.wait_for()
        goals = set(page.locator(".steps-list .label").all_inner_texts())

        def english() -> list[str]:
            known = lab | goals
            return [
                text for text in page.evaluate(untranslated) if text not in known and text[2:] not in known
            ]

        assert english() == []
        page.get_by_test_id("manage-open").click()
        assert english() == []
        page.get_by_test_id("manage-close").click()
        page.evaluate("() => { location.hash = ''; }")
        page.get_by_test_id("lab-wall").check()
        assert [text for text in english() if text != "Three steps that are marked at once."] == []
