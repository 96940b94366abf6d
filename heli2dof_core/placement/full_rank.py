"""Full-rank state feedback for any controllable (A, B), in exact rational arithmetic.

The code that derives the rig's formulas (`symbolic.luenberger`) runs here over the rational numbers:
a float is a fraction, so nothing is rounded between A, B and K but K itself. In floats the method
loses as many digits as the controllability matrix is ill conditioned, which for eight states is
most of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, get_args

import numpy as np
from numpy.typing import ArrayLike

from ..controllability import scan
from ..errors import InvalidInputError
from ..frozen import frozen
from ..signals import Floats
from .exact import exact_coefficients, exact_matrix, float_matrix, whole_matrix, whole_product
from .groups import Group, assign, require_groups
from .method import Method, Placement, Task, require_system

if TYPE_CHECKING:  # SymPy is imported on the first placement
    from sympy.polys.matrices import DomainMatrix

    from ..symbolic.luenberger import CanonicalForm, Triangle


@dataclass(frozen=True, kw_only=True)
class FullRankPlacement(Placement):
    """A full-rank placement with its construction.

    Attributes:
        T: n×n, x̄ = Tx.
        Q: p×p, the nonzero rows of TB; its columns are the inputs as given.
        controllability_indices: σ, one per input as given.
        groups: the blocks of the closed loop, in the order of T.
    """

    T: Floats
    Q: Floats
    controllability_indices: tuple[int, ...]
    groups: tuple[Group, ...]

    def construction(self) -> dict[str, Any]:
        """T, Q, the controllability indices and the groups."""
        return {
            "T": self.T.tolist(),
            "Q": self.Q.tolist(),
            "controllability_indices": list(self.controllability_indices),
            "groups": [asdict(group) for group in self.groups],
        }


class FullRank(Method):
    """Full-rank placement as one of the methods: poles dealt in their order, block-diagonal."""

    name = "full-rank"
    title = "Full-rank state feedback through Luenberger's canonical form"
    short = "Full-rank"
    source = "Patel & Munro, Multivariable System Theory and Design, 1982; Luenberger, IEEE TAC 12 (1967) 290"

    structured = True

    def place(self, task: Task) -> FullRankPlacement:
        """K = Q⁻¹ K̄ T with block-diagonal D."""
        return full_rank(task.A, task.B, task.poles)


def full_rank(
    A: ArrayLike,
    B: ArrayLike,
    poles: ArrayLike,
    *,
    groups: Sequence[Group] | None = None,
    input_order: Sequence[int] | None = None,
    triangle: Triangle = "none",
    shift: ArrayLike | None = None,
) -> FullRankPlacement:
    """Places the poles of any controllable (A, B) (theory: steps 1–5).

    Args:
        A: n×n.
        B: n×p, of full column rank.
        poles: n, closed under conjugation, rad/s.
        groups: which poles go into the block of which input; by default in the order given.
        input_order: the order in which the scan takes the inputs, from 0; another order can give
            other indices and another K.
        triangle: which off-diagonal blocks of the closed loop in x̄ stay as the plant has them;
            ``none`` makes it block-diagonal.
        shift: p×p, unit diagonal; the leading rows become shift · q. Entry (i, j) may differ from 0
            only where σ_j ≥ σ_i. Rows and columns in the order of the scan.

    Returns:
        The placement; T, Q and groups in the order of the scan.

    Raises:
        InvalidInputError: shapes, groups, order or shift do not fit.
        UnpairedPolesError: the poles, or a group of them, are not closed under conjugation.
        UncontrollableError: (A, B) is not controllable.
    """
    from ..symbolic.luenberger import Triangle, desired_rows

    A, B, wanted = require_system(A, B, poles)
    if triangle not in get_args(Triangle):
        raise InvalidInputError(f"triangle is {triangle!r}", field="triangle", value=triangle)
    p = B.shape[1]
    order = _require_order(input_order, p)
    scanned = scan(A, B[:, order])
    indices = scanned.indices
    if 0 in indices:
        raise InvalidInputError(
            f"input {order[indices.index(0)] + 1} moves the states hardly otherwise than the inputs before it",
            field="B",
            hint="Leave that column of B out.",
        )
    chosen = assign(wanted, indices) if groups is None else _reordered(groups, order)
    chosen = require_groups(chosen, wanted, indices)
    shifted = None if shift is None else _require_shift(shift, indices)
    prepared = _prepared(
        _Matrix.of(A), _Matrix.of(B[:, order]), indices, None if shifted is None else _Matrix.of(shifted)
    )
    polynomials = [(g.inputs, exact_coefficients(wanted[list(g.poles)])) for g in chosen]
    gain = prepared.gain(desired_rows(prepared.form, polynomials, triangle))
    back = np.argsort(order)
    return FullRankPlacement(
        K=gain[back],
        T=prepared.T,
        Q=prepared.Q[:, back],
        controllability_indices=tuple(indices[i] for i in back),
        weakest=scanned.weakest,
        groups=tuple(Group(tuple(order[i] for i in g.inputs), g.poles) for g in chosen),
    )


@dataclass(frozen=True)
class _Matrix:
    """A matrix by its bytes, which can be compared."""

    shape: tuple[int, ...]
    data: bytes

    @classmethod
    def of(cls, matrix: Floats) -> _Matrix:
        return cls(matrix.shape, np.ascontiguousarray(matrix).tobytes())

    @property
    def floats(self) -> Floats:
        return np.frombuffer(self.data, dtype=np.float64).reshape(self.shape)


class _Prepared:
    """The canonical form of a pair, which all its placements share: it takes nearly all of the time.

    K = Q⁻¹ (rows that carry the inputs, times T, − D T) = K₀ − Q⁻¹ D T. The products are taken in whole numbers over
    one denominator, which takes a tenth of the time of fractions.

    Attributes:
        form: the canonical form.
        T, Q: as floats.
        M: the columns of the controllability matrix that T is made of, as floats.
    """

    def __init__(self, form: CanonicalForm, M: DomainMatrix) -> None:
        self.form, self.M = form, frozen(float_matrix(M))
        self.T, self.Q = frozen(float_matrix(form.T)), frozen(float_matrix(form.Q))
        mixing = form.Q.inv()
        self._own = whole_matrix(mixing.matmul(form.last))
        self._mixing, self._basis = whole_matrix(mixing), whole_matrix(form.T)

    def gain(self, D: DomainMatrix) -> Floats:
        """K, each entry the float nearest to what it is exactly."""
        (own, below), (basis, t) = self._own, self._basis
        (mixing, m), (rows, d) = self._mixing, whole_matrix(D)
        inner = whole_product(whole_product(mixing, rows), basis)
        all_three = m * d * t
        return np.array(
            [
                [(k * all_three - x * below) / (below * all_three) for k, x in zip(*pair, strict=True)]
                for pair in zip(own, inner, strict=True)
            ]
        )


@lru_cache(maxsize=32)  # from one move of a pole to the next the system stays
def _prepared(A: _Matrix, B: _Matrix, indices: tuple[int, ...], shift: _Matrix | None) -> _Prepared:
    from ..symbolic.luenberger import canonical_form, chains, leading_rows

    matrix, inputs = exact_matrix(A.floats), exact_matrix(B.floats)
    rows = leading_rows(matrix, inputs, indices)
    if shift is not None:
        rows = _shifted(rows, shift.floats)
    return _Prepared(canonical_form(matrix, inputs, indices, rows), chains(matrix, inputs, indices))


def canonical(A: Floats, B: Floats) -> tuple[Floats, Floats, Floats]:
    """T, Q and M of a controllable pair as `full_rank` has them; M = [b₁ … A^(σ₁−1)b₁ | b₂ …], n×n.

    Raises:
        UncontrollableError: (A, B) is not controllable.
    """
    prepared = _prepared(_Matrix.of(A), _Matrix.of(B), scan(A, B).indices, None)
    return prepared.T, prepared.Q, prepared.M


def _require_order(order: Sequence[int] | None, p: int) -> list[int]:
    chosen = list(range(p)) if order is None else list(order)
    if sorted(chosen) != list(range(p)):
        raise InvalidInputError(
            f"the input order {chosen} does not name each of 0 … {p - 1} once",
            field="input_order",
            value=str(chosen),
            hint="Name each input once, by position from 0.",
        )
    return chosen


def _reordered(groups: Sequence[Group], order: list[int]) -> tuple[Group, ...]:
    """Groups by input as given → by position in the scan; unknown inputs are left for the check."""
    place = {given: position for position, given in enumerate(order)}
    return tuple(Group(tuple(place.get(i, i) for i in g.inputs), g.poles) for g in groups)


def _require_shift(shift: ArrayLike, indices: tuple[int, ...]) -> Floats:
    p = len(indices)
    S = np.asarray(shift, dtype=float)
    fits = S.shape == (p, p) and bool(np.all(np.isfinite(S)))
    allowed = np.array([[i == j or indices[j] >= indices[i] for j in range(p)] for i in range(p)])
    if not fits or np.any(np.diag(S) != 1) or np.any(S[~allowed] != 0) or not np.linalg.det(S):
        raise InvalidInputError(
            "the shift is no invertible p×p matrix with unit diagonal and zeros where σ_j < σ_i",
            field="shift",
            value=str(shift),
            hint="For two inputs with equal indices: [[1, c], [0, 1]].",
        )
    return S


def _shifted(rows: list[DomainMatrix], S: Floats) -> list[DomainMatrix]:
    stacked = exact_matrix(S).matmul(rows[0].vstack(*rows[1:]))
    n = stacked.shape[1]
    return [stacked.extract([i], list(range(n))) for i in range(len(rows))]
