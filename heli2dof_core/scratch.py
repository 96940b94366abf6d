"""Memory that kernels write into and nobody reads afterwards: kept between the calls, each thread its own."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np

from .kernels.layout import (
    FOLLOWED,
    FREQUENCIES,
    LAG_WORKSPACE,
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    WHOLE_MINORS,
    WHOLE_ROWS,
)
from .kernels.update_layout import made, scratch_shapes

FOLLOWED_TWICE = (2 * FOLLOWED[0], FOLLOWED[1])
"""Shape of the scratch array for figures: within the window, and beyond it."""

_KEPT = 8
"""Most lengths of responses whose memory a thread keeps."""


class _Scratch(threading.local):
    """As the kernels of an update take it, in their order."""

    def __init__(self) -> None:
        self._updates: dict[tuple[int, int], list[Any]] = {}
        self.stability = np.empty(POLYNOMIAL_WORKSPACE)
        self.margins = (np.empty(POLYNOMIALS), self.stability)
        self.sensitivity = np.empty((3, FREQUENCIES))
        self.whole = (np.empty(WHOLE_ROWS), np.empty(WHOLE_MINORS))
        self.lag = np.empty(LAG_WORKSPACE)

    def update(self, order: int, samples: int) -> list[Any]:
        """Of `update`, for a loop with so many states, sampled so often."""
        known = self._updates.get((order, samples))
        if known is None:
            if len(self._updates) == _KEPT:
                self._updates.pop(next(iter(self._updates)))
            known = self._updates[order, samples] = made(scratch_shapes(order, samples))
        return known


scratch = _Scratch()
