"""Exact step responses of the linear loop: one matrix exponential, then doubling."""

from __future__ import annotations

import numpy as np

from ..engine import engine
from ..layout import AUGMENTED
from ..loop import Loop
from ..spec import Scenario
from .response import Response, hold_when_diverged


def simulate_linear(loop: Loop, scenario: Scenario) -> Response:
    """Step response of the loop without limits, exact at every sample.

    Ignores saturation, anti-windup, travel stops and feed-forward. The states are augmented by a
    constant 1 that carries the references, so that one exponential holds the whole step.
    """
    plant = loop.design.plant
    rest = np.array([plant.theta_0, 0.0])
    reference, start = scenario.resolved(plant.theta_0)
    wanted = reference - rest

    n, samples = len(loop.A), scenario.samples
    augmented, outputs = np.zeros((AUGMENTED, AUGMENTED)), np.zeros((2, AUGMENTED))
    augmented[:n, :n] = loop.A
    augmented[:n, -1] = loop.B @ wanted
    outputs[:, :n] = loop.voltage_from_state
    outputs[:, -1] = loop.voltage_from_reference @ wanted

    t = scenario.times
    states, voltages = np.zeros((AUGMENTED, samples)), np.empty((2, samples))
    states[:2, 0], states[2:4, 0], states[-1, 0] = start[:2] - rest, start[2:], 1.0
    with np.errstate(over="ignore", invalid="ignore"):
        engine().respond(augmented, t[1], outputs, np.empty((3 * AUGMENTED, AUGMENTED)), states, voltages)
        states[:2] += rest[:, None]
    states = states[:n]
    findings = hold_when_diverged(t, states, voltages)
    ends, begin = (float(reference[0]), float(reference[1])), (float(start[0]), float(start[1]))
    return Response("linear", t, states[:2], voltages, ends, begin, (0.0, 0.0), tuple(findings), states)
