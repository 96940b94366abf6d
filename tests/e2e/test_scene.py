"""The scene in a real browser: a pose posted by the page moves what the viewer draws."""

from __future__ import annotations

import base64
import math
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Frame, Page

from tests.browser import UNDRAWN, visited
from tests.scene_server import SceneServer, serving

HOST_PAGE = """<!doctype html><title>host</title>
<style>body { margin: 0 } iframe { border: 0; width: 300px; height: 230px }</style>
<script type="module">
import { ScenePlayer } from "./static/scene/player.js";
window.players = {};
window.states = {};
window.open_scene = (name, query) => {
  const frame = document.createElement("iframe");
  frame.name = name;
  frame.src = `scene/${name.padEnd(22, "_")}/${query}`;
  document.body.append(frame);
  window.players[name] = new ScenePlayer(frame, {
    onState: (state) => { window.states[name] = state; },
  });
};
window.hold = (name, theta, psi) => window.players[name].load({
  t: [0, 1], theta: [theta, theta], psi: [psi, psi], V_p: [0, 0], V_y: [0, 0],
});
window.hosting = true;
</script>"""

ANGLES = """() => {
  const data = window.__viserMutable?.nodePoseData ?? {};
  const turn = (name) => data[name]?.wxyz ?? [1, 0, 0, 0];
  const yoke = turn("/rig/yoke"), body = turn("/rig/yoke/body");
  return { psi: -2 * Math.atan2(yoke[3], yoke[0]), theta: -2 * Math.atan2(body[2], body[0]) };
}"""
MESHES = """() => {
  let count = 0;
  window.__viserMutable?.scene?.traverse((object) => {
    count += object.material?.type === "MeshStandardMaterial" ? 1 : 0;
  });
  return count;
}"""
DRAWINGS = "window.__viserTestpoints.rendererInfo.render.frame"
PARTS = 29  # of the helicopter, counted by material
MOST_PICTURES = 40


@pytest.fixture(scope="module")
def server() -> Iterator[SceneServer]:
    with serving(host_page=HOST_PAGE) as running:
        yield running


@pytest.fixture
def host(server: SceneServer, chromium: Browser) -> Iterator[Page]:
    with visited(chromium, UNDRAWN, size=(620, 240)) as visit:
        visit.page.goto(server.http)
        visit.page.wait_for_function("window.hosting")
        yield visit.page


def open_scene(page: Page, name: str, query: str = "") -> Frame:
    """Open a session in a frame and wait until the whole rig is drawn."""
    page.evaluate("([name, query]) => open_scene(name, query)", [name, query])
    page.wait_for_function("name => states[name]?.ready", arg=name)
    frame = page.frame(name)
    assert frame is not None
    frame.wait_for_function(f"() => ({MESHES})() >= {PARTS}")
    # Left alone, the client draws more coarsely where it is slow, and no two pictures compare.
    frame.evaluate("() => window.__viserTestpoints.devSettings.set({ fixedDpr: 1 })")
    rendered(frame)
    return frame


def rendered(frame: Frame, frames: int = 2) -> None:
    """Wait until the viewer has drawn so many more frames, which it does once a second where it need not."""
    start = frame.evaluate(DRAWINGS)
    frame.wait_for_function(
        f"end => {{ window.__viserMutable.requestRender(); return {DRAWINGS} >= end; }}", arg=start + frames
    )


def hold(page: Page, frame: Frame, name: str, theta: float, psi: float) -> None:
    page.evaluate("([name, theta, psi]) => hold(name, theta, psi)", [name, theta, psi])
    frame.wait_for_function(
        f"([theta, psi]) => {{ const a = ({ANGLES})();"
        " return Math.abs(a.theta - theta) < 1e-6 && Math.abs(a.psi - psi) < 1e-6; }",
        arg=[theta, psi],
    )
    rendered(frame)


def pixels(page: Page, frame: Frame) -> bytes:
    """What the canvas shows once it has come to rest, as bytes of red, green, blue and opacity."""
    frame.evaluate("() => { window.drawn = true; }")
    rendered(frame)
    last, alike = picture(frame), 1
    for _ in range(MOST_PICTURES):
        rendered(frame)
        now = picture(frame)
        alike = alike + 1 if now == last else 1
        last = now
        if alike == 3:
            frame.evaluate("() => { window.drawn = false; }")
            return now
    raise AssertionError(f"the picture still changes after {MOST_PICTURES} looks")


def picture(frame: Frame) -> bytes:
    text = frame.evaluate(
        """() => {
          const source = window.__viserMutable.canvas;
          const copy = new OffscreenCanvas(210, 165);
          const draw = copy.getContext("2d");
          draw.drawImage(source, 0, 0, 210, 165);
          let text = "";
          for (const value of draw.getImageData(0, 0, 210, 165).data) text += String.fromCharCode(value);
          return btoa(text);
        }"""
    )
    return base64.b64decode(text)


def changed_share(before: bytes, after: bytes) -> float:
    """The share of pixels that differ by more than noise in any channel."""
    different = sum(
        any(abs(before[k + c] - after[k + c]) > 24 for c in range(4)) for k in range(0, len(before), 4)
    )
    return different / (len(before) / 4)


