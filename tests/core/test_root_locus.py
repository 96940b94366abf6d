"""LQR's poles and their symmetric root locus against python-control's and SciPy's Riccati solvers."""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest
from mpmath import mp
from scipy.linalg import solve_continuous_are
from scipy.optimize import linear_sum_assignment

from heli2dof_core import PRESETS, Spec
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.evaluate import evaluate, place, weights_of
from heli2dof_core.placement.method import Weights
from heli2dof_core.root_locus import DEAREST, optimal_poles, symmetric_root_locus
from heli2dof_core.rotors import Rotor, Rotors
from heli2dof_core.tuning import axis_poles

UNLIKE = Weights((3.0, 40.0, 0.0, 2.0), (0.3, 0.004), (8.0, 0.5))
CASES = {
    **{f"{name}, Bryson's rule": Spec.from_preset(name) for name in PRESETS},
    "weights far apart": Spec.from_preset(weights=UNLIKE),
    "rotors placed": Spec.from_preset(rotors=Rotors(Rotor(0.1), Rotor(0.2)), place_rotors=True),
}
METHODS = ("lqr", "lqr-integral")


def matrices(spec: Spec) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """A, B, Q and R, written down here: x, then the rotors' speeds, then ∫ y where the method integrates."""
    design, weights = place(spec), weights_of(spec)
    rig = design.plant
    A, B, Q = np.array(rig.A), np.array(rig.B), [*weights.states]
    if spec.place_rotors:
        tau = np.array([spec.rotors.pitch.tau, spec.rotors.yaw.tau])
        A = np.block([[A, B], [np.zeros((2, 4)), -np.diag(1 / tau)]])
        B = np.vstack((np.zeros((4, 2)), np.diag(1 / tau)))
        Q += [0.0, 0.0]
    if spec.method == "lqr-integral":
        n = len(A)
        A = np.block([[A, np.zeros((n, 2))], [np.eye(2, n), np.zeros((2, 2))]])
        B = np.vstack((B, np.zeros((2, 2))))
        Q += weights.integrals
    return A, B, np.diag(Q), np.diag(weights.inputs)


def exact(A: np.ndarray, B: np.ndarray, Q: np.ndarray, R: np.ndarray) -> np.ndarray:
    """The stable eigenvalues of the Hamiltonian matrix, by mpmath with 40 digits."""
    H = np.block([[A, -B @ np.linalg.inv(R) @ B.T], [-Q, -A.T]])
    with mp.workdps(40):
        values, _ = mp.eig(mp.matrix(H.tolist()))
    return np.array([complex(v) for v in values if v.real < 0])


def away(own: np.ndarray, other: np.ndarray) -> float:
    """Largest distance of two pole sets, as a share of their size."""
    distances = np.abs(own[:, None] - other)
    rows, columns = linear_sum_assignment(distances)
    return float(np.max(distances[rows, columns] / np.abs(own[rows])))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", CASES)
def test_locus_and_poles_are_those_of_other_riccati_solvers(name, method):
    spec = replace(CASES[name], method=method)
    A, B, Q, R = matrices(spec)
    design = place(spec)
    locus = symmetric_root_locus(design, weights_of(spec))
    assert locus.rho[0] == DEAREST and locus.rho[len(locus.rho) // 2] == 1.0
    np.testing.assert_allclose(np.diff(np.log(locus.rho)), np.log(locus.rho[1] / locus.rho[0]), rtol=1e-9)
    solved = 0
    for k in (0, 40, len(locus.rho) // 2, 130, -1):
        rho = locus.rho[k]
        try:
            _, _, E = control.lqr(A, B, Q, rho * R)
            X = solve_continuous_are(A, B, Q, rho * R)
        except ValueError:  # terms too far apart for floats
            assert away(locus.poles[k], exact(A, B, Q, rho * R)) < 1e-5
            continue
        own = np.linalg.solve(rho * R, B.T @ X)
        for theirs in (E, np.linalg.eigvals(A - B @ own)):
            assert away(locus.poles[k], np.asarray(theirs)) < 1e-5
        solved += 1
    assert solved >= 3
    middle = locus.poles[len(locus.rho) // 2]
    assert away(middle, np.array(optimal_poles(design.numbers, design.actuators))) < 1e-6


def test_the_poles_with_integrators_are_those_of_the_whole_loop():
    spec = Spec.from_preset(method="lqr-integral")
    report = evaluate(spec)
    assert away(np.array(optimal_poles(report.placed)), np.array(report.judged.poles)) < 1e-9


def test_less_weight_on_the_voltages_makes_every_mode_pair_no_slower_in_sum():
    """The product of all |p|² is det of the Hamiltonian matrix, and falls with ρ (spectral factorization)."""
    spec = Spec.from_preset(method="lqr")
    A, B, Q, R = matrices(spec)
    locus = symmetric_root_locus(place(spec), weights_of(spec))
    product = np.prod(np.abs(locus.poles) ** 2, axis=1)
    assert np.all(np.diff(product) > 0)
    for k in (0, 96, -1):
        H = np.block([[A, -B @ np.linalg.inv(locus.rho[k] * R) @ B.T], [-Q, -A.T]])
        assert product[k] == pytest.approx(abs(np.linalg.det(H)), rel=1e-6)


def test_paths_run_on():
    """No path jumps to another: a step is short, but where two poles meet and part at right angles."""
    poles = symmetric_root_locus(place(Spec.from_preset(method="lqr")), UNLIKE).poles
    steps = np.abs(np.diff(poles, axis=0)) / np.abs(poles[1:])
    assert np.max(np.quantile(steps, 0.97, axis=0)) < 0.2


def test_a_method_without_weights_has_no_locus():
    spec = Spec.from_preset()
    with pytest.raises(InvalidInputError, match="no symmetric root locus") as refused:
        symmetric_root_locus(place(spec), weights_of(spec))
    assert refused.value.field == "method" and "lqr" in refused.value.hint


def test_own_poles_are_dealt_to_the_axes_that_they_move():
    """Without cross coupling each axis' poles are those of its own Riccati equation."""
    parameters = {"K_py": 0.0, "K_yp": 0.0}
    spec = Spec.from_preset(method="lqr", parameters=parameters)
    A, B, Q, R = matrices(spec)
    for own, rows, motor in zip(axis_poles(place(spec)), ([0, 2], [1, 3]), ([0], [1]), strict=True):
        part = np.ix_(rows, rows)
        _, _, theirs = control.lqr(A[part], B[np.ix_(rows, motor)], Q[part], R[np.ix_(motor, motor)])
        assert away(np.array(own), np.asarray(theirs)) < 1e-6
