"""What a finding names as the cause is the cause: taking it away takes the finding away."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from heli2dof_core import (
    AxisFriction,
    Digital,
    Friction,
    Observer,
    PoleSet,
    Rotor,
    Rotors,
    Spec,
    evaluate,
    place,
    suggest_pi,
)
from heli2dof_core.errors import InvalidInputError, UncontrollableError
from heli2dof_core.evaluate import loop_of
from heli2dof_core.export import FORMATS
from heli2dof_core.robustness import Uncertainty, cloud
from heli2dof_core.tables import number

CURVED = Rotors(Rotor(0.1, "quadratic", 1.0), Rotor(0.1, "quadratic", 1.0))


def messages(spec: Spec) -> dict[str, str]:
    return {f.code: f.message for f in evaluate(spec, each_axis=True).findings}


def whole_matrix(spec: Spec, tau: float) -> np.ndarray:
    """Of x, v and z under a K that feeds the rotors' speeds back, both rotors lagged by tau."""
    design, outer = place(spec), spec.outer
    A, B, K = design.plant.A, design.plant.B, design.K
    P = np.diag([outer.pitch.kp, outer.yaw.kp])
    by_error = np.diag([outer.pitch.kp / outer.pitch.ti, outer.yaw.kp / outer.yaw.ti])
    law = np.hstack([-K - np.hstack([P, np.zeros((2, 4))]), by_error]) / tau
    rig = np.hstack([A, B, np.zeros((4, 2))])
    lag = np.hstack([np.zeros((2, 4)), -np.eye(2) / tau, np.zeros((2, 2))])
    return np.vstack([rig, lag + law, np.hstack([-np.eye(2, 6), np.zeros((2, 2))])])


@pytest.mark.parametrize("tau", [(0.02, 0.1), (0.05, 0.5), (0.5, 0.05)])
def test_a_loop_that_lives_by_the_rotors_difference_is_not_called_unlimited(tau):
    """Stable with its own two lags: with both as slow as the slower one, the eigenvalues decide."""
    spec = Spec.from_preset(rotors=Rotors(*map(Rotor, tau)), place_rotors=True)
    loop, slower = loop_of(spec), max(tau)
    assert loop.stable
    if np.linalg.eigvals(whole_matrix(spec, slower)).real.max() > 0:
        assert loop.lag_margin == slower
        assert "lag_unlimited" not in messages(spec)
    else:
        margin = loop.lag_margin
        assert margin is not None and margin > slower
        assert abs(np.linalg.eigvals(whole_matrix(spec, margin)).real.max()) < 1e-6


def test_one_rotor_that_follows_at_once_is_enough_to_live_by():
    base = Spec.from_preset()
    for own in (Rotors(), Rotors(Rotor(0.01)), Rotors(yaw=Rotor(0.01))):
        assert "lives_by_fast_rotors" in messages(base.changed(rotors=own))
    assert "lives_by_fast_rotors" not in messages(base.changed(rotors=Rotors(Rotor(0.01), Rotor(0.01))))


def test_an_observer_that_does_not_settle_is_named_and_not_the_loops():
    spec = Spec.from_preset(observer=Observer(PoleSet([1, 2, -3, -4])), measured="observer")
    found = messages(spec)
    assert "at 2 rad/s" in found["observer_unstable"]
    assert not {"pi_unstable", "loop_unstable"} & set(found)
    assert not {"observer_unstable", "pi_unstable"} & set(messages(spec.changed(observer=Observer())))


def test_thrust_without_slope_is_named_and_not_the_loops():
    spec = Spec.from_preset("quanser-aero", rotors=CURVED)
    found = messages(spec)
    assert "Both motors' thrust" in found["flat_thrust"] and "pi_unstable" not in found
    one = spec.changed(rotors=Rotors(CURVED.pitch, Rotor(0.1)))
    assert "The pitch motor's thrust" in messages(one)["flat_thrust"]
    assert "flat_thrust" not in messages(Spec.from_preset(rotors=CURVED))  # its motors turn at the trim


