"""The rig as nodes of a viser server. Imported only when the first session is made: viser is slow.

Nodes that the page moves: /rig/yoke (ψ), /rig/yoke/body (θ), its rotors and blurs (spin) and thrust
arrows; /rig/yoke's two stops; /ghost (the reference), /ghosts/linear and /ghosts/0 to 5 (pinned
designs), each with a yoke and a body. static/scene/pose.js and scene/ghosts.js name the same nodes.
"""

from __future__ import annotations

import functools
import logging
import math
from typing import Any

import numpy as np
import rich
from viser import GlbHandle, MeshHandle, ViserServer

from heli2dof_core.geometry import RigGeometry, RigName, Rotor, geometry

from . import graphics, machine
from .glb import glb
from .shapes import Mesh
from .views import first_view

LOOPBACK = "127.0.0.1"
Point = tuple[float, float, float]
Color = tuple[int, int, int]
ORIGIN: Point = (0.0, 0.0, 0.0)
GHOSTS = ("linear", *(str(k) for k in range(6)))
"""Ghosts beside the reference: the linear model and pinned designs, as many as have a colour."""

# First colours; the page sets those of its theme.
_SCALE: Color = (78, 86, 96)
_PITCH: Color = (185, 74, 44)
_YAW: Color = (23, 74, 114)
_STOP: Color = (200, 30, 30)
_THRUST: Color = (30, 140, 95)
_GHOST: Color = (79, 123, 166)

# viser prints a table of addresses per server, to standard output, whatever `verbose` says.
rich.reconfigure(quiet=True)


class RigServer(ViserServer):
    """A viser server that shows one rig, on a free port of the loopback interface."""

    def __init__(self, rig: RigName) -> None:
        super().__init__(host=LOOPBACK, port=0, verbose=False)
        self.gui.configure_theme(show_logo=False, show_share_button=False)
        self.show(rig)

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Refuse: any client may ask, and the tunnel would publish the session."""
        return None

    def disconnect_share_url(self) -> None:
        """Do nothing: there never is a tunnel."""

    def stop(self) -> None:
        """Stop, and let go of everything at once; a stopped server is good for nothing.

        Its parts refer to one another. Left to the collector of cycles, which looks at old objects
        seldom, the scenes of a hundred sessions would lie about. viser also hangs a filter into the
        logger of its sockets for each server and leaves it there.
        """
        if "scene" not in vars(self):
            return
        super().stop()
        logger = logging.getLogger("websockets.server")
        for extra in [f for f in logger.filters if type(f).__module__.startswith("viser.")][:-1]:
            logger.removeFilter(extra)
        _empty(self)

    def show(self, rig: RigName) -> None:
        """Replace all nodes by those of the named rig, in one atomic change."""
        with self.atomic():
            self.scene.reset()
            _build(self, geometry(rig))


def _empty(root: object) -> None:
    """Empty an object and all of viser's objects in it, so that none holds another."""
    waiting: list[Any] = [root]
    while waiting:
        part = waiting.pop()
        if isinstance(part, dict):
            waiting += part.values()
        elif isinstance(part, (list, tuple)):
            waiting += part
        elif type(part).__module__.startswith(("viser.", __name__)) and getattr(part, "__dict__", None):
            waiting += vars(part).values()
            vars(part).clear()


@functools.cache
def _files(rig: RigName) -> dict[str, bytes]:
    """Return the rig's moving parts as binary glTF, made once and shared by all sessions."""
    shape = geometry(rig)
    pitch, yaw = shape.pitch_rotor, shape.yaw_rotor
    parts = {
        "base": machine.base_parts(shape),
        "mast": machine.mast_parts(shape),
        "yoke": machine.yoke_parts(shape),
        "body": machine.body_parts(shape),
        "pitch_rotor": machine.rotor_parts(pitch, machine.PITCH_COLOR),
        "yaw_rotor": machine.rotor_parts(yaw, machine.YAW_COLOR),
        "pitch_blur": graphics.blur_parts(pitch, machine.PITCH_COLOR),
        "yaw_blur": graphics.blur_parts(yaw, machine.YAW_COLOR),
    }
    return {name: glb(list_of_parts) for name, list_of_parts in parts.items()}


