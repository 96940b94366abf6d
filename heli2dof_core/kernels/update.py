"""Everything that a change of a design changes, in one call: from `update_layout`'s numbers to its block."""

from __future__ import annotations

from math import inf, isnan, nan

from . import examples
from .augmented import (
    controller_numbers,
    estimator_matrices,
    estimator_order,
    more_constants,
    observer,
    sampled_estimator,
    voltages_by_state,
    whole_loop,
)
from .eigenvalues import eigenvalues
from .experiments import (
    controller_settings,
    copy_run,
    experiment_numbers,
    fill_times,
    run_of_linear_model,
    run_of_rig,
)
from .frequency import margins as fill_margins
from .jit import copy_into, entry_point, general, read_only
from .lag import lag_margin as least_lag
from .layout import ALL_STATES, KIND, KIND_ROW, OBSERVED, OWN, PI, SIZES, STATIC
from .loop import pi_gains
from .peaks import sensitivity_peaks
from .placing import SLOPE as SLOPES
from .placing import (
    TAU,
    aimed_pole,
    closed_loop,
    is_plain,
    judge,
    measure_gain,
    place,
    steady_state_determinant,
)
from .polynomials import polynomial_matrices
from .stability import is_stable
from .update_layout import (
    AIMS,
    ASKED,
    CONNECTED,
    CROSSWISE,
    DECOUPLED,
    DETERMINANT,
    DIGITAL,
    DISTURBED,
    DONE,
    DURATION,
    EACH_AXIS,
    GIVEN_INTEGRAL,
    LAG_MARGIN,
    MEASURED,
    NO_EIGENVALUES,
    OWN_INTEGRAL,
    PARAMETERS,
    PI_GAINS,
    PI_LOOPS,
    PLACED_STABLE,
    ROTORS_PLACED,
    SAMPLE_TIME,
    STABLE,
    WITHOUT_LAG_MARGIN,
    WITHOUT_LINEAR,
    WITHOUT_MARGINS,
    WITHOUT_RIG,
    WITHOUT_SCENARIO,
    WITHOUT_UNSTABLE,
    block_shapes,
    made,
    scratch_shapes,
)
from .whole import whole_polynomials


