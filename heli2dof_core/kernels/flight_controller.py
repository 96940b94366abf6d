"""A flight's controller: made of a design's numbers, and taking over from another in the air."""

from __future__ import annotations

from math import ceil

from . import examples
from .augmented import estimator_matrices, estimator_order, inner_start, more_constants, sampled_estimator
from .digital import sample_controller
from .experiments import controller_settings, experiment_numbers
from .flight import FLOWN, example_controller, read_sensors, refer
from .flight_layout import (
    BASE,
    BUMPLESS,
    BY_REFERENCE,
    FLIGHT_CONTROLLER,
    FLIGHT_INPUTS,
    FLIGHT_MEMORY,
    HAS,
    JUMP,
    JUMP_WITHOUT,
    LONGEST_TICK,
    MANUAL,
    MEASURED_AS,
    ORDER,
    STICK,
    TICK,
    TICKS,
    TOLD,
    TRIM,
    ZERO_ANGLE,
)
from .jit import copy_into, entry_point, kernel, read_only
from .layout import (
    ALL_STATES,
    FED,
    FILTER_FREQUENCY,
    FILTERED_RATES,
    GAIN,
    LIMIT,
    OBSERVED,
    PLAIN,
    SETTINGS,
    START,
    STEP,
    TIME,
)
from .loop import nonlinear_loop
from .update import kind_of_loop, rig_numbers, update
from .update_layout import ANGLE, DONE, MEASURED, SAMPLE_TIME, block_shapes, made, scratch_shapes


@entry_point(
    lambda: (
        FLOWN,
        examples.numbers(),
        examples.zeros(1, 2),
        *made(block_shapes(len(FLOWN), 2)),
        *made(scratch_shapes(len(FLOWN), 2)),
        examples.zeros(FLIGHT_CONTROLLER),
    )
)
def flight_controller(
    size, numbers, noise,
    outcome, A, B, trim, actuators, K, inverse, closed, own_poles, figures, proportional, integral,
    feedforward, by_reference, law, whole, driven, poles, connected, L, estimator_poles, margins,
    sensitivity, t, experiments, linear, nonlinear, voltages, axes, motors, courses, calm_axes,
    calm_courses,
    w, v, ladder, nodes, followed, c, m, plant, free, raw, grid, sampled, held, f, opened, f_whole, inner_whole, rows,
    minors, p, lag, frequencies, controller, more, inner, settings, estimator, estimated, squares, column,
    motor_columns, polynomial_law, inputs, nothing, rig, gains, vectors, exponential, size_of_exponential,
    start, work, k,
):  # fmt: skip
    """A design's rig and digital controller as `fly` takes them, from `update_layout`'s numbers, DIGITAL among them.

    Filled: `outcome`; where it is DONE, `c`, `m`, `estimated` and `k`, laid out as `layout` and `flight_layout` say,
    `start`, where the experiment begins, and the block as far as the numbers do not leave it out.
    """
    update(
        size, numbers, noise,
        outcome, A, B, trim, actuators, K, inverse, closed, own_poles, figures, proportional, integral,
        feedforward, by_reference, law, whole, driven, poles, connected, L, estimator_poles, margins,
        sensitivity, t, experiments, linear, nonlinear, voltages, axes, motors, courses, calm_axes,
        calm_courses,
        w, v, ladder, nodes, followed, c, m, plant, free, raw, grid, sampled, held, f, opened, f_whole, inner_whole,
        rows, minors, p, lag, frequencies, controller, more, inner, settings, estimator, estimated, squares, column,
        motor_columns, polynomial_law, inputs, nothing, rig, gains, vectors, exponential, size_of_exponential,
        start, work,
    )  # fmt: skip
    if outcome[0] != DONE:
        return
    kind, order, x = kind_of_loop(numbers), estimator_order(numbers, actuators), experiments[0]
    estimator_matrices(numbers, A, B, actuators, L, estimator)
    rig_numbers(numbers, rig)
    more_constants(numbers, trim, actuators, estimator, order, squares, more)
    experiment_numbers(numbers, kind, K, integral, -1, x)
    nonlinear_loop(
        size, read_only(rig), read_only(trim), numbers[ANGLE], read_only(law), read_only(by_reference),
        read_only(integral), x, read_only(more), c, m,
    )  # fmt: skip
    sampled_estimator(
        numbers, trim, estimator, order, numbers[SAMPLE_TIME], size_of_exponential, exponential, estimated
    )
    controller_settings(numbers, trim, x, size_of_exponential, exponential, settings)
    inner_start(numbers, trim, x, settings[STEP : STEP + 2], order, inner)
    for j in range(len(size)):
        start[j] = x[START + j] if j < 4 else inner[1, j - PLAIN] if j >= PLAIN else 0.0
    copy_into(settings, k[:SETTINGS])
    for i in range(2):
        for j in range(2):
            k[BY_REFERENCE + 2 * i + j] = by_reference[i, j]
        k[BASE + i] = (
            x[FED] * trim[i] - law[i, 0] * numbers[ANGLE] - law[i, 6] * trim[0] - law[i, 7] * trim[1]
        )
        k[TRIM + i] = trim[i]
    k[ZERO_ANGLE], k[MEASURED_AS], k[ORDER] = numbers[ANGLE], numbers[MEASURED], order
    k[TICKS] = max(ceil(numbers[SAMPLE_TIME] / LONGEST_TICK - 1e-9), 1)


