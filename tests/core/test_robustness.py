"""The cloud of uncertain rigs against single evaluations, and its statistics against what must be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from heli2dof_core import (
    InvalidInputError,
    PoleSet,
    Rotor,
    Rotors,
    Spec,
    Uncertainty,
    close_loop,
    cloud,
    evaluate,
    place,
    plant,
    pole_error,
    preset,
)
from heli2dof_core.robustness import cloud_in_parts
from heli2dof_core.simulation.nonlinear import simulate_nonlinear


def test_without_uncertainty_every_rig_is_the_nominal_one(spec):
    found = cloud(spec, Uncertainty(spread={}, samples=20))
    report = evaluate(spec)
    for poles in found.loop_poles:
        assert pole_error(report.loop.poles, poles) < 1e-9
    nominal = report.step["nonlinear"].response
    for i, name in enumerate(("theta", "psi")):
        band = found.envelopes[name]
        assert np.max(np.ptp(band, axis=0)) == 0
        expected = np.interp(found.t, nominal.t, nominal.angles[i])
        np.testing.assert_allclose(band[0], expected, atol=1e-3)
    assert (found.share_stable, found.share_within_limits) == (1, 1)


def test_each_rig_is_the_perturbed_plant_under_the_nominal_controller(spec):
    """One parameter, uniform: the extremes of the cloud are those of the parameter."""
    found = cloud(spec, Uncertainty(spread={"B_y": 0.5}, samples=400, seed=3))
    loop = close_loop(place(spec), spec.outer)
    for factor in (0.5, 1.5):
        rig = plant(spec.parameters.replaced({"B_y": factor * spec.parameters.B_y}))
        whole = loop.A.copy()
        whole[:4] = rig.B @ loop.voltage_from_state
        whole[:4, :4] += rig.A
        expected = np.linalg.eigvals(whole)
        assert min(pole_error(expected, poles) for poles in found.loop_poles) < 0.02


def test_median_and_bands_are_those_of_single_simulations(spec):
    uncertainty = Uncertainty(samples=60, seed=5)
    found = cloud(spec, uncertainty)
    rng = np.random.default_rng(5)
    names = list(spec.parameters.as_dict())
    factors = 1 + 0.1 * rng.uniform(-1, 1, (60, len(names))) * [name != "g" for name in names]
    loop = close_loop(place(spec), spec.outer)
    angles = []
    for row in factors:
        values = {name: v * f for (name, v), f in zip(spec.parameters.as_dict().items(), row, strict=True)}
        moved = replace(loop.design.plant, parameters=spec.parameters.replaced(values))
        other = replace(loop, design=replace(loop.design, plant=moved))
        scenario = replace(spec.scenario, samples=101, rtol=1e-8)
        angles.append(simulate_nonlinear(other, spec.limits, scenario).angles)
    bands = np.percentile(np.array(angles), (5, 50, 95), axis=0)
    np.testing.assert_allclose(found.envelopes["theta"], bands[:, 0], atol=2e-5)
    np.testing.assert_allclose(found.envelopes["psi"], bands[:, 1], atol=2e-5)


def test_parts_grow_to_the_whole_and_repeat_with_their_seed(spec):
    uncertainty = Uncertainty(samples=900, seed=1, distribution="normal")
    parts = list(cloud_in_parts(spec, uncertainty))
    assert [part.done for part in parts] == [250, 750, 900]
    again = cloud(spec, uncertainty)
    np.testing.assert_array_equal(parts[-1].loop_poles, again.loop_poles)
    np.testing.assert_array_equal(parts[0].loop_poles, again.loop_poles[:250])
    assert not np.array_equal(cloud(spec, replace(uncertainty, seed=2)).loop_poles, again.loop_poles)


def test_shares_tell_instability_and_limits():
    spec = Spec.from_preset(preset())
    slow = replace(spec, poles=PoleSet([-3.6, -3.1, -3.4, -3.2]))
    found = cloud(slow, Uncertainty(spread={"K_pp": 0.5, "B_p": 0.5, "J_p": 0.5}, samples=500))
    assert 0.02 < found.share_stable < 0.98
    far = replace(spec, scenario=replace(spec.scenario, theta=0.5, psi=1.5))
    assert cloud(far, Uncertainty(samples=100)).share_within_limits == 0


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"spread": {"mass": 0.1}}, "spread.mass"),
        ({"spread": {"m": 1.0}}, "spread.m"),
        ({"samples": 0}, "samples"),
        ({"distribution": "flat"}, "distribution"),
    ],
)
def test_bad_uncertainties_are_refused_with_their_field(change, field):
    with pytest.raises(InvalidInputError) as caught:
        Uncertainty(**change)
    assert caught.value.field == field


def test_uncertain_lags_judge_as_the_eigenvalues_of_each_rig_do(spec):
    """The share that is stable, rig by rig, from the loop's parts and LAPACK."""
    lagging = spec.changed(rotors=Rotors(Rotor(0.15), Rotor(0.15)))
    uncertainty = Uncertainty({"tau_p": 0.4, "tau_y": 0.4}, samples=300, seed=2)
    found = cloud(lagging, uncertainty)
    placed, outer = place(spec), spec.outer
    kp = np.diag([outer.pitch.kp, outer.yaw.kp])
    C, ki = np.eye(2, 4), kp @ np.diag([1 / outer.pitch.ti, 1 / outer.yaw.ti])
    law, stable = np.hstack((-placed.K - kp @ C, ki)), 0
    for poles in found.loop_poles:
        # the sum of the poles tells 1/τ_p + 1/τ_y; both from the characteristic polynomial at a point, too
        total = -np.sum(poles).real + np.trace(placed.plant.A)
        product = np.prod(poles).real  # det of the whole, which is det(B-path) / (τ_p τ_y)
        unit = _whole(placed, law, C, 1.0, 1.0)
        inverse = product / np.linalg.det(unit)
        a, b = np.roots([1.0, -total, inverse])
        whole = _whole(placed, law, C, 1 / a, 1 / b), _whole(placed, law, C, 1 / b, 1 / a)
        assert min(pole_error(poles, np.linalg.eigvals(each)) for each in whole) < 1e-5
        assert all(0.6 * 0.15 <= 1 / rate.real <= 1.4 * 0.15 for rate in (a, b))
        stable += np.max(poles.real) < 0
    assert 0.05 < found.share_stable < 0.95
    assert found.share_stable == pytest.approx(stable / 300, abs=1e-9)


def _whole(placed, law, C, tau_p, tau_y):
    """Rig, integrals of the errors, rotors: 8×8."""
    A, lag = np.zeros((8, 8)), np.diag([1 / tau_p, 1 / tau_y])
    A[:4, :4], A[:4, 6:], A[4:6, :4] = placed.plant.A, placed.plant.B, -C
    A[6:, :6], A[6:, 6:] = lag @ law, -lag
    return A
