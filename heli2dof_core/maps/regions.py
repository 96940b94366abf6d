"""Regions and lines of a grid of values, as paths of a picture; the geometry is contourpy's."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from ..signals import Floats
from .mapped import Truths

if TYPE_CHECKING:
    from contourpy import ContourGenerator

_FAR = 1e300


class Grid:
    """Places in a picture.

    Args:
        x: of the columns, in the picture's units, (nx,).
        y: of the rows, (ny,).
    """

    def __init__(self, x: Floats, y: Floats) -> None:
        self._x, self._y = x, y

    def where(self, truths: Truths) -> str:
        """The region in which something is true: its edge lies halfway to the places where it is not."""
        if not np.any(truths):
            return ""
        return self._filled(truths.astype(float), 0.5, _FAR)

    def below(self, values: Floats, level: float) -> str:
        """The region of values up to `level`; all of them must be finite."""
        return self._filled(values, -_FAR, level)

    def above(self, values: Floats, level: float) -> str:
        """The region of values from `level` on; all of them must be finite."""
        return self._filled(values, level, _FAR)

    def lines(self, values: Floats, level: float) -> Iterator[Floats]:
        """The lines on which values are `level`, each (n, 2)."""
        for line in self._of(values).lines(level):
            if isinstance(line, np.ndarray):
                yield line

    def _of(self, values: Floats) -> ContourGenerator:
        from contourpy import FillType, LineType, contour_generator

        return contour_generator(
            self._x,
            self._y,
            values,
            fill_type=FillType.OuterOffset,
            line_type=LineType.Separate,
        )

    def _filled(self, values: Floats, low: float, high: float) -> str:
        found = self._of(values).filled(low, high)
        points, offsets = cast("tuple[list[Floats], list[NDArray[np.uint32]]]", found)  # by the fill type
        parts = []
        for outer, ends in zip(points, offsets, strict=True):
            for first, last in pairwise(ends.tolist()):
                parts.append(closed(outer[first:last]))
        return "".join(parts)


def closed(points: Floats) -> str:
    """A path around; its last point is its first."""
    return f"M{_joined(points[:-1])}Z"


def opened(points: Floats) -> str:
    """A path along."""
    return f"M{_joined(points)}"


def _joined(points: Floats) -> str:
    return "L".join(f"{x:.1f},{y:.1f}" for x, y in points.tolist())


def extended(values: Floats, known: Truths) -> Floats:
    """Values beyond the places where they are known: the mean of those neighbours that have one, ring by ring.

    So that colours reach to the edges of their region, which lie between the places. Where none is known all are 0.
    """
    if not np.any(known):
        return np.zeros(values.shape)
    table, there = np.where(known, values, 0.0), known.copy()
    while not np.all(there):
        total, count = np.zeros(table.shape), np.zeros(table.shape)
        padded, present = np.pad(np.where(there, table, 0.0), 1), np.pad(there, 1)
        ny, nx = table.shape
        for dy in range(3):
            for dx in range(3):
                total += padded[dy : dy + ny, dx : dx + nx]
                count += present[dy : dy + ny, dx : dx + nx]
        reached = ~there & (count > 0)
        table[reached] = total[reached] / count[reached]
        there |= reached
    return table
