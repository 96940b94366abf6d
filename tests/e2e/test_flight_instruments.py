"""Instruments of a flight in a real browser: strip chart, dials, lamps, sound."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import EMPTY, opened
from tests.e2e.conftest import App
from tests.e2e.flying import FRAMES, HEARD, fly, waits

# The page's audio, for a test to listen to.
EARS = """window.heard = { tones: [], louds: [] };
const RealAudio = AudioContext;
window.AudioContext = class extends RealAudio { constructor() { super(); heard.context = this; } };
for (const [name, list] of [["OscillatorNode", heard.tones], ["GainNode", heard.louds]]) {
  const Real = window[name];
  window[name] = class extends Real { constructor(...how) { super(...how); list.push(this); } };
}"""
# Pixels of the newest 40 columns of the strip in a colour of the page, at each height.
PAINTED = """(name) => {
  const probe = document.createElement("canvas").getContext("2d");
  const style = getComputedStyle(document.querySelector(".strip"));
  probe.fillStyle = style.getPropertyValue(name);
  probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data;
  const edge = document.querySelector(".strip-plot").getBoundingClientRect().right;
  let found = 0;
  for (const canvas of document.querySelectorAll(".strip-scroll canvas")) {
    const box = canvas.getBoundingClientRect();
    const to = Math.min(Math.round(edge - box.left), canvas.width);
    const from = Math.max(Math.round(edge - box.left) - 40, 0);
    if (to <= from) continue;
    const { data } = canvas.getContext("2d").getImageData(from, 0, to - from, canvas.height);
    for (let i = 0; i < data.length; i += 4)
      if (data[i + 3] > 200 && Math.hypot(data[i] - r, data[i + 1] - g, data[i + 2] - b) < 30) found += 1;
  }
  return found;
}"""
DO = "([word, ...values]) => window.flight.do(word, ...values)"


@pytest.fixture
def page(chromium: Browser, app: App) -> Iterator[Page]:
    """The view Fly, its scene's frame empty, before the first flight."""
    with opened(chromium, f"{app.url}#fly", scene=HEARD + EARS + EMPTY) as page:
        yield page


def test_the_strip_shows_what_is_flown_in_lines_numbers_and_words(page: Page):
    plot = page.locator(".strip-plot")
    expect(plot).to_have_attribute("aria-label", "Strip chart of the last 20 s. ")
    fly(page)
    page.evaluate(DO, ["reference", 0.17, 0.35])
    waits(page, "state.time > 1.5")
    page.evaluate("() => window.flight.freeze()")
    for color in ("--pitch", "--yaw"):
        assert page.evaluate(PAINTED, color) > 40  # at least a line of each, at every column
    assert page.evaluate(PAINTED, "--danger") == 0
    newest = "() => [...window.flight.lastRows(0).rows.slice(0, 2)].map((v) => v * 180 / Math.PI)"
    pitch, yaw = (f"{value:.1f}°".replace("-", "−") for value in page.evaluate(newest))
    values = page.locator(".strip-value.angles b")
    expect(values).to_have_text([pitch, yaw])
    expect(plot).to_have_attribute(
        "aria-label", re.compile(r"^Strip chart of the last 20 s\. Pitch −?\d+°, set point")
    )


def test_a_motor_at_its_limit_is_red_lights_its_lamp_and_the_lamp_glows_on(page: Page):
    fly(page)
    lamp = page.locator("[data-lamp=full_p]")
    expect(lamp).to_have_attribute("data-glow", "off")
    page.evaluate(DO, ["hands", 1])
    page.evaluate(FRAMES)  # the sticks on the screen have asked for hover
    page.evaluate(DO, ["sticks", 30, 0])
    expect(lamp).to_have_attribute("data-glow", "on")
    expect(page.locator(".strip-asked").first).to_have_text("asked 30.0 V")
    expect(page.locator("[data-lamp=hands]")).to_have_attribute("data-glow", "on")
    expect(page.locator("[data-lamp=full_y]")).to_have_attribute("data-glow", "off")
    expect(page.locator(".lamps [role=status]")).to_contain_text("The pitch motor’s voltage is at its limit.")
    page.evaluate(DO, ["sticks", 1, 0])
    # it glows on for 600 ms: time stands still before a busy machine would have missed that
    page.wait_for_function("""() => {
      const glows = document.querySelector("[data-lamp=full_p]").dataset.glow === "glow";
      if (glows && window.flight.craft.volts[0] === 1) window.flight.freeze();
      return window.flight.state.mode === "frozen";
    }""")
    assert page.evaluate(PAINTED, "--danger") > 40
    expect(lamp).to_have_attribute("data-glow", "glow")  # as long as time stands still
    page.evaluate("() => window.flight.go()")
    expect(lamp).to_have_attribute("data-glow", "off")