@entry_point(
    lambda size: (
        size,
        examples.numbers(),
        examples.zeros(1, 2),
        *made(block_shapes(len(size), 2)),
        *made(scratch_shapes(len(size), 2)),
    ),
    *SIZES,
)
def update(
    size, numbers, noise,
    outcome, A, B, trim, actuators, K, inverse, closed, own_poles, figures, proportional, integral,
    feedforward, by_reference, law, whole, driven, poles, connected, L, estimator_poles, margins,
    sensitivity, t, experiments, linear, nonlinear, voltages, axes, motors, courses, calm_axes,
    calm_courses,
    w, v, ladder, nodes, followed, c, m, plant, free, raw, grid, sampled, held, f, opened, f_whole, inner_whole, rows,
    minors, p, lag, frequencies, controller, more, inner, settings, estimator, estimated, squares, column,
    motor_columns, polynomial_law, inputs, nothing, rig, gains, vectors, exponential, size_of_exponential,
    start, work,
):  # fmt: skip
    """Fills the block of `block_shapes` from `numbers`, NUMBERS of them; see `update_layout` for both.

    `noise`, (samples of the controller, 2), is added to the angles that a digital controller measures, rad. The names
    behind the block's are scratch. Where the outcome is not DONE, nothing else is to be read.
    """
    placed, order = numbers[ROTORS_PLACED] != 0.0, 0
    outcome[0], outcome[1] = place(numbers, A, B, trim, actuators, K, inverse, work), 0.0
    if outcome[0] != DONE:
        return
    for i in range(2):
        nothing[i] = 0.0
        for j in range(4):
            inputs[j, i] = B[j, i] * actuators[SLOPES + i]
    thrust = inputs if placed else B
    figures[DETERMINANT] = steady_state_determinant(numbers, A, thrust, actuators, K, inverse)
    measure_gain(numbers, A, B, actuators, K, inverse, figures)
    count = closed_loop(A, thrust, placed, actuators, K, squares[0], squares[1])
    own, terms = squares[0, :count, :count], squares[1, :count, :count]
    found = judge(numbers, count, own, terms, column, squares[2:], vectors, closed, figures)
    if not (found and poles_of(A, 4, squares[0], column, own_poles)):
        outcome[0] = float(NO_EIGENVALUES)
        return
    # the outer loop
    kind = kind_of_loop(numbers)
    for i in range(2):
        gains[i, 0] = numbers[PI_GAINS + 2 * i]
        gains[i, 1] = gains[i, 0] / numbers[PI_GAINS + 2 * i + 1]
        for j in range(2):
            proportional[i, j] = 0.0
            feedforward[i, j] = inverse[i, j] if kind == STATIC else 0.0
            integral[i, j] = numbers[GIVEN_INTEGRAL + 2 * i + j] if kind == OWN else 0.0
    if kind == PI:
        both = B[2, 0] * B[3, 1] - B[2, 1] * B[3, 0]
        crosswise, decoupled = numbers[CROSSWISE] != 0.0, numbers[DECOUPLED] != 0.0
        pi_gains(inverse, figures[DETERMINANT], both, gains, crosswise, decoupled, proportional, integral)
    for i in range(2):
        for j in range(2):
            by_reference[i, j] = proportional[i, j] + feedforward[i, j]
    # the whole loop
    order = estimator_order(numbers, actuators)
    if order > 0:
        if numbers[MEASURED] == OBSERVED:
            observer(numbers, work, L)
        estimator_matrices(numbers, A, B, actuators, L, estimator)
        if not poles_of(estimator, 4, squares[0], column, estimator_poles):
            outcome[0] = float(NO_EIGENVALUES)
            return
    voltages_by_state(numbers, K, proportional, integral, kind, estimator, order, law)
    whole_loop(A, B, actuators, by_reference, kind, estimator, order, law, whole, driven, motor_columns)
    states, apart = connected_states(len(size), actuators, kind, integral, order, whole, squares[0])
    if not poles_of(squares[0], states, squares[0], column, connected):
        outcome[0] = float(NO_EIGENVALUES)
        return
    figures[CONNECTED] = states
    with_zeros(connected, states, apart, poles)
    # judgements
    controller_numbers(numbers, A, B, actuators, K, proportional, integral, kind, L, order, controller)
    loop = f_whole
    if is_simple(placed, order, actuators):
        law_by_states(law, polynomial_law)
        polynomial_matrices(read_only(A), read_only(inputs), read_only(polynomial_law), f)
        loop = f
    else:
        fill_polynomials(A, inputs, actuators, controller, rows, minors, f_whole)
    stable = is_stable(read_only(loop), p)
    if numbers[AIMS] != 0.0:
        figures[PLACED_STABLE] = 1.0 if aims_left(numbers, figures) else 0.0
    else:
        alone = opened
        if placed:
            alone = inner_whole
            controller_alone(K, controller)
            fill_polynomials(A, inputs, actuators, controller, rows, minors, inner_whole)
        else:
            for i in range(2):
                for j in range(6):
                    polynomial_law[i, j] = -K[i, j] if j < 4 else 0.0
            polynomial_matrices(read_only(A), read_only(B), read_only(polynomial_law), opened)
        figures[PLACED_STABLE] = 1.0 if is_stable(read_only(alone), p) else 0.0
    plain = is_plain(actuators)
    outer = states > (6 if placed else 4)
    for i in range(2):
        for j in range(2):
            outer = outer or proportional[i, j] != 0.0
    if (plain or placed) and order == 0 and not outer:
        stable = stable and figures[PLACED_STABLE] != 0.0
    figures[STABLE] = 1.0 if stable else 0.0
    start_lag = max(actuators[TAU], actuators[TAU + 1]) if placed else 0.0
    figures[LAG_MARGIN] = nan
    if numbers[WITHOUT_LAG_MARGIN] == 0.0:
        least = least_lag(read_only(loop), start_lag, lag)
        figures[LAG_MARGIN] = least if least > start_lag or stable else inf
    for i in range(2):
        for j in range(margins.shape[1]):
            margins[i, j] = nan
    for j in range(len(sensitivity)):
        sensitivity[j] = nan
    if stable and numbers[WITHOUT_MARGINS] == 0.0:
        fill_margins(read_only(loop), opened, p, margins)
        sensitivity_peaks(read_only(loop), read_only(connected[:states]), frequencies, sensitivity)
    # experiments
    rig_numbers(numbers, rig)
    more_constants(numbers, trim, actuators, estimator, order, squares, more)
    fill_times(numbers[DURATION], t)
    if numbers[DIGITAL] != 0.0:
        period = numbers[SAMPLE_TIME]
        sampled_estimator(
            numbers, trim, estimator, order, period, size_of_exponential, exponential, estimated
        )
    runs = 0
    if not stable and numbers[WITHOUT_UNSTABLE] != 0.0:
        return
    for left_out in range(-1, 2):
        if left_out >= 0 and (numbers[EACH_AXIS] == 0.0 or isnan(numbers[ASKED + left_out])):
            continue
        if left_out < 0 and numbers[WITHOUT_SCENARIO] != 0.0:
            continue
        x, n = experiments[runs], runs
        experiment_numbers(numbers, kind, K, integral, 1 - left_out if left_out >= 0 else -1, x)
        if numbers[DIGITAL] != 0.0:
            controller_settings(numbers, trim, x, size_of_exponential, exponential, settings)
        if numbers[WITHOUT_LINEAR] == 0.0:
            run_of_linear_model(
                size, numbers, trim, law, by_reference, whole, driven, poles[: states + apart], order, x, t, inner,
                nothing, estimator, v, ladder, nodes, followed, linear[n], voltages[n, 0], axes[n, 0], motors[n, 0],
                courses[n, 0],
            )  # fmt: skip
        for disturbed in range(2):
            if numbers[WITHOUT_RIG] != 0.0 or (disturbed == 1 and numbers[DISTURBED] == 0.0):
                break
            run_of_rig(
                size, numbers, disturbed == 1, rig, trim, law, by_reference, integral, poles[: states + apart], order,
                x, more, t, noise, estimated, settings, inner, nothing, start, w, c, m, plant, free, raw, grid,
                sampled, held, followed, nonlinear[n], voltages[n, 1], axes[n, 1], motors[n, 1], courses[n, 1],
            )  # fmt: skip
            if disturbed == 0:
                copy_run(axes[n, 1], calm_axes[n])
                copy_into(courses[n, 1], calm_courses[n])
        runs += 1
    outcome[1] = runs


