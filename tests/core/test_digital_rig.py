"""The digital rig against a plain loop of SciPy's, sample by sample; disturbances against the linear theory."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete, dlsim

from heli2dof_core import InvalidInputError, Limits, Scenario, close_loop, design, plant, preset
from heli2dof_core.scenario import Digital, Disturbance
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import simulate_nonlinear
from heli2dof_core.simulation.recorded import run_recorder
from tests.core.test_nonlinear_response import independent_rates

LIMITS = preset().limits
EXACT = Digital(encoders=(0, 0), rates="true")


def by_hand(loop, scenario, digital, samples):
    """States at the samples, by solve_ivp between them and a controller written out here.

    The integrals are those that the sample leaves behind.
    """
    rig, trim, K = loop.design.plant.parameters, loop.design.plant.trim, loop.design.K
    kp = np.array([loop.outer.pitch.kp, loop.outer.yaw.kp])
    ti = np.array([loop.outer.pitch.ti, loop.outer.yaw.ti])
    w, zeta, Ts = 2 * np.pi * 20, 0.85, digital.sample_time
    continuous = (
        np.array([[0, 1], [-(w**2), -2 * zeta * w]]),
        np.array([[0.0], [1]]),
        np.array([[0, w**2]]),
        [[0.0]],
    )
    F, b, C, _, _ = cont2discrete(continuous, Ts)
    filters = np.zeros((2, 2))
    r, limits = np.array([scenario.theta, scenario.psi]), np.array([LIMITS.V_p, LIMITS.V_y])
    x, z, waiting, states = np.zeros(4), np.zeros(2), trim, []
    for _ in range(samples):
        before = x.copy()
        angles = x[:2].copy()
        for i, counts in enumerate(digital.encoders):
            if counts:
                angles[i] = np.floor(angles[i] * counts / (2 * np.pi) + 0.5) * 2 * np.pi / counts
        if digital.rates == "true":
            rates = x[2:]
        else:
            rates = (filters @ C.T).ravel()
            filters = filters @ F.T + angles[:, None] * b.T
        e = r - angles
        asked = trim - K @ [*angles, *rates] + kp * (e + z / ti)
        given = np.clip(asked, -limits, limits)
        held = waiting if digital.delay else given
        waiting = given
        z = z + Ts * np.where((given != asked) & (e * asked > 0), 0.0, e)
        states.append([*before, *z])
        rate = independent_rates(rig, lambda _x, v=held: (*v, ()))
        x = solve_ivp(rate, (0, Ts), x, "DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
    return np.array(states)


@pytest.mark.parametrize(
    "digital",
    [
        EXACT,
        replace(EXACT, rates="filtered", sample_time=0.005),
        Digital(sample_time=0.01, delay=True),
        Digital(sample_time=0.02),
    ],
    ids=["exact", "filtered", "late", "slow"],
)
def test_the_digital_rig_is_scipys_sample_by_sample(design, digital):
    loop, count = close_loop(design), 60
    scenario = Scenario(0.3, 1.2, duration=(count - 1) * digital.sample_time, samples=count, rtol=1e-10)
    own = simulate_digital(loop, LIMITS, scenario, digital)
    expected = by_hand(loop, scenario, digital, count)
    assert max(own.saturated) > 0
    np.testing.assert_allclose(own.angles.T, expected[:, :2], atol=1e-7)
    np.testing.assert_allclose(own.states.T, expected, atol=1e-5)  # rates are some fifty times the angles


def sampled_loop(loop, Ts, *, late):
    """The linear loop at its samples, in deviations: x, z and the voltages on their way, as SciPy's `dlti` has it."""
    plant, K = loop.design.plant, loop.design.K
    F, G, *_ = cont2discrete((plant.A, plant.B, np.eye(4), np.zeros((4, 2))), Ts)
    C, kp = np.eye(2, 4), np.diag([loop.outer.pitch.kp, loop.outer.yaw.kp])
    ki = np.diag([loop.outer.pitch.kp / loop.outer.pitch.ti, loop.outer.yaw.kp / loop.outer.yaw.ti])
    law = np.hstack([-K - kp @ C, ki])
    integrals = np.hstack([-Ts * C, np.eye(2)])
    if not late:
        A = np.vstack([np.hstack([F, np.zeros((4, 2))]) + G @ law, integrals])
        return A, np.vstack([G @ kp, Ts * np.eye(2)]), law, kp
    A = np.block([[F, np.zeros((4, 2)), G], [integrals, np.zeros((2, 2))], [law, np.zeros((2, 2))]])
    B = np.vstack([np.zeros((4, 2)), Ts * np.eye(2), kp])
    return A, B, np.hstack([np.zeros((2, 6)), np.eye(2)]), np.zeros((2, 2))


