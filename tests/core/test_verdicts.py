"""Verdicts that units and rounding must not decide: ranks, refusals, errors of placed poles."""

from __future__ import annotations

from dataclasses import replace

import mpmath
import numpy as np
import pytest
from scipy.linalg import solve_continuous_are

from heli2dof_core import (
    InvalidInputError,
    MethodUnavailableError,
    Spec,
    UncontrollableError,
    Weights,
    best_pairing,
    niederlinski_index,
    place,
    place_poles,
    relative_gain_array,
)
from heli2dof_core.rank import equilibrated, numeric_rank
from heli2dof_core.walkthrough import walk_through
from tests.bench import verdicts

SPEC = Spec.from_preset()
# A chain of three integrators whose states are in units 1e6 apart: K follows by hand from (s + 1)(s + 2)(s + 3)
CHAIN_A, CHAIN_B = np.array([[0, 1e6, 0], [0, 0, 1e-6], [0, 0, 0]]), np.array([[0.0], [0], [1]])


@pytest.mark.parametrize("kind", verdicts.KINDS)
def test_no_verdict_on_random_systems_is_wrong(kind):
    """A few of the thousands that `python -m tests.bench.verdicts` takes."""
    assert verdicts.wrong(kind, 12, seed=7) == []


@pytest.mark.parametrize("method", ["full-rank", "ackermann", "bass-gura", "varga"])
def test_units_do_not_make_a_chain_uncontrollable(method):
    placed = place_poles(CHAIN_A, CHAIN_B, [-1, -2, -3], method)
    np.testing.assert_allclose(placed.placement.K, [[6, 1.1e7, 6]], rtol=1e-9)
    assert placed.pole_error < 1e-9 and placed.findings == ()


def test_advice_fits_the_number_of_inputs():
    for method in ("ackermann", "bass-gura", "full-rank", "tits-yang", "varga"):
        with pytest.raises(UncontrollableError, match="the input reaches only 1 of the 2 states") as caught:
            place_poles(np.eye(2), [[1.0], [1.0]], [-1, -2], method)
        assert "several inputs" not in caught.value.hint
    with pytest.raises(
        MethodUnavailableError, match="eigenvalue 1 with 2 independent eigenvectors"
    ) as caught:
        place_poles(np.eye(2), np.eye(2), [-1, -2], "ackermann")
    assert "several inputs" in caught.value.hint


def test_what_is_wrong_with_b_is_said_of_b():
    for B, words in (
        ([[1.0, 0], [1, 0]], "column 2 of B is zero"),
        ([[1.0, 2], [2, 4]], "the 2 columns of B are dependent"),
    ):
        with pytest.raises(InvalidInputError, match=words):
            place_poles(np.diag([1.0, 2]), B, [-1, -2])
    with pytest.raises(InvalidInputError) as caught:
        place_poles([[1.0]], [[1.0, 1.0]], [-1])
    assert caught.value.hint == "Give one row and one column: there is one state."
    far_apart = np.array([[1.0, 1.0], [0.0, 1e-12]])  # of rank 2, whatever the second state's unit
    assert place_poles(np.zeros((2, 2)), far_apart, [-1, -2]).pole_error < 1e-9


def test_a_matrix_is_singular_in_all_units_or_in_none():
    G = np.array([[0.7, 0.1, 0.8], [0.2, 0.3, 0.5], [0.9, 0.4, 1.3]])  # rows 1 and 2 make row 3
    rng = np.random.default_rng(0)
    for _ in range(20):
        scaled = G * 10.0 ** rng.uniform(-6, 6, (3, 1)) * 10.0 ** rng.uniform(-6, 6, 3)
        with pytest.raises(InvalidInputError, match="singular"):
            relative_gain_array(scaled)
        with pytest.raises(InvalidInputError, match="singular"):
            best_pairing(scaled)
        assert niederlinski_index(scaled) == 0
    with pytest.raises(InvalidInputError, match="singular"):
        relative_gain_array(np.stack([np.eye(3), G]) + 0j)


def test_ill_scaled_is_not_singular():
    """Largest entries of 1 in all rows and columns, but for ε as regular as any: det = −2ε + ε²."""
    small = 1e-14
    G = np.array([[1.0, 1, 1], [1, small, 0], [1, 0, small]])
    assert numeric_rank(G) == 3
    assert np.linalg.cond(equilibrated(G)) < 10
    with mpmath.workdps(50):
        inverse = mpmath.matrix(G.tolist()) ** -1
        true = [[float(G[i, j] * inverse[j, i]) for j in range(3)] for i in range(3)]
    np.testing.assert_allclose(relative_gain_array(G), true, atol=1e-9)
    near = np.array([[1.0, 1.0], [1.0, 1.0 + 1e-12]])
    assert relative_gain_array(near)[0, 0] == pytest.approx(1e12, rel=1e-3)


