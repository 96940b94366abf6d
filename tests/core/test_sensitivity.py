"""Disk margin and sensitivity peak against python-control, and against what they promise."""

from __future__ import annotations

import control
import numpy as np
import pytest

from heli2dof_core import PRESETS, OuterLoop, PIGains, Spec, close_loop, design, place, plant, preset
from heli2dof_core.sensitivity import loop_sensitivity
from tests.core.test_nonlinear_response import random_loops


def loop_of(name):
    spec = Spec.from_preset(preset(name))
    return close_loop(place(spec), spec.outer)


def opened(loop):
    """L(s) and S(s) at both motors, interconnected by python-control."""
    n = len(loop.A)
    B = np.zeros((n, 2))
    B[:4] = loop.design.plant.B
    C_u = -loop.voltage_from_state
    L = control.ss(loop.A + B @ C_u, B, C_u, np.zeros((2, 2)))
    return L, control.feedback(control.ss([], [], [], np.eye(2)), L)


@pytest.mark.parametrize("name", PRESETS)
def test_sensitivity_of_the_presets_is_python_controls(name):
    loop = loop_of(name)
    own = loop_sensitivity(loop)
    L, S = opened(loop)
    near = own.disk_frequency * np.geomspace(0.5, 2, 401)
    margin, gain, phase = control.disk_margins(L, near)
    assert own.disk_margin == pytest.approx(float(margin), rel=1e-4)
    assert own.disk_margin <= margin * (1 + 1e-9)
    assert 20 * np.log10(own.gain_range[1]) == pytest.approx(float(gain), rel=1e-3)
    assert np.degrees(own.phase) == pytest.approx(float(phase), rel=1e-4)
    assert own.peak == pytest.approx(float(control.system_norm(S, p="inf")), rel=1e-4)


def test_sensitivity_peak_of_random_loops_is_the_infinity_norm():
    for loop, _ in random_loops(25, seed=6):
        own = loop_sensitivity(loop)
        norm = float(control.system_norm(opened(loop)[1], p="inf"))
        assert own.peak == pytest.approx(norm, rel=1e-3)


def test_gains_within_the_disk_margin_keep_the_loop_stable_and_one_beyond_all_directions_does_not():
    """Both motors' gains scaled at once, to every corner of the guaranteed range."""
    for loop, _ in random_loops(25, seed=7):
        own = loop_sensitivity(loop)
        low, high = own.gain_range
        n = len(loop.A)
        B = np.zeros((n, 2))
        B[:4] = loop.design.plant.B
        C_u = -loop.voltage_from_state
        opened_A = loop.A + B @ C_u
        top = 100.0 if high is None else high
        for corner in ((low, low), (low, top), (top, low), (top, top)):
            factors = 1 + (np.array(corner) - 1) * 0.999
            closed = opened_A - B @ np.diag(factors) @ C_u
            assert np.max(np.linalg.eigvals(closed).real) < 1e-9


def test_an_unstable_loop_has_no_margin():
    slow = design(plant(preset().parameters), preset().poles.dealt([-3, -2, -3, -2], [[0, 1], [2, 3]]))
    loop = close_loop(slow, OuterLoop(pitch=PIGains(30, 0.1), yaw=PIGains(30, 0.1)))
    assert not loop.stable
    assert loop_sensitivity(loop) is None


def test_effort_and_itae_are_the_integrals_that_they_say(spec):
    from heli2dof_core import evaluate

    report = evaluate(spec, each_axis=True)
    step = report.axis_steps["theta"]["nonlinear"]
    response, metrics = step.response, step.metrics
    t, dt = response.t, response.t[1]
    excess = response.voltages - report.design.plant.trim[:, None]
    simple = np.sum(0.5 * (excess[:, 1:] ** 2 + excess[:, :-1] ** 2) * dt, axis=1)
    assert metrics.motors["V_p"].effort == pytest.approx(simple[0])
    assert metrics.motors["V_y"].effort == pytest.approx(simple[1])
    error = t * np.abs(response.reference[0] - response.angles[0])
    assert metrics.axes["theta"].itae == pytest.approx(np.sum(0.5 * (error[1:] + error[:-1]) * dt))
