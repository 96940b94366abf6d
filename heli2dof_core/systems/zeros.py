"""Invariant zeros of any system: where the Rosenbrock matrix loses rank.

Source: A. Emami-Naeini and P. Van Dooren, "Computation of zeros of linear multivariable systems", Automatica 18
(1982) 415–430: orthogonal steps take away what belongs to zeros at infinity, first of the system, then of its dual;
the zeros are eigenvalues of what is left.
"""

from __future__ import annotations

import numpy as np

from ..controllability import in_own_units
from ..signals import Complexes, Floats
from .model import System

ROUNDING = 100.0
"""So many roundings of the largest entry count as 0."""


def invariant_zeros(system: System) -> Complexes:
    """Zeros in 1/s, by real part; those of a controllable and observable system are its transmission zeros.

    A system whose Rosenbrock matrix has less than full rank everywhere has none that are told here: there every s is
    one.
    """
    A, B, units, speed = in_own_units(system.A, system.B)
    C, D = system.C * units, system.D.copy()
    inputs = np.maximum(np.max(np.abs(np.vstack([B, D])), axis=0), np.finfo(float).tiny)
    B, D = B / inputs, D / inputs
    outputs = np.maximum(np.max(np.abs(np.hstack([C, D])), axis=1), np.finfo(float).tiny)[:, None]
    C, D = C / outputs, D / outputs
    own = np.block([[A, B], [C, D]])
    small = ROUNDING * np.finfo(float).eps * max(own.shape) * float(np.linalg.norm(own))
    A, B, C, D = _reduced(A, B, C, D, small)
    dual = _reduced(A.T, C.T, B.T, D.T, small)
    A, C, B, D = (matrix.T for matrix in dual)
    return _finite(A, B, C, D) * speed


def _finite(A: Floats, B: Floats, C: Floats, D: Floats) -> Complexes:
    """Eigenvalues of A − B D⁻¹ C, D square and regular; as a pencil, without D⁻¹."""
    from scipy.linalg import eigvals

    n, p = len(A), len(D)
    if not n:
        return np.zeros(0, dtype=np.complex128)
    W = np.linalg.qr(np.hstack([C, D]).T, mode="complete")[0][:, p:]  # the null space of [C D]
    left, right = np.hstack([A, B]) @ W, W[:n]
    values = np.asarray(eigvals(left, right), dtype=np.complex128)
    values = values[np.isfinite(values)]
    return values[np.lexsort((values.imag, values.real))]


def _reduced(
    A: Floats, B: Floats, C: Floats, D: Floats, small: float
) -> tuple[Floats, Floats, Floats, Floats]:
    """A system with the same finite zeros, whose D has full row rank."""
    while True:
        left, sizes, _ = np.linalg.svd(D) if D.size else (np.eye(len(D)), np.zeros(0), None)
        rank = int(np.sum(sizes > small))
        C, D = left.T @ C, left.T @ D
        if rank == len(C) or not len(A):
            return A, B, C[:rank], D[:rank]
        top, rest = (C[:rank], D[:rank]), C[rank:]
        _, sizes, rows = np.linalg.svd(rest)
        taken = int(np.sum(sizes > small))
        if not taken:
            return A, B, *top
        basis = np.vstack([rows[taken:], rows[:taken]]).T  # last come the states that `rest` tells
        A, B, C = basis.T @ A @ basis, basis.T @ B, top[0] @ basis
        kept = len(A) - taken
        C = np.vstack([A[kept:, :kept], C[:, :kept]])
        D = np.vstack([B[kept:], top[1]])
        A, B = A[:kept, :kept], B[:kept]
