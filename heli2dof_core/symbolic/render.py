"""Formulas for people and for tools: grouped, as SymPy text, LaTeX and MathML."""

# pyright: reportArgumentType=false, reportCallIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import sympy as sp

from ..couplings import Modelled, Sought, Structure
from .beyond import GainFormulas, observer_formulas, rotor_formulas
from .formulas import derive
from .full_rank import indices
from .linearization import linear_model
from .mathml import mathml
from .names import NAMES, Name, latex

_REPORTED = (
    *("A", "B", "controllability_matrix", "T", "Q", "A_bar", "B_bar", "K_bar", "K"),
    *("closed_loop", "canonical_closed_loop", "G", "G_0", "RGA", "RGA_s"),
)


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
            K, closed_loop (A − BK), canonical_closed_loop (T (A − BK) T⁻¹), G, G_0, RGA at s = 0, RGA_s;
            beyond the paper's model those of `beyond.GainFormulas`.
        entries: per matrix of K, RGA and G, or K or L, its entries, such as ``k_11``.
        definitions: what the short names α, β₀, γ, a stand for; beyond the paper's model all letters and groups.
        controllability_indices: σ, one per input; of (Aᵀ, Cᵀ) for the observer.
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
def symbolic_report(
    structure: Structure, *, shifted: bool = False, model: Modelled = "paper", what: Sought = "K"
) -> SymbolicReport:
    """Derives and renders everything symbolic for one structure of the closed loop.

    With `shifted` the shift c of the basis stays a symbol. The observer's L is the same in both models.
    """
    if what == "L":
        return _beyond(observer_formulas(structure, shifted=shifted))
    if model == "rotors":
        return _beyond(rotor_formulas(structure, shifted=shifted))
    derived = derive(structure, shifted=shifted)
    matrices: dict[str, sp.Matrix] = {name: getattr(derived, name) for name in _REPORTED}
    short = {str(name): value for name, value in linear_model().definitions.items()}
    used = set().union(
        *(m.free_symbols for m in matrices.values()), *(v.free_symbols for v in short.values())
    )
    used |= {sp.Symbol(name) for name in short}
    symbols = tuple(name for name in NAMES if sp.Symbol(name.name) in used)
    return SymbolicReport(
        formulas={name: formula(matrix) for name, matrix in matrices.items()},
        entries={
            name: _entries(matrices[name], letter)
            for name, letter in (("K", "k"), ("G", "g"), ("RGA", "lambda"))
        },
        definitions={name: formula(value) for name, value in short.items()},
        controllability_indices=indices(),
        symbols=symbols,
        notation={name.name: formula_of_name(name) for name in symbols},
    )


def _beyond(derived: GainFormulas) -> SymbolicReport:
    """Formulas of a gain beyond the paper's model."""
    sought = derived.sought
    return SymbolicReport(
        formulas={name: formula(value) for name, value in (derived.equations | derived.matrices).items()},
        entries={sought: _entries(derived.gain, sought.lower())},
        definitions={str(name): formula(value) for name, value in derived.definitions.items()},
        controllability_indices=derived.indices,
        symbols=derived.symbols,
        notation={name.name: formula_of_name(name) for name in derived.symbols},
    )


def _entries(matrix: sp.MatrixBase, letter: str) -> dict[str, Formula]:
    cells = [(i, j) for i in range(matrix.rows) for j in range(matrix.cols)]
    return {f"{letter}_{i + 1}{j + 1}": formula(matrix[i, j]) for i, j in cells}


def formula_of_name(name: Name) -> Formula:
    """A symbol by itself."""
    return Formula(name.name, name.latex, mathml(name.latex))


def formula_of_letters(expression: sp.Expr | sp.Matrix, letters: Mapping[str, sp.Symbol]) -> Formula:
    """An expression in somebody's own letters; those renamed for SymPy are written by the names that were given."""
    own = {symbol: sp.latex(sp.Symbol(name)) for name, symbol in letters.items() if symbol.name != name}
    text = sp.latex(expression, symbol_names=own, mat_delim="[")
    return Formula(str(expression), text, mathml(text))


def formula(expression: sp.Expr | sp.Matrix) -> Formula:
    """An expression or matrix in all three notations."""
    text = latex(expression)
    return Formula(str(expression), text, mathml(text))
