"""Figures on uncertain rigs: the nominal ones where nothing differs, and those of loops around another plant."""

from __future__ import annotations

import os
from dataclasses import replace

import numpy as np
import pytest

from heli2dof_core import Heli2DofError, Spec, close_loop, cloud, place, plant
from heli2dof_core.engine import warm_up
from heli2dof_core.errors import CancelledError, InvalidInputError
from heli2dof_core.kernels.update_layout import DONE, FOUND_FIGURES, FOUND_OUTCOME, STABLE
from heli2dof_core.many import Many, Measure
from heli2dof_core.margins import loop_margins
from heli2dof_core.measured import MEASURED, Where
from heli2dof_core.metrics import step_metrics
from heli2dof_core.on_rigs import OnRigs
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.robustness import Uncertainty, random_factors
from heli2dof_core.rotors import Rotor, Rotors
from heli2dof_core.scenario import Digital, Disturbance
from heli2dof_core.simulation.nonlinear import simulate_nonlinear
from tests.core.random_specs import random_specs

MANY = int(os.environ.get("HELI2DOF_MANY_SPECS", "60"))
ONE = np.ones((1, 14))
CONTINUOUS = {"digital": None, "disturbance": None}


@pytest.fixture(scope="module", autouse=True)
def compiled():
    warm_up()


def all_measures(steps: str) -> list[Measure]:
    """Every figure by every model that it has."""
    found = []
    for name, known in MEASURED.items():
        if known.of == "step" and steps == "together":
            continue
        for model in ("linear", "nonlinear") if known.may_have_model else ("nonlinear",):
            where = Where("both" if known.may_have_axis else None, None, model, steps)
            found.append(Measure(name, where))
    return found


def test_a_rig_without_differences_has_the_nominal_figures():
    seen = 0
    for i, spec in enumerate(random_specs(MANY, 21, **CONTINUOUS)):
        measures = all_measures(("alone", "together")[i % 2])
        many = Many(spec, measures)
        rows = many.row[np.newaxis]
        nominal = many.run(rows, lambda _, spec=spec: spec)
        if nominal.rows[0, FOUND_OUTCOME] != DONE:
            with pytest.raises(Heli2DofError):
                OnRigs(spec, measures)
            continue
        seen += 1
        own = OnRigs(spec, measures)
        found = own.found(ONE)
        np.testing.assert_array_equal(
            own.values_of(found), many.values(rows, nominal), err_msg=f"{i}: {spec}"
        )
        np.testing.assert_array_equal(found.poles, nominal.poles)
    assert seen > 0.9 * MANY


def test_a_design_among_many_is_put_on_rigs_by_its_numbers():
    spec, measures = Spec.from_preset(), all_measures("alone")
    many, row = Many(spec, measures), Many(spec.changed(pitch=(9.0, 0.4)), measures).row
    factors = random_factors(Uncertainty(samples=5))
    np.testing.assert_array_equal(
        OnRigs.of(many, row).values(factors), OnRigs(spec.changed(pitch=(9.0, 0.4)), measures).values(factors)
    )


def test_an_lqr_design_is_put_on_rigs_too():
    spec = Spec.from_preset(method="lqr")
    measures = all_measures("alone")
    many = Many(spec, measures)
    nominal = many.run(many.row[np.newaxis], lambda _: spec)
    np.testing.assert_array_equal(
        OnRigs(spec, measures).values(ONE), many.values(many.row[np.newaxis], nominal)
    )


