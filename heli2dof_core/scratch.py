"""Memory that kernels write into and nobody reads afterwards: kept between the calls, each thread its own."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, TypeVar

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

T = TypeVar("T")
FOLLOWED_TWICE = (2 * FOLLOWED[0], FOLLOWED[1])
"""Shape of the scratch array for figures: within the window, and beyond it."""

_KEPT = 8
"""Most lengths of responses whose memory a thread keeps."""


class _Scratch(threading.local):
    """As the kernels of an update take it, in their order."""

    def __init__(self) -> None:
        self._updates: dict[tuple[int, int], list[Any]] = {}
        self._blocks: dict[tuple[int, int], dict[str, Any]] = {}
        self.stability = np.empty(POLYNOMIAL_WORKSPACE)
        self.margins = (np.empty(POLYNOMIALS), self.stability)
        self.sensitivity = np.empty((3, FREQUENCIES))
        self.whole = (np.empty(WHOLE_ROWS), np.empty(WHOLE_MINORS))
        self.lag = np.empty(LAG_WORKSPACE)

    def update(self, order: int, samples: int) -> list[Any]:
        """Of `update`, for a loop with so many states, sampled so often."""
        return _kept(self._updates, (order, samples), _update)

    def block(self, key: tuple[int, int], make: Callable[[int, int], dict[str, Any]]) -> dict[str, Any]:
        """Of a result that nobody keeps, for a loop with so many states, sampled so often."""
        return _kept(self._blocks, key, make)


def _update(order: int, samples: int) -> list[Any]:
    return made(scratch_shapes(order, samples))


def _kept(known: dict[tuple[int, int], T], key: tuple[int, int], make: Callable[[int, int], T]) -> T:
    own = known.get(key)
    if own is None:
        if len(known) == _KEPT:
            known.pop(next(iter(known)))
        own = known[key] = make(*key)
    return own


scratch = _Scratch()
