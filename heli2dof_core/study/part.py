"""A part of a study, computed: a plain function of plain values, for whatever process it is sent to."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..engine import warm_up
from ..errors import CancelledError, Heli2DofError
from ..kernels.update_layout import DONE, FACTORS, FOUND_FIGURES, FOUND_OUTCOME, STABLE
from ..many import Found, Many
from ..on_rigs import OnRigs
from ..request import spec_of
from ..signals import Floats
from .study import NOMINAL, Segment, Task


class Part(NamedTuple):
    """What was found, a row for each pair, in the order of designs and of their rigs.

    Attributes:
        number: of the part.
        design, rig: their numbers; of the rigs 0 is the nominal one.
        exists: whether there is such a design.
        stable: whether the linear loop on this rig is.
        values: (rows, measures): NaN where there is none, ±∞ where it is unlimited.
    """

    number: int
    design: NDArray[np.int32]
    rig: NDArray[np.int32]
    exists: NDArray[np.bool_]
    stable: NDArray[np.bool_]
    values: Floats

    def rows(self, first: int, last: int) -> Part:
        """Those from one to before another."""
        own = slice(first, last)
        return Part(
            self.number,
            self.design[own],
            self.rig[own],
            self.exists[own],
            self.stable[own],
            self.values[own],
        )


def compute(task: Task, check: Callable[[], None] = lambda: None) -> Part:
    """The part.

    Args:
        task: what it is.
        check: called every few milliseconds; what it raises ends the work.
    """
    warm_up()  # the digits are those of the interpreted kernels, but not the time
    count = sum(own.last - own.first for own in task.segments)
    part = Part(
        task.number,
        np.empty(count, np.int32),
        np.empty(count, np.int32),
        np.zeros(count, np.bool_),
        np.zeros(count, np.bool_),
        np.full((count, len(task.measures)), np.nan),
    )
    at = 0
    for own in task.segments:
        check()
        rows = slice(at, at := at + own.last - own.first)
        part.design[rows], part.rig[rows] = own.design, np.arange(own.first, own.last)
        try:
            found, values = _computed(own, task, check)
        except CancelledError:
            raise
        except Heli2DofError:
            continue
        part.exists[rows] = found.rows[:, FOUND_OUTCOME] == DONE
        part.stable[rows] = part.exists[rows] & (found.rows[:, FOUND_FIGURES + STABLE] != 0.0)
        part.values[rows] = values
    return part


def _computed(own: Segment, task: Task, check: Callable[[], None]) -> tuple[Found, Floats]:
    spec = spec_of(own.body)
    if task.rigs is None:
        many = Many(spec, task.measures, unstable=task.unstable)
        rows = many.row[np.newaxis]
        found = many.run(rows, lambda _: spec, check)
        return found, many.values(rows, found)
    on_rigs = OnRigs(spec, task.measures, unstable=task.unstable)
    nominal = own.first == NOMINAL
    factors = task.rigs.factors(max(own.first - 1, 0), own.last - 1)
    if nominal:
        factors = np.vstack((np.ones((1, FACTORS)), factors))
    found = on_rigs.found(factors, check)
    return found, on_rigs.values_of(found)
