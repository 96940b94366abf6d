"""Where the printed K really puts the poles: what unequal digits mean for the machine."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..frozen import Frozen
from ..parameters import Parameters
from ..plant import plant
from ..presets import preset
from ..signals import Complexes, Floats
from . import as_printed
from .printed import printed_gain, printed_poles


@dataclass(frozen=True)
class Outcome(Frozen):
    """The printed K on one plant.

    Attributes:
        plant: which, in words.
        poles: eigenvalues of A − BK, real ones first, the fastest first, rad/s.
        unrounded: the same with the unrounded gain of the printed formula.
    """

    plant: str
    poles: Complexes
    unrounded: Complexes


def consequence() -> tuple[Outcome, ...]:
    """The printed K from the plant that its formula implies to the rig of the manual."""
    computed = preset("paper-as-computed").parameters
    physical = computed.replaced({"B_y": 0.318})
    implied = plant(computed)
    B = implied.B.copy()
    B[3] *= computed.beta / computed.alpha  # α in all four entries, as Eqs. 21 and 22 imply
    return (
        _outcome(
            "as the printed formula implies: α in all of B, B = 0.8 on both axes", computed, implied.A, B
        ),
        _outcome(
            "with B's rows over their own inertias, B = 0.8 on both axes", computed, implied.A, implied.B
        ),
        _outcome("and with yaw's own damping, B_y = 0.318", computed, plant(physical).A, plant(physical).B),
        _outcome(
            "the rig of the manual: m = 1.3872, B_y = 0.318",
            computed,
            plant(preset().parameters).A,
            plant(preset().parameters).B,
        ),
    )


def _outcome(words: str, designed_for: Parameters, A: Floats, B: Floats) -> Outcome:
    unrounded = as_printed.number(as_printed.gain(), designed_for, printed_poles())
    return Outcome(words, *(_ordered(A - B @ K) for K in (printed_gain(), unrounded)))


def _ordered(closed: Floats) -> Complexes:
    found: Complexes = np.linalg.eigvals(closed).astype(np.complex128)
    return found[np.lexsort((-np.imag(found), np.real(found), np.imag(found) != 0))]
