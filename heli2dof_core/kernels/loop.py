"""The loop put together: from K and the outer loop's settings to matrices, and to the constants of `kernels.rig`."""

from __future__ import annotations

from . import examples
from .jit import entry_point, kernel
from .layout import (
    ANTI_WINDUP,
    BACK,
    BOUND,
    CONSTANTS,
    DISTURBANCE,
    FED,
    GAIN,
    INNER,
    LIMIT,
    MORE_GAIN,
    MOTOR_OF,
    OFFSET,
    PI,
    PLAIN,
    REFERENCE,
    SIDE,
    SIZES,
    SLIP,
    START,
    STATIC,
    STOP,
    TORQUE,
    TRACKING,
    TRAVEL,
    VOLTS,
    WANTED,
    WINDUP,
    ZONE,
)


@entry_point(
    lambda: (
        examples.given(2, 4),
        examples.given(2, 2),
        1.0,
        *examples.plant(),
        PI,
        examples.zeros(2, 2),
        False,
        False,
        *examples.zeros(3, 2, 2),
        examples.zeros(2, 6),
        examples.zeros(2, 2),
        examples.zeros(6, 6),
        examples.zeros(6, 2),
    )
)
def loop_matrices(
    K,
    inverse,
    determinant,
    A,
    B,
    kind,
    gains,
    cross,
    decoupler,
    proportional,
    integral,
    feedforward,
    law,
    by_reference,
    whole,
    driven,
):
    """The outer loop around u = −Kx + v: its gains, and the whole loop's matrices, into all from `proportional` on.

    `inverse` is Ĝ(0)⁻¹ and `determinant` its own, 0 where a pole of A − BK lies at 0; `gains` holds kp and kp/ti of
    pitch and of yaw. `kind` OWN leaves `integral` as it is.
    `law` is ∂u/∂[x, z], (2, n), `by_reference` ∂u/∂r; `whole` (n, n) and `driven` (n, 2) are A and B of the loop.
    """
    for i in range(2):
        for j in range(2):
            proportional[i, j] = feedforward[i, j] = 0.0
            if kind == STATIC:
                feedforward[i, j] = inverse[i, j]
    if kind == PI:
        thrust = B[2, 0] * B[3, 1] - B[2, 1] * B[3, 0]
        pi_gains(inverse, determinant, thrust, gains, cross, decoupler, proportional, integral)
    order = law.shape[1]
    for i in range(2):
        for j in range(4):
            law[i, j] = -K[i, j]
        for j in range(2):
            law[i, j] -= proportional[i, j]
            by_reference[i, j] = proportional[i, j] + feedforward[i, j]
            if order == 6:
                law[i, 4 + j] = integral[i, j]
    for i in range(order):
        for j in range(order):
            whole[i, j] = A[i, j] if i < 4 and j < 4 else 0.0
            if i < 4:
                whole[i, j] += B[i, 0] * law[0, j] + B[i, 1] * law[1, j]
        for j in range(2):
            driven[i, j] = B[i, 0] * by_reference[0, j] + B[i, 1] * by_reference[1, j] if i < 4 else 0.0
    if order == 6:
        for i in range(2):
            whole[4 + i, i], driven[4 + i, i] = -1.0, 1.0


@kernel
def pi_gains(inverse, determinant, thrust, gains, cross, decoupler, proportional, integral):
    """Which motor each PI controller drives, and with which sign: V/rad and V/(rad·s) per error.

    Without steady state there is nothing to decouple, and signs are those that stable poles near 0 would give:
    det Ĝ(0)⁻¹ is the product of the poles by the determinant of `thrust`.
    """
    # Ĝ(0) = [[d, −b], [−c, a]]/det; only the determinant's sign matters here, and its size where decoupled
    sign = -1.0 if (determinant if determinant != 0.0 else thrust) < 0.0 else 1.0
    if cross:
        pitch, yaw = -sign * inverse[0, 1], -sign * inverse[1, 0]
    else:
        pitch, yaw = sign * inverse[1, 1], sign * inverse[0, 0]
    for j in range(2):
        paired = pitch if j == 0 else yaw
        for i in range(2):
            if decoupler and determinant != 0.0:
                weight = inverse[i, j] * abs(paired) / abs(determinant)
            elif cross:
                weight = 0.0 if i == j else (-1.0 if paired < 0.0 else 1.0)
            else:
                weight = 1.0 if i == j else 0.0
            proportional[i, j], integral[i, j] = weight * gains[j, 0], weight * gains[j, 1]


