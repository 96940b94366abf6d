"""Many designs, each the numbers of an update: of each its figures in a row, and how it does on uncertain rigs."""

from __future__ import annotations

from math import nan

from . import examples
from .jit import copy_into, entry_point
from .layout import COURSE, DEVIATION, MOTOR_METRICS, SIZES
from .rigs import run_rigs
from .update import update
from .update_layout import (
    CONNECTED,
    DISTURBED,
    DONE,
    FACTORS,
    FOUND_AXES,
    FOUND_COURSES,
    FOUND_FIGURES,
    FOUND_INVERSE,
    FOUND_K,
    FOUND_MARGINS,
    FOUND_MOTORS,
    FOUND_OUTCOME,
    FOUND_RUNS,
    FOUND_SENSITIVITY,
    NUMBERS,
    SHARE_STABLE,
    SHARE_WITHIN,
    block_shapes,
    designs_shapes,
    made,
    rigs_shapes,
    scratch_shapes,
)


@entry_point(
    lambda size: (
        size,
        examples.numbers().reshape(1, NUMBERS),
        examples.zeros(1, 2),
        examples.given(1, FACTORS),
        1e-3,
        *made(block_shapes(len(size), 2)),
        *made(scratch_shapes(len(size), 2)),
        *made(rigs_shapes(len(size), 1, 2)),
        *made(designs_shapes(len(size), 1)),
    ),
    *SIZES,
)
def run_designs(
    size, designs, noise, factors, rtol,
    outcome, A, B, trim, actuators, K, inverse, closed, own_poles, figures, proportional, integral,
    feedforward, by_reference, law, whole, driven, poles, connected, L, estimator_poles, margins,
    sensitivity, t, experiments, linear, nonlinear, voltages, axes, motors, courses, calm_axes,
    calm_courses,
    w, v, ladder, nodes, followed, c, m, plant, free, raw, grid, sampled, held, f, opened, f_whole, inner_whole, rows,
    minors, p, lag, frequencies, controller, more, inner, settings, estimator, estimated, squares, column,
    motor_columns, polynomial_law, inputs, nothing, rig, gains, vectors, exponential, size_of_exponential,
    start, work,
    times, rig_A, rig_B, rig_trim, rig_actuators, rig_whole, rig_driven, own, modes, y, one, x, course_of_rig,
    rig_poles, angles, stable, within,
    found_poles, found,
):  # fmt: skip
    """Designs, (n, NUMBERS), one after the other by `update`, and each on the rigs of `factors` by `run_rigs`.

    Filled: `found`, (n, FOUND), as `update_layout` says, and `found_poles`, (n, order), the loop's connected poles,
    the places behind them 0. Where a row's outcome is not DONE, nothing else of it is to be read. Without factors
    there are no rigs; of `times` that are one alone their poles are all that is found, which is quick.
    """
    for i in range(len(designs)):
        numbers, row = designs[i], found[i]
        update(
            size, numbers, noise,
            outcome, A, B, trim, actuators, K, inverse, closed, own_poles, figures, proportional, integral,
            feedforward, by_reference, law, whole, driven, poles, connected, L, estimator_poles, margins,
            sensitivity, t, experiments, linear, nonlinear, voltages, axes, motors, courses, calm_axes,
            calm_courses,
            w, v, ladder, nodes, followed, c, m, plant, free, raw, grid, sampled, held, f, opened, f_whole,
            inner_whole, rows, minors, p, lag, frequencies, controller, more, inner, settings, estimator, estimated,
            squares, column, motor_columns, polynomial_law, inputs, nothing, rig, gains, vectors, exponential,
            size_of_exponential, start, work,
        )  # fmt: skip
        row[FOUND_OUTCOME], row[FOUND_RUNS] = outcome[0], outcome[1]
        row[SHARE_STABLE] = row[SHARE_WITHIN] = nan
        if outcome[0] != DONE:
            continue
        for k in range(len(size)):
            found_poles[i, k] = connected[k] if k < int(figures[CONNECTED]) else 0.0
        copy_into(figures, row[FOUND_FIGURES:FOUND_SENSITIVITY])
        copy_into(sensitivity, row[FOUND_SENSITIVITY:FOUND_MARGINS])
        at = FOUND_MARGINS
        for motor in range(2):
            copy_into(margins[motor], row[at : at + margins.shape[1]])
            at += margins.shape[1]
        for run in range(int(outcome[1])):
            for model in range(2):
                n, calm = 2 * run + model, model == 1 and numbers[DISTURBED] != 0.0
                at = FOUND_COURSES + n * COURSE
                copy_into(courses[run, model], row[at : at + COURSE])
                for axis in range(2):
                    if calm:
                        row[at + DEVIATION + axis] = calm_courses[run, DEVIATION + axis]
                    of_motor = FOUND_MOTORS + (2 * n + axis) * MOTOR_METRICS
                    copy_into(motors[run, model, axis], row[of_motor : of_motor + MOTOR_METRICS])
                    source = calm_axes[run, axis] if calm else axes[run, model, axis]
                    of_axis = FOUND_AXES + (2 * n + axis) * len(source)
                    copy_into(source, row[of_axis : of_axis + len(source)])
        for motor in range(2):
            copy_into(K[motor], row[FOUND_K + 6 * motor : FOUND_K + 6 * motor + 6])
            copy_into(inverse[motor], row[FOUND_INVERSE + 2 * motor : FOUND_INVERSE + 2 * motor + 2])
        if len(factors) == 0:
            continue
        run_rigs(
            size, numbers, factors, rtol,
            outcome, A, B, trim, actuators, K, inverse, closed, own_poles, figures, proportional, integral,
            feedforward, by_reference, law, whole, driven, poles, connected, L, estimator_poles, margins,
            sensitivity, t, experiments, linear, nonlinear, voltages, axes, motors, courses, calm_axes,
            calm_courses,
            w, v, ladder, nodes, followed, c, m, plant, free, raw, grid, sampled, held, f, opened, f_whole,
            inner_whole, rows, minors, p, lag, frequencies, controller, more, inner, settings, estimator, estimated,
            squares, column, motor_columns, polynomial_law, inputs, nothing, rig, gains, vectors, exponential,
            size_of_exponential, start, work,
            times, rig_A, rig_B, rig_trim, rig_actuators, rig_whole, rig_driven, own, modes, y, one, x,
            course_of_rig, rig_poles, angles, stable, within,
        )  # fmt: skip
        good = kept = 0.0
        for k in range(len(factors)):
            good += stable[k]
            kept += within[k]
        row[SHARE_STABLE], row[SHARE_WITHIN] = good / len(factors), kept / len(factors)
