"""Formulas for people and for tools: grouped, as SymPy text, LaTeX and MathML."""

# pyright: reportArgumentType=false, reportCallIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

import sympy as sp
from latex2mathml.converter import convert
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from .full_rank import full_rank, indices, plant
from .linearization import linear_model
from .luenberger import controllability_matrix
from .names import (
    COEFFICIENTS_OF_POLES,
    LATEX,
    NAMES,
    PARAMETERS,
    Name,
    d_11,
    d_21,
    gamma_,
    p_1,
    p_2,
    p_3,
    p_4,
    s,
)
from .rga import relative_gain_array, relative_gains_of_s, steady_state, transfer_matrix

_DETERMINANT = PARAMETERS["K_pp"] * PARAMETERS["K_yy"] - PARAMETERS["K_py"] * PARAMETERS["K_yp"]
_SUMS = {sp.Dummy(): p_1 + p_2, sp.Dummy(): p_3 + p_4}
_SIGNED = {  # −(p₁ + p₂) keeps its sign outside the bracket only if the bracket is a name at first
    **COEFFICIENTS_OF_POLES,
    **{d: -name for d, name in zip((d_11, d_21), _SUMS, strict=True)},
}
_ORDER = [PARAMETERS[name] for name in ("K_pp", "K_yy", "K_py", "K_yp")]


@dataclass(frozen=True)
class Formula:
    """One expression: `sympy` parses back with `sympify`; `mathml` is a whole math element."""

    sympy: str
    latex: str
    mathml: str


@dataclass(frozen=True)
class SymbolicReport:
    """All formulas of one structure.

    Attributes:
        formulas: A, B, controllability_matrix, T, Q, A_bar (T A T⁻¹), B_bar (T B), K_bar (Q K T⁻¹),
            K, closed_loop (A − BK), canonical_closed_loop (T (A − BK) T⁻¹), G, G_0, RGA at s = 0, RGA_s.
        entries: per matrix of K, RGA and G its entries, such as ``k_11``.
        definitions: what the short names α, β₀, γ, a stand for.
        controllability_indices: σ, one per input.
        symbols: every symbol that occurs, with meaning and unit.
        notation: the same symbols as formulas, by name.
    """

    formulas: dict[str, Formula]
    entries: dict[str, dict[str, Formula]]
    definitions: dict[str, Formula]
    controllability_indices: tuple[int, ...]
    symbols: tuple[Name, ...]
    notation: dict[str, Formula]


@cache
def symbolic_report(structure: Structure, *, shifted: bool = False) -> SymbolicReport:
    """Derives and renders everything symbolic for one structure of the closed loop.

    With `shifted` the shift c of the basis stays a symbol.
    """
    model, result = linear_model(), full_rank(structure, shifted=shifted)
    A, B = plant()
    matrices = {
        "A": model.A,
        "B": model.B,
        "controllability_matrix": controllability_matrix(A, B).to_Matrix(),
        "T": grouped(result.form.T),
        "Q": grouped(result.form.Q),
        "A_bar": grouped(result.form.A_bar),
        "B_bar": grouped(result.form.B_bar),
        "K_bar": grouped(result.K_bar),
        "K": grouped(result.K),
        "closed_loop": grouped(result.closed_loop),
        "canonical_closed_loop": grouped(result.canonical_closed_loop),
        "G": grouped(transfer_matrix(structure, shifted=shifted)),
        "G_0": grouped(steady_state(structure, shifted=shifted)),
        "RGA": grouped(relative_gain_array(structure, shifted=shifted)),
        "RGA_s": grouped(relative_gains_of_s(structure, shifted=shifted)),
    }
    short = {str(name): value for name, value in model.definitions.items()}
    used = set().union(
        *(m.free_symbols for m in matrices.values()), *(v.free_symbols for v in short.values())
    )
    used |= {sp.Symbol(name) for name in short}
    symbols = tuple(name for name in NAMES if sp.Symbol(name.name) in used)
    return SymbolicReport(
        formulas={name: formula(matrix) for name, matrix in matrices.items()},
        entries={
            name: {
                f"{letter}_{i + 1}{j + 1}": formula(matrices[name][i, j])
                for i in range(matrices[name].rows)
                for j in range(matrices[name].cols)
            }
            for name, letter in (("K", "k"), ("G", "g"), ("RGA", "lambda"))
        },
        definitions={name: formula(value) for name, value in short.items()},
        controllability_indices=indices(),
        symbols=symbols,
        notation={name.name: formula(sp.Symbol(name.name)) for name in symbols},
    )


def formula(expression: sp.Expr | sp.Matrix) -> Formula:
    """An expression or matrix in all three notations."""
    latex = sp.latex(expression, symbol_names=LATEX, mat_delim="[")
    return Formula(str(expression), latex, convert(latex))


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
    with_gamma = [term for term in sp.Add.make_args(sp.expand(numerator)) if term.has(gamma_)]
    without = [term for term in sp.Add.make_args(sp.expand(numerator)) if not term.has(gamma_)]
    return sp.Add(*(_part(part, denominator) for part in (with_gamma, without) if part))


def _part(terms: Iterable[sp.Expr], denominator: sp.Expr) -> sp.Expr:
    fraction = sp.factor(sp.Add(*terms)) / denominator
    numerator, denominator = sp.fraction(sp.cancel(fraction) if fraction.has(gamma_) else fraction)
    parts = [
        sp.Mul(*(sp.collect(f, s) for f in sp.Mul.make_args(sp.factor(side))))
        for side in (numerator, denominator)
    ]
    return (parts[0] / parts[1]).subs(_SIGNED).subs(_SUMS)
