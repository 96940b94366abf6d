"""The digital rig: a controller that sees encoders at its sample times and holds its voltages between.

Between two samples the voltages are constant; there the rig is integrated as in `dormand_prince`, its
gain zero and its offset the voltage, so that stops are located as ever.
"""

from __future__ import annotations

from math import floor, inf

import numpy as np

from . import examples
from .dormand_prince import ANGLES, integrate_measured
from .exact import slowest_period
from .experiment import ROUNDING, SEEN
from .figures import (
    confirm_settling,
    copy_figures,
    figures_of_merit,
    settling_check_end,
    start_figures,
    update_held_motor,
)
from .jit import copy_into, entry_point, keep_apart, kernel
from .layout import (
    BACK_CALCULATION,
    BEFORE,
    BETA,
    CLAMPING,
    DELAY,
    DISTURBANCE,
    ENDED,
    FILTERED,
    FULL,
    GAIN,
    HELD,
    IMPACTS,
    INNER,
    LIMIT,
    MORE_GAIN,
    MOTOR_OF,
    OFFSET,
    OUT_OF_BOUNDS,
    OUTCOME,
    PLAIN,
    RATE,
    REACHED,
    REFERENCE,
    SIZES,
    START,
    STEP,
    TAU,
    TIME,
    TRACKING,
    TRAVEL,
    USUAL,
    WANTED,
    WINDUP,
    WORKSPACE,
    F,
)


@entry_point(
    lambda size: (
        size,
        examples.zeros(len(size)),
        examples.times(),
        examples.constants(size),
        examples.modes(size),
        examples.settings(),
        examples.estimated(),
        examples.poles(),
        examples.experiment(),
        examples.given(3, 2),
        inf,
        *examples.NUMBERS,
        examples.trim(),
        examples.zeros(*WORKSPACE),
        examples.constants(size),
        examples.modes(size),
        examples.zeros(4),
        examples.zeros(4, len(size)),
        examples.followed(),
        examples.zeros(2, len(size)),
        examples.zeros(2, 2),
        *examples.figures(),
    ),
    *SIZES,
)
def run_digital(
    size, y, t, c, m, d, estimator, poles, x, noise, disturbed_from, rtol, atol, most_steps, rest, w, plant, free,
    grid, course, f, states, voltages, axes, motors, known,
):  # fmt: skip
    """States (len(t), n) and held voltages (len(t), 2) at all t, increasing from t[0] = 0, and figures of merit.

    n is the size. `c`, `m` as for `integrate`, with the controller's gains; `estimator`, ESTIMATED, is the one within
    the controller, where there is one; `poles` are the linear loop's; `noise`, (samples, 2), is added to the measured
    angles, rad; the disturbance acts from the first sample at or after `disturbed_from`.
    With a delay the motors have the voltages d[BEFORE] until the second sample. Figures go into `axes`, `motors` and
    `known`, as `layout` says. Scratch: `w` of zeros, `plant` and `free` like c and m, `grid` (len(t) + 2,), `course`
    (len(t) + 2, n), `f`, twice FOLLOWED. What was not reached is held.
    """
    keep_apart()
    rig_without_feedback(size, c, m, plant, free)
    filters, measured, held, waiting = w[16:18], w[18], w[19], w[20]
    initialize_controller(y, c, d, filters, held)
    own, ahead, end, samples = f[:4], f[4:], t[-1], len(t)
    start, reference = (x[START], x[START + 1]), (x[REFERENCE], x[REFERENCE + 1])
    start_figures(own, start, reference, rest, y[0], y[1], 0.0)
    now, done, impacts, k, outcome, reached = t[0], 0, 0, 0, ENDED, end
    period, over, until, proven = d[TIME], False, end, True
    while done < samples or now < until:
        sample_sensors(y, d, filters, noise[min(k, len(noise) - 1)], measured)
        sample_controller(size, y, c, m, d, measured, w[23], waiting)
        if d[DELAY] == 0.0:
            held[0], held[1] = waiting[0], waiting[1]
        plant[OFFSET], plant[OFFSET + 1] = held[0], held[1]
        on = 1.0 if now >= disturbed_from - 1e-12 else 0.0
        plant[DISTURBANCE], plant[DISTURBANCE + 1] = on * c[DISTURBANCE], on * c[DISTURBANCE + 1]
        following = t[0] + (k + 1) * period
        count = 1
        grid[0] = now
        while done + count - 1 < samples and t[done + count - 1] < following:
            if t[done + count - 1] > now:
                grid[count] = t[done + count - 1]
                count += 1
            else:
                copy_into(y, states[done])
                held_speeds(size, plant, states[done])
                voltages[done, 0], voltages[done, 1] = held[0], held[1]
                done += 1
        ends = not over and done + count - 1 == samples
        if ends and count == 1:  # with this very sample
            ends, over = False, True
            copy_figures(own, ahead)
            until = settling_check_end(own, end, min(slowest_period(poles), end))
            if not until > end:
                break
        z0, z1 = y[4], y[5]
        points = count
        if not ends:
            grid[count] = following
            points += 1
        found, filled, _, _, hits, here = integrate_measured(
            size,
            y,
            grid[:points],
            plant,
            free,
            rtol,
            atol,
            most_steps,
            w,
            course,
            ahead if over else own,
            ANGLES,
        )
        y[4], y[5] = z0, z1
        for i in range(1, count):
            if i < filled:
                copy_into(course[i], states[done])
                states[done, 4], states[done, 5] = z0, z1
                held_speeds(size, plant, states[done])
                voltages[done, 0], voltages[done, 1] = held[0], held[1]
                done += 1
        if not over:
            impacts += hits
            for i in range(2):
                update_held_motor(own[2 + i], held[i], c[LIMIT + i], here - now)
        if ends and found == ENDED:
            over = True
            copy_figures(own, ahead)
            until = settling_check_end(own, end, min(slowest_period(poles), end))
            if not until > end:
                break
            grid[0], grid[1] = end, following
            found, _, _, _, _, _ = integrate_measured(
                size, y, grid[:2], plant, free, rtol, atol, most_steps, w, course, ahead, ANGLES
            )
            y[4], y[5] = z0, z1
        if found != ENDED:
            proven = False
            if not over:
                outcome, reached = found, here
            break
        sample_estimator(size, y, estimator, measured, held)
        held[0], held[1] = waiting[0], waiting[1]
        now = following
        k += 1
    if not over:
        copy_figures(own, ahead)
    for k in range(done, samples):
        copy_into(states[done - 1], states[k])
        voltages[k, 0], voltages[k, 1] = voltages[done - 1, 0], voltages[done - 1, 1]
    confirm_settling(own, ahead, proven)
    known[HELD] = done if outcome == OUT_OF_BOUNDS else samples
    known[OUTCOME], known[IMPACTS], known[REACHED] = outcome, impacts, reached
    last, floor = states[samples - 1] if outcome == ENDED else y, min(max(ROUNDING, 10.0 * rtol), SEEN)
    figures_of_merit(own, reference, last[0], last[1], reached, floor, axes, motors, known)


