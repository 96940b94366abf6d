"""View Find in a real browser: what is looked at is shown by the whole page and is no edit; a click takes it."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, Route, WebSocket, WebSocketRoute, expect

from tests.browser import FRAME, opened, reopened, settled, state, until_state
from tests.e2e.conftest import App
from tests.e2e.test_axe import RUN, violations

FOUND: dict[str, Any] = json.loads(Path("tests/page/fixtures/find_reply.json").read_text("utf-8"))
"""A recorded reply, so that these tests need no search."""
PROGRESS = {"done": False, "tried": 4000, "designs": 20000, "seconds": 0.4, "met": 12, "points": []}
SO_FAR = {**PROGRESS, "points": [[0.7, 21.5], [0.9, 18.2], [1.2, 16.0]]}
NOISY = "#v1&scenario.noise.theta=0.001&scenario.measured=filtered&view=find"
"""What the page's own kernel does not serve."""

MARKS = """() => [...document.querySelectorAll(".splane-svg :is(.pole, .loop-poles path, .open-poles path)")].map(
  (mark) => mark.getAttribute("transform")).join()"""
"""Where the s-plane's marks stand, in its pixels."""


class Finder:
    """The server's search, as the recorded reply has it; what it was asked."""

    def __init__(self, page: Page, *replies: dict[str, Any], progress: dict[str, Any] = PROGRESS) -> None:
        self.asked: list[dict[str, Any]] = []
        self.replies = list(replies) or [FOUND]
        self.progress = progress
        page.route_web_socket(re.compile("/api/v1/find"), self._answer)

    def _answer(self, socket: WebSocketRoute) -> None:
        def message(text: str | bytes) -> None:
            self.asked.append(json.loads(text))
            socket.send(json.dumps(self.progress))
            reply = self.replies.pop(0) if len(self.replies) > 1 else self.replies[0]
            if reply:
                socket.send(json.dumps(reply))

        socket.on_message(message)


def search(page: Page) -> None:
    page.get_by_test_id("find-run").click()
    point(page, 0).wait_for()


def ready(page: Page) -> None:
    page.wait_for_function("() => document.documentElement.dataset.kernel === 'ready'")


def point(page: Page, i: int) -> Locator:
    return page.get_by_test_id(f"find-point-{i}")


SHOWN = """(wanted) => {
  const { preview, poles } = JSON.parse(document.documentElement.dataset.state);
  return preview && poles.every(({ re, im }, k) => re === wanted[k].re && im === wanted[k].im);
}"""


def look(page: Page, i: int) -> None:
    point(page, i).hover(force=True)
    shows(page, i)


def shows(page: Page, i: int) -> None:
    """Waits until this design is previewed, not the one before."""
    page.wait_for_function(SHOWN, arg=FOUND["designs"][i]["design"]["poles"])


def leave(page: Page) -> None:
    page.get_by_test_id("find-words").hover()
    until_state(page, "!s.preview")


def shown(page: Page) -> tuple[list[dict[str, float]], Any]:
    own = state(page)
    return own["poles"], own["K"]


def is_of(page: Page, i: int) -> bool:
    return state(page)["poles"] == FOUND["designs"][i]["design"]["poles"]


@pytest.fixture
def finding(chromium: Browser, app: App) -> Iterator[Page]:
    with opened(chromium, app.url + "#find") as page:
        Finder(page)
        page.get_by_test_id("find-run").wait_for()
        ready(page)
        yield page


def test_the_whole_page_shows_the_design_under_the_pointer_and_it_is_no_edit(chromium: Browser, app: App):
    sent: list[str] = []

    def watch(socket: WebSocket) -> None:
        if "/live" in socket.url:
            socket.on("framesent", lambda text: sent.append(str(text)))

    with opened(chromium, app.url + "#find") as page:
        page.on("websocket", watch)
        page.reload()
        settled(page)
        Finder(page)
        ready(page)
        search(page)
        own, link, asked = shown(page), page.evaluate("location.hash"), len(sent)
        marks = page.evaluate(MARKS)
        for i in (3, 5, 3):
            look(page, i)
            assert is_of(page, i)
            assert shown(page)[1] != own[1]
            expect(page.locator("tr.active")).to_have_attribute("data-index", str(i))
            assert page.evaluate(MARKS) != marks
        expect(page.get_by_test_id("undo")).to_be_disabled()
        assert page.evaluate("location.hash") == link
        leave(page)
        assert shown(page) == own
        assert page.evaluate(MARKS) == marks  # the section of the plane, too
        assert len(sent) == asked


