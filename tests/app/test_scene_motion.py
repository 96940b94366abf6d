"""The motion as a file: its poses are those of the page, and its frames those of the trajectory."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
import zstandard

from app.scene.motion import MOST_FRAMES, REST, frame_times, motion_file
from app.scene.poses import Motion, State, rotor_angles, states

ROOT = Path(__file__).parents[2]
ASKED = """
import { poseMessages, rotorAngles } from "./static/scene/pose.js";
let text = "";
for await (const part of process.stdin) text += part;
const { trajectory, limits } = JSON.parse(text);
const { pitch, yaw } = rotorAngles(trajectory);
console.log(JSON.stringify(trajectory.t.map((t, k) => {
  const at = Object.fromEntries(["theta", "psi", "V_p", "V_y"].map((name) => [name, trajectory[name][k]]));
  const reference = { theta: trajectory.reference.theta[k], psi: trajectory.reference.psi[k] };
  return poseMessages({ t, ...at, pitchRotor: pitch[k], yawRotor: yaw[k], reference, limits });
})));
"""


def motion(samples: int = 26, duration: float = 2.0) -> Motion:
    """All that a rig can do: voltages of both signs, small, large and at their limits."""
    t = np.linspace(0.0, duration, samples)
    V_p, V_y = 24.0 * np.sin(3.0 * t), np.clip(20.0 * np.cos(2.0 * t), -15.0, 15.0)
    wanted = np.full(samples, 0.2), 0.5 - 0.3 * t
    return Motion(t, 0.3 * np.sin(2.0 * t), 0.5 * t, V_p, V_y, wanted, (24.0, 15.0, 0.7))


def of_the_page(motion: Motion) -> list[list[dict[str, Any]]]:
    """What the page would tell viser at each sample."""
    theta, psi = (course.tolist() for course in motion.reference)
    series = {name: getattr(motion, name).tolist() for name in ("t", "theta", "psi", "V_p", "V_y")}
    limits = dict(zip(("V_p", "V_y", "theta"), motion.limits, strict=True))
    asked = {"trajectory": {**series, "reference": {"theta": theta, "psi": psi}}, "limits": limits}
    node = Path(sys.executable).with_name("node")
    command = [str(node), "--input-type=module", "-e", ASKED]
    done = subprocess.run(
        command, cwd=ROOT, input=json.dumps(asked), capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout)


def state_of(told: list[dict[str, Any]]) -> State:
    state: State = {}
    for message in told:
        updates = dict(message.get("updates", {}))
        for name in ("wxyz", "position", "visible"):
            if name in message:
                updates[name] = message[name]
        for name, value in updates.items():
            state[message["name"], name] = tuple(value) if isinstance(value, list) else value
    return state


def test_poses_are_those_of_the_page():
    given = motion()
    for mine, told in zip(states(given), of_the_page(given), strict=True):
        page = state_of(told)
        assert set(mine) == set(page)
        for slot, value in mine.items():
            assert value == pytest.approx(page[slot], abs=1e-12), slot


def test_nose_points_where_the_angles_say():
    """The centre of mass is at (cos ψ cos θ, −sin ψ cos θ, sin θ) from the pivot: see geometry.py."""
    for state, theta, psi in zip(states(motion()), motion().theta, motion().psi, strict=True):
        nose = rotated(state["/rig/yoke", "wxyz"], rotated(state["/rig/yoke/body", "wxyz"], (1.0, 0.0, 0.0)))
        wanted = (math.cos(psi) * math.cos(theta), -math.sin(psi) * math.cos(theta), math.sin(theta))
        assert nose == pytest.approx(wanted, abs=1e-12)


def rotated(quaternion: tuple[float, ...], vector: tuple[float, ...]) -> tuple[float, ...]:
    w, *axis = quaternion
    u, v = np.array(axis), np.array(vector)
    return tuple(v + 2.0 * np.cross(u, np.cross(u, v) + w * v))


def test_propellers_turn_by_their_voltages_integral():
    t = np.linspace(0.0, 2.0, 21)
    assert rotor_angles(t, 3.0 * t) == pytest.approx(1.7 * 1.5 * t**2)


@pytest.mark.parametrize(
    ("duration", "frames"), [(0.01, 2), (5.0, 151), (60.0, MOST_FRAMES + 1), (600.0, MOST_FRAMES + 1)]
)
def test_frames_span_the_motion_and_are_bounded(duration: float, frames: int):
    times = frame_times(duration)
    assert (times[0], times[-1], len(times)) == (0.0, duration, frames)


def read_viser(content: bytes) -> dict[str, Any]:
    """What is in a .viser file, without its binary buffers."""
    inner = zstandard.ZstdDecompressor().decompress(
        content[8:], max_output_size=int.from_bytes(content[:8], "little")
    )
    size = int.from_bytes(inner[:8], "little")
    return msgspec.msgpack.decode(inner[8 : 8 + size])


def test_file_turns_the_rig_along_the_trajectory():
    given = motion(samples=501, duration=2.0)
    told = read_viser(motion_file("helicopter", given, "viser"))
    assert told["durationSeconds"] == pytest.approx(2.0 + REST)
    turns = [
        (time, message["wxyz"])
        for time, message in told["messages"]
        if message["type"] == "SetOrientationMessage" and message["name"] == "/rig/yoke"
    ]
    assert len(turns) > 50
    for time, (w, _, _, z) in turns[1:]:
        assert -2.0 * math.atan2(z, w) == pytest.approx(0.5 * time, abs=1e-3)


def test_each_rig_plays_as_itself():
    short = motion(samples=3, duration=0.1)
    pivots = []
    for rig in ("helicopter", "aero"):
        told = read_viser(motion_file(rig, short, "viser"))["messages"]
        pivots += [
            m["position"][2]
            for _, m in told
            if m["type"] == "SetPositionMessage" and m["name"] == "/rig/yoke/body"
        ][:1]
    assert pivots == pytest.approx([0.364, 0.295])


def test_page_is_whole_and_its_title_is_text():
    page = motion_file("aero", motion(samples=3, duration=0.1), "html", "<b>2 & 3</b>").decode()
    assert "<title>&lt;b&gt;2 &amp; 3&lt;/b&gt;</title>" in page
    assert page.count("__VISER_EMBED_DATA__=") == 1
    assert 'src="http' not in page
