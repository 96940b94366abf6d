"""The environment of Gymnasium: its checker, policies of both kinds, its flights as logs."""

from __future__ import annotations

import json
from dataclasses import replace

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import heli2dof_core as heli
from heli2dof_core.flight import FlightLog, simulate_flight
from heli2dof_core.gym_env import HeliEnv

NAME = "heli2dof_core.gym_env:heli2dof/Heli-v0"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("choices", [{}, {"gust": 0.1, "effort": 0.1, "samples": 1, "seconds": 2.0}])
def test_the_checker_has_nothing_to_say(choices):
    """Within `pytest` a warning is an error."""
    check_env(gymnasium.make(NAME, **choices).unwrapped)


def test_many_fly_at_once_and_begin_again_by_themselves():
    """As libraries of policies use it: 32-bit actions, one reset, then steps."""
    envs = gymnasium.make_vec(NAME, num_envs=3, vectorization_mode="sync", seconds=0.2)
    observations, _ = envs.reset(seed=3)
    assert observations.shape == (3, 6) and len(np.unique(observations[:, 4])) == 3
    truncations = 0
    for _ in range(25):
        actions = envs.action_space.sample()
        assert actions.dtype == np.float32
        observations, rewards, terminated, truncated, _ = envs.step(actions)
        truncations += truncated.sum()
        assert np.isfinite(observations).all() and (rewards <= 0.0).all() and not terminated.any()
    assert truncations == 6


def pd_policy(env: HeliEnv, observation: np.ndarray) -> np.ndarray:
    """A PD controller about each axis through the inverse of the thrust matrix, above the trim."""
    p, limits = env.design.parameters, env.design.limits
    theta, psi, theta_dot, psi_dot, wanted_theta, wanted_psi = observation
    torque = (8.0 * (wanted_theta - theta) - 4.0 * theta_dot, 8.0 * (wanted_psi - psi) - 4.0 * psi_dot)
    inertia = np.array([p.alpha, p.beta])
    thrust = np.array([[p.K_pp, p.K_py], [p.K_yp, p.K_yy]])
    weight = np.array([p.m * p.g * p.l * np.cos(theta) + p.K_s * theta, 0.0])
    return np.linalg.solve(thrust, inertia * torque + weight) / [limits.V_p, limits.V_y]


def returns(env: HeliEnv, policy, seed: int) -> float:
    """Sum of an episode's rewards."""
    observation, _ = env.reset(seed=seed)
    total, over = 0.0, False
    while not over:
        assert env.observation_space.contains(observation)
        observation, reward, terminated, truncated, _ = env.step(policy(observation))
        total, over = total + reward, terminated or truncated
    return total


def test_a_random_policy_flies_and_a_pd_policy_flies_well():
    env = HeliEnv(gust=0.05)
    env.action_space.seed(4)
    steered = returns(env, lambda seen: pd_policy(env, seen), 4)
    assert env.rig is not None and env.rig.time == pytest.approx(env.seconds)
    last = env.log()
    chance = returns(env, lambda _seen: env.action_space.sample(), 4)
    assert chance < 20 * steered < 0.0  # the same set points and gusts
    assert steered > -1.5  # rad² s in 20 s of four steps
    body = json.loads(json.dumps(last.body()))
    course = simulate_flight(FlightLog.read(body))  # which proves the states that the log tells
    assert course.apart == 0.0 and len(course.t) == last.ticks


def test_an_episode_is_its_seed():
    noisy = heli.Spec.from_preset("quanser-aero")
    noisy = replace(noisy, scenario=replace(noisy.scenario, noise=(1e-3, 1e-3), digital=heli.Digital(0.004)))
    flown = []
    for seed in (1, 1, 2):
        env = HeliEnv(noisy, gust=0.2, seconds=3.0, every=1.0)
        env.action_space.seed(0)
        observations = [env.reset(seed=seed)[0]]
        observations += [env.step(env.action_space.sample())[0] for _ in range(50)]
        flown.append(np.array(observations))
    np.testing.assert_array_equal(flown[0], flown[1])
    assert (flown[0] != flown[2]).any()


def test_a_reward_is_the_integral_of_the_errors_and_of_the_effort():
    env = HeliEnv(effort=0.3, seconds=2.0)
    env.reset(seed=0, options={"reference": (0.1, -0.2)})
    total = sum(env.step(np.array([0.5, -0.25]))[1] for _ in range(100))
    course = simulate_flight(env.log())
    step = course.t[1]
    errors = np.column_stack((course.theta, course.psi)) - [0.1, -0.2]
    shares = np.array([0.5, -0.25])
    expected = (errors**2).sum() * step + 0.3 * (shares**2).sum() * 2.0
    assert -total == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(course.references, np.broadcast_to([0.1, -0.2], (1000, 2)))
    np.testing.assert_allclose(course.voltages[5], shares * [env.design.limits.V_p, env.design.limits.V_y])


def test_actions_beyond_the_limits_are_the_limits():
    env = HeliEnv()
    env.reset(seed=0)
    info = env.step(np.array([3.0, -3.0]))[4]
    assert info["volts"].tolist() == [env.design.limits.V_p, -env.design.limits.V_y]


@pytest.mark.parametrize(
    ("choices", "field"),
    [
        ({"seconds": 0.0}, "seconds"),
        ({"samples": 0}, "samples"),
        ({"every": -1.0}, "every"),
        ({"span": (1.0, -1.0)}, "span"),
        ({"gust": float("nan")}, "gust"),
        ({"effort": -1.0}, "effort"),
        ({"render_mode": "human"}, "render_mode"),
    ],
)
def test_what_is_out_of_range_is_named(choices, field):
    with pytest.raises(heli.InvalidInputError) as refused:
        HeliEnv(**choices)
    assert refused.value.field == field


def test_an_episode_that_flies_away_terminates():
    wild = heli.Spec.from_preset("quanser-2dof-manual")
    env = HeliEnv(replace(wild, limits=replace(wild.limits, V_y=1e3)), samples=100)
    env.reset(seed=0)
    terminated = False
    for _ in range(100):
        observation, reward, terminated, _, info = env.step(np.array([0.0, 1.0], dtype=np.float32))
        assert env.observation_space.contains(observation) and np.isfinite(reward)
        if terminated:
            break
    assert terminated and "150" in info["ended"] and info["volts"][1] == 1e3
    assert simulate_flight(env.log()).ended


def test_nothing_flies_before_the_reset():
    env = HeliEnv()
    for call in (lambda: env.step(np.zeros(2)), env.log):
        with pytest.raises(heli.InvalidInputError, match="nothing"):
            call()
    env.reset(seed=0)
    with pytest.raises(heli.InvalidInputError, match="nothing was flown"):
        env.log()
