"""The recorded rig with rotors and friction: under held voltages, with exact sensitivities.

Between two samples a rotor's speed is v(s) = V + (v_k − V) e^(−s/τ), known with its derivative by τ, so that only the
axes are integrated, by the steps of `recorded`. Coulomb friction turns round where a rate passes 0: there the step
is cut, and the rate's derivatives jump by the ratio of the accelerations behind and before, 0 where the axis sticks
("saltation": di Bernardo et al., Piecewise-smooth Dynamical Systems, 2008, section 2.5). The two axes' accelerations
do not depend on one another, so that nothing else jumps.
"""

from __future__ import annotations

from math import ceil, cos, exp, sin

from . import examples
from .actuators import curve_zone, inertia, thrust_on, thrust_slope
from .digital import stop_at_travel
from .jit import copy_into, entry_point, kernel
from .layout import (
    ACTUATED_SENSITIVITIES,
    ACTUATED_WORKSPACE,
    ALPHA,
    BREAKAWAY,
    COULOMB,
    K_PP,
    K_PY,
    K_YP,
    K_YY,
    ML2,
    TAU,
)
from .recorded import begin_sensitivities, bound_travel, variational_equations

NONE = 2.0
"""In place of an axis' direction (±1, 0 at rest): nothing rubs."""
_MOST_EVENTS = 16
_MOST_TRIALS = 60
_NEAR = 1e-12


@entry_point(
    lambda: (
        examples.bounds(),
        examples.times(),
        examples.given(2, 2),
        examples.more_constants(),
        examples.zeros(2, 2),
        examples.zeros(2, 2),
    )
)
def run_rotors(bounds, t, volts, c, speeds, slopes):
    """Rotor speeds at all samples, V, and their derivatives by their own τ, V/s; both (n, 2), filled.

    In each stretch of the recording, bounds[i, 0] ≤ k < bounds[i, 1], they begin settled at its first voltages.
    """
    for i in range(len(bounds)):
        first, last = bounds[i, 0], bounds[i, 1]
        for motor in range(2):
            v, by_tau, tau = volts[first, motor], 0.0, c[TAU + motor]
            for k in range(first, last):
                if tau == 0.0:
                    v = volts[k, motor]
                speeds[k, motor], slopes[k, motor] = v, by_tau
                if k + 1 < last and tau > 0.0:
                    h, away = t[k + 1] - t[k], v - volts[k, motor]
                    decay = exp(-h / tau)
                    by_tau = decay * (by_tau + away * h / (tau * tau))
                    v = volts[k, motor] + away * decay


@entry_point(
    lambda: (
        examples.given(1, 4),
        examples.bounds(),
        examples.times(),
        examples.given(2, 2),
        examples.given(2, 2),
        examples.given(2, 2),
        examples.more_constants(),
        1e-2,
        examples.zeros(*ACTUATED_WORKSPACE),
        examples.zeros(2, 2),
        examples.zeros(2, 2, ACTUATED_SENSITIVITIES),
    )
)
def run_actuated_segments(starts, bounds, t, volts, speeds, by_tau, c, longest_step, w, outputs, slopes):
    """As `recorded.run_segments`, with rotors and friction; speeds and their derivatives are `run_rotors`'.

    `slopes` (n, 2, ACTUATED_SENSITIVITIES) go on with the derivatives by τ_p, τ_y, and by both F_c.
    """
    rows = ACTUATED_SENSITIVITIES + 1
    state = w[0]
    for i in range(len(starts)):
        first, last = bounds[i, 0], bounds[i, 1]
        begin_sensitivities(starts[i], rows, state)
        for k in range(first, last):
            for axis in range(2):
                outputs[k, axis] = state[0, axis]
                for row in range(ACTUATED_SENSITIVITIES):
                    slopes[k, axis, row] = state[row + 1, axis]
            if k + 1 < last:
                steps = max(1, ceil((t[k + 1] - t[k]) / longest_step))
                h = (t[k + 1] - t[k]) / steps
                for part in range(steps):
                    advance(part * h, h, volts[k], speeds[k], by_tau[k], c, rows, True, w)


@entry_point(
    lambda: (
        examples.zeros(4),
        examples.times(),
        examples.given(2, 2),
        examples.given(2, 2),
        examples.more_constants(),
        1e-2,
        examples.zeros(*ACTUATED_WORKSPACE),
        examples.zeros(2, 4),
    )
)
def run_actuated_held(start, t, volts, speeds, c, longest_step, w, states):
    """As `recorded.run_held`, with rotors and friction; `speeds` are those of `run_rotors`."""
    state = w[0]
    rubs = c[BREAKAWAY] > 0.0 or c[BREAKAWAY + 1] > 0.0
    copy_into(start, state[0])
    stop_at_travel(state[0], c)
    for k in range(len(t)):
        copy_into(state[0], states[k])
        if k + 1 < len(t):
            steps = max(1, ceil((t[k + 1] - t[k]) / longest_step))
            h = (t[k + 1] - t[k]) / steps
            for part in range(steps):
                advance(part * h, h, volts[k], speeds[k], speeds[k], c, 1, rubs, w)
                bound_travel(state[0], c)


