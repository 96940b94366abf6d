"""What is made of raw states: courses by rows, voltages, and what stands where nothing was simulated."""

from __future__ import annotations

from math import inf

from .jit import kernel
from .layout import DISTURBANCE, GAIN, INNER, LIMIT, MORE_GAIN, OFFSET, PLAIN, TAU


@kernel
def trajectories(size, states, done, c, course, voltages):
    """The first `done` states, (samples, n), by rows, (n, samples), and what the motors get in them, (2, samples).

    What follows is held at the last of them.
    """
    samples = course.shape[1]
    for i in range(len(size)):
        row = course[i]
        for k in range(done):
            row[k] = states[k, i]
        for k in range(done, samples):
            row[k] = states[done - 1, i]
    a, b, d, e, f, g = course[0], course[1], course[2], course[3], course[4], course[5]
    for motor in range(2):
        row, at, limit = voltages[motor], GAIN + 6 * motor, c[LIMIT + motor]
        p, q, r, s, t, u = c[at], c[at + 1], c[at + 2], c[at + 3], c[at + 4], c[at + 5]
        offset = c[OFFSET + motor]
        for k in range(samples):
            asked = offset + p * a[k] + q * b[k] + r * d[k] + s * e[k] + t * f[k] + u * g[k]
            if len(size) > PLAIN:
                for i in range(6, len(size)):
                    asked += c[MORE_GAIN + INNER * motor - 6 + i] * course[i, k]
            row[k] = min(max(asked, -limit), limit)


@kernel
def speeds_at_once(size, voltages, first, c, course):
    """Speeds of rotors that follow at once, rows 6 and 7 of a course: what their motors have.

    `voltages`, (2, samples), is what the controller gives; the disturbance within c acts from the sample `first` on.
    """
    if len(size) > PLAIN:
        for motor in range(2):
            if c[TAU + motor] == 0.0:
                for k in range(course.shape[1]):
                    volts = c[DISTURBANCE + motor] if k >= first else 0.0
                    course[6 + motor, k] = voltages[motor, k] + volts


@kernel
def hold_after_divergence(states, voltages, bound):
    """Freezes a response where an angle, states[:2], leaves ±bound or a number is not finite any more.

    Returns the first sample that is held, or the number of samples.
    """
    rows, samples = states.shape
    for k in range(samples):
        good = abs(states[0, k]) < bound and abs(states[1, k]) < bound
        if good and abs(voltages[0, k]) < inf and abs(voltages[1, k]) < inf:
            continue
        first = max(k, 1)
        for j in range(first, samples):
            for i in range(rows):
                states[i, j] = states[i, first - 1]
            for i in range(2):
                voltages[i, j] = voltages[i, first - 1]
        return first
    return samples
