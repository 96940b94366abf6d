"""The nonlinear response against laws and against SciPy."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from heli2dof_core import Limits, OuterLoop, PIGains, PoleSet, Scenario, close_loop, design, plant, preset
from heli2dof_core.compiled import accelerations
from heli2dof_core.engine import engine
from heli2dof_core.kernels import rig as kernel
from heli2dof_core.kernels.layout import PAPER, WORKSPACE
from heli2dof_core.scenario import Disturbance
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import NonlinearLoop, simulate_nonlinear
from tests.reference import Reference
from tests.strategies import STRUCTURES, rigs

twin = import_module("heli2dof_core.interpreted.dormand_prince")
FREE = Limits(V_p=1e6, V_y=1e6)
LIMITS = preset().limits


def independent_rates(rig, voltages):
    """Theory section 1, typed here from the sheet, with voltages as a function of the state."""
    ml2 = rig.m * rig.l**2

    def rates(_t, x):
        theta, _, theta_dot, psi_dot = x[:4]
        V_p, V_y, extra = voltages(x)
        s, c = np.sin(theta), np.cos(theta)
        pitch = rig.K_pp * V_p + rig.K_py * V_y - rig.B_p * theta_dot - rig.K_s * theta
        pitch -= ml2 * s * c * psi_dot**2 + rig.m * rig.g * rig.l * c
        yaw = rig.K_yp * V_p + rig.K_yy * V_y - rig.B_y * psi_dot + 2 * ml2 * s * c * theta_dot * psi_dot
        return [theta_dot, psi_dot, pitch / (rig.J_p + ml2), yaw / (rig.J_y + ml2 * c**2), *extra]

    return rates


@pytest.mark.parametrize("reference", [(0.3, 0.5), (0.5, 0.0), (0.0, 1.2)])
def test_saturating_response_is_scipys(spec, design, reference):
    """Limits without anti-windup: DOP853 at 1e-11 with a hand-written right-hand side."""
    loop = close_loop(design)
    trim, K = design.plant.trim, design.K
    limits = Limits(V_p=16.0, V_y=6.0)

    def voltages(x):
        error = np.array(reference) - x[:2]
        u = trim - K @ x[:4] + 30 * (error + x[4:] / 0.1)
        return (*np.clip(u, [-16, -6], [16, 6]), error)

    scenario = Scenario(*reference, anti_windup="none", rtol=1e-9)
    response = simulate_nonlinear(loop, limits, scenario)
    expected = solve_ivp(
        independent_rates(spec.parameters, voltages),
        (0, 5),
        np.zeros(6),
        "DOP853",
        t_eval=response.t,
        rtol=1e-11,
        atol=1e-12,
        max_step=0.01,
    )
    assert max(response.saturated) > 0
    np.testing.assert_allclose(response.angles, expected.y[:2], atol=1e-6)
    np.testing.assert_allclose(response.states[[0, 1, 4, 5]], expected.y[[0, 1, 4, 5]], atol=1e-6)
    np.testing.assert_allclose(response.states[2:4], expected.y[2:4], atol=1e-5)  # rad/s


def test_small_steps_tend_to_the_linear_response(design):
    """The difference to the linear response shrinks with the square of the step."""
    loop = close_loop(design)
    differences = []
    for size in (0.04, 0.02, 0.01):
        scenario = Scenario(theta=size, psi=size, rtol=1e-11)
        nonlinear = simulate_nonlinear(loop, FREE, scenario)
        linear = simulate_linear(loop, scenario)
        differences.append(np.max(np.abs(nonlinear.angles - linear.angles)))
    assert differences[0] / differences[1] == pytest.approx(4, rel=0.1)
    assert differences[1] / differences[2] == pytest.approx(4, rel=0.1)


def test_energy_is_conserved_without_friction_and_motors():
    """A rig that barely reacts to its motors swings as a spherical pendulum."""
    rig = preset().parameters.replaced(
        {"B_p": 0, "B_y": 0, "K_pp": 1e-5, "K_yy": 1e-5, "K_py": 0, "K_yp": 0, "K_s": 2.0}
    )
    placed = design(plant(rig), PoleSet([-1, -2, -3, -4]))
    loop = close_loop(placed, OuterLoop(pitch=PIGains(0, 1), yaw=PIGains(0, 1)))
    weak = Limits(V_p=1e-3, V_y=1e-3)  # at most 1e-8 N·m
    scenario = Scenario(
        initial=(0.3, 0.0, 0.2, 1.5), duration=5.0, samples=10_001, rtol=1e-10, trim_feedforward=False
    )
    response = simulate_nonlinear(loop, weak, scenario)
    theta, psi = response.angles
    h = response.t[1]
    rates = [np.gradient(a, h, edge_order=2) for a in (theta, psi)]
    ml2 = rig.m * rig.l**2
    energy = (
        0.5 * (rig.J_p + ml2) * rates[0] ** 2 + 0.5 * (rig.J_y + ml2 * np.cos(theta) ** 2) * rates[1] ** 2
    )
    energy += rig.m * rig.g * rig.l * np.sin(theta) + 0.5 * rig.K_s * theta**2
    assert np.ptp(theta) > 0.3
    assert np.ptp(energy[2:-2]) < 1e-5 * np.max(np.abs(energy))  # what the differences leave


def test_response_does_not_depend_on_its_grid_and_repeats(design):
    loop = close_loop(design)
    fine = simulate_nonlinear(loop, LIMITS, Scenario(theta=0.4, psi=0.8, samples=1001))
    coarse = simulate_nonlinear(loop, LIMITS, Scenario(theta=0.4, psi=0.8, samples=11))
    np.testing.assert_array_equal(fine.angles[:, ::100], coarse.angles)


def test_rest_stays_rest_with_feedforward_and_sags_without(spec):
    for theta_0 in (0.0, 0.3):
        loop = close_loop(design(plant(spec.parameters, theta_0), spec.poles))
        still = simulate_nonlinear(loop, LIMITS, Scenario())
        np.testing.assert_allclose(still.angles, [[theta_0], [0]] * np.ones((1, 501)), atol=1e-9)
        np.testing.assert_allclose(still.voltages[:, 0], loop.design.plant.trim)
        sagging = simulate_nonlinear(loop, LIMITS, Scenario(trim_feedforward=False))
        assert np.min(sagging.angles[0]) < theta_0 - 0.05
        assert sagging.angles[0, -1] == pytest.approx(theta_0, abs=1e-3)  # PI finds the trim


def test_voltages_keep_their_limits_and_the_share_is_told(design):
    response = simulate_nonlinear(close_loop(design), LIMITS, Scenario(theta=0.6, psi=1.5))
    assert np.all(np.abs(response.voltages[0]) <= 24) and np.all(np.abs(response.voltages[1]) <= 15)
    share = np.mean(np.abs(response.voltages) >= [[24 * (1 - 1e-9)], [15 * (1 - 1e-9)]], axis=1)
    assert response.saturated == pytest.approx(share, abs=2 / 501)  # the samples' share is coarser
    assert {"saturation_V_p", "saturation_V_y"} <= {f.code for f in response.findings}
    both = next(f.message for f in response.findings if f.code == "saturation_V_p")
    assert both.endswith(f"for {100 * response.saturated[0]:.1f} % of the time while both axes step at once.")
    free = simulate_nonlinear(close_loop(design), LIMITS, Scenario(theta=0.6, psi=1.5, saturation=False))
    assert np.max(np.abs(free.voltages[0])) > 24


@pytest.mark.parametrize(
    ("scenario", "motor", "words"),
    [
        (Scenario(theta=0.6), 0, "0.8 % of the pitch step"),
        (Scenario(theta=0.39), 0, "less than 0.1 % of the pitch step"),
        (Scenario(psi=1.5), 1, "3 % of the yaw step"),
        (Scenario(disturbance=Disturbance(V_p=60.0)), 0, "99 % of the time"),
    ],
)
def test_the_share_at_a_limit_says_of_which_step_and_is_never_none(design, scenario, motor, words):
    response = simulate_nonlinear(close_loop(design), LIMITS, scenario)
    assert response.saturated[motor] > 0
    assert any(f.message.endswith(f"V for {words}.") for f in response.findings)


def test_anti_windup_lowers_the_overshoot(design):
    loop, wide = close_loop(design), replace(LIMITS, theta=None)
    overshoot = {}
    for way in ("none", "clamping", "back-calculation"):
        response = simulate_nonlinear(loop, wide, Scenario(theta=0.6, anti_windup=way, duration=8.0))
        assert response.angles[0, -1] == pytest.approx(0.6, abs=1e-3)
        overshoot[way] = np.max(response.angles[0]) - 0.6
    assert overshoot["clamping"] < 0.5 * overshoot["none"]
    assert overshoot["back-calculation"] < 0.7 * overshoot["none"]


def test_pitch_stops_at_its_travel_and_leaves_when_the_torque_turns(design):
    loop = close_loop(design)
    pressed = simulate_nonlinear(loop, LIMITS, Scenario(theta=1.0))
    assert np.max(pressed.angles[0]) == pytest.approx(LIMITS.theta, abs=1e-9)
    assert pressed.angles[0, -1] == pytest.approx(LIMITS.theta, abs=1e-9)
    assert {"travel_stop", "reference_beyond_stop"} <= {f.code for f in pressed.findings}
    thrown = simulate_nonlinear(loop, LIMITS, Scenario(initial=(0.5, 0.0, 10.0, 0.0)))
    assert "travel_stop" in {f.code for f in thrown.findings}
    assert LIMITS.theta - 0.01 < np.max(thrown.angles[0]) <= LIMITS.theta
    assert thrown.angles[0, -1] == pytest.approx(0.0, abs=1e-3)
    free = simulate_nonlinear(loop, LIMITS, Scenario(initial=(0.5, 0.0, 10.0, 0.0), travel_stops=False))
    assert np.max(free.angles[0]) > LIMITS.theta


def test_very_fast_poles_are_simulated_all_the_same(spec):
    loop = close_loop(design(plant(spec.parameters), PoleSet([-1e4, -1.1e4, -9.0, -8.0])))
    response = simulate_nonlinear(loop, LIMITS, Scenario(theta=0.01, psi=0.1, rtol=1e-6))
    assert not {"integration_stopped", "diverges"} & {f.code for f in response.findings}
    assert np.all(np.isfinite(response.angles))


def test_unstable_designs_end_finite(spec):
    loop = close_loop(design(plant(spec.parameters), PoleSet([5.0, 4.0, 3.0, 2.0])))
    response = simulate_nonlinear(loop, LIMITS, Scenario(theta=0.2, psi=0.3))
    assert np.all(np.isfinite(response.angles)) and np.all(np.isfinite(response.voltages))


def random_loops(count, seed):
    """Stable loops of all structures, slow and fast, PI and none, near and far from the limits."""
    rng, found = np.random.default_rng(seed), 0
    while found < count:
        poles = PoleSet([*_pair(rng), *_pair(rng)])
        model = plant(preset().parameters, rng.uniform(-0.2, 0.2))
        outer = OuterLoop(
            "pi" if rng.random() < 0.8 else "none",
            PIGains(rng.uniform(2, 40), rng.uniform(0.08, 0.8)),
            PIGains(rng.uniform(2, 40), rng.uniform(0.08, 0.8)),
            decoupler=bool(rng.random() < 0.2),
        )
        loop = close_loop(design(model, poles, STRUCTURES[rng.integers(4)]), outer)
        if not loop.stable:
            continue
        found += 1
        windup = ("none", "clamping", "clamping", "clamping")[rng.integers(4)]
        reference = (rng.uniform(-0.6, 0.8), rng.uniform(-2, 2))
        yield loop, Scenario(*reference, duration=5.0, samples=501, rtol=1e-6, anti_windup=windup)


def _pair(rng):
    re = -rng.uniform(1, 15)
    if rng.random() < 0.5:
        im = rng.uniform(0.5, 8)
        return complex(re, im), complex(re, -im)
    return complex(re), complex(-rng.uniform(1, 15))


@pytest.mark.slow
def test_responses_are_those_of_scipy_from_event_to_event():
    """Against DOP853 at 1e-12 with events, in 200 random loops with limits, stops and clamping."""
    errors, saturating, stopped = [], 0, 0
    for loop, scenario in random_loops(200, seed=20_261_122):
        response = simulate_nonlinear(loop, LIMITS, scenario)
        expected = Reference(loop, LIMITS, scenario).run(response.t)
        errors.append(float(np.max(np.abs(response.angles.T - expected[:, :2]))))
        saturating += max(response.saturated) > 0
        stopped += "travel_stop" in {f.code for f in response.findings}
    print(
        f"{saturating} saturate, {stopped} meet a stop: median {np.median(errors):.1e}, worst {max(errors):.1e} rad"
    )
    assert saturating > 60 and stopped > 20
    assert max(errors) < 1e-5


def test_error_falls_with_the_tolerance(design):
    """Order 5 with error per step: the error is about proportional to the tolerance, switches or not."""
    loop = close_loop(design)
    for scenario in (Scenario(theta=0.1, psi=0.3), Scenario(theta=0.6, psi=1.5)):
        exact = Reference(loop, LIMITS, scenario).run(np.linspace(0, 5, 501))[:, :2].T
        errors = [
            np.max(np.abs(simulate_nonlinear(loop, LIMITS, replace(scenario, rtol=rtol)).angles - exact))
            for rtol in (1e-4, 1e-6, 1e-8)
        ]
        assert errors[1] < errors[0] / 20
        assert errors[2] < errors[1] / 20
        assert errors[2] < 1e-8


def test_a_later_start_of_the_grid_shifts_nothing(design):
    """The loop does not know what time it is: half a response, then the other half from its end."""
    loop = close_loop(design)
    system = NonlinearLoop.of(loop, LIMITS, Scenario(theta=0.5, psi=1.0, rtol=1e-10))
    t = np.linspace(0, 2, 201)
    whole, first, second = (np.empty((n, 6)) for n in (201, 101, 101))
    numbers = (1e-10, 1e-11, 100_000, np.empty(WORKSPACE))
    engine().integrate(PAPER, system.start.copy(), t, system.constants, system.modes.copy(), *numbers, whole)
    y, modes = system.start.copy(), system.modes.copy()
    engine().integrate(PAPER, y, t[:101], system.constants, modes, *numbers, first)
    engine().integrate(PAPER, y, t[100:], system.constants, modes, *numbers, second)
    np.testing.assert_allclose(np.vstack([first, second[1:]])[:, :4], whole[:, :4], atol=1e-8)


def test_clamping_slides_along_the_limit_instead_of_chattering(design):
    """Where both sides push the voltage onto its limit it stays there, with a handful of switches."""
    system = NonlinearLoop.of(close_loop(design), LIMITS, Scenario(theta=0.6, psi=1.5, rtol=1e-8))
    states = np.empty((2001, 6))
    t = np.linspace(0, 2, 2001)
    outcome, _, _, switches, _ = engine().integrate(
        PAPER,
        system.start.copy(),
        t,
        system.constants,
        system.modes.copy(),
        1e-8,
        1e-9,
        100_000,
        np.empty(WORKSPACE),
        states,
    )
    assert outcome == 0 and switches < 10
    asked = np.abs(system.gain @ states.T + system.offset[:, None]) / system.limits[:, None]
    assert np.sum(np.abs(asked - 1) < 1e-7) > 20


@given(
    st.floats(-1.5, 1.5), st.floats(-9, 9), st.floats(-9, 9), st.floats(-24, 24), st.floats(-15, 15), rigs()
)
def test_the_kernels_accelerations_are_those_derived(theta, theta_dot, psi_dot, V_p, V_y, rig):
    loop = close_loop(_any_design(rig))
    constants = NonlinearLoop.of(loop, FREE, Scenario()).constants
    own = kernel.accelerations(theta, theta_dot, psi_dot, V_p, V_y, constants)
    derived = accelerations()(theta, theta_dot, psi_dot, V_p, V_y, *rig.as_dict().values())
    scale = np.max(np.abs(derived)) + abs(rig.g) * rig.m * rig.l / rig.J_p + psi_dot**2 + theta_dot**2
    np.testing.assert_allclose(own, derived, rtol=1e-12, atol=1e-13 * (1 + scale))


def _any_design(rig):
    return design(plant(rig), PoleSet([-3, -4, -5, -6]))


def test_interpreted_and_compiled_kernels_agree_to_the_last_digit(design):
    for scenario in (
        Scenario(theta=0.6, psi=1.5, rtol=1e-6),
        Scenario(theta=1.0, psi=1.0, rtol=1e-6, anti_windup="back-calculation"),
        Scenario(initial=(0.5, 0.0, 10.0, 0.0), rtol=1e-6),
    ):
        system = NonlinearLoop.of(close_loop(design), LIMITS, scenario)
        courses = []
        for integrate in (engine().integrate, twin.integrate):
            states, t = np.empty((101, 6)), np.linspace(0, 3, 101)
            numbers = (1e-6, 1e-7, 10_000, np.empty(WORKSPACE))
            integrate(PAPER, system.start.copy(), t, system.constants, system.modes.copy(), *numbers, states)
            courses.append(states)
        np.testing.assert_array_equal(*courses)


def test_a_budget_of_steps_ends_what_is_too_fast(spec):
    loop = close_loop(design(plant(spec.parameters), PoleSet([-1e5, -9e4, -9.0, -8.0])))
    response = simulate_nonlinear(loop, FREE, Scenario(theta=0.1, duration=60.0))
    assert [f.code for f in response.findings] == ["integration_stopped"]  # and not that it grows
    assert np.all(np.isfinite(response.angles))
