"""The other methods against the libraries that know them, and their refusals with the reason."""

from __future__ import annotations

import builtins

import control
import numpy as np
import pytest
import slycot  # noqa: F401  (Varga's method must be testable here)
from scipy.linalg import solve_continuous_are
from scipy.signal import place_poles as scipy_place

from heli2dof_core import (
    METHODS,
    InvalidInputError,
    MethodUnavailableError,
    Weights,
    place,
    place_poles,
    plant,
    pole_error,
    preset,
)
from heli2dof_core.placement.ackermann import ackermann
from heli2dof_core.placement.bass_gura import bass_gura
from heli2dof_core.placement.dyadic import place_dyadic
from heli2dof_core.placement.method import Task
from heli2dof_core.request import spec_of
from heli2dof_core.signals import C
from tests.systems import random_poles, random_system, rounding

AERO = plant(preset("quanser-aero-2").parameters)
HELICOPTER = plant(preset().parameters)
POLES = np.array([-1.8 + 1j, -1.8 - 1j, -2.0, -2.4])
REAL = np.array([-12.0, -10.0, -9.25, -8.76])
PLACING = [name for name, method in METHODS.items() if method.places_poles]


@pytest.mark.parametrize("name", PLACING)
def test_every_placing_method_places(name):
    """Random cyclic systems with real poles, which every one of them takes."""
    rng = np.random.default_rng(11)
    for _ in range(10):
        n = int(rng.integers(3, 6))
        A, B, poles = rng.normal(size=(n, n)), rng.normal(size=(n, 2)), -np.arange(1.0, n + 1)
        result = place_poles(A, B, poles, name)
        assert result.pole_error is not None and result.pole_error < 1e-6
        np.testing.assert_allclose(result.closed_loop_poles, poles, atol=1e-6)
        assert result.norm * (1 + 1e-12) >= result.spectral_norm > 0


def test_single_input_gains_are_unique_and_agree_with_python_control():
    rng = np.random.default_rng(12)
    for _ in range(20):
        n = int(rng.integers(2, 6))
        A, B, poles = rng.normal(size=(n, n)), rng.normal(size=(n, 1)), random_poles(rng, n)
        theirs = control.place_acker(A, B, poles).reshape(1, n)
        for name in ("full-rank", "ackermann", "bass-gura", "varga"):
            own = place_poles(A, B, poles, name).placement.K
            np.testing.assert_allclose(
                own, theirs, rtol=1e-6, atol=1e-8 * np.max(np.abs(theirs)), err_msg=name
            )


@pytest.mark.parametrize(("name", "theirs"), [("tits-yang", "YT"), ("knv0", "KNV0")])
def test_robust_methods_are_scipys(name, theirs):
    expected = scipy_place(HELICOPTER.A, HELICOPTER.B, REAL, method=theirs)
    own = place_poles(HELICOPTER.A, HELICOPTER.B, REAL, name)
    np.testing.assert_array_equal(own.placement.K, expected.gain_matrix)
    plain = place_poles(HELICOPTER.A, HELICOPTER.B, REAL)
    assert own.eigenvector_condition is not None and plain.eigenvector_condition is not None
    assert own.eigenvector_condition < plain.eigenvector_condition


def test_varga_is_slicots_as_python_control_calls_it():
    for model, poles in ((AERO, POLES), (HELICOPTER, REAL)):
        own = place_poles(model.A, model.B, poles, "varga").placement.K
        theirs = control.place_varga(model.A, model.B, poles)
        wanted = (pole_error(poles, np.linalg.eigvals(model.A - model.B @ K)) for K in (own, theirs))
        assert max(wanted) < 1e-9
        assert np.linalg.norm(own) == pytest.approx(np.linalg.norm(theirs), rel=0.2)


def test_lqr_solves_the_riccati_equation_of_scipy():
    rng = np.random.default_rng(13)
    for _ in range(20):
        system = random_system(rng)
        n, p = system.B.shape
        weights = Weights(tuple(rng.uniform(0.1, 10, n)), tuple(rng.uniform(0.1, 10, p)))
        own = place_poles(system.A, system.B, system.poles, "lqr", weights=weights)
        P = solve_continuous_are(system.A, system.B, np.diag(weights.states), np.diag(weights.inputs))
        expected = np.diag(1 / np.array(weights.inputs)) @ system.B.T @ P
        np.testing.assert_allclose(own.placement.K, expected, rtol=1e-6, atol=1e-8 * np.max(np.abs(expected)))
        assert own.pole_error is None
        assert np.max(own.closed_loop_poles.real) < 0


