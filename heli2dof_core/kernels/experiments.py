"""Experiments of an update: what is asked of each in numbers, and both models' courses."""

from __future__ import annotations

from math import inf, isnan, pi, sqrt

from .augmented import inner_start, rate_filter
from .digital import run_digital
from .experiment import run_linear, run_nonlinear
from .jit import copy_into, general, keep_apart, read_only
from .layout import (
    ANTI_WINDUP,
    BACK,
    BACK_CALCULATION,
    BEFORE,
    BETA,
    BOUND,
    DELAY,
    DISTURBANCE,
    FED,
    FILTER_FREQUENCY,
    FILTERED,
    NO_ANTI_WINDUP,
    OWN,
    PLAIN,
    RATE,
    REFERENCE,
    START,
    STATIC,
    STEP,
    STOP,
    TIME,
    VOLTS,
    F,
)
from .loop import nonlinear_loop
from .update_layout import (
    ANGLE,
    ASKED,
    BEGINNING,
    COUNTS,
    DIGITAL,
    DISTURBANCE_VOLTS,
    DISTURBED,
    DISTURBED_FROM,
    FEEDFORWARD,
    LATE,
    LIMITS,
    MOST_STEPS,
    PI_GAINS,
    RATES_FILTERED,
    RTOL,
    SAMPLE_TIME,
    SATURATION,
    STOPS,
    TRACKING_TIME,
    WINDUP_KIND,
)

ABSOLUTE_TOLERANCE = 0.1
"""Absolute tolerance of the integration as a share of the relative one (states are of order 1)."""


@general
def experiment_numbers(numbers, kind, K, integral, left_out, x):
    """The scenario on this loop, EXPERIMENT numbers; the axis `left_out` rests, −1 for none."""
    keep_apart()
    theta_0 = numbers[ANGLE]
    for axis in range(2):
        base, asked, begins = theta_0 if axis == 0 else 0.0, numbers[ASKED + axis], numbers[BEGINNING + axis]
        x[REFERENCE + axis] = base if isnan(asked) or axis == left_out else asked
        x[START + axis] = base if isnan(begins) else begins
        x[START + 2 + axis] = numbers[BEGINNING + 2 + axis]
        limited = numbers[SATURATION] != 0.0
        x[BOUND + axis] = numbers[LIMITS + axis] if limited else inf
        x[VOLTS + axis] = numbers[DISTURBANCE_VOLTS + axis] if numbers[DISTURBED] != 0.0 else 0.0
    x[STOP] = numbers[LIMITS + 2] if numbers[STOPS] != 0.0 else inf
    x[FED] = numbers[FEEDFORWARD]
    windup = numbers[WINDUP_KIND] if numbers[SATURATION] != 0.0 and kind != STATIC else float(NO_ANTI_WINDUP)
    x[ANTI_WINDUP] = windup
    for k in range(4):
        x[BACK + k] = 0.0
    if windup == BACK_CALCULATION:
        tracking_gains(numbers, kind, K, integral, x)


@general
def tracking_gains(numbers, kind, K, integral, x):
    """The gains of back-calculation into x: see `simulation.experiment`."""
    a, b, c, d = integral[0, 0], integral[0, 1], integral[1, 0], integral[1, 1]
    if (a == 0.0 and c == 0.0) or (b == 0.0 and d == 0.0):
        return
    total, determinant = a * a + b * b + c * c + d * d, a * d - b * c
    difference = sqrt(max(total * total - 4.0 * determinant * determinant, 0.0))
    largest = sqrt((total + difference) / 2.0)
    e, f, g, h = d, -b, -c, a
    by = determinant
    if abs(determinant) <= 1e-15 * largest * largest:  # of rank one: the pseudo-inverse
        e, f, g, h = a, c, b, d
        by = total
    for axis in range(2):
        time = numbers[TRACKING_TIME]
        if time == 0.0:
            time = numbers[PI_GAINS + 2 * axis + 1]
            if kind == OWN:
                drives = sqrt(integral[0, axis] ** 2 + integral[1, axis] ** 2)
                time = sqrt(K[0, axis] ** 2 + K[1, axis] ** 2) / drives
        x[BACK + 2 * axis] = (e if axis == 0 else g) / by / time
        x[BACK + 2 * axis + 1] = (f if axis == 0 else h) / by / time


