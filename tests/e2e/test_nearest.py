"""Why not: arrows to the nearest design that meets what is required, taken by a click."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, expect

from tests.browser import opened, state, until_state
from tests.e2e.conftest import App
from tests.e2e.test_axe import violations

MISSED = "#v1&req.settling=0.8&view=design"
DEFAULT = {"kp": 30, "ti": 0.1}


def test_a_click_takes_the_move_and_undo_leads_back(app: App, chromium: Browser):
    with opened(chromium, app.url + MISSED) as page:
        verdict, line = page.get_by_test_id("requirements-verdict"), page.get_by_test_id("nearest")
        expect(verdict).to_contain_text("✕")
        first = page.get_by_test_id("nearest-move-0")
        expect(first).to_be_visible()
        assert page.get_by_test_id("nearest-ways").locator(".nearest-head").count() > 0
        assert not violations(page)
        before = state(page)
        first.focus()
        page.keyboard.press("Enter")
        until_state(page, "s.settled && !s.preview")
        expect(verdict).to_have_text("✓ met")
        expect(first).to_have_count(0)
        words = line.get_by_role("status")
        expect(words).to_have_text(re.compile("^✓ Taken: .*yaw.* Undo leads back\\.$"))
        after = state(page)
        assert (after["poles"], after["loops"]) != (before["poles"], before["loops"])
        page.get_by_test_id("undo").click()
        until_state(page, "s.settled")
        assert (state(page)["poles"], state(page)["loops"]) == (before["poles"], before["loops"])
        expect(first).to_be_visible()
        expect(line).not_to_contain_text("Taken")
        page.get_by_test_id("redo").click()
        expect(line).to_contain_text("✓ Taken")


@pytest.mark.parametrize("size", [(1280, 800), (1280, 1000), (390, 844)])
def test_what_moves_do_is_there_to_be_read_without_a_pointer(
    app: App, chromium: Browser, size: tuple[int, int]
):
    with opened(chromium, app.url + MISSED, size=size) as page:
        how, words = page.get_by_test_id("nearest-how"), page.get_by_test_id("nearest-all")
        expect(how).to_be_visible()
        low = size == (1280, 800)
        expect(how).to_have_attribute("aria-expanded", str(not low).lower())
        if low:
            how.focus()
            page.keyboard.press("Enter")
        expect(words.locator("li")).to_have_count(page.locator(".nearest-move").count())
        expect(words.locator("li").first).to_contain_text(
            re.compile(r"\d % away: .+ to .+ It gives .*0\.\d+ s")
        )
        assert not violations(page)
        how.click()
        expect(words).to_be_hidden()


def test_a_move_under_the_pointer_is_shown_and_changes_nothing(app: App, chromium: Browser):
    with opened(chromium, app.url + MISSED) as page:
        move = page.get_by_test_id("nearest-move-0")
        expect(move).to_be_visible()
        box = move.bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + 5, box["y"] + 5)
        page.mouse.move(box["x"] + 9, box["y"] + 8)
        until_state(page, "s.preview")
        page.mouse.move(5, 5)
        until_state(page, "!s.preview && s.settled")
        assert state(page)["loops"]["pitch"] == DEFAULT and page.get_by_test_id("undo").is_disabled()


@pytest.mark.parametrize(("lock", "stays"), [("loops", "loops"), ("poles", "poles")])
def test_what_is_locked_does_not_move(app: App, chromium: Browser, lock: str, stays: str):
    with opened(chromium, f"{app.url}{MISSED}&lock={lock}") as page:
        before = state(page)[stays]
        page.get_by_test_id("nearest-move-0").click()
        until_state(page, "s.settled && !s.preview")
        expect(page.get_by_test_id("requirements-verdict")).to_have_text("✓ met")
        assert state(page)[stays] == before


def test_where_nothing_near_is_enough_it_says_so(app: App, chromium: Browser):
    with opened(chromium, app.url + "#v1&req.settling=0.1&lock=poles&view=design") as page:
        expect(page.get_by_test_id("nearest")).to_contain_text("No design nearby meets Settling time")
        expect(page.get_by_test_id("nearest-move-0")).to_have_count(0)
