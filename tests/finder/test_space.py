"""The points among which is searched: what they stand for, in numbers and as a spec."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from heli2dof_core import Heli2DofError, InvalidInputError, Observer, Spec
from heli2dof_core.finder.ask import Bounds, Find
from heli2dof_core.finder.problem import Problem
from heli2dof_core.finder.proof import proved
from heli2dof_core.finder.space import Space, pair_point, pair_values, rounded
from heli2dof_core.kernels.update_layout import AIMS, GIVEN_K, K_GIVEN, L_GIVEN, NUMBERS
from heli2dof_core.many import SHARES
from heli2dof_core.placement.method import Weights
from heli2dof_core.requirements import measure_of, requirements_of
from heli2dof_core.signals import Floats
from tests.finder.problems import SETTLING, SOLVABLE, UNSOLVABLE, Case, aero_2, helicopter

EVERY = [*SOLVABLE, *UNSOLVABLE]
REQUIRED = requirements_of({"overshoot": {"max": 5}})


# searches whose K or L the kernel does not find itself
GIVEN = [
    Case(
        name,
        changes,
        Find(tuple(free.split()), REQUIRED, (measure_of(SETTLING), measure_of("norm"))),  # pyright: ignore[reportArgumentType]
    )
    for name, free, changes in (
        ("LQR", "weights loops", helicopter(method="lqr")),
        ("LQR of a rig with lag", "weights", aero_2(method="lqr")),
        ("LQR, rotors placed", "weights loops", aero_2(method="lqr", place_rotors=True)),
        ("LQR with integral action", "weights", helicopter(method="lqr-integral", outer="none")),
        (
            "LQR with integral action, rotors placed",
            "weights",
            aero_2(method="lqr-integral", place_rotors=True, outer="none"),
        ),
        (
            "LQR behind a Kalman filter",
            "weights",
            helicopter(method="lqr", measured="observer", observer=Observer(method="kalman")),
        ),
        ("LQR, its loops alone", "loops", helicopter(method="lqr")),
        ("another method's loops", "loops", helicopter(method="tits-yang")),
        ("another method's poles", "poles", helicopter(method="tits-yang")),
        (
            "a Kalman filter",
            "poles loops",
            helicopter(measured="observer", observer=Observer(method="kalman")),
        ),
    )
]


def _same(row: Floats, own: Floats, problem: Problem) -> bool:
    """Whether numbers are a design's: those of a gain to ten digits where many are found at once."""
    gain = slice(GIVEN_K, AIMS)
    if not problem.gains.quadratic:
        return np.array_equal(row, own, equal_nan=True)
    rest = np.delete(np.vstack((row, own)), np.r_[gain], axis=1)
    size = np.max(np.abs(own[gain]))
    return np.array_equal(*rest, equal_nan=True) and bool(
        np.max(np.abs(row[gain] - own[gain])) < 1e-10 * size
    )


@pytest.mark.parametrize("case", [*EVERY, *GIVEN], ids=lambda case: case.name)
def test_numbers_and_specs_are_the_same_designs(case):
    problem = Problem(case.spec(), case.find)
    points = np.random.default_rng(1).random((20, problem.space.size))
    for row, point in zip(problem.rows(points), points, strict=True):
        own = problem.many.numbers_of(problem.space.design(point), given=not problem.gains.closed_form)
        if problem.gains.closed_form:  # K of another path, where L is given
            row[K_GIVEN:L_GIVEN] = own[K_GIVEN:L_GIVEN]
        assert _same(row, own, problem)


@pytest.mark.parametrize("case", [*SOLVABLE, *GIVEN], ids=lambda case: case.name)
def test_what_is_searched_by_is_what_evaluate_tells(case):
    problem = Problem(case.spec(), case.find)
    points = np.random.default_rng(2).random((24, problem.space.size))
    tried = problem.tried(points)
    stable = tried.missed < 100
    assert np.any(stable)
    own = tried.taken(stable)
    designs = proved(problem, [problem.space.design(point) for point in own.points])
    columns = {measure: i for i, measure in enumerate(problem.measures)}
    digits = 1e-7 if problem.gains.quadratic else 0.0
    for design, values, excess in zip(designs, own.values, own.excess, strict=True):
        assert design.stable
        for measure, value in zip(problem.told, design.values, strict=True):
            if measure.name not in SHARES:
                near = np.allclose(value, values[columns[measure]], rtol=digits, atol=0.0, equal_nan=True)
                assert near, measure
        for need, judged, missed in zip(case.find.require, design.required, excess, strict=True):
            if not need.uncertain:
                assert judged.met == (missed == 0.0), need


