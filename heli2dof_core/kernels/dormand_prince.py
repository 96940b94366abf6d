"""Dormand and Prince's 5(4) pair on the rig's loop, with continuous output and located switches.

Sources: Dormand & Prince, J. Comput. Appl. Math. 6 (1980) 19–26 (the pair); Hairer, Nørsett & Wanner,
Solving Ordinary Differential Equations I, 2nd ed., II.4 (step control), II.6 (continuous output of
order 4).
"""

from __future__ import annotations

from math import inf, sqrt

from . import examples
from .figures import level_crossing, turning_point, update_axis, update_held_motor, update_motor
from .jit import copy_into, entry_point, keep_apart, kernel
from .layout import (
    BREAKAWAY,
    DEAD,
    DISTURBANCE,
    DIVERGED,
    ENDED,
    GAIN,
    INNER,
    INSIDE,
    LIMIT,
    MORE_GAIN,
    OFFSET,
    OUT_OF_BOUNDS,
    OUT_OF_STEPS,
    OUT_OF_SWITCHES,
    PLAIN,
    REST,
    SIDE,
    SIZES,
    SLIP,
    SQUARE,
    TAU,
    TRAVEL,
    USUAL,
    WORKSPACE,
    ZONE,
)
from .rig import (
    event_functions,
    initial_modes,
    meet_stop,
    state_derivative,
    switch_mode,
)

MOST_SWITCHES = 2000
SWITCHES_PER_SECOND = 1000.0
"""How many more a rig with friction or curved thrust may have: hunting goes on, but chattering does not."""
NOTHING, ANGLES, EVERYTHING = 0, 1, 2
"""Which figures are taken on the way."""
SHORTEST = 1e-9
"""Of first steps, s; a step that errs is made shorter anyway."""


@entry_point(
    lambda size: (
        size,
        examples.zeros(len(size)),
        examples.times().copy(),
        examples.constants(size),
        examples.modes(size),
        *examples.NUMBERS,
        examples.zeros(*WORKSPACE),
        examples.zeros(2, len(size)),
    ),
    *SIZES,
)
def integrate(size, y, t, c, m, rtol, atol, most_steps, w, states):
    """`integrate_measured` without figures: the outcome, and how many samples, steps, switches and impacts."""
    return integrate_measured(size, y, t, c, m, rtol, atol, most_steps, w, states, w, NOTHING)[:5]


