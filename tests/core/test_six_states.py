"""The rig with its rotors: K 2×6 in symbols and in numbers, against eigenvalues, SciPy and python-control."""

from __future__ import annotations

import control
import numpy as np
import pytest
import sympy as sp
from scipy.signal import place_poles as scipy_place

from heli2dof_core import (
    InvalidInputError,
    Parameters,
    PoleSet,
    Structure,
    StructureUnavailableError,
    UncontrollableError,
    design,
    full_rank,
    plant,
    pole_error,
    preset,
)
from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.placement.exact import exact_coefficients
from heli2dof_core.placement.groups import Group
from heli2dof_core.placement.verdict import judge
from heli2dof_core.placement.with_rotors import (
    cubic,
    exact_gain_with_rotors,
    gain_with_rotors,
    with_rotors,
)
from heli2dof_core.symbolic import names as n
from heli2dof_core.symbolic.rotors import full_rank_with_rotors, indices, plant_with_rotors

DESIGNS = 300
C = np.eye(2, 6)
SHIFTED = tuple(s for s in STRUCTURES if s.coupling != "axis-decoupled")


def random_design(rng):
    """A rig at a point with rotors, thrust slopes, six poles and a structure, every fourth shifted by hand."""
    K_pp, K_yy = rng.uniform(0.02, 0.5, 2)
    rig = Parameters(
        K_pp=K_pp,
        K_yy=K_yy,
        K_py=rng.uniform(-0.8, 0.8) * K_pp,
        K_yp=rng.uniform(-0.8, 0.8) * K_yy,
        J_p=rng.uniform(0.01, 0.1),
        J_y=rng.uniform(0.01, 0.1),
        m=rng.uniform(0, 3),
        l=rng.uniform(0, 0.4),
        B_p=rng.uniform(0, 2),
        B_y=rng.uniform(0, 2),
        K_s=rng.uniform(0, 0.5),
    )
    model = plant(rig, rng.uniform(-0.7, 0.7))
    shift = float(rng.uniform(-2, 2)) if rng.random() < 0.25 else None
    family = SHIFTED if shift is not None else STRUCTURES
    chosen = family[rng.integers(len(family))]
    structure = Structure(chosen.coupling, chosen.lead, shift)
    poles = PoleSet([*random_pair(rng), *random_pair(rng)])
    return model, poles, -rng.uniform(1, 40, 2), structure, rng.uniform(0.02, 0.5, 2), rng.uniform(0.5, 3, 2)


def random_pair(rng):
    re = -rng.uniform(0.5, 20)
    if rng.random() < 0.5:
        im = rng.uniform(0.3, 15)
        return complex(re, im), complex(re, -im)
    return complex(re), complex(-rng.uniform(0.5, 20))


def general(A, B, poles, thirds, structure):
    """The general construction's K for the same member: its scan, its groups, its shift."""
    driven = np.linalg.matrix_power(A, 2)[:2] @ B  # of θ and ψ the derivative that the inputs reach
    yaw_leads = structure.coupling == "triangular" and structure.lead == "yaw"
    c = structure.shift
    if c is None:
        own = {"pitch": driven[0, 1] / driven[0, 0], "yaw": driven[1, 0] / driven[1, 1]}
        c = own[structure.lead] if structure.coupling == "triangular" else 0.0
    triangle = "none" if structure.coupling != "triangular" else "upper" if yaw_leads else "lower"
    wanted = [*poles.values[:2], thirds[0], *poles.values[2:], thirds[1]]
    shift = [[1, 0], [c, 1]] if yaw_leads else [[1, c], [0, 1]]
    groups = [Group((0,), (0, 1, 2)), Group((1,), (3, 4, 5))]
    return full_rank(A, B, wanted, groups=groups, triangle=triangle, shift=shift)


def test_random_designs_have_their_poles_and_are_the_general_constructions():
    """Eigenvalues by LAPACK; K against the general construction, which scans A⁺, B⁺ by itself, to 1e-12."""
    rng = np.random.default_rng(17)
    worst_pole = worst_gain = 0.0
    for _ in range(DESIGNS):
        model, poles, thirds, structure, tau, slope = random_design(rng)
        K, inverse = gain_with_rotors(model, poles, thirds, structure, tau, slope=slope)
        A, B = with_rotors(model.A, model.B * slope, tau)
        wanted = np.array([*poles.values, *thirds])
        found = np.linalg.eigvals(A - B @ K)
        size = np.max(np.abs(wanted))
        worst_pole = max(worst_pole, pole_error(wanted, found) / size)
        np.testing.assert_allclose(np.poly(found), np.poly(wanted).real, rtol=1e-9)
        if structure.coupling != "axis-decoupled":
            placed = general(A, B, poles, thirds, structure)
            assert placed.controllability_indices == (3, 3)
            worst_gain = max(worst_gain, np.max(np.abs(K - placed.K)) / np.max(np.abs(placed.K)))
        np.testing.assert_allclose(
            -C @ np.linalg.solve(A - B @ K, B) @ inverse, np.eye(2), rtol=1e-9, atol=1e-9
        )
    print(f"{DESIGNS} designs: pole error {worst_pole:.1e} of the largest pole, K {worst_gain:.1e}")
    assert worst_gain < 1e-12
    assert worst_pole < 1e-5  # triples may nearly coincide


