"""The one kernel of an update against the steps one by one: placement, whole loop, margins, each response alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from heli2dof_core import Observer, Spec, evaluate, loop_of, place, simulate
from heli2dof_core.block import numbers_of
from heli2dof_core.interaction import interaction
from heli2dof_core.kernels.update_layout import NUMBERS
from heli2dof_core.margins import loop_margins
from heli2dof_core.scenario import Digital
from heli2dof_core.sensitivity import loop_sensitivity
from tests.core.random_specs import random_specs

EXACT = {"rtol": 1e-10, "samples": 101}
"""At a fine tolerance, since where the last digits of K differ the integrator's steps may."""


def close(one, other, share, floor=0.0):
    one, other = (np.array(each, dtype=complex) for each in (one, other))
    np.testing.assert_array_equal(np.isfinite(one), np.isfinite(other))
    known = np.isfinite(other)
    size = max(np.max(np.abs(other[known]), initial=0.0), floor)
    np.testing.assert_allclose(one[known], other[known], rtol=0, atol=share * size)


def numbers(record):
    return [np.nan if value is None else value for value in vars(record).values()]


def test_an_update_is_its_steps_one_by_one():
    """Four hundred specs of all kinds: K and the loop to 1e-12, what follows from eigenvalues as these allow."""
    for spec in random_specs(400, 7, samples=11, duration=0.5, rtol=1e-6):
        report, design = evaluate(spec), place(spec)
        loop = loop_of(spec, design)
        close(report.design.K, design.K, 1e-13)
        close(report.design.steady_state_inverse, design.steady_state_inverse, 1e-13)
        close(report.design.steady_state_determinant, design.steady_state_determinant, 1e-12)
        assert (report.design.stable, report.loop.stable) == (design.stable, loop.stable)
        assert report.design.verdict.exact == design.verdict.exact
        close(report.design.closed_loop_poles, design.closed_loop_poles, 1e-10)
        close(
            numbers_or_nan(report.design.eigenvector_condition),
            numbers_or_nan(design.eigenvector_condition),
            1e-8,
        )
        gains = interaction(design, spec.outer.pairing)
        close(numbers_or_nan(report.interaction.relative_gain), numbers_or_nan(gains.relative_gain), 1e-11)
        assert (report.loop.places, report.loop.connected) == (loop.places, loop.connected)
        for name in ("A", "B", "voltage_from_state", "voltage_from_reference", "motors"):
            close(getattr(report.loop, name), getattr(loop, name), 1e-12)
        close(report.loop.poles, loop.poles, 1e-9)
        close(report.loop.connected_poles, loop.connected_poles, 1e-9)
        close(numbers_or_nan(report.loop.lag_margin), numbers_or_nan(loop.lag_margin), 1e-8)
        margins, sensitivity = loop_margins(loop), loop_sensitivity(loop)
        assert (report.margins is None, report.sensitivity is None) == (margins is None, sensitivity is None)
        if margins is not None and report.margins is not None:
            close([numbers(m) for m in report.margins], [numbers(m) for m in margins], 1e-9)
            close(report.sensitivity.peak, sensitivity.peak, 1e-9)
            close(report.sensitivity.disk_margin, sensitivity.disk_margin, 1e-9)


def numbers_or_nan(value):
    return np.nan if value is None else value


def test_responses_of_an_update_are_each_alone():
    for spec in random_specs(60, 3, **EXACT):
        if spec.scenario.digital is not None and any(spec.scenario.digital.encoders):
            continue  # encoders magnify the last digit
        report = evaluate(spec, each_axis=True)
        loop = loop_of(spec)
        alone = {
            name: replace(spec.scenario, **{other: None})
            for name, other in (("theta", "psi"), ("psi", "theta"))
            if getattr(spec.scenario, name) is not None
        }
        assert list(report.axis_steps) == list(alone)
        for scenario, steps in (
            (spec.scenario, report.step),
            *zip(alone.values(), report.axis_steps.values(), strict=True),
        ):
            own = replace(spec, scenario=scenario)
            for model, step in steps.items():
                expected = simulate(loop, own, model)
                response, other = step.response, expected.response
                close(response.states, other.states, 1e-7, 1e-3)
                close(response.voltages, other.voltages, 1e-6, 1e-2)
                assert (response.signals, response.reference, response.start) == (
                    other.signals,
                    other.reference,
                    other.start,
                )
                np.testing.assert_array_equal(response.t, other.t)
                assert [f.code for f in step.findings] == [f.code for f in expected.findings]
                assert step.metrics.axes.keys() == expected.metrics.axes.keys()
                for axis, found in step.metrics.axes.items():
                    twin = expected.metrics.axes[axis]
                    assert found.settled == twin.settled
                    for name in ("rise_time", "settling_time", "overshoot", "undershoot", "iae"):
                        ours, theirs = getattr(found, name), getattr(twin, name)
                        assert ours == (
                            theirs if theirs is None else pytest.approx(theirs, rel=1e-4, abs=1e-5)
                        )


@pytest.mark.parametrize("method", ["bass-gura", "lqr", "lqr-integral", "knv0", "tits-yang", "varga"])
def test_what_other_methods_find_is_the_blocks(method):
    real = Spec.from_preset("quanser-aero", method=method, poles=[-4, -5, -6, -7], theta_0=0.1)
    report, design = evaluate(real), place(real)
    np.testing.assert_array_equal(report.design.K, design.K)
    assert report.design.stable == design.stable
    close(report.design.closed_loop_poles, design.closed_loop_poles, 1e-9)
    close(report.loop.poles, loop_of(real, design).poles, 1e-9)


def test_kalman_filters_and_nearly_parallel_motors_come_from_outside_the_kernel():
    kalman = Spec.from_preset(observer=Observer(method="kalman"), measured="observer")
    estimated = loop_of(kalman).estimator
    found = evaluate(kalman)
    assert found.loop.estimator is not None and estimated is not None
    np.testing.assert_allclose(found.block["L"], estimated.L, rtol=1e-15)
    spec = Spec.from_preset()
    p = spec.parameters
    near = spec.changed(parameters={"K_yp": 1.001 * p.K_pp * p.K_yy / p.K_py})
    np.testing.assert_allclose(evaluate(near).design.K, place(near).K, rtol=1e-14)
    assert near.parameters.independence < 1e-2


def test_the_numbers_are_as_many_as_the_layout_says():
    spec = Spec.from_preset()
    spec = replace(spec, scenario=replace(spec.scenario, digital=Digital()))
    assert len(numbers_of(spec, True, 1)) == NUMBERS
