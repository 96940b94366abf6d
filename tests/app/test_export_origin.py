"""What an exported file says of its origin makes the same design again."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.contract.experiment import StepRequest
from heli2dof_core import PRESETS, Limits, OuterLoop, PIGains, Scenario, Spec, Structure
from heli2dof_core.body import body_of
from heli2dof_core.placement.method import Weights
from heli2dof_core.scenario import Digital, Disturbance
from tests.strategies import operating_points, pole_sets, rigs, structures


def again(spec: Spec) -> Spec:
    """The spec that the request makes; weights are those in use."""
    return StepRequest.model_validate(body_of(spec)).to_spec()


def same(spec: Spec) -> bool:
    made = again(spec)
    return replace(made, weights=None) == replace(spec, weights=None)


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_is_its_name(name: str):
    spec = Spec.from_preset(PRESETS[name])
    assert body_of(spec) == {"preset": name}
    assert same(spec)


@given(rigs(), operating_points, pole_sets(), structures)
def test_any_design_is_made_again(parameters, theta_0, poles, structure):
    spec = Spec.from_preset(PRESETS["quanser-aero"])
    assert same(replace(spec, parameters=parameters, theta_0=theta_0, poles=poles, structure=structure))


SCENARIOS = [
    Scenario(),
    Scenario(theta=0.0, duration=2.0, samples=11, saturation=False),
    Scenario(psi=1.0, initial=(None, 0.2, 0.0, -0.1), anti_windup="back-calculation", tracking_time=0.3),
    Scenario(theta=0.1, psi=0.2, duration=3.0, travel_stops=False, trim_feedforward=False, rtol=1e-6),
    Scenario(digital=Digital(0.01, True, (0, 100), "true", 1e-3, 7), disturbance=Disturbance(1.0, 0.0, 0.5)),
    Scenario(digital=Digital()),
]


@pytest.mark.parametrize("scenario", SCENARIOS, ids=range(len(SCENARIOS)))
@pytest.mark.parametrize("name", ["quanser-2dof-manual", "quanser-aero-2"])
def test_any_experiment_is_made_again(name: str, scenario: Scenario):
    assert same(replace(Spec.from_preset(PRESETS[name]), scenario=scenario))


@given(st.sampled_from(["pi", "none"]), st.sampled_from(["diagonal", "cross"]), st.booleans())
def test_any_outer_loop_and_limits_are_made_again(outer, pairing, decoupler):
    loop = OuterLoop(outer, PIGains(12.0, 0.3), PIGains(30.0, 0.2), pairing, decoupler)
    base = Spec.from_preset(PRESETS["quanser-2dof-manual"])
    assert same(replace(base, outer=loop, limits=Limits(10.0, 15.0, None)))
    assert same(replace(base, structure=Structure("triangular", "yaw", 0.3)))


def test_weights_are_those_in_use():
    own = Weights((1.0, 2.0, 3.0, 4.0), (0.1, 0.2), (5.0, 6.0))
    base = Spec.from_preset(PRESETS["quanser-2dof-manual"])
    spec = replace(base, method="lqr-integral", weights=own)
    assert again(spec) == spec
    assert "weights" not in body_of(replace(spec, method="tits-yang"))
    tight = replace(base, method="lqr", limits=Limits(5.0, 5.0))  # its weights follow its own limits
    assert again(tight).weights != again(replace(base, method="lqr")).weights