@entry_point(
    lambda size: (
        size,
        examples.rig(),
        examples.trim(),
        0.0,
        examples.given(2, len(size)),
        examples.given(2, 2),
        examples.given(2, 2),
        examples.experiment(),
        examples.more(),
        examples.constants(size),
        examples.modes(size),
    ),
    *SIZES,
)
def nonlinear_loop(size, rig, trim, theta_0, law, by_reference, integral, x, more, c, m):
    """Constants c and modes m of the loop around the nonlinear rig; its deviations become absolute angles and speeds.

    `trim` are the motors' voltages at rest. Where the size is not PLAIN, `more` is what c goes on with, but for the
    gains on the states behind the sixth, which are the law's, (2, len(size)).
    """
    order = law.shape[1]
    for k in range(len(rig)):
        c[k] = rig[k]
    for i in range(2):
        for j in range(6):
            c[GAIN + 6 * i + j] = law[i, j] if j < order else 0.0
        c[OFFSET + i] = by_reference[i, 0] * (x[REFERENCE] - theta_0) + by_reference[i, 1] * x[REFERENCE + 1]
        c[OFFSET + i] += x[FED] * trim[i] - law[i, 0] * theta_0
        c[LIMIT + i], c[WANTED + i] = x[BOUND + i], x[REFERENCE + i]
        c[DISTURBANCE + i], c[TORQUE + i] = x[VOLTS + i], 0.0
        m[i], m[SIDE + i] = 0, 1
        # each integrator's motor is the one that it drives in the main
        m[MOTOR_OF + i] = 1 if abs(integral[1, i]) > abs(integral[0, i]) else 0
    if order == 4:
        m[MOTOR_OF], m[MOTOR_OF + 1] = 0, 1
    for k in range(4):
        c[TRACKING + k] = x[BACK + k]
    c[TRAVEL] = x[STOP]
    m[SIDE + 2] = 0
    m[WINDUP] = int(x[ANTI_WINDUP])
    if len(size) > PLAIN:
        for k in range(len(more)):
            c[CONSTANTS + k] = more[k]
        for i in range(2):
            m[ZONE + i] = m[SLIP + i] = 1
            for j in range(INNER):
                c[MORE_GAIN + INNER * i + j] = law[i, 6 + j] if 6 + j < order else 0.0
            c[OFFSET + i] -= law[i, 6] * trim[0] + law[i, 7] * trim[1]


@kernel
def augmented_system(size, theta_0, law, by_reference, whole, driven, x, inner, M, outputs, states):
    """The linear loop with the constant 1 as last state, in deviations from (θ₀, 0): M, voltages' rows, start."""
    order, last, reference = len(whole), len(size), (x[REFERENCE] - theta_0, x[REFERENCE + 1])
    for i in range(last + 1):
        for j in range(last + 1):
            M[i, j] = whole[i, j] if i < order and j < order else 0.0
        if i < order:
            M[i, last] = driven[i, 0] * reference[0] + driven[i, 1] * reference[1]
        states[i, 0] = x[START + i] if i < 4 else inner[i - 6] if 6 <= i < last else 0.0
    for i in range(2):
        for j in range(last + 1):
            outputs[i, j] = law[i, j] if j < order else 0.0
        outputs[i, last] = by_reference[i, 0] * reference[0] + by_reference[i, 1] * reference[1]
    states[0, 0] -= theta_0
    states[last, 0] = 1.0
