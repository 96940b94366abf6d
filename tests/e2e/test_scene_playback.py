"""Playback in a real browser: what the scene's own graph shows, against the trajectory and the plots."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Frame, Page, expect

from tests.browser import settled, until_state
from tests.e2e.test_page import drag, scene, seek

# The page's modules at work, and the pose (pitch, yaw in degrees) of the nodes that three.js draws.
PREPARE = """async () => {
  const at = (name) => new URL(`static/${name}.js`, document.baseURI).href;
  const modules = ["scene/pose", "scene/ghosts", "model/store"].map((name) => import(at(name)));
  const [pose, ghosts, store] = await Promise.all(modules);
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


@pytest.mark.parametrize(("speed", "duration"), [(1, 3), (0.25, 0.8)])
def test_the_graph_shows_the_trajectory_at_ten_times_during_playback(
    playing: Page, speed: float, duration: float, record_property: Any
):
    """Within one frame's motion; the slider, from which the time is read, is rounded to 10 ms."""
    playing.get_by_test_id("duration").fill(str(duration))
    playing.get_by_test_id("duration").press("Enter")
    until_state(playing, f"s.scenario.duration === {duration}")
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
