"""The rig as recorded: under held voltages, with sensitivities, or under references with its controller.

Between two samples the voltages are constant, so that the classical Runge–Kutta method with steps well below
the rig's own time constants is exact enough. It is applied to state and sensitivities together, which
gives the exact derivatives of the numerical solution.
"""

from __future__ import annotations

from math import ceil

from . import examples
from .digital import (
    initialize_controller,
    rig_without_feedback,
    sample_controller,
    sample_sensors,
    stop_at_travel,
)
from .dormand_prince import integrate
from .jit import copy_into, entry_point, kernel
from .layout import (
    ALPHA,
    B_P,
    B_Y,
    DELAY,
    J_Y,
    K_PP,
    K_PY,
    K_S,
    K_YP,
    K_YY,
    MGL,
    ML2,
    OFFSET,
    PAPER,
    RECORDED_WORKSPACE,
    SENSITIVITIES,
    TIME,
    TRAVEL,
    WANTED,
    WORKSPACE,
)
from .trigonometry import sine_and_cosine


@entry_point(
    lambda: (
        examples.given(1, 4),
        examples.bounds(),
        examples.times(),
        examples.given(2, 2),
        examples.constants(),
        1e-2,
        examples.zeros(*RECORDED_WORKSPACE),
        examples.zeros(2, 2),
        examples.zeros(2, 2, SENSITIVITIES),
    )
)
def run_segments(starts, bounds, t, volts, c, longest_step, w, outputs, slopes):
    """Stretches of a recording, each from a state of its own, driven by the recorded voltages.

    Segment i runs over the samples bounds[i, 0] ≤ k < bounds[i, 1] from starts[i] (θ, ψ, θ̇, ψ̇). Filled there:
    `outputs` (n, 2), θ and ψ; `slopes` (n, 2, SENSITIVITIES), their derivatives by the starting state and
    by K_pp, K_py, K_yp, K_yy, B_p, B_y, K_s. Scratch: `w`, (4, SENSITIVITIES + 1, 4).
    """
    state, stage, slope, total = w[0], w[1], w[2], w[3]
    for i in range(len(starts)):
        first, last = bounds[i, 0], bounds[i, 1]
        begin_sensitivities(starts[i], SENSITIVITIES + 1, state)
        for k in range(first, last):
            for axis in range(2):
                outputs[k, axis] = state[0, axis]
                for row in range(SENSITIVITIES):
                    slopes[k, axis, row] = state[row + 1, axis]
            if k + 1 < last:
                steps = max(1, ceil((t[k + 1] - t[k]) / longest_step))
                h = (t[k + 1] - t[k]) / steps
                for _ in range(steps):
                    runge_kutta_4_step(
                        h, volts[k, 0], volts[k, 1], c, SENSITIVITIES + 1, state, stage, slope, total
                    )


@entry_point(
    lambda: (
        examples.zeros(4),
        examples.times(),
        examples.given(2, 2),
        examples.constants(),
        1e-2,
        examples.zeros(*RECORDED_WORKSPACE),
        examples.zeros(2, 4),
    )
)
def run_held(start, t, volts, c, longest_step, w, states):
    """States (n, 4) at all t from `start`, driven by the recorded voltages; pitch is stopped at ±c[TRAVEL].

    Scratch: `w`, (4, SENSITIVITIES + 1, 4).
    """
    state, stage, slope, total = w[0], w[1], w[2], w[3]
    copy_into(start, state[0])
    stop_at_travel(state[0], c)
    for k in range(len(t)):
        copy_into(state[0], states[k])
        if k + 1 < len(t):
            steps = max(1, ceil((t[k + 1] - t[k]) / longest_step))
            h = (t[k + 1] - t[k]) / steps
            for _ in range(steps):
                runge_kutta_4_step(h, volts[k, 0], volts[k, 1], c, 1, state, stage, slope, total)
                bound_travel(state[0], c)


@kernel
def begin_sensitivities(start, rows, state):
    """The state and its derivatives, by itself first, where a segment begins."""
    for row in range(rows):
        for j in range(4):
            state[row, j] = 1.0 if row == j + 1 else 0.0
    copy_into(start, state[0])


@kernel
def bound_travel(y, c):
    """Pitch beyond a stop stands at it, and moves no farther."""
    if abs(y[0]) > c[TRAVEL]:
        side = 1.0 if y[0] > 0.0 else -1.0
        y[0] = side * c[TRAVEL]
        if side * y[2] > 0.0:
            y[2] = 0.0


@kernel
def runge_kutta_4_step(h, V_p, V_y, c, rows, state, stage, slope, total):
    """One step of the classical Runge–Kutta method on the first `rows` of `state`."""
    variational_equations(state, V_p, V_y, c, rows, slope)
    for row in range(rows):
        for j in range(4):
            total[row, j] = slope[row, j]
            stage[row, j] = state[row, j] + 0.5 * h * slope[row, j]
    for part in range(2):
        variational_equations(stage, V_p, V_y, c, rows, slope)
        share = 0.5 * h if part == 0 else h
        for row in range(rows):
            for j in range(4):
                total[row, j] += 2.0 * slope[row, j]
                stage[row, j] = state[row, j] + share * slope[row, j]
    variational_equations(stage, V_p, V_y, c, rows, slope)
    for row in range(rows):
        for j in range(4):
            state[row, j] += h / 6.0 * (total[row, j] + slope[row, j])


