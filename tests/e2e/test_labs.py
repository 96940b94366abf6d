"""Labs in a real browser: alone, what a step keeps back, on a phone, by keys and for axe."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, Route, expect

from tests.browser import settled, state, view
from tests.e2e.conftest import App
from tests.e2e.lab_pages import goal, handed_in, lab, ready, server
from tests.e2e.test_axe import RUN, violations
from tests.e2e.test_page import centre

__all__ = ["server"]


def test_a_step_alone_from_the_list_to_its_points(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#labs") as visit:
        page = visit.page
        titles = page.get_by_test_id("lab-list").locator("a")
        expect(titles.last).to_be_visible()
        page.get_by_test_id("lab-small").click()
        expect(page.get_by_test_id("lab-step-title")).to_have_text("Make it quick")
        expect(page.get_by_test_id("lab-text").locator("math")).to_have_count(1)
        ready(page)
        assert page.url.endswith("#lab=small")
        assert [round(p["re"], 2) for p in state(page)["poles"]] == [-2, -2.5, -9.25, -8.76]
        goal(page, "rise-time-theta", "missed")
        # a drag ticks the goal while the hand still holds the pole
        x, y = centre(page, "pole-0")
        gap = abs(x - centre(page, "pole-1")[0])  # 0.5 rad/s
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 24 * gap, y, steps=10)
        page.mouse.up()
        x, y = centre(page, "pole-1")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 12 * gap, y, steps=10)
        goal(page, "rise-time-theta", "met")
        assert state(page)["dragging"]
        page.mouse.up()
        settled(page)
        # what is fixed stays, and says so
        assert [p["re"] for p in state(page)["poles"][2:]] == [-9.25, -8.76]
        expect(page.get_by_test_id("pole-field-2")).to_be_disabled()
        expect(page.get_by_test_id("pole-field-2")).to_have_attribute("title", "Fixed in this step")
        expect(page.get_by_test_id("pole-field-0")).to_be_enabled()
        page.get_by_test_id("lab-q-who-2").check()
        page.get_by_test_id("lab-q-slowest-input").fill("7,05")
        expect(page.get_by_test_id("lab-hint-1")).to_have_text("Hint 1 (costs 1 point)")
        expect(page.get_by_test_id("lab-hint-2")).to_have_text("Hint 2 (free)")
        page.get_by_test_id("lab-hint-1").click()
        expect(page.get_by_test_id("lab-hint-1-text")).to_contain_text("4/σ")
        page.get_by_test_id("lab-q-why-input").fill("It dies away last.")
        page.get_by_test_id("lab-q-why-input").press("Control+Enter")
        expect(page.get_by_test_id("lab-best")).to_contain_text("of 17 points, 1 attempt.")
        expect(page.get_by_test_id("lab-q-who-told")).to_have_text("✓ right")
        expect(page.get_by_test_id("lab-goal-stable")).to_have_attribute(
            "data-kind", re.compile("met|missed")
        )
        points = page.get_by_test_id("lab-points").inner_text()
        assert not points.startswith("0 ")
        poles = state(page)["poles"]
        # whoever comes back finds the same step, design, answers, hint and points
        page.reload()
        expect(page.get_by_test_id("lab-points")).to_have_text(points)
        ready(page)
        assert state(page)["poles"] == poles
        expect(page.get_by_test_id("lab-q-slowest-input")).to_have_value("7,05")
        expect(page.get_by_test_id("lab-hint-1-text")).to_be_visible()
        page.get_by_test_id("lab-reset").click()
        settled(page)
        assert state(page)["poles"][0]["re"] == -2
        page.get_by_test_id("undo").click()
        settled(page)
        assert state(page)["poles"] == poles
        # the next step goes on with the own poles
        page.get_by_test_id("lab-next").click()
        expect(page.get_by_test_id("lab-step-title")).to_be_focused()
        settled(page)
        assert (state(page)["poles"], state(page)["outer"]) == (poles, "pi")
        page.reload()
        expect(page.get_by_test_id("lab-step-title")).to_have_text("Now with PI")
        page.get_by_test_id("lab-next").click()
        expect(page.get_by_test_id("lab-end").first).to_contain_text("of 22 points")
        expect(page.get_by_test_id("lab-text")).to_have_text("You are done.")
        page.get_by_test_id("lab-leave").click()
        expect(page.get_by_test_id("lab-list")).to_contain_text("begun:")
        page.get_by_test_id("lab-close").click()
        expect(page.locator("#lab")).to_be_hidden()
        settled(page)
        assert state(page)["locks"] == []
        expect(page.get_by_test_id("pole-field-2")).to_be_enabled()


def test_a_pole_is_taken_also_where_one_that_is_fixed_lies_over_it(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#lab=small") as visit:
        page = visit.page
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        ready(page)
        field = page.get_by_test_id("pole-field-0")
        field.fill("-9.1")  # the fixed one is nearer to the hand
        field.press("Enter")
        settled(page)
        page.reload()  # what was moved last lies on top no more
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        ready(page)
        x, y = centre(page, "pole-2")
        assert 0 < centre(page, "pole-0")[0] - x < 8
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 40, y, steps=5)
        page.mouse.up()
        settled(page)
        own, _, *fixed = [pole["re"] for pole in state(page)["poles"]]
        assert own < -9.3 and fixed == [-9.25, -8.76]
        # a fixed one that stands alone takes no hand, and those that are free pass over it
        x, y = centre(page, "pole-3")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 40, y, steps=5)
        page.mouse.up()
        settled(page)
        assert [pole["re"] for pole in state(page)["poles"]] == [own, -2.5, *fixed]


def test_a_server_that_does_not_answer_is_told_and_what_was_handed_in_counts_later(
    chromium: Browser, server: App
):
    waiting: list[Route] = []
    with lab(chromium, f"{server.url}#lab=small", clock=True) as visit:
        page = visit.page
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        ready(page)
        page.route("**/small/mark?*", lambda route: waiting.append(route))  # noqa: PLW0108 (Playwright writes)
        with page.expect_request("**/small/mark?*"):
            page.get_by_test_id("lab-hand-in").click()
        expect(page.get_by_test_id("lab-hand-in")).to_have_text("Marking…")
        page.clock.fast_forward(31_000)
        expect(page.get_by_test_id("lab-verdict")).to_contain_text("The server is busy")
        expect(page.get_by_test_id("lab-hand-in")).to_be_enabled()
        waiting.pop().continue_()
        expect(page.get_by_test_id("lab-best")).to_contain_text("1 attempt")


def test_a_question_is_told_right_or_not_of_the_answer_that_was_handed_in(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#lab=small") as visit:
        page = visit.page
        told = page.get_by_test_id("lab-q-who-told")
        best = page.get_by_test_id("lab-best")
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        ready(page)
        page.get_by_test_id("lab-q-who-2").check()
        handed_in(page, "Handed in:")
        expect(told).to_have_text("✓ right")
        page.get_by_test_id("lab-q-who-1").check()
        expect(told).to_be_empty()
        page.get_by_test_id("lab-hand-in").click()
        expect(best).to_contain_text("2 attempts")
        expect(told).to_contain_text("✕")
        # the first attempt is the best one, but of another answer than the one that stands there
        field = page.get_by_test_id("pole-field-0")
        field.fill("-5")
        field.press("Enter")
        expect(told).to_contain_text("✕")
        page.reload()
        expect(best).to_contain_text("2 attempts")
        expect(page.get_by_test_id("lab-q-who-1")).to_be_checked()
        expect(told).to_be_empty()
        page.get_by_test_id("lab-q-who-2").check()
        expect(told).to_have_text("✓ right")


def test_a_late_list_does_not_take_the_place_of_a_lab(chromium: Browser, server: App):
    waiting: list[Route] = []
    with lab(chromium, server.url) as visit:
        page = visit.page
        page.route("**/api/v1/labs?*", lambda route: waiting.append(route))  # noqa: PLW0108 (Playwright writes to a handler)
        with page.expect_request("**/api/v1/labs?*"):
            page.goto(f"{server.url}#labs")
        page.goto(f"{server.url}#lab=small")
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        with page.expect_response("**/api/v1/labs?*"):
            waiting.pop().continue_()
        ready(page)
        page.get_by_test_id("lab-q-who-2").check()
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()


def test_back_and_forward_lead_through_the_views_of_a_lab(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#lab=small") as visit:
        page = visit.page
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        ready(page)
        view(page, "compare")
        expect(page).to_have_url(re.compile("#lab=small&view=compare$"))
        page.go_back()
        page.wait_for_function("() => document.documentElement.dataset.view === 'design'")
        page.go_forward()
        page.wait_for_function("() => document.documentElement.dataset.view === 'compare'")
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        # the list of labs leads back to the one that is on, and so does the address
        page.keyboard.press("g")
        page.keyboard.press("l")
        expect(page.get_by_test_id("lab-step-title")).to_be_focused()
        expect(page).to_have_url(re.compile("#lab=small&view=compare$"))
        page.reload()
        expect(page.get_by_test_id("lab-step-title")).to_have_text("Make it quick")


def test_what_a_step_keeps_back_is_nowhere(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#lab=hiding") as visit:
        page = visit.page
        expect(page.get_by_test_id("lab-step-title")).to_have_text("Pair by measuring")
        ready(page)
        assert "broken" not in page.title()
        assert page.locator("#lab img").count() == 0
        expect(page.get_by_test_id("lab-text")).to_contain_text("onerror=")
        # a wide formula scrolls within its box, and is not cut
        box = page.get_by_test_id("lab-text").locator(".scroll")
        assert box.evaluate(
            "(node) => node.scrollWidth > node.clientWidth && getComputedStyle(node).overflowX === 'auto'"
        )
        expect(page.get_by_test_id("findings")).to_contain_text(
            "Remarks on this design are hidden in this step"
        )
        for hidden in ("rga-opener", "pairing-words", "pair-advised", "suggest-pi", "metrics"):
            expect(page.get_by_test_id(hidden)).to_be_hidden()
        page.get_by_test_id("view-compare").click()
        expect(page.get_by_test_id("compare-table")).to_be_visible()
        expect(page.get_by_test_id("interaction")).to_be_hidden()
        for cell in page.locator("[data-testid$='-lambda']").all():
            expect(cell).to_be_hidden()
        view(page, "derivation")
        expect(page.get_by_test_id("formula-closed_loop")).to_be_visible()
        expect(page.get_by_test_id("formula-RGA")).to_be_hidden()
        view(page, "design")
        page.get_by_test_id("export").click()
        expect(page.get_by_test_id("export-python")).to_be_visible()
        expect(page.get_by_test_id("export-report")).to_be_hidden()
        page.keyboard.press("Escape")
        page.get_by_test_id("lab-q-which-1").check()
        page.get_by_test_id("lab-q-which-3").check()
        handed_in(page, "2 of 3 points")
        expect(page.get_by_test_id("lab-q-which-told")).to_have_text("✓ right")
        page.get_by_test_id("lab-step-2").click()
        settled(page)
        expect(page.get_by_test_id("rga-opener")).to_be_visible()
        expect(page.get_by_test_id("findings")).not_to_contain_text("hidden")
        assert violations(page) == []
        # a design that there cannot be meets nothing of what the one before met
        goal(page, "phase-margin", "met")
        for pole in range(3):
            field = page.get_by_test_id(f"pole-field-{pole}")
            field.fill("-5")
            field.press("Enter")
        goal(page, "phase-margin", "unknown")


def test_on_a_phone_the_lab_is_a_sheet_under_plane_and_plot(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#lab=small", size=(390, 844), has_touch=True, is_mobile=True) as visit:
        page = visit.page
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        ready(page)
        boxes = {name: page.get_by_test_id(name).bounding_box() for name in ("splane", "plot-theta")}
        sheet = page.locator("#lab").bounding_box()
        assert sheet is not None and all(boxes.values())
        for name, box in boxes.items():
            assert box is not None and box["y"] >= 0 and box["y"] + box["height"] <= sheet["y"] + 1, name
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        expect(page.get_by_test_id("lab-ticker")).to_contain_text("≤ 0.50 s")
        handle = page.get_by_test_id("lab-handle")
        handle.press("ArrowDown")
        expect(page.locator("html")).to_have_attribute("data-sheet", "low")
        handle.press("ArrowUp")
        handle.press("ArrowUp")
        expect(page.locator("html")).to_have_attribute("data-sheet", "full")
        expect(page.get_by_test_id("lab-hand-in")).to_be_attached()
        # the free controls of the step are a tap away
        page.get_by_test_id("lab-free").get_by_role("button", name="pitch poles").click()
        expect(page.locator("html")).to_have_attribute("data-sheet", "low")
        handle.press("ArrowUp")
        assert violations(page) == []
        page.emulate_media(color_scheme="dark")
        assert page.evaluate(RUN) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("address", ["#labs", "#lab=small"])
def test_no_violation_of_axe(chromium: Browser, server: App, scheme: str, address: str):
    with lab(chromium, server.url + address, color_scheme=scheme) as visit:
        page = visit.page
        expect(page.get_by_test_id("lab-list" if address == "#labs" else "lab-goal-stable")).to_be_visible()
        ready(page)
        if address != "#labs":
            handed_in(page, "Handed in:")
        assert violations(page) == []


def test_a_design_s_link_ends_the_lab_and_the_keys_lead_to_it(chromium: Browser, server: App):
    with lab(chromium, server.url) as visit:
        page = visit.page
        ready(page)
        page.keyboard.press("g")
        page.keyboard.press("l")
        expect(page.get_by_test_id("lab-list")).to_be_visible()
        page.get_by_test_id("lab-small").click()
        expect(page.get_by_test_id("lab-step-title")).to_be_visible()
        expect(page.get_by_test_id("view-labs")).to_have_text("Lab")
        page.evaluate("location.hash = '#v1&preset=quanser-aero&p=-5,-4,-3,-2'")
        expect(page.locator("#lab")).to_be_hidden()
        settled(page)
        assert (state(page)["preset"], state(page)["locks"]) == ("quanser-aero", [])
