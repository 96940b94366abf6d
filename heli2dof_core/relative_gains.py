"""RGA, Niederlinski index, pairing and diagonal dominance of a matrix of gains, of any size."""

from __future__ import annotations

from itertools import permutations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InvalidInputError
from .rank import equilibrated, numeric_rank, rank_tolerance
from .signals import Floats

MOST_LOOPS = 7
"""Pairings are tried one by one up to this many loops."""


def relative_gain_array(G: ArrayLike) -> NDArray[Any]:
    """Λ = G ∘ (G⁺)ᵀ (Bristol 1966), same shape as G; any leading dimensions are a batch.

    G⁺ is the inverse of a square matrix and the pseudo-inverse of another (Chang and Yu, Ind. Eng.
    Chem. Res. 29 (1990) 1316). Rows sum to 1 where there are no more outputs than inputs, columns
    where there are no more inputs than outputs.

    Rank is decided in units in which rows and columns are of one size (`rank`), so that a matrix which is
    singular but for rounding counts as singular.

    Raises:
        InvalidInputError: G is square and singular, or no matrix.
    """
    gains = np.asarray(G)
    if gains.ndim < 2:
        raise InvalidInputError(f"gains of shape {gains.shape} are no matrix", field="G")
    rows, columns = gains.shape[-2:]
    full = numeric_rank(gains) == min(rows, columns)
    if rows == columns:
        if not np.all(full):
            raise InvalidInputError(
                "the gain matrix is singular, so it has no RGA",
                field="G",
                hint="Leave out a row or a column: one of them is a combination of the others.",
            )
        scaled = equilibrated(gains)  # the RGA does not depend on units
        return scaled * np.swapaxes(np.linalg.inv(scaled), -1, -2)
    inverse = np.linalg.pinv(gains, rcond=rank_tolerance(rows, columns))
    if np.any(full):  # the units of the shorter side do not count either
        axis = -2 if rows > columns else -1
        size = np.max(np.abs(gains), axis=axis, keepdims=True)
        units = np.where(size > 0, size, 1.0)
        right = np.linalg.pinv(gains / units, rcond=0.0) / np.swapaxes(units, -1, -2)
        inverse = np.where(full[..., None, None], right, inverse)
    return gains * np.swapaxes(inverse, -1, -2)


def niederlinski_index(G: ArrayLike, pairing: tuple[int, ...] | None = None) -> float | None:
    """Det G′ / Π g′ᵢᵢ, G′ = G with its columns in the order of the pairing (AIChE J. 17 (1971) 1261).

    Negative: with integral action in every loop, and each loop stable alone, the whole is unstable.

    Args:
        G: steady-state gains, n×n.
        pairing: per output the input that controls it; diagonal by default.

    Returns:
        The index, 0 where G is singular; None where a paired gain is 0.
    """
    gains = equilibrated(np.asarray(G))  # nor does the index depend on units
    ordered = gains[:, list(pairing) if pairing is not None else slice(None)]
    product = float(np.prod(np.diag(ordered)))
    if not product:
        return None
    return float(np.linalg.det(ordered)) / product if numeric_rank(ordered) == len(ordered) else 0.0


def best_pairing(G: ArrayLike) -> tuple[int, ...]:
    """Per output the input that the RGA and the Niederlinski index advise.

    Of the pairings with a positive index (all, if there are none) the one whose relative gains are
    nearest to 1 (smallest RGA number: Skogestad and Postlethwaite, Multivariable Feedback Control,
    2005, section 3.4.1).

    Raises:
        InvalidInputError: G is not square, singular, or has more than `MOST_LOOPS` loops.
    """
    gains = np.asarray(G, dtype=float)
    n = gains.shape[0] if gains.ndim else 0
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
