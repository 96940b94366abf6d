"""Exact step responses of the linear loop: one matrix exponential, then doubling."""

from __future__ import annotations

import numpy as np
from scipy.linalg import expm

from ..loop import Loop
from ..signals import Floats
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

    n = len(loop.A)
    state = np.zeros(n + 1)
    state[:2], state[2:4], state[n] = start[:2] - rest, start[2:], 1.0
    augmented = np.zeros((n + 1, n + 1))
    augmented[:n, :n] = loop.A
    augmented[:n, n] = loop.B @ (reference - rest)

    t = np.linspace(0.0, scenario.duration, scenario.samples)
    with np.errstate(over="ignore", invalid="ignore"):
        states = propagate(np.asarray(expm(augmented * t[1]), dtype=np.float64), state, scenario.samples)
        voltages = loop.voltage_from_state @ states[:n]
        voltages += (loop.voltage_from_reference @ (reference - rest))[:, None]
        states[:2] += rest[:, None]
    states, voltages, findings = hold_when_diverged(t, states[:n], voltages)
    ends, begin = (float(reference[0]), float(reference[1])), (float(start[0]), float(start[1]))
    return Response("linear", t, states[:2], voltages, ends, begin, (0.0, 0.0), tuple(findings), states)


def propagate(step: Floats, state: Floats, samples: int) -> Floats:
    """States x_k = stepᵏ x₀ for k = 0 … samples − 1, shape (n, samples), by doubling."""
    states = np.empty((len(state), samples))
    states[:, 0] = state
    done, power = 1, step
    while done < samples:
        more = min(done, samples - done)
        states[:, done : done + more] = power @ states[:, :more]
        done += more
        power = power @ power
    return states
