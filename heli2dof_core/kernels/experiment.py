"""Whole experiments: the linear and the nonlinear response to one step each, and all that is measured on them."""

from __future__ import annotations

from math import inf

from . import examples
from .dormand_prince import EVERYTHING, integrate_measured
from .exact import propagate_measured, settling_horizon, slowest_period
from .figures import confirm_settling, copy_figures, figures_of_merit, settling_check_end, start_figures
from .jit import copy_into, entry_point, keep_apart, kernel
from .layout import (
    DISTURBANCE,
    DIVERGED,
    ENDED,
    HELD,
    IMPACTS,
    OUT_OF_BOUNDS,
    OUTCOME,
    REACHED,
    REFERENCE,
    SIZES,
    START,
    TRAVEL,
    WORKSPACE,
)
from .linear import exact_response
from .loop import augmented_system
from .measures import hold_after_divergence, speeds_at_once, trajectories

ROUNDING = 1e-6
"""An overshoot of the exact response below this share of the step is none: with poles at −10⁵, it may be rounding."""
SEEN = 1e-4
"""The same of a simulation, whose own error is about its tolerance, whatever that is."""


@entry_point(
    lambda size: (
        size,
        0.0,
        examples.given(2, len(size)),
        examples.given(2, 2),
        examples.given(len(size), len(size)),
        examples.given(len(size), 2),
        examples.poles(),
        examples.experiment(),
        examples.inner(),
        examples.times(),
        10,
        examples.trim(),
        *examples.search(size),
        examples.zeros(len(size) + 1, 2),
        examples.zeros(2, 2),
        *examples.figures(),
    ),
    *SIZES,
)
def run_linear(
    size, theta_0, law, by_reference, whole, driven, poles, x, inner, t, most_steps, rest, w, ladder, nodes, f,
    states, voltages, axes, motors, course,
):  # fmt: skip
    """The loop without limits, exact: absolute states, (n, samples), voltages and figures of merit, as `layout` says.

    Voltages are deviations from those at rest, `rest`; the motors' figures are of both together.
    n is one more than the size; the last state is 1, those behind the sixth are deviations, from `inner` on. `whole`
    and `law` are of the size's order, or of 4 or 6 where that is PLAIN. `poles` are those of `whole`. Scratch: `w`,
    `ladder` and `nodes`, `layout.exact_shapes`, and `f`, twice FOLLOWED.
    """
    keep_apart()
    n = len(size) + 1
    M, outputs, slopes, scratch = w[:n], w[n : n + 2], w[n + 2 : n + 4], w[n + 4 :]
    augmented_system(size, theta_0, law, by_reference, whole, driven, x, inner, M, outputs, states)
    for i in range(n):
        nodes[i, 0] = states[i, 0]
        for j in range(2):
            total = 0.0
            for k in range(n):
                total += outputs[j, k] * M[k, i]
            slopes[j, i] = total
    exact_response(size, M, t[1], outputs, scratch, states, voltages)
    for j in range(2):
        outputs[j, len(size)] += rest[j]  # what is measured is the motors' whole voltage
    for k in range(len(t)):
        states[0, k] += theta_0
    own, ahead, end = f[:4], f[4:], t[-1]
    start, reference = (x[START], x[START + 1]), (x[REFERENCE], x[REFERENCE + 1])
    start_figures(own, start, reference, rest, x[START], x[START + 1], 0.0)
    outcome, reached = propagate_measured(
        size, M, outputs, slopes, poles, 0.0, end, theta_0, most_steps, own, ladder, nodes, scratch
    )
    proven, pitch, yaw = outcome == ENDED, nodes[0, 0] + theta_0, nodes[1, 0]
    until = settling_check_end(own, end, settling_horizon(poles))
    copy_figures(own, ahead)
    if proven and until > end:
        proven = False
        if until < inf:
            found, _ = propagate_measured(
                size,
                M,
                outputs,
                slopes,
                poles,
                end,
                until - end,
                theta_0,
                most_steps,
                ahead,
                ladder,
                nodes,
                scratch,
            )
            proven = found == ENDED
    confirm_settling(own, ahead, proven)
    course[HELD] = len(t) if outcome == ENDED else hold_after_divergence(states, voltages, DIVERGED)
    course[OUTCOME], course[IMPACTS], course[REACHED] = outcome, 0, reached
    figures_of_merit(own, reference, pitch, yaw, reached, ROUNDING, axes, motors, course)