def test_a_click_takes_it_undo_gives_ones_own_back_another_click_pins_it(finding: Page):
    search(finding)
    own = shown(finding)
    look(finding, 4)
    point(finding, 4).click(force=True)
    until_state(finding, "!s.preview && s.settled")
    assert is_of(finding, 4)
    expect(point(finding, 4)).to_have_class(re.compile("taken"))
    assert "&p=" in finding.evaluate("location.hash")
    point(finding, 4).click(force=True)
    until_state(finding, "s.pins.length === 1 && s.pins[0].K")
    expect(point(finding, 4)).to_contain_text("A")
    finding.get_by_test_id("undo").click()
    settled(finding)
    assert shown(finding) == own
    expect(finding.get_by_test_id("undo")).to_be_disabled()


def test_by_keys_alone(finding: Page):
    search(finding)
    own = shown(finding)
    scatter = finding.get_by_test_id("find-scatter")
    scatter.focus()
    finding.keyboard.press("ArrowRight")
    shows(finding, 0)
    assert scatter.get_attribute("aria-activedescendant") == "find-point-0"
    finding.keyboard.press("ArrowRight")
    finding.keyboard.press("ArrowRight")
    shows(finding, 2)
    finding.keyboard.press("p")
    until_state(finding, "s.pins.length === 1")
    finding.keyboard.press("Escape")
    until_state(finding, "!s.preview")
    assert shown(finding) == own
    finding.keyboard.press("End")
    shows(finding, len(FOUND["designs"]) - 1)
    finding.keyboard.press("Enter")
    until_state(finding, "!s.preview")
    assert is_of(finding, len(FOUND["designs"]) - 1)


def test_rows_of_the_table_show_their_designs_too(finding: Page):
    search(finding)
    own = shown(finding)
    finding.get_by_test_id("find-take-2").focus()
    shows(finding, 2)
    finding.get_by_test_id("find-run").focus()
    until_state(finding, "!s.preview")
    assert shown(finding) == own
    finding.get_by_test_id("find-sort-1").click()
    rows = finding.locator("[data-testid=find-table] tbody tr")
    least = min(range(len(FOUND["designs"])), key=lambda i: FOUND["designs"][i]["figures"][1]["value"])
    expect(rows.first).to_have_attribute("data-index", str(least))
    finding.get_by_test_id("find-pin-2").click()
    until_state(finding, "s.pins.length === 1")


