"""The digital rig against a plain loop of SciPy's, sample by sample; disturbances against the linear theory."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

from heli2dof_core import InvalidInputError, Limits, Scenario, close_loop, design, plant, preset
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import simulate_nonlinear
from heli2dof_core.spec import Digital, Disturbance
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
    x, z, waiting, states = np.zeros(4), np.zeros(2), None, []
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
        held = given if waiting is None or not digital.delay else waiting
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
    assert caught.value.field == "scenario.digital.sample_time"


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