@pytest.mark.parametrize("case", GIVEN, ids=lambda case: case.name)
def test_only_gains_of_other_methods_are_found_one_by_one(case, monkeypatch):
    problem = Problem(case.spec(), case.find)
    asked: list[Spec] = []
    assert problem.gains.row.shape == (NUMBERS,)  # of the spec that is there, once
    usual = problem.many.numbers_of
    monkeypatch.setattr(
        problem.many, "numbers_of", lambda spec, **how: (asked.append(spec), usual(spec, **how))[1]
    )
    tried = problem.tried(np.random.default_rng(5).random((30, problem.space.size)))
    assert np.any(tried.missed < 100)
    assert len(asked) == (30 if case.name == "another method's poles" else 0)


def test_weights_too_far_apart_for_many_at_once_take_everybodys_path():
    spec = Spec.from_preset(method="lqr", weights=Weights((1.0, 1.0, 1e8, 1.0), (1.0, 1.0)))
    problem = Problem(spec, Find(("weights",), REQUIRED, bounds=Bounds(weights=(1e-6, 1e6))))
    points = np.random.default_rng(6).random((60, problem.space.size))
    alone = problem.gains.give(problem.space.rows(problem.gains.row, points), points)
    assert 0 < np.count_nonzero(alone) < 60
    for row, point in zip(problem.rows(points)[alone], points[alone], strict=True):
        try:
            own = problem.many.numbers_of(problem.space.design(point), given=True)
        except Heli2DofError:  # a weight beyond those that a spec may have, or a loop that does not settle
            own = np.full(len(row), np.nan)
        assert np.array_equal(row, own, equal_nan=True)


def test_a_pair_goes_from_real_to_complex_through_a_double_pole():
    points = np.array([[0.6, kind] for kind in (0.0, 0.25, 0.4999999, 0.5, 0.5000001, 0.75, 1.0)])
    pairs = pair_values(points, (1.0, 50.0), 0.3)
    upper, other = pairs[:, 0] + 1j * pairs[:, 1], pairs[:, 2] + 1j * pairs[:, 3]
    assert np.all(pairs[:4, 1] == 0.0) and np.all(pairs[5:, 1] > 0.0)
    assert np.abs(upper[2:5] - upper[3]).max() < 1e-2 and np.abs(other[2:5] - upper[3]).max() < 1e-2
    sizes = np.sqrt(np.abs(upper * other))
    assert sizes == pytest.approx(np.full(len(points), sizes[3]), rel=1e-3)  # four digits
    assert np.abs(other[5:] - upper[5:].conj()).max() == 0.0
    assert -upper[-1].real / abs(upper[-1]) == pytest.approx(0.3, rel=1e-3)  # the least damping
    assert np.abs(upper).min() >= 1.0 - 1e-3 and np.abs(other).max() <= 50.0 * (1 + 1e-3)


def test_a_pair_is_found_again():
    rng = np.random.default_rng(3)
    points = rng.random((300, 2))
    for point, values in zip(points, pair_values(points, (0.5, 40.0), 0.2), strict=True):
        again = pair_point(complex(*values[:2]), complex(*values[2:]), (0.5, 40.0), 0.2)
        assert pair_values(np.array([again]), (0.5, 40.0), 0.2)[0] == pytest.approx(
            values, rel=1e-3, abs=1e-3
        )
        assert (
            again == pytest.approx(point, abs=2e-2) or abs(point[1] - 0.5) < 0.1
        )  # flat near the double pole


