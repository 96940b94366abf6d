"""Tracks in the s-plane: curves of the loop's poles, a slider that previews the design, values taken, gains moved."""

from __future__ import annotations

import re

from playwright.sync_api import Browser, Page, expect

from tests.browser import opened, settled, state, until_state
from tests.e2e.conftest import App
from tests.e2e.test_axe import violations

DESIGN = "#v1&preset=quanser-2dof-manual&p=-12,-10,-3%2B4j,-3-4j&view=design"


def curves(page: Page) -> None:
    expect(page.get_by_test_id("track").locator(".track-line").first).to_be_attached()


def test_the_lag_is_swept_previewed_taken_and_undone(app: App, chromium: Browser):
    with opened(chromium, app.url + DESIGN) as page:
        settled(page)
        page.get_by_test_id("show-track").click()
        page.get_by_test_id("track-path").select_option("rotors.tau")
        curves(page)
        expect(page.get_by_test_id("track-crossing").first).to_be_attached()
        expect(page.get_by_test_id("track-words")).to_contain_text("stable from")
        assert "track=rotors.tau" in page.url
        slider = page.get_by_test_id("track-slider")
        slider.fill("500")
        until_state(page, "s.preview && s.rotors.pitch.tau > 0.1")  # all that is shown is that design's
        expect(page.get_by_test_id("track-words")).to_contain_text("unstable")
        expect(page.get_by_test_id("track-value")).to_have_text(re.compile(r"τ = 0\.1\d"))
        slider.press("Escape")
        until_state(page, "!s.preview && s.rotors?.pitch?.tau === undefined")
        slider.fill("100")
        expect(page.get_by_test_id("track-take")).to_have_text("Take")
        page.get_by_test_id("track-take").click()
        expect(page.get_by_test_id("track-take")).to_have_text("✓ Taken")
        until_state(page, "s.settled && !s.preview && s.rotors.pitch.tau > 0.02 && s.rotors.pitch.tau < 0.04")
        assert state(page)["rotors"]["pitch"] == state(page)["rotors"]["yaw"]
        page.get_by_test_id("undo").click()
        until_state(page, "s.settled && s.rotors?.pitch?.tau === undefined")
        expect(page.get_by_test_id("track-take")).to_have_text("Take")
        assert violations(page) == []


def test_poles_move_from_the_open_loop_to_the_closed_one(app: App, chromium: Browser):
    with opened(chromium, app.url + DESIGN + "&track=gain.pitch", moving=True) as page:
        curves(page)
        expect(page.get_by_test_id("track-zero").first).to_be_attached()
        expect(page.get_by_test_id("track-take")).to_be_hidden()
        page.get_by_test_id("track-play").click()
        expect(page.get_by_test_id("track-value")).to_have_text("k = 1.00")
        expect(page.get_by_test_id("track-play")).to_have_attribute("aria-pressed", "false")
        expect(page.get_by_test_id("track-point")).to_have_count(6)
        expect(page.get_by_test_id("track-words")).to_contain_text("disk margin")
        assert not state(page)["preview"]


def test_an_open_loop_on_the_border_of_stability_crosses_nowhere(app: App, chromium: Browser):
    with opened(chromium, app.url + "#v1&preset=quanser-2dof-manual&view=design&track=gain") as page:
        curves(page)
        expect(page.get_by_test_id("track-words")).to_have_text(
            "stable for every value above 0, up to 3.00; at 0 poles on the imaginary axis"
        )
        expect(page.get_by_test_id("track-crossing")).to_have_count(0)


def test_who_wants_little_motion_goes_step_by_step(app: App, chromium: Browser):
    with opened(chromium, app.url + DESIGN + "&track=gain") as page:
        curves(page)
        play = page.get_by_test_id("track-play")
        play.click()
        first = page.get_by_test_id("track-value").inner_text()
        play.click()
        expect(page.get_by_test_id("track-value")).not_to_have_text(first)
        expect(play).to_have_attribute("aria-pressed", "false")


def test_a_click_on_a_curve_takes_its_value_and_the_range_is_ones_own(app: App, chromium: Browser):
    # so high that the curves' upper ends are on the stage
    with opened(chromium, app.url + DESIGN + "&track=loops.pitch.kp,5,60", size=(1280, 1200)) as page:
        curves(page)
        expect(page.get_by_test_id("track-to")).to_have_value("60")
        end = page.get_by_test_id("track").locator(".track-end")
        boxes = [end.nth(i).bounding_box() for i in range(end.count())]
        stage = page.get_by_test_id("splane").bounding_box()
        assert stage is not None
        seen = [
            b
            for b in boxes
            if b and stage["x"] < b["x"] < stage["x"] + stage["width"] and b["y"] > stage["y"]
        ]
        high = min(seen, key=lambda b: b["y"])  # far above the placed poles
        x, y = high["x"] + high["width"] / 2, high["y"] + high["height"] / 2
        page.mouse.move(x, y)
        expect(page.get_by_test_id("track-words")).to_contain_text("settling time")
        page.mouse.click(x, y)
        until_state(page, "s.settled && s.loops.pitch.kp > 45")
        page.get_by_test_id("track-to").fill("20")
        page.get_by_test_id("track-to").press("Enter")
        expect(page).to_have_url(re.compile(r"track=loops\.pitch\.kp,5,20"))
        page.get_by_test_id("show-track").click()
        expect(page.get_by_test_id("track").locator(".track-line")).to_have_count(0)
        assert "track=" not in page.url