def test_lqr_with_integral_action_is_lqr_of_the_augmented_system():
    weights = Weights((30.0, 30.0, 1.0, 1.0), (0.002, 0.004), (100.0, 50.0))
    placed = place_poles(HELICOPTER.A, HELICOPTER.B, REAL, "lqr-integral", C=C, weights=weights).placement
    assert placed.integral is not None
    A = np.block([[HELICOPTER.A, np.zeros((4, 2))], [-C, np.zeros((2, 2))]])  # z' = r − y
    B = np.vstack([HELICOPTER.B, np.zeros((2, 2))])
    Q, R = np.diag([*weights.states, *weights.integrals]), np.diag(weights.inputs)
    K = np.linalg.solve(R, B.T @ solve_continuous_are(A, B, Q, R))
    np.testing.assert_allclose(placed.K, K[:, :4], rtol=1e-6)
    np.testing.assert_allclose(placed.integral, -K[:, 4:], rtol=1e-6)


@pytest.mark.parametrize("formula", [ackermann, bass_gura])
def test_no_dyadic_design_exists_on_the_helicopter_without_a_first_feedback(formula):
    with pytest.raises(MethodUnavailableError, match="eigenvalue 0 with 2 independent eigenvectors"):
        place_dyadic(formula, HELICOPTER.A, HELICOPTER.B, REAL)
    first = np.array([[5.0, 0, 0, 0], [0, 20.0, 0, 0]])
    K = place_dyadic(formula, HELICOPTER.A, HELICOPTER.B, REAL, first_feedback=first)
    assert pole_error(REAL, np.linalg.eigvals(HELICOPTER.A - HELICOPTER.B @ K)) < 1e-6
    assert np.linalg.matrix_rank(K - first, tol=1e-9 * np.linalg.norm(K)) == 1


def test_a_dyadic_gain_exists_on_a_rig_with_stiffness_and_is_the_smallest_of_its_kind():
    one, other = (place_poles(AERO.A, AERO.B, POLES, name) for name in ("ackermann", "bass-gura"))
    assert np.linalg.matrix_rank(one.placement.K, tol=1e-9 * one.norm) == 1
    np.testing.assert_allclose(one.placement.K, other.placement.K, rtol=1e-6)
    rng = np.random.default_rng(14)
    wanted = np.poly(POLES).real
    for direction in rng.normal(size=(300, 2)):
        f = direction / np.linalg.norm(direction)
        assert np.linalg.norm(ackermann(AERO.A, AERO.B @ f, wanted)) >= one.norm * (1 - 1e-9)


def test_robust_methods_refuse_poles_that_occur_too_often():
    A, B = AERO.A, AERO.B
    for name in ("tits-yang", "knv0"):
        with pytest.raises(MethodUnavailableError, match="occurs 3 times") as caught:
            place_poles(A, B, [-1, -1, -1, -2], name)
        assert caught.value.field == "poles"
    assert place_poles(A, B, [-1, -1, -1, -2]).pole_error < 1e-3  # a double pole's root of rounding


def test_knv0_refuses_complex_poles():
    with pytest.raises(MethodUnavailableError, match="real poles only"):
        place_poles(AERO.A, AERO.B, POLES, "knv0")


def test_quadratic_methods_refuse_what_has_no_solution():
    A, B = np.diag([1.0, 0.0]), np.array([[1.0], [1.0]])
    with pytest.raises(MethodUnavailableError, match="no stabilizing solution"):
        place_poles(A, B, [-1, -2], "lqr", weights=Weights((0.0, 0.0), (1.0,)))
    with pytest.raises(MethodUnavailableError) as caught:
        place_poles(AERO.A, AERO.B, POLES, "lqr-integral")
    assert caught.value.field == "C"


def test_varga_without_slycot_says_what_to_install(monkeypatch):
    real = builtins.__import__

    def without(name, *args, **kwargs):
        if name.startswith("slycot"):
            raise ImportError(name)
        return real(name, *args, **kwargs)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(MethodUnavailableError) as caught:
        METHODS["varga"].place(None)
    assert caught.value.field == "method" and "slycot" in caught.value.hint


def test_unknown_methods_are_refused_with_those_known():
    with pytest.raises(InvalidInputError) as caught:
        place_poles(AERO.A, AERO.B, POLES, "magic")
    assert all(name in caught.value.hint for name in METHODS)


def test_a_gain_of_slicot_that_misses_is_refused():
    """Two complex pairs on this rig: SB01BD returns ‖K‖ = 2e18 without an error."""
    poles = [-9 + 5j, -9 - 5j, -9 + 2.25j, -9 - 2.25j]
    with pytest.raises(MethodUnavailableError, match="misses these poles"):
        place_poles(HELICOPTER.A, HELICOPTER.B, poles, "varga")
    assert place_poles(HELICOPTER.A, HELICOPTER.B, poles).pole_error < 1e-9


