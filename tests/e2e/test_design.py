"""The design view: what is read is large enough, a finger reaches what it presses, help needs no hover."""

from __future__ import annotations

import pytest
from playwright.sync_api import Browser, Page, Route, expect

from tests.browser import EMPTY, opened, settled, state, view, visited
from tests.e2e.conftest import App
from tests.e2e.test_axe import RUN, violations

READ, DRAWN = 14, 12
"""The smallest type, px: of what is read, and of what stands at the axes of drawings."""
SMALL = """([read, drawn]) => {
  const said = (n) => [...n.childNodes].some((c) => c.nodeType === 3 && c.nodeValue.trim());
  const least = (n) => (n.closest('svg, .plot-texts') ? drawn : read);
  return [...document.querySelectorAll('body *')]
    .filter((n) => !n.closest('script, style, noscript, option, sub, sup, math, tspan, .sr, .skip'))
    .filter((n) => said(n) && n.checkVisibility() && n.getClientRects().length)
    .filter((n) => parseFloat(getComputedStyle(n).fontSize) < least(n) - 0.01)
    .map((n) => [n.className.baseVal ?? n.className, n.textContent.trim().slice(0, 30),
      getComputedStyle(n).fontSize].join(' '));
}"""
TARGETS = """() => {
  const all = 'button, a[href], select, summary, input, label.check, label.key, .choice label';
  const pressed = [...document.querySelectorAll(all)].filter(
    (n) => n.checkVisibility({ visibilityProperty: true }) && n.getBoundingClientRect().width
      && !n.closest('.skip, .sr, .mark-point, .plane-toggle, p, li .message, .caption, .prose')
      && !n.matches('td a, dd a')  // one word of a sentence, as all links within text
      && !(n.matches('input') && n.closest('label')));
  const boxes = pressed.map((n) => [n, n.getBoundingClientRect()]);
  const name = (n) => n.dataset.testid || n.className || n.textContent;
  const small = boxes.filter(([, b]) => b.width < 43.5 || b.height < 43.5)
    .map(([n, b]) => `${name(n)} ${b.width} x ${b.height}`);
  const over = boxes.flatMap(([n, a], i) => boxes.slice(i + 1).filter(([m, b]) =>
    !n.contains(m) && !m.contains(n) && Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
      && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1).map(([m]) => `${name(n)} over ${name(m)}`));
  const thumb = [...document.querySelectorAll('input[type=range]')].filter((n) => n.checkVisibility())
    .map((n) => getComputedStyle(n, '::-webkit-slider-thumb').width).filter((w) => parseFloat(w) < 44);
  const scroller = document.documentElement;  // a telephone's window grows with what is too wide
  return { count: boxes.length, small, over, thumb, wide: scroller.scrollWidth - scroller.clientWidth };
}"""


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_all_that_is_read_has_fourteen_pixels_in_every_view(
    chromium: Browser, app: App, size: tuple[int, int]
):
    with opened(chromium, app.url, size=size) as page:
        page.get_by_test_id("requirements").click()
        page.get_by_test_id("require-settling").fill("0.6")
        page.get_by_test_id("experiment").click()
        page.get_by_test_id("more-figures").click()
        page.get_by_test_id("pin").click()
        page.get_by_test_id("pole-0").focus()
        settled(page)
        assert page.evaluate(SMALL, [READ, DRAWN]) == []
        for name, there in (
            ("explore", "[data-testid=step-ask]"),
            ("compare", "[data-testid=splits-table] td"),
            ("rig", "[data-testid=rig-B_y]"),
            ("derivation", ".paper .mark"),
        ):
            view(page, name)
            page.locator(there).first.wait_for()
            settled(page)
            assert page.evaluate(SMALL, [READ, DRAWN]) == [], name


