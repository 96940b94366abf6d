"""A process that loads everything once, has no threads, and is forked for each worker.

Numba with the kernels, SymPy with the derivation and the app are 400 MB and three seconds. Whoever is forked of
them has them at once and shares them. The serving process itself has threads and cannot be forked safely;
`multiprocessing`'s fork server is this, too, but needs a writable folder for its socket, does not tell what went
wrong while it loads, and runs the main script once more in every child.

It is asked over a socket: `FORK`, with the socket of the new worker as a file descriptor, is answered by the
process' number, `REAP` with a number by that process' status once it has ended. When the socket closes it ends.
"""

from __future__ import annotations

import gc
import logging
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
from collections.abc import Sequence
from importlib import import_module
from multiprocessing.connection import Connection
from pathlib import Path

import heli2dof_core

from .worker import serve

_log = logging.getLogger(__name__)
CAN_FORK = hasattr(os, "fork") and hasattr(socket, "send_fds") and sys.platform != "darwin"
"""Apple's libraries do not survive a fork; there, and on Windows, slow work stays in threads."""
FORK, REAP = 1, 2
_ASKED, _TOLD = struct.Struct("=ii"), struct.Struct("=i")
_UNKNOWN = -1000
"""Where a status is none."""
_LOADED = b"\x01"
_NICENESS = 5
"""Of the fork server, while it loads beside a server that starts."""
_USED_BY_MOST = ("scipy.optimize",)
"""What jobs import when they first need it, and most do: 11 MB once for all workers, not in each of them."""
_ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL")}
"""Threads would be lost in a fork, and on matrices of six rows they only wait for one another."""


class ForkServer:
    """The serving process' end of it; for many threads.

    Args:
        memory: bytes that each worker may have beyond what it has from the start.
        modules: that are imported before any worker is forked, besides the core and its derivation.
    """

    def __init__(self, memory: int, modules: Sequence[str] = ()) -> None:
        self._memory, self._modules = memory, tuple(modules)
        self._lock = threading.Lock()
        self._child: subprocess.Popen[bytes] | None = None
        self._control: socket.socket | None = None
        self._loaded = self._closed = False

    def start(self) -> None:
        """Starts it where it does not run; does not wait until it has loaded."""
        with self._lock:
            self._start()

    def fork(self) -> tuple[Connection, int]:
        """A new worker: what to talk to it by, and its process' number. Waits until everything is loaded.

        Raises:
            OSError: it cannot be started, or has been closed.
        """
        with self._lock:
            self._start()
            try:
                return self._fork()
            except OSError:  # it has ended, or is just ending and still looks alive
                self._end()
                self._start()
                return self._fork()

    def _fork(self) -> tuple[Connection, int]:
        own, workers = socket.socketpair()
        try:
            with workers:
                pid = self._asked(FORK, 0, workers.fileno())
        except BaseException:
            own.close()
            raise
        return Connection(own.detach()), pid

    def reap(self, pid: int) -> int | None:
        """How the worker has ended, as `subprocess` tells it; waits until it has. None if nobody knows any more."""
        with self._lock:
            try:
                status = self._asked(REAP, pid)
            except OSError:
                return None
        return None if status == _UNKNOWN else status

    def close(self) -> None:
        """Ends it; workers end by themselves when their sockets close."""
        self._closed = True
        child = self._child
        if child is not None:
            child.kill()  # unblocks whoever waits for it in `fork`
        with self._lock:
            self._end()

    def _start(self) -> None:
        if self._closed:
            raise ConnectionError("the workers are closed")
        if self._child is not None and self._child.poll() is None:
            return
        self._end()
        own, its = socket.socketpair()
        code = f"from {__name__} import main; main({its.fileno()}, {self._memory}, {self._modules})"
        path = os.pathsep.join([*_homes(), *filter(None, [os.environ.get("PYTHONPATH")])])
        with its:
            self._child = subprocess.Popen(
                [sys.executable, "-P", "-c", code],
                env=os.environ | _ONE_THREAD | {"PYTHONPATH": path},
                pass_fds=[its.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
            )
        if self._closed:  # meanwhile, so that `close` has not seen it
            self._child.kill()
        self._control, self._loaded = own, False

    def _asked(self, what: int, number: int, *descriptors: int) -> int:
        if self._control is None:
            raise ConnectionError("no fork server runs")
        if not self._loaded:
            if self._control.recv(1) != _LOADED:
                raise ConnectionError("the fork server ended while it was loading")
            self._loaded = True
        socket.send_fds(self._control, [_ASKED.pack(what, number)], list(descriptors))
        told = self._control.recv(_TOLD.size)
        if len(told) != _TOLD.size:
            raise ConnectionError("the fork server has ended")
        return _TOLD.unpack(told)[0]

    def _end(self) -> None:
        if self._control is not None:
            self._control.close()
            self._control = None
        if self._child is not None:
            self._child.kill()
            self._child.wait()
            self._child = None


def _homes() -> list[str]:
    """Folders of this process' own packages, whatever lies in the working directory."""
    here = Path(__file__).parents[__name__.count(".")]
    return list(dict.fromkeys((str(here), str(Path(heli2dof_core.__file__).parents[1]))))


def main(descriptor: int, memory: int, modules: Sequence[str]) -> None:
    """The fork server's own end: loads, then forks when asked, until the socket closes."""
    # A signal for the whole group, as Ctrl+C, is the serving process' to answer: who still computes may finish.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    os.nice(_NICENESS)
    # Nothing of what is loaded is garbage, and to look for some again and again takes a sixth of the time. Workers do
    # not look through it either: that would write to each object, and copy what they share.
    gc.disable()
    control = socket.socket(fileno=descriptor)
    _load(modules)
    control.sendall(_LOADED)
    while True:
        asked, descriptors, _, _ = socket.recv_fds(control, _ASKED.size, 1)
        if not asked:
            return
        what, number = _ASKED.unpack(asked)
        if what == REAP:
            control.sendall(_TOLD.pack(_status_of(number)))
            continue
        gc.freeze()
        pid = os.fork()
        if pid == 0:
            try:
                gc.enable()
                control.close()
                serve(Connection(descriptors[0]), memory)
            finally:
                os._exit(1)  # never back into this loop
        os.close(descriptors[0])
        control.sendall(_TOLD.pack(pid))


def _status_of(pid: int) -> int:
    """How a child has ended, waited for; `_UNKNOWN` where it is none of ours."""
    try:
        return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    except ChildProcessError:
        return _UNKNOWN


def _load(modules: Sequence[str]) -> None:
    """Everything that jobs need, so that no worker has to."""
    from heli2dof_core.compiled import warm_up as derive
    from heli2dof_core.couplings import STRUCTURES
    from heli2dof_core.engine import warm_up
    from heli2dof_core.kernel_cache import NotKeptError

    for module in (*modules, *_USED_BY_MOST):
        import_module(module)
    try:
        warm_up(compiling=False)
    except NotKeptError as error:
        _log.warning("workers compute with interpreted kernels: %s", error)
    derive(STRUCTURES)
