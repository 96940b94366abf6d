"""Full-rank state feedback in closed form (Eqs. 19–22), for each structure of the closed loop.

The method is Patel and Munro's (Multivariable System Theory and Design, 1982): in Luenberger's
basis the rows that carry the inputs can be replaced at will. K = Q⁻¹ K̄ T, K̄ = (those rows of Ā) − D.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from .linearization import linear_model
from .luenberger import CanonicalForm, canonical_form, controllability_indices, leading_rows
from .names import PARAMETERS as P
from .names import a, alpha, beta_0, d_10, d_11, d_20, d_21, s

_GENERATORS = [s, d_10, d_11, d_20, d_21, a, alpha, beta_0]
_GENERATORS += [P[n] for n in ("B_p", "B_y", "K_pp", "K_py", "K_yp", "K_yy")]
FIELD = sp.QQ.frac_field(*_GENERATORS)
"""Field of rational functions in which the whole derivation takes place."""


@dataclass(frozen=True)
class FullRank:
    """Symbolic full-rank placement of the rig in one structure, over `FIELD`.

    Attributes:
        form: the canonical form used, with T and Q.
        K: 2×4 gain of u = −Kx + v, V/rad and V·s/rad, in the coefficients of d₁ and d₂.
        closed_loop: A − BK.
        canonical_closed_loop: T (A − BK) T⁻¹, block triangular or block diagonal.
    """

    form: CanonicalForm
    K: DomainMatrix
    closed_loop: DomainMatrix
    canonical_closed_loop: DomainMatrix


@cache
def plant() -> tuple[DomainMatrix, DomainMatrix]:
    """(A, B) of the linear model over `FIELD`."""
    model = linear_model()
    return to_field(model.A), to_field(model.B)


@cache
def indices() -> tuple[int, ...]:
    """Controllability indices of the rig in general position: (2, 2)."""
    return controllability_indices(*plant())


@cache
def full_rank(structure: Structure) -> FullRank:
    """Derives K so that det(sI − A + BK) = d₁(s) d₂(s).

    Errata: Eqs. 21–22 print B_p/β for B_y/β four times, and α for β in k₁₂, k₁₄, k₂₂, k₂₄.
    """
    A, B = plant()
    form = canonical_form(A, B, indices(), _rows(structure))
    wanted = to_field(sp.Matrix([[-d_10, -d_11, 0, 0], [0, 0, -d_20, -d_21]]))
    K_bar = form.A_bar.extract(list(form.ends), list(range(4))) - wanted
    if structure.coupling == "triangular":  # the block that couples the axes stays as it is
        K_bar = to_field(sp.Matrix([[1, 1, 0, 0], [0, 0, 1, 1]])).mul_elementwise(K_bar)
    K = form.Q.inv().matmul(K_bar).matmul(form.T)
    closed_loop = A - B.matmul(K)
    return FullRank(form, K, closed_loop, form.T.matmul(closed_loop).matmul(form.T.inv()))


def to_field(matrix: sp.Matrix) -> DomainMatrix:
    """A SymPy matrix as a dense DomainMatrix over `FIELD`."""
    return DomainMatrix.from_Matrix(matrix).convert_to(FIELD).to_dense()


def _rows(structure: Structure) -> list[DomainMatrix]:
    """The leading rows q₁, q₂ that give the structure its name."""
    if structure.coupling == "axis-decoupled":
        outputs = to_field(sp.eye(2, 4))
        return [outputs.extract([i], list(range(4))) for i in range(2)]
    q_1, q_2 = leading_rows(*plant(), indices())
    if structure.coupling == "input-diagonal":
        return [q_1, q_2]
    if structure.lead == "pitch":  # q₁ → q₁ + c q₂ leaves θ alone in the first block
        shift = FIELD.from_sympy(P["K_py"] / P["K_pp"])
        return [q_1 + q_2 * shift, q_2]
    shift = FIELD.from_sympy(P["K_yp"] / P["K_yy"])
    return [q_1, q_2 + q_1 * shift]
