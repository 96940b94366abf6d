"""The whole loop's matrices, with rotors that lag and an estimator, every state at its place (`layout`)."""

from __future__ import annotations

from math import floor

from .derived import full_rank_observer
from .jit import keep_apart, kernel
from .layout import (
    ALL_STATES,
    BOUND,
    BY_ANGLES,
    BY_INTEGRALS,
    CONSTANTS,
    ESTIMATOR,
    FED,
    FILTER_DAMPING,
    FILTER_FREQUENCY,
    FILTERED_RATES,
    FULL,
    K_STATES,
    KIND,
    KIND_ROW,
    LAGGED,
    OBSERVED,
    OBSERVER_ROW,
    OMEGA,
    OWN_A,
    OWN_B,
    OWN_L,
    OWN_L_ANGLES,
    OWN_TAU,
    PLAIN,
    START,
    STATIC,
    STOP,
    TAU,
    USUAL,
    ZETA,
)
from .linear import matrix_exponential
from .placing import SLOPE
from .update_layout import (
    ANGLE,
    BY_ANGLE,
    BY_STATE,
    ESTIMATOR_COLUMNS,
    ESTIMATOR_F,
    ESTIMATOR_G,
    ESTIMATOR_H,
    GIVEN_L,
    L_GIVEN,
    MEASURED,
    OBSERVER_POLES,
    PARAMETERS,
    ROTORS_PLACED,
)


@kernel
def estimator_order(numbers, actuators):
    """States of what estimates: 0 where the states are measured, 6 where it tells the rotors' speeds, too."""
    if numbers[MEASURED] == ALL_STATES:
        return 0
    lags = actuators[0] != 0.0 or actuators[1] != 0.0
    return 6 if numbers[MEASURED] == OBSERVED and numbers[ROTORS_PLACED] != 0.0 and lags else 4


@kernel
def observer(numbers, d, L):
    """L by the closed form, or as it is given; scratch: `d`, of 4."""
    if numbers[L_GIVEN] != 0.0:
        for i in range(4):
            L[i, 0], L[i, 1] = numbers[GIVEN_L + 2 * i], numbers[GIVEN_L + 2 * i + 1]
        return
    for pair in range(2):
        at = OBSERVER_POLES + 4 * pair
        re, im = numbers[at], numbers[at + 1]
        if im == 0.0:
            d[2 * pair], d[2 * pair + 1] = re * numbers[at + 2], -(re + numbers[at + 2])
        else:
            d[2 * pair], d[2 * pair + 1] = re * re + im * im, -2.0 * re
    p = numbers[PARAMETERS : PARAMETERS + 12]
    full_rank_observer(d[:4], p, numbers[ANGLE], L)


@kernel
def known_thrust(numbers, B, actuators, i, motor):
    """Of B as the observer knows it: with the thrust curve's slope where the rotors are placed."""
    return B[i, motor] * actuators[SLOPE + motor] if numbers[ROTORS_PLACED] != 0.0 else B[i, motor]


@kernel
def estimator_matrices(numbers, A, B, actuators, L, e):
    """F, G, H of what estimates the states, x̂ by its states and by the angles, into e (`estimators.Estimator`)."""
    keep_apart()
    for i in range(6):
        for j in range(ESTIMATOR_COLUMNS):
            e[i, j] = 0.0
    order = estimator_order(numbers, actuators)
    if numbers[MEASURED] == FILTERED_RATES:
        w, damping = FILTER_FREQUENCY, FILTER_DAMPING
        for axis in range(2):
            i = 2 * axis
            e[i, ESTIMATOR_F + i + 1], e[i + 1, ESTIMATOR_F + i] = w, -w
            e[i + 1, ESTIMATOR_F + i + 1], e[i + 1, ESTIMATOR_G + axis] = -2.0 * damping * w, w
            e[2 + axis, BY_STATE + i + 1], e[axis, BY_ANGLE + axis] = w, 1.0
        return
    for i in range(4):
        for j in range(4):
            e[i, ESTIMATOR_F + j] = A[i, j] - (L[i, j] if j < 2 else 0.0)
        for j in range(2):
            e[i, ESTIMATOR_G + j], own = L[i, j], known_thrust(numbers, B, actuators, i, j)
            if order == 6:
                e[i, ESTIMATOR_F + 4 + j] = own
            else:
                e[i, ESTIMATOR_H + j] = own
    for i in range(order):
        e[i, BY_STATE + i] = 1.0
    if order == 6:
        for j in range(2):
            e[4 + j, ESTIMATOR_F + 4 + j] = -1.0 / actuators[j]
            e[4 + j, ESTIMATOR_H + j] = 1.0 / actuators[j]


