"""The core's work off the event loop, in a small pool of threads."""

from __future__ import annotations

import asyncio
import gc
import logging
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from time import perf_counter
from typing import TypeVar

from threadpoolctl import threadpool_limits

from heli2dof_core.comparison import STRUCTURES
from heli2dof_core.compiled import warm_up
from heli2dof_core.engine import engine

from .kernels import KernelCompiler

_log = logging.getLogger(__name__)
T = TypeVar("T")


class Compute:
    """Runs functions of the core in threads, once the derivation is there.

    The first derivation imports SymPy and takes a second or two; `start` runs it in the background,
    so that the page is served meanwhile, and `run` waits for it. It does not wait for the compiled
    kernels, which come later (see `kernels`).
    """

    def __init__(self, threads: int = 2) -> None:
        self._pool = ThreadPoolExecutor(threads, thread_name_prefix="compute")
        self._slow = ThreadPoolExecutor(1, thread_name_prefix="slow")
        self._warm = threading.Event()
        self._failure: BaseException | None = None
        self._kernels = KernelCompiler()
        self._settled = False

    @property
    def ready(self) -> bool:
        """Whether the derivation is done."""
        return self._warm.is_set() and self._failure is None

    @property
    def settled(self) -> bool:
        """Whether all is derived and compiled: a common update then takes a millisecond or two."""
        return self._settled

    def waiting(self) -> dict[str, int]:
        """How much work waits for a thread, by pool."""
        pools = {"compute": self._pool, "slow": self._slow}
        return {name: pool._work_queue.qsize() for name, pool in pools.items()}  # pyright: ignore[reportPrivateUsage]

    def start(self) -> None:
        """Begins the derivation in the background.

        BLAS is kept to one thread: on matrices of six rows its own threads only wait for one
        another, which costs three times the processor time of the work itself.
        """
        threadpool_limits(limits=1, user_api="blas")
        threading.Thread(target=self._warm_up, name="derivation", daemon=True).start()

    async def run(self, function: Callable[..., T], *args: object) -> T:
        """`function(*args)` in the pool, after the derivation."""
        return await self._run(self._pool, function, args)

    async def run_slow(self, function: Callable[..., T], *args: object) -> T:
        """As `run`, for what takes seconds: in a thread of its own, so that no design waits for it."""
        return await self._run(self._slow, function, args)

    async def _run(self, pool: ThreadPoolExecutor, function: Callable[..., T], args: tuple[object, ...]) -> T:
        def work() -> T:
            self._warm.wait()
            if self._failure is not None:
                raise RuntimeError("the derivation failed at start") from self._failure
            return function(*args)

        return await asyncio.get_running_loop().run_in_executor(pool, work)

    def close(self) -> None:
        """Drops what waits and stops the pool's threads."""
        self._kernels.close()
        for pool in (self._pool, self._slow):
            pool.shutdown(wait=False, cancel_futures=True)

    def _warm_up(self) -> None:
        began = perf_counter()
        try:
            warm_up()
            _log.info("derivation ready after %.2f s", perf_counter() - began)
        except BaseException as error:
            self._failure = error
            _log.exception("the derivation failed")
        finally:
            self._warm.set()
        self._kernels.run()
        if self.ready and engine().compiled:
            warm_up(STRUCTURES)
            # What lives as long as the process is not looked through again: a full collection would
            # stop every client for an eighth of a second.
            gc.collect()
            gc.freeze()
            self._settled = True
