"""Linear responses, metrics and margins against python-control."""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest
from hypothesis import given, settings

from heli2dof_core import OuterLoop, PIGains, PoleSet, Scenario, close_loop, design, plant, preset
from heli2dof_core.margins import loop_margins, open_loop_response
from heli2dof_core.metrics import step_metrics
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.tuning import DAMPING, EASED, suggest_pi
from tests.core.test_nonlinear_response import random_loops
from tests.strategies import operating_points, pole_sets, rigs, structures

OUTERS = (
    OuterLoop(),
    OuterLoop(outer="none"),
    OuterLoop(pitch=PIGains(12.0, 0.4), yaw=PIGains(20.0, 0.2), decoupler=True),
    OuterLoop(pitch=PIGains(3.0, 0.5), yaw=PIGains(2.0, 0.6), pairing="cross"),
)


MOTORS, STATES = ("V_p", "V_y"), ("theta", "psi", "theta_dot", "psi_dot")


def whole_loop(placed, outer, outputs=("theta", "psi", *MOTORS)):
    """Reference → outputs, its blocks connected by python-control by the names of their signals."""
    K, A, B = placed.K, placed.plant.A, placed.plant.B
    states, motors = list(STATES), list(MOTORS)
    G_0 = np.eye(2, 4) @ np.linalg.solve(-(A - B @ K), B)
    paired = [G_0[0, 0], G_0[1, 1]] if outer.pairing == "diagonal" else [G_0[0, 1], G_0[1, 0]]
    if outer.outer == "none":
        static = np.linalg.inv(G_0)
    elif outer.decoupler:
        static = np.linalg.inv(G_0) @ np.diag(np.abs(paired))
    elif outer.pairing == "diagonal":
        static = np.eye(2)
    else:
        static = np.array([[0, np.sign(paired[1])], [np.sign(paired[0]), 0]])
    s, closed = control.tf("s"), outer.outer == "pi"
    pi = [g.kp * (1 + 1 / (g.ti * s)) if closed else control.tf(1, 1) for g in (outer.pitch, outer.yaw)]
    controllers = control.ss([], [], [], static) * control.append(*[control.ss(c) for c in pi])
    fed_back = ["-theta", "-psi"] if closed else [None, None]
    errors = [
        control.summing_junction([r, *([y] if y else [])], e)
        for r, y, e in zip(["r_theta", "r_psi"], fed_back, ["e_theta", "e_psi"], strict=True)
    ]
    sums = [
        control.summing_junction([v, f], motor)
        for v, f, motor in zip(["v_p", "v_y"], ["-f_p", "-f_y"], motors, strict=True)
    ]
    blocks = [
        control.ss(A, B, np.eye(4), 0, inputs=motors, outputs=states, name="rig"),
        control.ss([], [], [], K, inputs=states, outputs=["f_p", "f_y"], name="feedback"),
        control.ss(controllers, inputs=["e_theta", "e_psi"], outputs=["v_p", "v_y"], name="controllers"),
    ]
    blocks += [
        control.ss(0, 1, 1, 0, inputs=error, outputs=z)
        for error, z in (("e_theta", "z_p"), ("e_psi", "z_y"))
        if z in outputs
    ]
    return control.interconnect([*blocks, *errors, *sums], inputs=["r_theta", "r_psi"], outputs=list(outputs))


@pytest.mark.parametrize("outer", OUTERS, ids=str)
@pytest.mark.parametrize("step", [(0.2, 0.0), (0.0, -0.3), (0.1, 0.4)])
def test_step_response_is_python_controls(spec, outer, step):
    placed = design(plant(spec.parameters), spec.poles)
    response = simulate_linear(close_loop(placed, outer), Scenario(theta=step[0], psi=step[1], duration=2.0))
    reference = np.repeat(np.array(step)[:, None], len(response.t), axis=1)
    expected = control.forced_response(whole_loop(placed, outer), response.t, reference)
    np.testing.assert_allclose(response.angles, expected.outputs[:2], atol=1e-10)
    np.testing.assert_allclose(response.voltages, expected.outputs[2:], atol=1e-8)


@settings(max_examples=30)
@given(rigs(), operating_points, pole_sets(), structures)
def test_inner_loop_alone_settles_on_the_reference_with_the_placed_poles(rig, theta_0, poles, structure):
    placed = design(plant(rig, theta_0), poles, structure)
    loop = close_loop(placed, OuterLoop(outer="none"))
    slowest = -np.max(poles.array.real)
    response = simulate_linear(loop, Scenario(theta=theta_0 + 0.1, psi=-0.2, duration=60 / slowest))
    np.testing.assert_allclose(response.angles[:, -1], [theta_0 + 0.1, -0.2], atol=1e-6)
    np.testing.assert_allclose(np.poly(loop.A), np.poly(poles.array).real, rtol=1e-8, atol=1e-8)


