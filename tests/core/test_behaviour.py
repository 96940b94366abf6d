"""Remarks on the closed loop: present where the responses and the margins say so, and nowhere else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from heli2dof_core import PRESETS, Digital, Disturbance, Rotor, Rotors, Spec, evaluate
from heli2dof_core.behaviour import AMPLE, DEAD_SAMPLES, SLOWER
from heli2dof_core.rotors import USUAL_LAG
from heli2dof_core.tables import number

OURS = {"short_delay_margin", "high_gain", "slow_pole", "not_settled", "unlike_linear"}
FAST = [-30, -31, -32, -33]


def codes(spec: Spec) -> set[str]:
    return {f.code for f in evaluate(spec, each_axis=True).findings}


def told(spec: Spec, code: str) -> str:
    (message,) = (f.message for f in evaluate(spec, each_axis=True).findings if f.code == code)
    return message


@pytest.mark.parametrize("name", PRESETS)
def test_what_the_presets_propose_needs_no_remark(name: str):
    assert not codes(Spec.from_preset(name)) & OURS


@pytest.mark.parametrize("first", [-900, -700, -450])
def test_one_pole_far_out_is_unwise_in_every_respect(first: float):
    spec = Spec.from_preset(poles=[first, -10, -9.25, -8.76])
    report = evaluate(spec, each_axis=True)
    found = {f.code: f.message for f in report.findings}
    assert {"high_gain", "slow_pole", "not_settled"} <= set(found)
    assert f"{np.max(np.abs(report.design.K[:, :2])) * np.pi / 180:.3g} V" in found["high_gain"]
    error = np.degrees(report.axis_steps["theta"]["nonlinear"].response.reference[0]) - np.degrees(
        report.axis_steps["theta"]["nonlinear"].response.theta[-1]
    )
    assert f"pitch ends {error:.2g}° from its reference" in found["not_settled"]


def test_the_delay_margin_is_held_against_the_sample_time():
    spec = Spec.from_preset(poles=[-900, -10, -9.25, -8.76])
    margins = evaluate(spec).margins
    assert margins is not None
    least = min(m.delay_margin for m in margins if m.delay_margin is not None)
    for share, short in ((1.02, True), (0.98, False)):
        digital = Digital(sample_time=share * least / DEAD_SAMPLES)
        own = replace(spec, scenario=replace(spec.scenario, digital=digital, duration=0.1))
        assert ("short_delay_margin" in codes(own)) is short
    assert "pitch motor" in told(spec, "short_delay_margin")


def lagged_poles(spec: Spec, tau: float) -> np.ndarray:
    """The loop's poles by the matrix of its parts: rotors between law and rig, both PI loops closed."""
    design, outer = evaluate(spec).design, spec.outer
    A, B, C, kp = design.plant.A, design.plant.B, np.eye(2, 4), np.diag([outer.pitch.kp, outer.yaw.kp])
    ki = kp @ np.diag([1 / outer.pitch.ti, 1 / outer.yaw.ti])
    law = np.hstack((-design.K - kp @ C, ki))
    whole = np.zeros((8, 8))
    whole[:4, :4], whole[:4, 6:], whole[4:6, :4] = A, B, -C
    whole[6:, :6], whole[6:, 6:] = law / tau, -np.eye(2) / tau
    return np.linalg.eigvals(whole)


@pytest.mark.parametrize(
    ("kp", "ti", "severity"),
    [
        (60, 0.1, "warning"),
        (30, 0.06, "warning"),
        (30, 0.1, "info"),
        (14, 0.08, "info"),
        (12, 0.08, None),
        (5, 0.3, None),
    ],
)
def test_a_design_that_lives_by_fast_rotors_is_told_of_it(kp: float, ti: float, severity: str | None):
    """Warned of where an Aero's rotors would do it, noted below twice their lag, and no word above."""
    spec = Spec.from_preset(pitch=(kp, ti), yaw=(kp, ti))
    report = evaluate(spec)
    limit = report.loop.lag_margin
    assert limit is not None
    rightmost = [np.max(lagged_poles(spec, share * limit).real) for share in (0.999, 1.001)]
    assert rightmost[0] < 0 < rightmost[1]
    found = [f for f in report.findings if f.code == "lives_by_fast_rotors"]
    expected = "warning" if limit < USUAL_LAG else "info" if limit < AMPLE * USUAL_LAG else None
    assert [f.severity for f in found] == ([] if expected is None else [expected]) and expected == severity
    assert all(f"{limit:.3g} s; an Aero's lag by {USUAL_LAG:g} s" in f.message for f in found)
    own = Rotor(0.5 * limit)
    assert "lives_by_fast_rotors" not in codes(
        spec.changed(rotors=Rotors(own, own))
    )  # the rig's own is known


