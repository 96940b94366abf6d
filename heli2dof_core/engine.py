"""Which kernels answer: the compiled ones once they are ready, their interpreted twins before."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from .layout import (
    ALPHA,
    AUGMENTED,
    AXIS_METRICS,
    CONSTANTS,
    FREQUENCIES,
    J_Y,
    LIMIT,
    MARGINS,
    MODES,
    MOTOR_METRICS,
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    SENSITIVITY,
    SETTINGS,
    TIME,
    WORKSPACE,
)


@dataclass(frozen=True)
class Engine:
    """The hot loops, of one kind.

    Attributes:
        compiled: whether Numba has compiled them; else they are interpreted, some hundred times slower.
        others: see the functions of these names in `kernels`.
    """

    compiled: bool
    respond: Any
    integrate: Any
    run_digital: Any
    run_cloud: Any
    trajectories: Any
    hold: Any
    share_at_limit: Any
    measure: Any
    describe: Any
    margins: Any
    peaks: Any

    @property
    def most_steps(self) -> int:
        """Steps after which a nonlinear response is given up: half a second's work, or two."""
        return 400_000 if self.compiled else 20_000


_HOMES = {
    "respond": "linear",
    "integrate": "dormand_prince",
    "run_digital": "digital",
    "run_cloud": "cloud",
    **dict.fromkeys(("trajectories", "hold", "share_at_limit", "measure"), "measures"),
    **dict.fromkeys(("describe", "margins", "peaks"), "frequency"),
}
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
    modules = {name: import_module(f"heli2dof_core.{package}.{name}") for name in set(_HOMES.values())}
    functions = {name: getattr(modules[home], name) for name, home in _HOMES.items()}
    return Engine(compiled=package == "kernels", **functions)


def _drop_stale_cache(kernels: Engine) -> None:
    """Empties Numba's cache where any kernel's source has changed since it was filled.

    Numba looks at the file of the function that it loads, not at those of the functions it calls.
    """
    home = Path(__file__).parent
    sources = [*sorted((home / "kernels").glob("*.py")), home / "layout.py"]
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
    """Calls each kernel once with the types that it is for: Numba compiles on the first call.

    Afterwards none compiles again, which would take seconds: a call with other types is an error.
    """
    c, m, w, y = np.zeros(CONSTANTS), np.zeros(MODES, dtype=np.int64), np.zeros(WORKSPACE), np.zeros(6)
    c[[ALPHA, J_Y, LIMIT, LIMIT + 1]] = 1.0
    t, states = np.array([0.0, 1e-3]), np.empty((2, 6))
    numbers = (1e-3, 1e-3, 10, w)
    kernels.integrate(y, t, c, m, *numbers, states)
    d = np.zeros(SETTINGS)
    d[TIME] = 1e-3
    scratch = (c.copy(), m.copy(), np.empty(4), np.empty((4, 6)))
    kernels.run_digital(y, t, c, m, d, np.zeros((3, 2)), np.inf, *numbers, *scratch, states, np.empty((2, 2)))
    rigs, pairs = c[None, :11].copy(), np.empty((1, 2, 2))
    kernels.run_cloud(rigs, y, t, c, m, *numbers, y.copy(), c.copy(), m.copy(), states, pairs, np.empty(1))
    M, start = np.eye(AUGMENTED), np.zeros((AUGMENTED, 2))
    kernels.respond(M, t[1], M[:2].copy(), np.empty((3 * AUGMENTED, AUGMENTED)), start, np.empty((2, 2)))
    angles, voltages = np.zeros((2, 2)), np.zeros((2, 2))
    kernels.trajectories(states, c, np.empty((6, 2)), voltages)
    kernels.hold(angles, voltages, 1.0)
    kernels.share_at_limit(voltages[0], 1.0)
    ends = (0.0, 0.0), (1.0, 1.0)
    kernels.measure(
        t, angles, voltages, *ends, np.zeros(2), np.empty((2, AXIS_METRICS)), np.empty((2, MOTOR_METRICS))
    )
    f, B = np.zeros(POLYNOMIALS), np.eye(4)[:, 2:].copy()
    kernels.describe(-np.eye(4), B, -np.ones((2, 4)), False, f)
    kernels.margins(f, np.empty(POLYNOMIAL_WORKSPACE), np.empty((2, MARGINS)))
    kernels.peaks(f, np.array([-1 + 0j]), np.empty(FREQUENCIES + 2), np.empty(SENSITIVITY))
    for name in _HOMES:
        getattr(kernels, name).disable_compile()
