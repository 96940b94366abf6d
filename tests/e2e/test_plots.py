"""What plots tell besides their lines: marks, words, pictures and numbers; and how they grow."""

from __future__ import annotations

import csv
import io
import re

import numpy as np
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser import opened, settled, state, view
from tests.e2e.conftest import App
from tests.e2e.test_copy import saved
from tests.e2e.test_explore import LETTERS
from tests.e2e.test_page import PLOTS, centre

DEGREE = 180 / np.pi
UNSTABLE = "#v1&preset=paper-as-computed&p=-3%2B2j,-3-2j,-1%2B3j,-1-3j"


def mark(page: Page, plot: str, kind: str) -> Locator:
    return page.get_by_test_id(f"plot-{plot}").get_by_test_id(f"mark-{kind}")


def numbers(text: str | None) -> list[float]:
    return [float(v.replace("−", "-")) for v in re.findall(r"[−-]?\d+(?:\.\d+)?", text or "")]


def test_marks_tell_the_servers_figures_and_lie_on_the_curve(page: Page, app: App):
    body = {"scenario": {"duration": 3.0, "samples": 501, "rtol": 1e-5}, "each_axis": True}
    steps = page.request.post(app.url + "api/v1/evaluate", data=body).json()["axis_steps"]
    step = steps["theta"]["nonlinear"]
    figures = step["metrics"]["theta"]
    peak, time, overshoot = numbers(mark(page, "theta", "peak").get_attribute("aria-label"))
    assert peak == pytest.approx(figures["peak"] * DEGREE, abs=0.01)
    assert time == pytest.approx(figures["peak_time"], abs=0.01)
    assert overshoot == pytest.approx(figures["overshoot"], abs=0.1)
    (moved, _) = numbers(mark(page, "psi", "coupling").get_attribute("aria-label"))
    assert moved == pytest.approx(step["metrics"]["coupling_peak"] * DEGREE, abs=0.01)
    plot = page.locator("[data-testid=plot-theta] .u-over").bounding_box()
    assert plot is not None
    for kind, when in (("peak", figures["peak_time"]), ("settling", figures["settling_time"])):
        x, _ = centre_of(mark(page, "theta", kind))
        assert x == pytest.approx(plot["x"] + when / 3 * plot["width"], abs=1.5)


def centre_of(locator: Locator) -> tuple[float, float]:
    box = locator.bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_a_mark_speaks_under_pointer_and_focus_and_takes_the_time(page: Page):
    point = mark(page, "theta", "peak")
    tip = page.locator("[data-testid=plot-theta] .mark-tip")
    expect(tip).to_be_hidden()
    point.hover()
    expect(tip).to_have_text(re.compile(r"^Peak 10\.\d\d° at 0\.\d\d s: overshoot \d\.\d %$"))
    inside, plot = tip.bounding_box(), page.get_by_test_id("plot-theta").bounding_box()
    assert inside and plot
    assert inside["x"] >= plot["x"] and inside["x"] + inside["width"] <= plot["x"] + plot["width"]
    page.mouse.move(2, 2)
    expect(tip).to_be_hidden()

    page.locator("[data-testid=plot-theta] .plot-body").focus()
    page.keyboard.press("Tab")
    expect(mark(page, "theta", "rise")).to_be_focused()
    expect(tip).to_have_text(re.compile("^Rise time "))
    page.keyboard.press("Escape")
    expect(tip).to_be_hidden()
    point.focus()
    page.get_by_test_id("play").click() if page.get_by_test_id("play").inner_text() == "Pause" else None
    point.press("Enter")
    seconds = numbers(point.get_attribute("aria-label"))[1]
    page.wait_for_function(
        "(t) => Math.abs(parseFloat(document.querySelector('[data-testid=clock]').textContent) - t) < 0.011",
        arg=seconds,
    )


def test_marks_can_be_switched_off_and_the_link_knows(page: Page):
    expect(mark(page, "psi", "settling")).to_be_visible()
    page.get_by_test_id("show-marks").uncheck()
    expect(page.locator(".mark-point:visible")).to_have_count(0)
    page.wait_for_function("() => location.hash.includes('marks=false')")
    page.reload()
    settled(page)
    expect(page.get_by_test_id("show-marks")).not_to_be_checked()
    expect(page.locator(".mark-point:visible")).to_have_count(0)


