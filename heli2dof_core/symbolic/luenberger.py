"""Controllability indices and Luenberger's controllable canonical form, symbolically.

Source: D. G. Luenberger, "Canonical forms for linear multivariable systems", IEEE Trans. Autom.
Control 12 (1967) 290–293. All matrices are SymPy `DomainMatrix` over one field of fractions: their
entries are always in lowest terms, so that zero is recognised and no `simplify` is needed.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy.polys.matrices import DomainMatrix

from ..errors import UncontrollableError


@dataclass(frozen=True)
class CanonicalForm:
    """x̄ = Tx brings (A, B) to block companion form.

    Attributes:
        indices: controllability indices σ₁ … σ_p, one per input.
        T: n×n transformation, its rows q_i, q_i A, …, q_i A^(σ_i − 1).
        A_bar, B_bar: T A T⁻¹ and T B.
        Q: p×p, the nonzero rows of B̄.
        ends: the row of each block that carries the input, so Q = B̄[ends].
    """

    indices: tuple[int, ...]
    T: DomainMatrix
    A_bar: DomainMatrix
    B_bar: DomainMatrix
    Q: DomainMatrix
    ends: tuple[int, ...]


def controllability_matrix(A: DomainMatrix, B: DomainMatrix) -> DomainMatrix:
    """[B, AB, …, A^(n−1) B], n × n·p."""
    blocks, power = [B], B
    for _ in range(A.shape[0] - 1):
        power = A.matmul(power)
        blocks.append(power)
    return blocks[0].hstack(*blocks[1:])


def controllability_indices(A: DomainMatrix, B: DomainMatrix) -> tuple[int, ...]:
    """Scans b₁ … b_p, Ab₁ … left to right and keeps each column independent of those kept.

    Raises:
        UncontrollableError: fewer than n columns are independent.
    """
    n, p = B.shape
    _, pivots = controllability_matrix(A, B).rref()
    if len(pivots) < n:
        raise UncontrollableError("the pair (A, B) is not controllable", field="parameters")
    return tuple(sum(1 for column in pivots if column % p == i) for i in range(p))


def leading_rows(A: DomainMatrix, B: DomainMatrix, indices: tuple[int, ...]) -> list[DomainMatrix]:
    """q_i = row σ₁ + … + σ_i of [b₁ … A^(σ₁−1) b₁ | b₂ …]⁻¹, each 1×n."""
    columns = []
    for i, index in enumerate(indices):
        column = _column(B, i)
        for _ in range(index):
            columns.append(column)
            column = A.matmul(column)
    inverse = columns[0].hstack(*columns[1:]).inv()
    last = [sum(indices[: i + 1]) - 1 for i in range(len(indices))]
    return [_row(inverse, row) for row in last]


def canonical_form(
    A: DomainMatrix, B: DomainMatrix, indices: tuple[int, ...], rows: list[DomainMatrix]
) -> CanonicalForm:
    """The form that the leading rows q_i span (Luenberger's, shifted, or the outputs' own)."""
    basis = []
    for row, index in zip(rows, indices, strict=True):
        current = row
        for _ in range(index):
            basis.append(current)
            current = current.matmul(A)
    T = basis[0].vstack(*basis[1:])
    ends = tuple(sum(indices[: i + 1]) - 1 for i in range(len(indices)))
    B_bar = T.matmul(B)
    Q = _row(B_bar, ends[0]).vstack(*[_row(B_bar, end) for end in ends[1:]])
    return CanonicalForm(indices, T, T.matmul(A).matmul(T.inv()), B_bar, Q, ends)


def _row(matrix: DomainMatrix, index: int) -> DomainMatrix:
    return matrix.extract([index], list(range(matrix.shape[1])))


def _column(matrix: DomainMatrix, index: int) -> DomainMatrix:
    return matrix.extract(list(range(matrix.shape[0])), [index])
