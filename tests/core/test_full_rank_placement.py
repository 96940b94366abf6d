"""Full-rank placement of any controllable pair: laws over random systems, groups, ranks."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import QQ
from sympy.polys.matrices import DomainMatrix

from heli2dof_core import (
    InvalidInputError,
    PoleSet,
    Structure,
    UncontrollableError,
    UnpairedPolesError,
    design,
    full_rank,
    plant,
    pole_error,
    preset,
)
from heli2dof_core.controllability import controllability_indices, scan
from heli2dof_core.placement.assess import place_poles
from heli2dof_core.placement.groups import Group, assign, conjugate_units, splits
from heli2dof_core.symbolic.luenberger import (
    canonical_form,
    desired_rows,
    feedback,
    leading_rows,
)
from heli2dof_core.symbolic.luenberger import controllability_indices as exact_indices
from tests.strategies import operating_points, pole_sets, rigs
from tests.systems import brunovsky, random_poles, random_system, rounding

SYSTEMS = 1200


@pytest.mark.slow
def test_poles_land_on_random_systems_as_exactly_as_their_condition_allows():
    """Pole error, one to one, in units of what rounding K to doubles explains."""
    rng = np.random.default_rng(20_261_122)
    ratios, joined, prescribed = [], 0, 0
    for _ in range(SYSTEMS):
        system = random_system(rng)
        placed = full_rank(system.A, system.B, system.poles)
        found = np.linalg.eigvals(system.A - system.B @ placed.K)
        ratios.append(pole_error(system.poles, found) / rounding(system, placed.K))
        joined += any(len(group.inputs) > 1 for group in placed.groups)
        if system.indices is not None:
            prescribed += 1
            assert tuple(sorted(placed.controllability_indices)) == system.indices
    print(
        f"{SYSTEMS} systems: median {np.median(ratios):.3f}, worst {max(ratios):.3f}; {joined} joined blocks"
    )
    assert joined > 50 and prescribed > 400
    assert np.median(ratios) < 0.5
    assert max(ratios) < 10


@pytest.mark.parametrize("seed", range(8))
def test_the_construction_is_exact_over_the_rationals(seed):
    """T B has its unit columns, and det(sI − A + BK) is the desired polynomial, digit for digit."""
    rng = np.random.default_rng(seed)
    n, p = int(rng.integers(3, 7)), int(rng.integers(1, 4))
    entries = [rng.integers(-5, 6, size=shape).tolist() for shape in ((n, n), (n, p))]
    A, B = (DomainMatrix([[QQ(x) for x in row] for row in m], (n, len(m[0])), QQ) for m in entries)
    indices = exact_indices(A, B)
    form = canonical_form(A, B, indices, leading_rows(A, B, indices))
    assert form.T.matmul(A) == form.A_bar.matmul(form.T)
    bar, Q = form.B_bar.to_list(), form.Q.to_list()
    for row in range(n):
        if row not in form.ends:
            assert not any(bar[row])
    for i in range(p):
        assert Q[i][i] == 1
        assert not any(Q[i][j] for j in range(i))
        if len(set(indices)) == 1:
            assert not any(Q[i][j] for j in range(i + 1, p))
    polynomials = [[QQ(int(x)) for x in rng.integers(-9, 10, size=index)] for index in indices]
    for triangle in ("none", "lower", "upper"):
        blocks = [((i,), polynomial) for i, polynomial in enumerate(polynomials)]
        K = feedback(form, desired_rows(form, blocks, triangle))
        wanted = [QQ(1)]
        for polynomial in polynomials:
            wanted = product(wanted, [*polynomial, QQ(1)])
        assert (A - B.matmul(K)).charpoly() == wanted[::-1]


def product(a, b):
    result = [QQ(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            result[i + j] += x * y
    return result


@pytest.mark.slow
@given(rigs(), operating_points, pole_sets(), st.floats(-3, 3))
def test_the_rigs_closed_forms_are_members_of_the_general_family(rig, theta_0, poles, c):
    """The formulas that the derivation gives, against the general construction on the rig's numbers."""
    model = plant(rig, theta_0)
    pitch, yaw = rig.K_py / rig.K_pp, rig.K_yp / rig.K_yy
    members = (
        (Structure("input-diagonal"), None, "none"),
        (Structure("input-diagonal", shift=c), [[1, c], [0, 1]], "none"),
        (Structure("triangular", "pitch"), [[1, pitch], [0, 1]], "lower"),
        (Structure("triangular", "yaw"), [[1, 0], [yaw, 1]], "upper"),
        (Structure("triangular", "pitch", shift=c), [[1, c], [0, 1]], "lower"),
        (Structure("triangular", "yaw", shift=c), [[1, 0], [c, 1]], "upper"),
    )
    for structure, shift, triangle in members:
        general = full_rank(model.A, model.B, poles.array, shift=shift, triangle=triangle)
        own = design(model, poles, structure).K
        np.testing.assert_allclose(general.K, own, rtol=1e-7, atol=1e-9 * np.max(np.abs(own)))
        assert general.controllability_indices == (2, 2)


