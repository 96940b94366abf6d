"""Random numbers by their place: the page's own (static/kernel/random.js), digit by digit."""

from __future__ import annotations

from importlib import import_module
from typing import Any

_normal: Any = import_module("heli2dof_core.interpreted.normal")
_STEP = 0x9E3779B9
_ALL = 0xFFFFFFFF


def uniform(index: int, stream: int) -> float:
    """Uniform between −1 and 1, both excluded.

    Args:
        index: which of its stream.
        stream: each is independent of all others.
    """
    first = _normal.mixed((stream + 1) * _STEP & _ALL)
    return (2 * _normal.mixed(((index + 1) * _STEP & _ALL) + first & _ALL) + 1) / 2**32 - 1
