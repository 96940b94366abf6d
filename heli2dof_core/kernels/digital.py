"""The digital rig: a controller that sees encoders at its sample times and holds its voltages between.

Between two samples the voltages are constant; there the rig is integrated as in `dormand_prince`, its
gain zero and its offset the voltage, so that stops are located as ever.
"""

from __future__ import annotations

from math import floor

import numpy as np

from ..layout import (
    BACK_CALCULATION,
    BEFORE,
    BETA,
    CLAMPING,
    DELAY,
    DISTURBANCE,
    FILTERED,
    GAIN,
    LIMIT,
    MOTOR_OF,
    OFFSET,
    RATE,
    STEP,
    TIME,
    TRACKING,
    TRAVEL,
    WANTED,
    WINDUP,
    F,
)
from .dormand_prince import integrate
from .jit import kernel, put


@kernel
def run_digital(
    y,
    t,
    c,
    m,
    d,
    noise,
    disturbed_from,
    rtol,
    atol,
    most_steps,
    w,
    plant,
    free,
    grid,
    course,
    states,
    voltages,
):
    """States (len(t), 6) and held voltages (len(t), 2) at all t, increasing from t[0] = 0.

    `c`, `m` as for `integrate`, with the controller's gains; `noise`, (samples, 2), is added to the
    measured angles, rad; the disturbance acts from the first sample at or after `disturbed_from`.
    With a delay the motors have the voltages d[BEFORE] until the second sample. Scratch: `w` of zeros, `plant` and
    `free` like c and m, `grid` (len(t) + 2,), `course` (len(t) + 2, 6).
    Returns the outcome, the grid points filled and the impacts.
    """
    without_controller(c, m, plant, free)
    filters, measured, held, waiting = w[16:18], w[18], w[19], w[20]
    stand(y, c, d, filters, held)
    now, done, impacts, k = t[0], 0, 0, 0
    period = d[TIME]
    while done < len(t):
        sense(y, d, filters, noise[min(k, len(noise) - 1)], measured)
        control(y, c, m, d, measured, w[21], waiting)
        if d[DELAY] == 0.0:
            held[0], held[1] = waiting[0], waiting[1]
        following = t[0] + (k + 1) * period
        count = 1
        grid[0] = now
        while done + count - 1 < len(t) and t[done + count - 1] < following:
            if t[done + count - 1] > now:
                grid[count] = t[done + count - 1]
                count += 1
            else:
                put(y, states[done])
                voltages[done, 0], voltages[done, 1] = held[0], held[1]
                done += 1
        grid[count] = following
        plant[OFFSET], plant[OFFSET + 1] = held[0], held[1]
        on = 1.0 if now >= disturbed_from - 1e-12 else 0.0
        plant[DISTURBANCE], plant[DISTURBANCE + 1] = on * c[DISTURBANCE], on * c[DISTURBANCE + 1]
        z0, z1 = y[4], y[5]
        outcome, filled, _, _, hits = integrate(
            y, grid[: count + 1], plant, free, rtol, atol, most_steps, w, course
        )
        y[4], y[5] = z0, z1
        impacts += hits
        for i in range(1, count):
            if i < filled:
                put(course[i], states[done])
                states[done, 4], states[done, 5] = z0, z1
                voltages[done, 0], voltages[done, 1] = held[0], held[1]
                done += 1
        if outcome != 0:
            return outcome, done, impacts
        held[0], held[1] = waiting[0], waiting[1]
        now = following
        k += 1
    return 0, done, impacts


@kernel
def measure(angle, axis, d, noise):
    """The angle as the encoder tells it, rad."""
    seen = angle + noise
    step = d[STEP + axis]
    return step * floor(seen / step + 0.5) if step > 0.0 else seen


@kernel
def without_controller(c, m, plant, free):
    """Constants and modes of the rig alone into `plant` and `free`: held voltages go into its offset."""
    put(c, plant)
    for j in range(12):
        plant[GAIN + j] = 0.0
    plant[LIMIT], plant[LIMIT + 1] = np.inf, np.inf
    put(m, free)
    free[WINDUP] = 0


@kernel
def stand(y, c, d, filters, held):
    """The rig before the first sample: within its travel, its filters settled, under the voltages d[BEFORE]."""
    enter(y, c)
    held[0], held[1] = d[BEFORE], d[BEFORE + 1]
    settle_filters(y, d, filters)


@kernel
def enter(y, c):
    """Who starts beyond a stop of the pitch travel stands at it, as in `rig.meet_stop`."""
    if abs(y[0]) >= c[TRAVEL]:
        y[0] = c[TRAVEL] if y[0] > 0.0 else -c[TRAVEL]
        y[2] = 0.0


@kernel
def settle_filters(y, d, filters):
    """The rate filters as if the rig had rested where it is."""
    if d[FILTERED] == 0.0:
        return
    for axis in range(2):
        seen = measure(y[axis], axis, d, 0.0)
        # x = (I − F)⁻¹ b θ
        a, b = 1.0 - d[F], -d[F + 1]
        e, f = -d[F + 2], 1.0 - d[F + 3]
        det = a * f - b * e
        filters[axis, 0] = (f * d[BETA] - b * d[BETA + 1]) * seen / det
        filters[axis, 1] = (a * d[BETA + 1] - e * d[BETA]) * seen / det


@kernel
def sense(y, d, filters, noise, measured):
    """Angles and rates as the controller knows them: θ, ψ, θ̇, ψ̇."""
    for axis in range(2):
        seen = measure(y[axis], axis, d, noise[axis])
        measured[axis] = seen
        if d[FILTERED] == 0.0:
            measured[2 + axis] = y[2 + axis]
            continue
        measured[2 + axis] = d[RATE] * filters[axis, 1]
        x0, x1 = filters[axis, 0], filters[axis, 1]
        filters[axis, 0] = d[F] * x0 + d[F + 1] * x1 + d[BETA] * seen
        filters[axis, 1] = d[F + 2] * x0 + d[F + 3] * x1 + d[BETA + 1] * seen


@kernel
def control(y, c, m, d, measured, asked, out):
    """Voltages as asked, and within their limits into `out`; the integrals y[4:6] go on by one sample (Euler)."""
    for motor in range(2):
        row = GAIN + 6 * motor
        u = c[OFFSET + motor] + c[row + 4] * y[4] + c[row + 5] * y[5]
        for j in range(4):
            u += c[row + j] * measured[j]
        asked[motor] = u
        out[motor] = min(max(u, -c[LIMIT + motor]), c[LIMIT + motor])
    cut0, cut1 = out[0] - asked[0], out[1] - asked[1]
    for i in range(2):
        e = c[WANTED + i] - measured[i]
        if m[WINDUP] == BACK_CALCULATION:
            e += c[TRACKING + 2 * i] * cut0 + c[TRACKING + 2 * i + 1] * cut1
        elif m[WINDUP] == CLAMPING:
            motor = m[MOTOR_OF + i]
            cut = cut0 if motor == 0 else cut1
            if cut != 0.0 and c[GAIN + 6 * motor + 4 + i] * e * asked[motor] > 0.0:
                e = 0.0
        y[4 + i] += d[TIME] * e
