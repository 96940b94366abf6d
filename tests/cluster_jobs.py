"""Jobs for workers elsewhere: functions of a module, as they have to be."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from pathlib import Path

from app.jobs.current import check_cancelled, report
from heli2dof_core.errors import InvalidInputError
from tests.patience import PATIENCE


def where() -> int:
    return os.getpid()


def twice(value: int) -> int:
    return 2 * value


def refuse() -> None:
    raise InvalidInputError("this is too large", field="poles", value=7, hint="Make it smaller.")


def count(to: int) -> Iterator[int]:
    yield from range(to)


def told_then_returned(parts: int) -> str:
    for k in range(parts):
        report(k)
    return "whole"


def wait_until_unwanted(begun: str, ended: str) -> None:
    """Writes a file as it begins, and one as it is called off."""
    Path(begun).touch()
    deadline = time.monotonic() + PATIENCE
    try:
        while time.monotonic() < deadline:
            check_cancelled()
            time.sleep(0.01)
    finally:
        Path(ended).touch()


def die_once(marker: str) -> int:
    """Ends its worker the first time, as running out of memory does."""
    if not Path(marker).exists():
        Path(marker).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return os.getpid()


def always_die(marker: str) -> None:
    with Path(marker).open("a") as file:
        file.write("x")
    os.kill(os.getpid(), signal.SIGKILL)
