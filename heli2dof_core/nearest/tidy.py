"""Found designs with few digits: what a person would have typed, where it is as near and meets all the same."""

from __future__ import annotations

from itertools import product
from math import inf

import numpy as np

from ..kernels.update_layout import PI_GAINS, POLES, ROTOR_POLES
from ..signals import Floats
from .handles import Chart
from .judge import Judge
from .search import Best

DIGITS = (3, 4, 5, 6)
ALLOWANCE = 0.01
"""By how much farther a design with few digits may be, as a share of the distance."""
FARTHER = (1.0, 1.002, 1.005)
"""So many times as far: limits leave more room there."""
LEAST = 1e-4
"""Likewise, in all."""
MOST_COMBINATIONS = 8
"""Numbers that are rounded both ways; of more, those that move the most."""
_PLACES = (*range(POLES, POLES + 8), ROTOR_POLES, ROTOR_POLES + 1, *range(PI_GAINS, PI_GAINS + 4))


def tidied(judge: Judge, best: Best, within: float) -> None:
    """Puts the best's numbers where people would, and what has hardly moved back; keeps it where nothing does."""
    chart, z = best.chart, best.z
    if chart is None or z is None:
        return
    most = min(best.distance * (1.0 + ALLOWANCE) + LEAST, max(within, best.distance))
    still = np.where(np.abs(z) < 0.03 * np.max(np.abs(z), initial=0.0), 0.0, z)
    starts = [own * farther for own in (still, z) for farther in FARTHER]
    for digits in DIGITS:
        for start in starts:
            rows = np.array(_rounded(chart, judge.rows(chart, start[np.newaxis])[0], judge.many.row, digits))
            zs = chart.coordinates(np.array([chart.read(row) for row in rows]))
            away = chart.distances(zs)
            far = np.where(judge(rows, away).met, away, inf)
            i = int(np.argmin(far))
            if far[i] <= most:
                best.distance, best.z, best.row = float(far[i]), zs[i], rows[i]
                return


def _rounded(chart: Chart, row: Floats, own: Floats, digits: int) -> list[Floats]:
    """The row with what differs from the design's own numbers rounded down and up, in all combinations."""
    places = [i for i in _PLACES if abs(row[i] - own[i]) > 1e-9 * max(abs(own[i]), 1e-9)]
    base = row.copy()
    for i in _PLACES:
        if i not in places:
            base[i] = own[i]
    # of conjugates the upper one tells both
    upper = [i for i in places if not _is_conjugate(row, i)]
    choices = [_both(row[i], digits) for i in upper]
    order = sorted(
        range(len(upper)), key=lambda k: -abs(row[upper[k]] - own[upper[k]]) / max(abs(own[upper[k]]), 0.1)
    )
    for k in order[MOST_COMBINATIONS:]:
        choices[k] = (min(choices[k], key=lambda v, k=k: abs(v - row[upper[k]])),)
    found = []
    for values in product(*choices):
        made = base.copy()
        made[upper] = values
        for first in (POLES, POLES + 4):
            if row[first + 1]:
                made[first + 2], made[first + 3] = made[first], -made[first + 1]
        found.append(made)
    return found


def _is_conjugate(row: Floats, i: int) -> bool:
    """Whether a place is that of the lower one of two conjugates."""
    return any(row[first + 1] and i in (first + 2, first + 3) for first in (POLES, POLES + 4))


def _both(value: float, digits: int) -> tuple[float, ...]:
    """The value with so many digits, rounded down and up."""
    near = float(f"{value:.{digits - 1}e}")
    step = 10.0 ** (np.floor(np.log10(abs(value))) - digits + 1) if value else 0.0
    other = float(f"{near + (step if near < value else -step):.{digits - 1}e}")
    return (near, other) if step else (near,)