def _build(server: ViserServer, rig: RigGeometry) -> None:
    scene, files = server.scene, _files(rig.name)
    pivot = (0.0, 0.0, rig.pivot_height)

    def part(node: str, file: str, *, at: Point = ORIGIN, solid: bool = True) -> GlbHandle:
        # Round parts that receive shadows show the shadow map's steps, so only the flat base does.
        flat_top = file == "base"
        return scene.add_glb(node, files[file], position=at, cast_shadow=solid, receive_shadow=flat_top)

    part("/rig/base", "base")
    part("/rig/mast", "mast")
    _flat(server, "/rig/scale", graphics.yaw_scale(rig), _SCALE)
    scene.add_frame("/rig/yoke", show_axes=False)
    part("/rig/yoke/shape", "yoke")
    _flat(server, "/rig/yoke/pointer", graphics.yaw_pointer(rig), _YAW)
    _flat(server, "/rig/yoke/pitch_scale", graphics.pitch_scale(rig), _SCALE, at=pivot)
    for name, side in (("stop_up", 1), ("stop_down", -1)):
        # The page puts them where the design's limits are.
        stop = graphics.stop(rig, side)
        _flat(server, f"/rig/yoke/{name}", stop, _STOP, at=pivot).visible = False
    scene.add_frame("/rig/yoke/body", show_axes=False, position=pivot)
    part("/rig/yoke/body/shape", "body")
    _flat(server, "/rig/yoke/body/pointer", graphics.nose_pointer(rig), _PITCH)
    for name, rotor in (("pitch", rig.pitch_rotor), ("yaw", rig.yaw_rotor)):
        node, hub = f"/rig/yoke/body/{name}", machine.hub_position(rotor)
        part(f"{node}_rotor", f"{name}_rotor", at=hub)
        part(f"{node}_blur", f"{name}_blur", at=hub, solid=False).visible = False
        _arrows(server, f"{node}_thrust", rotor)

    # The page shows the reference's ghost where it differs from the pose, and others as asked.
    _ghost(server, rig, "/ghost", graphics.reference_yoke(rig), opacity=0.34)
    for place, name in enumerate(GHOSTS):
        ghost = _ghost(server, rig, f"/ghosts/{name}", graphics.ghost_yoke(rig), opacity=0.56)
        ghost.wireframe = name == "linear"
        label = f"/ghosts/{name}/yoke/body/label"
        scene.add_label(label, name, position=graphics.ghost_label(rig, place), anchor="bottom-center")

    _light(server, rig)
    _frame(server, rig)


def _flat(
    server: ViserServer,
    node: str,
    mesh: Mesh,
    color: Color,
    *,
    at: Point = ORIGIN,
    opacity: float | None = None,
) -> MeshHandle:
    """Add a mesh of one colour, without shadow."""
    return server.scene.add_mesh_simple(
        node,
        mesh.vertices.astype(np.float32),
        mesh.faces.astype(np.uint32),
        color=color,
        opacity=opacity,
        side="front" if opacity is None else "double",
        cast_shadow=False,
        receive_shadow=False,
        position=at,
    )


def _arrows(server: ViserServer, node: str, rotor: Rotor) -> None:
    """Add a hidden thrust arrow for either sign of the rotor's voltage."""
    for sign, (start, turn) in graphics.arrow_starts(rotor).items():
        arrow = f"{node}_{sign}"
        wxyz = (math.cos(turn / 2), math.sin(turn / 2), 0.0, 0.0)
        server.scene.add_frame(arrow, show_axes=False, position=start, wxyz=wxyz, visible=False)
        _flat(server, f"{arrow}/shaft", graphics.arrow_shaft(), _THRUST)
        _flat(server, f"{arrow}/head", graphics.arrow_head(), _THRUST)
        _flat(server, f"{arrow}/cap", graphics.arrow_cap(), _STOP).visible = False


def _ghost(server: ViserServer, rig: RigGeometry, node: str, yoke: Mesh, *, opacity: float) -> MeshHandle:
    """Add a hidden ghost and return its body."""
    scene = server.scene
    scene.add_frame(node, show_axes=False, visible=False)
    scene.add_frame(f"{node}/yoke", show_axes=False)
    _flat(server, f"{node}/yoke/shape", yoke, _GHOST, opacity=opacity)
    scene.add_frame(f"{node}/yoke/body", show_axes=False, position=(0.0, 0.0, rig.pivot_height))
    body = graphics.ghost_body(rig)
    return _flat(server, f"{node}/yoke/body/shape", body, _GHOST, opacity=opacity)


def _light(server: ViserServer, rig: RigGeometry) -> None:
    scene = server.scene
    # viser's own lights spread three shadow maps over 20 m; one lamp close by draws a crisper
    # shadow for a third of the work, and the client's built-in surroundings give the metal shine.
    scene.configure_default_lights(enabled=False)
    lamp = (0.55, -0.35, 1.7)
    aim = 0.75 * rig.pivot_height
    scene.add_light_spot(
        "/light/key",
        position=lamp,
        direction=(-lamp[0], -lamp[1], aim - lamp[2]),
        intensity=4.2,
        angle=0.50,
        penumbra=0.7,
        decay=1.4,
        cast_shadow=True,
    )
    scene.add_light_directional(
        "/light/fill", color=(214, 226, 240), intensity=0.5, position=(0.7, -1.0, 0.5)
    )
    scene.add_grid(
        "/ground",
        width=6.0,
        height=6.0,
        cell_size=0.1,
        section_size=0.5,
        cell_color=(196, 200, 206),
        section_color=(176, 181, 188),
        cell_thickness=0.5,
        section_thickness=0.8,
        fade_distance=2.6,
        fade_strength=1.6,
        fade_from="origin",
        shadow_opacity=0.3,
        plane_opacity=0.0,
    )


def _frame(server: ViserServer, rig: RigGeometry) -> None:
    """Aim the first view at the rig."""
    camera, view = server.initial_camera, first_view(rig)
    camera.position = view["position"]
    camera.look_at = view["look_at"]
    camera.up = (0.0, 0.0, 1.0)
    camera.fov = view["fov"]
    camera.near = 0.02
