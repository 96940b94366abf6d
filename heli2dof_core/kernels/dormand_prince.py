"""Dormand and Prince's 5(4) pair on the rig's loop, with continuous output and located switches.

Sources: Dormand & Prince, J. Comput. Appl. Math. 6 (1980) 19–26 (the pair); Hairer, Nørsett & Wanner,
Solving Ordinary Differential Equations I, 2nd ed., II.4 (step control), II.6 (continuous output of
order 4).
"""

from __future__ import annotations

from math import inf, sqrt

from . import examples
from .figures import level_crossing, update_axis, update_held_motor, update_motor
from .jit import copy_into, entry_point, kernel
from .layout import (
    DIVERGED,
    ENDED,
    GAIN,
    INSIDE,
    LIMIT,
    OFFSET,
    OUT_OF_BOUNDS,
    OUT_OF_STEPS,
    OUT_OF_SWITCHES,
    REST,
    SIDE,
    TRAVEL,
    WORKSPACE,
)
from .rig import event_functions, meet_stop, saturation_modes, state_derivative, switch_mode

MOST_SWITCHES = 2000
NOTHING, ANGLES, EVERYTHING = 0, 1, 2
"""Which figures are taken on the way."""
SHORTEST = 1e-9
"""Of first steps, s; a step that errs is made shorter anyway."""


@entry_point(
    lambda: (
        examples.zeros(6),
        examples.times().copy(),
        examples.constants(),
        examples.modes(),
        *examples.NUMBERS,
        examples.zeros(*WORKSPACE),
        examples.zeros(2, 6),
    )
)
def integrate(y, t, c, m, rtol, atol, most_steps, w, states):
    """`integrate_measured` without figures: the outcome, and how many samples, steps, switches and impacts."""
    return integrate_measured(y, t, c, m, rtol, atol, most_steps, w, states, w, NOTHING)[:5]


@kernel
def integrate_measured(y, t, c, m, rtol, atol, most_steps, w, states, f, figures):
    """States at all t into `states`, (len(t), 6), from y at t[0]; y and m end where the course ends.

    `f`, laid out as `layout` says, follows the angles (ANGLES), or the voltages too (EVERYTHING). A course ends
    early where it is given up, or where an angle leaves ±DIVERGED. Returns the outcome, the number of samples
    filled, of steps, of switches and of impacts, and the time reached.
    """
    k, q, u, trial, probe, g = w[:8], w[8:13], w[21:23], w[13], w[14], w[15]
    switches = impacts = steps = 0
    now, end, samples = t[0], t[-1], len(t)
    saturation_modes(y, c, m)
    if abs(y[0]) >= c[TRAVEL]:
        meet_stop(y, c, m, k, g)
    state_derivative(y, c, m, k, 0)
    h = initial_step_size(y, k, end - now, rtol, atol)
    copy_into(y, states[0])
    done = 1
    while done < samples:
        steps += 1
        h = min(h, end - now)
        if steps > most_steps or h < 1e-15 * end:
            return OUT_OF_STEPS, done, steps, switches, impacts, now
        error = dormand_prince_step(y, h, k, trial, c, m, rtol, atol)
        if not error <= 1.0:  # also rejects a state that is not finite
            h *= max(0.2, 0.9 * error**-0.2) if error < inf else 0.1
            continue
        dense_output(y, h, k, trial, q)
        which, share = -1, 1.0
        if not no_event_possible(q, c, m, u):
            which, share = first_event(q, c, m, k, g, probe)
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
            interpolate(min((t[done] - now) / h, share), q, states[done])
            done += 1
        if beyond:
            interpolate(share, q, y)
            return OUT_OF_BOUNDS, done, steps, switches, impacts, reached
        if which < 0:
            for i in range(6):
                y[i] = trial[i]
                k[0, i] = k[6, i]
            h *= 5.0 if error == 0.0 else min(5.0, 0.9 * error**-0.2)
        else:
            switches += 1
            interpolate(share, q, y)
            if switches > MOST_SWITCHES:
                return OUT_OF_SWITCHES, done, steps, switches, impacts, reached
            if which == 4 and m[REST] == 0:
                impacts += 1
            switch_mode(which, y, c, m, k, g)
            state_derivative(y, c, m, k, 0)
            h *= max(1.0 - share, 1e-3)
        now = reached
    return ENDED, done, steps, switches, impacts, now


