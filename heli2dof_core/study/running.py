"""A study, computed: parts handed to workers, kept as they come, begun again where a worker was lost."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from dataclasses import dataclass
from typing import Protocol

from .folder import Folder
from .part import Part, compute
from .problems import StudyError
from .study import Task

ATTEMPTS = 4
"""How often a part is begun before it is given up: a worker that it kills time and again is no accident."""
AHEAD = 2
"""Parts that wait for each worker beside the one that it computes, so that none is idle."""
PATIENCE = 0.2
"""Seconds between two looks whether the work is still wanted."""


class Workers(Protocol):
    """Where parts are computed.

    Attributes:
        lost: what a future raises whose worker was lost, so that its part is begun again.
    """

    lost: tuple[type[BaseException], ...]

    @property
    def size(self) -> int:
        """Parts at once, now."""
        ...

    def submit(self, function: Callable[[Task], Part], task: Task, /) -> Future[Part]:
        """As `concurrent.futures.Executor.submit`."""
        ...


@dataclass(frozen=True)
class Progress:
    """How far a study is.

    Attributes:
        pairs: of a design and a rig, done so far, those of earlier runs within.
        of: all.
        earlier: done by earlier runs.
        again: parts that were begun again, since their workers were lost.
    """

    pairs: int
    of: int
    earlier: int
    again: int


class Alone:
    """This process as the only worker."""

    lost: tuple[type[BaseException], ...] = ()
    size = 1

    def submit(self, function: Callable[[Task], Part], task: Task, /) -> Future[Part]:
        """Computes it at once."""
        future: Future[Part] = Future()
        try:
            future.set_result(function(task))
        except Exception as error:  # as an executor does
            future.set_exception(error)
        return future


class Pool:
    """An executor's workers, which is made anew where one of them dies.

    Args:
        make: an executor.
        size: how many workers it has.

    Attributes:
        executor: the present one.
    """

    lost: tuple[type[BaseException], ...] = (BrokenExecutor,)

    def __init__(self, make: Callable[[], Executor], size: int) -> None:
        self._make, self.size = make, size
        self.executor = make()

    def submit(self, function: Callable[[Task], Part], task: Task, /) -> Future[Part]:
        """As the executor does; on a new one where this one is broken already."""
        try:
            return self.executor.submit(function, task)
        except BrokenExecutor:
            self.executor.shutdown(wait=False, cancel_futures=True)
            self.executor = self._make()
            return self.executor.submit(function, task)

    def close(self) -> None:
        """Drops what waits, and waits for what is being computed."""
        self.executor.shutdown(wait=True, cancel_futures=True)


def run(
    folder: Folder,
    workers: Workers,
    tell: Callable[[Progress], None] = lambda _: None,
    check: Callable[[], None] = lambda: None,
) -> Progress:
    """Computes the parts that are not there yet.

    Whoever computes a part, its numbers are the same; so they are after a crash and on any number of workers.

    Args:
        folder: where they are kept.
        workers: that compute.
        tell: called at first and whenever a part is kept.
        check: called now and then; what it raises ends the work, and what is kept stays.

    Raises:
        StudyError: another process computes there, or a part has lost its worker time and again.
    """
    with folder.alone():
        return _run(folder, workers, tell, check)


def _run(
    folder: Folder, workers: Workers, tell: Callable[[Progress], None], check: Callable[[], None]
) -> Progress:
    study, done = folder.study, folder.done()
    waiting = deque(number for number in range(study.parts) if number not in done)
    earlier = sum(map(study.size, done))
    pairs, again = earlier, 0
    attempts: dict[int, int] = {}
    running: dict[Future[Part], int] = {}
    progress = Progress(pairs, study.pairs, earlier, again)
    tell(progress)
    try:
        while waiting or running:
            check()
            while waiting and len(running) < (1 + AHEAD) * max(workers.size, 1):
                number = waiting.popleft()
                attempts[number] = attempts.get(number, 0) + 1
                running[workers.submit(compute, study.task(number))] = number
                if isinstance(workers, Alone):
                    break
            finished, _ = wait(running, PATIENCE, FIRST_COMPLETED)
            lost = []
            for future in finished:
                number = running.pop(future)
                try:
                    part = future.result()
                except workers.lost as error:
                    lost.append((number, error))
                    continue
                folder.write(part)
                attempts.pop(number, None)
                pairs += study.size(number)
                progress = Progress(pairs, study.pairs, earlier, again)
                tell(progress)
            if lost:
                again += len(lost)
                _begin_again(lost, attempts, waiting)
    finally:
        for future in running:
            future.cancel()
    return progress


def _begin_again(
    lost: list[tuple[int, BaseException]], attempts: dict[int, int], waiting: deque[int]
) -> None:
    for number, error in sorted(lost, key=lambda own: own[0], reverse=True):
        if attempts[number] >= ATTEMPTS:
            raise StudyError(
                f"part {number} has lost its worker {ATTEMPTS} times: {error or type(error).__name__}",
                hint="Look whether the workers have memory enough. What is done is kept.",
            ) from error
        waiting.appendleft(number)
