"""The door to everything symbolic; SymPy is imported on the first call only."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .couplings import Coupling, Lead, Structure

if TYPE_CHECKING:
    from .symbolic.beyond import GainFormulas
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


def rotor_formulas(
    coupling: Coupling = "triangular", lead: Lead = "pitch", *, shifted: bool = False
) -> GainFormulas:
    """The rig with its rotors: their equations, six states, and the K that places all of them, as SymPy objects.

    >>> f = rotor_formulas("axis-decoupled")
    >>> f.gain.shape, f.indices, f.gain[0, 1]
    ((2, 6), (3, 3), -b_12*d_20*tau_p/Delta)

    Args:
        coupling: structure of the closed loop.
        lead: the axis that leads where it is triangular.
        shifted: leave the basis' shift c a symbol.

    Raises:
        InvalidInputError: there is no such structure, or none with a shift.
    """
    from .symbolic.beyond import rotor_formulas as derive

    return derive(Structure(coupling, lead), shifted=shifted)


def observer_formulas(
    coupling: Coupling = "axis-decoupled", lead: Lead = "pitch", *, shifted: bool = False
) -> GainFormulas:
    """The observer's equations and its gain L by duality, as SymPy objects; with or without rotors it is the same.

    >>> observer_formulas().gain[0, 0]
    -nu_p - q_1 - q_2

    Args:
        coupling: structure of the estimate's errors.
        lead: the axis that leads where it is triangular.
        shifted: leave the basis' shift c a symbol.

    Raises:
        InvalidInputError: there is no such structure, or none with a shift.
    """
    from .symbolic.beyond import observer_formulas as derive

    return derive(Structure(coupling, lead), shifted=shifted)
