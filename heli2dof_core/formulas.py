"""The door to everything symbolic; SymPy is imported on the first call only."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .couplings import Coupling, Lead, Structure

if TYPE_CHECKING:
    from .symbolic.formulas import Formulas


def formulas(coupling: Coupling = "triangular", lead: Lead = "pitch", *, shifted: bool = False) -> Formulas:
    """The derivation as SymPy objects, from the energies to K, Ĝ(s) and the RGA.

    >>> f = formulas()
    >>> f.K.shape, f.RGA[0, 0].subs(f.symbols["K_py"], 0)
    ((2, 4), 1)

    Args:
        coupling: structure of the closed loop; the paper's by default.
        lead: the axis that leads where it is triangular.
        shifted: leave the basis' shift c a symbol.

    Raises:
        InvalidInputError: there is no such structure, or none with a shift.
    """
    from .symbolic.formulas import derive

    return derive(Structure(coupling, lead), shifted=shifted)
