"""The loop around the nonlinear rig: its rates, and the modes that limits, clamping and stops put it in.

State y: θ, ψ, θ̇, ψ̇, z_p, z_y (angles absolute, z = ∫ error), and where its size is not PLAIN the rotors' speeds v_p,
v_y and an estimator's states (`actuators`). All that is constant stands in one array `c`, all modes in one array of
integers `m`; the layouts are in `layout`. `k` is the integrator's table of slopes: ẏ, then each motor's λ; row 7 is
scratch. `size` is one of `layout.SIZES`.
"""

from __future__ import annotations

from .actuators import (
    curve_zone,
    inertia,
    inner_rates,
    rotor_speed,
    slip_margin,
    slip_way,
    thrust,
    with_friction,
    zone_margin,
)
from .jit import kernel
from .layout import (
    ALPHA,
    B_P,
    B_Y,
    BACK_CALCULATION,
    BEYOND,
    BREAKAWAY,
    CLAMPING,
    DISTURBANCE,
    GAIN,
    INNER,
    INSIDE,
    J_Y,
    K_PP,
    K_PY,
    K_S,
    K_YP,
    K_YY,
    LIMIT,
    MGL,
    ML2,
    MORE_GAIN,
    MOTOR_OF,
    OFFSET,
    PLAIN,
    REST,
    SIDE,
    SLIDING,
    SLIP,
    TORQUE,
    TRACKING,
    TRAVEL,
    WANTED,
    WINDUP,
    ZONE,
)
from .trigonometry import sine_and_cosine


@kernel
def accelerations(theta, theta_dot, psi_dot, V_p, V_y, c):
    """(θ̈, ψ̈), rad/s² (Eqs. 9–12), with torques from outside; a test holds them to the derivation."""
    sine, cosine = sine_and_cosine(theta)
    sway = c[ML2] * sine * cosine
    pitch = c[K_PP] * V_p + c[K_PY] * V_y - c[B_P] * theta_dot - c[K_S] * theta
    pitch -= sway * psi_dot * psi_dot + c[MGL] * cosine
    pitch += c[TORQUE]
    yaw = c[K_YP] * V_p + c[K_YY] * V_y - c[B_Y] * psi_dot + 2.0 * sway * theta_dot * psi_dot
    yaw += c[TORQUE + 1]
    return pitch / c[ALPHA], yaw / (c[J_Y] + c[ML2] * cosine * cosine)


@kernel
def accelerations_without_friction(y, V0, V1, c, m):
    """The same of the rig with its rotors, when the controller gives the motors V0 and V1."""
    thrust0 = thrust(rotor_speed(y, 0, V0, c), 0, c, m)
    thrust1 = thrust(rotor_speed(y, 1, V1, c), 1, c, m)
    return accelerations(y[0], y[2], y[3], thrust0, thrust1, c)


@kernel
def commanded_voltage(size, y, motor, c):
    """The voltage that the loop asks of a motor, before its limit."""
    row = GAIN + 6 * motor
    u = c[OFFSET + motor]
    for j in range(6):
        u += c[row + j] * y[j]
    if len(size) > PLAIN:
        row = MORE_GAIN + INNER * motor - 6
        for j in range(6, len(size)):
            u += c[row + j] * y[j]
    return u


@kernel
def voltage_rate(size, motor, c, k, row):
    """What its derivative would be by the rates k[row], without those of the integrals."""
    rate = 0.0
    for j in range(4):
        rate += c[GAIN + 6 * motor + j] * k[row, j]
    if len(size) > PLAIN:
        for j in range(6, len(size)):
            rate += c[MORE_GAIN + INNER * motor - 6 + j] * k[row, j]
    return rate


@kernel
def saturated_voltage(u, motor, c, m):
    """What the motor gets of it, by its mode."""
    return u if m[motor] == INSIDE else m[SIDE + motor] * c[LIMIT + motor]


