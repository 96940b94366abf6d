"""Many designs at once against `evaluate` one by one: every figure of every response equal bit for bit."""

from __future__ import annotations

import gc
import threading
from dataclasses import replace
from math import inf, isnan, nan
from typing import Any

import numpy as np
import pytest

from heli2dof_core import (
    Heli2DofError,
    InvalidInputError,
    Observer,
    PoleSet,
    Spec,
    Uncertainty,
    cloud,
    evaluate,
    plant,
)
from heli2dof_core.many import MOST_STEPS, SHARES, Many, Measure, evaluate_many
from heli2dof_core.measured import MEASURED, Where, worse
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.robustness import random_factors
from heli2dof_core.scenario import Digital
from heli2dof_core.signals import Floats
from tests.core.random_specs import random_specs
from tests.patience import PATIENCE


def every_measure() -> list[Measure]:
    """Each figure of each response that it has."""
    found = []
    for name, known in MEASURED.items():
        axes = ("theta", "psi", "both") if known.may_have_axis else (None,)
        motors = ("V_p", "V_y", None) if known.may_have_motor else (None,)
        models = ("linear", "nonlinear") if known.may_have_model else ("nonlinear",)
        steps = ("alone", "together") if known.may_have_model and known.of != "step" else ("alone",)
        found += [
            Measure(name, Where(axis, motor, model, each))
            for axis in axes
            for motor in motors
            for model in models
            for each in steps
        ]
    return found


EVERY = every_measure()


def expected(spec: Spec, measures) -> list[float | None]:
    """What `evaluate` and the registry say; NaN: none, infinite: unlimited, None: given up."""
    try:
        report = evaluate(spec, each_axis=True, most_steps=MOST_STEPS)
    except Heli2DofError:
        return [nan] * len(measures)
    found = []
    for measure in measures:
        known = MEASURED[measure.name]
        values = known.read(report, measure.where)
        value = worse(known, values) if values else None
        if report.given_up and known.may_have_model:
            found.append(None)  # of a response cut off nothing is known
            continue
        of_stable = known.of in ("margins", "sensitivity", "loop")
        if of_stable and not report.judged.stable:
            found.append(nan)
        elif value is None and known.unlimited:
            found.append(inf if known.figure.better == "higher" else -inf)
        else:
            found.append(nan if value is None else value)
    return found


def hold_equal(specs, measures, values):
    for spec, row in zip(specs, values.tolist(), strict=True):
        known = expected(spec, measures)
        wrong = [
            (measure, value, other)
            for measure, value, other in zip(measures, row, known, strict=True)
            if other is not None and value != other and not (isnan(value) and isnan(other))
        ]
        assert not wrong, (spec, wrong)


def some_specs(count: int, seed: int) -> list[Spec]:
    """Of all kinds: those of `random_specs`, and among them other methods, noise, Kalman filters, unstable poles."""
    rng = np.random.default_rng(seed)
    return [_of_another_kind(spec, rng) for spec in random_specs(count, seed)]


def _of_another_kind(spec: Spec, rng) -> Spec:
    kind, scenario = rng.random(), spec.scenario
    if kind < 0.15:
        return replace(spec, method=[*METHODS][rng.integers(1, len(METHODS))])
    if kind < 0.25:
        unstable = [complex(-p.real, p.imag) for p in spec.poles.values]
        return spec.with_poles(PoleSet([*unstable[:2], *spec.poles.values[2:]]))
    if kind < 0.35:
        start = (rng.uniform(-0.3, 0.3), None if rng.random() < 0.5 else 0.1, 0.1, -0.1)
        return replace(spec, scenario=replace(scenario, initial=start))
    if kind < 0.4:
        return replace(spec, scenario=replace(scenario, noise=(1e-4, 2e-4)))
    if kind < 0.5:
        observer = Observer(method="kalman", angle_noise=10 ** rng.uniform(-5, -3))
        return replace(spec, observer=observer, scenario=replace(scenario, measured="observer"))
    return spec


def test_figures_of_many_designs_are_those_of_each():
    specs = some_specs(100, 11)
    assert {spec.scenario.measured for spec in specs} == {"states", "filtered", "observer"}
    assert len({spec.method for spec in specs}) > 4
    values = evaluate_many(specs, EVERY)
    hold_equal(specs, EVERY, values)
    assert np.mean(np.isfinite(values)) > 0.4
    assert np.any(np.isinf(values))


