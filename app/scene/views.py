"""Where a rig is first looked at from, and what the page's cameras need to know of it."""

from __future__ import annotations

from typing import TypedDict

from fastapi import APIRouter
from fastapi.responses import JSONResponse

from heli2dof_core.geometry import RIG_NAMES, RigGeometry, geometry

_Point = tuple[float, float, float]
_NUMERALS = 0.085
"""Metres that the numbers of a scale take beyond the scale."""


class View(TypedDict):
    """A camera's pose in metres, z up, and its vertical angle of view in radians."""

    position: _Point
    look_at: _Point
    fov: float


class Arms(TypedDict):
    """Of the rotors, metres: where along the body they are, or how far from its axis."""

    pitch: float
    yaw: float


class RigView(TypedDict):
    """What the page's cameras and hands need, in metres.

    `outer` is the largest distance from the mast; `arms` are from the pitch axle, the yaw rotor's behind it;
    `offsets` are upwards for the pitch rotor and to the left for the yaw rotor; `guard` and `wall` are the
    radius and the height of a rotor's guard.
    """

    pivot_height: float
    reach: float
    outer: float
    arms: Arms
    offsets: Arms
    guard: float
    wall: float
    view: View


def first_view(rig: RigGeometry) -> View:
    """Return the view in which the rig fills a small window and does not leave it."""
    distance = 0.98 + 0.98 * rig.reach
    return {
        "position": (0.36 * distance, -0.94 * distance, rig.pivot_height + 0.40 * distance),
        "look_at": (-0.015, -0.01, 0.11 + 0.30 * rig.pivot_height),
        "fov": 0.62,
    }


def rig_view(rig: RigGeometry) -> RigView:
    """Return what the page's cameras need to know of a rig."""
    return {
        "pivot_height": rig.pivot_height,
        "reach": rig.reach,
        "outer": rig.reach + _NUMERALS,
        "arms": {"pitch": rig.pitch_rotor.distance, "yaw": rig.yaw_rotor.distance},
        "offsets": {"pitch": rig.pitch_rotor.offset, "yaw": rig.yaw_rotor.offset},
        "guard": max(rig.pitch_rotor.guard_radius, rig.yaw_rotor.guard_radius),
        "wall": max(rig.pitch_rotor.guard_height, rig.yaw_rotor.guard_height),
        "view": first_view(rig),
    }


def build_views_router() -> APIRouter:
    """Return the route that tells every rig's view."""
    router = APIRouter(prefix="/scene", include_in_schema=False)
    views = {name: rig_view(geometry(name)) for name in RIG_NAMES}

    @router.get("/rigs")
    async def rigs() -> JSONResponse:
        return JSONResponse(views, headers={"Cache-Control": "no-cache"})

    return router
