"""The observer's gain in closed form, by duality: (Aᵀ, Cᵀ) through the same construction gives Lᵀ.

x̂' = A x̂ + B u + L (y − C x̂), y = [θ, ψ]. The observability indices are (2, 2). The rig's A does not couple its axes
and neither does C, so that Luenberger's basis has the axes of its own: all named structures exist and have the same
L, which observes each axis by itself. Only a basis that is shifted has another.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from ..errors import InvalidInputError
from .full_rank import FIELD, FullRank, member, plant, to_field
from .luenberger import controllability_indices
from .names import c, d_10, d_11, d_20, d_21

_POLYNOMIALS = ((d_10, d_11), (d_20, d_21))


@dataclass(frozen=True)
class Observer:
    """An observer of the rig over `full_rank.FIELD`.

    Attributes:
        dual: placement of the dual pair (Aᵀ, Cᵀ); its K is Lᵀ.
        L: 4×2, 1/s in its first two rows, 1/s² below, in the coefficients of the observer's polynomials
            (`names.COEFFICIENTS_OF_OBSERVER_POLES`).
    """

    dual: FullRank
    L: DomainMatrix


@cache
def dual() -> tuple[DomainMatrix, DomainMatrix]:
    """(Aᵀ, Cᵀ), 4×4 and 4×2."""
    A, _ = plant()
    return A.transpose(), to_field(sp.eye(4, 2))


@cache
def indices() -> tuple[int, ...]:
    """Observability indices of every rig: (2, 2)."""
    return controllability_indices(*dual())


@cache
def observer(structure: Structure, *, shifted: bool = False) -> Observer:
    """Derives L so that det(sI − A + LC) = d₁(s) d₂(s).

    Args:
        structure: which member of the family; its own `shift` is not looked at.
        shifted: leave the basis' shift c a symbol.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    if shifted and structure.coupling == "axis-decoupled":
        raise InvalidInputError("the axis-decoupled structure has no shift", field="shifted")
    polynomials = [[FIELD.from_sympy(d) for d in pair] for pair in _POLYNOMIALS]
    placed = member(*dual(), structure, polynomials, FIELD.from_sympy(c) if shifted else None)
    return Observer(placed, placed.K.transpose())