@general
def controller_settings(numbers, trim, x, size, exponential, d):
    """`digital`'s array d."""
    d[TIME], d[DELAY], d[FILTERED] = numbers[SAMPLE_TIME], numbers[LATE], numbers[RATES_FILTERED]
    for axis in range(2):
        counts, limit = numbers[COUNTS + axis], x[BOUND + axis]
        d[STEP + axis] = 2.0 * pi / counts if counts > 0.0 else 0.0
        d[BEFORE + axis] = min(max(trim[axis] * x[FED], -limit), limit)
    d[F], d[F + 1], d[F + 2], d[F + 3], d[BETA], d[BETA + 1] = rate_filter(
        numbers[SAMPLE_TIME], size, exponential
    )
    d[RATE] = FILTER_FREQUENCY * FILTER_FREQUENCY


@general
def run_of_linear_model(
    size, numbers, trim, law, by_reference, whole, driven, poles, order, x, t, inner, nothing, e, v, ladder, nodes,
    followed, states, voltages, axes, motors, course,
):  # fmt: skip
    """The linear model's course of an experiment."""
    keep_apart()
    inner_start(numbers, trim, x, nothing, order, inner)
    run_linear(
        size, numbers[ANGLE], read_only(law), read_only(by_reference), read_only(whole), read_only(driven),
        read_only(poles), x, read_only(inner[0]), read_only(t), int(numbers[MOST_STEPS]), read_only(trim), v,
        ladder, nodes, followed, states, voltages, axes, motors, course,
    )  # fmt: skip


@general
def run_of_rig(
    size, numbers, disturbed, rig, trim, law, by_reference, integral, poles, order, x, more, t, noise, estimated,
    settings, inner, nothing, start, w, c, m, plant, free, raw, grid, sampled, held, followed,
    states, voltages, axes, motors, course,
):  # fmt: skip
    """The rig's course of an experiment, with the disturbance or without it, under either kind of controller."""
    keep_apart()
    rtol, most = numbers[RTOL], int(numbers[MOST_STEPS])
    atol, since = ABSOLUTE_TOLERANCE * rtol, numbers[DISTURBED_FROM] if disturbed else inf
    ends, times = read_only(poles), read_only(t)
    rest = read_only(trim)
    nonlinear_loop(
        size, read_only(rig), rest, numbers[ANGLE], read_only(law), read_only(by_reference), read_only(integral), x,
        read_only(more), c, m,
    )  # fmt: skip
    if not disturbed:
        c[DISTURBANCE] = c[DISTURBANCE + 1] = 0.0
    if numbers[DIGITAL] == 0.0:
        inner_start(numbers, trim, x, nothing, order, inner)
        run_nonlinear(
            size, c, m, ends, x, read_only(inner[1]), times, since, rtol, atol, most, rest, w, raw, grid, followed,
            states, voltages, axes, motors, course,
        )  # fmt: skip
        return
    inner_start(numbers, trim, x, settings[STEP : STEP + 2], order, inner)
    for k in range(len(size)):
        start[k] = x[START + k] if k < 4 else inner[1, k - PLAIN] if k >= PLAIN else 0.0
    for i in range(len(w)):
        for j in range(w.shape[1]):
            w[i, j] = 0.0
    run_digital(
        size, start, times, c, m, settings, read_only(estimated), ends, x, read_only(noise), since, rtol, atol, most,
        rest, w, plant, free, grid, raw, followed, sampled, held, axes, motors, course,
    )  # fmt: skip
    for k in range(len(t)):
        for i in range(len(size)):
            states[i, k] = sampled[k, i]
        voltages[0, k], voltages[1, k] = held[k, 0], held[k, 1]


@general
def fill_times(duration, t):
    """Evenly spaced, s."""
    last = len(t) - 1
    step = duration / last
    for k in range(last):
        t[k] = k * step
    t[last] = duration


@general
def copy_run(source, target):
    """Figures of one run beside another, (2, columns)."""
    for i in range(len(source)):
        copy_into(source[i], target[i])
