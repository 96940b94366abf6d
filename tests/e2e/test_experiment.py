"""The experiment's options and the figures of merit in a real browser."""

from __future__ import annotations

import math

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import opened, settled, state
from tests.e2e.conftest import App
from tests.e2e.test_page import PLOTS, TRACES
from tests.e2e.test_rig import entered

ESSENTIAL = ("rise", "settling", "overshoot", "error", "coupling", "V_p", "V_y", "margin", "delay")
MORE = ("undershoot", "iae", "itae", "effort-V_p", "effort-V_y")


def scenario(page: Page) -> dict:
    return state(page)["scenario"]


def until(page: Page, condition: str) -> None:
    """Waits until `s`, the scenario, is as it should be and answered."""
    page.wait_for_function(
        f"() => (s => {condition})(JSON.parse(document.documentElement.dataset.state).scenario)"
    )
    settled(page)


def steps(page: Page, theta: float, psi: float) -> None:
    for axis, value in (("theta", theta), ("psi", psi)):
        field = page.get_by_test_id(f"step-{axis}")
        field.fill(str(value))
        field.press("Enter")
    until(page, f"Math.abs(s.reference.psi - {math.radians(psi)}) < 1e-6")


def evaluated(page: Page, app: App) -> dict:
    """What the server says of the design that is shown, asked over REST."""
    now = state(page)
    body = {name: now[name] for name in ("preset", "poles", "loops", "outer", "coupling", "lead", "pairing")}
    body |= {"scenario": {"rtol": 1e-5, **now["scenario"], "samples": 501}, "each_axis": True}
    reply = page.request.post(app.url + "api/v1/evaluate", data=body)
    assert reply.ok, reply.text()
    return reply.json()


def number(text: str) -> float:
    return float(text.replace("−", "-").split()[0].rstrip("°"))


def test_the_digital_rig_and_a_disturbance_are_simulated_told_and_taken_back(page: Page):
    before = {plot: page.evaluate(TRACES, plot) for plot in PLOTS}
    words = page.get_by_test_id("experiment-words")
    expect(words).to_have_text("continuous controller, undisturbed")
    expect(page.get_by_test_id("experiment-reset")).to_be_hidden()
    page.get_by_test_id("experiment").click()
    page.get_by_test_id("experiment-digital").check()
    until(page, "s.digital")
    expect(words).to_have_text("digital rig, 2 ms")
    page.get_by_test_id("experiment-disturbance").check()
    field = page.get_by_test_id("experiment-disturbance-V_p")
    field.fill("5")
    field.press("Enter")
    until(page, "s.disturbance?.V_p === 5")
    expect(words).to_have_text("digital rig, 2 ms · disturbance 5 V (pitch) at 1.5 s")
    for plot in PLOTS:
        assert page.evaluate(TRACES, plot) != before[plot], plot
    page.get_by_test_id("undo").click()
    until(page, "s.disturbance?.V_p === 1")
    page.get_by_test_id("undo").click()
    until(page, "!s.disturbance && s.digital")
    page.get_by_test_id("experiment-reset").click()
    until(page, "Object.keys(s).length === 2")
    expect(words).to_have_text("continuous controller, undisturbed")
    expect(page.get_by_test_id("experiment-reset")).to_be_hidden()
    page.get_by_test_id("undo").click()
    until(page, "s.digital")


def test_a_sample_time_that_is_too_slow_is_told_at_its_field_and_in_the_findings(page: Page):
    page.get_by_test_id("experiment").click()
    page.get_by_test_id("experiment-digital").check()
    field = page.get_by_test_id("experiment-sample-time")
    field.fill("50")
    field.press("Enter")
    until(page, "s.digital?.sample_time === 0.05")
    assert "slow_sampling" in state(page)["findings"]
    expect(page.get_by_test_id("experiment-warning")).to_contain_text("50 ms is slow")
    page.get_by_test_id("experiment-close").click()
    expect(page.get_by_test_id("experiment-body")).to_be_hidden()
    expect(page.get_by_test_id("experiment-words")).to_contain_text("▲ digital rig, 50 ms")
    expect(page.get_by_test_id("findings")).to_contain_text("50 ms is slow")


def test_what_a_field_cannot_mean_is_told_there_and_what_the_server_refuses_is_marked(page: Page):
    page.get_by_test_id("experiment").click()
    page.get_by_test_id("experiment-digital").check()
    until(page, "s.digital")
    field = page.get_by_test_id("experiment-sample-time")
    for text, complaint in (
        ("0", "must be positive"),
        ("2000", "0.10 to 1000"),
        ("fast", "enter a number"),
    ):
        field.fill(text)
        expect(page.locator("#experiment-sample-time-error")).to_have_text(complaint)
    counts = page.get_by_test_id("experiment-encoder-theta")
    counts.fill("4096.5")
    expect(page.locator("#experiment-encoder-theta-error")).to_have_text("enter a whole number")
    counts.press("Enter")
    expect(counts).to_have_value("")
    assert scenario(page)["digital"] == {}
    field.fill("0.1")
    field.press("Enter")
    duration = page.get_by_test_id("duration")
    duration.fill("30")  # 300,000 samples
    page.wait_for_function("() => JSON.parse(document.documentElement.dataset.state).problem !== null")
    expect(field).to_have_class("number refused")
    expect(page.get_by_test_id("experiment")).to_have_class("refused")
    expect(page.get_by_test_id("findings")).to_contain_text("too many")
    duration.fill("3")
    settled(page)
    expect(field).to_have_class("number")