def test_what_happens_is_marked_and_unmarked_by_a_rewind(page: Page):
    fly(page)
    waits(page, "state.time > 0.5")
    page.evaluate(DO, ["hung", 0.02, 0.1])
    waits(page, "state.time > 1.5")
    page.evaluate(DO, ["gust", 0.05, 0, 100])
    flags = page.locator(".strip-flag")
    expect(flags).to_have_text(["Mass hung on", "Gust"])
    expect(page.locator("[data-lamp=hung]")).to_have_attribute("data-glow", "on")
    waits(page, "state.time > 2")
    page.evaluate("() => window.flight.freeze()")
    page.evaluate("() => window.flight.rewind(window.flight.state.time - 1)")
    expect(flags).to_have_text(["Mass hung on"])
    page.evaluate("() => window.flight.rewind(window.flight.state.time - 0.1)")
    expect(flags).to_have_count(0)
    expect(page.locator("[data-lamp=hung]")).to_have_attribute("data-glow", "off")


def test_a_moment_of_the_past_is_pointed_at_until_it_is_flown_from(page: Page):
    fly(page)
    page.evaluate(DO, ["reference", 0.4, 1.5])
    waits(page, "state.time > 2.5")
    page.evaluate("() => window.flight.freeze()")
    past, cursor = page.get_by_test_id("fly-past"), page.locator(".strip-cursor")
    yaw = page.locator(".dial.yaw .dial-value")
    now = yaw.text_content()
    expect(cursor).to_be_hidden()
    past.focus()
    page.evaluate(
        """() => { const past = document.querySelector("[data-testid=fly-past]");
        past.value = "-2.4"; past.dispatchEvent(new Event("input")); }"""
    )
    expect(cursor).to_be_visible()
    expect(yaw).not_to_have_text(now or "")
    past.dispatch_event("change")
    expect(cursor).to_be_hidden()


def test_the_rotors_are_heard_on_request_and_only_while_it_flies(page: Page):
    fly(page)
    assert page.evaluate("() => window.heard.context === undefined")
    button = page.get_by_test_id("fly-sound")
    button.click()
    expect(button).to_have_attribute("aria-pressed", "true")
    page.wait_for_function(
        "() => heard.context.state === 'running' && heard.louds.every((own) => own.gain.value > 0.001)"
    )
    page.wait_for_function("() => heard.tones[0].frequency.value > 60 && heard.tones[1].frequency.value > 92")
    page.evaluate("() => window.flight.freeze()")
    page.wait_for_function("() => heard.context.state === 'suspended'")
    page.evaluate("() => window.flight.go()")
    page.wait_for_function("() => heard.context.state === 'running' && heard.louds[0].gain.value > 0.001")
    button.click()
    page.wait_for_function("() => heard.context.state === 'suspended'")


def test_the_strip_is_printed_in_ink_for_white_paper(page: Page):
    page.emulate_media(color_scheme="dark")
    fly(page)
    waits(page, "state.time > 1")
    page.evaluate("() => window.flight.freeze()")
    assert page.evaluate(PAINTED, "--pitch") > 40
    page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
    ink = page.evaluate(
        "() => getComputedStyle(document.querySelector('.strip')).getPropertyValue('--pitch')"
    )
    assert ink == "#b94a2c"
    assert page.evaluate(PAINTED, "--pitch") > 40
    page.evaluate("() => dispatchEvent(new Event('afterprint'))")
    assert page.evaluate(PAINTED, "--pitch") > 40  # in the theme's colour again
