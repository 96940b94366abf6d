"""The rank of a matrix of floats, decided after scaling: units, of rows or of columns, must not decide."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

MARGIN = 10
"""A singular value counts as 0 below this many times what rounding every entry once can make of nothing."""
SWEEPS = 60
"""Most sweeps of the scaling; a badly scaled matrix of few rows takes a dozen."""


def rank_tolerance(rows: int, columns: int) -> float:
    """Share of the largest singular value below which one is rounding, in a scaled matrix."""
    return MARGIN * max(rows, columns) * float(np.finfo(np.float64).eps)


def equilibrated(matrix: NDArray[Any]) -> NDArray[Any]:
    """The same rank, in units in which rows, and columns, are of one size; leading dimensions are a batch.

    Rows and columns of absolute values are made to sum to 1 in turn, which for regular matrices tends to the one
    scaling that does both, whatever the units were (Sinkhorn and Knopp, Pacific J. Math. 21 (1967) 343–348). Largest
    entries of 1 would not do: [[1, 1, 1], [1, ε, 0], [1, 0, ε]] has them, and is as regular as any. The factors are
    powers of 2, so that nothing is rounded.
    """
    size = np.abs(np.asarray(matrix)).astype(np.float64)
    shifts = [np.zeros_like(size[..., :1]), np.zeros_like(size[..., :1, :])]
    with np.errstate(over="ignore", under="ignore"):
        for _ in range(SWEEPS):
            largest = 0.0
            for side, axis in enumerate((-1, -2)):
                total = np.sum(size, axis=axis, keepdims=True)
                inverse = -np.log2(np.where(total > 0, total, 1.0))
                size = size * np.exp2(inverse)
                shifts[side] += inverse
                largest = float(np.max(np.abs(inverse), initial=0.0))
            if largest < 0.01:
                break
        rows, columns = (np.rint(shift) for shift in shifts)
        half = np.floor(rows / 2)  # in two steps, as one factor alone may be out of a float's range
        return matrix * np.exp2(half) * np.exp2(columns) * np.exp2(rows - half)


def numeric_rank(matrix: NDArray[Any]) -> NDArray[np.int64]:
    """Rank of one matrix, or of each in a batch: an array of the leading dimensions."""
    scaled = equilibrated(matrix)
    sizes = np.linalg.svd(scaled, compute_uv=False)
    tolerance = rank_tolerance(*scaled.shape[-2:])
    return np.sum(sizes > tolerance * np.max(sizes, axis=-1, keepdims=True, initial=0.0), axis=-1)
