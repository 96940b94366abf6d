"""RGA, Niederlinski index, pairing and diagonal dominance of a matrix of gains, of any size."""

from __future__ import annotations

from itertools import permutations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InvalidInputError
from .signals import Floats

MOST_LOOPS = 7
"""Pairings are tried one by one up to this many loops."""


def relative_gain_array(G: ArrayLike) -> NDArray[Any]:
    """Λ = G ∘ (G⁺)ᵀ (Bristol 1966), same shape as G; any leading dimensions are a batch.

    G⁺ is the inverse of a square matrix and the pseudo-inverse of another (Chang and Yu, Ind. Eng.
    Chem. Res. 29 (1990) 1316). Rows sum to 1 where there are no more outputs than inputs, columns
    where there are no more inputs than outputs.

    Raises:
        InvalidInputError: G is square and singular, or so near it that rounding decides.
    """
    gains = np.asarray(G)
    if gains.shape[-1] != gains.shape[-2]:
        return gains * np.swapaxes(np.linalg.pinv(gains), -1, -2)
    if _singular(gains):
        raise InvalidInputError(
            "the gain matrix is singular, so it has no RGA",
            field="G",
            hint="A row or a column is a sum of the others: leave out an output and an input.",
        )
    return gains * np.swapaxes(np.linalg.inv(gains), -1, -2)


def _singular(gains: NDArray[Any]) -> bool:
    """Whether any matrix of the batch has no full rank, whatever the units of its rows and columns."""
    size = np.abs(gains)
    for axis in (-1, -2, -1, -2):
        largest = np.max(size, axis=axis, keepdims=True)
        if not np.all(largest > 0):
            return True
        gains, size = gains / largest, size / largest
    sizes = np.linalg.svd(gains, compute_uv=False)
    return bool(np.any(sizes[..., -1] <= gains.shape[-1] * np.finfo(float).eps * sizes[..., 0]))


def niederlinski_index(G: ArrayLike, pairing: tuple[int, ...] | None = None) -> float | None:
    """Det G′ / Π g′ᵢᵢ, G′ = G with its columns in the order of the pairing (AIChE J. 17 (1971) 1261).

    Negative: with integral action in every loop, and each loop stable alone, the whole is unstable.

    Args:
        G: steady-state gains, n×n.
        pairing: per output the input that controls it; diagonal by default.

    Returns:
        The index; None where a paired gain is 0.
    """
    ordered = np.asarray(G)[:, list(pairing) if pairing is not None else slice(None)]
    product = float(np.prod(np.diag(ordered)))
    return float(np.linalg.det(ordered)) / product if product else None


def best_pairing(G: ArrayLike) -> tuple[int, ...]:
    """Per output the input that the RGA and the Niederlinski index advise.

    Of the pairings with a positive index (all, if there are none) the one whose relative gains are
    nearest to 1 (smallest RGA number: Skogestad and Postlethwaite, Multivariable Feedback Control,
    2005, section 3.4.1).

    Raises:
        InvalidInputError: G is not square, singular, or has more than `MOST_LOOPS` loops.
    """
    gains = np.asarray(G, dtype=float)
    n = len(gains)
    if gains.shape != (n, n) or n > MOST_LOOPS:
        raise InvalidInputError(f"no pairing for gains of shape {gains.shape}", field="G")
    rga = relative_gain_array(gains)

    def judge(pairing: tuple[int, ...]) -> tuple[bool, float]:
        index = niederlinski_index(gains, pairing)
        wanted = np.eye(n)[list(pairing)]
        return not (index is not None and index > 0), float(np.sum(np.abs(rga - wanted)))

    return min(permutations(range(n)), key=judge)


def diagonal_dominance(G: ArrayLike) -> tuple[Floats, Floats]:
    """(Σ_{j≠i} |g_ij| / |g_ii| by rows, Σ_{i≠j} |g_ij| / |g_jj| by columns), each (..., n).

    Below 1 in all rows, or in all columns, G is diagonally dominant (Rosenbrock, Computer-Aided
    Control System Design, 1974). Infinite where a diagonal entry is 0.
    """
    size = np.abs(np.asarray(G))
    diagonal = np.diagonal(size, axis1=-2, axis2=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        rows = (size.sum(axis=-1) - diagonal) / diagonal
        columns = (size.sum(axis=-2) - diagonal) / diagonal
    return rows, columns
