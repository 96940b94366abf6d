"""Classical margins of each motor's loop, from polynomials instead of a frequency grid."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan

import numpy as np

from .engine import engine
from .layout import MARGINS, POLYNOMIAL_WORKSPACE
from .loop import Loop


@dataclass(frozen=True)
class Margins:
    """Margins of the loop opened at one motor's input, the rest closed; None where unlimited.

    Attributes:
        gain_margin: smallest factor above 1 on the motor's gain that makes the loop unstable.
        gain_reduction_margin: largest factor below 1 that does.
        phase_margin: smallest phase lag or lead at a gain crossover that does, rad.
        delay_margin: smallest delay that does, s.
    """

    gain_margin: float | None
    gain_reduction_margin: float | None
    phase_margin: float | None
    delay_margin: float | None


def loop_margins(loop: Loop) -> tuple[Margins, Margins] | None:
    """Margins at the pitch and the yaw motor; None if the whole loop is unstable.

    Crossings are roots of polynomials of ω² (`kernels.frequency.margins`): there is no grid, so none can
    be missed, and integrators at ω = 0, where `control.margin` reports a gain margin of 0, are none.
    """
    if not loop.stable:
        return None
    table = np.empty((2, MARGINS))
    engine().margins(loop.polynomials, np.empty(POLYNOMIAL_WORKSPACE), table)
    pitch, yaw = ([None if isnan(v) else v for v in row] for row in table.tolist())
    return Margins(*pitch), Margins(*yaw)