def test_posted_pose_moves_the_picture_and_taking_it_back_restores_it(host: Page):
    frame = open_scene(host, "moving")
    hold(host, frame, "moving", 0.0, 0.0)
    rest = pixels(host, frame)
    hold(host, frame, "moving", 0.4, 0.8)
    moved = pixels(host, frame)
    hold(host, frame, "moving", 0.0, 0.0)
    assert changed_share(rest, moved) > 0.04
    assert changed_share(rest, pixels(host, frame)) < 0.004


def test_sessions_do_not_disturb_each_other(host: Page):
    left, right = open_scene(host, "left"), open_scene(host, "right")
    hold(host, right, "right", -0.2, 0.3)
    before = pixels(host, right)
    hold(host, left, "left", 0.3, 1.0)
    rendered(right)
    assert right.evaluate(ANGLES) == pytest.approx({"theta": -0.2, "psi": 0.3})
    assert changed_share(before, pixels(host, right)) < 0.004


def test_playback_follows_the_trajectory(host: Page):
    frame = open_scene(host, "playing")
    worst: dict[str, Any] = host.evaluate(
        """async () => {
          const t = Array.from({ length: 101 }, (_, k) => k / 50);
          const theta = t.map((s) => 0.3 * Math.sin(2 * s)), psi = t.map((s) => 0.5 * s);
          const zero = t.map(() => 0);
          const player = players.playing;
          const read = () => {
            const scene = document.querySelector("iframe").contentWindow;
            const of = (name) => scene.__viserMutable.nodePoseData[name].wxyz;
            const [yoke, body] = [of("/rig/yoke"), of("/rig/yoke/body")];
            return [-2 * Math.atan2(body[2], body[0]), -2 * Math.atan2(yoke[3], yoke[0])];
          };
          let [shown, largest] = [0, 0];
          player.load({ t, theta, psi, V_p: zero, V_y: zero });
          player.play();
          while (player.playing) {
            await new Promise(requestAnimationFrame);
            const [th, ps] = read();
            // Pitch and yaw drawn together belong to one time: yaw tells which.
            largest = Math.max(largest, Math.abs(th - 0.3 * Math.sin(4 * ps)));
            shown += ps > 0.02 ? 1 : 0;
          }
          return { shown, largest, end: player.time };
        }"""
    )
    assert worst["end"] == 2.0
    assert worst["shown"] >= 3
    assert worst["largest"] < 1e-3  # rad: the interpolation between points 20 ms apart
    frame.wait_for_function(f"end => Math.abs(({ANGLES})().psi - end) < 1e-6", arg=worst["end"] * 0.5)


def test_changing_the_rig_keeps_the_pose(host: Page, server: SceneServer):
    frame = open_scene(host, "rebuilt")
    hold(host, frame, "rebuilt", 0.25, -0.4)
    session = "rebuilt".ljust(22, "_")
    reply = host.request.put(f"{server.http}/scene/{session}/rig", data={"rig": "aero"})
    assert reply.status == 204
    frame.wait_for_function(
        "() => Math.abs(window.__viserMutable.nodePoseData['/rig/yoke/body']?.position[2] - 0.295) < 1e-9"
    )
    frame.wait_for_function(f"() => Math.abs(({ANGLES})().psi + 0.4) < 1e-6")


def test_pose_returns_after_the_connection_was_lost(host: Page, server: SceneServer):
    frame = open_scene(host, "lost")
    hold(host, frame, "lost", 0.1, math.pi / 3)
    viser = server.sessions.server("lost".ljust(22, "_"))
    assert viser is not None
    host.evaluate("() => { window.seen = []; }")
    host.evaluate("() => addEventListener('message', (e) => window.seen.push(e.data.state))")
    viser._websock_server.disconnect_all_clients()
    host.wait_for_function("() => seen.includes('closed') && seen.at(-1) === 'ready'")
    frame.wait_for_function(f"() => Math.abs(({ANGLES})().psi - Math.PI / 3) < 1e-6")


def test_scene_takes_no_poses_from_elsewhere(host: Page):
    frame = open_scene(host, "guarded")
    hold(host, frame, "guarded", 0.2, 0.1)
    message = {
        "channel": "heli2dof-scene",
        "kind": "pose",
        "messages": [{"type": "SetOrientationMessage", "name": "/rig/yoke", "wxyz": [0, 0, 0, 1]}],
    }
    # From the frame itself, which is not its parent, and then a legal one that proves arrival.
    frame.evaluate("m => window.postMessage(m, location.origin)", message)
    hold(host, frame, "guarded", 0.3, 0.1)
    assert frame.evaluate(ANGLES) == pytest.approx({"theta": 0.3, "psi": 0.1})


def test_address_cannot_send_the_viewer_to_another_server(host: Page):
    frame = open_scene(host, "loyal", "?websocket=ws://127.0.0.1:9/&playbackPath=/static/evil.viser")
    assert "127.0.0.1:9" not in frame.evaluate("location.href")
    assert "playbackPath" not in frame.evaluate("location.href")


def test_panel_and_notices_are_hidden(host: Page):
    frame = open_scene(host, "bare")
    visible = frame.evaluate(
        """() => [...document.querySelectorAll("#root *")].filter((e) =>
             e.children.length === 0 && e.textContent.trim() && e.checkVisibility()
             && e.getBoundingClientRect().width > 0 && !["STYLE", "SCRIPT"].includes(e.tagName)
           ).map((e) => e.textContent.trim())"""
    )
    assert visible == []
