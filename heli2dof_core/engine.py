"""Which kernels answer: the compiled ones once they are ready, their interpreted twins before."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from threading import Lock
from types import SimpleNamespace
from typing import Any

import numpy as np

from .kernel_cache import KernelCache


class Engine(SimpleNamespace):
    """The hot loops, of one kind: every kernel that is marked with `kernels.jit.entry_point`, by its name.

    Attributes:
        compiled: whether Numba has compiled them; else they are interpreted, some hundred times slower.
    """

    compiled: bool

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


def warm_up(*, compiling: bool = True) -> Engine:
    """Loads the compiled kernels from Numba's cache, or compiles them, which takes some two minutes.

    Until it returns, other threads go on with the interpreted ones.

    Args:
        compiling: whether it may compile, and leave a sign that the cache is whole.

    Raises:
        NotKeptError: it may not compile, and the cache does not hold everything.
    """
    with _lock:
        if not engine().compiled:
            compiled = _load("kernels")
            cache = _cache_of(compiled)
            (cache.fill if compiling else cache.load)(_exercise)
            _ready.append(compiled)
    return engine()


def kept() -> bool:
    """Whether Numba's cache says that it holds all kernels, for these sources and this machine."""
    return _cache_of(_load("kernels")).whole()


def interpreted() -> Engine:
    """The kernels as Python reads them, whatever is compiled."""
    return _load("interpreted")


def _load(package: str) -> Engine:
    home = import_module(f"heli2dof_core.{package}")
    for module in iter_modules(home.__path__, f"{home.__name__}."):
        import_module(module.name)
    functions = import_module(f"{home.__name__}.jit").ENTRIES
    if package == "interpreted":  # NumPy's scalars warn where a response grows without bound, or 0 divides
        ignored: Any = dict.fromkeys(("over", "invalid", "divide"), "ignore")
        functions = {name: np.errstate(**ignored)(f) for name, f in functions.items()}
    return Engine(compiled=package == "kernels", **functions)


def _cache_of(kernels: Engine) -> KernelCache:
    home = Path(__file__).parent
    sources = sorted((home / "kernels").glob("*.py"))
    return KernelCache(Path(kernels.integrate.stats.cache_path), sources)


def _exercise() -> None:
    """Calls each kernel once with all types that it is for: Numba compiles on the first call.

    Afterwards none compiles again, which would take seconds: a call with other types is an error.
    """
    jit = import_module("heli2dof_core.kernels.jit")
    for name, function in jit.ENTRIES.items():
        for example in jit.EXAMPLES[name]:
            function(*example())
    for function in jit.ENTRIES.values():
        function.disable_compile()