def test_who_lives_by_no_rotors_is_told_so():
    """Low gains, which the rig's own damping bears whatever the rotors do."""
    spec = Spec.from_preset(poles=[-0.4412, -0.1094, -0.07397, -1.229], outer="none")
    assert "lag_unlimited" in codes(spec)
    design = evaluate(spec).design
    for tau in np.geomspace(1e-2, 1e4, 61):
        A = np.block([[design.plant.A, design.plant.B], [-design.K / tau, -np.eye(2) / tau]])
        assert np.max(np.linalg.eigvals(A).real) < 0


@pytest.mark.parametrize(
    ("poles", "pitch", "yaw"),
    [(FAST, (5, 5.0), (5, 5.0)), ([-9, -8, -7, -6], (1, 3.0), (30, 0.5)), (FAST, (30, 0.5), (1, 9.0))],
)
def test_a_pole_that_the_integral_action_slows_is_told(poles, pitch, yaw):
    spec = Spec.from_preset(poles=poles, pitch=pitch, yaw=yaw)
    slowest = float(evaluate(spec).loop.poles[0].real)
    assert 0 > slowest > max(poles) / SLOWER
    assert f"at {number(slowest, 2)} rad/s" in told(spec, "slow_pole")
    assert "slow_pole" not in codes(spec.changed(outer="none"))


@pytest.mark.parametrize("degrees", [70, 90, 150])
def test_what_the_motors_limits_cost_is_told_beside_the_linear_model(degrees: float):
    spec = Spec.from_preset(reference=(0.5, np.radians(degrees)))
    yaw = {m: s.metrics.axes["psi"] for m, s in evaluate(spec, each_axis=True).axis_steps["psi"].items()}
    message = told(spec, "unlike_linear")
    settling, ideal = yaw["nonlinear"].settling_time, yaw["linear"].settling_time
    assert settling is not None and ideal is not None
    assert f"the yaw step settles in {settling:.2f} s (linear: {ideal:.2f} s)" in message
    assert ("overshoots" in message) is (yaw["nonlinear"].overshoot > yaw["linear"].overshoot + 10)
    assert "motors' limits" in message
    free = replace(spec, scenario=replace(spec.scenario, saturation=False))
    assert "unlike_linear" not in codes(free)


def test_an_error_that_stays_without_integral_action_is_told_with_its_remedy():
    spec = Spec.from_preset(poles=[-9, -8, -3, -2], outer="none")
    message = told(spec, "not_settled")
    assert "pitch ends 0.38° from its reference (linear: settled in 0.69 s)" in message
    assert "close the PI loops" in message and "yaw" not in message


def test_who_is_within_the_band_at_the_end_and_leaves_it_again_has_not_settled():
    """A slowly dying oscillation, at ends all around its period: one finding, as the metrics say."""
    spec, told_so = (
        Spec.from_preset(poles=[-0.3 + 5j, -0.3 - 5j, -8, -9], outer="none", reference=(0.005, None)),
        0,
    )
    for duration in (*np.linspace(8.0, 9.3, 9), 30.0):
        report = evaluate(spec.changed(duration=float(duration)))
        own = report.step["nonlinear"].metrics.axes["theta"]
        messages = [f.message for f in report.findings if "settled" in f.code]
        assert len(messages) == (not own.settled)
        within = abs(own.steady_state_error) <= 0.02 * 0.005
        assert all(("does not stay there" in message) == within for message in messages)
        told_so += not own.settled and within
    assert own.settled and told_so > 0


def test_what_is_explained_otherwise_is_not_told_twice():
    assert "pi_unstable" in codes(slow := Spec.from_preset(poles=[-3, -2, -3, -2]))
    assert not codes(slow) & OURS
    beyond = Spec.from_preset(reference=(1.4, None))
    assert "reference_beyond_stop" in codes(beyond)
    assert not codes(beyond) & {"not_settled", "unlike_linear"}
    disturbed = Spec.from_preset()
    scenario = replace(disturbed.scenario, disturbance=Disturbance(V_p=5.0, time=1.0))
    assert "unlike_linear" not in codes(replace(disturbed, scenario=scenario))


def test_the_remarks_are_alike_with_and_without_each_axis_alone():
    spec = Spec.from_preset(poles=[-900, -10, -9.25, -8.76])
    assert {f.code for f in evaluate(spec).findings} == codes(spec)