def test_scipy_and_python_control_place_the_same_poles_with_other_gains():
    rng = np.random.default_rng(3)
    for _ in range(20):
        model, _, _, structure, tau, slope = random_design(rng)
        poles, thirds = PoleSet([-2 + 3j, -2 - 3j, -4, -6]), (-9.0, -14.0)
        wanted = np.array([*poles.values, *thirds])
        K, _ = gain_with_rotors(model, poles, thirds, structure, tau, slope=slope)
        A, B = with_rotors(model.A, model.B * slope, tau)
        theirs = (np.asarray(control.place(A, B, wanted)), scipy_place(A, B, wanted).gain_matrix)
        for other in (K, *theirs):
            assert pole_error(wanted, np.linalg.eigvals(A - B @ other)) < 1e-6
        assert np.max(np.abs(K - theirs[0])) > 1e-3 * np.max(np.abs(K))


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_derivation_has_the_desired_polynomial_digit_for_digit(structure):
    A, B = plant_with_rotors()
    result = full_rank_with_rotors(structure)
    form, s = result.form, n.s
    assert form.indices == indices() == (3, 3)
    assert form.T.matmul(A) == form.A_bar.matmul(form.T)
    K = result.K.to_Matrix()
    closed = (A.to_Matrix() - B.to_Matrix() * K).subs(
        {symbol: sp.Rational(2 + 3 * i, 5 + i) for i, symbol in enumerate(n.PARAMETERS.values())}
        | {
            n.alpha: 2,
            n.beta_0: 3,
            n.a: sp.Rational(1, 7),
            n.tau_p: sp.Rational(1, 6),
            n.tau_y: sp.Rational(1, 5),
        }
    )
    d_1 = s**3 + n.d_12 * s**2 + n.d_11 * s + n.d_10
    d_2 = s**3 + n.d_22 * s**2 + n.d_21 * s + n.d_20
    assert sp.expand(closed.applyfunc(sp.cancel).charpoly(s).as_expr() - d_1 * d_2) == 0


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_structures_are_what_they_claim_to_be(structure):
    """Ĝ(s) triangular, diagonal, or diagonal in B₂⁻¹[θ, ψ], at complex s off the poles."""
    rng = np.random.default_rng(5)
    for _ in range(10):
        model, poles, thirds, _, tau, slope = random_design(rng)
        K, _ = gain_with_rotors(model, poles, thirds, structure, tau, slope=slope)
        A, B = with_rotors(model.A, model.B * slope, tau)
        for s in (0.3j, 2 + 5j, 11j, 1.0):
            G = C @ np.linalg.solve(s * np.eye(6) - A + B @ K, B)
            size = np.max(np.abs(G))
            if structure.coupling == "input-diagonal":
                G = np.linalg.solve(model.B[2:] * slope, G)
                size = np.max(np.abs(G))
                assert abs(G[0, 1]) + abs(G[1, 0]) < 1e-9 * size
                continue
            # v reaches the axes through B₂ all the same: what is decoupled are the axes' own motions
            rest = np.linalg.solve(s * np.eye(6) - A + B @ K, np.eye(6))
            lead, other = (0, 1) if structure.lead == "pitch" else (1, 0)
            driven = [abs(rest[lead, other]), abs(rest[lead, other + 2])]
            assert max(driven) < 1e-9 * np.max(np.abs(rest))
            if structure.coupling == "axis-decoupled":
                assert max(abs(rest[other, lead]), abs(rest[other, lead + 2])) < 1e-9 * np.max(np.abs(rest))
            else:  # the triangular one is driven for good
                assert max(abs(rest[other, lead]), abs(rest[other, lead + 2])) > 1e-9 * np.max(np.abs(rest))


