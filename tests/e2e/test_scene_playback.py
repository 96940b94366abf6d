"""Playback in a real browser: what the scene's own graph shows, against the trajectory and the plots."""

from __future__ import annotations

import math
import os
from typing import Any

import pytest
from playwright.sync_api import Browser, Frame, Page, expect

from tests.e2e.conftest import App, opened, settled
from tests.e2e.test_page import drag, scene, seek

# The page's modules at work, and the pose (pitch, yaw in degrees) of the nodes that three.js draws.
PREPARE = """async () => {
  const at = (name) => new URL(`static/${name}.js`, document.baseURI).href;
  const [pose, ghosts, store] = await Promise.all(["scene_pose", "scene_ghosts", "store"].map((n) => import(at(n))));
  const inside = () => document.querySelector("iframe").contentWindow;
  const degrees = (angle) => (angle * 180) / Math.PI;
  window.probe = {
    pose, ghosts, inside,
    of: (id) => document.querySelector(`[data-testid="${id}"]`),
    node: (name) => inside().__viserMutable.nodeRefFromName[name],
    drawn: () => inside().__viserTestpoints.rendererInfo.render.frame,
    shown(root = "/rig") {
      const yoke = probe.node(`${root}/yoke`).quaternion, body = probe.node(`${root}/yoke/body`).quaternion;
      return [degrees(-2 * Math.atan2(body.y, body.w)), degrees(-2 * Math.atan2(yoke.z, yoke.w))];
    },
    wanted(trajectory, t) {
      const { theta, psi } = pose.sampleTrajectory(trajectory, t);
      return [degrees(theta), degrees(psi)];
    },
    colour(name) {
      let found;
      probe.node(name).traverse((o) => { found ??= o.material?.color; });
      return found;
    },
    // After the frame's own callbacks, the scene's included.
    frame: async () => { await new Promise(requestAnimationFrame); await new Promise((done) => {
      const channel = new MessageChannel(); channel.port1.onmessage = done; channel.port2.postMessage(0); }); },
    async reply() {
      const body = JSON.stringify(store.evaluationOf(JSON.parse(document.documentElement.dataset.state)));
      const headers = { "Content-Type": "application/json" };
      const response = await fetch("api/v1/evaluate", { method: "POST", headers, body });
      return response.json();
    },
  };
}"""
CAMERA = """() => {
  const { camera } = probe.inside().__viserMutable;
  return camera.position.toArray().map((v) => Number(v.toFixed(3)));  // three.js: y is up
}"""


def ready(page: Page) -> Frame:
    frame = scene(page)
    # Left alone, the client draws more coarsely where it is slow.
    frame.evaluate("() => window.__viserTestpoints.devSettings.set({ fixedDpr: 0.5 })")
    page.evaluate(PREPARE)
    return frame


@pytest.fixture
def playing(page_with_scene: Page) -> Page:
    ready(page_with_scene)
    return page_with_scene


def until_shown(page: Page, t: float, root: str = "/rig", key: str = "nonlinear") -> None:
    """Wait until the scene's graph shows the response at a time in seconds, to a hundredth of a degree."""
    page.evaluate(f"async () => {{ probe.now = (await probe.reply()).step.{key}; }}")
    page.wait_for_function(
        "([t, root]) => { const [a, b] = [probe.shown(root), probe.wanted(probe.now, t)];"
        " return Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.01; }",
        arg=[t, root],
    )


def time_of(page: Page) -> float:
    return float(page.get_by_test_id("time").input_value())


