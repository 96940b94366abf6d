"""Eigenvalues, eigenvectors and frequency responses of small real matrices."""

from __future__ import annotations

from functools import cache
from math import isfinite
from typing import Any

import numpy as np

from .signals import Complexes, Floats


@cache
def _geev() -> Any:
    """LAPACK's geev; with SciPy comes half of what importing the core would take."""
    from scipy.linalg import get_lapack_funcs

    return get_lapack_funcs("geev")


@cache
def _gebal() -> Any:
    from scipy.linalg import get_lapack_funcs

    return get_lapack_funcs("gebal")


def eigenvalues(A: Floats) -> list[complex]:
    """Eigenvalues of a real square matrix, by LAPACK's geev as in `numpy.linalg.eigvals`.

    On matrices of six rows, of which every update has one, NumPy takes longer around it than it takes itself.

    Raises:
        numpy.linalg.LinAlgError: the iteration does not converge, or an entry is not finite.
    """
    return list(map(complex, *_solved(A, vectors=False)[:2]))


def eigenvectors(A: Floats) -> Floats | Complexes:
    """Eigenvectors of length 1 of a real square matrix, as columns; errors as `eigenvalues`."""
    return spectrum(A)[1]


def balanced(A: Floats) -> tuple[Floats, Floats]:
    """D⁻¹ A D with rows and columns of like size, and D's diagonal, powers of 2 (LAPACK's gebal)."""
    matrix, _, _, units, _ = _gebal()(A, scale=1)
    return matrix, units


def spectrum(A: Floats) -> tuple[list[complex], Floats | Complexes]:
    """Eigenvalues, and the eigenvectors of length 1 as columns; errors as `eigenvalues`."""
    real, imaginary, vectors = _solved(A, vectors=True)
    values = list(map(complex, real, imaginary))
    if not any(imaginary):
        return values, vectors
    columns = vectors.astype(np.complex128)
    for i, part in enumerate(imaginary):
        if part > 0:  # a conjugate pair is kept as its real and its imaginary part
            columns[:, i] = vectors[:, i] + 1j * vectors[:, i + 1]
            columns[:, i + 1] = columns[:, i].conj()
    return values, columns


def resolvent(A: Floats, B: Floats, frequencies: Floats) -> Complexes:
    """(jωI − A)⁻¹ B at `frequencies` ω (rad/s), shape (n, rows of A, columns of B).

    At an eigenvalue jω of A it does not exist; there stands the value a few roundings beside it, which is very
    large.
    """
    identity = np.eye(len(A))
    try:
        response = np.linalg.solve(1j * frequencies[:, None, None] * identity - A, B)
    except np.linalg.LinAlgError:
        beside = frequencies * (1 + _BESIDE) + _BESIDE * np.linalg.norm(A)
        response = np.linalg.solve(1j * beside[:, None, None] * identity - A, B)
    return response.astype(np.complex128, copy=False)


_BESIDE = 16 * np.finfo(float).eps


def _solved(A: Floats, *, vectors: bool) -> tuple[list[float], list[float], Floats]:
    # the transpose has the same eigenvalues, and its columns, which LAPACK wants, are A's rows as they are
    real, imaginary, _, right, info = _geev()(A if vectors else A.T, compute_vl=False, compute_vr=vectors)
    if info or not isfinite(np.vdot(A, A)):  # geev itself gives some answer to NaN
        raise np.linalg.LinAlgError(f"the eigenvalues of a matrix of {len(A)} rows were not found")
    return real.tolist(), imaginary.tolist(), right


def courses(stack: Complexes) -> Complexes:
    """The spectra of matrices that change little by little, in an order in which each column follows one eigenvalue.

    The last row keeps its order. Neighbours are matched by the least sum of distances: the least largest one would
    leave all but the fastest pole at will.

    Args:
        stack: (steps, n), each row a spectrum in any order.
    """
    from scipy.optimize import linear_sum_assignment

    ordered = stack.copy()
    for k in range(len(ordered) - 1, 0, -1):
        _, nearest = linear_sum_assignment(np.abs(ordered[k][:, None] - ordered[k - 1]))
        ordered[k - 1] = ordered[k - 1][nearest]
    return ordered