def test_what_is_left_out_changes_no_figure_that_is_asked_for():
    """Each measure alone takes but what it needs, with the digits of the whole update."""
    specs = some_specs(8, 12)
    all_at_once = evaluate_many(specs, EVERY)
    for i in np.random.default_rng(2).permutation(len(EVERY))[:60].tolist():
        measure = EVERY[i]
        np.testing.assert_array_equal(evaluate_many(specs, [measure])[:, 0], all_at_once[:, i], str(measure))


def test_rows_of_one_structure_are_changed_in_place(spec):
    """The quick way: a row copied and its poles set, no spec per design; two threads do what one does."""
    rng = np.random.default_rng(3)
    places = rng.uniform(-12, 0.5, 300) + 1j * rng.uniform(0, 8, 300)
    many = Many(spec, [measure := Measure("settling_time", Where("psi"))])
    rows = np.tile(many.row, (300, 1))
    rows[:, 20], rows[:, 22], rows[:, 21], rows[:, 23] = places.real, places.real, places.imag, -places.imag
    found = many.run(rows)
    values = many.values(rows, found)
    specs = [
        spec.with_poles(PoleSet([*spec.poles.values[:2], p, p.conjugate()])) for p in places[:100].tolist()
    ]
    hold_equal(specs, [measure], values[:100])
    several = Many(spec, [measure], threads=2)
    both = several.run(rows)
    np.testing.assert_array_equal(several.values(rows, both), values)
    np.testing.assert_array_equal(both.poles, found.poles)
    for poles, own in zip(found.poles, specs, strict=False):
        np.testing.assert_array_equal(poles, evaluate(own).judged.connected)


def test_designs_that_take_exact_numbers_ask_for_their_spec(spec):
    """Motors that push nearly alike: the kernel refuses, and the exact construction's K is given."""
    p = spec.parameters
    alike = spec.changed(parameters={"K_py": p.K_pp * 0.993, "K_yy": p.K_yp}, outer="none")
    assert plant(alike.parameters, alike.theta_0).nearly_parallel
    specs = [alike.with_poles(PoleSet([-3 - 0.1 * i, -4, -5, -6])) for i in range(5)]
    values = evaluate_many(specs, EVERY)
    hold_equal(specs, EVERY, values)


def test_a_design_that_does_not_exist_has_no_figures(spec):
    p = spec.parameters
    none = spec.changed(parameters={"K_py": p.K_pp, "K_yp": p.K_pp, "K_yy": p.K_pp})
    values = evaluate_many([spec, none, spec], EVERY)
    assert np.all(np.isnan(values[1]))
    np.testing.assert_array_equal(values[0], values[2])
    hold_equal([spec], EVERY, values[:1])


def test_a_response_that_is_given_up_has_none_even_beside_one_that_settles(spec):
    """The other axis' figure is no figure of both."""
    measures = [Measure("settling_time", Where(axis)) for axis in ("theta", "psi", "both")]
    whole = evaluate_many([spec], measures)[0]
    assert np.all(np.isfinite(whole))
    for most in (8, 40, 200):
        theta, psi, both = evaluate_many([spec], measures, most_steps=most)[0]
        if isnan(theta) or isnan(psi):
            assert isnan(both)
    assert np.all(np.isnan(evaluate_many([spec], measures, most_steps=8)))
    slow = replace(spec, scenario=replace(spec.scenario, theta=1e-9))
    steps = [n for n in range(5, 120) if np.sum(np.isnan(evaluate_many([slow], measures, most_steps=n))) == 2]
    assert steps  # one axis is whole, the other not, and both are not


def test_unstable_loops_can_be_left_out(spec):
    growing = spec.with_poles(PoleSet([1.0, -2.0, -3.0, -4.0]))
    many = Many(spec, [Measure("peak", Where("theta")), Measure("norm")], unstable=False)
    rows = np.array([many.numbers_of(spec), many.numbers_of(growing)])
    (peak, norm), (none, other) = many.values(rows, many.run(rows)).tolist()
    assert peak == expected(spec, many.measures)[0]
    assert isnan(none)
    assert (norm, other) == (expected(spec, many.measures)[1], expected(growing, many.measures)[1])


