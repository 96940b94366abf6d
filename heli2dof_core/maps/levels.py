"""Between which values a map changes colour: round numbers, few enough to be told apart."""

from __future__ import annotations

import numpy as np

from ..signals import Floats
from ..ticks import decades, ticks

BANDS = 11
"""Bands that are wanted, about."""
_LOW, _HIGH = 0.01, 0.93
"""Shares of all values that lie beyond the good and the bad end: outliers must not make the rest one colour."""
_WIDE = 30.0
"""From this ratio on levels are multiples of each other."""


def levels_of(values: Floats, *, higher: bool, whole: bool = False) -> tuple[list[float], bool]:
    """Levels, ascending, and whether they are multiples of each other; none where all values are alike.

    Args:
        values: in the unit that is shown; what is not finite does not count.
        higher: whether more is better.
        whole: whether no value is an outlier, as of shares.
    """
    known = values[np.isfinite(values)]
    if not known.size:
        return [], False
    shares = (0.0, 1.0) if whole else (1 - _HIGH, 1 - _LOW) if higher else (_LOW, _HIGH)
    least, most = (float(np.quantile(known, share)) for share in shares)
    if not most - least > 1e-9 * max(abs(least), abs(most)):
        return [], False
    wide = not whole and least > 0 and most / least > _WIDE
    levels = decades(least, most) if wide else ticks(least, most, BANDS)
    first, last = float(known.min()), float(known.max())
    return [own for own in (float(f"{level:.12g}") for level in levels) if first < own < last], wide