@kernel
def advance(since, h, V, v, by_tau, c, rows, rubs, w):
    """A step from `since` s behind the sample, cut wherever an axis comes to rest or breaks away."""
    state, slope, kept, drive = w[0], w[2], w[4], w[5]
    direction = w[5, 3]
    left = h
    for _ in range(_MOST_EVENTS):
        begin = since + h - left
        direction[0] = direction[1] = NONE
        if rubs:
            thrust(begin, V, v, by_tau, c, drive[0])
            variational_equations(state, drive[0, 0], drive[0, 1], c, 1, slope)
            for axis in range(2):
                direction[axis] = direction_of(axis, state, slope, c)
        for row in range(rows):
            copy_into(state[row], kept[row])
        step(begin, left, V, v, by_tau, c, rows, w)
        if not rubs:
            return
        earliest, which = 2.0 * left, -1
        for axis in range(2):
            if past(axis, begin + left, V, v, by_tau, c, w) > 0.0:
                at = left if which < 0 else earliest
                own = locate(axis, begin, at, V, v, by_tau, c, w)
                if own < earliest:
                    earliest, which = own, axis
                copy_into(kept[0], state[0])
                step(begin, left, V, v, by_tau, c, 1, w)
        if which < 0:
            return
        for row in range(rows):
            copy_into(kept[row], state[row])
        step(begin, earliest, V, v, by_tau, c, rows, w)
        meet(which, begin, earliest, V, v, by_tau, c, rows, w)
        left -= earliest
        if left <= _NEAR * h:
            return
    direction[0] = direction[1] = NONE
    step(since + h - left, left, V, v, by_tau, c, rows, w)


@kernel
def thrust(since, V, v, by_tau, c, out):
    """φ of both rotors `since` s behind the sample, V, and its derivatives by their τ, V/s, into out[0:4]."""
    for motor in range(2):
        tau, speed, slope = c[TAU + motor], V[motor], 0.0
        if tau > 0.0:
            decay, away = exp(-since / tau), v[motor] - V[motor]
            speed = V[motor] + away * decay
            slope = decay * (by_tau[motor] + away * since / (tau * tau))
        zone = curve_zone(speed, motor, c)
        out[motor], out[2 + motor] = (
            thrust_on(speed, zone, motor, c),
            slope * thrust_slope(speed, zone, motor, c),
        )


@kernel
def direction_of(axis, state, slope, c):
    """Which way an axis slips, ±1, or 0 where it sticks; `slope` are its rates without friction."""
    rate = state[0, 2 + axis]
    if rate != 0.0:
        return 1.0 if rate > 0.0 else -1.0
    torque = inertia(axis, state[0, 0], c) * slope[0, 2 + axis]
    if abs(torque) <= c[BREAKAWAY + axis]:
        return 0.0
    return 1.0 if torque > 0.0 else -1.0


@kernel
def step(begin, h, V, v, by_tau, c, rows, w):
    """One step of the classical Runge–Kutta method, the axes' directions unchanged."""
    state, stage, slope, total, drive = w[0], w[1], w[2], w[3], w[5]
    for node in range(3):
        thrust(begin + 0.5 * h * node, V, v, by_tau, c, drive[node])
    rates(state, drive[0], w[5, 3], c, rows, slope)
    for row in range(rows):
        for j in range(4):
            total[row, j] = slope[row, j]
            stage[row, j] = state[row, j] + 0.5 * h * slope[row, j]
    for part in range(2):
        rates(stage, drive[1], w[5, 3], c, rows, slope)
        share = 0.5 * h if part == 0 else h
        for row in range(rows):
            for j in range(4):
                total[row, j] += 2.0 * slope[row, j]
                stage[row, j] = state[row, j] + share * slope[row, j]
    rates(stage, drive[2], w[5, 3], c, rows, slope)
    for row in range(rows):
        for j in range(4):
            state[row, j] += h / 6.0 * (total[row, j] + slope[row, j])


@kernel
def rates(x, drive, direction, c, rows, out):
    """Rates of the state and of its derivatives, with thrusts φ and friction in these directions."""
    variational_equations(x, drive[0], drive[1], c, rows, out)
    alpha, beta = c[ALPHA], inertia(1, x[0, 0], c)
    if rows > 1:
        out[12, 2] += c[K_PP] * drive[2] / alpha
        out[12, 3] += c[K_YP] * drive[2] / beta
        out[13, 2] += c[K_PY] * drive[3] / alpha
        out[13, 3] += c[K_YY] * drive[3] / beta
    for axis in range(2):
        side = direction[axis]
        if side == NONE:
            continue
        if side == 0.0:
            for row in range(rows):
                out[row, 2 + axis] = 0.0
            continue
        own = alpha if axis == 0 else beta
        against = -side * c[COULOMB + axis] / own
        out[0, 2 + axis] += against
        if rows > 1:
            out[14 + axis, 2 + axis] -= side / own
            if axis == 1:  # β changes with pitch
                by_theta = 2.0 * c[ML2] * sin(x[0, 0]) * cos(x[0, 0]) * against / beta
                for row in range(1, rows):
                    out[row, 3] += by_theta * x[row, 0]