@kernel
def voltages_by_state(numbers, K, proportional, integral, kind, e, order, law):
    """∂u/∂ states, (2, n)."""
    n = law.shape[1]
    for i in range(2):
        for j in range(n):
            law[i, j] = 0.0
        if order == 0:
            for j in range(4):
                law[i, j] = -K[i, j]
        else:
            rows = order if numbers[MEASURED] == OBSERVED else 4
            for k in range(rows):
                for j in range(2):
                    law[i, j] -= K[i, k] * e[k, BY_ANGLE + j]
                for j in range(order):
                    law[i, LAGGED + j] -= K[i, k] * e[k, BY_STATE + j]
        if n > 6 and order < 6:
            law[i, 6], law[i, 7] = -K[i, 4], -K[i, 5]
        for j in range(2):
            law[i, j] -= proportional[i, j]
            law[i, 4 + j] = integral[i, j] if kind != STATIC else 0.0


@kernel
def whole_loop(A, B, actuators, by_reference, kind, e, order, law, whole, driven, motors):
    """A and B of the loop, (n, n) and (n, 2). Scratch: `motors`, (2, n, 2)."""
    n = len(whole)
    for i in range(n):
        for j in range(n):
            whole[i, j] = A[i, j] if i < 4 and j < 4 else 0.0
        for j in range(2):
            driven[i, j] = motors[0, i, j] = 0.0
            thrust = B[i, j] * actuators[SLOPE + j] if i < 4 else 0.0
            tau = actuators[j]
            if tau == 0.0:
                motors[0, i, j] = thrust
            elif i < 4:
                whole[i, 6 + j] = thrust
            elif i == 6 + j:
                whole[i, i], motors[0, i, j] = -1.0 / tau, 1.0 / tau
            motors[1, i, j] = motors[0, i, j]
    if kind != STATIC:
        for j in range(2):
            whole[4 + j, j], driven[4 + j, j] = -1.0, 1.0
    for i in range(order):
        for j in range(order):
            whole[LAGGED + i, LAGGED + j] = e[i, ESTIMATOR_F + j]
        for j in range(2):
            whole[LAGGED + i, j], motors[1, LAGGED + i, j] = e[i, ESTIMATOR_G + j], e[i, ESTIMATOR_H + j]
    for i in range(n):
        for motor in range(2):
            by = motors[1, i, motor]
            if by != 0.0:
                for j in range(n):
                    whole[i, j] += by * law[motor, j]
                for j in range(2):
                    driven[i, j] += by * by_reference[motor, j]


@kernel
def controller_numbers(numbers, A, B, actuators, K, proportional, integral, kind, L, order, c):
    """The law as `kernels.whole` takes it, (5, 10)."""
    for i in range(len(c)):
        for j in range(c.shape[1]):
            c[i, j] = 0.0
    for i in range(2):
        for j in range(6):
            c[i, K_STATES + j] = K[i, j]
        for j in range(2):
            c[i, BY_ANGLES + j] = -proportional[i, j]
            c[i, BY_INTEGRALS + j] = integral[i, j] if kind != STATIC else 0.0
    c[KIND_ROW, KIND] = numbers[MEASURED]
    if numbers[MEASURED] == FILTERED_RATES:
        c[KIND_ROW, OMEGA], c[KIND_ROW, ZETA] = FILTER_FREQUENCY, FILTER_DAMPING
    if numbers[MEASURED] == OBSERVED:
        for i in range(2):
            for j in range(4):
                c[OBSERVER_ROW + i, OWN_A + j] = A[2 + i, j]
            for j in range(2):
                c[OBSERVER_ROW + i, OWN_B + j] = known_thrust(numbers, B, actuators, 2 + i, j)
                c[OBSERVER_ROW + i, OWN_L + j], c[OBSERVER_ROW + i, OWN_L_ANGLES + j] = L[2 + i, j], L[i, j]
            c[KIND_ROW, OWN_TAU + i] = actuators[i] if order == 6 else 0.0


@kernel
def more_constants(numbers, trim, actuators, e, order, squares, more):
    """What `kernels.rig`'s constants go on with, from CONSTANTS on, but for the gains (`nonlinear_loop`)."""
    keep_apart()
    for k in range(len(more)):
        more[k] = 0.0
    for k in range(USUAL - CONSTANTS, len(more)):
        more[k] = 1.0
    for k in range(10):
        more[TAU - CONSTANTS + k] = actuators[k]
    for i in range(order):
        at, G, H = ESTIMATOR - CONSTANTS + (FULL + 3) * i, e[i, ESTIMATOR_G], e[i, ESTIMATOR_H]
        for j in range(order):
            more[at + LAGGED + j] = e[i, ESTIMATOR_F + j]
        for j in range(2):
            more[at + j], more[at + FULL + j] = e[i, ESTIMATOR_G + j], e[i, ESTIMATOR_H + j]
        more[at + FULL + 2] = -numbers[ANGLE] * G - (H * trim[0] + e[i, ESTIMATOR_H + 1] * trim[1])
    usual_sizes(e, order, squares, more[USUAL + 2 - CONSTANTS :])


