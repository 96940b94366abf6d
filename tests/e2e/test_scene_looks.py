"""The scene's looks in a real browser: cameras, ghosts, thrust arrows, and what remains without graphics."""

from __future__ import annotations

import math

from playwright.sync_api import Browser, Page, expect

from tests.browser import UNDRAWN, launched, opened, settled
from tests.e2e.conftest import App
from tests.e2e.test_page import drag, seek
from tests.e2e.test_scene_playback import playing, ready, until_shown

__all__ = ["playing"]

CAMERA = """() => {
  const { camera } = probe.inside().__viserMutable;
  const { x, y, z } = probe.node("").worldToLocal(camera.position.clone()); // three.js's own has y up
  return [x, y, z].map((v) => Number(v.toFixed(3)));
}"""

# A weak machine draws the scene's first frame late: viser sets its own first camera there.
SLOW_FRAMES = """if (window !== window.top) {
  const frame = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (act) => setTimeout(() => frame(act), 200);
}"""


def test_cameras_move_the_view_and_the_choice_survives_a_reload(playing: Page):
    seek(playing, 1.0)
    home = playing.evaluate(CAMERA)
    # By keyboard: the cameras are one group, reached by Tab, walked by arrows.
    playing.get_by_test_id("camera-free").focus()
    seen = {"free": home}
    for name in ("front", "side", "top", "follow"):
        playing.keyboard.press("ArrowRight")
        expect(playing.get_by_test_id(f"camera-{name}")).to_be_checked()
        playing.wait_for_function(
            f"(before) => JSON.stringify(({CAMERA})()) !== JSON.stringify(before)",
            arg=list(seen.values())[-1],
        )
        playing.wait_for_function(
            f"() => {{ const now = JSON.stringify(({CAMERA})()), same = now === window.last;"
            " window.last = now; return same; }"
        )
        seen[name] = playing.evaluate(CAMERA)
    assert seen["front"][0] > 0.8 and abs(seen["front"][1]) < 0.01
    assert seen["side"][1] < -0.8 and abs(seen["side"][0]) < 0.01
    assert seen["top"][2] > 1.0 and math.hypot(seen["top"][0], seen["top"][1]) < 0.02
    followed = seen["follow"]
    seek(playing, 0.0)
    playing.wait_for_function(f"(before) => ({CAMERA})()[0] !== before", arg=followed[0])
    playing.get_by_test_id("camera-top").check()
    playing.add_init_script(SLOW_FRAMES)
    playing.reload()
    settled(playing)
    ready(playing)
    expect(playing.get_by_test_id("camera-top")).to_be_checked()
    playing.wait_for_function(
        f"(top) => ({CAMERA})().every((v, k) => Math.abs(v - top[k]) < 0.03)", arg=seen["top"]
    )
    playing.get_by_test_id("camera-reset").click()
    expect(playing.get_by_test_id("camera-free")).to_be_checked()
    playing.wait_for_function(
        f"(home) => ({CAMERA})().every((v, k) => Math.abs(v - home[k]) < 0.03)", arg=home
    )


def test_who_moves_the_camera_has_it(playing: Page):
    playing.get_by_test_id("camera-follow").check()
    box = playing.locator("iframe").bounding_box()
    assert box is not None
    playing.mouse.move(box["x"] + 200, box["y"] + 180)
    playing.mouse.down()
    playing.mouse.move(box["x"] + 260, box["y"] + 190, steps=3)
    playing.mouse.up()
    expect(playing.get_by_test_id("camera-free")).to_be_checked()


def test_pinned_designs_and_the_linear_model_fly_beside_the_rig(playing: Page):
    playing.get_by_test_id("step-theta").fill("30")  # far enough for the models to differ
    playing.get_by_test_id("step-theta").press("Enter")
    settled(playing)
    pinned = playing.evaluate("async () => { probe.pinned = (await probe.reply()).step.nonlinear; }")
    playing.get_by_test_id("pin").click()
    playing.get_by_test_id("pole-field-0").fill("-4")
    playing.get_by_test_id("pole-field-0").press("Enter")
    settled(playing)
    playing.get_by_test_id("fly-linear").check()
    seek(playing, 0.1)
    until_shown(playing, 0.3)
    until_shown(playing, 0.3, root="/ghosts/linear", key="linear")
    playing.wait_for_function(
        "() => { const [a, b] = [probe.shown('/ghosts/0'), probe.wanted(probe.pinned, 0.3)];"
        " return Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.01; }"
    )
    apart = playing.evaluate(
        "() => ['/ghosts/linear', '/ghosts/0'].map((root) =>"
        " Math.hypot(...probe.shown(root).map((v, k) => v - probe.shown()[k])))"
    )
    assert all(distance > 0.3 for distance in apart), (apart, pinned)
    colour = playing.evaluate(
        """() => ["#" + probe.colour("/ghosts/0/yoke/body/shape").getHexString(),
          getComputedStyle(document.documentElement).getPropertyValue("--pin-0").trim()]"""
    )
    assert colour[0] == colour[1]
    playing.get_by_test_id("fly-linear").uncheck()
    playing.get_by_test_id("fly-pins").uncheck()
    playing.wait_for_function(
        "() => !probe.node('/ghosts/linear').visible && !probe.node('/ghosts/0').visible"
    )


