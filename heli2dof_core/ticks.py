"""Round numbers along an axis, in steps or in decades."""

from __future__ import annotations

from math import ceil, floor, log10


def ticks(low: float, high: float, most: int = 6) -> list[float]:
    """Round numbers from `low` to `high`, in steps of 1, 2 or 5 times a power of ten.

    >>> ticks(-3.1, 10.0)
    [-2.0, 0.0, 2.0, 4.0, 6.0, 8.0, 10.0]
    """
    raw = (high - low) / most
    power = 10.0 ** floor(log10(raw))
    step = next(power * factor for factor in (1, 2, 5, 10) if power * factor >= raw * (1 - 1e-9))
    first = ceil(low / step - 1e-9)
    return [step * k for k in range(first, floor(high / step + 1e-9) + 1)]


def decades(low: float, high: float) -> list[float]:
    """1, 2 and 5 times powers of ten from `low` to `high`, both above 0.

    >>> decades(0.3, 12)
    [0.5, 1.0, 2.0, 5.0, 10.0]
    """
    exponents = range(floor(log10(low)) - 1, ceil(log10(high)) + 1)
    known = (float(f"{m}e{e}") for e in exponents for m in (1, 2, 5))
    return [v for v in known if low * (1 - 1e-9) <= v <= high * (1 + 1e-9)]
