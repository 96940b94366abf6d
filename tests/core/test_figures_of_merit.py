"""Figures of merit belong to the response: held against SciPy, whatever the samples, the window and the model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from heli2dof_core import (
    Limits,
    OuterLoop,
    PoleSet,
    Scenario,
    Spec,
    close_loop,
    design,
    evaluate,
    plant,
    preset,
    simulate,
)
from heli2dof_core.evaluate import place
from heli2dof_core.metrics import step_metrics
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import simulate_nonlinear
from heli2dof_core.spec import Digital, Disturbance
from tests.core.test_nonlinear_response import independent_rates, random_loops
from tests.figures import LinearCourse, figures, held_course, largest
from tests.reference import Reference
from tests.strategies import STRUCTURES

LIMITS = preset().limits
AXES = ("theta", "psi")
ANGULAR = ("rise_time", "overshoot", "undershoot", "peak", "steady_state_error", "iae", "itae")


def inner_loop(*poles, theta_0=0.0, coupling=STRUCTURES[0]):
    placed = design(plant(preset().parameters, theta_0), PoleSet(poles), coupling)
    return close_loop(placed, OuterLoop(outer="none"))


def worst_gap(own, expected, step, length, rounding=1e-9):
    """The largest difference of the figures: shares of the step, or of the time that it lasts."""
    gaps = [0.0]
    assert (own.rise_time is None) == (expected["rise_time"] is None)
    for name in ANGULAR:
        value = getattr(own, name)
        if value is None:
            continue
        size = {"rise_time": 1.0, "overshoot": 100.0, "undershoot": 100.0, "iae": step, "itae": step * length}
        gaps.append(abs(value - expected[name]) / size.get(name, step))
    if own.peak_time is not None:
        # an extremum is flat: its time is known to the root of what its height is known to
        assert own.peak_time == pytest.approx(expected["peak_time"], abs=1e-3 * length)
    elif expected["peak_time"] < 0.999 * length:
        assert expected["overshoot"] < 100 * rounding
    if own.settled:
        gaps.append(abs(own.settling_time - expected["entered"]))
    return max(gaps)


def random_linear(count, seed):
    """Loops and experiments of all kinds: steps down, starts off rest, windows from 10 ms to 40 s."""
    rng = np.random.default_rng(seed)
    for loop, _ in random_loops(count, seed):
        start = [None if rng.random() < 0.5 else rng.uniform(-0.3, 0.3) for _ in range(2)]
        rates = rng.uniform(-1, 1, 2) if rng.random() < 0.3 else (0.0, 0.0)
        reference = [None if rng.random() < 0.15 else rng.uniform(-0.5, 0.5) for _ in range(2)]
        duration = float(10 ** rng.uniform(-2, 1.6))
        yield loop, Scenario(*reference, duration=duration, samples=2, initial=(*start, *rates))


def linear_reference(loop, scenario, samples=20_001):
    theta_0 = loop.design.plant.theta_0
    resolved = np.array(scenario.resolved(theta_0))
    start = np.zeros(len(loop.A))
    start[:4] = resolved[2:6] - [theta_0, 0, 0, 0]
    return LinearCourse(loop.A, loop.B, resolved[:2] - [theta_0, 0], start), resolved


def check_linear(loop, scenario, samples=20_001):
    course, resolved = linear_reference(loop, scenario)
    fastest = np.max(np.abs(loop.poles))
    # dense where the fast poles are, too
    early = np.linspace(0, min(scenario.duration, 30 / fastest), samples)
    late = np.linspace(early[-1], scenario.duration, samples)[1:]
    t = early if early[-1] == scenario.duration else np.concatenate([early, late])
    states = course(t)
    states[0] += loop.design.plant.theta_0
    response = simulate_linear(loop, scenario)
    own, worst = step_metrics(response), 0.0
    for axis, name in enumerate(AXES):
        if name not in own.axes:
            continue
        reference, start = resolved[axis], resolved[2 + axis]
        if abs(reference - start) < 1e-3:
            continue
        expected = figures(t, states[axis], start, reference)
        metrics, step = own.axes[name], abs(reference - start)
        worst = max(worst, worst_gap(metrics, expected, step, scenario.duration))
        offset = np.array([loop.design.plant.theta_0, 0.0])[axis]
        stays = not course.leaves(scenario.duration, axis, start - offset, reference - offset)
        assert metrics.settled == (expected["entered"] is not None and stays)
        assert (f"not_settled_{name}" in {f.code for f in response.findings}) == (not metrics.settled)
    for motor, name in enumerate(("V_p", "V_y")):
        states_0 = course(t)
        voltage = loop.voltage_from_state[motor] @ states_0
        voltage = voltage + loop.voltage_from_reference[motor] @ (resolved[:2] - [loop.design.plant.theta_0, 0])
        peak = largest(t, voltage)
        worst = max(worst, abs(own.motors[name].peak - peak) / peak if peak > 1e-6 else 0.0)
    return worst


def test_linear_figures_are_scipys():
    worst = max(check_linear(loop, scenario) for loop, scenario in random_linear(40, seed=7))
    assert worst < 1e-6
