"""Which kernels answer: the compiled ones once they are ready, their interpreted twins before."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from .figures import AXIS_METRICS
from .kernel_cache import KernelCache
from .layout import (
    ALPHA,
    AUGMENTED,
    BOUND,
    CONSTANTS,
    COURSE,
    EXPERIMENT,
    FOLLOWED,
    FREQUENCIES,
    GAIN,
    J_Y,
    LADDER,
    LIMIT,
    LINEAR_WORKSPACE,
    MARGINS,
    MODES,
    MOTOR_METRICS,
    PI,
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    RECORDED_WORKSPACE,
    REFERENCE,
    SENSITIVITIES,
    SENSITIVITY,
    SETTINGS,
    START,
    STOP,
    STRETCH,
    TIME,
    WORKSPACE,
)
from .signals import fixed


@dataclass(frozen=True)
class Engine:
    """The hot loops, of one kind.

    Attributes:
        compiled: whether Numba has compiled them; else they are interpreted, some hundred times slower.
        others: see the functions of these names in `kernels`.
    """

    compiled: bool
    close: Any
    compose: Any
    run_linear: Any
    run_nonlinear: Any
    run_experiments: Any
    integrate: Any
    run_digital: Any
    run_recorder: Any
    run_segments: Any
    run_held: Any
    run_cloud: Any
    describe: Any
    stable: Any
    count_stable: Any
    margins: Any
    peaks: Any

    @property
    def most_steps(self) -> int:
        """Steps after which a nonlinear response is given up: half a second's work, or two."""
        return 400_000 if self.compiled else 20_000


_HOMES = {
    **dict.fromkeys(("close", "compose"), "loop"),
    **dict.fromkeys(("run_linear", "run_nonlinear", "run_experiments"), "experiment"),
    "integrate": "dormand_prince",
    "run_digital": "digital",
    **dict.fromkeys(("run_recorder", "run_segments", "run_held"), "recorded"),
    "run_cloud": "cloud",
    "describe": "polynomials",
    **dict.fromkeys(("stable", "count_stable"), "stability"),
    "margins": "frequency",
    "peaks": "peaks",
}
_ready: list[Engine] = []
_lock = Lock()


def engine() -> Engine:
    """The best kernels that are there now."""
    if not _ready:
        _ready.append(_load("interpreted"))
    return _ready[-1]


def warm_up(*, compiling: bool = True) -> Engine:
    """Loads the compiled kernels from Numba's cache, or compiles them, which takes some ten seconds.

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
            (cache.fill if compiling else cache.load)(partial(_exercise, compiled))
            _ready.append(compiled)
    return engine()


def kept() -> bool:
    """Whether Numba's cache says that it holds all kernels, for these sources and this machine."""
    return _cache_of(_load("kernels")).whole()


def _load(package: str) -> Engine:
    modules = {name: import_module(f"heli2dof_core.{package}.{name}") for name in set(_HOMES.values())}
    functions = {name: getattr(modules[home], name) for name, home in _HOMES.items()}
    if package == "interpreted":  # NumPy's scalars warn where a response grows without bound
        functions = {name: np.errstate(over="ignore", invalid="ignore")(f) for name, f in functions.items()}
    return Engine(compiled=package == "kernels", **functions)


def _cache_of(kernels: Engine) -> KernelCache:
    home = Path(__file__).parent
    sources = [*sorted((home / "kernels").glob("*.py")), home / "layout.py"]
    return KernelCache(Path(kernels.integrate.stats.cache_path), sources)


