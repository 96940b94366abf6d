"""Rotors and friction of a recorded rig, as numbers that a simulation takes."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

from ..errors import InvalidInputError
from ..parameters import Parameters
from ..plant import plant
from ..rotors import AxisFriction, Rotor, Rotors, actuators
from ..signals import AXES, Floats

DEAD, SQUARE, COULOMB, BREAKAWAY = 2, 4, 6, 8
"""Where in `rotors.Actuators.constants` they begin; the time constants stand first."""


def acting_of(
    p: Parameters,
    rotors: Rotors,
    friction: AxisFriction,
    theta_0: float = 0.0,
    limits: tuple[float, float] | None = None,
) -> Floats | None:
    """The numbers (10,) of `rotors.Actuators.constants`; None where all is as in the paper's model.

    Args:
        p: the rig as it is thought to be; its trim matches a quadratic curve that says nothing else.
        rotors: of it.
        friction: of its axes.
        theta_0: operating point, rad.
        limits: of both voltages, V, for a motor that rests at the trim.

    Raises:
        InvalidInputError: a curve cannot be matched.
    """
    if all(rotor.plain for rotor in rotors.both) and not any(own.breakaway for own in friction.both):
        return None
    own = plant(p, theta_0)
    if limits is None:
        for rotor, volts, axis in zip(rotors.both, own.trim.tolist(), AXES, strict=True):
            if rotor.curve == "quadratic" and rotor.matched_at is None and not abs(volts) > rotor.dead_zone:
                raise InvalidInputError(
                    f"nothing says where the {axis} motor's quadratic curve is matched: it rests at the trim",
                    field=f"rotors.{axis}.matched_at",
                    hint="Say at which voltage it meets the linear one, or give the motors' limits.",
                )
    return actuators(own, rotors, friction, (0.0, 0.0) if limits is None else limits).constants


def matched(rotors: Rotors, acting: Floats) -> Rotors:
    """The rotors with the point written down where their curves are matched: another trim would move it."""

    def one(rotor: Rotor, i: int) -> Rotor:
        if rotor.curve == "linear" or rotor.matched_at is not None:
            return rotor
        s, v_d = float(acting[SQUARE + i]), rotor.dead_zone  # s (v_m − v_d)² = v_m
        return replace(rotor, matched_at=v_d + (1.0 + sqrt(1.0 + 4.0 * s * v_d)) / (2.0 * s))

    return Rotors(one(rotors.pitch, 0), one(rotors.yaw, 1))
