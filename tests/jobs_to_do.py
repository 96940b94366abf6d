"""Jobs for tests, at the top level of a module as all jobs are."""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from time import sleep
from typing import NoReturn

from app.jobs.compute import check_cancelled, report
from heli2dof_core.engine import engine
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.systems.text import PastedError


def counted(most: int) -> Iterator[int]:
    """Parts 0, 1 … most − 1."""
    yield from range(most)


def told(most: int) -> str:
    """Reports 0, 1 … most − 1."""
    for k in range(most):
        report(k)
    return "the end"


def until_called_off() -> NoReturn:
    """Reports its process' number, then asks whether it is still wanted."""
    report(os.getpid())
    while True:
        check_cancelled()
        sleep(0.001)


def deaf() -> NoReturn:
    """Reports its process' number, and never asks."""
    report(os.getpid())
    while True:
        sleep(3600)


def until_there(path: str) -> int:
    """Reports its process' number, and returns it once there is such a file."""
    report(os.getpid())
    while not Path(path).exists():
        check_cancelled()
        sleep(0.001)
    return os.getpid()


def killed() -> NoReturn:
    """Ends its process, as the system does where memory is short."""
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError("it goes on")


def refused() -> NoReturn:
    """What the core refuses."""
    raise InvalidInputError("J_p must be positive", field="J_p", value=-1.0, hint="Give kg·m².")


def pasted() -> NoReturn:
    """An error whose constructor takes other arguments than its message."""
    raise PastedError("this bracket is never closed", 1, 5)


def unsendable() -> object:
    """An outcome that cannot be pickled."""
    return lambda: None


def of_size(count: int) -> int:
    """Has so many bytes for a moment."""
    return len(bytearray(count))


def kept(count: int, _bytes: list[bytearray] = []) -> int:  # noqa: B006 - it shall stay
    """Keeps so many bytes, and returns its process' number."""
    _bytes.append(bytearray(b"1") * count)
    return os.getpid()


def collecting() -> tuple[bool, int]:
    """Whether garbage is collected, and how many objects are not looked through for it."""
    return gc.isenabled(), gc.get_freeze_count()


def loaded() -> tuple[bool, bool]:
    """Whether kernels are compiled, and whether SymPy is there, before anything has asked for either."""
    return engine().compiled, "sympy" in sys.modules


def standing() -> tuple[int, int]:
    """Its process' niceness, and how much rather than others the system ends it where memory is short."""
    return os.getpriority(os.PRIO_PROCESS, 0), int(Path("/proc/self/oom_score_adj").read_text())
