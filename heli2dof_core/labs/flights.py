"""A flight that is handed in: made again from its log, once it is sure that it is the student's own to hand in."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import Heli2DofError, InvalidInputError, within_field
from ..flight import FlightCourse, FlightLog, simulate_flight
from ..flight.events import DESIGN
from ..flight.scores import Score, score
from ..flight.task_flights import flown_by_design, require_task
from ..flight.tasks import TASKS
from ..request import Body
from .bodies import Flat, flat_body
from .by_hand import flown_by_hand
from .lab import Step
from .locks import forced, names_of

NOT_FLOWN = (
    "scenario.reference",
    "scenario.initial",
    "scenario.duration",
    "scenario.disturbance",
    "scenario.samples",
    "scenario.rtol",
    "scenario.digital.seed",
)
"""Parts of a design that a flight knows nothing of: set points and gusts are the task's."""

SHORTEST_TICK = 1e-4
"""Shortest sample time that a controller may have, s."""
_SPARE = 1.1


@dataclass(frozen=True)
class Flown:
    """A flight as it was found again.

    Attributes:
        course: all of it.
        score: what its task is judged by.
        checksum: of its log, by which a student can show later that a file is this very flight.
    """

    course: FlightCourse
    score: Score
    checksum: str

    @property
    def told(self) -> dict[str, Any]:
        """What is kept of it: not the log, which the student has, but what tells that a log is this one."""
        log = self.course.log
        return {
            "task": log.task,
            "seed": log.seed,
            "ticks": log.ticks,
            "checksum": self.checksum,
            "values": dict(self.score.values),
        }


def flown_again(
    body: Mapping[str, Any],
    task: str,
    design: Flat,
    free: Sequence[str],
    *,
    seed: int | None,
    wanted: Callable[[], None],
) -> Flown:
    """Makes a flight again.

    Args:
        body: the log, as it was handed in.
        task: that was to be flown.
        design: the design that was handed in, on the student's rig and with the step's locks.
        free: paths in which the flight's designs may differ from it, where changes in the air are allowed.
        seed: that its gusts shall have; None: any.
        wanted: called now and then; what it raises ends the work.

    Raises:
        InvalidInputError: the log was changed; it was flown with another rig or design; its task's gusts are missing.
        Heli2DofError: a design in it does not exist.
    """
    with within_field("flight"):
        log = FlightLog.read(body)
        _require_task(log, task, seed)
        for flown in _designs(log):
            _require_own(flown, design, free)
        course = simulate_flight(log, wanted=wanted)
        require_task(course)
        return Flown(course, score(course), str(body.get("checksum", "")))


def tried_flight(step: Step, body: Body) -> Body | None:
    """The log of a step's flight as it is flown to try a design; None where nothing is flown, or it cannot be.

    By the design alone; where a goal asks for hands, by a model of one.

    Args:
        step: whose goals say what is flown.
        body: the design, on the student's rig and with the step's locks.
    """
    goals = [goal.told() for goal in step.goals if goal.kind == "flight"]
    if not goals:
        return None
    flown = flown_by_hand if any(goal.get("hands") == "on" for goal in goals) else flown_by_design
    try:
        return flown(goals[0]["task"], body, goals[0].get("seed", 0)).body()
    except Heli2DofError:
        return None  # there is no such design, which its marks say


def _require_task(log: FlightLog, task: str, seed: int | None) -> None:
    """Refuses what was not flown for a task, before anything is computed."""
    own = TASKS[task]
    if log.task != task:
        raise InvalidInputError(
            "the flight is of another task", field="task", value=log.task, hint=f"Fly “{own.title}”."
        )
    if seed is not None and log.seed != seed:
        raise InvalidInputError(
            "the flight went through other gusts",
            field="seed",
            value=log.seed,
            hint="Fly it from the lab, which has gusts of its own.",
        )
    if log.ticks > _SPARE * own.duration / SHORTEST_TICK:
        raise InvalidInputError(
            f"the flight is longer than its task, {own.duration:g} s", field="ticks", value=log.ticks
        )


def _designs(log: FlightLog) -> list[Body]:
    return [log.design, *(event[2] for event in log.events if event[1] == DESIGN)]


def _require_own(body: Body, design: Flat, free: Sequence[str]) -> None:
    _, differing = forced(design, flat_body(body), [*NOT_FLOWN, *free])
    if not differing:
        return
    parts = ", ".join(names_of(differing))
    if free:
        raise InvalidInputError(
            f"the flight differs in what is fixed in this step: {parts}",
            field="design",
            hint="Fly it again, and change only what is free.",
        )
    raise InvalidInputError(
        f"the flight was flown with another design than the one handed in: {parts}",
        field="design",
        hint="Fly it with this design, or go back to the one that you flew.",
    )
