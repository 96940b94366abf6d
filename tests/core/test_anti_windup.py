"""Back-calculation's tracking time: how fast an integral lets go of what a limit cuts off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from heli2dof_core import InvalidInputError, OuterLoop, PIGains, Scenario, close_loop, design, plant, preset
from heli2dof_core.kernels import rig as kernel
from heli2dof_core.kernels.layout import PAPER
from heli2dof_core.scenario import Digital
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.nonlinear import NonlinearLoop, simulate_nonlinear
from tests.strategies import pole_sets, rigs

LIMITS = preset().limits
EXACT = Digital(encoders=(0, 0), rates="true")
outers = st.builds(
    OuterLoop,
    pitch=st.builds(PIGains, st.floats(0.5, 60), st.floats(0.02, 5)),
    yaw=st.builds(PIGains, st.floats(0.5, 60), st.floats(0.02, 5)),
    pairing=st.sampled_from(["diagonal", "cross"]),
    decoupler=st.booleans(),
)
times = st.floats(1e-3, 10.0)


@given(rigs(), pole_sets(), outers, times, st.lists(st.floats(-3, 3), min_size=6, max_size=6))
def test_the_integrals_voltage_follows_the_limits_with_the_tracking_time(rig, poles, outer, tracking, y):
    """Whatever loop, rig and state: I (ż − e) = (given − asked) / T_t, motor by motor."""
    loop = close_loop(design(plant(rig), poles), outer)
    assume(np.linalg.cond(loop.integral) < 1e6)  # both integrals reach the motors
    scenario = Scenario(theta=0.3, psi=0.4, anti_windup="back-calculation", tracking_time=tracking)
    system = NonlinearLoop.of(loop, LIMITS, scenario)
    y, slopes = np.array(y), np.zeros((8, 8))
    asked = system.gain @ y + system.offset
    limited = np.clip(asked, -system.limits, system.limits)
    modes = system.modes.copy()
    modes[:2] = np.where(limited == asked, kernel.INSIDE, kernel.BEYOND)
    modes[2:4] = np.sign(asked)
    kernel.state_derivative(PAPER, y, system.constants, modes, slopes, 0)
    followed = loop.integral @ (slopes[0, 4:6] - (system.reference - y[:2]))
    scale = np.max(np.abs(asked)) / tracking
    np.testing.assert_allclose(followed, (limited - asked) / tracking, atol=1e-9 * scale, rtol=1e-7)


@pytest.mark.parametrize("digital", [None, EXACT, Digital(delay=True)], ids=["continuous", "exact", "late"])
@pytest.mark.parametrize("tracking", [0.02, 0.1, 0.5])
def test_pressed_onto_its_stop_the_loop_asks_for_more_than_it_gets_by_the_tracking_time(
    spec, digital, tracking
):
    """The error is constant there, so the excess ends at (k_p / T_i) e T_t: what one T_t of it adds."""
    loop = close_loop(design(plant(spec.parameters), spec.poles))
    scenario = Scenario(
        theta=1.0, psi=0.0, anti_windup="back-calculation", tracking_time=tracking, duration=20 * tracking + 6
    )
    run = simulate_nonlinear if digital is None else simulate_digital
    extra = () if digital is None else (digital,)
    end = run(loop, LIMITS, scenario, *extra).states[:, -1]
    system = NonlinearLoop.of(loop, LIMITS, scenario)
    asked = system.gain[0] @ end + system.offset[0]
    error = 1.0 - LIMITS.theta
    assert end[0] == pytest.approx(LIMITS.theta)
    gains = spec.outer.pitch
    encoder = (
        2 * np.pi / 4096 * gains.kp * (1 + tracking / gains.ti) if digital and any(digital.encoders) else 0
    )
    assert asked - LIMITS.V_p == pytest.approx(
        gains.kp / gains.ti * error * tracking, rel=1e-3, abs=3 * encoder
    )


@pytest.mark.parametrize("digital", [None, EXACT], ids=["continuous", "digital"])
def test_the_shorter_the_tracking_time_the_sooner_the_motor_leaves_its_limit(design, digital):
    loop = close_loop(design)
    released, left = [], []
    for tracking in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0):
        scenario = Scenario(
            theta=0.6,
            psi=0.0,
            anti_windup="back-calculation",
            tracking_time=tracking,
            samples=5001,
            rtol=1e-9,
        )
        wide = replace(LIMITS, theta=None)
        response = (
            simulate_nonlinear(loop, wide, scenario)
            if digital is None
            else simulate_digital(loop, wide, scenario, digital)
        )
        at_limit = response.voltages[0] >= LIMITS.V_p * (1 - 1e-9)
        released.append(response.t[np.argmin(at_limit)])
        left.append(np.max(response.states[4]))
    assert released[0] > 0 and np.all(np.diff(released) > 0)
    assert np.all(np.diff(left) > 0)


def test_the_integral_time_is_the_tracking_time_of_who_names_none(design):
    loop = close_loop(design, OuterLoop(pitch=PIGains(30.0, 0.3), yaw=PIGains(20.0, 0.3)))
    scenario = Scenario(theta=0.6, psi=1.5, anti_windup="back-calculation")
    named = replace(scenario, tracking_time=0.3)
    for run in (
        lambda s: simulate_nonlinear(loop, LIMITS, s),
        lambda s: simulate_digital(loop, LIMITS, s, EXACT),
    ):
        np.testing.assert_array_equal(run(scenario).angles, run(named).angles)
        assert np.max(np.abs(run(scenario).angles - run(replace(named, tracking_time=0.03)).angles)) > 1e-3


def test_tracking_faster_than_the_samples_is_told(design):
    loop = close_loop(design)
    scenario = Scenario(theta=0.6, anti_windup="back-calculation", tracking_time=0.001)

    def codes(scenario):
        return {f.code for f in simulate_digital(loop, LIMITS, scenario, EXACT).findings}

    assert "fast_tracking" in codes(scenario)
    for calm in ({"tracking_time": 0.01}, {"anti_windup": "clamping"}, {"saturation": False}):
        assert "fast_tracking" not in codes(replace(scenario, **calm))


@pytest.mark.parametrize("tracking", [0.0, -1.0, 1e-5, 1e5])
def test_a_tracking_time_that_is_none_is_refused_by_name(tracking):
    with pytest.raises(InvalidInputError) as caught:
        Scenario(tracking_time=tracking)
    assert caught.value.field == "tracking_time"
