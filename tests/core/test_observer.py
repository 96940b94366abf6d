"""The observer's gain by duality: against the theory's formulas, eigenvalues, SciPy, and the separation of poles."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
from scipy.signal import place_poles as scipy_place

from heli2dof_core import InvalidInputError, PoleSet, Structure, design, plant, pole_error, preset
from heli2dof_core.compiled import observer_gain
from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.symbolic import names as n
from heli2dof_core.symbolic.names import PARAMETERS as P
from heli2dof_core.symbolic.observer import dual, indices, observer
from tests.core.test_six_states import random_design

C = np.eye(2, 4)


def test_observability_indices_are_two_and_two():
    assert indices() == (2, 2)


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_gain_is_that_of_the_theory_in_every_structure(structure):
    """l₁ = −q₁ − q₂ − b, l₂ = q₁q₂ + a − l₁ b for either axis, from s² + (l₁ + b)s + l₁b − a + l₂."""
    L = observer(structure).L.to_Matrix().subs(n.COEFFICIENTS_OF_OBSERVER_POLES)
    expected = sp.zeros(4, 2)
    for i, (p, q, a, b) in enumerate(
        ((n.q_1, n.q_2, n.a, P["B_p"] / n.alpha), (n.q_3, n.q_4, 0, P["B_y"] / n.beta_0))
    ):
        expected[i, i] = -p - q - b
        expected[i + 2, i] = p * q + a - expected[i, i] * b
    assert all(sp.cancel(entry) == 0 for entry in L - expected)


@pytest.mark.parametrize("structure", [s for s in STRUCTURES if s.coupling != "axis-decoupled"], ids=str)
def test_shifted_gains_couple_the_axes_and_keep_the_polynomial(structure):
    A, Ct = dual()
    L = observer(structure, shifted=True).L
    assert n.c in L.to_Matrix().free_symbols
    closed = (A - Ct.matmul(L.transpose())).to_Matrix()
    s = n.s
    d_1, d_2 = s**2 + n.d_11 * s + n.d_10, s**2 + n.d_21 * s + n.d_20
    assert sp.cancel(closed.charpoly(s).as_expr() - d_1 * d_2) == 0
    at_zero = L.to_Matrix().subs(n.c, 0) - observer(structure).L.to_Matrix()
    assert all(sp.cancel(entry) == 0 for entry in at_zero)


def test_the_axis_decoupled_observer_has_no_shift():
    with pytest.raises(InvalidInputError):
        observer(Structure("axis-decoupled"), shifted=True)


def test_random_observers_have_their_poles_and_do_not_move_the_controllers():
    """eig(A − LC), and eig [[A − BK, BK], [0, A − LC]] = both sets together (separation), by LAPACK."""
    rng = np.random.default_rng(23)
    worst = 0.0
    for _ in range(300):
        model, poles, _, structure, _, _ = random_design(rng)
        wanted = PoleSet([4 * p for p in poles.values])
        own = () if structure.shift is None else (structure.shift,)
        function = observer_gain(structure.family, shifted=structure.shift is not None)
        L = np.array(function(*wanted.coefficients, *model.numbers, *own))
        error = model.A - L @ C
        np.testing.assert_allclose(np.poly(error), np.poly(wanted.array).real, rtol=1e-9, atol=1e-9)
        worst = max(worst, pole_error(wanted.array, np.linalg.eigvals(error)) / np.max(np.abs(wanted.array)))
        K = design(model, poles, structure).K
        loop = np.block([[model.A - model.B @ K, model.B @ K], [np.zeros((4, 4)), error]])
        together = np.concatenate((poles.array, wanted.array))
        assert pole_error(together, np.linalg.eigvals(loop)) < 1e-4 * np.max(np.abs(together))
        # the same in the states of rig and observer, where nothing is triangular
        whole = np.block([[model.A, -model.B @ K], [L @ C, model.A - model.B @ K - L @ C]])
        np.testing.assert_allclose(np.poly(whole), np.poly(together).real, rtol=1e-6)
    print(f"pole error {worst:.1e} of the largest pole")
    assert worst < 1e-6


def test_scipy_places_the_dual_with_the_same_poles():
    model, wanted = plant(preset().parameters, 0.2), PoleSet([-40, -42, -41, -43])
    L = np.array(observer_gain(Structure("axis-decoupled"))(*wanted.coefficients, *model.numbers))
    theirs = scipy_place(model.A.T, C.T, wanted.array.real).gain_matrix.T
    for gain in (L, theirs):
        assert pole_error(wanted.array, np.linalg.eigvals(model.A - gain @ C)) < 1e-6