@pytest.mark.parametrize("late", [False, True], ids=["at once", "late"])
@pytest.mark.parametrize(("Ts", "start"), [(0.01, 0.0), (0.02, 0.0), (0.005, 0.3)])
def test_small_motions_are_those_of_the_loop_in_z(design, Ts, start, late):
    """The delay is a state that starts at 0, so that the first voltages are late as all others are."""
    loop, count, share = close_loop(design), 200, 1e-4
    A, B, C, D = sampled_loop(loop, Ts, late=late)
    x_0 = np.zeros(len(A))
    x_0[0] = start
    _, volts, states = dlsim((A, B, C, D, Ts), np.tile([0.2, -0.1], (count, 1)), x0=x_0)
    digital = replace(EXACT, sample_time=Ts, delay=late)
    scenario = Scenario(
        0.2 * share,
        -0.1 * share,
        duration=(count - 1) * Ts,
        samples=count,
        initial=(start * share, 0.0, 0.0, 0.0),
        saturation=False,
        rtol=1e-11,
    )
    own = simulate_digital(loop, LIMITS, scenario, digital)
    np.testing.assert_allclose(own.angles.T / share, states[:, :2], atol=1e-4)
    deviations = (own.voltages.T - loop.design.plant.trim) / share
    np.testing.assert_allclose(deviations, volts, atol=2e-2)
    if late:
        np.testing.assert_array_equal(own.voltages[:, 0], loop.design.plant.trim)


@pytest.mark.parametrize(("Ts", "overshoot"), [(0.01, 4.54), (0.02, 5.39)])
def test_overshoot_of_a_late_controller_is_that_of_the_loop_in_z(design, Ts, overshoot):
    loop, count = close_loop(design), 150
    A, B, C, D = sampled_loop(loop, Ts, late=True)
    _, _, states = dlsim((A, B, C, D, Ts), np.tile([0.2, 0.0], (count, 1)))
    assert 100 * (np.max(states[:, 0]) / 0.2 - 1) == pytest.approx(overshoot, abs=0.01)
    free = Limits(V_p=1e6, V_y=1e6)
    scenario = Scenario(theta=2e-4, duration=(count - 1) * Ts, samples=count, rtol=1e-11)
    own = simulate_digital(loop, free, scenario, replace(EXACT, sample_time=Ts, delay=True))
    assert 100 * (np.max(own.angles[0]) / 2e-4 - 1) == pytest.approx(overshoot, abs=0.02)


def test_until_the_first_voltages_arrive_the_motors_have_the_trim(design):
    """Fed forward, within the limits; and none where nothing is fed forward."""
    loop, late = close_loop(design), Digital(sample_time=0.01, delay=True)
    scenario = Scenario(theta=0.2, duration=0.05, samples=6)
    plain = simulate_digital(loop, LIMITS, scenario, late).voltages[0]
    np.testing.assert_allclose(plain[:2], [12.5348, 18.5348], atol=1e-4)
    at_once = simulate_digital(loop, LIMITS, scenario, replace(late, delay=False)).voltages[0]
    assert at_once[0] == plain[1]
    tight = simulate_digital(loop, Limits(V_p=10.0, V_y=15.0), scenario, late).voltages[:, 0]
    np.testing.assert_allclose(tight, [10.0, loop.design.plant.trim[1]])
    unfed = simulate_digital(loop, LIMITS, replace(scenario, trim_feedforward=False), late).voltages
    np.testing.assert_array_equal(unfed[:, 0], 0)


def test_a_recorded_rig_keeps_its_recorded_voltages_until_the_first_ones_arrive(design):
    loop, late = close_loop(design), Digital(sample_time=0.01, delay=True)
    references = np.tile([0.1, 0.0], (5, 1))
    given = run_recorder(loop, LIMITS, late, references, voltages=np.array([14.0, -40.0])).voltages
    np.testing.assert_allclose(given[0], [14.0, -LIMITS.V_y])
    own = run_recorder(loop, LIMITS, late, references).voltages
    np.testing.assert_array_equal(own[0], loop.design.plant.trim)
    assert own[1, 0] > own[0, 0] + 1


@pytest.mark.parametrize("start", [0.9, -0.9, 0.7, 100.0])
@pytest.mark.parametrize(
    "digital", [Digital(), replace(EXACT, delay=True, sample_time=0.01)], ids=["own", "late"]
)
def test_a_start_beyond_a_stop_is_a_start_at_it(design, start, digital):
    """Nothing jumps: as if the start had been given at the stop, for rig, encoders, filters and voltages alike."""
    loop, limits = close_loop(design), replace(LIMITS, theta=0.7)
    side = np.sign(start)

    def run(theta, rate=0.0):
        scenario = Scenario(theta=0.2 * side, duration=0.5, samples=251, initial=(theta, None, rate, 0.1))
        return simulate_digital(loop, limits, scenario, digital), simulate_nonlinear(loop, limits, scenario)

    own, continuous = run(start, -0.5 * side)
    at_stop, _ = run(0.7 * side)
    assert own.angles[0, 0] == 0.7 * side
    assert continuous.angles[0, 0] == pytest.approx(
        0.7 * side, rel=1e-11
    )  # just inside, if it leaves at once
    np.testing.assert_array_equal(own.states, at_stop.states)
    np.testing.assert_array_equal(own.voltages, at_stop.voltages)
    assert np.max(np.abs(np.diff(own.angles[0]))) < 0.02
    assert ("starts_on_stop" in {f.code for f in own.findings}) == (abs(start) > 0.7)