@pytest.mark.parametrize("n", [4, 5, 6, 7])
def test_the_order_of_the_poles_is_all_the_same_to_varga(n):
    """SB01BD takes neighbours for conjugates; interleaved ones must not be placed twice, nor be refused."""
    rng = np.random.default_rng(n)
    for _ in range(10):
        A, B = rng.normal(size=(n, n)), rng.normal(size=(n, rng.integers(1, 3)))
        upper = -np.arange(1.0, n // 2 + 1) + 1j * rng.uniform(0.5, 2, n // 2)
        poles = np.concatenate([upper, upper.conj(), [-0.5] * (n % 2)])
        for order in (np.arange(n), rng.permutation(n), np.argsort(poles.imag)):
            assert place_poles(A, B, poles[order], "varga").pole_error < 1e-5


def test_varga_needs_no_neighbours_on_a_chain():
    chain, last = np.diag(np.ones(3), 1), np.eye(4)[:, 3:]
    wanted = [-1 + 1j, -2 + 1j, -1 - 1j, -2 - 1j]
    placed = place_poles(chain, last, wanted, "varga")
    np.testing.assert_allclose(placed.placement.K, [np.poly(wanted).real[:0:-1]], rtol=1e-9)


TURNED = np.linalg.qr(np.random.default_rng(0).standard_normal((4, 4)))[0]
OSCILLATOR = np.array([[0, 1.0, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]])


@pytest.mark.parametrize(
    ("A", "B", "reached"),
    [
        (np.diag([1.0, 2, 3, 4]), [[1.0], [1], [1], [0]], 3),
        (np.diag([1.0, 2, 3, 4]), [[1.0, 0], [1, 2], [0, 1], [0, 0]], 3),
        (OSCILLATOR, [[0.0], [0], [0], [1]], 2),
        (np.diag([1.0, 1, 3, 4]), [[1.0], [1], [1], [1]], 3),
    ],
    ids=["one mode", "two inputs", "two modes", "an eigenvalue twice"],
)
@pytest.mark.parametrize("turned", [np.eye(4), TURNED], ids=["plain", "turned"])
def test_varga_says_of_an_uncontrollable_pair_that_it_is_one(A, B, reached, turned):
    poles = np.array([-1 + 1j, -1 - 1j, -3 + 1j, -3 - 1j])
    task = Task(turned @ A @ turned.T, turned @ np.array(B), poles)
    with pytest.raises(MethodUnavailableError, match=f"reach(es)? only {reached} of the 4 states") as caught:
        METHODS["varga"].place(task)
    assert caught.value.field == "B" and "two at a time" not in str(caught.value)


@pytest.mark.parametrize("B", [[[1.0], [1], [1], [1e-17]], [[1.0, 0], [1, 0], [1, 0], [0, 1e-17]]])
def test_varga_tells_what_slicot_takes_for_uncontrollable(B):
    """In units of its own this state is reached as well as any; SLICOT's tolerance is an absolute one."""
    A = np.diag([1.0, 2, 3, 4])
    with pytest.raises(MethodUnavailableError, match="SLICOT leaves 4 where the plant has it") as caught:
        place_poles(A, B, [-1, -2, -3, -4], "varga")
    assert caught.value.field == "B"
    assert place_poles(A, B, [-1, -2, -3, -4]).pole_error < 1e-6


def test_varga_law_on_random_systems():
    """SLICOT places one pole after the other, so its error is larger than rounding K explains."""
    rng = np.random.default_rng(15)
    ratios = []
    for _ in range(100):
        system = random_system(rng)
        placed = place_poles(system.A, system.B, system.poles, "varga")
        ratios.append(placed.pole_error / rounding(system, placed.placement.K))
    assert np.median(ratios) < 10


def test_lqr_decides_where_the_optimal_poles_lie_too_close_to_be_told_apart():
    """A rig with rotors whose units are 10³⁰⁰ apart; its loop is stable as SciPy sees it, too."""
    body = {
        "preset": "quanser-aero",
        "method": "lqr",
        "place_rotors": True,
        "rotors": {"yaw": {"tau": 5.86}},
        "parameters": {
            "K_py": 3.5,
            "K_yp": -558304.25,
            "B_p": 318669.64,
            "K_yy": 1e6,
            "J_y": 964153.48,
            "m": 6e-291,
        },
    }
    found = place(spec_of(body))
    assert np.max(np.linalg.eigvals(found.A_closed).real) < 0