@kernel
def state_derivative(size, y, c, m, k, row):
    """ẏ into k[row]."""
    u0, u1 = commanded_voltage(size, y, 0, c), commanded_voltage(size, y, 1, c)
    v0, v1 = saturated_voltage(u0, 0, c, m), saturated_voltage(u1, 1, c, m)
    if len(size) == PLAIN:
        pitch, yaw = accelerations(y[0], y[2], y[3], v0 + c[DISTURBANCE], v1 + c[DISTURBANCE + 1], c)
    else:
        pitch, yaw = accelerations_without_friction(y, v0, v1, c, m)
        pitch, yaw = with_friction(0, pitch, y[0], c, m), with_friction(1, yaw, y[0], c, m)
        inner_rates(size, y, v0, v1, c, k, row)
    theta_dot = y[2]
    if m[REST] != 0:
        theta_dot = pitch = 0.0
    k[row, 0], k[row, 1], k[row, 2], k[row, 3] = theta_dot, y[3], pitch, yaw
    e0, e1 = c[WANTED] - y[0], c[WANTED + 1] - y[1]
    if m[WINDUP] == CLAMPING and (m[0] != INSIDE or m[1] != INSIDE):
        clamped_integrators(size, e0, e1, c, m, k, row)
        return
    if m[WINDUP] == BACK_CALCULATION:
        cut0, cut1 = v0 - u0, v1 - u1
        e0 += c[TRACKING] * cut0 + c[TRACKING + 1] * cut1
        e1 += c[TRACKING + 2] * cut0 + c[TRACKING + 3] * cut1
    k[row, 4], k[row, 5] = e0, e1


@kernel
def clamped_integrators(size, e0, e1, c, m, k, row):
    """Rates of the integrals under clamping: on, off, or sliding.

    An integrator pushes if it drives its motor farther beyond its limit; beyond, what pushes stands
    still. Where it would come back at once if it stood still, but leave again if it went on, the
    voltage slides along its limit: the share λ of the error is integrated that keeps u̇ = 0 (Filippov).
    """
    a, b = m[MOTOR_OF], m[MOTOR_OF + 1]
    pushes0 = m[a] != INSIDE and c[GAIN + 6 * a + 4] * e0 * m[SIDE + a] > 0.0
    pushes1 = m[b] != INSIDE and c[GAIN + 6 * b + 5] * e1 * m[SIDE + b] > 0.0
    share0 = 0.0 if m[0] == BEYOND else 1.0
    share1 = 0.0 if m[1] == BEYOND else 1.0
    if m[0] == SLIDING or m[1] == SLIDING:
        # u̇_i = k_i + Σ_j λ_j s_ij is 0 on each sliding motor; s_ij sums the integrators that push motor j
        k0, k1 = voltage_rate(size, 0, c, k, row), voltage_rate(size, 1, c, k, row)
        s00 = s01 = s10 = s11 = 0.0
        for i in range(2):
            e, pushes, motor = (e0, pushes0, a) if i == 0 else (e1, pushes1, b)
            f0, f1 = c[GAIN + 4 + i] * e, c[GAIN + 10 + i] * e
            if not pushes:
                k0 += f0
                k1 += f1
            elif motor == 0:
                s00 += f0
                s10 += f1
            else:
                s01 += f0
                s11 += f1
        if m[0] == SLIDING and m[1] == SLIDING:
            det = s00 * s11 - s01 * s10
            share0 = (k1 * s01 - k0 * s11) / det if det != 0.0 else 2.0
            share1 = (k0 * s10 - k1 * s00) / det if det != 0.0 else 2.0
        elif m[0] == SLIDING:
            share0 = -(k0 + share1 * s01) / s00 if s00 != 0.0 else 2.0
        else:
            share1 = -(k1 + share0 * s10) / s11 if s11 != 0.0 else 2.0
    k[row, len(size)], k[row, len(size) + 1] = share0, share1
    if pushes0:
        e0 *= share0 if a == 0 else share1
    if pushes1:
        e1 *= share0 if b == 0 else share1
    k[row, 4], k[row, 5] = e0, e1


@kernel
def event_functions(size, y, c, m, k, g):
    """Functions that stay positive while the modes hold, into g; which one does not, or −1.

    Two per motor (its distance from the limit; sliding: λ and 1 − λ) and one for the pitch stop (the
    way left; resting: the torque that presses); then one per motor for the part of its thrust curve, and one per axis
    for its friction.
    """
    u0, u1 = commanded_voltage(size, y, 0, c), commanded_voltage(size, y, 1, c)
    if m[0] == SLIDING or m[1] == SLIDING:
        state_derivative(size, y, c, m, k, 7)
    for motor in range(2):
        limit = c[LIMIT + motor]
        u = u0 if motor == 0 else u1
        g[2 * motor + 1] = 1.0
        if m[motor] == SLIDING:
            share = k[7, len(size) + motor]
            g[2 * motor], g[2 * motor + 1] = share, 1.0 - share
        elif m[motor] == INSIDE:
            g[2 * motor] = 1.0 - abs(u) / limit
        else:
            g[2 * motor] = m[SIDE + motor] * u / limit - 1.0
    v0, v1 = saturated_voltage(u0, 0, c, m), saturated_voltage(u1, 1, c, m)
    count = 5
    if len(size) == PLAIN:
        if m[REST] != 0:
            pitch, _ = accelerations(y[0], 0.0, y[3], v0 + c[DISTURBANCE], v1 + c[DISTURBANCE + 1], c)
            g[4] = m[REST] * pitch
    else:
        count = 9
        pitch, yaw = accelerations_without_friction(y, v0, v1, c, m)
        g[4] = m[REST] * pitch + c[BREAKAWAY] / inertia(0, y[0], c)
        g[5] = zone_margin(rotor_speed(y, 0, v0, c), 0, c, m)
        g[6] = zone_margin(rotor_speed(y, 1, v1, c), 1, c, m)
        g[7] = slip_margin(0, y[2], pitch, y[0], c, m)
        g[8] = slip_margin(1, y[3], yaw, y[0], c, m)
    if m[REST] == 0:
        g[4] = c[TRAVEL] - abs(y[0])
    low = 0
    for j in range(1, count):
        if g[j] < g[low]:
            low = j
    return low if g[low] < -1e-13 else -1