def test_relative_gains_of_a_tall_plant_do_not_depend_on_its_inputs_units():
    rng = np.random.default_rng(3)
    G = rng.normal(size=(5, 3))
    np.testing.assert_allclose(relative_gain_array(G * [1e-9, 1, 1e9]), relative_gain_array(G), atol=1e-9)
    np.testing.assert_allclose(
        relative_gain_array((G * [1e-9, 1, 1e9]).T), relative_gain_array(G).T, atol=1e-9
    )


# Nearly uncontrollable: the input is near an eigenvector. Quintuple poles: K is an integer, rounded or not.
NEAR_A, NEAR_B = [[1.25, 0.43], [0.43, 1.75]], [[0.498688049233], [0.866781535078]]


def test_a_right_gain_is_not_told_to_be_wrong():
    """NumPy's eigenvalues of the rounded A − BK are +34 and −37; mpmath's, of the exact one, −1 and −2."""
    placed = place_poles(NEAR_A, NEAR_B, [-1, -2])
    found = verdicts.true_poles(np.array(NEAR_A), np.array(NEAR_B), placed.placement.K)
    assert placed.pole_error == pytest.approx(verdicts.farthest([-1, -2], found), rel=1e-9)
    assert placed.pole_error < 1e-6 and placed.pole_error_bound < 1e-14
    said = {f.code: f.message for f in placed.findings}
    assert said.keys() == {"nearly_uncontrollable", "rounded_closed_loop"}
    assert "can move them by more than the magnitude of the largest one: so" in said["rounded_closed_loop"]


@pytest.mark.parametrize("times", [2, 3, 4, 5])
def test_an_error_at_multiple_poles_is_not_told_too_small(times):
    rng = np.random.default_rng(times)
    for _ in range(5):
        A, B = rng.normal(size=(times, times)), rng.normal(size=(times, 1))
        placed = place_poles(A, B, [-1.3] * times)
        found = verdicts.true_poles(A, B, placed.placement.K)
        true = verdicts.farthest([-1.3] * times, found)
        assert placed.pole_error == pytest.approx(true, rel=1e-9, abs=1e-15)
        assert ("pole_error" in {f.code for f in placed.findings}) == (true > 1.3e-6)


def test_an_exact_gain_is_told_to_be_exact():
    A = [[-1.0, 0, 2, -3], [1, -4, 3, -1], [0, 2, 4, -5], [0, 0, -1, -2]]
    placed = place_poles(A, [[1.0], [0], [0], [0]], [-1, -1, -1, -1])  # SLICOT's SB01MD: K = [1, 29, 93, −76]
    assert placed.pole_error == 0 and placed.eigenvector_condition is None


def test_four_equal_poles_of_the_rig_are_judged_exactly_and_four_others_in_floats():
    plain, equal = place(SPEC), place(SPEC.changed(poles=[-4, -4, -4, -4]))
    assert not plain.verdict.exact and equal.verdict.exact
    for own in (plain, equal):
        found = verdicts.true_poles(own.plant.A, own.plant.B, own.K)
        true = verdicts.farthest(own.poles.values, found)
        assert abs(own.pole_error - true) <= own.pole_error_bound + 1e-15


DOUBLE = np.array([[0.0, 1], [0, 0]]), np.array([[0.0], [1]])
OSCILLATOR = np.array([[0.0, 1], [-1, 0]]), np.array([[0.0], [1]])
NO_SOLUTION = [
    (*DOUBLE, (0.0, 1.0), "do not see the mode at 0,"),
    (*DOUBLE, (0.0, 0.0), "do not see the mode at 0,"),
    (*OSCILLATOR, (0.0, 0.0), "do not see the mode at 0 ± 1j,"),
    (np.diag([1.0, 2]), np.array([[1.0], [0]]), (1.0, 1.0), "do not reach the mode at 2,"),
    (np.eye(2), np.ones((2, 1)), (1.0, 1.0), "do not reach the mode at 1,"),
    (np.array([[0, 1e6], [0, 0]]), np.array([[0.0], [1e-6]]), (0.0, 1.0), "do not see the mode at 0,"),
]


@pytest.mark.parametrize(("A", "B", "states", "words"), NO_SOLUTION)
def test_lqr_without_a_stabilizing_solution_is_refused_with_the_mode(A, B, states, words):
    with pytest.raises(MethodUnavailableError, match=words) as caught:
        place_poles(A, B, [-1, -2], "lqr", weights=Weights(states, (1.0,)))
    assert caught.value.hint and "method" not in caught.value.field


