"""Each motor's loop: its classical margins, from polynomials and no grid, and its frequency response."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isnan
from typing import Any

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
    pitch, yaw = table.tolist()
    return margins_in((margin_figures(pitch), margin_figures(yaw)))


def margin_figures(row: Sequence[float]) -> dict[str, float]:
    """A motor's margins as the kernel has filled them, by name; those without limit, NaN, are left out."""
    return {name: value for name, value in zip(FIGURES, row, strict=True) if not isnan(value)}


def margins_in(both: tuple[Mapping[str, float], Mapping[str, float]]) -> tuple[Margins, Margins]:
    """The figures of both motors as objects."""
    pitch, yaw = both
    return Margins(**{**_UNLIMITED, **pitch}), Margins(**{**_UNLIMITED, **yaw})


_UNLIMITED: dict[str, Any] = dict.fromkeys(FIGURES)


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
