"""Many rigs under one controller: the poles of their loops, whether these are stable, and the rigs' responses."""

from __future__ import annotations

from math import nan

from . import examples
from .augmented import (
    controller_numbers,
    estimator_matrices,
    estimator_order,
    inner_start,
    more_constants,
    whole_loop,
)
from .derived import rig_model
from .dormand_prince import integrate
from .experiments import ABSOLUTE_TOLERANCE, experiment_numbers
from .jit import copy_into, entry_point, read_only
from .layout import LIMIT, PLAIN, SIZES, START, TAU
from .loop import nonlinear_loop
from .placing import SLOPE
from .polynomials import polynomial_matrices
from .rig import commanded_voltage
from .stability import is_stable
from .update import (
    connected_states,
    fill_polynomials,
    is_simple,
    kind_of_loop,
    law_by_states,
    poles_of,
    rig_numbers,
)
from .update_layout import (
    ANGLE,
    FACTORS,
    MOST_STEPS,
    PARAMETERS,
    ROTORS_PLACED,
    block_shapes,
    made,
    rigs_shapes,
    scratch_shapes,
)


@entry_point(
    lambda size: (
        size,
        examples.numbers(),
        examples.given(1, FACTORS),
        1e-3,
        *made(block_shapes(len(size), 2)),
        *made(scratch_shapes(len(size), 2)),
        *made(rigs_shapes(len(size), 1, 2)),
    ),
    *SIZES,
)
def run_rigs(
    size, numbers, factors, rtol,
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
):  # fmt: skip
    """Rigs that differ from the nominal one by `factors`, (n, FACTORS): of its parameters, and of both rotors' τ.

    Controller and trim are those of the nominal rig, as `update` has left them in the block that is given. Filled:
    `rig_poles`, (n, order), the linear loops' own, slowest first, its columns as many as the nominal loop's connected
    states; `angles`, (n, 2, times), θ and ψ, NaN where a response was given up; `stable` and `within`, (n,), 1 or 0:
    whether no motor met its limit at these times and pitch no stop. The block is only read; all else is scratch.
    """
    kind, order, placed = (
        kind_of_loop(numbers),
        estimator_order(numbers, actuators),
        numbers[ROTORS_PLACED] != 0.0,
    )
    estimator_matrices(numbers, A, B, actuators, L, estimator)
    rig_numbers(numbers, rig)
    more_constants(numbers, trim, actuators, estimator, order, squares, more)
    nothing[0] = nothing[1] = 0.0
    experiment_numbers(numbers, kind, K, integral, -1, x)
    inner_start(numbers, trim, x, nothing, order, inner)
    nonlinear_loop(
        size, read_only(rig), read_only(trim), numbers[ANGLE], read_only(law), read_only(by_reference),
        read_only(integral), x, read_only(more), c, m,
    )  # fmt: skip
    law_by_states(law, polynomial_law)
    controller_numbers(numbers, A, B, actuators, K, proportional, integral, kind, L, order, controller)
    copy_into(c, own)
    copy_into(numbers, one)
    copy_into(actuators, rig_actuators)
    most = int(numbers[MOST_STEPS])
    for i in range(len(factors)):
        for k in range(12):
            one[PARAMETERS + k] = numbers[PARAMETERS + k] * factors[i, k]
        for k in range(2):
            rig_actuators[k] = actuators[k] * factors[i, 12 + k]
        rig_model(one[PARAMETERS : PARAMETERS + 12], numbers[ANGLE], rig_A, rig_B, rig_trim)
        for j in range(4):
            for k in range(2):
                inputs[j, k] = rig_B[j, k] * actuators[SLOPE + k]
        # the linear loop
        loop = f_whole
        if is_simple(placed, order, actuators):
            polynomial_matrices(read_only(rig_A), read_only(inputs), read_only(polynomial_law), f)
            loop = f
        else:
            fill_polynomials(rig_A, inputs, rig_actuators, controller, rows, minors, f_whole)
        stable[i] = 1.0 if is_stable(read_only(loop), p) else 0.0
        whole_loop(rig_A, rig_B, rig_actuators, by_reference, kind, estimator, order, law, rig_whole, rig_driven,
                   motor_columns)  # fmt: skip
        states, _ = connected_states(len(size), actuators, kind, integral, order, rig_whole, squares[0])
        if not poles_of(squares[0], states, squares[0], column, rig_poles[i]):
            for k in range(states):
                rig_poles[i, k] = nan
        # the rig itself
        rig_numbers(one, rig)
        for k in range(len(rig)):
            own[k] = rig[k]
        if len(size) > PLAIN:
            own[TAU], own[TAU + 1] = rig_actuators[0], rig_actuators[1]
        copy_into(m, modes)
        for k in range(len(size)):
            y[k] = x[START + k] if k < 4 else inner[1, k - PLAIN] if k >= PLAIN else 0.0
        _, done, _, _, impacts = integrate(
            size, y, times, own, modes, rtol, ABSOLUTE_TOLERANCE * rtol, most, w, course_of_rig
        )
        free = impacts == 0 and done == len(times)
        for k in range(len(times)):
            if k >= done:
                angles[i, 0, k] = angles[i, 1, k] = nan
                continue
            state = course_of_rig[k]
            angles[i, 0, k], angles[i, 1, k] = state[0], state[1]
            for motor in range(2):
                if abs(commanded_voltage(size, state, motor, own)) > own[LIMIT + motor]:
                    free = False
        within[i] = 1.0 if free else 0.0