def test_response_from_an_initial_state_is_python_controls(spec, design):
    loop = close_loop(design)
    start = (0.1, -0.2, 0.5, -0.4)
    response = simulate_linear(loop, Scenario(initial=start, duration=3.0, samples=301))
    system = control.ss(loop.A, loop.B, np.eye(6), 0)
    expected = control.initial_response(system, response.t, [*start, 0.0, 0.0])
    np.testing.assert_allclose(response.angles, expected.outputs[:2], atol=1e-10)


@pytest.mark.parametrize("outer", OUTERS, ids=str)
def test_states_are_python_controls(spec, outer):
    placed = design(plant(spec.parameters), spec.poles)
    step = np.array([0.1, -0.3])
    response = simulate_linear(close_loop(placed, outer), Scenario(*step, duration=2.0))
    names = STATES if outer.outer == "none" else (*STATES, "z_p", "z_y")
    reference = np.repeat(step[:, None], len(response.t), axis=1)
    expected = control.forced_response(whole_loop(placed, outer, names), response.t, reference).outputs
    assert response.states.shape == expected.shape
    np.testing.assert_allclose(response.states, expected, atol=1e-10)
    np.testing.assert_array_equal(response.states[:2], response.angles)


def test_response_does_not_depend_on_its_grid(spec, design):
    loop = close_loop(design)
    fine = simulate_linear(loop, Scenario(theta=0.2, psi=0.3, duration=2.0, samples=1001))
    coarse = simulate_linear(loop, Scenario(theta=0.2, psi=0.3, duration=2.0, samples=11))
    np.testing.assert_allclose(fine.angles[:, ::100], coarse.angles, atol=1e-12)


def test_unstable_responses_stay_finite_and_say_so(spec):
    placed = design(plant(spec.parameters), PoleSet([1e5, 900.0, -3.0, -4.0]))
    response = simulate_linear(close_loop(placed, OuterLoop(outer="none")), Scenario(theta=0.1))
    assert np.all(np.isfinite(response.angles)) and np.all(np.isfinite(response.voltages))
    assert [f.code for f in response.findings] == ["diverges"]


@pytest.mark.parametrize("axis", ["theta", "psi"])
def test_metrics_are_those_of_step_info(spec, design, axis):
    """It looks at samples: within two of its times, and a smooth peak within the square of that."""
    response = simulate_linear(close_loop(design), Scenario(**{axis: 0.2}, duration=3.0, samples=20_001))
    metrics = step_metrics(response).axes[axis]
    row = ["theta", "psi"].index(axis)
    info = control.step_info(response.angles[row], response.t, final_output=0.2)
    sample = response.t[1]
    assert metrics.rise_time == pytest.approx(info["RiseTime"], abs=2 * sample)
    assert metrics.settling_time == pytest.approx(info["SettlingTime"], abs=2 * sample)
    assert metrics.overshoot == pytest.approx(info["Overshoot"], abs=2e-6)
    assert metrics.peak == pytest.approx(info["Peak"])
    assert metrics.peak_time == pytest.approx(info["PeakTime"], abs=sample)
    assert step_metrics(response).coupling_peak == pytest.approx(np.max(np.abs(response.angles[1 - row])))


def test_step_info_takes_each_entry_by_itself(design):
    """As the README warns: what returns to 0 has shares of nothing; the diagonal entries are like ours."""
    system = close_loop(design).to_control()
    found = control.step_info(system)
    assert all(found[i][i] == pytest.approx(control.step_info(system[i, i])) for i in range(2))
    assert found[1][0]["Overshoot"] > 1e6
    own = step_metrics(simulate_linear(close_loop(design), Scenario(theta=0.2))).axes["theta"]
    assert found[0][0]["Overshoot"] == pytest.approx(own.overshoot, abs=0.01)


@pytest.mark.parametrize("name", ["quanser-2dof-manual", "quanser-aero-2", "quanser-aero"])
def test_margins_are_python_controls(name):
    p = preset(name)
    check_margins(close_loop(design(plant(p.parameters), p.poles, p.structure), p.outer))


def test_margins_of_random_loops_are_python_controls():
    """Conditionally stable ones and several crossings among them."""
    loops = [loop for loop, _ in random_loops(80, seed=11) if loop.stable]
    several = sum(m.gain_reduction_margin is not None for loop in loops for m in loop_margins(loop))
    assert len(loops) > 60 and several > 5
    for loop in loops:
        check_margins(loop)