@kernel
def encoder_reading(angle, axis, d, noise):
    """The angle as the encoder tells it, rad."""
    seen = angle + noise
    step = d[STEP + axis]
    return step * floor(seen / step + 0.5) if step > 0.0 else seen


@kernel
def rig_without_feedback(size, c, m, plant, free):
    """Constants and modes of the rig alone into `plant` and `free`: held voltages go into its offset."""
    copy_into(c, plant)
    for j in range(12):
        plant[GAIN + j] = 0.0
    if len(size) > PLAIN:
        for j in range(MORE_GAIN, USUAL):
            plant[j] = 0.0
    plant[LIMIT], plant[LIMIT + 1] = np.inf, np.inf
    copy_into(m, free)
    free[WINDUP] = 0


@kernel
def initialize_controller(y, c, d, filters, held):
    """The rig before the first sample: within its travel, its filters settled, under the voltages d[BEFORE]."""
    stop_at_travel(y, c)
    held[0], held[1] = d[BEFORE], d[BEFORE + 1]
    initialize_filters(y, d, filters)


@kernel
def stop_at_travel(y, c):
    """Who starts beyond a stop of the pitch travel stands at it, as in `rig.meet_stop`."""
    if abs(y[0]) >= c[TRAVEL]:
        y[0] = c[TRAVEL] if y[0] > 0.0 else -c[TRAVEL]
        y[2] = 0.0


@kernel
def initialize_filters(y, d, filters):
    """The rate filters as if the rig had rested where it is."""
    if d[FILTERED] == 0.0:
        return
    for axis in range(2):
        seen = encoder_reading(y[axis], axis, d, 0.0)
        # x = (I − F)⁻¹ b θ
        a, b = 1.0 - d[F], -d[F + 1]
        e, f = -d[F + 2], 1.0 - d[F + 3]
        det = a * f - b * e
        filters[axis, 0] = (f * d[BETA] - b * d[BETA + 1]) * seen / det
        filters[axis, 1] = (a * d[BETA + 1] - e * d[BETA]) * seen / det


@kernel
def sample_sensors(y, d, filters, noise, measured):
    """Angles and rates as the controller knows them: θ, ψ, θ̇, ψ̇."""
    for axis in range(2):
        seen = encoder_reading(y[axis], axis, d, noise[axis])
        measured[axis] = seen
        if d[FILTERED] == 0.0:
            measured[2 + axis] = y[2 + axis]
            continue
        measured[2 + axis] = d[RATE] * filters[axis, 1]
        x0, x1 = filters[axis, 0], filters[axis, 1]
        filters[axis, 0] = d[F] * x0 + d[F + 1] * x1 + d[BETA] * seen
        filters[axis, 1] = d[F + 2] * x0 + d[F + 3] * x1 + d[BETA + 1] * seen


@kernel
def held_speeds(size, plant, state):
    """Speeds of rotors that follow at once: what their motors have."""
    if len(size) > PLAIN:
        for motor in range(2):
            if plant[TAU + motor] == 0.0:
                state[6 + motor] = plant[OFFSET + motor] + plant[DISTURBANCE + motor]


@kernel
def sample_estimator(size, y, estimator, measured, held):
    """The estimator's states y[8:] go on by one sample, with the angles measured at its start and held voltages."""
    if len(size) == FULL:
        known = estimator.shape[0]
        for i in range(known):
            total = estimator[i, 10]
            for j in range(known):
                total += estimator[i, j] * y[8 + j]
            for j in range(2):
                total += estimator[i, 6 + j] * measured[j] + estimator[i, 8 + j] * held[j]
            measured[4 + i] = total  # the old state is still needed
        for i in range(known):
            y[8 + i] = measured[4 + i]


@kernel
def sample_controller(size, y, c, m, d, measured, asked, out):
    """Voltages as asked, and within their limits into `out`; the integrals y[4:6] go on by one sample (Euler)."""
    for motor in range(2):
        row = GAIN + 6 * motor
        u = c[OFFSET + motor] + c[row + 4] * y[4] + c[row + 5] * y[5]
        for j in range(4):
            u += c[row + j] * measured[j]
        if len(size) > PLAIN:
            for j in range(6, len(size)):
                u += c[MORE_GAIN + INNER * motor - 6 + j] * y[j]
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