def test_marks_follow_the_zoom_and_the_design(page: Page):
    point = mark(page, "theta", "settling")
    before = centre_of(point)
    page.get_by_test_id("pole-field-0").fill("-6")
    page.get_by_test_id("pole-field-0").press("Enter")
    settled(page)
    page.wait_for_function(
        "([x, y]) => { const b = document.querySelector('[data-testid=plot-theta] [data-testid=mark-settling]')"
        ".getBoundingClientRect(); return Math.hypot(b.x + b.width / 2 - x, b.y + b.height / 2 - y) > 2; }",
        arg=list(before),
    )
    body = page.locator("[data-testid=plot-theta] .plot-body")
    body.focus()
    page.get_by_test_id("play").click() if page.get_by_test_id("play").inner_text() == "Pause" else None
    page.get_by_test_id("time").fill("0")
    body.focus()
    for _ in range(3):
        page.keyboard.press("+")
    expect(mark(page, "theta", "settling")).to_be_hidden()
    page.keyboard.press("Escape")
    expect(mark(page, "theta", "settling")).to_be_visible()


def test_plots_over_frequency_are_saved_as_picture_and_numbers(page: Page, app: App):
    view(page, "compare")
    page.locator("[data-testid=interaction-gains] canvas").wait_for()
    rows = list(csv.reader(io.StringIO(saved(page, "frequency-gains", "CSV").read_text(encoding="utf-8"))))
    assert rows[0] == ["omega [rad/s]", "|λ₁₁|", "|λ₁₂|"]
    table = np.array(rows[1:], dtype=float)
    body = {"frequencies": table[:, 0].tolist()}
    reply = page.request.post(app.url + "api/v1/rga", data=body).json()
    np.testing.assert_allclose(table[:, 1], [m[0][0] for m in reply["rga_magnitude"]], rtol=1e-6)
    np.testing.assert_allclose(table[:, 2], [m[0][1] for m in reply["rga_magnitude"]], rtol=1e-6, atol=1e-12)
    picture = saved(page, "frequency-dominance", "PNG").read_bytes()
    assert picture[:8] == b"\x89PNG\r\n\x1a\n" and len(picture) > 20_000


def test_bode_plots_show_the_loops_and_their_margins(page: Page, app: App):
    card = page.get_by_test_id("open-loops")
    view(page, "compare")
    card.scroll_into_view_if_needed()
    card.locator("canvas").first.wait_for()
    rows = list(csv.reader(io.StringIO(saved(page, "frequency-loop-phase", "CSV").read_text("utf-8"))))
    assert rows[0] == ["omega [rad/s]", "pitch motor", "yaw motor"]
    table = np.array(rows[1:], dtype=float)
    reply = page.request.post(app.url + "api/v1/loops", data={"frequencies": table[:, 0].tolist()}).json()
    np.testing.assert_allclose(table[:, 1], np.degrees(reply["pitch"]["phase"]), rtol=1e-6)
    words = page.get_by_test_id("margin-words").inner_text()
    pitch, yaw = words.split("Yaw")
    for said, axis in ((pitch, "pitch"), (yaw, "yaw")):
        margin, frequency = numbers(said)[:2]
        assert margin == pytest.approx(np.degrees(reply["margins"][axis]["phase_margin"]), abs=0.51)
        nearest = int(np.argmin(np.abs(np.log(reply[axis]["gain"]))))
        assert frequency == pytest.approx(table[nearest, 0], rel=0.05)
        assert "gain margin ∞" in said


def test_plots_over_frequency_are_read_by_keys(page: Page):
    card = page.get_by_test_id("open-loops")
    view(page, "compare")
    card.scroll_into_view_if_needed()
    card.locator("canvas").first.wait_for()
    shown = page.get_by_test_id("interaction-loop-gain-0")
    expect(card.locator(".at-frequency")).to_contain_text("the lowest")
    page.get_by_test_id("interaction-loop-gain").locator(".plot-body").focus()
    page.keyboard.press("ArrowRight")
    expect(card.locator(".at-frequency")).to_have_text("10.0 rad/s")
    before = numbers(shown.inner_text())[0]
    page.keyboard.press("Shift+ArrowRight")
    expect(card.locator(".at-frequency")).not_to_have_text("10.0 rad/s")
    assert numbers(shown.inner_text())[0] < before


def test_an_unstable_loop_has_no_margins(chromium: Browser, app: App):
    with opened(chromium, app.url + UNSTABLE) as page:
        view(page, "compare")
        page.get_by_test_id("open-loops").scroll_into_view_if_needed()
        expect(page.get_by_test_id("margin-words")).to_have_text(
            "The whole loop is unstable: it has no margins."
        )


