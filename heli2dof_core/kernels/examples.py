"""Arguments that make Numba compile the kernels: of the types that they take, and of the smallest shapes.

A kernel that `engine` hands out names its own beside its definition (`jit.entry_point`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..figures import AXIS_METRICS
from ..frozen import frozen
from ..signals import Floats, fixed
from . import update_layout
from .layout import (
    ALPHA,
    BOUND,
    CONSTANTS,
    COURSE,
    ESTIMATED,
    EXPERIMENT,
    FOLLOWED,
    GAIN,
    INNER,
    J_Y,
    LIMIT,
    MODES,
    MORE_CONSTANTS,
    MORE_MODES,
    MOTOR_METRICS,
    PAPER,
    PLAIN,
    REFERENCE,
    SETTINGS,
    SIZES,
    START,
    STOP,
    TIME,
    exact_shapes,
)

NUMBERS = (1e-3, 1e-3, 10)
"""Relative and absolute tolerance, most steps."""


def zeros(*shape: int) -> Floats:
    """An array that a kernel fills, or its caller's own."""
    return np.zeros(shape)


def given(*shape: int) -> Floats:
    """An array of a result, which nobody may change; a writable one is taken in its place."""
    return fixed(np.zeros(shape))


def times() -> Floats:
    """Two samples, which nobody may change."""
    return fixed([0.0, 1e-3])


def constants(size: Sequence[int] = PAPER) -> Floats:
    """A rig with inertia and limits, and no controller."""
    c = np.zeros(CONSTANTS if len(size) == PLAIN else MORE_CONSTANTS)
    c[[ALPHA, J_Y, LIMIT, LIMIT + 1]] = 1.0
    return c


def more_constants() -> Floats:
    """The same with rotors and friction."""
    return constants(SIZES[1])


def modes(size: Sequence[int] = PAPER) -> Any:
    """All switches as they are at first."""
    return np.zeros(MODES if len(size) == PLAIN else MORE_MODES, dtype=np.int64)


def rig() -> Floats:
    """Its own constants, which nobody may change."""
    return fixed(constants()[:GAIN])


def trim() -> Floats:
    """Voltages at rest, which nobody may change."""
    return fixed(np.zeros(2))


def plant() -> tuple[Floats, Floats]:
    """A and B, which nobody may change."""
    return fixed(-np.eye(4)), fixed(np.eye(4)[:, 2:])


def experiment() -> Floats:
    """A step of both axes within limits and stops."""
    x = np.zeros(EXPERIMENT)
    x[REFERENCE : START + 2], x[BOUND : STOP + 1] = (1.0, 1.0, 0.0, 0.0), 1.0
    return x


def poles() -> Any:
    """Of the linear loop, which nobody may change."""
    return frozen(np.array([-1 + 0j]))


def more() -> Floats:
    """What the constants go on with for rotors, friction and estimator, which nobody may change."""
    return fixed(np.zeros(MORE_CONSTANTS - CONSTANTS))


def inner(*leading: int) -> Floats:
    """States behind the sixth at the start, which nobody may change."""
    return given(*leading, INNER)


def estimated() -> Floats:
    """An estimator from sample to sample, which nobody may change."""
    return given(*ESTIMATED)


def search(size: tuple[int, ...]) -> tuple[Floats, Floats, Floats, Floats]:
    """Scratch of the exact response: matrices, powers of the step, nodes, and what is followed."""
    matrices, ladder, nodes = exact_shapes(len(size))
    return zeros(*matrices), zeros(*ladder), zeros(*nodes), followed()


def followed() -> Floats:
    """Scratch of the figures of merit, twice."""
    return zeros(2 * FOLLOWED[0], FOLLOWED[1])


def figures(*leading: int) -> tuple[Floats, Floats, Floats]:
    """Figures of merit by axis, by motor and of the course."""
    return zeros(*leading, 2, AXIS_METRICS), zeros(*leading, 2, MOTOR_METRICS), zeros(*leading, COURSE)


def settings() -> Floats:
    """Of a digital controller."""
    d = zeros(SETTINGS)
    d[TIME] = 1e-3
    return d


def bounds() -> Any:
    """One segment of two samples, which nobody may change."""
    return frozen(np.array([[0, 2]]))


def numbers() -> Floats:
    """Of an update: a rig whose motors drive an axis each, and poles at −1."""
    x = np.zeros(update_layout.NUMBERS)
    x[[0, 3, 4, 5]] = 1.0
    x[update_layout.LIMITS : update_layout.LIMITS + 3] = 1.0
    x[update_layout.POLES : update_layout.POLES + 8 : 2] = -1.0
    x[update_layout.PI_GAINS : update_layout.PI_GAINS + 4] = 1.0
    x[[update_layout.RTOL, update_layout.DURATION, update_layout.SAMPLE_TIME]] = 1e-3
    x[[update_layout.MOST_STEPS, update_layout.AIMS]] = 10.0, 1.0
    return x
