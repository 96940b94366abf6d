"""How the rig's nodes stand along a motion, for its file; static/scene/pose.js says the same live.

A test holds the two to one another.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from heli2dof_core.signals import Floats

Slot = tuple[str, str]
"""A node and one of its properties."""
State = dict[Slot, Any]
Quaternion = tuple[float, float, float, float]

ROTOR_SCALE = 1.7
"""Propeller speed per volt, rad/(s V): far below the true one, which a screen cannot show."""
_BLUR_VOLTAGE = 5.0
_GHOST_DISTANCE = 0.012
_THRUST_SCALE, _HEAD_LENGTH, _LEAST_VOLTAGE, _AT_LIMIT = 0.0065, 0.026, 0.05, 1e-3
_THRUST, _STOP = (22, 128, 84), (190, 30, 30)
_BODY, _GHOST = "/rig/yoke/body", "/ghost"


@dataclass(frozen=True, slots=True)
class Motion:
    """What is played: N samples at times t (s) of θ, ψ (rad), V_p, V_y (V).

    Attributes:
        reference: of θ and of ψ, rad, a sample each.
        limits: of |V_p|, |V_y|, V, and of |θ|, rad; None where there is none.
    """

    t: Floats
    theta: Floats
    psi: Floats
    V_p: Floats
    V_y: Floats
    reference: tuple[Floats, Floats]
    limits: tuple[float, float, float | None]

    def sampled(self, times: Floats) -> Motion:
        """Return the motion at other times, interpolated linearly and held at its ends."""

        def at(y: Floats) -> Floats:
            return np.interp(times, self.t, y)

        theta, psi = self.reference
        return Motion(
            times,
            at(self.theta),
            at(self.psi),
            at(self.V_p),
            at(self.V_y),
            (at(theta), at(psi)),
            self.limits,
        )


def states(motion: Motion) -> Iterator[State]:
    """Yield how the nodes stand at each sample: quaternions (w, x, y, z), metres, colours.

    With z up and x towards the nose, positive yaw turns clockwise seen from above and positive pitch
    lifts the nose: both turns are negative.
    """
    spins = {"pitch": rotor_angles(motion.t, motion.V_p), "yaw": rotor_angles(motion.t, motion.V_y)}
    V_p, V_y, travel = motion.limits
    for k in range(len(motion.t)):
        theta, psi = float(motion.theta[k]), float(motion.psi[k])
        state: State = {("/rig/yoke", "wxyz"): turn("z", -psi), (_BODY, "wxyz"): turn("y", -theta)}
        state |= _stops(travel)
        state |= _rotor("pitch", "z", float(spins["pitch"][k]), float(motion.V_p[k]), V_p)
        state |= _rotor("yaw", "y", float(spins["yaw"][k]), float(motion.V_y[k]), V_y)
        wanted = float(motion.reference[0][k]), float(motion.reference[1][k])
        yield state | _reference(wanted, theta, psi)


def rotor_angles(t: Floats, V: Floats) -> Floats:
    """Return a propeller's angle (rad) at each time (s): its voltage (V), integrated by trapezoids."""
    return np.concatenate([[0.0], np.cumsum(ROTOR_SCALE * np.diff(t) * (V[1:] + V[:-1]) / 2)])


def turn(axis: Literal["y", "z"], angle: float) -> Quaternion:
    """Return the unit quaternion of a turn by an angle (rad)."""
    c, s = math.cos(angle / 2), math.sin(angle / 2)
    return (c, 0.0, s, 0.0) if axis == "y" else (c, 0.0, 0.0, s)


def _stops(travel: float | None) -> State:
    state: State = {}
    for name, side in (("stop_up", -1), ("stop_down", 1)):
        state["/rig/yoke/" + name, "visible"] = travel is not None
        if travel is not None:
            state["/rig/yoke/" + name, "wxyz"] = turn("y", side * travel)
    return state


def _rotor(name: str, axis: Literal["y", "z"], angle: float, volts: float, limit: float) -> State:
    fast = abs(volts) > _BLUR_VOLTAGE
    state: State = {}
    for part, seen in (("rotor", not fast), ("blur", fast)):
        state[f"{_BODY}/{name}_{part}", "wxyz"] = turn(axis, angle)
        state[f"{_BODY}/{name}_{part}", "visible"] = seen
    for sign in ("positive", "negative"):
        arrow = f"{_BODY}/{name}_thrust_{sign}"
        drawn = abs(volts) > _LEAST_VOLTAGE and (volts > 0) == (sign == "positive")
        state[arrow, "visible"] = drawn
        if drawn:
            state |= _arrow(arrow, abs(volts), limit)
    return state


def _arrow(arrow: str, volts: float, limit: float) -> State:
    full = volts >= limit - _AT_LIMIT
    length = volts * _THRUST_SCALE
    head = min(1.0, length / (1.25 * _HEAD_LENGTH))
    neck = length - head * _HEAD_LENGTH
    color = _STOP if full else _THRUST
    return {
        (f"{arrow}/shaft", "scale"): (1.0, 1.0, max(neck, 1e-4)),
        (f"{arrow}/shaft", "color"): color,
        (f"{arrow}/head", "position"): (0.0, 0.0, neck),
        (f"{arrow}/head", "scale"): (head, head, head),
        (f"{arrow}/head", "color"): color,
        (f"{arrow}/cap", "visible"): full,
        (f"{arrow}/cap", "position"): (0.0, 0.0, neck),
    }


def _reference(reference: tuple[float, float], theta: float, psi: float) -> State:
    away = math.hypot(reference[0] - theta, reference[1] - psi) > _GHOST_DISTANCE
    state: State = {(_GHOST, "visible"): away}
    if away:
        state[f"{_GHOST}/yoke", "wxyz"] = turn("z", -reference[1])
        state[f"{_GHOST}/yoke/body", "wxyz"] = turn("y", -reference[0])
    return state
