"""Each motor's loop: its classical margins, from polynomials and no grid, and its frequency response."""

from __future__ import annotations

from math import isnan

import numpy as np

from .eigenvalues import resolvent
from .engine import engine
from .figures import MARGINS as FIGURES
from .figures import Margins
from .kernels.layout import MARGINS
from .loop import Loop
from .scratch import scratch
from .signals import AXES, Complexes, Floats
from .tables import Table, number


def loop_margins(loop: Loop) -> tuple[Margins, Margins] | None:
    """Margins at the pitch and the yaw motor; None if the whole loop is not stable.

    Crossings are roots of polynomials of ω² (`kernels.frequency.margins`): there is no grid, so none can
    be missed, and integrators at ω = 0, where `control.margin` may report a gain margin of 0 for a state-space model
    (not for its transfer function), are none.
    """
    if not loop.stable:
        return None
    table = np.empty((2, MARGINS))
    engine().margins(loop.polynomials, *scratch.margins, table)
    pitch, yaw = ([None if isnan(v) else v for v in row] for row in table.tolist())
    return Margins(*pitch), Margins(*yaw)


def margin_table(margins: tuple[Margins, Margins]) -> Table:
    """Both motors' margins; a dash where there is no limit."""
    cells = (
        (figure.head, *(number(getattr(own, name)) for own in margins)) for name, figure in FIGURES.items()
    )
    return Table.of("margins at the motors", ("", *AXES), cells)


def open_loop_response(loop: Loop, frequencies: Floats) -> Complexes:
    """L(jω) of the loop opened at each motor's input, the rest closed, shape (2, n); −1 is critical.

    With u = c [x, z] the motor's own law, b its input and A that of the whole loop, opening takes the law out
    again: L(s) = −c (sI − A + bc)⁻¹ b (Skogestad & Postlethwaite, Multivariable Feedback Control, 2005, 3.2).

    Args:
        loop: stable or not.
        frequencies: above 0, rad/s, shape (n,).
    """
    response = np.empty((2, len(frequencies)), dtype=np.complex128)
    for motor, law in enumerate(loop.voltage_from_state):
        b = loop.motors[:, [motor]]
        response[motor] = -(law @ resolvent(loop.A - b * law, b, frequencies))[:, 0]
    return response