@kernel
def integrate_measured(size, y, t, c, m, rtol, atol, most_steps, w, states, f, figures):
    """States at all t into `states`, (len(t), len(size)), from y at t[0]; y and m end where the course ends.

    `f`, laid out as `layout` says, follows the angles (ANGLES), or the voltages too (EVERYTHING). A course ends
    early where it is given up, or where an angle leaves ±DIVERGED. Returns the outcome, the number of samples
    filled, of steps, of switches and of impacts, and the time reached.
    """
    keep_apart()
    k, q, u, trial, probe, g = w[:8], w[8:13], w[21:23], w[13], w[14], w[15]
    switches = impacts = steps = 0
    now, end, samples = t[0], t[-1], len(t)
    initial_modes(size, y, c, m)
    if abs(y[0]) >= c[TRAVEL]:
        meet_stop(size, y, c, m, k, g)
    state_derivative(size, y, c, m, k, 0)
    h = initial_step_size(size, y, c, k, end - now, rtol, atol)
    copy_into(y, states[0])
    done = 1
    while done < samples:
        steps += 1
        h = min(h, end - now)
        if steps > most_steps or h < 1e-15 * end:
            return OUT_OF_STEPS, done, steps, switches, impacts, now
        error = dormand_prince_step(size, y, h, k, trial, c, m, rtol, atol)
        if not error <= 1.0:  # also rejects a state that is not finite
            h *= max(0.2, 0.9 * error**-0.2) if error < inf else 0.1
            continue
        dense_output(size, y, h, k, trial, q)
        which, share = -1, 1.0
        if not no_event_possible(size, q, c, m, u):
            which, share = first_event(size, q, c, m, k, g, probe)
        beyond = which < 0 and max(abs(trial[0]), abs(trial[1])) >= DIVERGED
        if beyond:
            share = divergence_crossing(q)
        if figures != NOTHING:
            for i in range(2):
                update_axis(f[i], q[0, i], q[1, i], q[2, i], q[3, i], q[4, i], now, h, share, True)
        if figures == EVERYTHING:
            for i in range(2):
                b = f[2 + i]
                if m[i] == INSIDE:
                    update_motor(b, u[i, 0], u[i, 1], u[i, 2], u[i, 3], u[i, 4], h, share)
                else:
                    update_held_motor(b, m[SIDE + i] * c[LIMIT + i], c[LIMIT + i], share * h)
        reached = now + share * h
        last = end - reached < 1e-12 * end
        while done < samples and (t[done] <= reached or last):
            interpolate(size, min((t[done] - now) / h, share), q, states[done])
            done += 1
        if beyond:
            interpolate(size, share, q, y)
            return OUT_OF_BOUNDS, done, steps, switches, impacts, reached
        if which < 0:
            for i in range(len(size)):
                y[i] = trial[i]
                k[0, i] = k[6, i]
            h *= 5.0 if error == 0.0 else min(5.0, 0.9 * error**-0.2)
        else:
            switches += 1
            interpolate(size, share, q, y)
            allowed = MOST_SWITCHES
            if len(size) > PLAIN:
                allowed += int(SWITCHES_PER_SECOND * (reached - t[0]))
            if switches > allowed:
                return OUT_OF_SWITCHES, done, steps, switches, impacts, reached
            if which == 4 and m[REST] == 0:
                impacts += 1
            switch_mode(size, which, y, c, m, k, g)
            state_derivative(size, y, c, m, k, 0)
            h *= max(1.0 - share, 1e-3)
        now = reached
    return ENDED, done, steps, switches, impacts, now


@kernel
def no_event_possible(size, q, c, m, u):
    """Whether no mode can change within a step, by bounds on its polynomials; those of the voltages asked into u."""
    for motor in range(2):
        row = GAIN + 6 * motor
        for i in range(5):
            total = c[OFFSET + motor] if i == 0 else 0.0
            for j in range(6):
                total += c[row + j] * q[i, j]
            if len(size) > PLAIN:
                for j in range(6, len(size)):
                    total += c[MORE_GAIN + INNER * motor - 6 + j] * q[i, j]
            u[motor, i] = total
    if m[0] != INSIDE or m[1] != INSIDE or m[REST] != 0:
        return False
    for motor in range(2):
        if (
            bernstein_bound(u[motor, 0], u[motor, 1], u[motor, 2], u[motor, 3], u[motor, 4])
            > c[LIMIT + motor]
        ):
            return False
    if len(size) > PLAIN and not actuators_keep_modes(q, c, m, u):
        return False
    return bernstein_bound(q[0, 0], q[1, 0], q[2, 0], q[3, 0], q[4, 0]) <= c[TRAVEL]


@kernel
def actuators_keep_modes(q, c, m, u):
    """The same of thrust curves and friction, where no motor is at its limit and pitch at no stop."""
    for i in range(2):
        if c[SQUARE + i] != 0.0:
            if c[TAU + i] > 0.0:
                first, p1, p2, p3, p4 = q[0, 6 + i], q[1, 6 + i], q[2, 6 + i], q[3, 6 + i], q[4, 6 + i]
            else:
                first, p1, p2, p3, p4 = u[i, 0] + c[DISTURBANCE + i], u[i, 1], u[i, 2], u[i, 3], u[i, 4]
            zone = m[ZONE + i]
            if zone == 0 and bernstein_bound(first, p1, p2, p3, p4) > c[DEAD + i]:
                return False
            if zone != 0 and bernstein_least(zone, first, p1, p2, p3, p4) < c[DEAD + i]:
                return False
        if c[BREAKAWAY + i] > 0.0:
            way = m[SLIP + i]
            if (
                way == 0
                or bernstein_least(way, q[0, 2 + i], q[1, 2 + i], q[2, 2 + i], q[3, 2 + i], q[4, 2 + i]) < 0.0
            ):
                return False
    return True