def test_fast_sampling_tends_to_the_continuous_controller(design):
    """The difference falls in proportion to the sample time."""
    loop, scenario = close_loop(design), Scenario(theta=0.2, psi=0.5, rtol=1e-9)
    continuous = simulate_nonlinear(loop, LIMITS, scenario).angles
    gaps = [
        np.max(
            np.abs(
                simulate_digital(loop, LIMITS, scenario, replace(EXACT, sample_time=Ts)).angles - continuous
            )
        )
        for Ts in (2e-3, 1e-3, 5e-4)
    ]
    assert gaps[0] / gaps[1] == pytest.approx(2, rel=0.1)
    assert gaps[1] / gaps[2] == pytest.approx(2, rel=0.1)
    assert gaps[2] < 2e-4


def test_voltages_are_held_between_samples(design):
    scenario = Scenario(theta=0.2, psi=0.5, duration=1.0, samples=1001)
    response = simulate_digital(close_loop(design), LIMITS, scenario, Digital(sample_time=0.02))
    index = np.floor(response.t / 0.02 + 1e-9).astype(int)
    for motor in response.voltages:
        assert all(np.ptp(motor[index == k]) == 0 for k in range(50))


def test_noise_repeats_with_its_seed_and_shakes_the_voltages(design):
    loop, scenario = close_loop(design), Scenario(theta=0.2)
    quiet, one, again, other = (
        simulate_digital(loop, LIMITS, scenario, d)
        for d in (Digital(), Digital(noise=1e-2), Digital(noise=1e-2), Digital(noise=1e-2, seed=1))
    )
    np.testing.assert_array_equal(one.angles, again.angles)
    assert np.max(np.abs(one.angles - other.angles)) > 1e-5
    assert np.std(np.diff(one.voltages[0])) > 3 * np.std(np.diff(quiet.voltages[0]))


def test_slow_sampling_is_told_and_too_many_samples_are_refused(design):
    loop, scenario = close_loop(design), Scenario(theta=0.1)
    assert "slow_sampling" not in {
        f.code for f in simulate_digital(loop, LIMITS, scenario, Digital()).findings
    }
    slow = simulate_digital(loop, LIMITS, scenario, Digital(sample_time=0.05))
    assert "slow_sampling" in {f.code for f in slow.findings}
    with pytest.raises(InvalidInputError) as caught:
        Scenario(duration=600.0, digital=Digital(sample_time=1e-3))
    assert caught.value.field == "digital.sample_time"


@pytest.mark.parametrize("time", [0.0, 0.503, 1.0])
def test_a_small_disturbance_moves_the_rig_as_linear_theory_says(spec, time):
    """Volts on the inputs: the linear loop's response to B d, shifted in time."""
    loop = close_loop(design(plant(spec.parameters), spec.poles))
    free, size = Limits(V_p=1e6, V_y=1e6), 1e-3
    scenario = Scenario(
        disturbance=Disturbance(V_p=size, V_y=-size, time=time), duration=2.0, samples=2001, rtol=1e-10
    )
    own = simulate_nonlinear(loop, free, scenario)
    B = np.zeros(6)
    B[:4] = loop.design.plant.B @ [size, -size]
    t = own.t[own.t >= time - 1e-12]
    expected = solve_ivp(
        lambda _t, x: loop.A @ x + B, (time, 2.0), np.zeros(6), "DOP853", t_eval=t, rtol=1e-10, atol=1e-14
    ).y
    assert np.max(np.abs(own.angles[:, own.t < time])) < 1e-9 if time else True
    np.testing.assert_allclose(own.angles[:, -len(t) :], expected[:2], atol=1e-8)
    assert np.max(np.abs(expected[:2])) > 5e-6


def test_a_disturbance_reaches_the_digital_rig_with_its_next_sample(design):
    loop = close_loop(design)
    scenario = Scenario(disturbance=Disturbance(V_p=2.0, time=0.5), duration=1.5, rtol=1e-8)
    digital = simulate_digital(loop, LIMITS, scenario, replace(EXACT, sample_time=1e-3))
    continuous = simulate_nonlinear(loop, LIMITS, scenario)
    assert np.max(np.abs(continuous.angles[0])) > 5e-3
    np.testing.assert_allclose(digital.angles, continuous.angles, atol=2e-4)
    linear = simulate_linear(loop, scenario)  # which ignores it
    assert np.max(np.abs(linear.angles)) == 0
