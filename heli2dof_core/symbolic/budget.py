"""Symbolic work on what somebody else wrote, which must end: how long it takes cannot be told beforehand.

SymPy has no way to be stopped, and a thread has none either. But it is plain Python, so that the interpreter's
profiling hook, which is the thread's own, is called every few microseconds, and may raise.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from time import thread_time
from types import FrameType
from typing import Any

from ..errors import InvalidInputError, Wanted, nobody_leaves

SECONDS = 3.0
"""Processor time that one input may take."""
EVERY = 1024
"""Calls between two looks at the clock."""


class _Over(BaseException):
    """Raised within SymPy, which catches exceptions of many kinds, but none of this."""

    def __init__(self, reason: Exception | None) -> None:
        super().__init__()
        self.reason = reason


@contextmanager
def within_budget(seconds: float = SECONDS, wanted: Wanted = nobody_leaves) -> Iterator[None]:
    """Whatever is computed in here, in this thread, ends after so much of its processor time.

    Args:
        seconds: of processor time.
        wanted: called now and then; what it raises ends the work, too.

    Raises:
        InvalidInputError: the time is over.
    """
    end, calls, before = thread_time() + seconds, 0, sys.getprofile()

    def look(_frame: FrameType, _event: str, _argument: Any) -> None:
        nonlocal calls
        calls += 1
        if calls % EVERY:
            return
        if thread_time() > end:
            raise _Over(None)
        try:
            wanted()
        except Exception as error:
            raise _Over(error) from error

    sys.setprofile(look)
    try:
        yield
    except _Over as over:
        if over.reason is not None:
            raise over.reason from None
        raise InvalidInputError(
            f"these matrices take longer than {seconds:g} s to compute with",
            field="A",
            hint="Give fewer letters: numbers for some of them, or one letter for a whole expression.",
        ) from None
    finally:
        sys.setprofile(before)