@kernel
def bernstein_least(sign, p0, p1, p2, p3, p4):
    """The smallest of the Bernstein ordinates of `sign` times a step's polynomial: nothing on the step is smaller."""
    b1, b3 = p0 + 0.25 * (p1 + p2), p0 + 0.75 * p1 + 0.25 * (p2 + p3)
    b2 = p0 + 0.5 * p1 + (p2 + 0.5 * (p3 + p4)) / 3.0
    return min(sign * p0, sign * b1, sign * b2, sign * b3, sign * (p0 + p1))


@kernel
def bernstein_bound(p0, p1, p2, p3, p4):
    """The largest of a step's Bernstein ordinates: nothing on the step is larger."""
    b1, b3 = p0 + 0.25 * (p1 + p2), p0 + 0.75 * p1 + 0.25 * (p2 + p3)
    b2 = p0 + 0.5 * p1 + (p2 + 0.5 * (p3 + p4)) / 3.0
    return max(abs(p0), abs(b1), abs(b2), abs(b3), abs(p0 + p1))


@kernel
def divergence_crossing(q):
    """The share of a step at which the first angle leaves ±DIVERGED."""
    share = 1.0
    for i in range(2):
        last = q[0, i] + q[1, i]
        if abs(last) >= DIVERGED:
            level = DIVERGED if last > 0.0 else -DIVERGED
            share = min(share, level_crossing(q[0, i], q[1, i], q[2, i], q[3, i], q[4, i], level, 0.0, 1.0))
    return share


@kernel
def initial_step_size(size, y, c, k, length, rtol, atol):
    """A hundredth of the time in which the state would change by itself (Hairer, II.4), from `SHORTEST` on.

    That time is no measure where the state is 0 but for rounding.
    """
    extent = speed = 0.0
    for i in range(6):
        scale = atol + rtol * abs(y[i])
        extent += (y[i] / scale) ** 2
        speed += (k[0, i] / scale) ** 2
    if len(size) > PLAIN:
        for i in range(6, len(size)):
            scale = atol * c[USUAL - 6 + i] + rtol * abs(y[i])
            extent += (y[i] / scale) ** 2
            speed += (k[0, i] / scale) ** 2
    extent, speed = sqrt(extent / 6), sqrt(speed / 6)
    return min(length, 1e-6 if min(extent, speed) < 1e-5 else max(SHORTEST, 0.01 * extent / speed))


@kernel
def dormand_prince_step(size, y, h, k, trial, c, m, rtol, atol):
    """One step of size h from y into `trial`; its estimated error, accepted up to 1."""
    for i in range(len(size)):
        trial[i] = y[i] + h * (k[0, i] / 5)
    state_derivative(size, trial, c, m, k, 1)
    for i in range(len(size)):
        trial[i] = y[i] + h * (3 / 40 * k[0, i] + 9 / 40 * k[1, i])
    state_derivative(size, trial, c, m, k, 2)
    for i in range(len(size)):
        trial[i] = y[i] + h * (44 / 45 * k[0, i] - 56 / 15 * k[1, i] + 32 / 9 * k[2, i])
    state_derivative(size, trial, c, m, k, 3)
    for i in range(len(size)):
        slope = 19372 / 6561 * k[0, i] - 25360 / 2187 * k[1, i] + 64448 / 6561 * k[2, i]
        trial[i] = y[i] + h * (slope - 212 / 729 * k[3, i])
    state_derivative(size, trial, c, m, k, 4)
    for i in range(len(size)):
        slope = 9017 / 3168 * k[0, i] - 355 / 33 * k[1, i] + 46732 / 5247 * k[2, i]
        trial[i] = y[i] + h * (slope + 49 / 176 * k[3, i] - 5103 / 18656 * k[4, i])
    state_derivative(size, trial, c, m, k, 5)
    for i in range(len(size)):
        slope = 35 / 384 * k[0, i] + 500 / 1113 * k[2, i] + 125 / 192 * k[3, i]
        trial[i] = y[i] + h * (slope - 2187 / 6784 * k[4, i] + 11 / 84 * k[5, i])
    state_derivative(size, trial, c, m, k, 6)
    total = 0.0
    for i in range(len(size)):
        usual = 1.0 if i < 6 else c[USUAL - 6 + i]
        d = 71 / 57600 * k[0, i] - 71 / 16695 * k[2, i] + 71 / 1920 * k[3, i]
        d += -17253 / 339200 * k[4, i] + 22 / 525 * k[5, i] - 1 / 40 * k[6, i]
        total += (h * d / (atol * usual + rtol * max(abs(y[i]), abs(trial[i])))) ** 2
    return sqrt(total / 6) if total < inf else inf