def test_an_empty_field_is_the_standard_and_back_calculation_brings_its_tracking_time(page: Page):
    steps(page, 35, 20)
    page.get_by_test_id("experiment").click()
    tracking = page.get_by_test_id("experiment-tracking")
    expect(tracking).to_be_hidden()
    page.get_by_label("back-calculation", exact=True).check(force=True)
    until(page, "s.anti_windup === 'back-calculation'")
    expect(tracking).to_have_attribute("placeholder", "100")  # the loops' integral time, ms
    slow = page.evaluate(TRACES, "plot-theta")
    tracking.fill("10")
    tracking.press("Enter")
    until(page, "s.tracking_time === 0.01")
    assert page.evaluate(TRACES, "plot-theta") != slow
    tracking.fill("")
    tracking.press("Enter")
    until(page, "!('tracking_time' in s)")
    assert page.evaluate(TRACES, "plot-theta") == slow
    start = page.get_by_test_id("experiment-start-psi")
    start.fill("-10")
    start.press("Enter")
    until(page, f"Math.abs(s.initial?.psi + {math.radians(10)}) < 1e-6")
    start.fill("")
    start.press("Tab")
    until(page, "!s.initial")


def test_limits_stops_and_trim_can_be_switched_off(page: Page, app: App):
    steps(page, 45, 90)
    page.get_by_test_id("experiment").click()
    for testid, key in (
        ("saturation", "saturation"),
        ("stops", "travel_stops"),
        ("trim", "trim_feedforward"),
    ):
        before = page.evaluate(TRACES, "plot-theta")
        page.get_by_test_id(f"experiment-{testid}").uncheck()
        until(page, f"s.{key} === false")
        assert page.evaluate(TRACES, "plot-theta") != before, testid
        codes = {f["code"] for f in evaluated(page, app)["findings"]}
        assert set(state(page)["findings"]) == codes, testid
        page.get_by_test_id(f"experiment-{testid}").check()
        until(page, f"!('{key}' in s)")


def test_by_keyboard_alone(page: Page):
    page.get_by_test_id("experiment").focus()
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("experiment-body")).to_be_visible()
    page.get_by_test_id("experiment-disturbance").focus()
    page.keyboard.press("Space")
    until(page, "s.disturbance")
    page.keyboard.press("Tab")
    expect(page.get_by_test_id("experiment-disturbance-V_p")).to_be_focused()
    page.keyboard.press("ArrowUp")
    until(page, "Math.abs(s.disturbance.V_p - 1.1) < 1e-9")
    page.keyboard.press("Escape")
    expect(page.get_by_test_id("experiment-body")).to_be_hidden()
    expect(page.get_by_test_id("experiment")).to_be_focused()


def test_the_cloud_says_what_it_leaves_out(page: Page):
    page.get_by_test_id("experiment").click()
    page.get_by_test_id("experiment-digital").check()
    page.get_by_test_id("experiment-disturbance").check()
    page.get_by_test_id("spread").select_option("0.1")
    cloud = page.get_by_test_id("cloud-words")
    expect(cloud).to_contain_text("rigs (not digital, not disturbed): 100 % stable")
    page.get_by_test_id("experiment-reset").click()
    expect(cloud).to_contain_text("rigs: 100 % stable")


def test_figures_are_the_servers_and_more_of_them_are_remembered(page: Page, app: App):
    for row in ESSENTIAL:
        expect(page.get_by_test_id(f"metric-{row}-theta")).to_be_visible()
    for row in MORE:
        expect(page.get_by_test_id(f"metric-{row}-theta")).to_be_hidden()
    page.get_by_test_id("more-figures").click()
    expect(page.get_by_test_id("more-figures")).to_have_attribute("aria-expanded", "true")
    reply = evaluated(page, app)
    for axis in ("theta", "psi"):
        own = reply["axis_steps"][axis]["nonlinear"]["metrics"]
        expected = {
            "iae": math.degrees(own[axis]["iae"]),
            "itae": math.degrees(own[axis]["itae"]),
            "effort-V_p": own["V_p"]["effort"],
            "effort-V_y": own["V_y"]["effort"],
        }
        for row, value in expected.items():
            shown = number(page.get_by_test_id(f"metric-{row}-{axis}").inner_text())
            assert shown == pytest.approx(value, rel=5e-3, abs=5e-3), (row, axis)
    assert number(page.get_by_test_id("metric-lag").inner_text()) == pytest.approx(
        reply["lag_margin"], abs=5e-3
    )
    disk = page.get_by_test_id("metric-disk").inner_text()
    assert disk.startswith(f"{reply['sensitivity']['disk_margin']:.2f}:")
    assert (
        page.get_by_test_id("metric-sensitivity")
        .inner_text()
        .startswith(f"{reply['sensitivity']['peak']:.2f}")
    )
    page.reload()
    settled(page)
    expect(page.get_by_test_id("metric-itae-psi")).to_be_visible()
    page.get_by_test_id("more-figures").click()
    expect(page.get_by_test_id("metric-itae-psi")).to_be_hidden()


