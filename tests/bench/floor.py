"""The nonlinear kernel's floor: the same method in C, compiled here and now; a test holds it to the same numbers."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from heli2dof_core.simulation.nonlinear import NonlinearLoop

SOURCE = Path(__file__).with_name("floor.c")
FLAGS = ["-O3", "-march=native", "-ffp-contract=off", "-fPIC", "-shared", "-Wall", "-Wextra", "-Werror"]


def compiled() -> Callable[..., int]:
    """`integrate` of floor.c, by the system's C compiler."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "floor.so"
        subprocess.run(["cc", *FLAGS, str(SOURCE), "-lm", "-o", str(library)], check=True)
        function = ctypes.CDLL(str(library)).integrate
    pointer, number, count = ctypes.c_void_p, ctypes.c_double, ctypes.c_long
    function.argtypes = [pointer, pointer, count, pointer, pointer, number, number, count, pointer]
    function.restype = count
    return function


def call(
    function: Callable[..., int],
    system: NonlinearLoop,
    t: np.ndarray,
    states: np.ndarray,
    rtol: float,
    atol: float,
):
    """A call without arguments, as cheap as ctypes can make it."""
    y, modes = system.start.copy(), system.modes.copy()
    addresses = [a.ctypes.data for a in (y, t, system.constants, modes, states)]
    arguments = (*addresses[:2], len(t), *addresses[2:4], rtol, atol, 400_000, addresses[4])

    def run() -> int:
        y[:], modes[:] = system.start, system.modes
        return function(*arguments)

    return run