def test_six_splits_of_four_real_poles_give_six_gains_with_the_same_poles():
    model, poles = plant(preset().parameters), np.array([-2.0, -3.0, -5.0, -7.0])
    found = list(splits(poles, (2, 2)))
    assert len(found) == 6
    gains = []
    for pairs in found:
        groups = [Group((i,), pair) for i, pair in enumerate(pairs)]
        placed = full_rank(model.A, model.B, poles, groups=groups)
        assert pole_error(poles, np.linalg.eigvals(model.A - model.B @ placed.K)) < 1e-9
        by_name = design(model, PoleSet.dealt(list(poles), pairs), Structure("input-diagonal"))
        np.testing.assert_allclose(by_name.K, placed.K, rtol=1e-9, atol=1e-9)
        gains.append(placed.K)
    assert all(np.max(np.abs(a - b)) > 1 for a, b in permutations(gains, 2))


def test_splits_keep_conjugates_together():
    pair = [-1 + 2j, -1 - 2j]
    assert set(splits(np.array([*pair, -3, -4]), (2, 2))) == {((2, 3), (0, 1)), ((0, 1), (2, 3))}
    assert list(splits(np.array([*pair, -3]), (1, 2))) == [((2,), (0, 1))]
    with pytest.raises(UnpairedPolesError):
        list(splits(np.array([-1 + 2j, -3, -4, -5]), (2, 2)))


@given(st.data())
def test_automatic_groups_fit_and_keep_the_order_where_they_can(data):
    indices = data.draw(st.lists(st.integers(1, 4), min_size=1, max_size=4))
    n = sum(indices)
    rng = np.random.default_rng(data.draw(st.integers(0, 10**6)))
    poles = random_poles(rng, n)[rng.permutation(n)]
    groups = assign(poles, indices)
    assert sorted(i for g in groups for i in g.inputs) == list(range(len(indices)))
    assert sorted(i for g in groups for i in g.poles) == list(range(n))
    for group in groups:
        assert len(group.poles) == sum(indices[i] for i in group.inputs)
        conjugate_units(poles[list(group.poles)])
        assert len(group.inputs) <= 2
    if all(index % 2 == 0 for index in indices):
        assert all(len(g.inputs) == 1 for g in groups)


def test_odd_chains_are_joined_where_a_complex_pair_has_no_block_of_its_own():
    A, B = np.array([[1.0, 2.0], [3.0, 4.0]]), np.eye(2)
    placed = full_rank(A, B, [-1 + 2j, -1 - 2j])
    assert placed.groups == (Group((0, 1), (0, 1)),)
    assert pole_error([-1 + 2j, -1 - 2j], np.linalg.eigvals(A - B @ placed.K)) < 1e-12


def test_the_order_of_the_inputs_can_decide_the_indices():
    """Three states, two inputs: whose second column is looked at first gets the longer chain."""
    A, B = np.array([[1.0, 2, 3], [4, 5, 6], [7, 8, 10]]), np.array([[1.0, 0], [0, 1], [0, 0]])
    poles = [-1.0, -2.0, -3.0]
    one, other = full_rank(A, B, poles), full_rank(A, B, poles, input_order=[1, 0])
    assert (one.controllability_indices, other.controllability_indices) == ((2, 1), (1, 2))
    assert one.groups == (Group((0,), (0, 1)), Group((1,), (2,)))
    assert other.groups == (Group((1,), (0, 1)), Group((0,), (2,)))
    for placed in (one, other):
        assert pole_error(poles, np.linalg.eigvals(A - B @ placed.K)) < 1e-9
        ends = np.cumsum([len(group.poles) for group in placed.groups]) - 1
        np.testing.assert_allclose((placed.T @ B)[ends], placed.Q, atol=1e-12)


