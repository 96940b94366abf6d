"""The kernel's eigenvalues against LAPACK's, by what backward stability promises, and by laws."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from heli2dof_core.engine import engine
from tests.core.test_nonlinear_response import random_loops

EPS = np.finfo(float).eps


def eigenvalues(A: np.ndarray) -> np.ndarray:
    n = len(A)
    real, imaginary = np.empty(n), np.empty(n)
    assert engine().eigenvalues(np.ascontiguousarray(A, dtype=float).copy(), real, imaginary, np.empty(n))
    return real + 1j * imaginary


def apart(found: np.ndarray, known: np.ndarray) -> float:
    away = np.abs(found[:, None] - known)
    return float(np.max(away[linear_sum_assignment(away)]))


def backward_error(A: np.ndarray, values: np.ndarray) -> float:
    """Largest σ_min(A − λI) in roundings of ‖A‖: how far the nearest matrix is that has λ as an eigenvalue."""
    shifted = A - values[:, None, None] * np.eye(len(A))
    return float(np.max(np.linalg.svd(shifted, compute_uv=False)[:, -1])) / (EPS * np.linalg.norm(A, 2))


def random_matrices(count: int, seed: int):
    rng = np.random.default_rng(seed)
    for k in range(count):
        n = int(rng.integers(1, 15))
        A = rng.normal(size=(n, n))
        if k % 3 == 0:
            A *= 10.0 ** rng.uniform(-3, 3, size=(n, n))
        if k % 7 == 0:
            A = np.triu(A, -1)
        yield A


def test_ten_thousand_random_matrices_are_as_near_as_their_condition_allows():
    ratios, backward, lapacks = [], [], []
    for A in random_matrices(10_000, 0):
        found, (known, vectors) = eigenvalues(A), np.linalg.eig(A)
        bound = EPS * np.linalg.norm(A) * min(np.linalg.cond(vectors), 1 / EPS)
        ratios.append(apart(found, known) / bound if bound else 0.0)
        backward.append(backward_error(A, found) if A.any() else 0.0)
        lapacks.append(backward_error(A, known) if A.any() else 0.0)
        assert np.all(np.diff(np.flatnonzero(found.imag > 0)) > 0)
        conjugate = found[np.flatnonzero(found.imag > 0) + 1].conj()
        np.testing.assert_array_equal(conjugate, found[found.imag > 0])
    assert max(ratios) < 20
    assert max(backward) < 3 * max(lapacks)  # both balance, which costs badly scaled ones a little
    assert np.median(backward) < 1.2 * np.median(lapacks)


def test_loops_of_random_designs_have_lapacks_poles():
    ratios = []
    for loop, _ in random_loops(200, 18):
        known, vectors = np.linalg.eig(loop.A)
        bound = EPS * np.linalg.norm(loop.A) * np.linalg.cond(vectors)
        ratios.append(apart(eigenvalues(loop.A), known) / bound)
    assert max(ratios) < 10


@pytest.mark.parametrize("n", [2, 3, 4, 6])
def test_defective_ones_are_eigenvalues_of_a_matrix_within_rounding(n):
    """One Jordan block, turned: its eigenvalues scatter by the n-th root of a rounding, whoever computes them."""
    turned, _ = np.linalg.qr(np.random.default_rng(n).normal(size=(n, n)))
    A = turned @ (np.diag(np.ones(n - 1), 1) - 3 * np.eye(n)) @ turned.T
    found = eigenvalues(A)
    assert backward_error(A, found) < 20
    assert np.max(np.abs(found + 3)) < 3 * (50 * EPS) ** (1 / n)


@pytest.mark.parametrize(
    ("A", "known"),
    [
        (np.zeros((3, 3)), [0, 0, 0]),
        (np.diag([3.0, -1.0, 2.0]), [3, -1, 2]),
        (np.roll(np.eye(5), 1, 0), np.exp(2j * np.pi * np.arange(5) / 5)),
        (np.kron(np.eye(3), [[0, 1], [-1, 0]]), [1j, -1j] * 3),
        ([[1, 1e200], [1e-200, 2]], [(3 - 5**0.5) / 2, (3 + 5**0.5) / 2]),
        ([[0, 1e150], [1e150, 0]], [1e150, -1e150]),
        (np.diag(np.ones(3), 1), [0] * 4),
    ],
    ids=["nothing", "diagonal", "a shift in a ring", "oscillators", "units far apart", "large", "nilpotent"],
)
def test_known_ones(A, known):
    A = np.array(A, dtype=float)
    assert apart(eigenvalues(A), np.array(known)) <= 1e-14 * max(1.0, float(np.max(np.abs(known))))


def test_what_is_no_number_has_none():
    A, room = np.full((3, 3), np.nan), np.empty(3)
    assert not engine().eigenvalues(A, room, room.copy(), room.copy())
