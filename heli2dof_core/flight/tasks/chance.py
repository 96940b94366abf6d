"""Random numbers by their place: the page's own (static/kernel/random.js), digit by digit."""

from __future__ import annotations

_STEP = 0x9E3779B9
_ALL = 0xFFFFFFFF


def _mixed(x: int) -> int:
    x ^= x >> 16
    x = (x * 0x85EBCA6B) & _ALL
    x ^= x >> 13
    x = (x * 0xC2B2AE35) & _ALL
    return x ^ (x >> 16)


def uniform(index: int, stream: int) -> float:
    """Uniform between −1 and 1, both excluded.

    Args:
        index: which of its stream.
        stream: each is independent of all others.
    """
    first = _mixed((stream + 1) * _STEP & _ALL)
    return (2 * _mixed(((index + 1) * _STEP & _ALL) + first & _ALL) + 1) / 2**32 - 1
