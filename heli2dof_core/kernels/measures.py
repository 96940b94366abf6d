"""Step metrics of trajectories, and what is made of raw states before: see `metrics` for their definitions."""

from __future__ import annotations

from math import inf, isnan, nan

from ..layout import (
    EFFORT,
    IAE,
    ITAE,
    LIMIT,
    OVERSHOOT,
    PEAK,
    PEAK_TIME,
    PEAK_VOLTAGE,
    RISE_TIME,
    SETTLING_TIME,
    STEADY_STATE_ERROR,
)
from .jit import kernel
from .rig import asked

LOW, HIGH = 0.1, 0.9
SETTLED = 0.02


@kernel
def trajectories(states, c, course, voltages):
    """The states, (samples, 6), by rows, (6, samples), and what the motors get in them, (2, samples)."""
    for k in range(len(states)):
        for i in range(6):
            course[i, k] = states[k, i]
        for motor in range(2):
            u, limit = asked(states[k], motor, c), c[LIMIT + motor]
            voltages[motor, k] = u if isnan(u) else min(max(u, -limit), limit)


@kernel
def share_at_limit(voltage, limit):
    """Share of the samples at the limit."""
    count = 0
    for value in voltage:
        if abs(value) >= limit * (1.0 - 1e-9):
            count += 1
    return count / len(voltage)


@kernel
def hold(states, voltages, bound):
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


@kernel
def measure(t, angles, voltages, start, reference, trim, axes, motors):
    """Metrics of each axis that is stepped into `axes`, (2, 8), nan where there is none; of each motor into `motors`.

    Returns the largest deviation from the start of each axis.
    """
    for i in range(2):
        if reference[i] != start[i]:
            axis(t, angles[i], start[i], reference[i], axes[i])
        motor(t, voltages[i], trim[i], motors[i])
    return deviation(angles[0], start[0]), deviation(angles[1], start[1])


@kernel
def deviation(angle, start):
    """The largest |angle − start|."""
    largest = 0.0
    for value in angle:
        largest = max(largest, abs(value - start))
    return largest


@kernel
def axis(t, angle, start, reference, out):
    """How one axis follows its step."""
    step, samples = reference - start, len(t)
    by = 1.0 / step
    largest = overshoot = iae = itae = before = 0.0
    lower = upper = nan
    risen = settled = peak = 0
    for k in range(samples):
        moved = angle[k] - start
        share, error, far = moved * by, abs(reference - angle[k]), abs(moved)
        while risen < 2 and share >= (LOW if risen == 0 else HIGH):
            if risen == 0:
                lower = crossing(t, angle, k, start + LOW * step)
            else:
                upper = crossing(t, angle, k, start + HIGH * step)
            risen += 1
        if far > largest:
            largest, peak = far, k
        overshoot = max(overshoot, share - 1.0)
        if abs(share - 1.0) > SETTLED:
            settled = k + 1
        if k > 0:
            half = 0.5 * (t[k] - t[k - 1])
            iae += half * (before + error)
            itae += half * (before * t[k - 1] + error * t[k])
        before = error
    out[RISE_TIME] = upper - lower
    out[SETTLING_TIME] = nan
    if settled == 0:
        out[SETTLING_TIME] = t[0]
    elif settled < samples:
        outside, inside = (
            abs((angle[settled - 1] - start) / step - 1.0),
            abs((angle[settled] - start) / step - 1.0),
        )
        part = (outside - SETTLED) / (outside - inside)
        out[SETTLING_TIME] = t[settled - 1] + part * (t[settled] - t[settled - 1])
    out[OVERSHOOT] = 100.0 * overshoot
    out[PEAK], out[PEAK_TIME] = angle[peak], t[peak]
    out[STEADY_STATE_ERROR] = reference - angle[samples - 1]
    out[IAE], out[ITAE] = iae, itae


@kernel
def crossing(t, angle, k, level):
    """When the angle reaches a level that it has reached at sample k, by straight line."""
    if k == 0:
        return t[0]
    part = (level - angle[k - 1]) / (angle[k] - angle[k - 1])
    return t[k - 1] + part * (t[k] - t[k - 1])


@kernel
def motor(t, voltage, trim, out):
    """What one motor has to do."""
    peak = effort = before = 0.0
    for k in range(len(t)):
        excess = voltage[k] - trim
        peak = max(peak, abs(voltage[k]))
        if k > 0:
            effort += 0.5 * (t[k] - t[k - 1]) * (before * before + excess * excess)
        before = excess
    out[PEAK_VOLTAGE], out[EFFORT] = peak, effort
