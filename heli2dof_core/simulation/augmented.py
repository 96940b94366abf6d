"""Rotors, friction and an estimator as numbers: what the kernels take of a loop with more states than the paper's."""

from __future__ import annotations

import numpy as np

from ..estimators import Estimator
from ..kernels.layout import (
    BOUND,
    CONSTANTS,
    ESTIMATED,
    ESTIMATOR,
    FED,
    FULL,
    INNER,
    LAGGED,
    MORE_CONSTANTS,
    MORE_GAIN,
    PLAIN,
    START,
    STOP,
    TAU,
    USUAL,
)
from ..loop import Loop
from ..signals import Floats, fixed

_NOTHING_MORE = fixed(np.zeros(MORE_CONSTANTS - CONSTANTS))
_NOTHING_INSIDE = fixed(np.zeros((2, INNER)))
_NO_ESTIMATOR = fixed(np.zeros(ESTIMATED))


def more_constants(loop: Loop) -> Floats:
    """What `kernels.rig`'s constants go on with, from CONSTANTS on; the gains are left to `nonlinear_loop`."""
    if len(loop.size) == PLAIN:
        return _NOTHING_MORE
    c, estimator = np.zeros(MORE_CONSTANTS), loop.estimator
    c[USUAL:] = 1.0
    if loop.actuators is not None:
        c[TAU:MORE_GAIN] = loop.actuators.constants
    if estimator is not None:
        m, G, H = estimator.order, estimator.G, estimator.H
        rows = c[ESTIMATOR:USUAL].reshape(-1, FULL + 3)[:m]
        rows[:, LAGGED : LAGGED + m], rows[:, :2], rows[:, FULL : FULL + 2] = estimator.F, G, H
        rows[:, FULL + 2] = -loop.design.plant.theta_0 * G[:, 0] - H @ loop.design.trim
        c[USUAL + 2 : USUAL + 2 + m] = _usual(estimator)
    return c[CONSTANTS:]


def _usual(estimator: Estimator) -> Floats:
    """How large an estimator's states are, at most 1, where an angle rests at 1 rad or turns at 1 rad/s.

    Those of a filter are small numbers by which fast ones are told: their errors must be smaller still.
    """
    try:
        rest = np.linalg.solve(estimator.F, estimator.G)
        sizes = np.max(np.abs(np.hstack((rest, np.linalg.solve(estimator.F, rest)))), axis=1)
    except np.linalg.LinAlgError:
        return np.ones(estimator.order)
    return fixed(np.where(sizes > 0.0, np.minimum(sizes, 1.0), 1.0))


def inner_start(loop: Loop, x: Floats, steps: tuple[float, float] = (0.0, 0.0)) -> Floats:
    """Where the states behind the sixth start in an experiment: of the linear model and of the rig, (2, INNER).

    Rotors turn as the trim holds them that is fed forward, in the linear model as the trim; filters have settled at
    the measured angles, and an observer knows these and believes in rest. `steps` are those of encoders, rad, 0 for
    none.
    """
    if len(loop.size) == PLAIN:
        return _NOTHING_INSIDE
    start, limits, theta_0 = np.zeros((2, INNER)), x[BOUND:STOP], loop.design.plant.theta_0
    start[1, :2] = np.clip(loop.design.trim * x[FED], -limits, limits)
    if loop.estimator is not None:
        theta, psi = x[START], x[START + 1]
        stopped = np.array([min(max(theta, -x[STOP]), x[STOP]), psi])
        for axis, step in enumerate(steps):
            if step:
                stopped[axis] = step * np.floor(stopped[axis] / step + 0.5)
        for row, angles in zip(start, (np.array([theta, psi]), stopped), strict=True):
            row[2 : 2 + loop.estimator.order] = _settled(loop.estimator, angles - [theta_0, 0.0])
    return start


def _settled(estimator: Estimator, angles: Floats) -> Floats:
    """States of an estimator of a rig that has rested at these angles, in deviations."""
    if estimator.measured == "filtered":
        return fixed(-np.linalg.solve(estimator.F, estimator.G @ angles))
    return np.concatenate((angles, np.zeros(estimator.order - 2)))


def sampled_estimator(loop: Loop, sample_time: float) -> Floats:
    """The estimator from one sample to the next, laid out as ESTIMATED says: exact for what is held between them."""
    if loop.estimator is None:
        return _NO_ESTIMATOR
    from scipy.linalg import expm

    m, F, G, H = loop.estimator.order, loop.estimator.F, loop.estimator.G, loop.estimator.H
    continuous = np.zeros((m + 4, m + 4))
    continuous[:m] = np.hstack((F, G, H))
    step = np.asarray(expm(continuous * sample_time), dtype=np.float64)[:m]
    rows = np.zeros(ESTIMATED)
    rows[:m, :m], rows[:m, 6:10] = step[:, :m], step[:, m:]
    rows[:m, 10] = -loop.design.plant.theta_0 * step[:, m] - step[:, m + 2 :] @ loop.design.trim
    return rows


def own_states(loop: Loop, rows: Floats) -> Floats:
    """The loop's own states among those that a kernel has filled, row by row."""
    if len(loop.size) == PLAIN:
        return rows[: len(loop.places)]
    return rows[list(loop.places)]