@kernel
def dense_output(size, y, h, k, trial, q):
    """Coefficients of the step's continuous output into q, 5×6."""
    for i in range(len(size)):
        change = trial[i] - y[i]
        bend = h * k[0, i] - change
        q[0, i], q[1, i], q[2, i] = y[i], change, bend
        q[3, i] = change - h * k[6, i] - bend
        d = -12715105075 / 11282082432 * k[0, i] + 87487479700 / 32700410799 * k[2, i]
        d += -10690763975 / 1880347072 * k[3, i] + 701980252875 / 199316789632 * k[4, i]
        q[4, i] = h * (d - 1453857185 / 822651844 * k[5, i] + 69997945 / 29380423 * k[6, i])


@kernel
def interpolate(size, x, q, out):
    """The state at the share x of a step."""
    z = 1.0 - x
    for i in range(len(size)):
        out[i] = q[0, i] + x * (q[1, i] + z * (q[2, i] + x * (q[3, i] + z * q[4, i])))


@kernel
def first_event(size, q, c, m, k, g, probe):
    """Which function of `event_functions` turns negative first, and at which share of the step; −1 if none.

    Looked for at the middle and at the end of the step, then bisected to the last digit; where there are thrust
    curves or friction also where what they depend on turns back.
    """
    low = 0.0
    while low < 1.0:
        high = 0.5 if low < 0.5 else 1.0
        if len(size) > PLAIN:
            high = next_look(q, c, m, low, high)
        interpolate(size, high, q, probe)
        which = event_functions(size, probe, c, m, k, g)
        if which >= 0:
            while high - low > 1e-15:
                middle = 0.5 * (low + high)
                if middle <= low or middle >= high:
                    break
                interpolate(size, middle, q, probe)
                found = event_functions(size, probe, c, m, k, g)
                if found >= 0:
                    high, which = middle, found
                else:
                    low = middle
            return which, high
        low = high
    return -1, 1.0


@kernel
def next_look(q, c, m, low, high):
    """Where to look next for an event after the share `low` of a step, at `high` at the latest.

    A rate that turns back may have been 0 before, and a rotor's speed at an end of its curve's part. What an axis
    that is stuck withstands is no polynomial: it is looked at eight times.
    """
    first = low + 1e-9 if low > 0.0 else 0.0
    for i in range(2):
        if c[BREAKAWAY + i] > 0.0 and m[SLIP + i] == 0:
            high = min(high, low + 0.125)
        elif c[BREAKAWAY + i] > 0.0:
            high = turning_point(q[1, 2 + i], q[2, 2 + i], q[3, 2 + i], q[4, 2 + i], first, high)
        if c[SQUARE + i] != 0.0 and c[TAU + i] > 0.0:
            high = turning_point(q[1, 6 + i], q[2, 6 + i], q[3, 6 + i], q[4, 6 + i], first, high)
    return high