@pytest.mark.parametrize("hidden", [1, 2, 3])
def test_systems_with_states_out_of_reach_are_refused(hidden):
    rng = np.random.default_rng(hidden)
    for _ in range(50):
        n, p = 6, 2
        A, B = rng.normal(size=(n, n)), rng.normal(size=(n, p))
        A[-hidden:, :-hidden], B[-hidden:] = 0, 0
        basis = np.linalg.qr(rng.normal(size=(n, n)))[0]
        with pytest.raises(UncontrollableError, match=f"reach only {n - hidden} of the {n} states"):
            scan(basis.T @ A @ basis, basis.T @ B)


def test_the_rank_decision_does_not_depend_on_units():
    rng = np.random.default_rng(3)
    for _ in range(100):
        system = random_system(rng)
        n, p = system.B.shape
        units, volts, seconds = 10.0 ** rng.uniform(-6, 6, n), 10.0 ** rng.uniform(-6, 6, p), 1e3
        A = seconds * system.A * units / units[:, None]
        B = seconds * system.B / units[:, None] * volts
        assert controllability_indices(A, B) == controllability_indices(system.A, system.B)


def test_long_chains_are_controllable():
    """Ten states behind one input: the raw Krylov matrix is singular to working precision."""
    rng = np.random.default_rng(5)
    for n in (8, 9, 10):
        A, B = rng.normal(size=(n, n)), rng.normal(size=(n, 1))
        assert scan(A, B).indices == (n,)
        poles = random_poles(rng, n)
        result = place_poles(A, B, poles)
        assert result.pole_error is not None and result.pole_error < 1e-4
    A, B = brunovsky(np.array([10]))
    assert scan(A, B).indices == (10,)


def test_nearly_uncontrollable_systems_are_told():
    A = np.diag([-1.0, -2.0, -3.0])
    B = np.array([[1.0], [1.0], [1e-7]])
    assert "nearly_uncontrollable" not in {f.code for f in place_poles(A, B, [-4, -5, -6]).findings}
    near = np.diag([-1.0, -1.0 - 1e-7, -3.0])
    found = place_poles(near, np.ones((3, 1)), [-4, -5, -6])
    assert "nearly_uncontrollable" in {f.code for f in found.findings}
    with pytest.raises(UncontrollableError):
        place_poles(np.diag([-1.0, -1.0, -3.0]), np.ones((3, 1)), [-4, -5, -6])


GOOD = {"A": np.diag([1.0, 1.0], 1), "B": np.array([[0.0, 0], [0, 1], [1, 0]]), "poles": [-1, -2, -3]}
BAD = [
    ({"A": np.ones((2, 3))}, "A"),
    ({"A": np.full((3, 3), np.nan)}, "A"),
    ({"A": np.eye(30)}, "A"),
    ({"A": [[1, 2], [3]]}, "A"),
    ({"B": "none"}, "B"),
    ({"B": np.ones((3, 2))}, "B"),
    ({"B": np.ones((2, 2))}, "B"),
    ({"poles": [-1, -2]}, "poles"),
    ({"poles": [-1, -2, np.inf]}, "poles"),
    ({"groups": [Group((0,), (0, 1)), Group((1,), (2,))]}, "groups.0.poles"),
    ({"groups": [Group((0,), (0,)), Group((1,), (1, 1))]}, "groups"),
    ({"groups": [Group((0, 0), (0, 1, 2))]}, "groups"),
    ({"input_order": [0, 0]}, "input_order"),
    ({"triangle": "left"}, "triangle"),
    ({"shift": [[1, 2], [0, 2]]}, "shift"),
    ({"shift": [[1, 0], [2, 1]]}, "shift"),
    ({"shift": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "shift"),
]


@pytest.mark.parametrize(("change", "field"), BAD, ids=lambda x: str(x)[:30])
def test_what_does_not_fit_is_refused_with_its_field(change, field):
    full_rank(**GOOD)
    with pytest.raises(InvalidInputError) as caught:
        full_rank(**{**GOOD, **change})
    assert caught.value.field == field


def test_a_group_may_not_separate_conjugates():
    A, B = brunovsky(np.array([2, 2]))
    poles = [-1 + 1j, -1 - 1j, -2 + 1j, -2 - 1j]
    with pytest.raises(UnpairedPolesError):
        full_rank(A, B, poles, groups=[Group((0,), (0, 2)), Group((1,), (1, 3))])
