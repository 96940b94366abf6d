"""A flight made again from its log."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..errors import ChangedLogError, InvalidInputError, Wanted, nobody_leaves, within_field
from ..frozen import Frozen
from ..kernels.flight_layout import FLIGHT_ROW
from ..request import spec_of
from ..signals import Floats
from .events import DESIGN
from .log import AGREED, FlightLog
from .rig import LONGEST, Event, Rig, Takeover
from .rows import FlightRows

_LOOK = 2000
"""Ticks between two looks whether somebody still waits: some milliseconds, of a wild rig a few seconds."""
_CHANGED = "The log was changed, or it is of another version of heli2dof."


@dataclass(frozen=True)
class Flown(Frozen):
    """How a flight went, beside its course.

    Attributes:
        ticks: that were flown.
        duration: s.
        takeovers: of its changes.
        samples: (tick, ticks in a sample): from which tick on controllers sample, and how often.
        limits: V_p and V_y at most, V, at the beginning.
        ended: why it ended by itself; empty if it did not.
        apart: how far the log's own states are from these at most, rad and rad/s; 0 without any.
        last: the row that the next tick would have, (FLIGHT_ROW,): the last state; None where there is no next one.
    """

    ticks: int
    duration: float
    takeovers: tuple[Takeover, ...]
    samples: tuple[tuple[int, int], ...]
    limits: tuple[float, float]
    ended: str
    apart: float
    last: Floats | None


@dataclass(frozen=True, repr=False)
class FlightCourse(FlightRows):
    """What a flight was, a row per tick: see `FlightRows`.

    Attributes:
        log: it was made from.
        flown: how it went.
    """

    log: FlightLog
    flown: Flown

    @property
    def takeovers(self) -> tuple[Takeover, ...]:
        """Of its changes."""
        return self.flown.takeovers

    @property
    def ended(self) -> str:
        """Why it ended before its log did; empty if it did not."""
        return self.flown.ended

    @property
    def apart(self) -> float:
        """How far the log's own states are from these at most, rad and rad/s; 0 without any."""
        return self.flown.apart


Take = Callable[[Floats, Floats], None]
"""Takes a stretch of a course as it was flown: times (n,), s, and rows (n, FLIGHT_ROW); it may keep both."""


def fly_log(log: FlightLog, take: Take, *, wanted: Wanted = nobody_leaves) -> Flown:
    """Makes a flight again, a stretch after the other, so that a long one need not be kept.

    Args:
        log: of it.
        take: gets each stretch of some thousand ticks, in order.
        wanted: called before each stretch and each change of design; what it raises ends the flight.

    Raises:
        ChangedLogError: a state that the log tells is not the one that its events lead to: either was changed.
        InvalidInputError: the flight is too long.
        Heli2DofError: a design does not exist.
    """
    rig = log.first()
    limits = rig.controller.spec.limits
    told = {int(check[0]): n for n, check in enumerate(log.checks)}
    marks = sorted({*told, *(event[0] for event in log.events), log.ticks})
    n, apart = 0, 0.0
    for mark in marks:
        while rig.tick < mark and not rig.ended:
            wanted()
            rows, t = rig.fly_ticks(min(mark - rig.tick, _LOOK))
            if rig.time > LONGEST + rig.controller.tick:
                raise InvalidInputError(
                    f"a flight lasts {LONGEST:g} s at most", field="ticks", value=log.ticks
                )
            take(t, rows)
        if rig.tick < mark:
            raise ChangedLogError(
                f"the flight ends by itself at tick {rig.tick}, and its log goes on",
                field="ticks",
                value=log.ticks,
                hint=_CHANGED,
            )
        if mark in told:
            apart = max(apart, _apart(log, told[mark], rig))
        while n < len(log.events) and log.events[n][0] == mark:
            if log.events[n][1] == DESIGN:
                wanted()
            with within_field(f"events[{n}][2]"):
                repeat(rig, log.events[n])
            n += 1
    return Flown(
        rig.tick,
        rig.time,
        tuple(rig.takeovers),
        tuple(rig.samples),
        (limits.V_p, limits.V_y),
        rig.ended,
        apart,
        rig.row(),
    )


def simulate_flight(log: FlightLog, *, wanted: Wanted = nobody_leaves) -> FlightCourse:
    """Makes a flight again, and keeps its whole course: 152 bytes a tick.

    Raises:
        Heli2DofError: as `fly_log`.
    """
    times, rows = [np.zeros(0)], [np.zeros((0, FLIGHT_ROW))]

    def keep(t: Floats, stretch: Floats) -> None:
        times.append(t)
        rows.append(stretch)

    flown = fly_log(log, keep, wanted=wanted)
    return FlightCourse(np.concatenate(times), np.concatenate(rows), log, flown)


def repeat(rig: Rig, event: Event) -> None:
    """Does to a rig what an event of a log says."""
    if event[1] == DESIGN:
        rig.change(spec_of(event[2]))
    else:
        rig.do(event[1], *event[2:])


def _apart(log: FlightLog, n: int, rig: Rig) -> float:
    """How far the n-th state that a log tells is from the rig's."""
    tick, *told = log.checks[n]
    pairs = list(zip(rig.y[:4].tolist(), told, strict=True))
    apart = max(abs(a - b) for a, b in pairs)
    if not all(abs(a - b) <= AGREED * max(1.0, abs(b)) for a, b in pairs):
        raise ChangedLogError(
            f"at tick {tick:g} the log's own state is not the one that its events lead to",
            field=f"checks[{n}]",
            value=apart,
            hint=_CHANGED,
        )
    return apart
