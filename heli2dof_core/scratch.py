"""Memory that kernels write into and nobody reads afterwards: kept between the calls, each thread its own."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np

from .kernels.layout import (
    CONSTANTS,
    FOLLOWED,
    FREQUENCIES,
    LAG_WORKSPACE,
    MODES,
    MORE_CONSTANTS,
    MORE_MODES,
    PLAIN,
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    SIZES,
    WHOLE_MINORS,
    WHOLE_ROWS,
    WORKSPACE,
    exact_shapes,
)

FOLLOWED_TWICE = (2 * FOLLOWED[0], FOLLOWED[1])
"""Shape of the scratch array for figures: within the window, and beyond it."""


class _Scratch(threading.local):
    """As the kernels of an update take it, in their order."""

    def __init__(self) -> None:
        self._experiments = {len(size): _experiments(len(size)) for size in SIZES}
        self.stability = np.empty(POLYNOMIAL_WORKSPACE)
        self.margins = (np.empty(POLYNOMIALS), self.stability)
        self.sensitivity = np.empty((3, FREQUENCIES))
        self.whole = (np.empty(WHOLE_ROWS), np.empty(WHOLE_MINORS))
        self.lag = np.empty(LAG_WORKSPACE)

    def experiments(self, size: int) -> tuple[Any, ...]:
        """Of both models' responses, for a loop with so many states."""
        return self._experiments[size]


def _experiments(size: int) -> tuple[Any, ...]:
    plain = size == PLAIN
    return (
        np.empty(WORKSPACE),
        *map(np.empty, exact_shapes(size)),
        np.empty(FOLLOWED_TWICE),
        np.empty(CONSTANTS if plain else MORE_CONSTANTS),
        np.empty(MODES if plain else MORE_MODES, dtype=np.int64),
    )


scratch = _Scratch()