def test_figures_are_those_of_the_same_controller_around_another_plant():
    """Without feedforward of the trim a loop around another plant can be built from the outside."""
    figures = ("settling_time", "overshoot", "iae")
    measures = [
        *(
            Measure(name, Where(axis, None, "nonlinear", "together"))
            for name in figures
            for axis in ("theta", "psi")
        ),
        Measure("lag_margin"),
        *(Measure("phase_margin", Where(motor=motor)) for motor in ("V_p", "V_y")),
        *(Measure("V_peak", Where(motor=motor, steps="together")) for motor in ("V_p", "V_y")),
    ]
    spec = Spec.from_preset(outer="pi", reference=(0.25, -0.3), duration=6.0)
    spec = replace(spec, scenario=replace(spec.scenario, trim_feedforward=False, samples=2))
    factors = random_factors(Uncertainty({name: 0.25 for name in PARAMETER_INFO if name != "g"}, samples=40))
    values, design = OnRigs(spec, measures).values(factors), place(spec)
    for row, own in zip(values.tolist(), factors, strict=True):
        changed = {name: getattr(spec.parameters, name) * own[k] for k, name in enumerate(PARAMETER_INFO)}
        other = replace(design, plant=plant(spec.parameters.replaced(changed), spec.theta_0))
        loop = close_loop(other, spec.outer)
        step = step_metrics(simulate_nonlinear(loop, spec.limits, spec.scenario))
        expected = [getattr(step.axes[axis], name) for name in figures for axis in ("theta", "psi")]
        expected += [loop.lag_margin]
        if loop.stable:
            expected += [own.phase_margin for own in loop_margins(loop)]
        else:
            expected += [None, None]
        expected += [step.motors[motor].peak for motor in ("V_p", "V_y")]
        got = [None if np.isnan(v) or np.isinf(v) else v for v in row]
        assert got == expected


@pytest.mark.parametrize("kind", ["observer", "rotors"])
def test_responses_end_where_those_of_the_cloud_do(kind):
    """Trim, thrust curves, lags and estimators are the nominal ones there as here; that kernel integrates anew."""
    rotors = Rotors(Rotor(tau=0.05, curve="quadratic"), Rotor(tau=0.08))
    spec = Spec.from_preset(
        **({"measured": "observer"} if kind == "observer" else {"rotors": rotors}), reference=(0.2, -0.3)
    )
    spread = dict.fromkeys(
        ("J_p", "K_pp", "K_yy", "m", *(("tau_p", "tau_y") if kind == "rotors" else ())), 0.2
    )
    uncertainty = Uncertainty(spread, samples=25)
    axes = ("theta", "psi")
    own = OnRigs(spec, [Measure("steady_state_error", Where(axis, steps="together")) for axis in axes])
    found = own.found(random_factors(uncertainty))
    reference = np.array([spec.scenario.theta, spec.scenario.psi])
    ends = reference - own.values_of(found)
    whole = cloud(spec, uncertainty)
    np.testing.assert_array_equal(found.poles[:, : whole.loop_poles.shape[1]], whole.loop_poles)
    assert np.mean(found.rows[:, FOUND_FIGURES + STABLE]) == whole.share_stable
    for axis, name in enumerate(axes):
        np.testing.assert_allclose(
            np.percentile(ends[:, axis], whole.percentiles), whole.envelopes[name][:, -1], atol=2e-4
        )


def test_what_cannot_be_on_uncertain_rigs_is_refused():
    spec = Spec.from_preset()
    for name, own in (
        ("digital", {"digital": Digital()}),
        ("disturbance", {"disturbance": Disturbance(V_p=1.0)}),
        ("noise", {"noise": (0.01, 0.0), "digital": None}),
    ):
        with pytest.raises(InvalidInputError) as refused:
            OnRigs(replace(spec, scenario=replace(spec.scenario, **own)), [Measure("lag_margin")])
        assert refused.value.field == f"scenario.{name}"
    with pytest.raises(InvalidInputError, match="of all rigs together"):
        OnRigs(spec, [Measure("share_stable")])


def test_it_ends_when_nobody_wants_it_any_more():
    asked = []

    def check():
        asked.append(1)
        if len(asked) == 3:
            raise CancelledError("cancelled")

    with pytest.raises(CancelledError):
        OnRigs(Spec.from_preset(), [Measure("lag_margin")]).values(np.ones((500, 14)), check)
    assert len(asked) == 3


def test_unstable_rigs_have_no_figures_of_responses_where_these_are_left_out():
    spec = Spec.from_preset(outer="pi", duration=1.0)
    own = OnRigs(spec, [Measure("iae", Where("theta"))], unstable=False)
    factors = np.ones((2, 14))
    factors[1, [*PARAMETER_INFO].index("J_p")] = 100.0
    found = own.found(factors)
    assert found.rows[:, FOUND_FIGURES + STABLE].tolist() == [1.0, 0.0]
    assert np.isnan(own.values_of(found)[:, 0]).tolist() == [False, True]
