"""What a flight is worth: the registry's figures of flights, taken while it is flown or from its whole course."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import hypot, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from ..figures import FLIGHT_BY_AXIS
from ..kernels.flight_layout import ON_STOP, STATE, VOLTAGE, WISH
from ..request import spec_of
from ..signals import Floats
from ..spec import Spec
from .tasks import TASKS, FlightTask, reach_of
from .tasks.task import AT_REST, EARLY, LANDED, REACHED, RESTED

if TYPE_CHECKING:
    from .course import FlightCourse
    from .log import FlightLog

BY_AXIS = frozenset(FLIGHT_BY_AXIS)
"""Names of the figures with a value per axis."""
_AXES = ("theta", "psi")
WITHIN = 0.0349065850398866
"""2° in rad."""


@dataclass(frozen=True)
class Score:
    """What a flight is worth.

    Attributes:
        values: by figure, in the registry's units; of those with a value per axis both by its name. What does not
            exist is missing.
        stars: 0 to 3 of its task; 0 without one.
        done: whether the task has come to its end.
    """

    values: Mapping[str, Any]
    stars: int
    done: bool

    def value(self, figure: str, axis: str | None = None) -> float | None:
        """One of them; None where there is none."""
        found = self.values.get(figure)
        return found.get(axis) if isinstance(found, dict) else found


class Scoring:
    """Takes a flight's figures while it goes on.

    Without a task what is asked are the flight's own set points.

    Attributes:
        done: whether the task has come to its end; what is put from then on does not count.
        ticks: that count so far.
    """

    def __init__(self, task: FlightTask | None, spec: Spec) -> None:
        """Before the first row."""
        self._task, self._theta_0, self._reach = task, spec.theta_0, reach_of(spec)
        self._limits = task.limits(spec) if task else ()
        self.done, self.ticks = False, 0
        self._squares, self._largest = [0.0, 0.0], [0.0, 0.0]
        self._within = self._effort = 0.0
        self._time, self._impacts, self._on_stop = 0.0, 0, 0.0
        self._mark, self._since, self._reached = 0, -1.0, None
        self._last: tuple[float, list[float]] | None = None
        self._error = (0.0, 0.0)

    def asked(self, t: float, theta_0: float, reach: float) -> tuple[float, float]:
        """θ and ψ that the task asks now, rad: where marks are reached in turn, the present one."""
        assert self._task is not None
        if self._task.ends:
            mark = self._task.marks[min(self._mark, len(self._task.marks) - 1)]
            return theta_0 + reach * mark.theta, mark.psi
        return self._task.asked(t, theta_0, reach)

    def put(self, t: Floats, rows: Floats) -> None:
        """A stretch of the course as it was flown: times (n,), s, and rows (n, FLIGHT_ROW)."""
        for time, row in zip(t.tolist(), rows.tolist(), strict=True):
            if self.done:
                return
            if self._last is not None:
                self._take(*self._last, time - self._last[0])
            self._last = (time, row)

    def end(self, time: float) -> None:
        """The last row has lasted until then, s."""
        if self._last is not None and not self.done:
            self._take(*self._last, time - self._last[0])
            self._last = None

    def _take(self, time: float, row: list[float], dt: float) -> None:
        """One row, which lasted `dt` s: plain floats, since NumPy takes five times as long for two of them."""
        task = self._task
        wanted = (row[WISH], row[WISH + 1]) if task is None else self.asked(time, self._theta_0, self._reach)
        pitch, yaw = row[STATE] - wanted[0], row[STATE + 1] - wanted[1]
        self._error = (pitch, yaw)
        self._squares[0] += pitch * pitch * dt
        self._squares[1] += yaw * yaw * dt
        self._largest[0] = max(self._largest[0], abs(pitch))
        self._largest[1] = max(self._largest[1], abs(yaw))
        if max(abs(pitch), abs(yaw)) <= WITHIN:
            self._within += dt
        V_p, V_y = row[VOLTAGE], row[VOLTAGE + 1]
        self._effort += (V_p * V_p + V_y * V_y) * dt
        if row[ON_STOP] != 0.0 and self._on_stop == 0.0:
            self._impacts += 1
        self._on_stop = row[ON_STOP]
        self._time, self.ticks = time + dt, self.ticks + 1
        if task is not None:
            self._follow(task, row, time + dt)

    def _follow(self, task: FlightTask, row: list[float], time: float) -> None:
        near = max(map(abs, self._error))
        if task.ends == "reached" and near <= REACHED:
            self._mark += 1
            if self._mark == len(task.marks):
                self._reached, self.done = time, True
        if task.ends == "landed":
            still = max(abs(row[STATE + 2]), abs(row[STATE + 3])) <= AT_REST and near <= LANDED
            if not still:
                self._since = -1.0
            elif self._since < 0.0:
                self._since = time
            elif time - self._since > RESTED - EARLY:
                self._reached, self.done = time, True
        if time > task.duration - EARLY:
            self.done = True

    def score(self, by_hand: float = 0.0) -> Score:
        """What it is worth so far; without `end` the last row is not counted, as nobody knows how long it lasts."""
        if self._time == 0.0:
            return Score({}, 0, False)
        rms = [sqrt(square / self._time) for square in self._squares]
        values: dict[str, Any] = {
            "flight_error_rms": dict(zip(_AXES, rms, strict=True)),
            "flight_error_max": dict(zip(_AXES, self._largest, strict=True)),
            "path_error": hypot(*rms),
            "time_within": self._within / self._time,
            "flight_effort": self._effort,
            "landing_error": max(map(abs, self._error)),
            "flight_impacts": float(self._impacts),
            "by_hand": by_hand,
        }
        if self._reached is not None:
            values["flight_time"] = self._reached
        return Score(values, self._stars(values), self.done)

    def _stars(self, values: Mapping[str, Any]) -> int:
        task = self._task
        if task is None or (task.ends and self._reached is None):
            return 0
        value = values.get(task.figure)
        return 0 if value is None else sum(value <= limit for limit in self._limits)


def scoring_of(log: FlightLog) -> Scoring:
    """Before the first row of a log's flight: by its task, or by its own set points."""
    return Scoring(TASKS.get(log.task), spec_of(log.design))


def score(course: FlightCourse) -> Score:
    """Of a flight that was made again: by its log's task, or by its own set points."""
    log, scoring = course.log, scoring_of(course.log)
    scoring.put(course.t, course.rows)
    scoring.end(course.flown.duration)
    edges = np.append(course.t, course.flown.duration)[: scoring.ticks + 1]
    return scoring.score(hand_share(log.events, edges))


def hand_share(events: Iterable[Sequence[Any]], edges: Floats) -> float:
    """Share of the time in which the controller was off.

    Args:
        events: of the flight's log.
        edges: when each tick that counts began, and when the last one ended, (N + 1,), s.
    """
    total, since, ticks = 0.0, None, len(edges) - 1
    for tick, word, *values in (*events, (ticks, "hands", 0.0)):
        if word != "hands":
            continue
        now = edges[min(tick, ticks)]
        total += 0.0 if since is None else now - since
        since = now if values[0] else None
    return float(total / (edges[-1] - edges[0])) if ticks > 0 else 0.0
