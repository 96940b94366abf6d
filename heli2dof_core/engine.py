"""Which kernels answer: the compiled ones once they are ready, their interpreted twins before."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Engine:
    """The hot loops, of one kind.

    Attributes:
        compiled: whether Numba has compiled them; else they are interpreted, some hundred times slower.
        integrate: see `kernels.dormand_prince.integrate`.
        run_digital: see `kernels.digital.run`.
        run_cloud: see `kernels.cloud.run`.
    """

    compiled: bool
    integrate: Any
    run_digital: Any
    run_cloud: Any

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
            _drop_stale_cache(compiled)
            _exercise(compiled)
            _ready.append(compiled)
    return engine()


def _load(package: str) -> Engine:
    home = f"heli2dof_core.{package}"
    return Engine(
        compiled=package == "kernels",
        integrate=import_module(f"{home}.dormand_prince").integrate,
        run_digital=import_module(f"{home}.digital").run,
        run_cloud=import_module(f"{home}.cloud").run,
    )


def _drop_stale_cache(kernels: Engine) -> None:
    """Empties Numba's cache where any kernel's source has changed since it was filled.

    Numba looks at the file of the function that it loads, not at those of the functions it calls.
    """
    sources = sorted((Path(__file__).parent / "kernels").glob("*.py"))
    present = sha256(b"".join(source.read_bytes() for source in sources)).hexdigest()
    cache = Path(kernels.integrate.stats.cache_path)
    stamp = cache / "heli2dof-kernels.sha256"
    if not stamp.is_file() or stamp.read_text() != present:
        for source in sources:
            for kept in cache.glob(f"{source.stem}.*.nb[ci]"):
                kept.unlink(missing_ok=True)
        cache.mkdir(parents=True, exist_ok=True)
        stamp.write_text(present)


def _exercise(kernels: Engine) -> None:
    """Calls each kernel once with the types that it is for: Numba compiles on the first call."""
    from .kernels.digital import SETTINGS, TIME
    from .kernels.rig import ALPHA, CONSTANTS, J_Y, LIMIT, MODES

    c, m = np.zeros(CONSTANTS), np.zeros(MODES, dtype=np.int64)
    c[[ALPHA, J_Y, LIMIT, LIMIT + 1]] = 1.0
    t, states = np.array([0.0, 1e-3]), np.empty((2, 6))
    kernels.integrate(np.zeros(6), t, c, m, 1e-3, 1e-3, 10, states)
    d = np.zeros(SETTINGS)
    d[TIME] = 1e-3
    kernels.run_digital(
        np.zeros(6), t, c, m, d, np.zeros((3, 2)), np.inf, 1e-3, 1e-3, 10, states, np.empty((2, 2))
    )
    rigs, angles = c[None, :11].copy(), np.empty((1, 2, 2))
    kernels.run_cloud(rigs, np.zeros(6), t, c, m, 1e-3, 1e-3, 10, angles, np.empty(1))
