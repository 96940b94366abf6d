"""The report's formulas: those of the method and the structure in use."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..couplings import Structure
from ..design import Design

if TYPE_CHECKING:  # would be imported before the first page
    from ..symbolic.render import Formula


def formulas(design: Design) -> dict[str, Any]:
    """All formulas, K's entries by their indices; `gains` is None where K has no formula.

    `relative` is None where the steady state's relative gain is another one: six states are placed, or the motors
    act by the slopes of thrust curves.
    """
    from ..symbolic.render import symbolic_report  # SymPy: on first use

    structure = design.structure
    symbols = symbolic_report((structure or Structure()).family)
    if structure is None:
        return {"symbols": symbols, "gains": None}
    relative: Formula | None = symbols.entries["RGA"]["lambda_11"]
    if design.rotor_poles is not None:
        gains, relative = _with_rotors(structure), None
    elif structure.shift is not None:
        gains, relative = _shifted(structure.family)
    else:
        gains = symbols.entries["K"]
    if design.actuators is not None and design.actuators.square.any():
        relative = None
    by_index = {name.removeprefix("k_"): entry for name, entry in gains.items()}
    return {"symbols": symbols, "gains": by_index, "relative": relative}


def _shifted(structure: Structure) -> tuple[dict[str, Formula], Formula]:
    """K's entries and λ₁₁ with the shift as a symbol, and no more: all else with it takes SymPy a minute."""
    from ..symbolic.full_rank import full_rank
    from ..symbolic.grouping import group
    from ..symbolic.render import formula
    from ..symbolic.rga import relative_gain_array

    K: Any = full_rank(structure, shifted=True).K.to_Matrix()  # SymPy's entries are dynamic
    relative: Any = relative_gain_array(structure, shifted=True).to_Matrix()
    entries = {f"k_{i + 1}{j + 1}": formula(group(K[i, j])) for i in range(2) for j in range(4)}
    return entries, formula(group(relative[0, 0]))


def _with_rotors(structure: Structure) -> dict[str, Formula]:
    """K's entries where six states are placed, by the coefficients of both cubics."""
    import sympy as sp

    from ..symbolic.grouping import group
    from ..symbolic.render import formula
    from ..symbolic.rotors import COEFFICIENTS, full_rank_with_rotors

    K: Any = full_rank_with_rotors(structure.family, shifted=structure.shift is not None).K.to_Matrix()
    # `group` writes coefficients of quadratics by poles; those of cubics have the same names
    aside = {d: sp.Dummy() for cubic in COEFFICIENTS for d in cubic}
    back = {dummy: d for d, dummy in aside.items()}

    def written(entry: Any) -> Formula:
        own: Any = group(entry.xreplace(aside))
        return formula(own.xreplace(back))

    return {f"k_{i + 1}{j + 1}": written(K[i, j]) for i in range(2) for j in range(6)}
