"""Where contour lines are named: on their straight stretches, along them, clear of each other and of the edges."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import atan2, degrees, hypot

import numpy as np

from ..signals import Floats

APART = 46.0
"""Between two names, picture units."""


@dataclass(frozen=True)
class Label:
    """A name on a line.

    Attributes:
        x, y: of its middle.
        angle: of the line there, degrees, within ±90.
        level: which one it names.
    """

    x: float
    y: float
    angle: float
    level: int


class Labels:
    """Finds places for names, one line after the other.

    Args:
        box: left, top, right, bottom of where they may lie.
        kept: points that they keep clear of.
    """

    def __init__(self, box: tuple[float, float, float, float], kept: Iterable[tuple[float, float]]) -> None:
        self._box, self._taken = box, [*kept]

    def on(self, line: Floats, width: float, level: int) -> Label | None:
        """A label of this width on a line, (n, 2), where it is straightest; None where it has no room."""
        steps = np.hypot(*np.diff(line, axis=0).T)
        length = np.concatenate(([0.0], np.cumsum(steps)))
        if length[-1] < 1.6 * width:
            return None
        best, least = None, 1.25
        for middle in np.linspace(0.75 * width, length[-1] - 0.75 * width, 24).tolist():
            ends = [
                [float(np.interp(at, length, line[:, k])) for k in (0, 1)]
                for at in (middle - 0.5 * width, middle, middle + 0.5 * width)
            ]
            (x0, y0), (x, y), (x1, y1) = ends
            chord = hypot(x1 - x0, y1 - y0)
            bend = width / chord if chord else np.inf
            if bend < least and self._free(x, y, 0.5 * width):
                best, least = (x, y, atan2(y1 - y0, x1 - x0)), bend
        if best is None:
            return None
        x, y, angle = best
        self._taken.append((x, y))
        turned = (degrees(angle) + 90.0) % 180.0 - 90.0
        return Label(x, y, turned, level)

    def _free(self, x: float, y: float, half: float) -> bool:
        left, top, right, bottom = self._box
        inside = left + half < x < right - half and top + 8 < y < bottom - 8
        return inside and all(hypot(x - a, y - b) > APART for a, b in self._taken)