@pytest.mark.parametrize("speed", [1, 0.25])
def test_the_graph_shows_the_trajectory_at_ten_times_during_playback(
    playing: Page, speed: float, record_property: Any
):
    """Within one frame's motion; the slider, from which the time is read, is rounded to 10 ms."""
    playing.get_by_test_id("speed").select_option(str(speed))
    found = playing.evaluate(
        """async () => {
          const trajectory = (await probe.reply()).step.nonlinear;
          const [shown, one] = [[], (k) => probe.wanted(trajectory, k)];
          probe.of("replay").click();
          for (let before = -1; probe.of("play").textContent === "Pause";) {
            await probe.frame();
            const t = Number(probe.of("time").value);
            if (t > before) shown.push([t, probe.shown()]);
            before = t;
          }
          const apart = (a, b) => Math.max(Math.abs(a[0] - b[0]), Math.abs(a[1] - b[1]));
          const moving = shown.slice(1);
          const ten = Array.from({ length: 10 }, (_, k) => moving[Math.round((k * (moving.length - 1)) / 9)]);
          return {
            frames: moving.length,
            largest: Math.max(...ten.map(([t, pose]) => apart(pose, one(t)))),
            motion: Math.max(...moving.map(([t], k) => apart(one(t), one(shown[k][0])))),
            rounding: Math.max(...moving.map(([t]) => apart(one(t - 0.005), one(t + 0.005)))),
          };
        }"""
    )
    for name, value in found.items():
        record_property(name, value)
    print(
        f"speed {speed}: {found['frames']} frames, largest difference {found['largest']:.4f}°,"
        f" one frame's motion {found['motion']:.2f}°, the slider's rounding {found['rounding']:.2f}°"
    )
    assert found["frames"] >= 4
    assert found["largest"] < found["motion"]
    assert found["largest"] <= found["rounding"]


def test_every_animation_frame_shows_a_new_pose(playing: Page):
    playing.get_by_test_id("speed").select_option("0.25")
    seen = playing.evaluate(
        """async () => {
          const [poses, drawn] = [[], []];
          probe.of("replay").click();
          await probe.frame();
          while (Number(probe.of("time").value) < 0.3) {
            await probe.frame();
            poses.push(probe.shown().join());
            drawn.push(probe.drawn());
          }
          return { poses, drawn };
        }"""
    )
    assert len(seen["poses"]) >= 3
    assert len(set(seen["poses"])) == len(seen["poses"])
    assert all(b > a for a, b in zip(seen["drawn"], seen["drawn"][1:], strict=False))


def test_the_slider_moves_rig_and_cursor_of_all_plots(playing: Page):
    seek(playing, 0.1)
    until_shown(playing, 0.3)
    expect(playing.get_by_test_id("plot-time")).to_contain_text("at 0.30 s")
    expect(playing.get_by_test_id("play")).to_have_text("Play")
    heads = playing.locator(".playhead")
    assert heads.count() == 4
    lefts = {round(heads.nth(k).bounding_box()["x"]) for k in range(4)}  # type: ignore[index]
    assert len(lefts) == 1
    values = playing.evaluate(
        "async () => (await probe.reply()).axis_steps.theta.nonlinear.theta[50] * 180 / Math.PI"
    )
    shown = playing.locator("[data-testid=plot-theta] .values .pitch").inner_text()
    assert float(shown.rstrip("°")) == pytest.approx(values, abs=0.006)


def test_the_plots_move_slider_and_rig(playing: Page):
    seek(playing, 0.5)
    over = playing.locator("[data-testid=plot-psi] .u-over")
    box = over.bounding_box()
    assert box is not None

    def point(share: float) -> tuple[float, float]:
        return box["x"] + share * box["width"], box["y"] + box["height"] / 2

    playing.mouse.move(*point(0.1))
    playing.wait_for_function("() => Math.abs(Number(probe.of('time').value) - 0.3) < 0.02")
    until_shown_at_slider(playing)
    # Where the cursor leaves, the rig goes back; where it is clicked, it stays.
    playing.mouse.move(box["x"] - 60, box["y"] - 200)
    playing.wait_for_function("() => Number(probe.of('time').value) === 1.5")
    playing.mouse.click(*point(0.2))
    playing.mouse.move(box["x"] - 60, box["y"] - 200)
    playing.wait_for_function("() => Math.abs(Number(probe.of('time').value) - 0.6) < 0.02")
    until_shown_at_slider(playing)


