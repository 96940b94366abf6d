"""A motion to take away: the rig playing a trajectory, as one HTML file or as viser's own recording.

Both play without a server and without a network. The file is viser's serialized scene, the HTML viser's
own page with that in it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from heli2dof_core.errors import Wanted, nobody_leaves
from heli2dof_core.geometry import RigName
from heli2dof_core.signals import Floats

from .page import standalone_page
from .poses import Motion, Slot, states

if TYPE_CHECKING:
    from .rig import RigServer

MotionFormat = Literal["html", "viser"]
RATE = 30.0
"""Frames per second; between two the rig stands still."""
MOST_FRAMES = 1800
REST = 1.0
"""Seconds for which the end is held before the player starts again."""


def frame_times(duration: float, most: int = MOST_FRAMES) -> Floats:
    """Return evenly spaced times from 0 to the duration, s; fewer a second where they would be more than `most`."""
    count = min(max(math.ceil(duration * RATE), 1), most)
    return np.linspace(0.0, duration, count + 1)


def motion_file(
    rig: RigName,
    motion: Motion,
    kind: MotionFormat,
    title: str = "heli2dof",
    *,
    most: int = MOST_FRAMES,
    wanted: Wanted = nobody_leaves,
) -> bytes:
    """Return a file in which the rig plays the motion, again and again.

    Takes a quarter of a second for each hundred frames, and a viser server of its own for as long.

    Args:
        rig: what is seen.
        motion: what it does.
        kind: of the file.
        title: of the page.
        most: frames.
        wanted: called before each frame; what it raises ends it.
    """
    from .rig import RigServer

    frames = motion.sampled(frame_times(float(motion.t[-1]), most))
    server = RigServer(rig)
    try:
        content = _played(server, frames, kind, wanted)
    finally:
        server.stop()
    return content if isinstance(content, bytes) else standalone_page(content, title).encode()


def _played(server: RigServer, frames: Motion, kind: MotionFormat, wanted: Wanted) -> bytes | str:
    nodes: dict[str, Any] = {}
    shown: dict[Slot, Any] = {}

    def show(state: Mapping[Slot, Any]) -> None:
        for slot, value in state.items():
            if shown.get(slot) != value:
                node, attribute = slot
                if node not in nodes:
                    nodes[node] = server.scene.get_handle_by_name(node)
                setattr(nodes[node], attribute, value)
                shown[slot] = value

    serializer = None
    for k, state in enumerate(states(frames)):
        wanted()
        show(state)
        # What stands at first belongs to the scene.
        serializer = serializer or server.get_scene_serializer()
        last = k == len(frames.t) - 1
        serializer.insert_sleep(REST if last else float(frames.t[k + 1] - frames.t[k]))
    assert serializer is not None
    return serializer.as_html() if kind == "html" else serializer.serialize()
