"""The compiled kernels of a server: loaded from Numba's cache, which a process of its own fills where it must.

Compiling holds Python's lock for ten seconds and more, in which no drag would be answered. So a child
process compiles while the interpreted kernels answer; the server then loads what it left on the disk.
Where an earlier start has left everything there is no child. The server itself never compiles: what is
missing against expectation is an error in loading (`heli2dof_core.kernel_cache`), and the child's work.
"""

from __future__ import annotations

import atexit
import logging
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import heli2dof_core
from heli2dof_core.engine import engine, kept, warm_up
from heli2dof_core.kernel_cache import NotKeptError

_log = logging.getLogger(__name__)
COMPILE = "from heli2dof_core.engine import warm_up; warm_up()"
_FALLBACK = Path("/dev/shm")  # writable in read-only containers


def _nothing() -> None:
    """Where nobody waits for it."""


class KernelCompiler:
    """Brings the compiled kernels into this process, in the background."""

    def __init__(self) -> None:
        self._child: subprocess.Popen[bytes] | None = None
        self._closed = threading.Event()

    def run(self, whole: Callable[[], None] = _nothing, compiling: Callable[[], None] = _nothing) -> None:
        """Compiles and loads; whatever fails leaves the interpreted kernels in place, with a warning.

        Args:
            whole: is called as soon as other processes may load, too.
            compiling: is called before the child compiles, which takes minutes.
        """
        if engine().compiled:
            whole()
            return
        began = perf_counter()
        try:
            seed_cache()
            # Compiled twice where another server that starts on the same cache rewrites it while this one loads.
            ways = (self._loaded, self._compiled_and_loaded, self._compiled_and_loaded)
            if not any(way(whole, compiling) for way in ways) and not self._closed.is_set():
                raise RuntimeError("Numba's cache does not keep what was compiled")
        except Exception as error:
            _log.warning("the kernels stay interpreted, responses take twenty times longer: %s", error)
        else:
            if engine().compiled:
                _log.info("kernels ready after %.1f s", perf_counter() - began)

    def _loaded(self, whole: Callable[[], None], _compiling: Callable[[], None]) -> bool:
        """Loads what an earlier start has left, where all of it is there; this process never compiles."""
        if not kept():
            return False
        whole()
        return self._load()

    def _compiled_and_loaded(self, whole: Callable[[], None], compiling: Callable[[], None]) -> bool:
        if self._closed.is_set():
            return False
        compiling()
        command, environment = compiler()
        self._child = subprocess.Popen(command, env=environment)
        status = self._child.wait()
        if self._closed.is_set():
            return False
        if status:
            raise RuntimeError(f"the compiler's process ended with status {status}")
        whole()
        return self._load()

    def _load(self) -> bool:
        try:
            warm_up(compiling=False)
        except NotKeptError as error:
            _log.info("the kernels are compiled anew: %s", error)
            return False
        return True

    def close(self) -> None:
        """Ends the child process, if there still is one."""
        self._closed.set()
        if self._child is not None and self._child.poll() is None:
            self._child.terminate()


def compiler(code: str = COMPILE) -> tuple[list[str], dict[str, str]]:
    """Command and environment of a child that imports this process's own package, whose cache it fills.

    Not the one in the working directory: `make serve` runs the installed package in its checkout.
    """
    home = str(Path(heli2dof_core.__file__).parents[1])
    path = os.pathsep.join([home, *filter(None, [os.environ.get("PYTHONPATH")])])
    return [sys.executable, "-P", "-c", code], os.environ | {"PYTHONPATH": path}


def seed_cache() -> None:
    """Where NUMBA_CACHE_DIR cannot be written to, as in a read-only container, moves on to a copy.

    Numba does not even read a cache that it cannot write to. Must run before Numba is imported.

    Raises:
        OSError: there is no place to write to at all.
    """
    home = os.environ.get("NUMBA_CACHE_DIR")
    if not home or "numba" in sys.modules or os.access(home, os.W_OK):
        return
    copy = Path(tempfile.mkdtemp(prefix="heli2dof-kernels-", dir=_writable()))
    atexit.register(shutil.rmtree, copy, ignore_errors=True)
    if Path(home).is_dir():
        shutil.copytree(home, copy, dirs_exist_ok=True)
    os.environ["NUMBA_CACHE_DIR"] = str(copy)


def _writable() -> str:
    try:
        return tempfile.gettempdir()
    except FileNotFoundError:
        if os.access(_FALLBACK, os.W_OK):
            return str(_FALLBACK)
        raise
