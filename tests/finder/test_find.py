"""Searches: what they find holds, the same seed finds the same, and what contradicts is named."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from heli2dof_core import Spec, Uncertainty, evaluate
from heli2dof_core.errors import CancelledError, InvalidInputError
from heli2dof_core.finder import Designs, Find, find, find_in_parts, finding
from heli2dof_core.finder.finding import distinct, thinned
from heli2dof_core.finder.problem import Problem
from heli2dof_core.finder.result import why_text
from heli2dof_core.finder.search import nondominated
from heli2dof_core.many import evaluate_many
from heli2dof_core.requirements import measure_of, requirements_of
from heli2dof_core.robustness import cloud
from tests.finder.problems import SETTLING, SOLVABLE, UNSOLVABLE, VOLTAGE, quick
from tests.finder.volume import volume

EASY = quick(SOLVABLE[0], 1500)


@pytest.fixture(scope="module")
def easy() -> Designs:
    return find(EASY.spec(), EASY.find)


def _told(found: Designs) -> list:
    return [(own.spec, own.values, own.required) for own in found.candidates]


def test_designs_meet_what_is_required_by_everybodys_path(easy):
    assert easy.met and len(easy.candidates) > 5 and easy.why is None
    for own in easy.candidates:
        steps = evaluate(own.spec, each_axis=True).axis_steps
        metrics = {axis: steps[axis]["nonlinear"].metrics for axis in ("theta", "psi")}
        settling = max(metrics[axis].axes[axis].settling_time for axis in metrics)
        peaks = max(motor.peak for one in metrics.values() for motor in one.motors.values())
        assert own.values[:2] == (settling, peaks)
        assert settling <= 1.505 and own.met


def test_they_are_a_front_and_better_than_what_was_there(easy):
    goals = np.array([own.values[:2] for own in easy.candidates])
    assert nondominated(goals).tolist() == list(
        range(len(goals))
    )  # sorted by the first figure, none dominated
    assert easy.present is not None
    here = np.array([easy.present.values[:2]])
    assert np.any(np.all(goals < here, axis=1))


def test_the_same_seed_finds_the_same_whatever_threads_there_are(easy):
    again = find(EASY.spec(), EASY.find, threads=1)
    assert _told(again) == _told(easy) and again.tried == easy.tried
    other = find(EASY.spec(), replace(EASY.find, seed=1))
    assert _told(other) != _told(easy)


def test_numpys_own_random_numbers_are_neither_used_nor_touched(easy):
    np.random.seed(3)
    before = np.random.get_state()[1].tolist()
    assert _told(find(EASY.spec(), EASY.find)) == _told(easy)
    assert np.random.get_state()[1].tolist() == before


def test_the_budget_holds(easy):
    assert 0.9 * EASY.find.designs <= easy.tried <= EASY.find.designs and not easy.stopped
    for part in find_in_parts(EASY.spec(), EASY.find):
        if not isinstance(part, Designs):
            assert part.tried <= part.designs == EASY.find.designs
            assert part.points.shape[1] == 2


def test_how_far_it_is_is_told_now_and_then(monkeypatch):
    def told() -> int:
        return sum(not isinstance(part, Designs) for part in find_in_parts(EASY.spec(), EASY.find))

    monkeypatch.setattr(finding, "PAUSE", 0.0)
    every = told()
    monkeypatch.setattr(finding, "PAUSE", 1e9)
    assert told() == 1 < every


def test_time_is_a_ceiling():
    found = find(EASY.spec(), replace(EASY.find, designs=1_000_000, seconds=0.5))
    assert found.stopped and found.tried < 1_000_000 and found.candidates


def test_it_can_be_called_off():
    calls = 0

    def check() -> None:
        nonlocal calls
        calls += 1
        if calls > 5:
            raise CancelledError("nobody waits")

    with pytest.raises(CancelledError):
        find(EASY.spec(), EASY.find, check)
    assert calls == 6


def test_nothing_to_minimize_finds_what_is_nearest():
    spec = Spec.from_preset(poles=[-12.0, -10.0, -9.25, -8.76])
    met = Find(("poles",), requirements_of({"overshoot": {"max": 10}}), designs=400)
    (own, *_) = find(spec, met).candidates
    assert own.met and np.sort(own.spec.poles.array) == pytest.approx(np.sort(spec.poles.array), rel=1e-3)
    missed = replace(met, require=requirements_of({"overshoot": {"max": 1}}), designs=1500)
    (own, *_) = find(spec, missed).candidates
    assert own.met and own.values[0] < 1.05


def test_limits_on_the_better_side_are_of_both_axes():
    ask = Find(("poles", "loops"), requirements_of({"rise_time": {"min": 0.4}}), designs=600)
    for own in find(Spec.from_preset(), ask).candidates:
        measures = [measure_of({"measure": "rise_time", "axis": axis}) for axis in ("theta", "psi")]
        assert own.met and evaluate_many([own.spec], measures).min() >= 0.395


def test_shares_are_of_all_rigs():
    rigs = Uncertainty({"K_pp": 0.3, "K_yy": 0.3, "J_p": 0.3}, samples=60, seed=2)
    needs = {"settling_time": {"max": 1.2, "share": 0.8}, "share_within_limits": {"min": 0.5}}
    ask = Find(
        ("poles", "loops"), requirements_of(needs), (measure_of("V_peak"),), uncertainty=rigs, designs=6000
    )
    found = find(Spec.from_preset(), ask)
    assert found.met
    for own in found.candidates[:3]:
        share, within = own.required
        assert share.share is not None and share.share >= 0.8 and share.met and within.met
        assert own.values[-1] == cloud(own.spec, rigs).share_within_limits


def test_uncertain_rigs_take_no_digital_controller():
    rigs = Uncertainty({"tau_p": 0.1}, samples=5)
    ask = Find(("poles",), requirements_of({"share_stable": {"min": 0.5}}), uncertainty=rigs)
    with pytest.raises(InvalidInputError) as caught:
        find(Spec.from_preset(), ask)
    assert caught.value.field == "uncertainty.spread.tau_p"


@pytest.mark.parametrize("case", UNSOLVABLE, ids=lambda case: case.name)
def test_contradictions_are_named(case):
    found = find(case.spec(), quick(case, 5000).find)
    assert not found.met and found.why is not None
    which = (*found.why.alone, *found.why.requirements)
    named = frozenset(case.find.require[i].measure.name for i in which)
    assert named in case.contradict and bool(found.why.alone) == (len(named) == 1)
    assert all(case.find.require[i].words in why_text(found) for i in which)
    for give in found.why.gives:
        assert give.value is not None and give.spec is not None and give.others_met
        need = case.find.require[give.requirement]
        assert not need.meets(give.value)
        # with what it would have to give all is met, by the design that is told
        loose = replace(need, **{"max" if need.max is not None else "min": give.value})
        others = [own for i, own in enumerate(case.find.require) if i != give.requirement]
        values = evaluate_many([give.spec], [own.measure for own in (loose, *others)])[0]
        assert all(own.meets(v) for own, v in zip((loose, *others), values.tolist(), strict=True))


def test_a_front_is_thinned_along_itself():
    x = np.linspace(0, 1, 500) ** 3
    goals = np.column_stack((x, 1 - x))
    kept = thinned(goals, 20)
    assert len(kept) == 20 and kept[0] == 0 and kept[-1] == 499 and np.all(np.diff(kept) > 0)
    assert np.diff(x[kept]).max() < 0.15


def test_fronts_are_told_from_what_they_dominate():
    rng = np.random.default_rng(5)
    for k in (1, 2, 3):
        goals = rng.integers(0, 8, (60, k)).astype(float)
        kept = goals[nondominated(goals)]
        for row in goals:
            assert any(np.all(own <= row) for own in kept)
        for i, row in enumerate(kept):
            assert not any(np.all(own <= row) for j, own in enumerate(kept) if j != i)
    assert volume(np.array([[1.0, 2.0], [2.0, 1.0], [2.0, 2.0]]), np.array([3.0, 3.0])) == 3.0


@pytest.mark.parametrize("problem", UNSOLVABLE[:2], ids=lambda own: own.name)
@pytest.mark.parametrize("looks", [0, 3, 8, 40])
def test_a_search_whose_time_runs_out_tells_what_it_has(problem, looks, monkeypatch):
    times = iter(range(10**9))
    monkeypatch.setattr("heli2dof_core.finder.search.perf_counter", lambda: next(times))
    monkeypatch.setattr("heli2dof_core.finder.finding.perf_counter", lambda: 0.0)
    found = find(problem.spec(), replace(quick(problem, 3000).find, seconds=max(looks, 0.1)))
    assert found.stopped and not found.met and found.candidates
    if found.why is not None:  # a set is told where it was found, whatever was not found of it
        assert {own.requirement for own in found.why.gives} == {*found.why.alone, *found.why.requirements}


HARD = {"disk_margin": {"min": 2.5}, SETTLING: {"max": 0.6}, VOLTAGE: {"max": 14}}


@pytest.fixture(scope="module")
def missed() -> Designs:
    """No disk margin is above 2; the other two can be met, each without the other."""
    return find(Spec.from_preset(), Find(("poles", "loops"), requirements_of(HARD), designs=3000))


def test_what_no_design_meets_is_told_before_what_contradicts(missed):
    assert missed.why is not None
    assert missed.why.alone == (0,) and missed.why.requirements == (1, 2)
    told = why_text(missed)
    assert told.startswith(
        f"No design of {missed.tried} tried meets Disk margin ≥ 2.50, whatever else is asked. Of"
    )
    assert "0.60 s and Largest |voltage|, both motors, either step ≤ 14.0 V together" in told
    assert [own.requirement for own in missed.why.gives] == [0, 1, 2]
    assert [table.title for table in missed.tables()[1:]] == ["out of reach", "these contradict"]


def test_several_that_are_out_of_reach_are_all_told_and_blame_no_other():
    hard = {SETTLING: {"max": 0.1}, VOLTAGE: {"max": 5}, "disk_margin": {"min": 0.5}}
    found = find(Spec.from_preset(), Find(("poles", "loops"), requirements_of(hard), designs=2000))
    assert found.why is not None and found.why.alone == (0, 1) and found.why.requirements == ()
    assert why_text(found).count("whatever else is asked") == 2 and "Disk margin" not in why_text(found)
    assert all(own.value is not None and not own.others_met for own in found.why.gives)


def test_nearest_misses_are_designs_of_their_own():
    """A search that has converged has tried hundreds that nobody tells apart."""
    ask = Find(("poles",), requirements_of({"disk_margin": {"min": 2.5}}), designs=3000)
    found = find(Spec.from_preset(), ask)
    problem = Problem(Spec.from_preset(), ask)
    assert not found.met and len(found.candidates) > 3
    margins = [own.values[0] for own in found.candidates]
    assert margins == sorted(margins, reverse=True)  # nearest first
    points = [problem.space.point_of(own.spec) for own in found.candidates]
    for (a, one), (b, other) in combinations(zip(points, margins, strict=True), 2):
        assert np.max(np.abs(a - b)) >= 0.05 or abs(one - other) > 0.05 * max(one, other)


def test_copies_of_one_design_are_told_once():
    ask = Find(("poles", "loops"), requirements_of(HARD), designs=200)
    problem = Problem(Spec.from_preset(), ask)
    home = problem.space.point_of(problem.space.spec)
    rng = np.random.default_rng(4)
    copies = np.clip(home + 1e-4 * rng.standard_normal((40, problem.space.size)), 0.0, 1.0)
    elsewhere = home.copy()
    elsewhere[0] += 0.2 if home[0] < 0.5 else -0.2
    tried = problem.tried(np.vstack((copies, elsewhere)))
    kept = distinct(problem, tried, 15)
    assert len(kept) == 2 and 40 in kept


def test_limits_that_exclude_one_another_need_no_search():
    needs = requirements_of({"overshoot": [{"max": 1}, {"min": 2, "axis": "theta"}], SETTLING: {"max": 1}})
    found = find(Spec.from_preset(), Find(("poles", "loops"), needs))
    assert found.tried == 0 and not found.met and not found.candidates and found.present is not None
    assert found.why is not None and found.why.excluding == ((0, 1),) and found.why.requirements == (0, 1)
    assert "exclude one another" in why_text(found) and "Settling" not in why_text(found)
    assert found.tables()[-1].title == "these exclude one another"


def test_requirements_that_fit_are_not_blamed_for_a_figure_that_no_design_has():
    """Within 0.05 s nothing settles, so that no settling time can be made small; the volts are kept all the same."""
    spec = Spec.from_preset(duration=0.05)
    ask = Find(("poles",), requirements_of({VOLTAGE: {"max": 24}}), (measure_of(SETTLING),), designs=400)
    found = find(spec, ask)
    assert any(all(own.met for own in design.required) for design in found.candidates)
    assert found.why is None
