"""Full-rank state feedback through Luenberger's controllable canonical form, over any field.

All matrices are SymPy `DomainMatrix` over one field: the rational functions for symbols (see
`full_rank`), the rational numbers for numbers (see `heli2dof_core.placement.full_rank`). Their entries
are always in lowest terms, so that zero is recognised and no `simplify` is needed.

Source: D. G. Luenberger, "Canonical forms for linear multivariable systems", IEEE Trans. Autom.
Control 12 (1967) 290–293; R. V. Patel and N. Munro, Multivariable System Theory and Design, 1982.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal

# SymPy first, as in all modules: who asks for a part of a package that another thread is importing does not wait for
# it, and its circular imports break for both.
import sympy  # noqa: F401
from sympy.polys.matrices import DomainMatrix

from ..errors import UncontrollableError

Triangle = Literal["none", "lower", "upper"]
"""Which off-diagonal blocks of the canonical closed loop keep the plant's own entries."""


@dataclass(frozen=True)
class CanonicalForm:
    """x̄ = Tx brings (A, B) to block companion form.

    Attributes:
        indices: controllability indices σ₁ … σ_p, one per input.
        T: n×n transformation, its rows q_i, q_i A, …, q_i A^(σ_i − 1).
        last: p×n, the rows q_i A^σ_i; times T⁻¹ they are the rows of Ā that carry the inputs.
        A, B_bar: the plant's A, and T B.
        Q: p×p, the nonzero rows of B̄.
        ends: the row of each block that carries the input, so Q = B̄[ends].
    """

    indices: tuple[int, ...]
    T: DomainMatrix
    last: DomainMatrix
    A: DomainMatrix
    B_bar: DomainMatrix
    Q: DomainMatrix
    ends: tuple[int, ...]

    @cached_property
    def T_inverse(self) -> DomainMatrix:
        """T⁻¹."""
        return self.T.inv()

    @cached_property
    def A_bar(self) -> DomainMatrix:
        """Ā = T A T⁻¹."""
        return self.T.matmul(self.A).matmul(self.T_inverse)


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
    kept: list[tuple[int, list[Any]]] = []  # what each column added, with the row that it is reduced to 1 in
    columns = {i: _column(B, i) for i in range(p)}
    indices = [0] * p
    while columns and len(kept) < n:
        for i, column in list(columns.items()):
            added = column.to_list_flat()
            for row, earlier in kept:
                if factor := added[row]:
                    added = [x - factor * y for x, y in zip(added, earlier, strict=True)]
            row = next((k for k, x in enumerate(added) if x), None)
            if row is None:
                del columns[i]  # all later powers of this input depend, too
                continue
            kept.append((row, [x / added[row] for x in added]))
            indices[i] += 1
            columns[i] = A.matmul(column)
            if len(kept) == n:
                return tuple(indices)
    raise UncontrollableError("the pair (A, B) is not controllable", field="parameters")


def chains(A: DomainMatrix, B: DomainMatrix, indices: tuple[int, ...]) -> DomainMatrix:
    """M = [b₁ … A^(σ₁−1) b₁ | b₂ …], n×n: the columns that the scan kept."""
    columns = []
    for i, index in enumerate(indices):
        column = _column(B, i)
        for _ in range(index):
            columns.append(column)
            column = A.matmul(column)
    return columns[0].hstack(*columns[1:])


def leading_rows(A: DomainMatrix, B: DomainMatrix, indices: tuple[int, ...]) -> list[DomainMatrix]:
    """q_i = row σ₁ + … + σ_i of [b₁ … A^(σ₁−1) b₁ | b₂ …]⁻¹, each 1×n."""
    n = A.shape[0]
    units = DomainMatrix.eye(n, A.domain).to_dense().extract(list(range(n)), list(_ends(indices)))
    rows = chains(A, B, indices).transpose().lu_solve(units).transpose()
    return [_row(rows, i) for i in range(len(indices))]


def canonical_form(
    A: DomainMatrix, B: DomainMatrix, indices: tuple[int, ...], rows: list[DomainMatrix]
) -> CanonicalForm:
    """The form that the leading rows q_i span (Luenberger's, shifted, or the outputs' own)."""
    basis, last = [], []
    for row, index in zip(rows, indices, strict=True):
        current = row
        for _ in range(index):
            basis.append(current)
            current = current.matmul(A)
        last.append(current)
    T = _stacked(basis)
    B_bar, ends = T.matmul(B), _ends(indices)
    Q = _stacked([_row(B_bar, end) for end in ends])
    return CanonicalForm(indices, T, _stacked(last), A, B_bar, Q, ends)


def desired_rows(
    form: CanonicalForm, groups: Iterable[tuple[Sequence[int], Sequence[Any]]], triangle: Triangle = "none"
) -> DomainMatrix:
    """D, p×n: the rows that the closed loop shall have in place of Ā's rows that carry the inputs.

    Args:
        form: the canonical form.
        groups: per block of the closed loop its inputs, and the coefficients d₀ … of its monic
            polynomial, the leading 1 left out. A block of several inputs joins their chains: each
            but the last gets a 1 at the first column of the next.
        triangle: the off-diagonal blocks that stay as the plant has them.
    """
    field, (p, n) = form.T.domain, form.last.shape
    starts = [end - index + 1 for end, index in zip(form.ends, form.indices, strict=True)]
    block = [i for i, index in enumerate(form.indices) for _ in range(index)]
    D = [[field.zero] * n for _ in range(p)]
    if triangle != "none":
        own = form.last.matmul(form.T_inverse).to_list()
        for i in range(p):
            for column in range(n):
                if (block[column] < i) if triangle == "lower" else (block[column] > i):
                    D[i][column] = own[i][column]
    for inputs, coefficients in groups:
        columns = [starts[i] + k for i in inputs for k in range(form.indices[i])]
        for i, following in pairwise(inputs):
            for column in columns:
                D[i][column] = field.zero
            D[i][starts[following]] = field.one
        for column, coefficient in zip(columns, coefficients, strict=True):
            D[inputs[-1]][column] = -coefficient
    return DomainMatrix(D, (p, n), field)


def feedback(form: CanonicalForm, D: DomainMatrix) -> DomainMatrix:
    """K = Q⁻¹ K̄ T with K̄ = (rows of Ā that carry the inputs) − D, p×n (Eq. 19)."""
    return form.Q.inv().matmul(form.last - D.matmul(form.T))


def _ends(indices: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(sum(indices[: i + 1]) - 1 for i in range(len(indices)))


def _stacked(rows: list[DomainMatrix]) -> DomainMatrix:
    return rows[0].vstack(*rows[1:])


def _row(matrix: DomainMatrix, index: int) -> DomainMatrix:
    return matrix.extract([index], list(range(matrix.shape[1])))


def _column(matrix: DomainMatrix, index: int) -> DomainMatrix:
    return matrix.extract(list(range(matrix.shape[0])), [index])
