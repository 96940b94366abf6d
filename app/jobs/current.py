"""The job that runs here, in whatever thread, process or machine: whether it is still wanted, where its parts go."""

from __future__ import annotations

import math
import sys
import traceback
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from dataclasses import dataclass
from time import monotonic
from typing import Any

from heli2dof_core.errors import CancelledError, Heli2DofError

from .packed import packed, unpacked

Report = Callable[[Any], None]
"""Takes a part of a job's outcome."""


@dataclass(frozen=True)
class _Current:
    cancelled: Callable[[], bool]
    until: float
    report: Report


_current: ContextVar[_Current | None] = ContextVar("current_job", default=None)


def check_cancelled() -> None:
    """Long work calls this now and then.

    Raises:
        CancelledError: nobody waits for its outcome any more, or it has taken too long.
    """
    current = _current.get()
    if current is not None and (current.cancelled() or monotonic() > current.until):
        raise CancelledError("cancelled")


def seconds_left() -> float:
    """Until the job that runs here is given up; infinite where it never is."""
    current = _current.get()
    return math.inf if current is None else max(0.0, current.until - monotonic())


def report(part: Any) -> None:
    """Long work tells how far it is, in parts of which each stands alone.

    Raises:
        CancelledError: see `check_cancelled`.
    """
    check_cancelled()
    current = _current.get()
    if current is not None:
        current.report(part)


def run_job(
    function: Callable[..., Any],
    args: tuple[Any, ...],
    cancelled: Callable[[], bool],
    report_part: Report,
    seconds: float,
) -> Any:
    """Does a job here.

    Args:
        function: what to call; where it is a generator function each of its values is a part.
        args: what with.
        cancelled: whether nobody wants it any more; asked by `check_cancelled`.
        report_part: takes each part.
        seconds: after which `check_cancelled` gives up.

    Returns:
        What the function returns.
    """
    token = _current.set(_Current(cancelled, monotonic() + seconds, report_part))
    try:
        outcome = function(*args)
        if isinstance(outcome, Iterator):
            for part in outcome:
                report(part)
            return None
        return outcome
    finally:
        _current.reset(token)


class JobError(RuntimeError):
    """Stands for an error that cannot be pickled; its message holds the other one's kind and words."""


def portable(error: BaseException) -> BaseException:
    """The error as another process gets it: with the traceback of this one as a note, and picklable."""
    lines = "".join(traceback.format_exception(error))
    if isinstance(error, Heli2DofError) and not _travels(error):
        error.value = str(error.value)[:200]  # it is told to people
    if not _travels(error):
        error = JobError(f"{type(error).__name__}: {error}")
    error.add_note(f"In the worker:\n{lines}")
    return error


def _travels(error: BaseException) -> bool:
    """Whether the error arrives as what it is."""
    try:
        return type(unpacked(packed(error))) is type(error)
    except Exception:
        return False


def is_portable(function: Callable[..., Any]) -> bool:
    """Whether another process finds the function: at the top level of a module that can be imported."""
    name = getattr(function, "__qualname__", "")
    module = sys.modules.get(getattr(function, "__module__", None) or "")
    known = module is not None and module.__name__ != "__main__"
    return known and bool(name) and getattr(module, name, None) is function
