"""`kernel`: Numba's compiler, or nothing where this file is loaded as part of `interpreted`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

if __name__.startswith("heli2dof_core.interpreted"):
    _compile: Callable[..., Any] | None = None
else:
    from numba import njit

    _compile = njit(cache=True, error_model="numpy", nogil=True)


def kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, compiled on its first call; or as it is."""
    return _compile(function) if _compile else function