@kernel
def past(axis, at, V, v, by_tau, c, w):
    """How far a slipping axis' rate is beyond 0, or a resting axis' torque beyond F_s; up to 0: not there."""
    state, slope, drive = w[0], w[2], w[5]
    side = w[5, 3, axis]
    if side != 0.0:
        return -side * state[0, 2 + axis]
    thrust(at, V, v, by_tau, c, drive[0])
    variational_equations(state, drive[0, 0], drive[0, 1], c, 1, slope)
    return abs(inertia(axis, state[0, 0], c) * slope[0, 2 + axis]) - c[BREAKAWAY + axis]


@kernel
def locate(axis, begin, h, V, v, by_tau, c, w):
    """When that comes to pass first, s behind `begin`, at most `h`: regula falsi (Illinois) on steps of one row.

    The end of the bracket that is past it is returned, so that the axis is found there beyond 0 or F_s.
    """
    state, kept = w[0], w[4]
    low, high, at_low, at_high = 0.0, h, 0.0, 0.0
    for end in range(2):
        copy_into(kept[0], state[0])
        if end == 1:
            step(begin, h, V, v, by_tau, c, 1, w)
            at_high = past(axis, begin + h, V, v, by_tau, c, w)
        else:
            at_low = past(axis, begin, V, v, by_tau, c, w)
    if at_high <= 0.0 or at_low > 0.0:
        return h
    last = 0
    for _ in range(_MOST_TRIALS):
        if high - low <= _NEAR * h:
            break
        at = high - (high - low) * at_high / (at_high - at_low) if at_high > at_low else 0.5 * (low + high)
        if at <= low or at >= high:
            at = 0.5 * (low + high)
        copy_into(kept[0], state[0])
        step(begin, at, V, v, by_tau, c, 1, w)
        value = past(axis, begin + at, V, v, by_tau, c, w)
        if value > 0.0:
            high, at_high = at, value
            if last == 1:
                at_low *= 0.5
            last = 1
        else:
            low, at_low = at, value
            if last == -1:
                at_high *= 0.5
            last = -1
    return high


@kernel
def meet(axis, begin, h, V, v, by_tau, c, rows, w):
    """The axis turns round, comes to rest, or breaks away: what its rate's derivatives are afterwards."""
    state, slope, kept, drive = w[0], w[2], w[4], w[5]
    side, own = w[5, 3, axis], inertia(axis, state[0, 0], c)
    thrust(begin + h, V, v, by_tau, c, drive[0])
    if side != 0.0:
        variational_equations(state, drive[0, 0], drive[0, 1], c, 1, slope)
        free, against = slope[0, 2 + axis], side * c[COULOMB + axis] / own
        ratio = 0.0
        if abs(free) * own > c[BREAKAWAY + axis]:
            ratio = (free + against) / (free - against)
        for row in range(1, rows):
            state[row, 2 + axis] *= ratio
        state[0, 2 + axis] = 0.0
        return
    jump = (c[BREAKAWAY + axis] - c[COULOMB + axis]) / own
    if rows == 1 or jump <= 0.0:
        return
    # The moment t* shifts by −δT/Ṫ, and what acts from then on, by ∓(F_s − F_c) t* in rate
    w[5, 3, axis] = NONE
    rates(state, drive[0], w[5, 3], c, rows, slope)
    torque = own * slope[0, 2 + axis]
    if torque < 0.0:
        jump = -jump
    turn = -2.0 * c[ML2] * sin(state[0, 0]) * cos(state[0, 0]) if axis == 1 else 0.0
    for row in range(1, rows):
        kept[row, 0] = own * slope[row, 2 + axis] + turn * slope[0, 3] * state[row, 0]
    w[5, 3, axis] = 0.0
    grows = torque_rate(axis, state, begin + h, V, v, by_tau, c, w)
    if grows * jump > 0.0:
        for row in range(1, rows):
            state[row, 2 + axis] += jump * kept[row, 0] / grows


@kernel
def torque_rate(axis, state, at, V, v, by_tau, c, w):
    """Ṫ of an axis at rest, N·m/s: by its own motion's direction, a small difference to either side."""
    stage, slope, drive = w[1], w[2], w[5]
    thrust(at, V, v, by_tau, c, drive[0])
    rates(state, drive[0], w[5, 3], c, 1, slope)
    copy_into(slope[0], w[3, 0])
    values = 0.0
    small = 1e-5
    for end in range(2):
        sign = 1.0 if end == 1 else -1.0
        for j in range(4):
            stage[0, j] = state[0, j] + sign * small * w[3, 0, j]
        thrust(at + sign * small, V, v, by_tau, c, drive[0])
        variational_equations(stage, drive[0, 0], drive[0, 1], c, 1, slope)
        values += sign * inertia(axis, stage[0, 0], c) * slope[0, 2 + axis]
    return values / (2.0 * small)
