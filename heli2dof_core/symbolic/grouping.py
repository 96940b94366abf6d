"""Rational functions as a person would write them: γ, p₁p₂ and p₁ + p₂ kept together."""

# pyright: reportArgumentType=false, reportCallIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from .names import COEFFICIENTS_OF_POLES, PARAMETERS, d_11, d_21, gamma_, p_1, p_2, p_3, p_4, s

_DETERMINANT = PARAMETERS["K_pp"] * PARAMETERS["K_yy"] - PARAMETERS["K_py"] * PARAMETERS["K_yp"]
_SUMS = {sp.Dummy(): p_1 + p_2, sp.Dummy(): p_3 + p_4}
_SIGNED = {  # −(p₁ + p₂) keeps its sign outside the bracket only if the bracket is a name at first
    **COEFFICIENTS_OF_POLES,
    **{d: -name for d, name in zip((d_11, d_21), _SUMS, strict=True)},
}
_ORDER = [PARAMETERS[name] for name in ("K_pp", "K_yy", "K_py", "K_yp")]


def grouped(matrix: DomainMatrix) -> sp.Matrix:
    """The matrix with γ, p₁p₂ and p₁ + p₂ kept together in every entry."""
    return matrix.to_Matrix().applyfunc(group)


@cache
def group(expression: sp.Expr) -> sp.Expr:
    """Writes a rational function as a person would.

    The denominator is factored and its K_pp K_yy − K_py K_yp named −γ; the numerator is split into
    the part that γ divides and the rest, each factored; then d_ij are put back in terms of poles.
    """
    numerator, denominator = sp.fraction(expression)
    denominator = sp.factor(denominator).subs(_DETERMINANT, -gamma_)
    if denominator.has(gamma_):
        _, numerator = sp.reduced(numerator, [_DETERMINANT + gamma_], *_ORDER)
    terms = sp.Add.make_args(sp.expand(numerator))
    with_gamma = [term for term in terms if term.has(gamma_)]
    without = [term for term in terms if not term.has(gamma_)]
    return sp.Add(*(_part(part, denominator) for part in (with_gamma, without) if part))


def _part(terms: Iterable[sp.Expr], denominator: sp.Expr) -> sp.Expr:
    sides = sp.fraction(sp.factor(sp.Add(*terms)) / denominator)  # common factors go as powers of one base
    parts = [sp.Mul(*(sp.collect(factor, s) for factor in sp.Mul.make_args(side))) for side in sides]
    return (parts[0] / parts[1]).subs(_SIGNED).subs(_SUMS)
