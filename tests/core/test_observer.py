"""The observer's gain by duality: against the theory's formulas, eigenvalues, SciPy, and the separation of poles."""

from __future__ import annotations

import control
import mpmath
import numpy as np
import pytest
import sympy as sp
from scipy.linalg import solve_continuous_are
from scipy.signal import place_poles as scipy_place

from heli2dof_core import (
    InvalidInputError,
    MethodUnavailableError,
    PoleSet,
    Structure,
    design,
    plant,
    pole_error,
    preset,
)
from heli2dof_core.compiled import observer_gain
from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.estimators import Observer, observe
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


def stabilizing(A, Q, R):
    """P of AP + PAᵀ − PCᵀR⁻¹CP + Q = 0 from the stable subspace of the Hamiltonian matrix, at 50 digits."""
    with mpmath.workdps(50):
        A, Q, C_, inverse = (mpmath.matrix(M.tolist()) for M in (A, Q, C, np.linalg.inv(R)))
        H = mpmath.zeros(8)
        H[:4, :4], H[:4, 4:], H[4:, :4], H[4:, 4:] = A.T, -C_.T * inverse * C_, -Q, -A
        values, vectors = mpmath.eig(H)
        stable = [i for i in range(8) if mpmath.re(values[i]) < 0]
        assert len(stable) == 4
        X = mpmath.zeros(8, 4)
        for column, i in enumerate(stable):
            X[:, column] = vectors[:, i]
        P = X[4:, :] * X[:4, :] ** -1
        return np.array([[float(mpmath.re(P[i, j])) for j in range(4)] for i in range(4)])


def test_a_kalman_filter_is_that_of_the_riccati_equation():
    """L = P Cᵀ R⁻¹ for random rigs and densities: by mpmath, and by python-control and SciPy where these solve it."""
    rng, solved = np.random.default_rng(31), 0
    for i in range(60):
        model, poles, *_ = random_design(rng)
        placed = design(model, poles, Structure("axis-decoupled"))
        voltage, angle = 10 ** rng.uniform(-2, 2), 10 ** rng.uniform(-5, -1)
        L = observe(placed, Observer(method="kalman", voltage_noise=voltage, angle_noise=angle)).L
        Q, R = voltage**2 * model.B @ model.B.T, angle**2 * np.eye(2)
        if i < 10:
            theirs = stabilizing(model.A, Q, R) @ C.T / angle**2
            np.testing.assert_allclose(L, theirs, rtol=1e-9, atol=1e-9 * np.max(np.abs(theirs)))
        try:
            X = solve_continuous_are(model.A.T, C.T, (Q + Q.T) / 2, R)
            gain, *_ = control.lqe(model.A, np.eye(4), C, (Q + Q.T) / 2, R, method="scipy")
        except (ValueError, control.ControlArgument):  # in seconds they often cannot
            continue
        for theirs in (X @ C.T / angle**2, np.asarray(gain)):
            np.testing.assert_allclose(L, theirs, rtol=1e-6, atol=1e-6 * np.max(np.abs(theirs)))
        solved += 1
    assert solved > 20


def test_densities_far_apart_have_a_filter_too():
    """Over 21 decades of their ratio every filter is stable; one that trusts no measurement at all is refused."""
    placed = design(plant(preset().parameters), PoleSet([-4, -5, -3 + 2j, -3 - 2j]), Structure())
    for voltage, angle in ((1e-3, 1.0), (1.0, 1e-6), (1e6, 1e-6), (1e6, 1e-12)):
        L = observe(placed, Observer(method="kalman", voltage_noise=voltage, angle_noise=angle)).L
        assert L is not None and np.max(np.linalg.eigvals(placed.plant.A - L @ C).real) < 0
    with pytest.raises(MethodUnavailableError) as caught:
        observe(placed, Observer(method="kalman", voltage_noise=1e-9, angle_noise=1e3))
    assert caught.value.field == "observer.angle_noise"