@general
def kind_of_loop(numbers):
    """What is around the state feedback: see `layout`."""
    return OWN if numbers[OWN_INTEGRAL] != 0.0 else PI if numbers[PI_LOOPS] != 0.0 else STATIC


@general
def is_simple(placed, order, actuators):
    """Whether `polynomials` has room for the loop: nothing is estimated, and no rotor takes time or is placed."""
    return order == 0 and not placed and actuators[TAU] == 0.0 and actuators[TAU + 1] == 0.0


@general
def law_by_states(law, by_six):
    """The first six columns of ∂u/∂ states: x and z."""
    for i in range(2):
        for j in range(6):
            by_six[i, j] = law[i, j]


@general
def fill_polynomials(A, inputs, actuators, controller, rows, minors, f):
    """The eight polynomials of `kernels.whole`."""
    tau = actuators[TAU : TAU + 2]
    whole_polynomials(read_only(A), read_only(inputs), read_only(tau), read_only(controller), rows, minors, f)


@general
def poles_of(matrix, n, work, column, found):
    """The eigenvalues of the first n rows and columns into `found`, slowest first; False where there are none.

    Scratch: `work`, which may be the matrix itself, and `column`.
    """
    for i in range(n):
        for j in range(n):
            work[i, j] = matrix[i, j]
    if not eigenvalues(work[:n, :n], column[0, :n], column[1, :n], column[2, :n]):
        return False
    for i in range(n):
        found[i] = complex(column[0, i], column[1, i])
    sort_slowest_first(found, n)
    return True


@general
def sort_slowest_first(poles, n):
    """By real parts from the right to the left, and of conjugates the upper first."""
    for i in range(1, n):
        pole, k = poles[i], i
        while k > 0 and (
            poles[k - 1].real < pole.real
            or (poles[k - 1].real == pole.real and poles[k - 1].imag < pole.imag)
        ):
            poles[k] = poles[k - 1]
            k -= 1
        poles[k] = pole


@general
def connected_states(n, actuators, kind, integral, order, whole, work):
    """The loop's A by its own states into `work`; how many they are, and how many integrals drive nothing.

    These are no part of a loop, nor are places that its rig leaves empty.
    """
    rows, apart = 0, 0
    for i in range(n):
        if not is_connected(i, actuators, kind, integral, order):
            if kind != STATIC and 4 <= i < 6:
                apart += 1
            continue
        columns = 0
        for j in range(n):
            if is_connected(j, actuators, kind, integral, order):
                work[rows, columns] = whole[i, j]
                columns += 1
        rows += 1
    return rows, apart


@general
def is_connected(i, actuators, kind, integral, order):
    """Whether the state at place i belongs to the loop."""
    if i < 4:
        return True
    if i < 6:
        return kind != STATIC and (integral[0, i - 4] != 0.0 or integral[1, i - 4] != 0.0)
    if i < 8:
        return actuators[TAU + i - 6] > 0.0
    return i < 8 + order


@general
def with_zeros(connected, states, apart, poles):
    """All poles: the connected ones and, at 0, those of integrals that drive nothing; slowest first."""
    for i in range(states):
        poles[i] = connected[i]
    for i in range(states, states + apart):
        poles[i] = 0.0
    if apart > 0:
        sort_slowest_first(poles, states + apart)


@general
def aims_left(numbers, figures):
    """Whether all poles asked for lie left of the imaginary axis."""
    stable = figures[DETERMINANT] != 0.0
    for i in range(6 if numbers[ROTORS_PLACED] != 0.0 else 4):
        stable = stable and aimed_pole(numbers, i).real < 0.0
    return stable


@general
def controller_alone(K, c):
    """State feedback without an outer loop, as `kernels.whole` takes it."""
    for i in range(len(c)):
        for j in range(c.shape[1]):
            c[i, j] = K[i, j] if i < 2 and j < 6 else 0.0
    c[KIND_ROW, KIND] = ALL_STATES


@general
def rig_numbers(numbers, rig):
    """`layout`'s constants of the rig, from K_PP on, of its parameters as they stand in `Parameters`."""
    for k in range(4):
        rig[k] = numbers[PARAMETERS + k]
    own = numbers[PARAMETERS + 4 :]
    mass, arm = own[2], own[3]
    rig[4], rig[5], rig[6] = own[0] + mass * (arm * arm), own[1], mass * (arm * arm)
    rig[7], rig[8], rig[9], rig[10] = mass * own[7] * arm, own[4], own[5], own[6]
