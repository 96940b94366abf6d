"""Pinned designs in a real browser: ghosts in the s-plane and the plots, their table, and what survives a reload."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import opened, reopened, settled, state, until_state, view
from tests.e2e.conftest import App
from tests.e2e.test_page import PLOTS, drag
from tests.e2e.test_permalink import set_field, until_hash

GHOSTS = """(plot) => {
  const canvas = document.querySelector(`[data-testid="${plot}"] canvas.ghosts`);
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 3; i < data.length; i += 4) count += data[i] > 0;
  return count;
}"""


def pin(page: Page, count: int) -> None:
    page.get_by_test_id("pin").click()
    until_state(page, f"s.pins.length === {count} && s.pins.every((p) => p.K)")


def seen_table(page: Page) -> None:
    page.get_by_test_id("pins-link").click()
    page.get_by_test_id("pin-row-present").wait_for()


def figure(page: Page, testid: str) -> float:
    text = page.get_by_test_id(testid).inner_text().split("\n")[0]
    found = re.search(r"[−-]?[\d.]+", text)
    assert found, text
    return float(found[0].replace("−", "-"))


def test_a_pinned_design_stays_as_ghosts_while_the_present_one_moves(page: Page):
    before = state(page)
    assert all(page.evaluate(GHOSTS, plot) == 0 for plot in PLOTS)
    pin(page, 1)
    drag(page, "pole-2", 60)
    for plot in PLOTS:
        page.wait_for_function(f"(plot) => ({GHOSTS})(plot) > 300", arg=plot)
    after = state(page)
    assert after["pins"] == [{"name": "Design A", "K": before["K"]}]
    assert after["K"] != before["K"]
    marks = page.locator("[data-testid=pin-poles] path")
    assert marks.count() == 4
    page.get_by_test_id("pin-chip-0").locator(".remove").click()
    page.wait_for_function(f"() => ({GHOSTS})('plot-theta') === 0")
    assert marks.count() == 0


def test_the_table_shows_differences_to_the_present_design(page: Page, app: App):
    pin(page, 1)
    set_field(page, "pole-field-0", "-5")
    set_field(page, "pole-field-1", "-5")
    until_state(page, "s.poles[1].re === -5")
    pin(page, 2)
    set_field(page, "kp-pitch", "10")
    until_state(page, "s.loops.pitch.kp === 10")
    seen_table(page)
    first = page.request.post(app.url + "api/v1/evaluate", data={"each_axis": True}).json()
    assert figure(page, "pin-0-norm") == pytest.approx(first["gains"]["norm"], rel=1e-3)
    rise = first["axis_steps"]["theta"]["nonlinear"]["metrics"]["theta"]["rise_time"]
    assert figure(page, "pin-0-rise-theta") == pytest.approx(rise, abs=6e-3)
    present = figure(page, "pin-present-norm")
    shift = page.get_by_test_id("pin-0-norm").locator("small").inner_text()
    worse = first["gains"]["norm"] > present
    assert shift.startswith("▼ +" if worse else "▲ −")
    cells = [page.get_by_test_id(f"pin-{row}-rise-theta") for row in ("present", "0", "1")]
    values = [figure(page, f"pin-{row}-rise-theta") for row in ("present", "0", "1")]
    best = [("best" in (cell.get_attribute("class") or "")) for cell in cells]
    assert best[values.index(min(values))]


def test_use_rename_and_unpin_by_keyboard(page: Page):
    pin(page, 1)
    original = state(page)["K"]
    set_field(page, "pole-field-0", "-5")
    until_state(page, "s.poles[0].re === -5")
    seen_table(page)
    page.get_by_test_id("pin-rename-0").focus()
    page.keyboard.press("Enter")
    page.get_by_test_id("pin-name-0").wait_for()
    page.keyboard.type("the manual’s & mine")
    page.keyboard.press("Enter")
    until_state(page, "s.pins[0].name === 'the manual’s & mine'")
    expect(page.get_by_test_id("pin-rename-0")).to_be_focused()
    view(page, "design")
    expect(page.get_by_test_id("pin-chip-0")).to_contain_text("the manual’s & mine")
    seen_table(page)
    page.get_by_test_id("pin-use-0").focus()
    page.keyboard.press("Enter")
    until_state(page, "s.poles[0].re === -12")
    assert state(page)["K"] == original
    page.get_by_test_id("pin-delete-0").focus()
    page.keyboard.press("Enter")
    until_state(page, "s.pins.length === 0")
    expect(page.locator("#pins")).to_be_hidden()


def test_pins_survive_a_reload_and_travel_with_the_link(page: Page, app: App, chromium: Browser):
    pin(page, 1)
    set_field(page, "pole-field-0", "-5")
    pin(page, 2)
    until_hash(page, "&pin=1~")
    link, pins = page.url, state(page)["pins"]
    page.reload()
    settled(page)
    until_state(page, "s.pins.length === 2 && s.pins.every((p) => p.K)")
    assert state(page)["pins"] == pins
    reopened(page, app.url)  # the tab keeps them without the link
    until_state(page, "s.pins.length === 2 && s.pins.every((p) => p.K)")
    with opened(chromium, link) as other:
        until_state(other, "s.pins.length === 2 && s.pins.every((p) => p.K)")
        assert state(other)["pins"] == pins


def test_pins_do_not_slow_a_drag(page: Page, record_property):
    """Ghosts are not drawn again while a pole moves; reports the time a frame takes."""
    for index, value in enumerate(("-11", "-9", "-8", "-7", "-6"), start=1):
        set_field(page, "pole-field-0", value)
        pin(page, index)
    page.evaluate(
        """() => {
          window.strokes = 0;
          for (const canvas of document.querySelectorAll("canvas.ghosts")) {
            const context = canvas.getContext("2d");
            const stroke = context.stroke.bind(context);
            context.stroke = (...a) => { window.strokes += 1; stroke(...a); };
          }
          window.layer = document.querySelector("[data-testid=pin-poles]").firstElementChild;
          heli2dofStats.reset();
        }"""
    )
    drag(page, "pole-2", 12, steps=30)
    strokes = page.evaluate("() => window.strokes")
    summary = page.evaluate("() => heli2dofStats.summary()")
    record_property("render", summary["render"])
    print(f"\na drag with five pins: {summary}, {strokes} strokes")
    assert page.evaluate("() => window.layer.isConnected")
    redraw = 5 * 2 * 4 + 5 * 2 * 4  # lines and badges of one drawing of all four plots
    assert strokes <= 3 * redraw  # a range that grows draws anew, thirty moves do not


def test_an_unstable_pin_says_so(page: Page):
    pin(page, 1)
    expect(page.get_by_test_id("pin-chip-0")).not_to_contain_text("unstable")
    for i in range(4):
        set_field(page, f"pole-field-{i}", str(-1 - 0.5 * i))
    until_state(page, "s.stable === false")
    pin(page, 2)
    expect(page.get_by_test_id("pin-chip-1")).to_contain_text("unstable")
    seen_table(page)
    expect(page.get_by_test_id("pin-row-present")).to_contain_text("✕ unstable")
    expect(page.get_by_test_id("pin-row-1")).to_contain_text("✕ unstable")
    expect(page.get_by_test_id("pin-row-0")).not_to_contain_text("unstable")