@entry_point(
    lambda: (
        FLOWN,
        examples.zeros(len(FLOWN)),
        examples.zeros(FLIGHT_MEMORY),
        *(*example_controller(), examples.zeros(FLIGHT_INPUTS)),
        *(*example_controller(), examples.zeros(FLIGHT_INPUTS)),
        examples.constants(FLOWN),
        examples.zeros(14),
        examples.zeros(TOLD),
    )
)
def take_over(size, y, s, c, m, k, u, new_c, new_m, new_k, new_u, own, seen, told):
    """Another controller takes over at a sample, or the same one from the sticks or under other references.

    Its estimator goes on with what the old one knows; its integrals are set so that the motors' voltages do not jump
    (bumpless transfer). `told`, TOLD: the jumps that remain and those that there would be. Where the integrals drive
    one motor or none, by least squares. Scratch: `own` like c, `seen` (14,).
    """
    asked, out = seen[10:12], seen[12:14]
    read_sensors(y, s, k, u, seen[:10])
    step = k[TIME] / k[TICKS]
    if u[MANUAL] != 0.0:
        for i in range(2):
            out[i] = min(max(u[STICK + i], -c[LIMIT + i]), c[LIMIT + i])
    else:
        copy_into(c, own)
        refer(k, u, s[TICK], step, own)
        ask(size, y, own, m, k, seen, asked, out)
    before0, before1 = out[0], out[1]
    hand_over_estimate(y, s, k, new_k, seen)
    if new_u[MANUAL] != 0.0:  # the sticks go on
        for j in range(len(told)):
            told[j] = 0.0
        told[BUMPLESS] = 1.0
        return
    copy_into(new_c, own)
    refer(new_k, new_u, s[TICK], new_k[TIME] / new_k[TICKS], own)
    read_sensors(y, s, new_k, new_u, seen[:10])
    ask(size, y, own, new_m, new_k, seen, asked, out)
    told[JUMP_WITHOUT], told[JUMP_WITHOUT + 1] = out[0] - before0, out[1] - before1
    z0, z1 = y[4], y[5]
    y[4] = y[5] = 0.0
    ask(size, y, own, new_m, new_k, seen, asked, out)
    a, b, e, f = own[GAIN + 4], own[GAIN + 5], own[GAIN + 10], own[GAIN + 11]
    miss0, miss1 = before0 - asked[0], before1 - asked[1]
    total, determinant = a * a + b * b + e * e + f * f, a * f - b * e
    told[BUMPLESS] = 0.0
    if abs(determinant) > 1e-12 * total:
        y[4], y[5] = (f * miss0 - b * miss1) / determinant, (a * miss1 - e * miss0) / determinant
        told[BUMPLESS] = 1.0
    elif total > 0.0:
        y[4], y[5] = (a * miss0 + e * miss1) / total, (b * miss0 + f * miss1) / total
    else:
        y[4], y[5] = z0, z1
    ask(size, y, own, new_m, new_k, seen, asked, out)
    told[JUMP], told[JUMP + 1] = out[0] - before0, out[1] - before1


@kernel
def ask(size, y, own, m, k, seen, asked, out):
    """What the controller would ask and give, while its integrals stay."""
    z0, z1 = y[4], y[5]
    sample_controller(size, y, own, m, k, seen, asked, out)
    y[4], y[5] = z0, z1


@kernel
def hand_over_estimate(y, s, old, new, seen):
    """The new controller's estimator begins with what the old one knew; all in deviations from its own trim."""
    kind, after = old[MEASURED_AS], new[MEASURED_AS]
    for axis in range(2):
        angle, rate, speed = seen[axis], seen[2 + axis], s[HAS + axis]
        if kind == OBSERVED:
            angle, rate = y[8 + axis], y[10 + axis]
            angle += old[ZERO_ANGLE] if axis == 0 else 0.0
            if old[ORDER] == 6.0:
                speed = y[12 + axis] + old[TRIM + axis]
        elif kind == FILTERED_RATES:
            angle, rate = y[8 + 2 * axis], FILTER_FREQUENCY * y[9 + 2 * axis]
            angle += old[ZERO_ANGLE] if axis == 0 else 0.0
        seen[4 + axis], seen[6 + axis], seen[8 + axis] = angle, rate, speed
    for j in range(8, len(y)):
        y[j] = 0.0
    if after == ALL_STATES:
        return
    for axis in range(2):
        angle, rate, speed = seen[4 + axis], seen[6 + axis], seen[8 + axis]
        angle -= new[ZERO_ANGLE] if axis == 0 else 0.0
        if after == OBSERVED:
            y[8 + axis], y[10 + axis] = angle, rate
            if new[ORDER] == 6.0:
                y[12 + axis] = speed - new[TRIM + axis]
        else:
            y[8 + 2 * axis], y[9 + 2 * axis] = angle, rate / FILTER_FREQUENCY
