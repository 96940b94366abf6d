"""Tasks as they are flown: by a design alone or by a hand that is a function, and proof that a log is of its task."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import numpy as np

from ..errors import InvalidInputError
from ..kernels.flight_layout import STATE
from ..request import Body, spec_of
from ..spec import Spec
from .course import FlightCourse
from .events import DESIGN
from .log import CHECK_EVERY, FlightLog
from .rig import Rig
from .scores import Scoring, score
from .tasks import TASKS, FlightTask, reach_of
from .tasks.task import EARLY, ticks_of

SET_POINTS = 0.02
"""s: how often set points follow what a task asks, where the design flies it alone."""
_OTHERS = ("gust", "push", "hung", "thrust", "stuck")
"""Words of what a task alone may do to the rig: a hand on the body would bring it to any mark."""


def task_named(name: str) -> FlightTask:
    """The task of a name.

    Raises:
        InvalidInputError: there is none.
    """
    if name not in TASKS:
        hint = f"Known are {', '.join(TASKS)}."
        raise InvalidInputError("there is no such task", field="task", value=name, hint=hint)
    return TASKS[name]


def fly_task(
    task: str,
    body: Body,
    seed: int = 0,
    hand: Callable[[Rig], None] | None = None,
    every: float = 0.0,
) -> FlightLog:
    """Flies a task: the design alone follows what it asks, or a hand does.

    Args:
        task: its name.
        body: the design, as a body of the REST calls.
        seed: of the gusts, and of the noise.
        hand: called at the first tick and then every `every` s (0: each tick), before it is flown; it does what it
            wants to the rig. Set points are then its own, too.
        every: s.

    Raises:
        Heli2DofError: there is no such task, or the design does not exist.
    """
    own, spec = task_named(task), spec_of(body)
    rig = Rig(spec, seed=seed)
    rig.do("reference", spec.theta_0, 0.0)
    plan, planned = list(own.plan(rig.controller.spec, seed)), 0
    reach, scoring = reach_of(spec), Scoring(own, spec)
    checks: list[tuple[float, ...]] = []
    due = 0.0
    while rig.time < own.duration - EARLY and not rig.ended and not scoring.done:
        while planned < len(plan) and rig.time > plan[planned][0] - EARLY:
            _, torques, length = plan[planned]
            rig.do("gust", *torques, ticks_of(length, rig.controller.tick))
            planned += 1
        if rig.time > due - EARLY:
            if hand is not None:
                hand(rig)
                due += every
            else:
                if not (rig.tick and len(own.marks) == 1):
                    rig.do("reference", *scoring.asked(rig.time, spec.theta_0, reach))
                due += SET_POINTS
        rows, t = rig.fly_ticks(_until(rig, own, plan[planned][0] if planned < len(plan) else inf, due))
        scoring.put(t, rows)
        if rig.tick % CHECK_EVERY == 0:
            checks.append((rig.tick, *rig.y[:4].tolist()))
    if not checks or checks[-1][0] != rig.tick:
        checks.append((rig.tick, *rig.y[:4].tolist()))
    return FlightLog.of(rig, body, checks, task)


def _until(rig: Rig, task: FlightTask, *times: float) -> int:
    """Ticks to the next of these times, and at most to the next check."""
    step = rig.controller.tick
    ahead = min(*times, task.duration) - EARLY - rig.time
    ticks = max(1, int(np.ceil(ahead / step))) if ahead > 0.0 else 1
    return min(ticks, CHECK_EVERY - rig.tick % CHECK_EVERY)


def flown_by_design(task: str, body: Body, seed: int = 0) -> FlightLog:
    """The task as the design flies it alone: what its ghost shows."""
    return fly_task(task, body, seed)


def require_task(course: FlightCourse) -> None:
    """Refuses a flight that is none of its log's task.

    Such as one with another beginning, other gusts, a hand on the body, another rig on the way, or an early end.

    Raises:
        InvalidInputError: it says what is missing, or what is too much.
    """
    log = course.log
    task, spec = task_named(log.task), spec_of(log.design)
    hint = "Fly the task again from its beginning."
    start = np.array([spec.theta_0, 0.0, 0.0, 0.0])
    travel = inf if spec.limits.theta is None else spec.limits.theta
    start[0] = min(max(start[0], -travel), travel)
    if np.abs(course.rows[0, STATE : STATE + 4] - start).max() > 1e-9:
        raise InvalidInputError(
            "this flight does not begin at rest at the operating point",
            field="design",
            value=log.task,
            hint=hint,
        )
    own = [event for event in log.events if event[1] in _OTHERS]
    end = course.flown.duration
    ticks = np.diff(course.t, append=end)
    wanted = []
    for time, torques, length in task.plan(spec, log.seed):
        tick = int(np.searchsorted(course.t, time - EARLY, side="right"))
        if tick < len(course.t):
            wanted.append((tick, "gust", *torques, float(ticks_of(length, float(ticks[tick])))))
    if [_plain(event) for event in own] != [_plain(event) for event in wanted]:
        raise InvalidInputError(
            f"what acts on the rig is not what the task “{task.title}” has",
            field="events",
            value=len(own),
            hint=hint,
        )
    for n, event in enumerate(log.events):
        if event[1] == DESIGN and _rig(spec_of(event[2])) != _rig(spec):
            raise InvalidInputError(
                "a task is flown on one rig: its design may change in the air, the rig may not",
                field=f"events[{n}]",
                hint=hint,
            )
    if end < task.duration - 1.5 * ticks[-1] and not score(course).done:
        raise InvalidInputError(
            f"the task takes {task.duration:g} s, this flight {end:.1f} s",
            field="ticks",
            value=log.ticks,
            hint=hint,
        )


def _rig(spec: Spec) -> tuple[object, ...]:
    """What of a design is the rig's, and no choice of whoever flies it."""
    scenario = spec.scenario
    return (
        *(spec.parameters, spec.limits, spec.rotors, spec.friction),
        *(scenario.saturation, scenario.travel_stops, scenario.noises),
    )


def _plain(event: tuple[object, ...]) -> tuple[object, ...]:
    tick, word, *values = event
    return (tick, word, *(float(value) for value in values if isinstance(value, (int, float))))