@entry_point(
    lambda size: (
        size,
        examples.constants(size),
        examples.modes(size),
        examples.poles(),
        examples.experiment(),
        examples.inner(),
        examples.times(),
        inf,
        *examples.NUMBERS,
        examples.trim(),
        examples.zeros(*WORKSPACE),
        examples.zeros(3, len(size)),
        examples.zeros(3),
        examples.followed(),
        examples.zeros(len(size), 2),
        examples.zeros(2, 2),
        *examples.figures(),
    ),
    *SIZES,
)
def run_nonlinear(
    size, c, m, poles, x, inner, t, since, rtol, atol, most_steps, rest, w, raw, grid, f,
    states, voltages, axes, motors, course,
):  # fmt: skip
    """The rig within its limits: states, (n, samples), voltages and figures of merit, as `layout` says.

    n is the size; the states behind the sixth start as `inner`. `poles` are the linear loop's; the disturbance within
    c sets in at `since`. Scratch: `w`, WORKSPACE, `raw`, (samples + 1, n), `grid`, (samples + 1,), and `f`, twice
    FOLLOWED.
    """
    keep_apart()
    own, ahead, y, end, samples = f[:4], f[4:], w[16, : len(size)], t[-1], len(t)
    for i in range(len(size)):
        y[i] = x[START + i] if i < 4 else inner[i - 6] if i >= 6 else 0.0
    start, reference = (x[START], x[START + 1]), (x[REFERENCE], x[REFERENCE + 1])
    start_figures(own, start, reference, rest, min(max(y[0], -c[TRAVEL]), c[TRAVEL]), y[1], 0.0)
    volts = (c[DISTURBANCE], c[DISTURBANCE + 1])
    before, outcome, done, impacts, reached = 0, ENDED, 0, 0, 0.0
    while before < samples and t[before] < since:
        before += 1
    if before > 0:  # until the disturbance
        c[DISTURBANCE] = c[DISTURBANCE + 1] = 0.0
        for k in range(before):
            grid[k] = t[k]
        grid[before] = since
        count = before + 1 if before < samples else before
        outcome, done, _, _, impacts, reached = integrate_measured(
            size, y, grid[:count], c, m, rtol, atol, most_steps, w, raw[:count], own, EVERYTHING
        )
        done = min(done, before)
    c[DISTURBANCE], c[DISTURBANCE + 1] = volts[0], volts[1]
    if before < samples and outcome == ENDED:
        grid[0] = since if before > 0 else t[0]
        count = samples - before + 1
        for k in range(before, samples):
            grid[k - before + 1] = t[k]
        outcome, more, _, _, hits, reached = integrate_measured(
            size, y, grid[:count], c, m, rtol, atol, most_steps, w, raw[before:], own, EVERYTHING
        )
        impacts += hits
        for k in range(before, before + more - 1):
            copy_into(raw[k + 1], raw[k])
        done = before + more - 1
    trajectories(size, raw, done, c, states, voltages)
    speeds_at_once(size, voltages, before, c, states)
    pitch, yaw = y[0], y[1]
    turn = min(slowest_period(poles), end)
    check_settling(
        size, own, ahead, y, end, outcome, c, m, since, turn, rtol, atol, most_steps, w, raw[:2], grid[:2]
    )
    course[HELD] = done if outcome == OUT_OF_BOUNDS else samples
    course[OUTCOME], course[IMPACTS], course[REACHED] = outcome, impacts, reached
    floor = min(max(ROUNDING, 10.0 * rtol), SEEN)
    figures_of_merit(own, reference, pitch, yaw, reached, floor, axes, motors, course)


@kernel
def check_settling(
    size, own, ahead, y, end, outcome, c, m, since, turn, rtol, atol, most_steps, w, raw, grid
):
    """Looks beyond the end, until an axis has been within its settling band for a time `turn`.

    The disturbance within c sets in at `since` there, too.
    """
    keep_apart()
    proven, until = outcome == ENDED, settling_check_end(own, end, turn)
    volts, now = (c[DISTURBANCE], c[DISTURBANCE + 1]), end
    copy_figures(own, ahead)
    for disturbed in range(2):
        to = until if disturbed == 1 else min(max(since, end), until)
        if proven and to > now:
            c[DISTURBANCE], c[DISTURBANCE + 1] = disturbed * volts[0], disturbed * volts[1]
            grid[0], grid[1] = now, to
            found, _, _, _, _, _ = integrate_measured(
                size, y, grid, c, m, rtol, atol, most_steps, w, raw, ahead, EVERYTHING
            )
            proven, now = found == ENDED, to
    c[DISTURBANCE], c[DISTURBANCE + 1] = volts[0], volts[1]
    confirm_settling(own, ahead, proven)