@kernel
def variational_equations(x, V_p, V_y, c, rows, out):
    """Rates of the state x[0] and of its derivatives x[1:rows] (variational equations of Eqs. 9–12)."""
    theta, theta_dot, psi_dot = x[0, 0], x[0, 2], x[0, 3]
    (sine, cosine), ml2 = sine_and_cosine(theta), c[ML2]
    sway, turn = ml2 * sine * cosine, ml2 * (cosine * cosine - sine * sine)
    alpha, beta = c[ALPHA], c[J_Y] + ml2 * cosine * cosine
    pitch = c[K_PP] * V_p + c[K_PY] * V_y - c[B_P] * theta_dot - c[K_S] * theta
    pitch = (pitch - sway * psi_dot * psi_dot - c[MGL] * cosine) / alpha
    yaw = c[K_YP] * V_p + c[K_YY] * V_y - c[B_Y] * psi_dot + 2.0 * sway * theta_dot * psi_dot
    yaw /= beta
    out[0, 0], out[0, 1], out[0, 2], out[0, 3] = theta_dot, psi_dot, pitch, yaw
    if rows == 1:
        return
    by_theta = (c[MGL] * sine - c[K_S] - turn * psi_dot * psi_dot) / alpha
    by_theta_dot, by_psi_dot = -c[B_P] / alpha, -2.0 * sway * psi_dot / alpha
    yaw_theta = 2.0 * (turn * theta_dot * psi_dot + sway * yaw) / beta
    yaw_theta_dot, yaw_psi_dot = 2.0 * sway * psi_dot / beta, (2.0 * sway * theta_dot - c[B_Y]) / beta
    for row in range(1, rows):
        a, v, w = x[row, 0], x[row, 2], x[row, 3]
        out[row, 0], out[row, 1] = v, w
        out[row, 2] = by_theta * a + by_theta_dot * v + by_psi_dot * w
        out[row, 3] = yaw_theta * a + yaw_theta_dot * v + yaw_psi_dot * w
    out[5, 2] += V_p / alpha
    out[6, 2] += V_y / alpha
    out[7, 3] += V_p / beta
    out[8, 3] += V_y / beta
    out[9, 2] -= theta_dot / alpha
    out[10, 3] -= psi_dot / beta
    out[11, 2] -= theta / alpha


@entry_point(
    lambda: (
        examples.zeros(6),
        examples.constants(),
        examples.modes(),
        examples.settings(),
        *(examples.given(1, 2) for _ in range(3)),
        *examples.NUMBERS,
        examples.zeros(*WORKSPACE),
        examples.constants(),
        examples.constants(),
        examples.modes(),
        examples.zeros(2),
        examples.zeros(2, 6),
        examples.zeros(1, 2),
        examples.zeros(1, 6),
        examples.zeros(1, 2),
    )
)
def run_recorder(
    y, c, m, d, noise, references, offsets, rtol, atol, most_steps,
    w, own, plant, free, grid, course, measured, states, voltages,
):  # fmt: skip
    """The digital rig under changing references, with what its controller measured at each of its samples.

    `references` and `offsets`, (n, 2): c's WANTED and OFFSET from sample k on; `noise`, (n, 2), rad. Filled, with a
    row per sample: `measured` and `voltages` (n, 2), `states` (n, 6). Scratch: `w` of zeros, `own`, `plant` like c,
    `free` like m, `grid` (2,), `course` (2, 6). Returns the outcome, the samples filled and the impacts.
    """
    copy_into(c, own)
    rig_without_feedback(PAPER, c, m, plant, free)
    filters, seen, held, waiting = w[16:18], w[18], w[19], w[20]
    initialize_controller(y, c, d, filters, held)
    impacts = 0
    for k in range(len(references)):
        for i in range(2):
            own[WANTED + i], own[OFFSET + i] = references[k, i], offsets[k, i]
        copy_into(y, states[k])
        sample_sensors(y, d, filters, noise[k], seen)
        sample_controller(PAPER, y, own, m, d, seen, w[21], waiting)
        if d[DELAY] == 0.0:
            held[0], held[1] = waiting[0], waiting[1]
        for i in range(2):
            measured[k, i], voltages[k, i] = seen[i], held[i]
            plant[OFFSET + i] = held[i]
        z0, z1 = y[4], y[5]
        grid[0], grid[1] = k * d[TIME], (k + 1) * d[TIME]
        outcome, _, _, _, hits = integrate(PAPER, y, grid, plant, free, rtol, atol, most_steps, w, course)
        y[4], y[5] = z0, z1
        impacts += hits
        if outcome != 0:
            return outcome, k + 1, impacts
        held[0], held[1] = waiting[0], waiting[1]
    return 0, len(references), impacts
