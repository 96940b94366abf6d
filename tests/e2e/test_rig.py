"""The rig's parameters and limits in a real browser."""

from __future__ import annotations

import math

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import opened, settled, state, view
from tests.e2e.conftest import App
from tests.e2e.test_axe import violations
from tests.e2e.test_page import PLOTS, TRACES


def until(page: Page, condition: str) -> None:
    """Waits until `s`, the state, is as it should be and answered."""
    page.wait_for_function(f"() => (s => {condition})(JSON.parse(document.documentElement.dataset.state))")
    settled(page)


def entered(page: Page, testid: str, text: str) -> None:
    field = page.get_by_test_id(testid)
    field.fill(text)
    field.press("Enter")


def test_every_parameter_and_limit_is_there_as_the_server_has_it(page: Page, app: App):
    view(page, "rig")
    preset = page.request.get(app.url + "api/v1/presets").json()[0]
    for name, value in preset["parameters"].items():
        field = page.get_by_test_id(f"rig-{name}")
        assert float(field.input_value()) == pytest.approx(value, rel=1e-6), name
        info = preset["parameter_info"][name]
        expect(field).to_have_attribute("aria-label", f"{name}: {info['meaning']}, {info['unit']}")
    assert len(preset["parameters"]) == 12
    for name in ("V_p", "V_y"):
        assert float(page.get_by_test_id(f"rig-limit-{name}").input_value()) == preset["limits"][name]
    travel = float(page.get_by_test_id("rig-limit-theta").input_value())
    assert travel == pytest.approx(math.degrees(preset["limits"]["theta"]), rel=1e-6)
    expect(page.get_by_test_id("rig-source")).to_have_text(preset["source"])


def test_a_parameter_changes_all_that_follows_and_is_taken_back(page: Page, app: App):
    gain, traces = state(page)["K"], {plot: page.evaluate(TRACES, plot) for plot in PLOTS}
    rig = page.get_by_test_id("rig")
    expect(rig).to_be_hidden()
    view(page, "rig")
    entered(page, "rig-B_y", "0.5")
    until(page, "s.parameters.B_y === 0.5")
    assert state(page)["K"] != gain
    body = {"parameters": {"B_y": 0.5}}
    expected = page.request.post(app.url + "api/v1/gains", data=body).json()["K"]
    assert state(page)["K"] == [pytest.approx(row, rel=1e-9) for row in expected]
    for plot in PLOTS[1:]:
        assert page.evaluate(TRACES, plot) != traces[plot], plot
    expect(rig).to_have_text("1 parameter changed")
    expect(page.get_by_test_id("rig-B_y-preset")).to_have_text("● preset 0.318")
    entered(page, "rig-K_pp", "0.25")
    until(page, "s.parameters.K_pp === 0.25")
    expect(rig).to_have_text("2 parameters changed")
    page.get_by_test_id("rig-reset-parameters-B_y").click()
    until(page, "!('B_y' in s.parameters)")
    expect(page.get_by_test_id("rig-B_y")).to_be_focused()
    expect(rig).to_have_text("1 parameter changed")
    page.get_by_test_id("undo").click()
    until(page, "s.parameters.B_y === 0.5")
    page.get_by_test_id("rig-reset").click()
    until(page, "Object.keys(s.parameters).length === 0")
    assert state(page)["K"] == gain
    expect(page.get_by_test_id("rig-reset")).to_be_hidden()


def test_a_limit_saturates_is_drawn_and_travels_with_the_link(page: Page):
    view(page, "rig")
    entered(page, "rig-limit-V_y", "4")
    until(page, "s.limits.V_y === 4")
    assert "saturation_V_y" in state(page)["findings"]
    expect(page.get_by_test_id("remark-V_y")).to_contain_text("▲ at limit")
    entered(page, "rig-limit-theta", "5")
    until(page, "s.findings.includes('reference_beyond_stop')")
    expect(page.get_by_test_id("remark-theta")).to_have_text("▲ beyond a stop")
    expect(page.get_by_test_id("rig")).to_have_text("2 limits changed")
    page.get_by_test_id("rig-limit-theta").fill("")
    until(page, "s.limits.theta === null && !s.findings.includes('reference_beyond_stop')")
    page.wait_for_function("() => location.hash.includes('limits.V_y=4&limits.theta=null')")
    page.reload()
    settled(page)
    assert state(page)["limits"] == {"V_y": 4, "theta": None}
    page.get_by_test_id("reset").click()
    until(page, "Object.keys(s.limits).length === 0")
    page.get_by_test_id("preset").select_option("quanser-aero")
    until(page, "s.preset === 'quanser-aero'")
    expect(page.get_by_test_id("rig-limit-theta")).to_have_value("")
    expect(page.get_by_test_id("rig-K_s")).to_have_value("0.037463")


def test_what_no_rig_can_have_is_told_at_its_field_or_where_the_server_finds_it(page: Page):
    view(page, "rig")
    for testid, text, complaint in (
        ("rig-J_p", "0", "1.0e−9 to 1.0e6"),
        ("rig-B_p", "-1", "0.00 to 1.0e6"),
        ("rig-m", "heavy", "enter a number"),
        ("rig-limit-theta", "200", "0.057 to 183"),
    ):
        page.get_by_test_id(testid).fill(text)
        expect(page.locator(f"#{testid}-error")).to_have_text(complaint)
        page.get_by_test_id(testid).blur()
    assert state(page)["parameters"] == {}
    entered(page, "rig-K_yy", "0")
    entered(page, "rig-K_py", "0")  # then yaw has no motor
    page.wait_for_function(
        "() => JSON.parse(document.documentElement.dataset.state).problem === 'uncontrollable'"
    )
    expect(page.get_by_test_id("rig-problem")).to_contain_text("✕")
    expect(page.get_by_test_id("rig")).to_have_class("rig-link changed refused")
    page.get_by_test_id("rig-reset").click()
    settled(page)
    expect(page.get_by_test_id("rig-problem")).to_be_empty()


def test_by_keyboard_alone(page: Page):
    page.get_by_test_id("view-rig").focus()
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("rig-body")).to_be_visible()
    page.get_by_test_id("rig-B_y").focus()
    page.keyboard.press("ArrowUp")
    until(page, "s.parameters.B_y > 0.318")
    page.keyboard.press("Tab")
    expect(page.get_by_test_id("rig-reset-parameters-B_y")).to_be_focused()
    page.keyboard.press("Enter")
    until(page, "Object.keys(s.parameters).length === 0")


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080), (820, 1180), (390, 844)])
def test_parameters_s_plane_and_plots_are_side_by_side(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(chromium, app.url + "#rig", size=size) as page:
        body = page.get_by_test_id("rig-body")
        page.get_by_test_id("rig-B_y").wait_for()
        box = body.bounding_box()
        assert box and box["x"] >= 0 and box["x"] + box["width"] <= size[0]
        assert body.evaluate("n => n.scrollWidth - n.clientWidth") == 0
        assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0
        if size[0] > 1179:
            for name in ("splane", *PLOTS[: 2 if size[0] < 1600 else 4]):
                seen = page.get_by_test_id(name).first.bounding_box()
                assert seen and seen["y"] + seen["height"] <= size[1], name


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_in_the_open_panel(chromium: Browser, app: App, scheme: str):
    with opened(chromium, app.url, color_scheme=scheme) as page:
        view(page, "rig")
        entered(page, "rig-B_y", "0.5")
        entered(page, "rig-limit-V_y", "4")
        until(page, "s.limits.V_y === 4")
        assert violations(page) == []
