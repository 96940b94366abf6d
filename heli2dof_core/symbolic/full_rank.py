"""Full-rank state feedback in closed form (Eqs. 19–22), for each structure of the closed loop.

The method is Patel and Munro's (Multivariable System Theory and Design, 1982): in Luenberger's
basis the rows that carry the inputs can be replaced at will. K = Q⁻¹ K̄ T, K̄ = (those rows of Ā) − D.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from ..errors import InvalidInputError
from .linearization import linear_model
from .luenberger import (
    CanonicalForm,
    Triangle,
    canonical_form,
    controllability_indices,
    desired_rows,
    feedback,
    leading_rows,
)
from .names import PARAMETERS as P
from .names import a, alpha, beta_0, c, d_10, d_11, d_20, d_21, s

_GENERATORS = [s, d_10, d_11, d_20, d_21, c, a, alpha, beta_0]
_GENERATORS += [P[n] for n in ("B_p", "B_y", "K_pp", "K_py", "K_yp", "K_yy")]
FIELD = sp.QQ.frac_field(*_GENERATORS)
"""Field of rational functions in which the whole derivation takes place."""


@dataclass(frozen=True)
class FullRank:
    """Full-rank placement of the rig in one structure, over `FIELD` or the rational numbers.

    Attributes:
        form: the canonical form used, with T and Q.
        K: 2×4 gain of u = −Kx + v, V/rad and V·s/rad, in the coefficients of d₁ and d₂.
    """

    form: CanonicalForm
    K: DomainMatrix

    @cached_property
    def closed_loop(self) -> DomainMatrix:
        """A − BK."""
        A, B = plant()
        return A - B.matmul(self.K)

    @cached_property
    def K_bar(self) -> DomainMatrix:
        """K̄ = Q K T⁻¹, 2×4: the rows of Ā that carry the inputs, less the desired ones (Eq. 19)."""
        return self.form.Q.matmul(self.K).matmul(self.form.T_inverse)

    @cached_property
    def canonical_closed_loop(self) -> DomainMatrix:
        """T (A − BK) T⁻¹, block triangular or block diagonal."""
        return self.form.T.matmul(self.closed_loop).matmul(self.form.T_inverse)


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
def full_rank(structure: Structure, *, shifted: bool = False) -> FullRank:
    """Derives K so that det(sI − A + BK) = d₁(s) d₂(s).

    Args:
        structure: which member of the family; its own `shift` is not looked at.
        shifted: leave the basis' shift c a symbol, instead of the value that the structure gives it.

    Raises:
        InvalidInputError: a shift is asked for where there is none.

    Errata: Eqs. 21–22 print B_p/β for B_y/β four times, and α for β in k₁₂, k₁₄, k₂₂, k₂₄.
    """
    if shifted and structure.coupling == "axis-decoupled":
        raise InvalidInputError("the axis-decoupled structure has no shift", field="shifted")
    polynomials = [[FIELD.from_sympy(d) for d in pair] for pair in _POLYNOMIALS]
    return member(*plant(), structure, polynomials, FIELD.from_sympy(c) if shifted else None)


def member(
    A: DomainMatrix, B: DomainMatrix, structure: Structure, polynomials: Sequence[Sequence[Any]], shift: Any
) -> FullRank:
    """The member of the family with this structure, over any field: that of the symbols, or the rational numbers.

    Args:
        A: n×n, of a pair with the indices (n/2, n/2): the rig's, that with its rotors (`rotors`), or the observer's
            dual (`observer`).
        B: n×2.
        structure: which member; its own `shift` is not looked at.
        polynomials: (d₁₀, d₁₁ …), (d₂₀, d₂₁ …), n/2 coefficients each, the leading 1 left out.
        shift: of the basis, an element of the field; None takes the one that gives the structure its name.
    """
    half = A.shape[0] // 2
    form = canonical_form(A, B, (half, half), _rows(A, B, (half, half), structure, shift))
    blocks = [((i,), pair) for i, pair in enumerate(polynomials)]
    return FullRank(form, feedback(form, desired_rows(form, blocks, _kept_triangle(structure))))


def steady_state_inverse(K: DomainMatrix, A: DomainMatrix, B: DomainMatrix) -> DomainMatrix:
    """Ĝ(0)⁻¹ = K's columns of θ and ψ less (I + K_v) B₂⁻¹ A₂₁, 2×2, over the field of all three.

    Args:
        K: 2×4, or 2×6 with K_v in its last columns, of the rotors' speeds.
        A: the rig's without rotors, 4×4.
        B: the same rig's, 4×2.
    """
    angles, rates, rotors = [0, 1], [2, 3], list(range(4, K.shape[1]))
    statics = B.extract(rates, angles).inv().matmul(A.extract(rates, angles))
    inverse = K.extract(angles, angles) - statics
    return inverse - K.extract(angles, rotors).matmul(statics) if rotors else inverse


def to_field(matrix: sp.MatrixBase) -> DomainMatrix:
    """A SymPy matrix as a dense DomainMatrix over `FIELD`."""
    return DomainMatrix.from_Matrix(matrix).convert_to(FIELD).to_dense()


_POLYNOMIALS = ((d_10, d_11), (d_20, d_21))


def _kept_triangle(structure: Structure) -> Triangle:
    """The axis that leads is not driven; the block that drives the other stays as the plant has it."""
    if structure.coupling != "triangular":
        return "none"
    return "lower" if structure.lead == "pitch" else "upper"


def _rows(
    A: DomainMatrix, B: DomainMatrix, indices: tuple[int, int], structure: Structure, shift: Any
) -> list[DomainMatrix]:
    """The leading rows q₁, q₂ that give the structure its name."""
    if structure.coupling == "axis-decoupled":
        axes = _axes(A, B, indices)
        return [axes.extract([i], list(range(A.shape[0]))) for i in range(2)]
    q_1, q_2 = leading_rows(A, B, indices)
    if structure.coupling == "input-diagonal" and shift is None:
        return [q_1, q_2]
    yaw_leads = structure.coupling == "triangular" and structure.lead == "yaw"
    if shift is None:  # the last derivative of the axes that is free of the inputs, derived once more
        driven = _axes(A, B, indices)
        for _ in range(indices[0] - 1):
            driven = driven.matmul(A)
        pitch, yaw = driven.matmul(B).to_list()
        shift = (
            yaw[0] / yaw[1] if yaw_leads else pitch[1] / pitch[0]
        )  # K_yp/K_yy or K_py/K_pp, of the rig alone
    if yaw_leads:
        return [q_1, q_2 + q_1 * shift]
    return [q_1 + q_2 * shift, q_2]  # with c = K_py/K_pp this leaves θ alone in the first block


def _axes(A: DomainMatrix, B: DomainMatrix, indices: tuple[int, int]) -> DomainMatrix:
    """The rows that no input reaches before the last derivative, 2×n: θ and ψ of the rig."""
    reached = B
    for _ in range(indices[0] - 2):
        reached = A.matmul(reached).hstack(B)
    return reached.transpose().nullspace().rref()[0]