def test_responses_are_held_to_the_requirements_as_well(page: Page):
    amber = """() => {
      const canvas = document.querySelector('[data-testid=plot-theta] canvas:not(.ghosts)');
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += data[i] > data[i + 2] + 60 && data[i + 1] > data[i + 2] + 20;
      return count;
    }"""
    before = page.evaluate(amber)
    page.get_by_test_id("requirements").click()
    page.get_by_test_id("require-overshoot").fill("4")
    page.wait_for_function(f"(n) => ({amber})() > n + 300", arg=before)
    expect(page.get_by_test_id("requirements-verdict")).to_have_text(re.compile("^✕ pitch"))
    overshoot = page.get_by_test_id("metric-overshoot-theta")
    expect(overshoot).to_have_text(re.compile(r"^✕ 4\.\d %$"))
    page.get_by_test_id("require-overshoot").fill("6")
    expect(overshoot).to_have_text(re.compile(r"^4\.\d %$"))


def type_of(page: Page) -> list[float]:
    """The sizes of the letters at the axes of every chart, CSS pixels."""
    return page.evaluate(
        """() => [...new Set([...document.querySelectorAll('.plot canvas:not(.ghosts), .frequency-plot canvas')]
          .map((c) => parseFloat(c.getContext('2d').font.match(/([\\d.]+)px/)[1]) / devicePixelRatio))]"""
    )


def test_a_very_large_window_grows_all_and_all_still_fits(chromium: Browser, app: App):
    sizes = {}
    for size in ((1920, 1080), (3840, 2160)):
        with opened(chromium, app.url, size=size) as page:
            view(page, "compare")
            page.locator("[data-testid=interaction-gains] canvas").wait_for()
            view(page, "design")
            unit = page.locator("[data-testid=pole-mark-0] .ring").bounding_box()
            assert unit is not None
            sizes[size] = [page.evaluate(LETTERS), unit["width"], min(type_of(page))]
            assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0
            for testid in ("splane", *PLOTS, "k-matrix", "metric-delay-psi", "decoupler"):
                box = page.get_by_test_id(testid).first.bounding_box()
                assert box, testid
                assert box["y"] >= 0 and box["y"] + box["height"] <= size[1], testid
    for small, large in zip(*sizes.values(), strict=True):
        assert 1.6 <= large / small <= 2.0, sizes


def test_in_a_very_large_window_a_pole_goes_where_the_pointer_takes_it(chromium: Browser, app: App):
    with opened(chromium, app.url, size=(3840, 2160)) as page:
        x, y = centre(page, "pole-0")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 90, y, steps=6)
        page.mouse.up()
        settled(page)
        assert centre(page, "pole-0") == pytest.approx((x - 90, y), abs=4)
        assert state(page)["poles"][0]["re"] < -12
        readout = page.get_by_test_id("readout").bounding_box()
        assert readout is not None
        assert abs(readout["x"] - (x - 90)) < 120 and abs(readout["y"] - y) < 300


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_figures_of_an_unstable_loop_do_not_touch(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(chromium, app.url + UNSTABLE, size=size) as page:
        assert state(page)["stable"] is False
        over = page.locator(".metrics tbody td").evaluate_all(
            """all => all.filter((td) => td.checkVisibility()).map((td) => {
              const said = [...td.children].filter((c) => c.textContent);
              const left = Math.min(...said.map((c) => c.getBoundingClientRect().left));
              return [td.textContent, left - td.getBoundingClientRect().left];
            }).filter(([, room]) => room < 4)"""
        )
        assert over == []


PAINTED = """
const paint = CanvasRenderingContext2D.prototype.fillText;
window.painted = new Set();
CanvasRenderingContext2D.prototype.fillText = function (text, ...where) {
  window.painted.add(String(text));
  return paint.call(this, text, ...where);
};"""


def test_what_is_painted_passes_through_the_words_too(chromium: Browser, app: App):
    with opened(chromium, app.url + "?lang=qps-ploc") as page:
        page.add_init_script(PAINTED)
        page.reload()
        settled(page)
        page.get_by_test_id("pin").click()
        page.wait_for_function(
            "() => JSON.parse(document.documentElement.dataset.state).pins.every((p) => p.K)"
        )
        view(page, "compare")
        page.locator("[data-testid=interaction-gains] canvas").wait_for()
        page.get_by_test_id("open-loops").scroll_into_view_if_needed()
        page.locator("[data-testid=interaction-loop-phase] canvas").wait_for()
        for name in ("frequency-loop-phase", "frequency-dominance"):
            saved(page, name, "PNG")
        view(page, "design")
        for name in ("theta", "V_y"):
            saved(page, name, "PNG")
        painted = page.evaluate("() => [...window.painted]")
        words = [text for text in painted if re.search(r"[^\W\d_]{3}", text)]
        assert any("référén" in text for text in words)
        assert any("Tîmé" in text for text in words)
        assert any("dömînånt" in text for text in words)
        assert [text for text in words if "⟦" not in text] == []
