"""Weights for the quadratic methods from what one is ready to bear (Bryson's rule)."""

from __future__ import annotations

from math import radians

from .placement.method import Weights
from .scenario import Limits

ANGLE = radians(10)
"""Error that weighs as much as a motor at its limit, rad."""
RATE = 1.0
"""Rate that does, rad/s."""
PATIENCE = 0.5
"""Time for which that error may last, s."""


def bryson_weights(limits: Limits) -> Weights:
    """1/(largest acceptable value)² each: 10° of error, 1 rad/s, half a second of it, the motors' limits.

    Source: A. E. Bryson and Y.-C. Ho, Applied Optimal Control, 1975, section 5.2.
    """
    angle, rate, integral = 1 / ANGLE**2, 1 / RATE**2, 1 / (ANGLE * PATIENCE) ** 2
    return Weights(
        states=(angle, angle, rate, rate),
        inputs=(1 / limits.V_p**2, 1 / limits.V_y**2),
        integrals=(integral, integral),
    )
