"""A task in the air as data: what is asked at which time, which gusts come, and what it is scored by."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import floor, inf
from typing import Any

from ...spec import Spec
from .chance import uniform

HIGHEST = 0.14
"""rad: what a task asks of pitch at most, from θ₀; less where the travel is short."""
ROOM = 0.6
"""Share of the travel from θ₀ to the farther stop that a task takes at most."""
REACHED = 0.035
"""rad: within so much of a mark it counts as reached (2°)."""
LANDED, AT_REST, RESTED = 0.0175, 0.0175, 1.0
"""rad, rad/s and s: how near to a mark, how slow and how long one rests that has landed (1°, 1°/s)."""
EARLY = 1e-6
"""s: a tick that begins no earlier than so much before a time counts as later."""


@dataclass(frozen=True)
class Mark:
    """What is asked at a time; between two it moves smoothly (cubic, at rest at both).

    Attributes:
        time: s.
        theta: pitch as a share of the task's `reach`, from θ₀.
        psi: yaw, rad.
    """

    time: float
    theta: float
    psi: float


@dataclass(frozen=True)
class FlightTask:
    """A task.

    Attributes:
        name, title: which.
        words: what is to be done, in one or two sentences.
        duration: s; the longest that it takes where it is done before.
        marks: what is asked, in order of time.
        figure: of the registry, by which stars are given; ``lower`` is better for all.
        stars: limits of 1, 2 and 3 stars, in the figure's unit; see `limits`.
        gusts: how many; each has a place in time of its own.
        strength: of their torques as a share of what a motor's limit would give.
        free: whether set points are the pilot's: the task only shows what it asks.
        ends: how it is done before its time: "" never, "landed" at rest at the last mark, "reached" at the last mark
            after all others in order.
        pilots: how many hands share it: 2 where one has pitch and the other yaw.
        per_square_volt: whether `stars` are of a rig whose motors' limits have squares that add up to 1 V², so that
            they do not depend on how many volts a rig's amplifiers have: V²s are then s of both limits.
    """

    name: str
    title: str
    words: str
    duration: float
    marks: tuple[Mark, ...]
    figure: str
    stars: tuple[float, float, float]
    gusts: int = 0
    strength: float = 0.0
    free: bool = True
    ends: str = ""
    pilots: int = 1
    per_square_volt: bool = False
    figures: tuple[str, ...] = field(default=())

    def asked(self, t: float, theta_0: float, reach: float) -> tuple[float, float]:
        """θ and ψ that are asked at a time, rad."""
        marks = self.marks
        n = 0
        while n < len(marks) - 1 and t >= marks[n + 1].time:
            n += 1
        here = marks[n]
        if self.ends or n == len(marks) - 1:
            return theta_0 + reach * here.theta, here.psi
        there = marks[n + 1]
        part = (t - here.time) / (there.time - here.time)
        part = part * part * (3.0 - 2.0 * part)
        theta = here.theta + part * (there.theta - here.theta)
        return theta_0 + reach * theta, here.psi + part * (there.psi - here.psi)

    def limits(self, spec: Spec) -> tuple[float, ...]:
        """Limits of 1, 2 and 3 stars on a rig, in the figure's unit."""
        unit = spec.limits.V_p**2 + spec.limits.V_y**2 if self.per_square_volt else 1.0
        return tuple(limit * unit for limit in self.stars)

    def plan(self, spec: Spec, seed: int) -> Iterator[tuple[float, tuple[float, float], float]]:
        """The task's gusts: when (s), the largest torques (N·m), and how long (s)."""
        pitch = abs(spec.parameters.K_pp) * spec.limits.V_p
        yaw = abs(spec.parameters.K_yy) * spec.limits.V_y
        for k in range(self.gusts):
            every = (self.duration - 4.0) / self.gusts
            time = 1.5 + every * (k + 0.25 + 0.25 * uniform(4 * k, seed))
            torques = (
                self.strength * pitch * uniform(4 * k + 1, seed),
                self.strength * yaw * uniform(4 * k + 2, seed),
            )
            yield time, torques, 0.8 + 0.4 * uniform(4 * k + 3, seed)


def reach_of(spec: Spec) -> float:
    """How far a task goes in pitch, rad, with its sign: towards the farther stop of the travel."""
    travel = inf if spec.limits.theta is None else spec.limits.theta
    sign = -1.0 if spec.theta_0 > 0.0 else 1.0
    return sign * min(HIGHEST, ROOM * (travel + abs(spec.theta_0)))


def ticks_of(seconds: float, step: float) -> int:
    """So many ticks of `step` s, one at least."""
    return max(1, floor(seconds / step + 0.5))


def told(task: FlightTask) -> dict[str, Any]:
    """The task as JSON, for pages and tools."""
    return {
        "name": task.name,
        "title": task.title,
        "words": task.words,
        "duration": task.duration,
        "marks": [[mark.time, mark.theta, mark.psi] for mark in task.marks],
        "figure": task.figure,
        "figures": [task.figure, *task.figures],
        "stars": [*task.stars],
        "gusts": task.gusts,
        "strength": task.strength,
        "free": task.free,
        "ends": task.ends,
        "pilots": task.pilots,
        "per_square_volt": task.per_square_volt,
    }
