"""Figures of merit: what each is called, what it means, its unit, how it is shown and which way is better.

All that names a figure reads it here: tables of the library and of the command line, the laboratory report, the
descriptions of replies, and the page, by a module that `python -m tests.page_figures` makes of this one. A figure of
an axis is a column of the kernels' row (`kernels.figures`), in the order of `AxisMetrics`.
"""

from __future__ import annotations

from collections.abc import Mapping

from .figure import Figure, figures_of
from .flight import FLIGHT, FLIGHT_BY_AXIS
from .loop import DESIGN, LOOP, MARGINS, SENSITIVITY, Margins
from .response import (
    AXIS,
    AXIS_METRICS,
    MOTOR,
    NO_AXIS_METRICS,
    RESPONSE,
    STEP,
    AxisMetrics,
    MotorMetrics,
    axis_figures,
)

KINDS: Mapping[str, Mapping[str, Figure]] = {
    "axis": AXIS,
    "step": STEP,
    "motor": MOTOR,
    "margins": MARGINS,
    "sensitivity": SENSITIVITY,
    "loop": LOOP,
    "design": DESIGN,
}
"""All of a design: per stepped axis, per step, per motor, per motor's loop, of both loops, of the state feedback."""

__all__ = [
    "AXIS",
    "AXIS_METRICS",
    "DESIGN",
    "FLIGHT",
    "FLIGHT_BY_AXIS",
    "KINDS",
    "LOOP",
    "MARGINS",
    "MOTOR",
    "NO_AXIS_METRICS",
    "RESPONSE",
    "SENSITIVITY",
    "STEP",
    "AxisMetrics",
    "Figure",
    "Margins",
    "MotorMetrics",
    "axis_figures",
    "figures_of",
]
