"""Linear quadratic regulators of one system for many weights at once, for searches that try thousands."""

from __future__ import annotations

from math import nan

import numpy as np

from ..controllability import in_own_units
from ..signals import Complexes, Floats
from .riccati import NEAR_AXIS

ACCURACY = 1e-10
"""Share of K by which a last step of Newton's method may still change it; its own error is about the square."""


def regulators(A: Floats, B: Floats, states: Floats, inputs: Floats) -> Floats:
    """K of u = −Kx for each row of weights, (n, p, k): what `lqr.regulate` gives, to 1e-9 of its largest entry.

    The columns of [V₁; V₂] are the eigenvectors of the Hamiltonian matrix that decay; X = V₂ V₁⁻¹ solves the Riccati
    equation (MacFarlane 1963; Potter, SIAM J. Appl. Math. 14 (1966) 496–501). One step of Newton's method (Kleinman,
    IEEE TAC 13 (1968) 114–115) takes away what multiple eigenvalues cost X in digits: its Lyapunov equation is
    diagonal in the same vectors, and the size of the step tells what the digits were. Where a step is large, an
    eigenvalue lies near the imaginary axis, or a weight is out of range, K is NaN: `regulate` decides there.

    Args:
        A: k×k.
        B: k×p.
        states: diagonals of Q, (n, k), ≥ 0.
        inputs: diagonals of R, (n, p), > 0.
    """
    count, k = states.shape
    found = np.full((count, B.shape[1], k), nan)
    # R = I by the inputs' units E; those of the states and of time are the same for all E
    own, driven, units, _ = in_own_units(A, B)
    with np.errstate(all="ignore"):  # what overflows is not finite, and left out
        E = 1.0 / np.sqrt(inputs)
        Q, B_own = states * units**2, driven * E[:, np.newaxis]
        matrices = _hamiltonians(own, B_own, Q)
        good = np.flatnonzero(np.all(np.isfinite(matrices), axis=(1, 2)) & np.all(states >= 0.0, axis=1))
        if not len(good):
            return found
        try:
            vectors, values = _decaying(matrices[good], k)
        except np.linalg.LinAlgError:  # of one, eigenvalues were not found, which NumPy does not tell
            return found
        apart = np.max(values.real, axis=1) < -NEAR_AXIS * np.max(np.abs(values), axis=1)
        good, vectors, values = good[apart], vectors[apart], values[apart]
        B_own = B_own[good]
        X, step = _solved(own, B_own, Q[good], (vectors, values))
        K, last = (np.swapaxes(B_own, 1, 2) @ part for part in (X, step))
        size, change = (np.max(np.abs(part), axis=(1, 2)) for part in (K, last))
        sure = change <= ACCURACY * size  # false where anything is NaN
        found[good[sure]] = (E[good, :, np.newaxis] * K / units)[sure]
    return found


def _hamiltonians(A: Floats, B: Floats, Q: Floats) -> Floats:
    """[[A, −BBᵀ], [−Q, −Aᵀ]] of each, (n, 2k, 2k)."""
    count, k = Q.shape
    whole = np.zeros((count, 2 * k, 2 * k))
    whole[:, :k, :k], whole[:, k:, k:] = A, -A.T
    whole[:, :k, k:] = -B @ np.swapaxes(B, 1, 2)
    every = np.arange(k)
    whole[:, k + every, every] = -Q
    return whole


def _decaying(matrices: Floats, k: int) -> tuple[Complexes, Complexes]:
    """The k leftmost eigenvalues' vectors, (n, 2k, k), and these, (n, k)."""
    values, vectors = np.linalg.eig(matrices)
    values, vectors = values.astype(np.complex128), vectors.astype(np.complex128)
    chosen = np.argsort(values.real, axis=1, kind="stable")[:, :k]
    values = np.take_along_axis(values, chosen, axis=1)
    vectors = np.take_along_axis(vectors, chosen[:, np.newaxis], axis=2)
    return vectors, values


def _solved(A: Floats, B: Floats, Q: Floats, modes: tuple[Complexes, Complexes]) -> tuple[Floats, Floats]:
    """X of each after one step of Newton's method, and that step, (n, k, k); NaN where V₁ is singular."""
    k, (vectors, values) = len(A), modes
    V, W = vectors[:, :k].copy(), vectors[:, k:]
    singular = np.linalg.det(V) == 0.0
    V[singular] = np.eye(k)
    inverse = np.linalg.inv(V)
    X = (W @ inverse).real
    X = (X + np.swapaxes(X, 1, 2)) / 2.0
    half = X @ A
    gain = np.swapaxes(B, 1, 2) @ X
    residual = half + np.swapaxes(half, 1, 2) - np.swapaxes(gain, 1, 2) @ gain
    every = np.arange(k)
    residual[:, every, every] += Q
    # (A − BBᵀX)ᵀ S + S (A − BBᵀX) = −residual, in the coordinates of V
    modal = np.swapaxes(V, 1, 2).conj() @ residual @ V
    modal /= -(values.conj()[:, :, np.newaxis] + values[:, np.newaxis])
    step = (np.swapaxes(inverse, 1, 2).conj() @ modal @ inverse).real
    step[singular] = nan
    return X + step, step
