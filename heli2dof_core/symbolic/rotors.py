"""The rig with its rotors: six states, and the gain that places all of them.

x⁺ = [θ, ψ, θ̇, ψ̇, v_p, v_y], where v_j, V, holds the present speed of rotor j and τ_j v̇_j = V_j − v_j. Its
controllability indices are (3, 3), and full-rank placement is the same construction with two cubics. Where thrust is
no straight line, its slope φ′ at the trim multiplies the motor's thrust constants; formulas need no letter for it.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from ..errors import InvalidInputError
from .full_rank import FullRank, member, plant
from .luenberger import controllability_indices
from .names import PARAMETERS as P
from .names import a, alpha, beta_0, c, d_10, d_11, d_12, d_20, d_21, d_22, tau_p, tau_y

COEFFICIENTS = ((d_10, d_11, d_12), (d_20, d_21, d_22))
"""Of the two monic cubics, pitch's and yaw's."""
_GENERATORS = [*COEFFICIENTS[0], *COEFFICIENTS[1], c, a, alpha, beta_0, tau_p, tau_y]
_GENERATORS += [P[n] for n in ("B_p", "B_y", "K_pp", "K_py", "K_yp", "K_yy")]
FIELD = sp.QQ.frac_field(*_GENERATORS)
"""Field of rational functions of the six-state derivation."""


def with_rotors(
    A: DomainMatrix, B: DomainMatrix, rates: tuple[Any, Any]
) -> tuple[DomainMatrix, DomainMatrix]:
    """A⁺ = [[A, B], [0, −diag(1/τ)]], 6×6, and B⁺ = [0; diag(1/τ)], 6×2, over the field of A and B.

    Args:
        A: of the rig whose thrust follows the voltage at once, 4×4.
        B: the same rig's, 4×2.
        rates: 1/τ_p and 1/τ_y, elements of the field.
    """
    field, zero = A.domain, A.domain.zero
    lag = DomainMatrix([[rates[0], zero], [zero, rates[1]]], (2, 2), field)
    below = DomainMatrix([[zero] * 4] * 2, (2, 4), field).hstack(-lag)
    above = DomainMatrix([[zero] * 2] * 4, (4, 2), field)
    return A.hstack(B).vstack(below), above.vstack(lag)


@cache
def base() -> tuple[DomainMatrix, DomainMatrix]:
    """(A, B) of the four states over this module's `FIELD`."""
    A, B = (matrix.to_Matrix() for matrix in plant())
    return _to_field(A), _to_field(B)


@cache
def plant_with_rotors() -> tuple[DomainMatrix, DomainMatrix]:
    """(A⁺, B⁺) over `FIELD`."""
    return with_rotors(*base(), (FIELD.from_sympy(1 / tau_p), FIELD.from_sympy(1 / tau_y)))


@cache
def indices() -> tuple[int, ...]:
    """Controllability indices of the rig with rotors in general position: (3, 3)."""
    return controllability_indices(*plant_with_rotors())


@cache
def full_rank_with_rotors(structure: Structure, *, shifted: bool = False) -> FullRank:
    """Derives K, 2×6, so that det(sI − A⁺ + B⁺K) = d₁(s) d₂(s), two cubics.

    Args:
        structure: which member of the family; its own `shift` is not looked at.
        shifted: leave the basis' shift c a symbol, instead of the value that the structure gives it: of the
            triangular ones c = τ_p K_py/(τ_y K_pp), or τ_y K_yp/(τ_p K_yy) where yaw leads.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    if shifted and structure.coupling == "axis-decoupled":
        raise InvalidInputError("the axis-decoupled structure has no shift", field="shifted")
    polynomials = [[FIELD.from_sympy(d) for d in triple] for triple in COEFFICIENTS]
    shift = FIELD.from_sympy(c) if shifted else None
    return member(*plant_with_rotors(), structure, polynomials, shift)


def _to_field(matrix: sp.MatrixBase) -> DomainMatrix:
    return DomainMatrix.from_Matrix(matrix).convert_to(FIELD).to_dense()