def test_the_design_that_is_there_is_one_of_the_points():
    for case in EVERY:
        space = Space(case.spec(), case.find)
        again = space.design(space.point_of(space.spec))
        for own, found in zip(again.poles.values, space.spec.poles.values, strict=True):
            assert abs(own - found) < 1e-2 * abs(found) or set(np.round(again.poles.array, 2)) == set(
                np.round(space.spec.poles.array, 2)
            )
        assert again.outer.pitch.kp == pytest.approx(space.spec.outer.pitch.kp, rel=1e-3)
        assert again.structure.family == space.spec.structure.family
        assert (again.outer.pairing, again.outer.decoupler) == (
            space.spec.outer.pairing,
            space.spec.outer.decoupler,
        )


def test_numbers_have_four_digits():
    assert rounded(np.array([[12.34567, -0.00123456], [1e5 / 3, 0.0]])).tolist() == [
        [12.35, -0.001235],
        [33330.0, 0.0],
    ]


def test_bounds_hold():
    bounds = Bounds(poles=(2.0, 9.0), damping=0.7, kp=(3.0, 5.0), ti=(0.2, 0.3))
    space = Space(Spec.from_preset(), Find(("poles", "loops"), REQUIRED, bounds=bounds))
    for point in np.random.default_rng(4).random((200, space.size)):
        own = space.design(point)
        assert all(2.0 * 0.999 <= abs(p) <= 9.0 * 1.001 for p in own.poles.values)
        assert all(-p.real >= 0.699 * abs(p) for p in own.poles.values)
        assert all(3.0 <= pi.kp <= 5.0 and 0.2 <= pi.ti <= 0.3 for pi in (own.outer.pitch, own.outer.yaw))


@pytest.mark.parametrize(
    ("changes", "free", "field"),
    [
        ({"method": "lqr"}, ("poles",), "free"),
        ({}, ("poles", "weights"), "free"),
        ({}, ("rotor_poles",), "free"),
        ({"outer": "none"}, ("loops",), "free"),
        ({"outer": "none"}, ("pairing",), "free"),
        ({"method": "knv0"}, ("structure",), "free"),
        ({"coupling": "axis-decoupled"}, ("shift",), "free"),
        ({}, ("observer",), "free"),
    ],
)
def test_what_has_no_effect_cannot_be_free(changes, free, field):
    with pytest.raises(InvalidInputError) as caught:
        Space(Spec.from_preset(**changes), Find(free, REQUIRED))
    assert caught.value.field == field


@pytest.mark.parametrize(
    ("ask", "field"),
    [
        ({"free": ()}, "free"),
        ({"free": ("poles", "gains")}, "free.1"),
        ({"require": ()}, "require"),
        ({"require": requirements_of({"overshoot": [{"max": 5}, {"max": 5}]})}, "require.overshoot.1"),
        ({"minimize": ("V_peak", "norm", {"measure": "V_peak", "motor": "both"})}, "minimize.2"),
        ({"designs": 5}, "designs"),
        ({"seconds": 0.0}, "seconds"),
        ({"require": requirements_of({"share_stable": {"min": 0.9}})}, "uncertainty"),
        ({"require": requirements_of({"overshoot": {"max": 5, "share": 0.9}})}, "uncertainty"),
    ],
)
def test_refusals_name_the_field(ask, field):
    with pytest.raises(InvalidInputError) as caught:
        Find(**{"free": ("poles",), "require": REQUIRED, **ask})
    assert caught.value.field == field


@pytest.mark.parametrize(
    ("bounds", "field"),
    [
        ({"poles": (5.0, 1.0)}, "bounds.poles"),
        ({"kp": (0.0, 1.0)}, "bounds.kp"),
        ({"damping": 0.0}, "bounds.damping"),
    ],
)
def test_bounds_that_are_none_are_refused(bounds, field):
    with pytest.raises(InvalidInputError) as caught:
        Bounds(**bounds)
    assert caught.value.field == field


def test_a_figure_that_is_neither_good_small_nor_large_is_not_minimized():
    measure = requirements_of({"lambda_11": {"max": 2}})[0].measure
    with pytest.raises(InvalidInputError) as caught:
        replace(Find(("poles",), REQUIRED), minimize=(measure,))
    assert caught.value.field == "minimize.0"
