"""Whole experiments: the linear and the nonlinear response to one step each, and all that is measured on them."""

from __future__ import annotations

from math import nan

from ..layout import (
    AUGMENTED,
    DEVIATION,
    DIVERGED,
    HELD,
    IMPACTS,
    LIMIT,
    OUTCOME,
    REFERENCE,
    SHARE,
    START,
)
from .dormand_prince import integrate
from .jit import kernel
from .linear import respond
from .loop import augment, compose
from .measures import hold, measure, share_at_limit, trajectories


@kernel
def run_linear(theta_0, law, by_reference, whole, driven, x, t, w, states, voltages):
    """The loop without limits, exact: absolute states, (7, samples), and voltages; the first sample that is held.

    Scratch: `w`, LINEAR_WORKSPACE.
    """
    M, outputs = w[:AUGMENTED], w[AUGMENTED : AUGMENTED + 2]
    augment(theta_0, law, by_reference, whole, driven, x, M, outputs, states)
    respond(M, t[1], outputs, w[AUGMENTED + 2 :], states, voltages)
    for k in range(len(t)):
        states[0, k] += theta_0
    return hold(states, voltages, DIVERGED)


@kernel
def run_nonlinear(c, m, x, t, rtol, atol, most_steps, w, raw, states, voltages):
    """The rig within its limits: states, (6, samples), and voltages; the first held, the outcome, impacts.

    Scratch: `w`, WORKSPACE, and `raw`, (samples, 6).
    """
    y = w[16, :6]
    for i in range(6):
        y[i] = x[START + i] if i < 4 else 0.0
    outcome, done, _, _, impacts = integrate(y, t, c, m, rtol, atol, most_steps, w, raw)
    for k in range(done, len(t)):
        for i in range(6):
            raw[k, i] = nan
    trajectories(raw, c, states, voltages)
    return hold(states, voltages, DIVERGED), outcome, impacts


@kernel
def run_experiments(
    rig, trim, theta_0, law, by_reference, integral, whole, driven,
    experiments, t, rtol, atol, most_steps, w, v, c, m, raw, zeros,
    linear, nonlinear, voltages, axes, motors, courses,
):  # fmt: skip
    """Both responses to each row of `experiments`, (n, EXPERIMENT), and their measures.

    Filled, with n in front: states `linear` (7, samples) and `nonlinear` (6, samples); and by model `voltages`
    (2, 2, samples), `axes` (2, 2, AXIS_METRICS), `motors` (2, 2, MOTOR_METRICS), `courses` (2, COURSE).
    """
    for n in range(len(experiments)):
        x = experiments[n]
        held = run_linear(theta_0, law, by_reference, whole, driven, x, t, v, linear[n], voltages[n, 0])
        courses[n, 0, HELD], courses[n, 0, OUTCOME], courses[n, 0, IMPACTS] = held, 0, 0
        courses[n, 0, SHARE] = courses[n, 0, SHARE + 1] = 0.0
        compose(rig, trim, theta_0, law, by_reference, integral, x, c, m)
        held, outcome, impacts = run_nonlinear(
            c, m, x, t, rtol, atol, most_steps, w, raw, nonlinear[n], voltages[n, 1]
        )
        courses[n, 1, HELD], courses[n, 1, OUTCOME], courses[n, 1, IMPACTS] = held, outcome, impacts
        for i in range(2):
            courses[n, 1, SHARE + i] = share_at_limit(voltages[n, 1, i], c[LIMIT + i])
        start, reference = (x[START], x[START + 1]), (x[REFERENCE], x[REFERENCE + 1])
        for model in range(2):
            angles = linear[n] if model == 0 else nonlinear[n]
            rest = zeros if model == 0 else trim
            pitch, yaw = measure(
                t, angles, voltages[n, model], start, reference, rest, axes[n, model], motors[n, model]
            )
            courses[n, model, DEVIATION], courses[n, model, DEVIATION + 1] = pitch, yaw
