"""Why not: the smallest move of poles or loops with which a design would meet what is required of it."""

from __future__ import annotations

from .answer import CLOSEST, FARTHEST, WITHIN, Move, Nearest, nearest
from .handles import GROUPS, HANDLES, Free, Handle, distance

__all__ = [
    "CLOSEST",
    "FARTHEST",
    "GROUPS",
    "HANDLES",
    "WITHIN",
    "Free",
    "Handle",
    "Move",
    "Nearest",
    "distance",
    "nearest",
]
