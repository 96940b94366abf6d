"""Exact step responses of the linear loop: one matrix exponential, then doubling."""

from __future__ import annotations

import numpy as np

from ..engine import engine
from ..kernels.layout import AUGMENTED, LADDER, LINEAR_WORKSPACE, STRETCH
from ..loop import Loop
from ..scenario import Scenario
from ..scratch import FOLLOWED_TWICE
from ..signals import Floats, fixed
from .experiment import experiment
from .response import Measured, Response, course_response, room

AT_REST = fixed(np.zeros(2))
"""Its voltages are deviations from the trim."""


def simulate_linear(loop: Loop, scenario: Scenario, most_steps: int | None = None) -> Response:
    """Step response of the loop without limits, exact at every sample.

    Ignores saturation, anti-windup, travel stops and feed-forward. The states are augmented by a
    constant 1 that carries the references, so that one exponential holds the whole step. Its figures are
    given up after `most_steps` groups of steps, by default a tenth of a second's work.
    """
    x, t = experiment(loop, None, scenario), scenario.times
    states, voltages, found, kernels = (
        np.empty((AUGMENTED, len(t))),
        np.empty((2, len(t))),
        room(),
        engine(),
    )
    matrices = (loop.voltage_from_state, loop.voltage_from_reference, loop.A, loop.B, loop.poles)
    kernels.run_linear(
        loop.design.plant.theta_0,
        *matrices,
        x,
        t,
        most_steps or kernels.most_steps,
        AT_REST,
        np.empty(LINEAR_WORKSPACE),
        np.empty(LADDER),
        np.empty(STRETCH),
        np.empty(FOLLOWED_TWICE),
        states,
        voltages,
        *found,
    )
    return linear_response(x, t, states[: len(loop.A)], voltages, Measured(*found))


def linear_response(x: Floats, t: Floats, states: Floats, voltages: Floats, found: Measured) -> Response:
    """The course of an experiment with its remarks."""
    return course_response("linear", x.tolist(), t, found, states=states, voltages=voltages)
