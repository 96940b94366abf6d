"""What Numba keeps of the kernels on disk: whether all of it is there, for these sources and this machine.

Numba looks at the file of the function that it loads, not at those of the functions that it calls, and says nothing
when it compiles what it did not find. So the cache is emptied where a source has changed, a seal tells that it is
whole, and who relies on the seal loads where compiling is an error.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path
from typing import Any
from uuid import uuid4


class NotKeptError(RuntimeError):
    """A kernel would have to be compiled: Numba's cache does not hold it, or not for this machine."""


class KernelCache:
    """Numba's cache of some sources.

    Args:
        folder: where Numba keeps it.
        sources: all files whose functions are compiled, or read while one is.
    """

    def __init__(self, folder: Path, sources: Sequence[Path]) -> None:
        self._folder, self._sources = folder, tuple(sources)
        self._checksum = _digest(*(source.read_bytes() for source in self._sources))
        self._stamp = folder / "heli2dof-kernels.sha256"
        machine = _machine()
        self._claim = {"sources": self._checksum, **machine}
        name = _digest(json.dumps(machine).encode())[:16]
        self._seal = folder / f"heli2dof-kernels.{sys.implementation.cache_tag}-{name}.json"

    def whole(self) -> bool:
        """Whether a process has compiled everything here, for these very sources, and all that it left is there."""
        try:
            sealed = json.loads(self._seal.read_bytes())
            return sealed == self._claim | {"files": self._contents()}
        except (OSError, ValueError):
            return False

    def load(self, exercise: Callable[[], None]) -> None:
        """Calls `exercise`, which calls each kernel once; Numba may load, but not compile.

        Raises:
            NotKeptError: it would have had to.
        """
        with _never_compiling():
            exercise()

    def fill(self, exercise: Callable[[], None]) -> None:
        """Calls `exercise`, which calls each kernel once: Numba loads or compiles it. Then seals the cache.

        What Numba cannot read, as after a crash, is made anew.
        """
        self._drop_stale()
        try:
            exercise()
        except Exception:
            if not self._files():
                raise
            self._clear()
            exercise()
        contents = json.dumps(self._claim | {"files": self._contents()}, indent=1)
        with suppress(OSError):  # it is only asked for to save time
            _write(self._seal, contents)

    def _drop_stale(self) -> None:
        """Empties the cache where any source has changed since it was filled."""
        if not self._stamp.is_file() or self._stamp.read_text() != self._checksum:
            self._clear()
            self._folder.mkdir(parents=True, exist_ok=True)
            _write(self._stamp, self._checksum)

    def _clear(self) -> None:
        for kept in [*self._files(), *self._folder.glob("heli2dof-kernels.*.json")]:
            kept.unlink(missing_ok=True)

    def _files(self) -> list[Path]:
        """Index files and machine code, of all Pythons."""
        return [kept for source in self._sources for kept in self._folder.glob(f"{source.stem}.*.nb[ci]")]

    def _contents(self) -> dict[str, str]:
        """Name and checksum of what this Python reads."""
        own = f".py{sys.version_info[0]}{sys.version_info[1]}{getattr(sys, 'abiflags', '')}."
        return {kept.name: _digest(kept.read_bytes()) for kept in sorted(self._files()) if own in kept.name}


def _machine() -> dict[str, str]:
    """All that the machine code depends on, besides its sources."""
    import llvmlite
    import numba
    from llvmlite import binding
    from numba import config as typed

    config: Any = typed  # made from the environment, unseen by type checkers
    features = config.CPU_FEATURES  # empty for a generic processor
    if features is None:
        features = binding.get_host_cpu_features().flatten()
    return {
        "python": sys.version,
        "numba": numba.__version__,
        "llvmlite": llvmlite.__version__,
        "system": binding.get_process_triple(),
        "processor": binding.get_host_cpu_name() if config.CPU_NAME is None else config.CPU_NAME,
        "features": features,
        "options": " ".join(f"{k}={v}" for k, v in sorted(os.environ.items()) if _matters(k)),
    }


def _matters(variable: str) -> bool:
    """Whether machine code may depend on an environment variable; where the cache lies does not matter."""
    return variable.startswith("NUMBA_") and variable != "NUMBA_CACHE_DIR"


@contextmanager
def _never_compiling() -> Iterator[None]:
    """Makes it an error where this thread compiles with Numba."""
    from numba.core import event

    own = threading.get_ident()

    class Refusing(event.Listener):
        def on_start(self, event: Any) -> None:
            if threading.get_ident() == own:
                raise NotKeptError(f"Numba's cache does not hold {event.data['dispatcher'].__name__}")

        def on_end(self, event: Any) -> None:
            pass

    with event.install_listener("numba:compile", Refusing()):
        yield


def _digest(*parts: bytes) -> str:
    return sha256(b"".join(parts)).hexdigest()


def _write(path: Path, text: str) -> None:
    """In one piece, since other processes read it meanwhile."""
    part = path.with_name(f"{path.name}.{uuid4().hex[:8]}")
    part.write_text(text)
    part.replace(path)
