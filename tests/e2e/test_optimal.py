"""LQR by its weights, and a Kalman filter's poles: sliders that move poles, their marks, the symmetric root locus."""

from __future__ import annotations

import math

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import opened, settled, state, until_state
from tests.e2e.conftest import App
from tests.e2e.test_axe import violations

LQR = "#v1&preset=quanser-2dof-manual&method=lqr&outer=none"


def marks(page: Page, kind: str, count: int) -> str:
    """What the marks of own poles say, once there are so many; where they stand depends on the view."""
    layer = page.get_by_test_id(f"{kind}-poles")
    expect(layer.locator(":scope > g")).to_have_count(count)
    return layer.get_attribute("aria-label") or ""


def poles(page: Page, app: App, **more: object) -> list[dict]:
    reply = page.request.post(app.url + "api/v1/gains", data={"method": "lqr", **more}).json()
    return reply["optimal_poles"]


def slide(page: Page, testid: str, share: float) -> None:
    """Drags a slider to a share of its length, as a hand does."""
    page.get_by_test_id(testid).scroll_into_view_if_needed()
    box = page.get_by_test_id(testid).bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] / 2, y)
    page.mouse.down()
    page.mouse.move(box["x"] + share * box["width"], y, steps=5)
    page.mouse.up()


def test_a_slider_moves_the_poles_and_is_one_step_of_undo(app: App, chromium: Browser):
    with opened(chromium, app.url + LQR) as page:
        words = page.get_by_test_id("optimal-words")
        expect(words).to_contain_text("Your placed poles are dimmed and ignored")
        expect(page.get_by_test_id("key-optimal")).to_be_visible()
        before = marks(page, "optimal", 4)
        said = words.inner_text()
        slide(page, "weights-states-theta-accepted-slider", 0.25)
        until_state(page, "s.settled && s.weights?.states?.theta > 40")
        told = marks(page, "optimal", 4)
        assert told != before
        expect(words).not_to_have_text(said)
        weights = state(page)["weights"]
        for pole in poles(page, app, weights=weights):
            assert f"{abs(pole['re']):.2f}" in told
        assert "weights.states.theta=" in page.url
        page.get_by_test_id("undo").click()
        until_state(page, "s.settled && s.weights === undefined")
        assert marks(page, "optimal", 4) == before


def test_the_largest_value_accepted_and_the_weight_are_one(app: App, chromium: Browser):
    with opened(chromium, app.url + LQR) as page:
        field = page.get_by_test_id("weights-states-theta-accepted")
        expect(field).to_have_value("10")
        field.fill("5")
        field.press("Enter")
        until_state(page, "s.settled && s.weights?.states?.theta > 100")
        assert state(page)["weights"]["states"]["theta"] == pytest.approx((180 / math.pi / 5) ** 2)
        page.get_by_test_id("weights-as-weight").check(force=True)
        expect(page.get_by_test_id("weights-states-theta")).to_have_value("131.3")
        voltage = page.get_by_test_id("weights-inputs-V_p")
        voltage.fill("-1")
        expect(page.locator("#weights-inputs-V_p-error")).not_to_be_empty()
        voltage.fill("0.25")
        until_state(page, "s.settled && s.weights.inputs?.V_p === 0.25")
        page.get_by_test_id("weights-as-accepted").check(force=True)
        expect(page.get_by_test_id("weights-inputs-V_p-accepted")).to_have_value("2")
        page.get_by_test_id("weights-reset").click()
        until_state(page, "s.settled && s.weights === undefined")
        expect(field).to_have_value("10")


def test_rho_moves_the_poles_along_a_locus_that_stays(app: App, chromium: Browser):
    with opened(chromium, app.url + LQR) as page:
        locus = page.locator("[data-testid=locus][data-shown=true]")
        locus.wait_for(state="attached")
        lines = locus.locator(".locus-path")
        assert lines.count() == 4 and locus.locator(".locus-one").count() == 4
        page.get_by_test_id("fit").click()
        drawn = lines.first.evaluate("(node) => node.getAttribute('d')")
        asked = []
        page.on("request", lambda r: asked.append(r.url) if "locus" in r.url else None)
        rho = page.get_by_test_id("weights-rho")
        rho.fill("1.5")
        rho.press("Enter")
        until_state(page, "s.settled && s.weights?.inputs?.V_p > 0")
        assert state(page)["weights"]["inputs"]["V_p"] == pytest.approx(1.5 / 24**2)
        assert asked == []
        page.get_by_test_id("fit").click()
        body = {"method": "lqr"}
        answer = page.request.post(app.url + "api/v1/locus", data=body).json()
        own = {round(p["re"], 2) for p in poles(page, app, weights=state(page)["weights"])}
        near = min(range(len(answer["rho"])), key=lambda k: abs(math.log(answer["rho"][k] / 1.5)))
        for path in answer["poles"]:
            assert min(abs(path[near]["re"] - p) for p in own) < 0.05 * abs(path[near]["re"])
        assert drawn
        page.get_by_test_id("show-locus").uncheck()
        expect(page.locator("[data-testid=locus][data-shown=true]")).to_have_count(0)


def test_integral_action_has_weights_and_poles_of_its_own(app: App, chromium: Browser):
    with opened(chromium, app.url + LQR) as page:
        expect(page.get_by_test_id("weights-integrals-theta-accepted")).to_be_hidden()
        page.get_by_test_id("method").select_option("lqr-integral")
        until_state(page, "s.settled && s.method === 'lqr-integral'")
        expect(page.get_by_test_id("weights-integrals-theta-accepted")).to_have_value("5")
        marks(page, "optimal", 6)
        page.get_by_test_id("method").select_option("full-rank/axis-decoupled")
        until_state(page, "s.settled && s.method === 'full-rank'")
        expect(page.get_by_test_id("weights")).to_be_hidden()
        expect(page.get_by_test_id("key-optimal")).to_be_hidden()
        expect(page.get_by_test_id("pole-field-0")).to_be_visible()


def test_a_kalman_filters_poles_are_drawn_and_its_noise_moves_them(app: App, chromium: Browser):
    link = "#v1&outer=none&scenario.measured=observer&observer.method=kalman"
    with opened(chromium, app.url + link) as page:
        settled(page)
        before = state(page)["observerPoles"]
        marks(page, "kalman", 4)
        expect(page.get_by_test_id("key-kalman")).to_be_visible()
        page.get_by_test_id("experiment").click()
        slide(page, "observer-voltage_noise-slider", 0.8)
        until_state(page, "s.settled && s.observer?.voltage_noise > 2")
        after = state(page)["observerPoles"]
        assert max(-p["re"] for p in after) > 1.2 * max(-p["re"] for p in before)
        expect(page.get_by_test_id("kalman-words")).to_contain_text("Its poles")


def test_a_locked_method_keeps_its_weights(app: App, chromium: Browser):
    with opened(chromium, app.url + LQR + "&weights.states.psi=9&lock=weights") as page:
        settled(page)
        assert state(page)["weights"] == {"states": {"psi": 9}}
        for testid in ("weights-states-theta-accepted", "weights-rho", "weights-reset"):
            expect(page.get_by_test_id(testid)).to_be_disabled()


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_no_violation(app: App, chromium: Browser, size: tuple[int, int]):
    with opened(chromium, app.url + LQR, size=size) as page:
        page.locator("[data-testid=locus][data-shown=true]").wait_for(state="attached")
        assert violations(page) == []
