"""Memory that kernels write into and nobody reads afterwards: kept between the calls, each thread its own."""

from __future__ import annotations

import threading

import numpy as np

from .kernels.layout import (
    CONSTANTS,
    FOLLOWED,
    FREQUENCIES,
    LADDER,
    LAG_WORKSPACE,
    LINEAR_WORKSPACE,
    MODES,
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    STRETCH,
    WHOLE_MINORS,
    WHOLE_ROWS,
    WORKSPACE,
)

FOLLOWED_TWICE = (2 * FOLLOWED[0], FOLLOWED[1])
"""Shape of the scratch array for figures: within the window, and beyond it."""


class _Scratch(threading.local):
    """As the kernels of an update take it, in their order."""

    def __init__(self) -> None:
        self.experiments = (
            np.empty(WORKSPACE),
            np.empty(LINEAR_WORKSPACE),
            np.empty(LADDER),
            np.empty(STRETCH),
            np.empty(FOLLOWED_TWICE),
            np.empty(CONSTANTS),
            np.empty(MODES, dtype=np.int64),
        )
        self.stability = np.empty(POLYNOMIAL_WORKSPACE)
        self.margins = (np.empty(POLYNOMIALS), self.stability)
        self.sensitivity = np.empty((3, FREQUENCIES))
        self.whole = (np.empty(WHOLE_ROWS), np.empty(WHOLE_MINORS))
        self.lag = np.empty(LAG_WORKSPACE)


scratch = _Scratch()