def test_a_drag_keeps_those_within_a_rectangle(finding: Page):
    search(finding)
    rows = finding.locator("[data-testid=find-table] tbody tr")
    count = len(FOUND["designs"])
    expect(rows).to_have_count(count)
    finding.get_by_test_id("find-scatter").scroll_into_view_if_needed()
    box = finding.get_by_test_id("find-scatter").bounding_box()
    middle = point(finding, count // 2).bounding_box()
    assert box and middle
    finding.mouse.move(box["x"] + 48, box["y"] + 28)
    finding.mouse.down()
    finding.mouse.move(middle["x"] + middle["width"] / 2 + 2, box["y"] + box["height"] - 42, steps=3)
    finding.mouse.up()
    expect(rows).to_have_count(count // 2 + 1)
    assert not state(finding)["preview"]
    expect(point(finding, count - 1)).to_have_class(re.compile("out"))
    # in other figures the same ones are kept
    finding.get_by_test_id("find-x").select_option("3")
    expect(rows).to_have_count(count // 2 + 1)
    finding.get_by_test_id("find-brush-0").click()
    finding.get_by_test_id("find-brush-1").click()
    expect(rows).to_have_count(count)


def test_an_answer_that_comes_late_never_wins(chromium: Browser, app: App):
    waiting: list[Route] = []

    def wait(route: Route) -> None:
        waiting.append(route)

    with opened(chromium, app.url + NOISY) as page:
        Finder(page)
        page.get_by_test_id("find-run").wait_for()
        ready(page)
        search(page)
        own = shown(page)
        page.route("**/api/v1/evaluate*", wait)
        with page.expect_request("**/api/v1/evaluate*"):
            point(page, 3).hover(force=True)
        page.evaluate(FRAME)
        assert shown(page) == own  # not its poles with another's curves
        with page.expect_request("**/api/v1/evaluate*"):
            point(page, 5).hover(force=True)
            waiting.pop(0).continue_()
        assert shown(page) == own  # 3 is not looked at any more
        with page.expect_response("**/api/v1/evaluate*"):
            leave(page)
            waiting.pop(0).continue_()
        page.evaluate(FRAME)
        assert shown(page) == own
        look(page, 5)  # known by now: nobody is asked
        assert is_of(page, 5)
        assert waiting == []


def test_an_edit_ends_it(finding: Page):
    search(finding)
    point(finding, 4).click(force=True)
    until_state(finding, "s.settled")
    look(finding, 2)
    finding.keyboard.press("Control+z")
    until_state(finding, "!s.preview")
    assert not is_of(finding, 2) and not is_of(finding, 4)


def test_what_is_asked_for_stands_in_the_link(chromium: Browser, app: App):
    with opened(chromium, app.url + "#find") as page:
        finder = Finder(page)
        page.get_by_test_id("find-limit-0").fill("0.8")
        page.get_by_test_id("find-where-0").select_option("theta")
        page.get_by_test_id("find-remove-1").click()
        page.get_by_test_id("find-free-pairing").check()
        page.get_by_test_id("find-spread").select_option("0.1")
        page.get_by_test_id("find-share-0").fill("95")
        page.wait_for_function(
            "() => location.hash.includes('spread:0.1') && location.hash.includes('share:0.95')"
        )
        link = page.evaluate("location.href")
        reopened(page, link)
        expect(page.get_by_test_id("find-limit-0")).to_have_value("0.8")
        expect(page.get_by_test_id("find-share-0")).to_have_value("95")
        page.get_by_test_id("find-run").click()
        point(page, 0).wait_for()
        asked = finder.asked[0]["find"]
        assert asked["free"] == ["poles", "loops", "pairing"]
        assert asked["require"]["settling_time"] == [
            {"max": 0.8, "share": 0.95, "axis": "theta", "model": "nonlinear"}
        ]
        assert asked["uncertainty"]["spread"]["J_p"] == 0.1
        assert "g" not in asked["uncertainty"]["spread"]


def contradiction() -> dict[str, Any]:
    reply = copy.deepcopy(FOUND)
    reply["met"] = False
    for design in reply["designs"]:
        design["met"] = design["required"][0]["met"] = False
    settling = {"figure": 0, "max": 0.3, "words": "Settling time, either step", "limit": "≤ 0.30 s"}
    reply["requirements"][0] = settling
    gives = [
        {
            "requirement": 0,
            "value": 0.71,
            "text": "0.71 s",
            "by": 0.41,
            "others": True,
            "message": "It could be 0.71 s.",
        },
        {"requirement": 1, "others": False, "message": "No disk margin is small enough.", "text": "nothing"},
    ]
    return reply | {"why": {"requirements": [0, 1], "message": "These contradict.", "gives": gives}}


def test_where_nothing_meets_all_it_says_what_contradicts_and_takes_what_one_gives(
    chromium: Browser, app: App
):
    with opened(chromium, app.url + "#find") as page:
        finder = Finder(page, contradiction(), FOUND)
        page.get_by_test_id("find-limit-0").fill("0.3")
        search(page)
        why = page.get_by_test_id("find-why")
        expect(why).to_contain_text("These contradict.")
        expect(page.get_by_test_id("find-words")).to_contain_text("No design meets all")
        expect(page.get_by_test_id("find-give-1").get_by_role("button")).to_have_count(0)
        page.get_by_test_id("find-give-0").get_by_role("button").click()
        expect(page.get_by_test_id("find-limit-0")).to_have_value("0.71")
        expect(why).to_be_hidden()
        assert finder.asked[1]["find"]["require"]["settling_time"][0]["max"] == 0.71


def test_a_search_can_be_called_off(chromium: Browser, app: App):
    with opened(chromium, app.url + "#find") as page:
        Finder(page, {})
        page.get_by_test_id("find-run").click()
        expect(page.get_by_test_id("find-standing")).to_contain_text("4,000 / 20,000: 12 meet all")
        expect(page.get_by_test_id("find-cancel")).to_be_focused()
        page.keyboard.press("Enter")
        expect(page.get_by_test_id("find-standing")).to_have_text("Called off.")
        expect(page.get_by_test_id("find-run")).to_be_focused()


def test_the_front_so_far_is_drawn_while_it_searches(chromium: Browser, app: App):
    with opened(chromium, app.url + "#find") as page:
        finder = Finder(page, {}, progress=SO_FAR)
        so_far = page.get_by_test_id("find-so-far").locator("circle")
        page.get_by_test_id("find-run").click()
        expect(so_far).to_have_count(3)
        expect(page.get_by_test_id("find-scatter")).to_be_visible()
        expect(page.get_by_test_id("find-empty")).to_be_hidden()
        expect(page.get_by_test_id("find-x")).to_be_hidden()
        page.get_by_test_id("find-cancel").click()
        expect(page.get_by_test_id("find-scatter")).to_be_hidden()
        expect(page.get_by_test_id("find-empty")).to_be_visible()
        finder.replies = [FOUND]
        search(page)
        expect(so_far).to_have_count(0)
        expect(page.get_by_test_id("find-x")).to_be_visible()
        # beside what was found before, where it is looked at by the same figures
        finder.replies = [{}]
        page.get_by_test_id("find-run").click()
        expect(so_far).to_have_count(3)
        expect(point(page, 0)).to_be_visible()
        page.get_by_test_id("find-x").select_option("2")
        expect(so_far).to_have_count(0)
        expect(point(page, 0)).to_be_visible()
        page.get_by_test_id("find-cancel").click()
        # the next one turns to what it makes better
        page.get_by_test_id("find-run").click()
        expect(so_far).to_have_count(3)
        expect(page.get_by_test_id("find-x")).to_have_value("0")
        page.get_by_test_id("find-cancel").click()
        expect(so_far).to_have_count(0)
        expect(point(page, 0)).to_be_visible()


def test_what_a_link_locks_is_not_searched(chromium: Browser, app: App):
    with opened(chromium, app.url + "#v1&lock=poles&view=find") as page:
        finder = Finder(page)
        expect(page.get_by_test_id("find-free-poles")).to_be_disabled()
        own = state(page)["poles"]
        search(page)
        assert finder.asked[0]["find"]["free"] == ["loops"]
        point(page, 3).hover(force=True)
        until_state(page, "s.preview")
        assert state(page)["poles"] == own
        assert state(page)["loops"]["pitch"] == FOUND["designs"][3]["design"]["loops"]["pitch"]


def test_after_another_rig_was_chosen_the_figures_are_told_to_be_of_before(finding: Page):
    search(finding)
    expect(finding.get_by_test_id("find-stale")).to_be_hidden()
    finding.get_by_test_id("preset").select_option("quanser-aero-2")
    expect(finding.get_by_test_id("find-stale")).to_be_visible()
    finding.get_by_test_id("undo").click()
    expect(finding.get_by_test_id("find-stale")).to_be_hidden()


def test_with_the_server_itself(chromium: Browser, app: App):
    with opened(
        chromium, app.url + "#v1&find=settling_time:better::V_peak:max:20::free:poles,loops&view=find"
    ) as page:
        page.get_by_test_id("find-budget").select_option("5000")
        search(page)
        expect(page.get_by_test_id("find-words")).to_contain_text("designs tried")
        point(page, 0).hover(force=True)
        until_state(page, "s.preview")
        page.keyboard.press("Escape")
        point(page, 0).click(force=True)
        until_state(page, "!s.preview")
        # the figure that the search tells is the one of the page
        told = page.locator("[data-testid=find-found-0] td").first.inner_text()
        page.get_by_test_id("view-design").click()
        settled(page)
        expect(page.get_by_test_id("metric-settling-psi")).not_to_have_text("")
        times = " ".join(
            page.get_by_test_id(f"metric-settling-{axis}").inner_text() for axis in ("theta", "psi")
        )
        assert told in times


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_violation(chromium: Browser, app: App, scheme: str):
    with opened(chromium, app.url + "#find", color_scheme=scheme) as page:
        Finder(page, contradiction())
        page.get_by_test_id("find-spread").select_option("0.1")
        search(page)
        assert violations(page) == []
        page.get_by_test_id("find-scatter").focus()
        page.keyboard.press("ArrowRight")
        until_state(page, "s.preview")
        assert page.evaluate(RUN) == []
