"""Closed-loop transfer matrix Ĝ(s) (Eq. 17) and relative gain array (Eq. 23), symbolically."""

from __future__ import annotations

from functools import cache

import sympy as sp
from sympy.polys.fields import FracElement
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from .full_rank import FIELD, full_rank, to_field
from .grouping import group
from .names import PARAMETERS as P
from .names import alpha, beta_0, d_10, d_11, d_20, d_21, s

_DET_B = FIELD.from_sympy((P["K_pp"] * P["K_yy"] - P["K_py"] * P["K_yp"]) / (alpha * beta_0))
_CHARACTERISTIC = FIELD.from_sympy((s**2 + d_11 * s + d_10) * (s**2 + d_21 * s + d_20))


@cache
def transfer_matrix(structure: Structure, *, shifted: bool = False) -> DomainMatrix:
    """Ĝ(s) = C (sI − A + BK)⁻¹ B over `FIELD`, 2×2, rad/V, solved in the basis of T.

    Erratum: Eqs. 16–18 print A + BK; the printed K is stable with A − BK only.
    """
    result = full_rank(structure, shifted=shifted)
    form = result.form
    pencil = to_field(sp.eye(4) * s) - result.canonical_closed_loop
    states = pencil.lu_solve(form.B_bar)
    return to_field(sp.eye(2, 4)).matmul(form.T_inverse).matmul(states)


@cache
def steady_state(structure: Structure, *, shifted: bool = False) -> DomainMatrix:
    """Ĝ(0) over `FIELD`, 2×2, rad/V."""
    entries = transfer_matrix(structure, shifted=shifted).to_list()
    return DomainMatrix([[_at_zero(entry) for entry in row] for row in entries], (2, 2), FIELD)


@cache
def relative_gain_array(structure: Structure, *, shifted: bool = False) -> DomainMatrix:
    """RGA = Ĝ(0) ∘ Ĝ(0)⁻ᵀ over `FIELD`, 2×2 (Bristol 1966)."""
    G_0 = steady_state(structure, shifted=shifted)
    return G_0.mul_elementwise(G_0.inv().transpose())


@cache
def relative_gains_of_s(structure: Structure, *, shifted: bool = False) -> sp.ImmutableMatrix:
    """Ĝ(s) ∘ Ĝ(s)⁻ᵀ, 2×2, as a person would write it: RGA(jω) at s = jω.

    Rows and columns sum to 1, so one entry tells all: λ₁₂ = −ĝ₁₂ ĝ₂₁ / det Ĝ. Feedback moves no zeros and
    the rig has none, so that det Ĝ = det B₂ / (d₁ d₂) with B₂ the rows of B that carry the inputs. The
    product stays one: multiplied out it is ten times as long where the shift is a symbol.
    """
    (_, g_12), (g_21, _) = transfer_matrix(structure, shifted=shifted).to_list()
    factors = [FIELD.to_sympy(factor) for factor in (-g_12 * _CHARACTERISTIC / _DET_B, g_21)]
    other = sp.factor_terms(sp.Mul(*map(group, factors)))
    return sp.ImmutableMatrix([[1 - other, other], [other, 1 - other]])


def _at_zero(entry: FracElement) -> FracElement:
    return FIELD.from_sympy(FIELD.to_sympy(entry).subs(s, 0))