@pytest.mark.parametrize("size", [(390, 844), (820, 1180)])
def test_a_finger_reaches_every_control(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(chromium, app.url, size=size, has_touch=True, is_mobile=True) as page:
        page.get_by_test_id("requirements").tap()
        page.get_by_test_id("experiment").tap()
        page.get_by_test_id("experiment-digital").tap(force=True)
        page.get_by_test_id("pin").tap()
        settled(page)
        for name, section, there in (
            ("design", "splane", "[data-testid=splane]"),
            ("explore", "explore", "[data-testid=step-ask]"),
            ("rig", "rig", "[data-testid=rig-B_y]"),
            ("compare", "pins", "[data-testid=pin-use-0]"),
            (
                "compare",
                "compare .card:nth-child(1)",
                "[data-testid=compare-table] td",
            ),  # which moves the next down
            ("compare", "compare .card:nth-child(2)", "[data-testid=splits-table] td"),
            ("plant", "plant", "svg"),
            ("derivation", "paper", ".mark"),
        ):
            if page.evaluate("() => document.documentElement.dataset.view") != name:
                view(page, name)
            page.locator(f"#{section}").scroll_into_view_if_needed()
            page.locator(f"#{section}").locator(there).first.wait_for()
            settled(page)
            found = page.evaluate(TARGETS)
            assert found["count"] > 20
            assert (found["small"], found["over"], found["thumb"], found["wide"]) == ([], [], [], 0), name


def test_help_explains_what_is_tapped_and_does_nothing_else(chromium: Browser, app: App):
    with opened(chromium, app.url, size=(820, 1180), has_touch=True) as page:
        before = state(page)
        tip = page.get_by_test_id("tip")
        page.get_by_test_id("help").tap()
        expect(tip).to_contain_text("what it is")
        page.get_by_test_id("reset").tap()
        expect(tip).to_have_text("Back to this preset's parameters, poles, loops and steps")
        page.get_by_test_id("undo").tap(force=True)  # it cannot be pressed now, and is explained all the same
        expect(tip).to_have_text("Undo (Ctrl+Z)")
        page.get_by_test_id("outer-none").tap(force=True)
        expect(tip).to_contain_text("the placed poles, and no others")
        page.locator("[data-testid=metrics] th[title]").nth(2).tap()
        expect(tip).to_contain_text("excess beyond the reference")
        assert page.evaluate("() => document.activeElement.closest('.popup')") is None
        assert violations(page) == []
        page.get_by_test_id("help").tap()
        expect(tip).to_be_hidden()
        assert page.locator("[data-help-stop]").count() == 0
        assert state(page) == before
        page.get_by_test_id("outer-none").tap(force=True)
        settled(page)
        assert state(page)["outer"] == "none"


def test_help_by_keys(page: Page):
    page.get_by_test_id("reset").focus()
    page.keyboard.press("?")
    tip = page.get_by_test_id("tip")
    expect(tip).to_contain_text("what it is")
    page.keyboard.press("Tab")
    expect(tip).to_contain_text("Keep this design beside those that follow")
    heads = page.locator("[data-testid=metrics] th[title]")
    heads.first.focus()  # what takes no focus otherwise
    page.keyboard.press("Tab")
    page.keyboard.press("Shift+Tab")
    expect(tip).to_have_text(heads.first.get_attribute("title") or "")
    page.keyboard.press("Escape")
    expect(tip).to_be_hidden()
    expect(page.get_by_test_id("help")).to_have_attribute("aria-pressed", "false")
    page.get_by_test_id("pole-field-0").fill("?")  # a letter there, no call for help
    expect(page.get_by_test_id("help")).to_have_attribute("aria-pressed", "false")


def test_requirements_and_relative_gains_unfold_where_they_are_wanted(chromium: Browser, app: App):
    with opened(chromium, app.url) as page:
        expect(page.get_by_test_id("require-settling")).to_be_hidden()
        page.get_by_test_id("requirements").click()
        page.get_by_test_id("require-settling").fill("0.4")
        expect(page.get_by_test_id("requirements-verdict")).to_have_text("✕ pitch, yaw")
        expect(page.get_by_test_id("rga-matrix")).to_be_hidden()
        page.get_by_test_id("rga-opener").click()
        expect(page.get_by_test_id("rga-matrix")).to_be_visible()
        page.reload()
        settled(page)
        expect(page.get_by_test_id("require-settling")).to_have_value("0.4")
        expect(page.get_by_test_id("require-settling")).to_be_visible()  # a link may have brought it
        expect(page.get_by_test_id("rga-matrix")).to_be_visible()
        assert violations(page) == []
        page.emulate_media(color_scheme="dark")
        assert page.evaluate(RUN) == []


def test_a_link_can_lock_what_is_asked_of_the_response(chromium: Browser, app: App):
    with opened(chromium, app.url + "#v1&view=design&req.settling=0.9&lock=requirements") as page:
        expect(page.get_by_test_id("require-settling")).to_have_value("0.9")
        expect(page.get_by_test_id("locked")).to_have_text("locked: requirements")
        for key in ("settling", "overshoot", "lag"):
            expect(page.get_by_test_id(f"require-{key}")).to_be_disabled()
        expect(page.get_by_test_id("pole-field-0")).to_be_enabled()


def test_a_slow_server_does_not_end_a_first_visit(chromium: Browser, app: App):
    with visited(chromium, EMPTY) as visit:
        held: list[Route] = []

        def hold(route: Route) -> None:
            held.append(route)

        visit.page.route("**/api/v1/presets*", hold)
        visit.page.goto(app.url)
        # drawn before it knows of any rig
        visit.page.wait_for_function("() => document.documentElement.dataset.view")
        held[0].continue_()
        expect(visit.page.get_by_test_id("step-ask")).to_contain_text("overshoot")