def test_what_the_linear_model_leaves_out_is_what_makes_the_difference():
    spec = Spec.from_preset(rotors=CURVED, place_rotors=True)
    assert "leaves out how thrust curves" in messages(spec)["unlike_linear"]
    straight = spec.changed(rotors=Rotors(Rotor(0.1), Rotor(0.1)))
    assert "curves" not in messages(straight).get("unlike_linear", "")
    sampled = replace(spec, scenario=replace(spec.scenario, digital=Digital(0.002), noise=(1e-5, 0.0)))
    assert "sampling, noise and how thrust curves" in messages(sampled)["unlike_linear"]


def test_an_error_that_stays_is_not_waited_for():
    """Ĝ(0)⁻¹ is the design's: off level it does not hold for motors that act otherwise than the design knows."""
    spec = Spec.from_preset(theta_0=0.3, outer="none", rotors=CURVED, reference=(0.2, 0.3), duration=10.0)
    linear = evaluate(spec).step["linear"].response
    assert abs(linear.theta[-1] - 0.2) > 0.002
    assert "such an error stays" in messages(spec)["not_settled"]


def test_a_lag_just_beyond_the_margin_is_told_from_it():
    message = messages(Spec.from_preset(rotors=Rotors(Rotor(0.16482), Rotor(0.16482))))["rotors_unstable"]
    assert "lag of 0.16482 s" in message and "less than 0.164812 s" in message


def test_noise_is_named_where_it_keeps_the_rig_from_settling():
    spec = Spec.from_preset()
    noisy = replace(spec, scenario=replace(spec.scenario, noise=(0.02, 0.0)))
    assert "Noise on the measured angles" in messages(noisy)["not_settled"]


def test_friction_is_named_where_it_holds_the_rig():
    spec = Spec.from_preset(friction=AxisFriction(Friction(0.0, 0.3), Friction(0.05)))
    assert "Friction holds" in messages(spec)["not_settled"]
    assert "not_settled" not in messages(spec.changed(friction=AxisFriction()))


def test_a_lag_too_short_to_be_seen_is_none():
    for tau in (5e-324, 1e-300, 1e-12, 9.9e-7):
        assert Rotor(tau) == Rotor() and Spec.from_preset(rotors=Rotors(Rotor(tau))).actuators is None
    assert Rotor(1e-6).tau == 1e-6


def test_suggested_values_know_the_rotors():
    """Damping is asked of the loop as far as the inner loop with its rotors has it: gains are not shut off."""
    spec = Spec.from_preset(poles=[-4, -3.5, -4, -3], rotors=Rotors(Rotor(0.16), Rotor(0.16)))
    found = suggest_pi(place(spec), spec.outer)
    assert found.loop.stable and float(found.loop.poles[0].real) < -0.2
    with pytest.raises(InvalidInputError, match="rotors make the inner loop unstable") as refused:
        suggest_pi(place(spec.changed(poles=[-12, -10, -9.25, -8.76], rotors=Rotors(Rotor(2.0), Rotor(2.0)))))
    assert refused.value.hint is not None and "place the rotors" in refused.value.hint
    with pytest.raises(UncontrollableError, match="does not change"):
        suggest_pi(place(Spec.from_preset("quanser-aero", rotors=CURVED)))


@pytest.mark.parametrize("digital", [None, Digital(0.004, noise=3e-4)])
def test_the_report_tells_of_the_sampling_and_all_the_noise_that_was_simulated(digital):
    spec = Spec.from_preset()
    spec = replace(spec, scenario=replace(spec.scenario, noise=(4e-4, 0.0), digital=digital))
    report = FORMATS["report"].content(spec).decode()
    assert f"digital controller, {'2' if digital is None else '4'} ms" in report
    theta = 4e-4 if digital is None else 5e-4
    assert f"standard deviations {number(np.degrees(theta))}°" in report


def test_an_uncertain_lag_that_is_not_there_is_refused_and_not_ignored():
    spec = Spec.from_preset(rotors=Rotors(Rotor(0.1)))
    assert cloud(spec, Uncertainty({"tau_p": 0.2}, samples=3)).done == 3
    with pytest.raises(InvalidInputError, match="yaw motor's rotor follows at once") as refused:
        cloud(spec, Uncertainty({"tau_p": 0.2, "tau_y": 0.2}, samples=3))
    assert refused.value.field == "spread.tau_y"
