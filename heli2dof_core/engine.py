"""Which kernels answer: the compiled ones once they are ready, their interpreted twins before."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from threading import Lock
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Engine:
    """The hot loops, of one kind.

    Attributes:
        compiled: whether Numba has compiled them; else they are interpreted, some hundred times slower.
        integrate: see `kernels.dormand_prince.integrate`.
    """

    compiled: bool
    integrate: Callable[..., tuple[int, int, int, int, int]]

    @property
    def most_steps(self) -> int:
        """Steps after which a nonlinear response is given up: half a second's work, or two."""
        return 400_000 if self.compiled else 20_000


_ready: list[Engine] = []
_lock = Lock()


def engine() -> Engine:
    """The best kernels that are there now."""
    if not _ready:
        _ready.append(_load("interpreted"))
    return _ready[-1]


def warm_up() -> Engine:
    """Loads the compiled kernels from Numba's cache, or compiles them, which takes some ten seconds.

    Until it returns, other threads go on with the interpreted ones.
    """
    with _lock:
        if not engine().compiled:
            compiled = _load("kernels")
            _exercise(compiled)
            _ready.append(compiled)
    return engine()


def _load(package: str) -> Engine:
    home = f"heli2dof_core.{package}"
    return Engine(package == "kernels", import_module(f"{home}.dormand_prince").integrate)


def _exercise(kernels: Engine) -> None:
    """Calls each kernel once with the types that it is for: Numba compiles on the first call."""
    from heli2dof_core.kernels.rig import ALPHA, CONSTANTS, J_Y, LIMIT, MODES

    c, m = np.zeros(CONSTANTS), np.zeros(MODES, dtype=np.int64)
    c[[ALPHA, J_Y, LIMIT, LIMIT + 1]] = 1.0
    arguments: tuple[Any, ...] = (np.zeros(6), np.array([0.0, 1e-3]), c, m)
    kernels.integrate(*arguments, 1e-3, 1e-3, 10, np.empty((2, 6)))
