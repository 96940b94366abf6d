"""The rig as nodes of a viser server. Imported only when the first session is made: viser is slow.

Nodes that the page moves: /rig/yoke (ψ), /rig/yoke/body (θ), its pitch_rotor and yaw_rotor (spin),
/ghost/yoke and /ghost/yoke/body (the reference). static/scene_pose.js names the same nodes.
"""

from __future__ import annotations

import functools
import logging

import rich
from viser import GlbHandle, ViserServer

from heli2dof_core.geometry import RigGeometry, RigName, geometry

from . import machine
from .glb import glb

LOOPBACK = "127.0.0.1"
Point = tuple[float, float, float]
ORIGIN: Point = (0.0, 0.0, 0.0)

# viser prints a table of addresses per server, to standard output, whatever `verbose` says.
rich.reconfigure(quiet=True)


class RigServer(ViserServer):
    """A viser server that shows one rig, on a free port of the loopback interface."""

    def __init__(self, rig: RigName) -> None:
        super().__init__(host=LOOPBACK, port=0, verbose=False)
        self.gui.configure_theme(show_logo=False, show_share_button=False)
        self.show(rig)

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Refuse: any visitor may ask, and the tunnel would publish the session."""
        return None

    def disconnect_share_url(self) -> None:
        """Do nothing: there never is a tunnel."""

    def stop(self) -> None:
        """Stop, and take back what viser hangs into the logger of its sockets, one filter a server."""
        super().stop()
        logger = logging.getLogger("websockets.server")
        for extra in [f for f in logger.filters if type(f).__module__.startswith("viser.")][:-1]:
            logger.removeFilter(extra)

    def show(self, rig: RigName) -> None:
        """Replace all nodes by those of the named rig, in one atomic change."""
        with self.atomic():
            self.scene.reset()
            _build(self, geometry(rig))


@functools.cache
def _files(rig: RigName) -> dict[str, bytes]:
    """Return the rig's moving parts as binary glTF, made once and shared by all sessions."""
    shape = geometry(rig)
    pitch, yaw = shape.pitch_rotor, shape.yaw_rotor
    parts = {
        "base": machine.base_parts(shape),
        "mast": machine.mast_parts(shape),
        "scale": machine.scale_parts(shape),
        "yoke": machine.yoke_parts(shape),
        "body": machine.body_parts(shape),
        "pitch_rotor": machine.rotor_parts(pitch, machine.PITCH_COLOR),
        "yaw_rotor": machine.rotor_parts(yaw, machine.YAW_COLOR),
        "pitch_blur": machine.blur_parts(pitch, machine.PITCH_COLOR),
        "yaw_blur": machine.blur_parts(yaw, machine.YAW_COLOR),
        "ghost_yoke": machine.ghost_yoke_parts(shape),
        "ghost_body": machine.ghost_body_parts(shape),
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
    part("/rig/scale", "scale", solid=False)
    scene.add_frame("/rig/yoke", show_axes=False)
    part("/rig/yoke/shape", "yoke")
    scene.add_frame("/rig/yoke/body", show_axes=False, position=pivot)
    part("/rig/yoke/body/shape", "body")
    for name, rotor in (("pitch", rig.pitch_rotor), ("yaw", rig.yaw_rotor)):
        node, hub = f"/rig/yoke/body/{name}", machine.hub_position(rotor)
        part(f"{node}_rotor", f"{name}_rotor", at=hub)
        part(f"{node}_blur", f"{name}_blur", at=hub, solid=False).visible = False

    # The page shows the ghost where the reference differs from the pose.
    scene.add_frame("/ghost", show_axes=False, visible=False)
    scene.add_frame("/ghost/yoke", show_axes=False)
    part("/ghost/yoke/shape", "ghost_yoke", solid=False)
    scene.add_frame("/ghost/yoke/body", show_axes=False, position=pivot)
    part("/ghost/yoke/body/shape", "ghost_body", solid=False)

    _light(server, rig)
    _frame(server, rig)


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
    """Aim the first view at the rig so that it fills a small window and does not leave it."""
    camera = server.initial_camera
    distance = 0.72 + 1.10 * rig.reach
    camera.position = (0.42 * distance, -0.96 * distance, rig.pivot_height + 0.28 * distance)
    camera.look_at = (0.01, -0.01, 0.57 * rig.pivot_height)
    camera.up = (0.0, 0.0, 1.0)
    camera.fov = 0.62
    camera.near = 0.02