def check_margins(loop):
    found = loop_margins(loop)
    assert found is not None
    n = len(loop.A)
    for motor, margins in enumerate(found):
        b = np.zeros((n, 1))
        b[:4, 0] = loop.design.plant.B[:, motor]
        c = -loop.voltage_from_state[[motor]]
        system = control.ss(loop.A + b @ c, b, c, 0)
        gains, phases, _, _, gain_crossovers, _ = control.stability_margins(system, returnall=True)
        finite = gains[gains > 1e-9]  # an integrator's crossing at ω = 0, with a gain of 0, is none
        above, below = finite[finite > 1], finite[finite < 1]
        for own, theirs in (
            (margins.gain_margin, above.min() if len(above) else None),
            (margins.gain_reduction_margin, below.max() if len(below) else None),
        ):
            assert own == (None if theirs is None else pytest.approx(theirs, rel=1e-5))
        lags = np.radians(phases % 360)
        assert margins.phase_margin == pytest.approx(np.min(np.minimum(lags, 2 * np.pi - lags)), rel=1e-6)
        assert margins.delay_margin == pytest.approx(np.min(lags / gain_crossovers), rel=1e-6)


@pytest.mark.parametrize("seed", [3, 4])
def test_open_loops_over_frequency_are_python_controls(seed):
    """With one motor's loop opened by hand, the rest closed; stable or not."""
    frequencies = np.logspace(-2, 3, 41)
    for loop, _ in random_loops(20, seed=seed):
        for motor, response in enumerate(open_loop_response(loop, frequencies)):
            n = len(loop.A)
            A, B = np.zeros((n, n)), np.zeros((n, 2))
            A[:4, :4], B[:4] = loop.design.plant.A, loop.design.plant.B
            if n == 6:
                A[4, 0] = A[5, 1] = -1.0
            other = 1 - motor
            A += B[:, [other]] @ loop.voltage_from_state[[other]]
            system = control.ss(A, B[:, [motor]], -loop.voltage_from_state[[motor]], 0)
            expected = control.frequency_response(system, frequencies).complex
            np.testing.assert_allclose(response, expected, rtol=1e-6)


def test_margins_lie_on_the_open_loop(spec, design):
    """At the phase margin's frequency |L| = 1: between its two neighbours on a fine grid, found by bisection."""
    loop = close_loop(design, spec.outer)
    margins = loop_margins(loop)
    assert margins is not None
    for motor, own in enumerate(margins):
        low, high = 1e-2, 1e3
        for _ in range(60):
            middle = np.sqrt(low * high)
            gain = abs(open_loop_response(loop, np.array([middle]))[motor, 0])
            low, high = (middle, high) if gain > 1 else (low, middle)
        phase = np.angle(open_loop_response(loop, np.array([low]))[motor, 0])
        assert own.phase_margin == pytest.approx(np.pi - abs(phase), rel=1e-9)


def test_delay_margin_is_where_the_loop_turns_unstable(spec, design):
    """The characteristic function 1 + L(jω) e^{−jωτ} is zero at the margin."""
    loop = close_loop(design)
    margins = loop_margins(loop)
    for motor in range(2):
        b = np.zeros(6)
        b[:4] = loop.design.plant.B[:, motor]
        c = -loop.voltage_from_state[motor]
        omegas = np.linspace(0.5, 60, 20_001)
        pencils = 1j * omegas[:, None, None] * np.eye(6) - (loop.A + np.outer(b, c))
        L = np.linalg.solve(pencils, b[:, None])[:, :, 0] @ c
        distance = np.abs(1 + L * np.exp(-1j * omegas * margins[motor].delay_margin))
        assert distance.min() < 5e-3
        assert np.abs(1 + L * np.exp(-1j * omegas * 0.5 * margins[motor].delay_margin)).min() > 0.1


@settings(max_examples=20)
@given(pole_sets())
def test_suggested_pi_is_stable_and_as_damped_as_promised(poles):
    placed = design(plant(preset().parameters), poles)
    suggestion = suggest_pi(placed)
    assert suggestion.loop.stable
    own = np.min(-poles.array.real / np.abs(poles.array))
    found = suggestion.loop.poles
    assert np.min(-found.real / np.abs(found)) >= min(DAMPING, EASED * own) - 1e-3


def test_suggested_pi_is_for_stable_poles_only(spec):
    placed = design(plant(spec.parameters), PoleSet([1.0, -2.0, -3.0, -4.0]))
    with pytest.raises(ValueError, match="stable poles"):
        suggest_pi(placed)


def test_cross_pairing_works_on_the_rig_that_asks_for_it():
    p = preset("quanser-aero")
    placed = design(plant(p.parameters), p.poles, p.structure)
    crossed = suggest_pi(placed, replace(p.outer, pairing="cross"))
    assert crossed.loop.stable
    diagonal = suggest_pi(placed, p.outer)
    assert crossed.loop.poles[0].real < diagonal.loop.poles[0].real