@pytest.mark.parametrize(
    ("A", "B", "states"),
    [
        (*DOUBLE, (1e-12, 1.0)),
        (*OSCILLATOR, (0.0, 1.0)),
        (np.array([[1.0, 1], [0, 2]]), np.array([[0.0], [1]]), (0.0, 0.0)),
        (np.diag([1.0, -2]), np.array([[1.0], [0]]), (1.0, 1.0)),
    ],
)
def test_lqr_with_one_is_scipys(A, B, states):
    own = place_poles(A, B, [-1, -2], "lqr", weights=Weights(states, (1.0,)))
    expected = B.T @ solve_continuous_are(A, B, np.diag(states), np.eye(1))
    np.testing.assert_allclose(own.placement.K, expected, atol=1e-9)
    assert np.max(own.closed_loop_poles.real) < 0


def test_integral_action_on_what_cannot_be_held_is_refused():
    for C in (np.eye(2), [[0.0, 1.0]]):
        with pytest.raises(MethodUnavailableError, match="an integral runs away") as caught:
            place_poles(*DOUBLE, [-1, -2], "lqr-integral", C=C)
        assert caught.value.field == "C"


def test_weights_of_a_wrong_number_are_refused_with_their_field():
    for weights, field in (
        (Weights((1.0,), (1.0,)), "weights.states"),
        (Weights((1.0, 1.0), ()), "weights.inputs"),
        (Weights((-1.0, 1.0), (1.0,)), "weights.states"),
        (Weights((1.0, 1.0), (0.0,)), "weights.inputs"),
    ):
        with pytest.raises(InvalidInputError) as caught:
            place_poles(*DOUBLE, [-1, -2], "lqr", weights=weights)
        assert caught.value.field == field


def test_lqrs_poles_are_not_to_be_dragged():
    placed = place(SPEC.changed(method="lqr"))
    words = " ".join(f.message for f in placed.findings)
    assert "LQR computes its poles" in words and "Place" not in words and "Drag" not in words


@pytest.mark.parametrize("structure", verdicts.STRUCTURES, ids=str)
@pytest.mark.parametrize("share", [3e-9, -1e-6, 1e-3])
def test_motors_that_push_nearly_alike_divide_by_no_zero(structure, share):
    p = SPEC.parameters
    near = p.replaced({"K_yy": p.K_py * p.K_yp / p.K_pp * (1 + share)})
    own = place(replace(SPEC, parameters=near, structure=structure))
    found = verdicts.true_poles(own.plant.A, own.plant.B, own.K)
    true = verdicts.farthest(own.poles.values, found)
    assert abs(own.pole_error - true) <= own.pole_error_bound * (1 + 1e-9)
    assert "nearly_uncontrollable" in {f.code for f in own.findings}
    assert np.all(np.isfinite(walk_through(own).T))
    if (
        share == 3e-9
    ):  # nothing but rounding K to floats is lost: the last digit of an entry moves the poles as far
        moves = []
        for at in np.ndindex(2, 4):
            K = own.K.copy()
            K[at] = np.nextafter(K[at], np.inf)
            moved = verdicts.true_poles(own.plant.A, own.plant.B, K)
            moves.append(verdicts.farthest([complex(v) for v in found], moved))
        assert true < 10 * max(moves)


def test_the_rational_gain_is_the_closed_forms_where_both_are_right():
    from heli2dof_core.gains import _exact_gain, full_rank_gain

    for structure in verdicts.STRUCTURES:
        model = place(SPEC).plant
        both = (law(model, SPEC.poles, structure) for law in (_exact_gain, full_rank_gain))
        for one, other in zip(*both, strict=True):  # K, then Ĝ(0)⁻¹
            np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-10 * np.max(np.abs(other)))


EMPTY = [{}, {"parameters": {}}, {"decoupler": None}, {"reference": None}, {"poles": None}]


@pytest.mark.parametrize("change", EMPTY, ids=str)
def test_what_is_left_out_or_empty_changes_nothing(change):
    same = SPEC.changed(**change)
    assert same == SPEC
    np.testing.assert_array_equal(place(same).K, place(SPEC).K)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"poles": []}, "poles"),
        ({"poles": [-1, -2, -3]}, "poles"),
        ({"pitch": ()}, "outer.pitch"),
        ({"yaw": (3.0,)}, "outer.yaw"),
        ({"yaw": (3.0, None)}, "outer.yaw.ti"),
        ({"reference": ()}, "reference"),
        ({"reference": (0.1,)}, "reference"),
        ({"parameters": {"K_pp": None}}, "parameters.K_pp"),
        ({"coupling": ""}, "structure.coupling"),
        ({"outer": ""}, "outer.outer"),
    ],
    ids=str,
)
def test_what_is_partial_is_refused_with_its_field(change, field):
    with pytest.raises(InvalidInputError) as caught:
        SPEC.changed(**change)
    assert caught.value.field == field


def test_partial_parameters_keep_the_others():
    changed = SPEC.changed(parameters={"K_pp": 0.3}).parameters
    assert changed == SPEC.parameters.replaced({"K_pp": 0.3}) and changed.K_yy == SPEC.parameters.K_yy
