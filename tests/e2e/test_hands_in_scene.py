"""Hands on a flight whose scene is there: the body is pushed by dragging it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import UNDRAWN, opened
from tests.e2e.conftest import App
from tests.e2e.flying import CALL, FRAMES, HEARD, did, fly, waits

PLACE = """async (own) => {
  const { rayThrough, placed, seenAt } = await import(new URL("static/flight/ray.js", document.baseURI).href);
  const frame = document.querySelector("iframe");
  const shapes = await (await fetch("scene/rigs")).json();
  let camera = null;
  const listen = ({ data }) => { camera = data.camera ?? camera; };
  addEventListener("message", listen);
  const data = { channel: "heli2dof-scene", kind: "camera" };
  frame.contentWindow.dispatchEvent(new MessageEvent("message", { data, origin: location.origin, source: window }));
  removeEventListener("message", listen);
  if (!camera) return null;
  const { theta, psi } = window.flight.craft;
  const { x, y } = seenAt(camera, placed(own, shapes.helicopter, { theta, psi }));
  const [left, top, width, height] = camera.box;
  const box = frame.getBoundingClientRect();
  return [box.left + left + (x + 1) / 2 * width, box.top + top + (1 - y) / 2 * height, height];
}"""
# Where three.js itself projects the middle of the pitch rotor's node to.
PROJECTED = """() => {
  const { camera, nodeRefFromName, canvas } = document.querySelector("iframe").contentWindow.__viserMutable;
  const hub = nodeRefFromName["/rig/yoke/body/pitch_rotor"].getWorldPosition(camera.position.clone());
  const { x, y } = hub.project(camera);
  const frame = document.querySelector("iframe").getBoundingClientRect(), box = canvas.getBoundingClientRect();
  return [frame.left + box.left + (x + 1) / 2 * box.width, frame.top + box.top + (1 - y) / 2 * box.height];
}"""
INKED = """() => {
  const canvas = document.querySelector("[data-testid=push-overlay]");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width || 1, canvas.height || 1);
  return data.some((v) => v > 0);
}"""


@pytest.fixture
def in_scene(chromium: Browser, app: App) -> Iterator[Page]:
    """A flight with its scene, which has everything but pixels."""
    with opened(chromium, f"{app.url}#fly", scene=HEARD + UNDRAWN) as page:
        expect(page.get_by_test_id("scene-notice")).to_be_hidden()
        fly(page)
        yield page


def test_whoever_drags_the_body_pushes_it(in_scene: Page):
    page = in_scene
    # rays go where three.js draws: the rotor's middle is where we say that it is, whatever the pose
    page.evaluate(CALL, "freeze")
    page.evaluate(FRAMES)
    expected, found = page.evaluate(PROJECTED), page.evaluate(PLACE, [0.19685, 0, 0.046])
    assert math.dist(expected, found[:2]) < 1.5
    # without the tool the camera turns, with it the body is held; it stands still until it is
    did(page)
    page.keyboard.press("p")
    expect(page.get_by_test_id("push-overlay")).to_have_class("push-overlay on")
    x, y, _ = page.evaluate(PLACE, [0.28, 0.02, 0.046])  # of the pitch rotor as it is seen
    page.mouse.move(x, y)
    expect(page.get_by_test_id("push-overlay")).to_have_class("push-overlay on holds")
    page.mouse.down()
    page.mouse.move(x, y - 80)
    assert did(page) == []
    page.evaluate(CALL, "go")
    waits(page, "craft.u[8] > 0.05")
    expect(page.get_by_test_id("fly-told")).to_contain_text("You push with")
    page.wait_for_function(INKED)
    assert page.evaluate("() => window.flight.craft.theta") != 0
    page.mouse.up()
    waits(page, "craft.u[8] === 0 && craft.u[9] === 0")
    pushes = did(page, "push")
    assert pushes[-1] == ["push", 0, 0]
    steps = [abs(value / 1e-3 - round(value / 1e-3)) for _, *values in pushes for value in values]
    assert max(steps) < 1e-6
    page.wait_for_function(f"() => !({INKED})()")
    # beside the body nothing is held
    page.mouse.move(x, y - 150)
    page.mouse.down()
    page.mouse.move(x, y - 200)
    page.evaluate(FRAMES)
    assert did(page, "push") == []
    page.mouse.up()


def test_shift_pushes_without_the_tool(in_scene: Page):
    page = in_scene
    page.evaluate(CALL, "freeze")
    x, y, _ = page.evaluate(PLACE, [0.15, 0, 0])
    page.keyboard.down("Shift")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y)
    page.evaluate(CALL, "go")
    waits(page, "craft.u[9] !== 0")
    page.mouse.up()
    page.keyboard.up("Shift")
    waits(page, "craft.u[9] === 0")
    expect(page.get_by_test_id("push-overlay")).not_to_have_class(re.compile(r"\bon\b"))


def test_a_scene_that_does_not_tell_its_camera_says_so_and_keys_push(in_scene: Page):
    page = in_scene
    page.evaluate("() => { delete document.querySelector('iframe').contentWindow.__viserMutable.camera; }")
    assert page.evaluate(PLACE, [0.15, 0, 0]) is None
    page.keyboard.press("p")
    expect(page.get_by_test_id("fly-told")).to_have_text(
        "The scene cannot be pushed here: push with Shift and the arrow keys."
    )
    page.keyboard.down("Shift")
    page.keyboard.down("ArrowRight")
    waits(page, "craft.u[9] > 0")
    page.keyboard.up("ArrowRight")
    page.keyboard.up("Shift")


def test_keys_fly_while_the_scene_has_the_focus(in_scene: Page):
    page = in_scene
    page.evaluate("() => { const f = document.querySelector('iframe'); f.focus(); f.contentWindow.focus(); }")
    assert page.evaluate("() => document.activeElement.tagName") == "IFRAME"
    looked = "() => document.querySelector('iframe').contentWindow.__viserMutable.camera.position.toArray()"
    before = page.evaluate(looked)
    page.keyboard.down("w")
    waits(page, "craft.u[5] > 0")
    page.evaluate(FRAMES)
    assert page.evaluate(looked) == before  # viser would come closer by it
    page.keyboard.up("w")
    waits(page, "craft.u[5] === 0")