@kernel
def usual_sizes(e, order, squares, sizes):
    """How large an estimator's states are, at most 1, where an angle rests at 1 rad or turns at 1 rad/s.

    Those of a filter are small numbers by which fast ones are told: their errors must be smaller still. Scratch:
    `squares`, (2, 14, 14).
    """
    F, rest = squares[0], squares[1]
    for again in range(2):
        for i in range(order):
            for j in range(order):
                F[i, j] = e[i, ESTIMATOR_F + j]
            for j in range(2):
                if again == 0:
                    rest[i, j] = e[i, ESTIMATOR_G + j]
                else:
                    rest[i, 2 + j] = rest[i, j]
        if not eliminate(order, 2 * (again + 1), F, rest, 2 * again):
            return
    for i in range(order):
        size = 0.0
        for j in range(4):
            size = max(size, abs(rest[i, j]))
        sizes[i] = min(size, 1.0) if size > 0.0 else 1.0


@kernel
def eliminate(n, end, a, b, first):
    """Solves a x = b for b's columns from `first` to `end`, in place, a overwritten; False where a is singular."""
    for step in range(n):
        pivot = step
        for i in range(step + 1, n):
            if abs(a[i, step]) > abs(a[pivot, step]):
                pivot = i
        if a[pivot, step] == 0.0:
            return False
        if pivot != step:
            for j in range(n):
                a[step, j], a[pivot, j] = a[pivot, j], a[step, j]
            for j in range(first, end):
                b[step, j], b[pivot, j] = b[pivot, j], b[step, j]
        for i in range(step + 1, n):
            factor = a[i, step] / a[step, step]
            for j in range(step, n):
                a[i, j] -= factor * a[step, j]
            for j in range(first, end):
                b[i, j] -= factor * b[step, j]
    for i in range(n - 1, -1, -1):
        for j in range(first, end):
            total = b[i, j]
            for k in range(i + 1, n):
                total -= a[i, k] * b[k, j]
            b[i, j] = total / a[i, i]
    return True


@kernel
def inner_start(numbers, trim, x, steps, order, inner):
    """Where the states behind the sixth start: of the linear model and of the rig, (2, INNER); `steps` of encoders.

    Rotors turn as the trim holds them that is fed forward, in the linear model as the trim; filters have settled at
    the measured angles, and an observer knows these and believes in rest.
    """
    keep_apart()
    for model in range(2):
        for j in range(inner.shape[1]):
            inner[model, j] = 0.0
    for motor in range(2):
        limit = x[BOUND + motor]
        inner[1, motor] = min(max(trim[motor] * x[FED], -limit), limit)
    if order == 0:
        return
    spread = 2 if numbers[MEASURED] == FILTERED_RATES else 1
    for axis in range(2):
        angle = x[START + axis]
        stopped = min(max(angle, -x[STOP]), x[STOP]) if axis == 0 else angle
        if steps[axis] > 0.0:
            stopped = steps[axis] * floor(stopped / steps[axis] + 0.5)
        base = numbers[ANGLE] if axis == 0 else 0.0
        inner[0, 2 + spread * axis], inner[1, 2 + spread * axis] = angle - base, stopped - base


@kernel
def sampled_estimator(numbers, trim, e, order, period, size, exponential, rows):
    """The estimator from one sample to the next, laid out as ESTIMATED says: exact for what is held between them."""
    keep_apart()
    for i in range(len(rows)):
        for j in range(rows.shape[1]):
            rows[i, j] = 0.0
    if order == 0:
        return
    n = order + 4
    M, step = exponential[:10], exponential[10:20]
    for i in range(n):
        for j in range(n):
            M[i, j] = 0.0
        if i < order:
            for j in range(order):
                M[i, j] = e[i, ESTIMATOR_F + j]
            for j in range(2):
                M[i, order + j], M[i, order + 2 + j] = e[i, ESTIMATOR_G + j], e[i, ESTIMATOR_H + j]
    matrix_exponential(size[: n - 1], M, period, step, exponential[20:])
    for i in range(order):
        for j in range(order):
            rows[i, j] = step[i, j]
        for j in range(4):
            rows[i, 6 + j] = step[i, order + j]
        fed = step[i, order + 2] * trim[0] + step[i, order + 3] * trim[1]
        rows[i, 10] = -numbers[ANGLE] * step[i, order] - fed


@kernel
def rate_filter(period, size, exponential):
    """F (2×2, row by row) and b of a rate filter: x⁺ = F x + b θ, exact for held angles."""
    keep_apart()
    M, step = exponential[:10], exponential[10:20]
    w = FILTER_FREQUENCY
    for i in range(PLAIN + 2):  # products know the paper's size, and larger ones
        for j in range(PLAIN + 2):
            M[i, j] = 0.0
    M[0, 1], M[1, 0], M[1, 1], M[1, 2] = 1.0, -w * w, -2.0 * FILTER_DAMPING * w, 1.0
    matrix_exponential(size[: PLAIN + 1], M, period, step, exponential[20:])
    return step[0, 0], step[0, 1], step[1, 0], step[1, 1], step[0, 2], step[1, 2]
