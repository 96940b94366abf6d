"""Controllability indices of a numeric pair (A, B), with an honest rank decision."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .errors import UncontrollableError
from .frozen import Frozen
from .signals import Floats

RANK_TOLERANCE = 1e-10
"""A column counts as dependent when it adds no more than this to the smallest singular value."""


@dataclass(frozen=True)
class Scan:
    """Result of the scan for independent columns.

    Attributes:
        indices: controllability indices σ₁ … σ_p, one per input.
        weakest: smallest singular value that a kept column left, between 0 (dependent) and 1.
    """

    indices: tuple[int, ...]
    weakest: float


@dataclass(frozen=True)
class Reach(Frozen):
    """How far a scan came.

    Attributes:
        indices: columns kept, per input.
        weakest: as of `Scan`.
        basis: orthonormal columns that span what the inputs reach, n×r, in the states' own units.
        units: of the states (`in_own_units`).
    """

    indices: tuple[int, ...]
    weakest: float
    basis: Floats
    units: Floats


def scan(A: Floats, B: Floats) -> Scan:
    """`reach` of a controllable pair.

    Raises:
        UncontrollableError: fewer than n independent columns exist.
    """
    (n, p), found = B.shape, reach(A, B)
    if found.basis.shape[1] < n:
        who = "the inputs reach" if p > 1 else "the input reaches"
        raise UncontrollableError(
            f"{who} only {found.basis.shape[1]} of the {n} states",
            field="B",
            hint="Add an input, or take the states that no input reaches out of the model.",
        )
    return Scan(found.indices, found.weakest)


def reach(A: Floats, B: Floats) -> Reach:
    """Scans b₁ … b_p, Ab₁ … left to right; σ_i is the number of columns kept of input i.

    States and columns are scaled first, so that units do not decide (`in_own_units`). In place of A^k b_i
    stands A times what A^(k−1) b_i added to the columns before it: both span the same space, but
    powers of A all turn towards its fastest mode, and rank could not be told from rounding. A column
    is kept if it leaves the smallest singular value above `RANK_TOLERANCE`, and above what rounding
    could have made of nothing.
    Source: Luenberger, IEEE TAC 12:290–293, 1967.

    Args:
        A: n×n.
        B: n×p.
    """
    n, p = B.shape
    A, B, units, _ = in_own_units(A, B)
    lengths = np.linalg.norm(B, axis=0)
    B = B / np.where(lengths > 0, lengths, 1.0)
    rounding = 100 * n * np.finfo(float).eps
    kept = np.empty((n, 0))
    chains: list[tuple[Floats, float] | None] = [(column, 0.0) for column in B.T]
    indices, weakest = [0] * p, 1.0
    while kept.shape[1] < n and any(chain is not None for chain in chains):
        for i, chain in enumerate(chains):
            if chain is None or kept.shape[1] == n:
                continue
            column, error = chain
            length = float(np.linalg.norm(column))
            smallest = 0.0
            if length > error:
                unit = column / length
                smallest = float(np.linalg.svd(np.column_stack([kept, unit]), compute_uv=False)[-1])
            if smallest <= RANK_TOLERANCE or smallest * length <= error:
                chains[i] = None  # all later powers of this input depend too
                continue
            added = _orthogonal(column / length, kept)
            kept = np.column_stack([kept, added])
            chains[i] = A @ added, rounding * float(np.linalg.norm(np.abs(A) @ np.abs(added)))
            indices[i] += 1
            weakest = min(weakest, smallest)
    return Reach(tuple(indices), weakest, kept, units)


def controllability_indices(A: Floats, B: Floats) -> tuple[int, ...]:
    """σ₁ … σ_p of (A, B), see `scan`."""
    return scan(A, B).indices


def controllability_matrix(A: Floats, B: Floats) -> Floats:
    """[B, AB, …, A^(n−1) B], n×(n p); B may be one column, of shape (n,)."""
    blocks = [B]
    for _ in range(len(A) - 1):
        blocks.append(A @ blocks[-1])
    return np.column_stack(blocks)


def in_own_units(A: Floats, B: Floats) -> tuple[Floats, Floats, Floats, float]:
    """(D⁻¹AD/ω, D⁻¹B/ω, D's diagonal, ω): the pair in units of its own, in which rank, if exact, stays as it is.

    Time is in units of A's size, 1/ω, and each state in units of what the inputs make of it; ω and D are powers of 2,
    so that nothing is rounded. With |A| / ρ(|A|) in place of A the result is the same in all units of states, inputs
    and time. Balancing is not: it takes an entry of 1e-200 as seriously as one of 1. A gain k for the result is
    k D⁻¹ for the pair.
    """
    size = np.abs(A)
    speed = float(np.exp2(np.rint(np.log2(float(np.max(np.abs(np.linalg.eigvals(size)))) or 1.0))))
    reached = np.abs(B) / np.maximum(np.max(np.abs(B), axis=0), np.finfo(float).tiny)
    largest = power = np.max(reached, axis=1)
    for _ in range(len(A) - 1):
        power = size @ power / speed
        largest = np.maximum(largest, power)
    units = np.exp2(np.rint(np.log2(np.where(largest > 0, largest, 1.0))))
    return A / speed * units / units[:, None], B / units[:, None] / speed, units, speed


def _orthogonal(column: Floats, basis: Floats) -> Floats:
    """The unit vector that `column` adds to the orthonormal columns of `basis`."""
    for _ in range(2):  # the second time takes away what rounding left of the first
        column = column - basis @ (basis.T @ column)
    return column / np.linalg.norm(column)
