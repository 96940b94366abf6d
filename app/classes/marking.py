"""Marking in threads and workers: in turn, and nobody is sent away because many hand in at once."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np

from heli2dof_core.errors import within_field
from heli2dof_core.labs import mark, student_rig

from ..jobs.compute import Caller, Compute, check_cancelled, current_caller
from .lab_library import KnownLab, frozen_lab

_AT_ONCE = 32
"""Marks of this server in the threads' queue at once; all others wait here, where nobody is refused."""
_QUICK = frozenset(("figure", "setting"))
"""Kinds of goals that take milliseconds; others go where what takes seconds is done."""


@dataclass(frozen=True)
class _Attempt:
    """What is handed in."""

    step: str
    seed: int
    body: Mapping[str, Any]
    answers: Mapping[str, Any]
    hints: tuple[int, ...]
    flight: Mapping[str, Any] | None = None


class Marker:
    """Marks attempts, as many at once as the threads' queue may hold."""

    def __init__(self, compute: Compute) -> None:
        self._compute = compute
        self._room = asyncio.Semaphore(_AT_ONCE)

    async def marked(
        self,
        known: KnownLab,
        step: str,
        *,
        seed: int,
        body: Mapping[str, Any],
        answers: Mapping[str, Any],
        hints: Sequence[int],
        flight: Mapping[str, Any] | None = None,
        whose: tuple[str, int] | None = None,
    ) -> dict[str, Any]:
        """The marks, as JSON.

        Args:
            known: the lab.
            step: a step of it.
            seed: of the student's rig.
            body: the design.
            answers: by the question's name.
            hints: those that were taken, 1-based.
            flight: the log of a flight, for goals on tasks in the air.
            whose: class and student, who wait in turn with others; the address where left out.
        """
        caller = current_caller.get()
        if whose is not None:
            current_caller.set(Caller(whose, caller.disconnected))
        kinds = {goal.get("kind", "figure") for goal in known.steps[step]["goals"]}
        run = self._compute.run if kinds <= _QUICK else self._compute.run_slow

        attempt = _Attempt(step, seed, body, answers, tuple(hints), flight)
        try:
            async with self._room:
                return await run(_marked, known.file, known.lab.name, attempt)
        finally:
            current_caller.set(caller)


def _marked(lab_text: str, name: str, attempt: _Attempt) -> dict[str, Any]:
    """The marks; takes the lab as text, since its goals hold functions, which cannot be sent."""
    lab, seed = frozen_lab(lab_text, name).lab, attempt.seed
    rig = student_rig(lab, seed)
    given = {"hints": attempt.hints, "seed": seed, "check": check_cancelled, "flight": attempt.flight}
    with within_field("design"):
        return told(mark(lab, attempt.step, rig, attempt.body, attempt.answers, **given).as_dict())


def told(value: Any) -> Any:
    """A value of the core as JSON has it; None within an object is left out."""
    if is_dataclass(value):
        pairs = ((field.name, getattr(value, field.name)) for field in fields(value))
        return {name: told(item) for name, item in pairs if item is not None}
    if isinstance(value, Mapping):
        return {str(name): told(item) for name, item in value.items() if item is not None}
    if isinstance(value, (list, tuple)):
        return [told(item) for item in value]
    if isinstance(value, np.generic):
        return value.item()
    return value
