"""How often something may be done."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic


class Bucket:
    """Tokens: `rate` of them come back in a second of `clock`, up to `burst`."""

    __slots__ = ("_burst", "_clock", "_last", "_left", "_rate")

    def __init__(self, rate: float, burst: float, clock: Callable[[], float] = monotonic) -> None:
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._last = burst, clock()

    def take(self, *, in_advance: bool = False) -> float:
        """Takes one; returns 0, or after how many seconds there is one.

        Args:
            in_advance: take it even then: for who waits so long and then acts, not for who is refused.
        """
        wait = self.wait()
        if in_advance or not wait:
            self._left -= 1
        return wait

    def wait(self) -> float:
        """After how many seconds there is one to be taken; 0: now."""
        now = self._clock()
        self._left = min(self._burst, self._left + (now - self._last) * self._rate)
        self._last = now
        return max(0.0, (1 - self._left) / self._rate)