def test_every_figure_says_what_it_is(page: Page):
    page.get_by_test_id("more-figures").click()
    titles = page.locator("[data-testid=metrics] tbody th").evaluate_all("nodes => nodes.map((n) => n.title)")
    assert len(titles) == len(ESSENTIAL) + len(MORE) + 3  # and disk margin, sensitivity, lag margin
    assert all(len(title) > 20 for title in titles)


def test_what_limits_cost_stands_beside_the_linear_model(page: Page, app: App):
    expect(page.get_by_test_id("metric-settling-psi-linear")).to_be_empty()
    steps(page, 30, 70)
    metrics = {m: s["metrics"] for m, s in evaluated(page, app)["axis_steps"]["psi"].items()}
    own, ideal = (metrics[m]["psi"]["settling_time"] for m in ("nonlinear", "linear"))
    assert metrics["nonlinear"]["V_y"]["saturated"] > 0 and own > 1.05 * ideal
    expect(page.get_by_test_id("metric-settling-psi")).to_have_text(f"{own:.2f} s")
    expect(page.get_by_test_id("metric-settling-psi-linear")).to_have_text(f"({ideal:.2f})")
    expect(page.get_by_test_id("findings")).to_contain_text(
        f"the yaw step settles in {own:.2f} s (linear: {ideal:.2f} s)"
    )
    asked = number(page.get_by_test_id("metric-V_y-psi-linear").inner_text().strip("()"))
    assert asked > 15
    page.get_by_test_id("show-linear").uncheck()
    expect(page.get_by_test_id("metric-settling-psi-linear")).to_be_empty()
    page.get_by_test_id("show-linear").check()
    page.get_by_test_id("experiment").click()
    page.get_by_test_id("experiment-saturation").uncheck()
    until(page, "s.saturation === false")
    for axis in ("pitch", "yaw"):  # gentle loops, of which nothing else is to be said
        entered(page, f"kp-{axis}", "12")
        entered(page, f"ti-{axis}", "0.08")
    expect(page.get_by_test_id("findings")).to_contain_text("Voltage limits are off")


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_options_and_all_figures_fit_without_moving_the_instrument(
    chromium: Browser, app: App, size: tuple[int, int]
):
    with opened(chromium, app.url, size=size) as page:
        page.wait_for_function(
            "() => [...document.fonts].some((font) => font.status === 'loaded')"
        )  # the symbols'
        still = ("splane", "scene", "k-matrix", "metrics")
        boxes = {name: page.locator(f"[data-testid={name}], #{name}").first.bounding_box() for name in still}
        page.get_by_test_id("experiment").click()
        page.get_by_test_id("experiment-digital").check()
        page.get_by_test_id("experiment-disturbance").check()
        until(page, "s.disturbance && s.digital")
        assert {n: page.locator(f"[data-testid={n}], #{n}").first.bounding_box() for n in still} == boxes
        page.get_by_test_id("more-figures").click()
        for testid in ("experiment-body", "metrics", "metric-sensitivity", *PLOTS):
            box = page.get_by_test_id(testid).bounding_box()
            assert box is not None, testid
            assert box["x"] >= 0 and box["x"] + box["width"] <= size[0], testid
            assert box["y"] >= 0 and box["y"] + box["height"] <= size[1], testid
        drawn = [
            page.get_by_test_id(name).first.bounding_box()
            for name in ("experiment-body", "splane", "scene", *PLOTS)
        ]
        body, *shown = [box for box in drawn if box]
        assert len(shown) == 6
        for box in shown:  # it covers nothing of what it changes
            assert box["height"] > 90
            below = box["y"] >= body["y"] + body["height"]
            right, left = box["x"] - body["x"] - body["width"], body["x"] - box["x"] - box["width"]
            assert below or right >= 0 or left >= 0
        over = "n => n.scrollHeight - n.clientHeight"
        assert page.locator("#metrics").evaluate(over) <= 0


def test_on_a_phone_the_options_open_in_line(chromium: Browser, app: App):
    with opened(chromium, app.url, size=(390, 844)) as page:
        page.get_by_test_id("experiment").click()
        page.get_by_test_id("experiment-digital").check()
        until(page, "s.digital")
        box, panel = (page.locator(s).bounding_box() for s in (".experiment-body", "#scenario"))
        assert box["x"] >= panel["x"] and box["x"] + box["width"] <= panel["x"] + panel["width"]
        assert box["y"] + box["height"] <= panel["y"] + panel["height"]
        assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0
