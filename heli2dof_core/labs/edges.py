"""Edges of a design that questions ask for: how large a step or a gain may become before something gives way."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

from ..evaluate import loop_of
from ..spec import Spec

_SMALLEST, _LARGEST = 1e-3, 1e4
"""Of the gains that are tried, V/rad."""
_GROWTH = 1.2
_CLOSE = 1e-6


def largest_step(spec: Spec, trim: float, axis: str) -> float | None:
    """Largest step upwards whose first voltage, trim + kp · step, is within the own motor's limit.

    Args:
        spec: the design; its loops pair diagonally.
        trim: the own motor's voltage at rest, V.
        axis: pitch or yaw.

    Returns:
        rad; None without such a step.
    """
    kp = getattr(spec.outer, axis).kp
    limit = spec.limits.V_p if axis == "pitch" else spec.limits.V_y
    return (limit - trim) / kp if kp > 0 else None


def largest_gain(spec: Spec, axis: str) -> float | None:
    """Largest kp of one PI loop up to which the whole loop is stable, all else as it is.

    Returns:
        V/rad; None where it is unstable with the smallest gain already, or stable with every one.
    """

    def stable(kp: float) -> bool:
        own = replace(getattr(spec.outer, axis), kp=kp)
        return loop_of(replace(spec, outer=replace(spec.outer, **{axis: own}))).stable

    low = _SMALLEST
    if not stable(low):
        return None
    while stable(high := low * _GROWTH):
        low = high
        if low > _LARGEST:
            return None
    while high / low > 1 + _CLOSE:
        middle = sqrt(low * high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low