def test_arrows_are_as_long_as_voltages_and_red_at_the_limit(playing: Page):
    for axis, value in (("theta", "40"), ("psi", "90")):
        playing.get_by_test_id(f"step-{axis}").fill(value)
        playing.get_by_test_id(f"step-{axis}").press("Enter")
    settled(playing)
    arrow = """(t) => {
      const node = "/rig/yoke/body/pitch_thrust_positive";
      const { r, g } = probe.colour(`${node}/head`);
      const volts = probe.pose.sampleTrajectory(probe.now, t).V_p;
      const length = probe.node(`${node}/head`).position.z + 0.026;
      const cap = probe.node(`${node}/cap`).visible;
      return { error: length - probe.pose.THRUST_SCALE * volts, volts, red: r > g, cap };
    }"""
    for t, full in ((0.03, True), (1.5, False)):
        seek(playing, t / 3)
        until_shown(playing, t)
        playing.wait_for_function(
            f"([t, full]) => {{ const a = ({arrow})(t);"
            " return a.cap === full && a.red === full && Math.abs(a.error) < 2e-4; }",
            arg=[t, full],
        )
        assert (playing.evaluate(arrow, t)["volts"] > 23.99) == full


def test_every_node_that_the_page_moves_is_there(playing: Page):
    missing = playing.evaluate(
        """() => {
          const trajectory = { t: [0], theta: [0], psi: [0] }, color = [0, 0, 0];
          const flights = probe.ghosts.SLOTS.map((slot) => ({ slot, label: slot, color, trajectory }));
          const [reference, limits] = [{ theta: 1, psi: 1 }, { theta: 1, V_p: 1, V_y: 1 }];
          const pose = { t: 0, theta: 0, psi: 0, V_p: 1, V_y: 1, reference, limits };
          const messages = [...probe.pose.poseMessages(pose), ...probe.pose.themeMessages(true),
            ...probe.pose.poseMessages({ ...pose, V_p: -1, V_y: -1 }), ...probe.ghosts.ghostMessages(flights, 0)];
          const tree = probe.inside().__viserMutable.nodePoseData;
          return [...new Set(messages.map((m) => m.name))].filter((name) => !(name in tree));
        }"""
    )
    assert missing == []


def test_without_graphics_the_page_says_so_and_everything_else_works(chromium: Browser, app: App):
    flags = ["--no-sandbox", "--disable-gpu", "--disable-software-rasterizer"]
    with launched(chromium.browser_type, *flags) as browser, opened(browser, app.url, moving=True) as page:
        expect(page.get_by_test_id("scene-notice")).to_have_text(
            "This browser has no WebGL, so the 3D view is off. Everything else works."
        )
        assert page.locator("iframe").count() == 0
        expect(page.get_by_test_id("camera")).to_have_count(0)
        seek(page, 0.1)
        expect(page.get_by_test_id("hud-theta")).to_have_text("9.2°")
        expect(page.get_by_test_id("plot-time")).to_contain_text("at 0.30 s")
        page.get_by_test_id("replay").click()
        page.wait_for_function("() => Number(document.querySelector('[data-testid=time]').value) === 3")
        drag(page, "pole-0", 40)


def test_over_the_rig_a_finger_and_a_wheel_scroll_the_page(chromium: Browser, app: App):
    """Up and down the page moves, sideways the rig turns."""
    with opened(chromium, app.url, scene=UNDRAWN, size=(390, 844), has_touch=True, is_mobile=True) as page:
        page.get_by_test_id("scene").scroll_into_view_if_needed()  # before that it is not loaded
        ready(page)
        screen = page.context.new_cdp_session(page)

        def middle() -> tuple[float, float]:
            page.get_by_test_id("scene").scroll_into_view_if_needed()
            box = page.get_by_test_id("scene").bounding_box() or {}
            return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

        def swipe(across: float, up: float) -> None:
            x, y = middle()
            screen.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
            for part in range(1, 11):
                point = {"x": x + part * across / 10, "y": y - part * up / 10}
                screen.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [point]})
            screen.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

        middle()
        before, seen = page.evaluate("scrollY"), page.evaluate(CAMERA)
        swipe(0, 90)
        page.wait_for_function("(before) => scrollY > before + 40", arg=before)
        assert page.evaluate(CAMERA) == seen
        middle()
        before, seen = page.evaluate("scrollY"), page.evaluate(CAMERA)
        swipe(100, 0)
        page.wait_for_function(f"(seen) => Math.abs(({CAMERA})()[1] - seen[1]) > 0.2", arg=seen)
        assert page.evaluate("scrollY") == before
        page.mouse.move(*middle())
        before, seen = page.evaluate("scrollY"), page.evaluate(CAMERA)
        page.mouse.wheel(0, 60)
        page.wait_for_function("(before) => scrollY > before + 40", arg=before)
        assert page.evaluate(CAMERA) == seen
