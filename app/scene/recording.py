"""A motion to take away: the rig playing a trajectory, as one HTML file or as viser's own recording.

Both play without a server and without a network. The file is viser's serialized scene, the HTML viser's
own page with that in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from heli2dof_core.geometry import RigName
from heli2dof_core.signals import Floats

from .page import taken_away

if TYPE_CHECKING:
    from .rig import RigServer

Format = Literal["html", "viser"]
RATE = 30.0
"""Frames per second; between two the rig stands still."""
MOST_FRAMES = 1800
REST = 1.0
"""Seconds for which the end is held before the player starts again."""
ROTOR_SCALE, BLUR_VOLTAGE, GHOST_DISTANCE = 1.7, 5.0, 0.012
"""As in static/scene_pose.js: rad/(s V), V, rad."""


@dataclass(frozen=True, slots=True)
class Motion:
    """What is played: N samples at times t (s) of θ, ψ (rad), V_p, V_y (V); references in rad."""

    t: Floats
    theta: Floats
    psi: Floats
    V_p: Floats
    V_y: Floats
    reference: tuple[float, float]

    def sampled(self, times: Floats) -> Motion:
        """Return the motion at other times, interpolated linearly and held at its ends."""

        def at(y: Floats) -> Floats:
            return np.interp(times, self.t, y)

        return Motion(times, at(self.theta), at(self.psi), at(self.V_p), at(self.V_y), self.reference)


def frame_times(duration: float) -> Floats:
    """Return evenly spaced times from 0 to the duration, s; fewer a second where it is long."""
    count = min(max(math.ceil(duration * RATE), 1), MOST_FRAMES)
    return np.linspace(0.0, duration, count + 1)


def turns(motion: Motion) -> dict[str, Floats]:
    """Return the unit quaternions (w, x, y, z), N×4, of each node that moves.

    With z up and x towards the nose, positive yaw turns clockwise seen from above and positive pitch
    lifts the nose: both turns are negative.
    """
    step = np.diff(motion.t, prepend=motion.t[0])

    def spin(V: Floats) -> Floats:
        return np.cumsum(ROTOR_SCALE * step * (V + np.roll(V, 1)) / 2)  # step is 0 where roll wraps

    return {
        "/rig/yoke": _about("z", -motion.psi),
        "/rig/yoke/body": _about("y", -motion.theta),
        "/rig/yoke/body/pitch_rotor": _about("z", spin(motion.V_p)),
        "/rig/yoke/body/yaw_rotor": _about("y", spin(motion.V_y)),
    }


def seen(motion: Motion) -> dict[str, np.ndarray]:
    """Return when each node that comes and goes is seen, N truth values."""
    theta, psi = motion.reference
    return {
        "/rig/yoke/body/pitch_blur": np.abs(motion.V_p) > BLUR_VOLTAGE,
        "/rig/yoke/body/yaw_blur": np.abs(motion.V_y) > BLUR_VOLTAGE,
        "/ghost": np.hypot(theta - motion.theta, psi - motion.psi) > GHOST_DISTANCE,
    }


def record(rig: RigName, motion: Motion, kind: Format, title: str = "heli2dof") -> bytes:
    """Return the rig playing the motion, again and again.

    Takes a quarter of a second and a viser server of its own for as long.
    """
    from .rig import RigServer

    frames = motion.sampled(frame_times(float(motion.t[-1])))
    server = RigServer(rig)
    try:
        content = _played(server, frames, kind)
    finally:
        server.stop()
    return content if isinstance(content, bytes) else taken_away(content, title).encode()


def _played(server: RigServer, frames: Motion, kind: Format) -> bytes | str:
    scene = server.scene
    theta, psi = frames.reference
    ghost = {
        "/ghost/yoke": _about("z", np.array([-psi])),
        "/ghost/yoke/body": _about("y", np.array([-theta])),
    }
    nodes: dict[str, Any] = {
        name: scene.get_handle_by_name(name) for name in (*turns(frames), *seen(frames), *ghost)
    }
    for name, quaternion in ghost.items():
        nodes[name].wxyz = quaternion[0]
    turned, visible = turns(frames), seen(frames)
    serializer = server.get_scene_serializer()
    for k in range(len(frames.t)):
        for name, quaternions in turned.items():
            if k == 0 or not np.array_equal(quaternions[k], quaternions[k - 1]):
                nodes[name].wxyz = quaternions[k]
        for name, shown in visible.items():
            if nodes[name].visible != bool(shown[k]):
                nodes[name].visible = bool(shown[k])
        last = k == len(frames.t) - 1
        serializer.insert_sleep(REST if last else float(frames.t[k + 1] - frames.t[k]))
    return serializer.as_html() if kind == "html" else serializer.serialize()


def _about(axis: Literal["y", "z"], angle: Floats) -> Floats:
    quaternion = np.zeros((len(angle), 4))
    quaternion[:, 0] = np.cos(angle / 2)
    quaternion[:, 2 if axis == "y" else 3] = np.sin(angle / 2)
    return quaternion