def _exercise(kernels: Engine) -> None:
    """Calls each kernel once with the types that it is for: Numba compiles on the first call.

    Afterwards none compiles again, which would take seconds: a call with other types is an error.
    """
    c, m, w, y = np.zeros(CONSTANTS), np.zeros(MODES, dtype=np.int64), np.zeros(WORKSPACE), np.zeros(6)
    c[[ALPHA, J_Y, LIMIT, LIMIT + 1]] = 1.0
    t, states, numbers = np.array([0.0, 1e-3]), np.empty((2, 6)), (1e-3, 1e-3, 10)
    A, B = fixed(-np.eye(4)), fixed(np.eye(4)[:, 2:])
    pairs, law, whole, driven = np.zeros((4, 2, 2)), np.empty((2, 6)), np.empty((6, 6)), np.empty((6, 2))
    K, P, F, by_reference = np.ones((2, 4)), *pairs[1:]
    integral = np.zeros((2, 2))
    settings = (PI, pairs[0], False, False)
    kernels.close(K, integral, 1.0, A, B, *settings, P, integral, F, law, by_reference, whole, driven)
    x = np.zeros(EXPERIMENT)
    x[REFERENCE : START + 2], x[BOUND : STOP + 1] = (1.0, 1.0, 0.0, 0.0), 1.0
    rig, trim = fixed(c[:GAIN]), fixed(c[:2])
    kernels.compose(rig, trim, 0.0, law, by_reference, integral, x, c, m)
    poles, rest = np.array([-1 + 0j]), fixed(c[:2])
    room = (np.empty(LADDER), np.empty(STRETCH), np.zeros((2 * FOLLOWED[0], FOLLOWED[1])))
    figures = np.empty((2, AXIS_METRICS)), np.empty((2, MOTOR_METRICS)), np.empty(COURSE)
    linear, voltages, v = np.empty((AUGMENTED, 2)), np.empty((2, 2)), np.empty(LINEAR_WORKSPACE)
    outer = (law, by_reference, whole, driven, poles)
    kernels.run_linear(0.0, *outer, x, t, 10, rest, v, *room, linear, voltages, *figures)
    raw, grid, f = np.empty((3, 6)), np.empty(3), room[-1]
    step = (c.copy(), m.copy(), poles, x, t, np.inf, *numbers, rest, w, raw, grid, f)
    kernels.run_nonlinear(*step, np.empty((6, 2)), voltages, *figures)
    loop = (rig, trim, 0.0, law, by_reference, integral, whole, driven, poles)
    scratch = (w, v, *room, c.copy(), m.copy(), raw, grid, rest)
    courses = (np.empty((1, AUGMENTED, 2)), np.empty((1, 6, 2)), np.empty((1, 2, 2, 2)))
    metrics = np.empty((1, 2, 2, AXIS_METRICS)), np.empty((1, 2, 2, MOTOR_METRICS)), np.empty((1, 2, COURSE))
    kernels.run_experiments(*loop, x[None], t, *numbers, *scratch, *courses, *metrics)
    kernels.integrate(y, t, c, m, *numbers, w, states)
    d = np.zeros(SETTINGS)
    d[TIME] = 1e-3
    scratch = (c.copy(), m.copy(), np.empty(4), np.empty((4, 6)), f)
    controller = (d, poles, x, np.zeros((3, 2)), np.inf)
    kernels.run_digital(y, t, c, m, *controller, *numbers, rest, w, *scratch, states, voltages, *figures)
    _exercise_recorded(kernels, (y, c, m, d), numbers)
    rigs, angles = c[None, :GAIN].copy(), np.empty((1, 2, 2))
    kernels.run_cloud(
        rigs, y, t, c, m, *numbers, w, y.copy(), c.copy(), m.copy(), states, angles, np.empty(1)
    )
    f = np.zeros(POLYNOMIALS)
    p = np.empty(POLYNOMIAL_WORKSPACE)
    kernels.describe(A, B, law, f)
    kernels.stable(f, p)
    kernels.count_stable(np.array([A]), np.array([B]), law, f, p, np.empty(1))
    kernels.margins(f, p, np.empty((2, MARGINS)))
    kernels.peaks(f, np.array([-1 + 0j]), np.empty((3, FREQUENCIES)), np.empty(SENSITIVITY))
    for name in _HOMES:
        getattr(kernels, name).disable_compile()


def _exercise_recorded(kernels: Engine, rig: tuple[Any, ...], numbers: tuple[float, ...]) -> None:
    y, c, m, d = rig
    t, pairs, scratch = np.array([0.0, 1e-3]), np.zeros((1, 2)), np.zeros(RECORDED_WORKSPACE)
    volts, bounds, slopes = np.zeros((2, 2)), np.array([[0, 2]]), np.empty((2, 2, SENSITIVITIES))
    kernels.run_segments(np.zeros((1, 4)), bounds, t, volts, c, 1e-2, scratch, volts.copy(), slopes)
    kernels.run_held(np.zeros(4), t, volts, c, 1e-2, scratch, np.empty((2, 4)))
    own = np.zeros(WORKSPACE), c.copy(), c.copy(), m.copy(), np.empty(2), np.empty((2, 6))
    kernels.run_recorder(
        y.copy(), c, m, d, *np.zeros((3, 1, 2)), *numbers, *own, pairs, np.empty((1, 6)), pairs.copy()
    )