def until_shown_at_slider(page: Page) -> None:
    """Wait until the graph shows the slider's time, as well as that is known."""
    page.evaluate("async () => { probe.now = (await probe.reply()).step.nonlinear; }")
    page.wait_for_function(
        "() => { const t = Number(probe.of('time').value), a = probe.shown();"
        " const [l, h] = [-0.006, 0.006].map((d) => probe.wanted(probe.now, t + d));"
        " return [0, 1].every((k) => a[k] > Math.min(l[k], h[k]) - 0.05 && a[k] < Math.max(l[k], h[k]) + 0.05); }"
    )


def test_speed_and_loop(playing: Page):
    playing.get_by_test_id("speed").select_option("4")
    playing.get_by_test_id("loop").check()
    rounds = playing.evaluate(
        """async () => {
          probe.of("replay").click();
          const times = [];
          let [wall, before] = [0, await new Promise(requestAnimationFrame)];
          while (times.filter((t, k) => k > 0 && t < times[k - 1]).length < 2) {
            const now = await new Promise(requestAnimationFrame);
            wall += Math.min((now - before) / 1000, 1);
            before = now;
            times.push(Number(probe.of("time").value));
          }
          return { wall, end: Math.max(...times) };
        }"""
    )
    assert rounds["end"] == pytest.approx(3, abs=0.005)  # it rests at the end
    assert rounds["wall"] == pytest.approx(2 * (3 / 4 + 0.9), abs=1.5)  # a slow frame more or less
    playing.get_by_test_id("loop").uncheck()
    expect(playing.get_by_test_id("play")).to_have_text("Play")
    assert time_of(playing) == 3


def test_a_drag_plays_the_newest_response_from_its_start(playing: Page):
    seek(playing, 1.0)
    assert time_of(playing) == 3
    times = playing.evaluate(
        """() => {
          window.times = [];
          const tick = () => {
            times.push(Number(probe.of("time").value));
            requestAnimationFrame(tick);
          };
          tick();
        }"""
    )
    drag(playing, "pole-0", 40)
    settled(playing)
    playing.wait_for_function("() => times.some((t) => t < 0.5)")
    times = playing.evaluate("() => times")
    assert times[0] == 3
    playing.wait_for_function(
        "() => probe.of('play').textContent === 'Play' && Number(probe.of('time').value) === 3"
    )
    until_shown(playing, 3.0)


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
    # three.js has y up, and its -z is the scene's y.
    assert seen["front"][0] > 0.8 and abs(seen["front"][2]) < 0.01
    assert seen["side"][2] > 0.8 and abs(seen["side"][0]) < 0.01
    assert seen["top"][1] > 1.0 and math.hypot(seen["top"][0], seen["top"][2]) < 0.02
    followed = seen["follow"]
    seek(playing, 0.0)
    playing.wait_for_function(f"(before) => ({CAMERA})()[0] !== before", arg=followed[0])
    playing.get_by_test_id("camera-top").check()
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
      return { error: length - probe.pose.THRUST_SCALE * volts, volts, red: r > g, cap: probe.node(`${node}/cap`).visible };
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
    path = os.environ.get("CHROMIUM") or "/usr/bin/chromium"
    flags = ["--no-sandbox", "--disable-gpu", "--disable-software-rasterizer"]
    with chromium.browser_type.launch(executable_path=path, args=flags) as browser:
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        errors: list[str] = []
        page.on("pageerror", lambda error: errors.append(str(error)))
        opened(page, app.url)
        expect(page.get_by_test_id("scene-notice")).to_have_text(
            "This browser shows no WebGL, so the rig stays unseen. All else works."
        )
        assert page.locator("iframe").count() == 0
        expect(page.get_by_test_id("camera")).to_have_count(0)
        seek(page, 0.1)
        expect(page.get_by_test_id("hud-theta")).to_have_text("9.2°")
        expect(page.get_by_test_id("plot-time")).to_contain_text("at 0.30 s")
        page.get_by_test_id("replay").click()
        page.wait_for_function("() => Number(document.querySelector('[data-testid=time]').value) === 3")
        drag(page, "pole-0", 40)
        assert errors == []