@kernel
def initial_modes(size, y, c, m):
    """All modes afresh but that of the pitch stop."""
    saturation_modes(size, y, c, m)
    if len(size) > PLAIN:
        for axis in range(2):
            find_slip(size, axis, y, c, m)


@kernel
def saturation_modes(size, y, c, m):
    """The motors' modes afresh, at the start and after a jump of the state."""
    for motor in range(2):
        u = commanded_voltage(size, y, motor, c)
        m[SIDE + motor] = 1 if u > 0.0 else -1
        m[motor] = BEYOND if abs(u) > c[LIMIT + motor] else INSIDE
        if len(size) > PLAIN:
            find_zone(size, motor, y, c, m)


@kernel
def find_zone(size, motor, y, c, m):
    """The part of its thrust curve that a motor is on, by its mode and the state."""
    voltage = saturated_voltage(commanded_voltage(size, y, motor, c), motor, c, m)
    m[ZONE + motor] = curve_zone(rotor_speed(y, motor, voltage, c), motor, c)


@kernel
def find_slip(size, axis, y, c, m):
    """Which way an axis slips or that it is stuck, by the other modes and the state."""
    v0 = saturated_voltage(commanded_voltage(size, y, 0, c), 0, c, m)
    v1 = saturated_voltage(commanded_voltage(size, y, 1, c), 1, c, m)
    pitch, yaw = accelerations_without_friction(y, v0, v1, c, m)
    m[SLIP + axis] = slip_way(axis, y[2 + axis], pitch if axis == 0 else yaw, y[0], c)


@kernel
def meet_stop(size, y, c, m, k, g):
    """Pitch is at a stop: its rate is gone, and it rests there while the torque presses."""
    m[REST] = 1 if y[0] > 0.0 else -1
    y[0], y[2] = m[REST] * c[TRAVEL], 0.0
    saturation_modes(size, y, c, m)
    event_functions(size, y, c, m, k, g)
    if g[4] <= 0.0:
        leave_stop(size, y, m)


@kernel
def leave_stop(size, y, m):
    """The torque has turned; just inside, so that the next impact is seen."""
    if len(size) > PLAIN:
        m[SLIP] = -m[REST]
    m[REST] = 0
    y[0] *= 1.0 - 1e-12


@kernel
def switch_mode(size, which, y, c, m, k, g):
    """The modes after the function `which` of `event_functions` has turned negative."""
    motor = which // 2
    if which > 6:
        if m[SLIP + which - 7] != 0:
            y[which - 5] = 0.0
        find_slip(size, which - 7, y, c, m)
    elif which > 4:
        find_zone(size, which - 5, y, c, m)
    elif which == 4:
        if m[REST] == 0:
            meet_stop(size, y, c, m, k, g)
        else:
            leave_stop(size, y, m)
    elif m[motor] == INSIDE:
        m[SIDE + motor] = 1 if commanded_voltage(size, y, motor, c) > 0.0 else -1
        m[motor] = BEYOND
        if m[WINDUP] == CLAMPING:
            state_derivative(size, y, c, m, k, 7)
            rise = 0.0
            for j in range(6):
                rise += c[GAIN + 6 * motor + j] * k[7, j]
            if len(size) > PLAIN:
                for j in range(6, len(size)):
                    rise += c[MORE_GAIN + INNER * motor - 6 + j] * k[7, j]
            if rise * m[SIDE + motor] < 0.0:
                m[motor] = SLIDING
    elif m[motor] == SLIDING:
        m[motor] = BEYOND if which % 2 == 0 else INSIDE
    else:
        m[motor] = INSIDE
        if m[WINDUP] == CLAMPING:
            m[motor] = SLIDING
            state_derivative(size, y, c, m, k, 7)
            if not k[7, len(size) + motor] < 1.0:
                m[motor] = INSIDE
