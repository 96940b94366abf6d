"""The machine beyond the paper's model in a real browser: rotors that lag, their poles, an observer's, the track."""

from __future__ import annotations

import math
import re

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import FRAME, opened, settled, state, until_state, view
from tests.e2e.conftest import App

LAG = "#v1&rotors.pitch.tau=0.165&rotors.yaw.tau=0.165"
OBSERVED = f"{LAG}&place_rotors=true&scenario.measured=observer"


def enter(page: Page, testid: str, value: float) -> None:
    field = page.get_by_test_id(testid)
    field.fill(str(value))
    field.press("Enter")


def test_rotors_that_lag_are_the_fault_and_placing_them_the_remedy(page: Page):
    """The first design stands at the edge of instability where both rotors need 0.1648 s (theory, section 8)."""
    assert state(page)["lagMargin"] == pytest.approx(0.1648, abs=5e-5)
    expect(page.get_by_test_id("rotor-poles")).to_be_hidden()
    view(page, "rig")
    for axis in ("pitch", "yaw"):
        enter(page, f"rig-rotors.{axis}.tau", 0.165)
    until_state(page, "s.settled && s.stable === false")
    assert "rotors_unstable" in state(page)["findings"]
    assert max(p["re"] for p in state(page)["loopPoles"]) == pytest.approx(0, abs=5e-3)
    view(page, "design")
    expect(page.get_by_test_id("lag-crossing")).to_have_count(2)
    expect(page.get_by_test_id("turning-V_p")).to_be_visible()
    page.get_by_test_id("place-rotors").check()
    until_state(page, "s.settled && s.stable && s.K[0].length === 6")
    assert state(page)["lagMargin"] > 0.165
    expect(page.get_by_test_id("k-matrix-05")).to_be_visible()
    expect(page.get_by_test_id("lag-crossing")).to_have_count(0)
    rotor = page.get_by_test_id("pole-4")
    rotor.focus()
    before = state(page)["rotor_poles"]
    rotor.press("ArrowLeft")
    until_state(page, f"s.settled && s.rotor_poles[0] < {before[0]}")
    expect(page.get_by_test_id("rotor-pole-0")).to_have_value(re.compile("−"))
    page.get_by_test_id("undo").click()
    until_state(page, f"s.settled && s.rotor_poles[0] === {before[0]}")


def test_the_observer_has_marks_of_its_own_and_separates(page: Page):
    page.get_by_test_id("experiment").click()
    page.get_by_test_id("outer-none").check(force=True)
    page.get_by_test_id("measured-observer").check(force=True)
    until_state(page, "s.settled && s.observerPoles && s.loopPoles.length === 8")
    placed = [p["re"] for p in [*state(page)["poles"], *state(page)["observer"]["poles"]]]
    assert sorted(p["re"] for p in state(page)["loopPoles"]) == pytest.approx(sorted(placed), rel=1e-4)
    expect(page.get_by_test_id("pole-mark-6")).to_be_visible()
    expect(page.get_by_test_id("separation")).to_contain_text("disk margin")
    enter(page, "noise-theta", 0.1)
    enter(page, "observer-pole-field-0", -30)
    until_state(
        page, "s.settled && s.scenario.noise && s.observerPoles.some(p => Math.abs(p.re + 30) < 1e-4)"
    )
    assert state(page)["scenario"]["noise"]["theta"] == pytest.approx(math.radians(0.1))
    page.get_by_test_id("observer-method-kalman").check(force=True)
    until_state(page, "s.settled && s.observer.method === 'kalman' && s.observerPoles.every(p => p.re < 0)")
    expect(page.get_by_test_id("pole-mark-6")).to_be_hidden()
    page.get_by_test_id("experiment-reset").click()
    until_state(page, "s.settled && s.observerPoles === null")


def test_a_drag_of_an_observers_pole_is_a_drag(app: App, chromium: Browser):
    with opened(chromium, app.url + OBSERVED) as page:
        mark = page.get_by_test_id("pole-mark-6")
        expect(mark).to_be_visible()
        expect(
            page.get_by_test_id("rotor-poles")
        ).to_be_visible()  # comes late, and takes room from the plane
        box = mark.bounding_box()
        assert box is not None
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        before = state(page)["observerPoles"]
        page.mouse.move(x, y)
        partner = page.get_by_test_id("pole-mark-7").bounding_box()
        assert partner is not None
        page.mouse.down()
        page.mouse.move(partner["x"] + partner["width"] / 2, y)  # where both leave the axis together
        page.evaluate(FRAME)
        page.mouse.move(x - 30, y - 25, steps=4)
        page.mouse.up()
        until_state(page, "s.settled && s.dragging === false && s.observer?.poles.some(p => p.im > 0)")
        assert state(page)["observerPoles"] != before
        assert [p["im"] for p in state(page)["poles"]] == [0, 0, 0, 0]


def test_links_carry_the_machine_and_locks_hold_it(app: App, chromium: Browser):
    link = f"{OBSERVED}&q=-30,-31,-32,-33&friction.pitch.coulomb=0.01&lock=preset,observer"
    with opened(chromium, app.url + link) as page:
        settled(page)
        now = state(page)
        assert now["notice"] is None
        assert now["rotors"] == {"pitch": {"tau": 0.165}, "yaw": {"tau": 0.165}}
        assert now["friction"] == {"pitch": {"coulomb": 0.01}}
        assert sorted(p["re"] for p in now["observerPoles"]) == pytest.approx([-33, -32, -31, -30], rel=1e-5)
        view(page, "rig")
        expect(page.get_by_test_id("rig-rotors.pitch.tau")).to_be_disabled()
        view(page, "design")
        page.get_by_test_id("experiment").click()
        expect(page.get_by_test_id("observer-pole-field-0")).to_be_disabled()
        assert "rotors.pitch.tau=0.165" in page.url and "q=-30,-31" in page.url


def test_a_lag_margin_can_be_asked_for(page: Page):
    page.get_by_test_id("requirements").click()
    enter(page, "require-lag", 0.3)
    expect(page.get_by_test_id("requirements-verdict")).to_have_text("✕ lag margin")
    expect(page.locator("[data-code=lag_margin_missed]").first).to_be_visible()
    enter(page, "require-lag", 0.1)
    expect(page.get_by_test_id("requirements-verdict")).to_have_text("✓ met")
