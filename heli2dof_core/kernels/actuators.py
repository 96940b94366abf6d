"""Rotors that take time, thrust that curves, friction that holds, and an estimator: what the paper's rig is without.

Rotor j turns as τ_j v̇_j = V_j − v_j with V_j what the motor has, and thrusts K φ(v_j), where φ(v) is v, or
s·sign(v)·max(|v| − v_d, 0)². Coulomb friction F_c acts against an axis' motion; at rate 0 the axis is stuck while the
rest of the torque is at most F_s. The curve's part and the way of each axis are modes in `m` (ZONE, SLIP): within a
mode all is smooth.
"""

from __future__ import annotations

from math import inf

from .jit import kernel
from .layout import (
    ALPHA,
    BREAKAWAY,
    COULOMB,
    DEAD,
    DISTURBANCE,
    ESTIMATOR,
    FULL,
    J_Y,
    ML2,
    REST,
    SLIP,
    SQUARE,
    TAU,
    ZONE,
)
from .trigonometry import sine_and_cosine


@kernel
def rotor_speed(y, motor, voltage, c):
    """The speed of a motor that has got this voltage from the controller, V: a state, or the voltage at once."""
    return y[6 + motor] if c[TAU + motor] > 0.0 else voltage + c[DISTURBANCE + motor]


@kernel
def thrust(v, motor, c, m):
    """φ(v), V, on the part of its curve that the mode says."""
    return thrust_on(v, m[ZONE + motor], motor, c)


@kernel
def thrust_on(v, zone, motor, c):
    """φ(v), V, on this part of its curve: −1, 0 (the dead zone) or 1."""
    if c[SQUARE + motor] == 0.0:
        return v
    beyond = v - zone * c[DEAD + motor]
    return zone * c[SQUARE + motor] * beyond * beyond


@kernel
def thrust_slope(v, zone, motor, c):
    """φ′(v), likewise."""
    if c[SQUARE + motor] == 0.0:
        return 1.0
    return zone * 2.0 * c[SQUARE + motor] * (v - zone * c[DEAD + motor])


@kernel
def curve_zone(v, motor, c):
    """The part of the thrust curve at v: −1, 0 (the dead zone) or 1."""
    if abs(v) <= c[DEAD + motor] and c[DEAD + motor] > 0.0:
        return 0
    return 1 if v >= 0.0 else -1


@kernel
def zone_margin(v, motor, c, m):
    """How far, V, v lies within its part of the curve; infinite where that is straight."""
    if c[SQUARE + motor] == 0.0:
        return inf
    if m[ZONE + motor] == 0:
        return c[DEAD + motor] - abs(v)
    return m[ZONE + motor] * v - c[DEAD + motor]


@kernel
def inertia(axis, theta, c):
    """About an axis, kg·m²."""
    if axis == 0:
        return c[ALPHA]
    _, cosine = sine_and_cosine(theta)
    return c[J_Y] + c[ML2] * cosine * cosine


@kernel
def with_friction(axis, acceleration, theta, c, m):
    """The acceleration, rad/s², of an axis that would have this one without friction."""
    if m[SLIP + axis] == 0:
        return 0.0
    return acceleration - m[SLIP + axis] * c[COULOMB + axis] / inertia(axis, theta, c)


@kernel
def slip_margin(axis, rate, acceleration, theta, c, m):
    """Positive while an axis goes on to slip its way, or to be stuck; `acceleration` is without friction."""
    if c[BREAKAWAY + axis] == 0.0 or (axis == 0 and m[REST] != 0):
        return inf
    if m[SLIP + axis] != 0:
        return m[SLIP + axis] * rate
    return 1.0 - abs(acceleration) * inertia(axis, theta, c) / c[BREAKAWAY + axis]


@kernel
def slip_way(axis, rate, acceleration, theta, c):
    """Which way an axis slips: with its rate, or with the torque where that is 0; 0 where it is stuck."""
    if c[BREAKAWAY + axis] == 0.0:
        return 1
    if rate != 0.0:
        return 1 if rate > 0.0 else -1
    if abs(acceleration) * inertia(axis, theta, c) <= c[BREAKAWAY + axis]:
        return 0
    return 1 if acceleration > 0.0 else -1


@kernel
def inner_rates(size, y, V0, V1, c, k, row):
    """Rates of the states behind the sixth into k[row], when the controller gives the motors V0 and V1."""
    for motor in range(2):
        tau = c[TAU + motor]
        has = (V0 if motor == 0 else V1) + c[DISTURBANCE + motor]
        k[row, 6 + motor] = (has - y[6 + motor]) / tau if tau > 0.0 else 0.0
    if len(size) == FULL:
        for i in range(FULL - 8):
            at = ESTIMATOR + (FULL + 3) * i
            rate = c[at + FULL + 2] + c[at + FULL] * V0 + c[at + FULL + 1] * V1
            for j in range(FULL):
                rate += c[at + j] * y[j]
            k[row, 8 + i] = rate
