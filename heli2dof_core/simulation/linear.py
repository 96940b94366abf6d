"""Exact step responses of the linear loop: one matrix exponential, then doubling."""

from __future__ import annotations

import numpy as np

from ..engine import engine
from ..layout import AUGMENTED, LINEAR_WORKSPACE, START
from ..loop import Loop
from ..signals import Floats
from ..spec import Scenario
from .experiment import experiment
from .response import Response, divergence


def simulate_linear(loop: Loop, scenario: Scenario) -> Response:
    """Step response of the loop without limits, exact at every sample.

    Ignores saturation, anti-windup, travel stops and feed-forward. The states are augmented by a
    constant 1 that carries the references, so that one exponential holds the whole step.
    """
    x, t = experiment(loop, None, scenario), scenario.times
    states, voltages = np.empty((AUGMENTED, len(t))), np.empty((2, len(t)))
    matrices = (loop.voltage_from_state, loop.voltage_from_reference, loop.A, loop.B)
    held = engine().run_linear(
        loop.design.plant.theta_0, *matrices, x, t, np.empty(LINEAR_WORKSPACE), states, voltages
    )
    return linear_response(x, t, states[: len(loop.A)], voltages, held)


def linear_response(x: Floats, t: Floats, states: Floats, voltages: Floats, held: float) -> Response:
    """The course of an experiment with its remark; held from sample `held` on."""
    theta, psi, theta_start, psi_start = x[: START + 2].tolist()
    start = (theta_start, psi_start)
    remarks = divergence(t, int(held))
    return Response("linear", t, states[:2], voltages, (theta, psi), start, (0.0, 0.0), remarks, states)
