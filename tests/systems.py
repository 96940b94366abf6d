"""Seeded random systems for the laws of placement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eig

EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class System:
    """A controllable pair and desired poles; `indices` where the construction knows them, sorted."""

    A: np.ndarray
    B: np.ndarray
    poles: np.ndarray
    indices: tuple[int, ...] | None


def random_system(rng: np.random.Generator) -> System:
    """3 to 8 states, 1 to 4 inputs; every second one with prescribed controllability indices."""
    n = int(rng.integers(3, 9))
    p = int(rng.integers(1, min(4, n) + 1))
    if rng.random() < 0.5:
        return System(rng.normal(size=(n, n)), rng.normal(size=(n, p)), random_poles(rng, n), None)
    cuts = np.sort(rng.choice(np.arange(1, n), size=p - 1, replace=False))
    sigma = np.diff([0, *cuts, n])
    A, B = brunovsky(sigma)
    basis = np.linalg.qr(rng.normal(size=(n, n)))[0]
    mixing = np.linalg.qr(rng.normal(size=(p, p)))[0] + 0.3 * np.eye(p)
    A = basis.T @ (A + B @ rng.normal(size=(p, n))) @ basis
    return System(A, basis.T @ B @ mixing, random_poles(rng, n), tuple(sorted(int(s) for s in sigma)))


def brunovsky(sigma: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Chains of integrators of lengths σ_i, the last of each driven by input i."""
    n, p = int(np.sum(sigma)), len(sigma)
    A, B, row = np.zeros((n, n)), np.zeros((n, p)), 0
    for i, length in enumerate(sigma):
        for k in range(row, row + length - 1):
            A[k, k + 1] = 1.0
        row += length
        B[row - 1, i] = 1.0
    return A, B


def random_poles(rng: np.random.Generator, n: int) -> np.ndarray:
    """n poles in the left half plane, closed under conjugation, pairs and real ones mixed."""
    poles: list[complex] = []
    while len(poles) < n:
        re = -rng.uniform(0.5, 5)
        if n - len(poles) >= 2 and rng.random() < 0.6:
            im = rng.uniform(0.3, 5)
            poles += [complex(re, im), complex(re, -im)]
        else:
            poles.append(complex(re))
    return np.array(poles)


def eigenvalue_condition(closed: np.ndarray) -> float:
    """Largest condition number of an eigenvalue, 1/|wᴴv| (Wilkinson)."""
    _, left, right = eig(closed, left=True)
    return float(1 / np.min(np.abs(np.sum(left.conj() * right, axis=0))))


def rounding(system: System, K: np.ndarray) -> float:
    """Largest move of a pole that rounding A − BK once in its last digit explains."""
    size = np.linalg.norm(system.A) + np.linalg.norm(system.B) * np.linalg.norm(K)
    return EPS * eigenvalue_condition(system.A - system.B @ K) * float(size)