@pytest.mark.parametrize("structure", [s for s in STRUCTURES if s.coupling != "input-diagonal"], ids=str)
def test_leading_axis_has_exactly_its_own_three_poles(structure):
    """From any start of θ, θ̇, θ̈ and any of the rest, pitch moves by its own cubic alone (Cayley and Hamilton)."""
    model, tau = plant(preset().parameters, 0.2), (0.16, 0.2)
    poles, thirds = PoleSet([-3 + 2j, -3 - 2j, -5, -6]), (-11.0, -13.0)
    K, _ = gain_with_rotors(model, poles, thirds, structure, tau)
    A, B = with_rotors(model.A, model.B, tau)
    closed, axis = A - B @ K, 0 if structure.lead == "pitch" else 1
    own = [*poles.values[2 * axis : 2 * axis + 2], thirds[axis]]
    powers = [np.linalg.matrix_power(closed, k)[axis] for k in range(4)]
    left = sum(coefficient * row for coefficient, row in zip(np.poly(own).real[::-1], powers, strict=True))
    assert np.max(np.abs(left)) < 1e-9 * np.max(np.abs(powers[3]))


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_rotors_that_follow_at_once_leave_the_four_state_gain(structure):
    """τ → 0 with both third poles at −1/τ: K → [K₄, 0], linearly in τ, where both rotors have one τ.

    Then d_i(s) τ → (s² + d_i1 s + d_i0)(τ s + 1), the shift K_py/K_pp is the four states', and the rotors need
    no feedback. K's columns on the axes are those of [K₄ (I + small)], its columns on the rotors vanish.
    """
    model, poles = plant(preset().parameters, 0.1), PoleSet([-3 + 2j, -3 - 2j, -5, -6])
    four = design(model, poles, structure)
    gaps = []
    for tau in (1e-3, 1e-4, 1e-5):
        K, inverse = gain_with_rotors(model, poles, (-1 / tau, -1 / tau), structure, (tau, tau))
        size = np.max(np.abs(four.K))
        gaps.append(np.max(np.abs(K[:, :4] - four.K)) / size + np.max(np.abs(K[:, 4:])))
        assert np.max(np.abs(inverse - four.steady_state_inverse)) < 100 * tau * size
    assert gaps[0] < 0.1
    assert gaps[1] < 0.11 * gaps[0] and gaps[2] < 0.11 * gaps[1]


def test_motors_that_push_nearly_alike_are_placed_exactly():
    """γ a hundred-thousandth of its terms: nothing is rounded but K, whose last digits move the poles a little."""
    values = preset().parameters.as_dict()
    rig = Parameters(**{**values, "K_py": values["K_pp"] * values["K_yy"] / values["K_yp"] * (1 - 1e-5)})
    model = plant(rig)
    assert model.nearly_parallel
    poles, thirds, tau = PoleSet([-3 + 2j, -3 - 2j, -5, -6]), (-11.0, -13.0), (0.16, 0.2)
    for structure in STRUCTURES:
        K, inverse = gain_with_rotors(model, poles, thirds, structure, tau)
        polynomials = [cubic(poles.coefficients[:2], -11.0), cubic(poles.coefficients[2:], -13.0)]
        again = exact_gain_with_rotors(model.A, model.B, tau, structure, polynomials)
        np.testing.assert_array_equal(K, again[0])
        np.testing.assert_array_equal(inverse, again[1])
        A, B = with_rotors(model.A, model.B, tau)
        assert judge(A, B, K, np.array([*poles.values, *thirds])).error < 1e-3


def test_exact_and_closed_form_agree_in_all_digits_but_the_last():
    rng = np.random.default_rng(11)
    for _ in range(60):
        model, poles, thirds, structure, tau, slope = random_design(rng)
        K, inverse = gain_with_rotors(model, poles, thirds, structure, tau, slope=slope)
        triples = ((*poles.values[:2], complex(thirds[0])), (*poles.values[2:], complex(thirds[1])))
        exact = exact_gain_with_rotors(
            model.A, model.B * slope, tau, structure, [exact_coefficients(triple) for triple in triples]
        )
        for ours, theirs in ((K, exact[0]), (inverse, exact[1])):
            assert np.max(np.abs(ours - theirs)) < 1e-12 * np.max(np.abs(theirs))


def test_cubic_is_numpys():
    np.testing.assert_allclose((1.0, *cubic((25.0, 6.0), -15.0)[::-1]), np.poly([-3 + 4j, -3 - 4j, -15]).real)


def test_what_cannot_be_placed_says_why():
    model, poles = plant(preset().parameters), PoleSet([-3, -4, -5, -6])
    for tau, field in (((0.0, 0.1), "rotors.pitch.tau"), ((0.1, 0.0), "rotors.yaw.tau")):
        with pytest.raises(InvalidInputError) as caught:
            gain_with_rotors(model, poles, (-7, -8), Structure(), tau)
        assert caught.value.field == field
        with pytest.raises(InvalidInputError):
            with_rotors(model.A, model.B, tau)
    with pytest.raises(UncontrollableError) as caught:
        gain_with_rotors(model, poles, (-7, -8), Structure(), (0.1, 0.1), slope=(2.0, 0.0))
    assert caught.value.field == "rotors.yaw"
    with pytest.raises(UncontrollableError):
        exact_gain_with_rotors(model.A, model.B * [1, 0], (0.1, 0.1), Structure(), [(1, 3, 3), (1, 3, 3)])
    values = preset().parameters.as_dict()
    crossed = plant(Parameters(**{**values, "K_pp": 0.0}))
    with pytest.raises(StructureUnavailableError):
        gain_with_rotors(crossed, poles, (-7, -8), Structure("triangular", "pitch"), (0.1, 0.1))
    K, _ = gain_with_rotors(crossed, poles, (-7, -8), Structure("triangular", "yaw"), (0.1, 0.1))
    A, B = with_rotors(crossed.A, crossed.B, (0.1, 0.1))
    assert pole_error([-3, -4, -5, -6, -7, -8], np.linalg.eigvals(A - B @ K)) < 1e-6
    with pytest.raises(InvalidInputError):
        full_rank_with_rotors(Structure("axis-decoupled"), shifted=True)