@kernel
def no_event_possible(q, c, m, u):
    """Whether no mode can change within a step, by bounds on its polynomials; those of the voltages asked into u."""
    for motor in range(2):
        row = GAIN + 6 * motor
        for i in range(5):
            total = c[OFFSET + motor] if i == 0 else 0.0
            for j in range(6):
                total += c[row + j] * q[i, j]
            u[motor, i] = total
    if m[0] != INSIDE or m[1] != INSIDE or m[REST] != 0:
        return False
    for motor in range(2):
        if (
            bernstein_bound(u[motor, 0], u[motor, 1], u[motor, 2], u[motor, 3], u[motor, 4])
            > c[LIMIT + motor]
        ):
            return False
    return bernstein_bound(q[0, 0], q[1, 0], q[2, 0], q[3, 0], q[4, 0]) <= c[TRAVEL]


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
def initial_step_size(y, k, length, rtol, atol):
    """A hundredth of the time in which the state would change by itself (Hairer, II.4), from `SHORTEST` on.

    That time is no measure where the state is 0 but for rounding.
    """
    size = speed = 0.0
    for i in range(6):
        scale = atol + rtol * abs(y[i])
        size += (y[i] / scale) ** 2
        speed += (k[0, i] / scale) ** 2
    size, speed = sqrt(size / 6), sqrt(speed / 6)
    return min(length, 1e-6 if min(size, speed) < 1e-5 else max(SHORTEST, 0.01 * size / speed))


@kernel
def dormand_prince_step(y, h, k, trial, c, m, rtol, atol):
    """One step of size h from y into `trial`; its estimated error, accepted up to 1."""
    for i in range(6):
        trial[i] = y[i] + h * (k[0, i] / 5)
    state_derivative(trial, c, m, k, 1)
    for i in range(6):
        trial[i] = y[i] + h * (3 / 40 * k[0, i] + 9 / 40 * k[1, i])
    state_derivative(trial, c, m, k, 2)
    for i in range(6):
        trial[i] = y[i] + h * (44 / 45 * k[0, i] - 56 / 15 * k[1, i] + 32 / 9 * k[2, i])
    state_derivative(trial, c, m, k, 3)
    for i in range(6):
        slope = 19372 / 6561 * k[0, i] - 25360 / 2187 * k[1, i] + 64448 / 6561 * k[2, i]
        trial[i] = y[i] + h * (slope - 212 / 729 * k[3, i])
    state_derivative(trial, c, m, k, 4)
    for i in range(6):
        slope = 9017 / 3168 * k[0, i] - 355 / 33 * k[1, i] + 46732 / 5247 * k[2, i]
        trial[i] = y[i] + h * (slope + 49 / 176 * k[3, i] - 5103 / 18656 * k[4, i])
    state_derivative(trial, c, m, k, 5)
    for i in range(6):
        slope = 35 / 384 * k[0, i] + 500 / 1113 * k[2, i] + 125 / 192 * k[3, i]
        trial[i] = y[i] + h * (slope - 2187 / 6784 * k[4, i] + 11 / 84 * k[5, i])
    state_derivative(trial, c, m, k, 6)
    total = 0.0
    for i in range(6):
        d = 71 / 57600 * k[0, i] - 71 / 16695 * k[2, i] + 71 / 1920 * k[3, i]
        d += -17253 / 339200 * k[4, i] + 22 / 525 * k[5, i] - 1 / 40 * k[6, i]
        total += (h * d / (atol + rtol * max(abs(y[i]), abs(trial[i])))) ** 2
    return sqrt(total / 6) if total < inf else inf


@kernel
def dense_output(y, h, k, trial, q):
    """Coefficients of the step's continuous output into q, 5×6."""
    for i in range(6):
        change = trial[i] - y[i]
        bend = h * k[0, i] - change
        q[0, i], q[1, i], q[2, i] = y[i], change, bend
        q[3, i] = change - h * k[6, i] - bend
        d = -12715105075 / 11282082432 * k[0, i] + 87487479700 / 32700410799 * k[2, i]
        d += -10690763975 / 1880347072 * k[3, i] + 701980252875 / 199316789632 * k[4, i]
        q[4, i] = h * (d - 1453857185 / 822651844 * k[5, i] + 69997945 / 29380423 * k[6, i])


@kernel
def interpolate(x, q, out):
    """The state at the share x of a step."""
    z = 1.0 - x
    for i in range(6):
        out[i] = q[0, i] + x * (q[1, i] + z * (q[2, i] + x * (q[3, i] + z * q[4, i])))


@kernel
def first_event(q, c, m, k, g, probe):
    """Which function of `event_functions` turns negative first, and at which share of the step; −1 if none.

    Looked for at the middle and at the end of the step, then bisected to the last digit.
    """
    low = 0.0
    for half in range(1, 3):
        high = 0.5 * half
        interpolate(high, q, probe)
        which = event_functions(probe, c, m, k, g)
        if which >= 0:
            while high - low > 1e-15:
                middle = 0.5 * (low + high)
                if middle <= low or middle >= high:
                    break
                interpolate(middle, q, probe)
                found = event_functions(probe, c, m, k, g)
                if found >= 0:
                    high, which = middle, found
                else:
                    low = middle
            return which, high
        low = high
    return -1, 1.0
