from __future__ import annotations

import dataclasses
import math

import pytest

from heli2dof_core import (
    PRESETS,
    InvalidInputError,
    Limits,
    OuterLoop,
    PIGains,
    Scenario,
    Spec,
    evaluate,
    plant,
    preset,
)
from heli2dof_core.parameters import PARAMETER_INFO


def test_parameters_are_frozen():
    with pytest.raises(dataclasses.FrozenInstanceError):
        preset().parameters.m = 2.0


@pytest.mark.parametrize("name", PARAMETER_INFO)
@pytest.mark.parametrize("value", [math.nan, math.inf, "1", None, True, 1e7])
def test_unusable_values_name_field_and_value(name, value):
    with pytest.raises(InvalidInputError) as caught:
        preset().parameters.replaced({name: value})
    assert caught.value.field == name
    assert caught.value.value is value


@pytest.mark.parametrize("name", ["J_p", "J_y"])
def test_inertias_must_be_positive_and_masses_may_be_zero(name):
    for value in (0.0, -0.1):
        with pytest.raises(InvalidInputError, match="kg·m²"):
            preset().parameters.replaced({name: value})
    assert preset().parameters.replaced({"m": 0, "l": 0}).alpha == 0.0384


def test_unknown_parameters_are_refused():
    with pytest.raises(InvalidInputError, match="no parameter 'mass'"):
        preset().parameters.replaced({"mass": 1.0})


def test_alpha_beta_gamma_are_those_of_eq_15():
    rig = preset("paper-as-computed").parameters
    assert rig.alpha == pytest.approx(0.0384 + 1.39 * 0.186**2)
    assert rig.beta == pytest.approx(0.0432 + 1.39 * 0.186**2)
    assert rig.gamma == pytest.approx(0.0068 * 0.0219 - 0.204 * 0.072)


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_is_stable_and_within_its_limits(name):
    spec = Spec.from_preset(preset(name))
    report = evaluate(spec, each_axis=True)
    assert report.loop.stable
    assert report.design.pole_error < 1e-9
    assert {f.code for f in report.findings if f.severity != "info"} <= {"pairing_cross"}
    notes = {f.code for f in report.findings if f.severity == "info"}
    assert notes == (set() if spec.rotors.lag else {"lives_by_fast_rotors"})
    for steps in (report.step, *report.axis_steps.values()):
        motors = steps["nonlinear"].metrics.motors
        assert motors["V_p"].saturated == motors["V_y"].saturated == 0
        for axis in steps["nonlinear"].metrics.axes.values():
            assert axis.settling_time is not None


@pytest.mark.parametrize(
    ("name", "tau", "span"), [("quanser-aero", 0.156, ()), ("quanser-aero-2", 0.165, (0.162, 0.169))]
)
def test_the_aeros_fly_with_their_rotors_lag(name, tau, span):
    """Measured on such rigs: 0.156 s (step 0 → 10 V of a first-generation Aero), 0.162 to 0.169 s (Aero 2)."""
    own = preset(name)
    assert [rotor.tau for rotor in own.rotors.both] == [tau, tau]
    assert "Rotors' lag" in own.source and all(f"{bound:g}" in own.source for bound in span or (tau,))
    report = evaluate(Spec.from_preset(own))
    assert report.loop.lag_margin > 4 * tau
    assert report.sensitivity.disk_margin > 0.7
    assert min(each.phase_margin for each in report.margins) > math.radians(40)
    speeds = report.step["nonlinear"].response.rotors
    assert speeds is not None and abs(speeds - report.step["nonlinear"].response.voltages).max() > 0.5


@pytest.mark.parametrize("name", [name for name in PRESETS if "aero" not in name])
def test_the_other_rigs_are_the_papers(name):
    """No source tells their rotors' lag."""
    assert not preset(name).rotors.lag
    assert Spec.from_preset(name).actuators is None


def test_first_generation_aero_is_told_of_its_pairing():
    report = evaluate(Spec.from_preset(preset("quanser-aero")))
    assert report.interaction.rga[0, 0] == pytest.approx(0.299, abs=5e-4)
    assert report.interaction.pairing == (("theta", "V_y"), ("psi", "V_p"))
    assert [f.code for f in report.findings] == ["pairing_cross"]


def test_unknown_preset_lists_those_that_exist():
    with pytest.raises(InvalidInputError) as caught:
        preset("quanser")
    assert all(name in caught.value.hint for name in PRESETS)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: OuterLoop(pitch=PIGains(math.nan, 1.0)), "kp"),
        (lambda: OuterLoop(yaw=PIGains(1.0, 0.0)), "ti"),
        (lambda: Limits(0.0, 15.0), "V_p"),
        (lambda: Scenario(samples=1), "samples"),
        (lambda: Scenario(duration=-1.0), "duration"),
        (lambda: Scenario(theta=math.inf), "theta"),
        (lambda: Scenario(initial=(math.nan, None, 0.0, 0.0)), "initial.theta"),
        (lambda: Scenario(initial=(0.1, 0.2)), "initial"),
        (lambda: Scenario(initial=None), "initial"),
        (lambda: Scenario(anti_windup="wishful"), "anti_windup"),
        (lambda: plant(preset().parameters, 2.0), "theta_0"),
    ],
)
def test_unusable_settings_name_their_field(make, field):
    with pytest.raises(InvalidInputError) as caught:
        make()
    assert caught.value.field == field
