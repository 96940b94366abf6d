"""What a map's picture is drawn on: where places are, which values have which colours, what is marked."""

from __future__ import annotations

from hashlib import sha256

import numpy as np

from ..signals import Floats
from ..tables import number
from .colors import css, ramp
from .levels import levels_of
from .mapped import Mapped
from .regions import Grid

LEFT, TOP, SIDE = 66.0, 64.0, 480.0
"""Of the field, picture units; its height follows its ranges."""
_LEAST, _MOST = 240.0, 480.0
_ALIKE = 0.02
"""Share of the places that may be as good as the best, as it is shown: of more, none is worth a mark."""
_DARK = 0.62
"""Lightness below which lines and names on a colour are white."""


class Canvas:
    """One map's places and colours in the picture.

    Attributes:
        name: of its own, before what is referred to by a name: several pictures may stand in one page.
        height: of the field.
        higher: whether more is better.
        shown: values in the unit that people read, NaN where there is none, (ny, nx).
        levels: between which the colour changes, in that unit, ascending.
        wide: whether levels are multiples of each other.
        colors: in Oklab, one more than levels.
        best: the best place and its value; None where none is worth a mark.
        grid: the places in the picture.
    """

    def __init__(self, found: Mapped) -> None:
        self.found, self.plane = found, found.plane
        own = repr((found.values.tobytes(), found.plane.words, found.title)).encode()
        self.name = f"m{sha256(own).hexdigest()[:8]}"  # several pictures may stand in one page
        self.height = self._height()
        self.higher = found.measure.figure.better == "higher"
        self.shown = self._shown()
        self.levels, self.wide = levels_of(
            self.shown, higher=self.higher, whole=found.measure.figure.shown == "%"
        )
        colors = ramp(max(2, len(self.levels) + 1))[: len(self.levels) + 1]
        self.colors = colors[::-1] if self.higher else colors
        self.best = self._best()
        self.grid = Grid(self.across(found.x), self.up(found.y))

    @property
    def of_poles(self) -> bool:
        """Whether the plane is the s-plane."""
        return self.plane.of_pair and not self.plane.real

    def _height(self) -> float:
        if not self.plane.of_pair:
            return 0.75 * SIDE
        x, y = self.found.x, self.found.y
        return min(max(SIDE * float((y[-1] - y[0]) / (x[-1] - x[0])), _LEAST), _MOST)

    def _along(self, values: Floats | float, side: Floats) -> Floats:
        first, last = float(side[0]), float(side[-1])
        if self.plane.scale == "log":
            return np.log(np.asarray(values) / first) / np.log(last / first)
        return (np.asarray(values) - first) / (last - first)

    def across(self, values: Floats | float) -> Floats:
        """Where values of x are, picture units from the left."""
        return LEFT + SIDE * self._along(values, self.found.x)

    def up(self, values: Floats | float) -> Floats:
        """Where values of y are, picture units from the top."""
        return TOP + self.height * (1.0 - self._along(values, self.found.y))

    def inside(self, x: float, y: float) -> bool:
        """Whether a place is in the field."""
        over = ((x, self.found.x), (y, self.found.y))
        return all(side[0] <= value <= side[-1] for value, side in over)

    def _shown(self) -> Floats:
        """Values in the unit that people read, NaN where there is none."""
        figure, values = self.found.measure.figure, np.where(self.found.valid, self.found.values, np.nan)
        if figure.notation == "decibel":
            with np.errstate(divide="ignore", invalid="ignore"):
                values = 20.0 * np.log10(values)
            return np.where(np.isfinite(values), values, np.nan)
        values = values * figure.scale
        return np.abs(values) if figure.signed else values

    @property
    def unit(self) -> str:
        """That people read; empty without one."""
        figure = self.found.measure.figure
        if figure.notation in ("decibel", "seconds"):
            return {"decibel": "dB", "seconds": "s"}[figure.notation]
        return figure.shown or figure.unit

    def text_of(self, level: float) -> str:
        """How a level is written."""
        text = number(level, 6)
        return f"{text}°" if self.unit == "°" else text

    def ink(self, k: int) -> tuple[str, str]:
        """Of a line between two colours: its own, and that behind its value."""
        between = 0.5 * (self.colors[k] + self.colors[k + 1])
        return ("#fff" if between[0] < _DARK else "#1a2420"), css(between)

    def spots(self) -> list[tuple[float, float]]:
        """What is marked: the design itself and the best place."""
        best = self.best
        both = (self.found.here, None if best is None else best[:2])
        return [spot for spot in both if spot is not None and self.inside(*spot)]

    def _best(self) -> tuple[float, float, float] | None:
        """The best place, where few are as good."""
        best, shown = self.found.best, self.found.measure.shown
        if best is None:
            return None
        own = shown(best[2])
        alike = sum(shown(value) == own for value in self.found.values[self.found.valid].tolist())
        return best if alike <= 1 + _ALIKE * self.found.values.size else None
