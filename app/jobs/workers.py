"""What slow work is given to: the standard `Executor`, and beyond it parts, a time, and calling off what runs."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any

from .current import Report

UNLIMITED = 10.0**9
"""Seconds of a job for which no time is set: thirty years."""


class WorkerLostError(Exception):
    """The workers that had the job ended, one after the other; the job is to blame, or the machine."""

    retry_after = 10

    def __init__(self, message: str = "The process that did this ended twice before it was done.") -> None:
        super().__init__(message)


class Workers(Executor):
    """Processes, here or elsewhere, that do jobs.

    A job is a function at the top level of a module, with arguments and an outcome that can be pickled. A job
    whose worker ends is begun again once in another one, so it must leave nothing behind but its outcome.
    A future's `cancel` calls off a job that runs, too: it is told (`check_cancelled`), and later forced. The
    future then holds `concurrent.futures.CancelledError`, as soon as the worker is free again.
    """

    @property
    @abstractmethod
    def size(self) -> int:
        """Jobs that are done at once; may change."""

    @property
    def died(self) -> int:
        """Workers that have ended by themselves while they had a job, as far as that is known here."""
        return 0

    @abstractmethod
    def start(self) -> None:
        """Makes ready for the first job, in the background; a job that comes earlier waits."""

    @abstractmethod
    def submit_reporting(
        self, report: Report, seconds: float, fn: Callable[..., Any], /, *args: Any
    ) -> Future[Any]:
        """As `submit`.

        Args:
            report: is called with each part of the outcome, in a thread of this process.
            seconds: after which the job is given up.
            fn: what to call; where it is a generator function each value is a part, and the outcome None.
            *args: what with.

        Returns:
            The outcome. May raise `WorkerLostError`, and `heli2dof_core.errors.CancelledError` once the time is over.
        """