@pytest.mark.parametrize("measured", ["states", "observer"])
def test_shares_are_those_of_the_cloud(spec, measured):
    """The same rigs under each design as `robustness` puts under one."""
    uncertainty = Uncertainty({"J_p": 0.4, "K_pp": 0.4, "K_yy": 0.5, "B_y": 0.5}, samples=60, seed=4)
    rng = np.random.default_rng(8)
    specs = []
    for _ in range(6):
        p = complex(-rng.uniform(0.3, 6), rng.uniform(0, 8))
        own = spec.with_poles(PoleSet([p, p.conjugate(), *spec.poles.values[2:]]))
        specs.append(replace(own, scenario=replace(own.scenario, measured=measured)))
    measures = [Measure(name) for name in SHARES]
    values = evaluate_many(specs, measures, factors=random_factors(uncertainty))
    known = [cloud(own, uncertainty) for own in specs]
    assert values.tolist() == [[each.share_stable, each.share_within_limits] for each in known]
    assert len(np.unique(values[:, 1])) > 2
    alone = evaluate_many(specs, measures[:1], factors=random_factors(uncertainty))
    assert alone[:, 0].tolist() == values[:, 0].tolist()


def test_work_that_nobody_wants_any_more_ends(spec):
    class EnoughError(Exception):
        pass

    calls = []

    def check():
        calls.append(1)
        if len(calls) == 3:
            raise EnoughError

    many = Many(spec, [Measure("norm")])
    with pytest.raises(EnoughError):
        many.run(np.tile(many.row, (1000, 1)), check=check)
    assert len(calls) == 3
    calls.clear()
    with pytest.raises(EnoughError):  # while another method places, too
        evaluate_many([replace(spec, method="lqr")] * 5, many.measures, check=check)
    assert len(calls) == 3


def test_noise_of_a_controller_is_each_scenarios_own(spec):
    """Equal seeds, unequal lengths and rates: no design hears another's noise."""
    specs = [
        replace(spec, scenario=replace(spec.scenario, duration=d, digital=Digital(t), noise=(n, n)))
        for d, t, n in ((1.0, 0.002, 1e-3), (2.0, 0.002, 1e-3), (1.0, 0.004, 1e-3), (1.0, 0.002, 2e-3))
    ]
    hold_equal(specs, EVERY, evaluate_many(specs, EVERY))


@pytest.mark.parametrize(
    ("given", "field"),
    [
        (("none such", Where()), "measure"),
        (("settling_time", Where()), "axis"),
        (("settling_time", Where("pitch")), "axis"),
        (("V_peak", Where(motor="theta")), "motor"),
        (("settling_time", Where("theta", model="real")), "model"),
        (("coupling_peak", Where("theta", steps="together")), "steps"),
    ],
)
def test_what_cannot_be_measured_is_refused(given, field):
    with pytest.raises(InvalidInputError) as refused:
        Measure(*given)
    assert refused.value.field == field
    assert refused.value.hint


def test_shares_need_rigs(spec):
    with pytest.raises(InvalidInputError, match="uncertain rigs") as refused:
        evaluate_many([spec], [Measure("share_stable")])
    assert refused.value.field == "uncertainty"


def test_a_small_generation_is_shared_by_threads_which_end_with_it(monkeypatch):
    many = Many(Spec.from_preset(), [Measure("V_peak")], threads=2)
    rows = np.tile(many.row, (10, 1))
    seen: list[tuple[int, threading.Thread]] = []
    fill = Many._fill

    def told(self: Many, rows: Floats, *filled: Any) -> None:
        seen.append((len(rows), threading.current_thread()))
        fill(self, rows, *filled)

    monkeypatch.setattr(Many, "_fill", told)
    many.run(rows[:1])
    assert seen == [(1, threading.current_thread())]
    del seen[:]
    for _ in range(3):
        many.run(rows)
    assert [count for count, _ in seen] == 6 * [5]
    threads = {thread for _, thread in seen}
    assert threading.current_thread() not in threads and 1 <= len(threads) <= 2
    del many
    gc.collect()
    for thread in threads:
        thread.join(PATIENCE)
        assert not thread.is_alive()
