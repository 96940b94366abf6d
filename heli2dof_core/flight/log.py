"""A flight's log: its design, its events by tick and some states on the way; from it the flight is made again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

from ..body import body_of
from ..checks import checked_number, shortly
from ..errors import ChangedLogError, InvalidInputError, within_field
from ..request import Body, spec_of
from ..tables import Shown
from .checksum import checksum
from .events import DESIGN, require_event, whole_number
from .rig import LARGEST_SEED, LONGEST, Event, Rig

FORMAT = 1
MOST_TICKS = 6_000_000
"""Of a flight: ten minutes at 0.1 ms."""
MOST_EVENTS = 100_000
MOST_DESIGNS = 5_000
CHECK_EVERY = 500
"""Ticks between two states that a log tells."""
MOST_CHECKS = MOST_TICKS // CHECK_EVERY + 2
AGREED = 1e-9
"""rad and rad/s: how far the states of a flight that is made again may lie from those that its log tells; of states
beyond 1 relative to them."""
LONGEST_NAME = 100
"""Characters of a task's name."""
DEEPEST = 8
"""Lists and objects within one another: a log is no deeper than the designs in it."""
_FIELDS = ("flight", "design", "ticks", "events", "seed", "checks", "task")


@dataclass(frozen=True, repr=False)
class FlightLog(Shown):
    """All that makes a flight.

    Attributes:
        design: a body of the REST calls: rig, design, and where the experiment begins.
        ticks: how long it was.
        events: (tick, word, values …) in order; of the word ``design`` the value is another body.
        seed: of the noise.
        checks: (tick, θ, ψ, θ̇, ψ̇): states on the way, rad and rad/s.
        task: name of the task that was flown, empty without one.
    """

    design: Body
    ticks: int
    events: tuple[Event, ...] = ()
    seed: int = 0
    checks: tuple[tuple[float, ...], ...] = ()
    task: str = ""

    @classmethod
    def read(cls, body: object) -> FlightLog:
        """From what a file or a request holds, whatever that is.

        Raises:
            InvalidInputError: it is none; what is refused is named.
            ChangedLogError: its checksum does not fit: something in it was changed.
        """
        own = dict(cast("Mapping[str, Any]", body)) if isinstance(body, Mapping) else {}
        told, kind = own.pop("checksum", None), own.get("flight")
        if kind != FORMAT or isinstance(kind, bool):
            raise _no_log(kind)
        _require_shallow(own)
        for name in own:
            if name not in _FIELDS:
                raise InvalidInputError(
                    f"a flight's log has no field {shortly(name)}", field=str(name)[:LONGEST_NAME], value=name
                )
        if told != _checksum(own):
            hint = "It was damaged or edited. Take the file as the flight has written it."
            raise ChangedLogError(
                "the log does not fit its checksum", field="checksum", value=told, hint=hint
            )
        ticks = whole_number(own.get("ticks"), "ticks", 1, MOST_TICKS)
        design, task = own.get("design"), own.get("task", "")
        if not isinstance(design, Mapping):
            raise InvalidInputError("a flight's design is an object", field="design", value=design)
        if not isinstance(task, str) or len(task) > LONGEST_NAME:
            raise InvalidInputError("a task is told by its name", field="task", value=task)
        return cls(
            design=dict(cast("Mapping[str, Any]", design)),
            ticks=ticks,
            events=_events(own.get("events", ()), ticks),
            seed=whole_number(own.get("seed", 0), "seed", 0, LARGEST_SEED),
            checks=_checks(own.get("checks", ()), ticks),
            task=task,
        )

    @classmethod
    def of(
        cls,
        rig: Rig,
        design: Body | None = None,
        checks: Sequence[Sequence[float]] | None = None,
        task: str = "",
    ) -> FlightLog:
        """Of what has been flown with a rig.

        Args:
            rig: that has flown.
            design: a body that stands for what it was made of; by default the smallest one.
            checks: states on the way; by default the last one.
            task: that was flown.

        Raises:
            InvalidInputError: nothing was flown, or more than a log holds.
        """
        if not rig.tick:
            raise InvalidInputError("nothing was flown", field="ticks", value=0, hint="Fly the rig first.")
        if rig.tick > MOST_TICKS or rig.time > LONGEST + rig.controller.tick:
            raise InvalidInputError(
                f"a log holds {LONGEST:g} s and {MOST_TICKS} ticks at most", field="ticks", value=rig.tick
            )
        if checks is None:
            checks = [] if rig.ended else [(rig.tick, *rig.y[:4].tolist())]
        return cls(
            body_of(rig.spec) if design is None else design,
            rig.tick,
            tuple(rig.events),
            rig.seed,
            tuple(tuple(check) for check in checks),
            task,
        )

    def summary(self) -> str:
        """How much it holds."""
        task = f", task {self.task}" if self.task else ""
        return f"{self.ticks} ticks, {len(self.events)} events{task}"

    def body(self) -> Body:
        """As JSON, with its checksum."""
        own: Body = {
            "flight": FORMAT,
            "design": self.design,
            "ticks": self.ticks,
            "events": [list(event) for event in self.events],
            "seed": self.seed,
            "checks": [list(check) for check in self.checks],
            "task": self.task,
        }
        return {**own, "checksum": checksum(own)}

    def first(self) -> Rig:
        """The rig before its first tick.

        Raises:
            Heli2DofError: the design does not exist.
        """
        with within_field("design"):
            return Rig(spec_of(self.design), seed=self.seed)


def _no_log(kind: object) -> InvalidInputError:
    if isinstance(kind, int) and kind > FORMAT:
        return InvalidInputError(
            f"the log is of format {shortly(kind)}, and this version of heli2dof reads format {FORMAT}",
            field="flight",
            value=kind,
            hint="Read it by a newer version.",
        )
    hint = "Take the file of a flight as it was written."
    return InvalidInputError("this is no flight's log", field="flight", value=kind, hint=hint)


def _checksum(body: Body) -> str:
    try:
        return checksum(body)
    except OverflowError:
        raise InvalidInputError("a number in the log is larger than any can be", field="flight") from None


def _require_shallow(body: Body) -> None:
    level: list[Any] = [body]
    for _ in range(DEEPEST):
        level = [part for whole in level for part in _within(whole)]
        if not level:
            return
    raise InvalidInputError(
        f"a flight's log is at most {DEEPEST} levels deep",
        field="flight",
        hint="Give the log as it was written.",
    )


def _within(whole: Any) -> list[Any]:
    parts = whole.values() if isinstance(whole, Mapping) else whole
    return [part for part in parts if isinstance(part, (Mapping, list, tuple))]


def _listed(value: Any, path: str, most: int) -> Sequence[Any]:
    if not isinstance(value, (list, tuple)):
        raise InvalidInputError("this is a list", field=path, value=value)
    own = cast("Sequence[Any]", value)
    if len(own) > most:
        raise InvalidInputError(f"at most {most} stand here", field=path, value=len(own))
    return own


def _checks(value: Any, ticks: int) -> tuple[tuple[float, ...], ...]:
    found, before = [], -1
    for n, check in enumerate(_listed(value, "checks", MOST_CHECKS)):
        path = f"checks[{n}]"
        own = [checked_number(part, path) for part in _listed(check, path, 5)]
        if len(own) < 5 or not before < own[0] <= ticks or own[0] != int(own[0]):
            raise InvalidInputError(
                "a check is a tick, later than that of the one before and within the flight, and θ, ψ, θ̇, ψ̇",
                field=path,
                value=check,
            )
        found.append(tuple(own))
        before = own[0]
    return tuple(found)


def _events(value: Any, ticks: int) -> tuple[Event, ...]:
    found: list[Event] = []
    before, designs = 0, 0
    for n, event in enumerate(_listed(value, "events", MOST_EVENTS)):
        path = f"events[{n}]"
        if len(_listed(event, path, 8)) < 3:
            raise InvalidInputError("an event is a tick, a word and its values", field=path, value=event)
        tick, word, *values = event
        tick = whole_number(tick, f"{path}[0]", 0, MOST_TICKS)
        if word == DESIGN:
            designs += 1
            if len(values) > 1 or not isinstance(values[0], Mapping):
                raise InvalidInputError("a change of design carries it", field=f"{path}[2]", value=values[0])
        else:
            require_event(tick, word, values, path)
        if not before <= tick <= ticks:
            raise InvalidInputError(
                "events stand in order, within the flight", field=f"{path}[0]", value=tick
            )
        found.append((tick, word, *values))
        before = tick
    if designs > MOST_DESIGNS:
        raise InvalidInputError(f"a flight has at most {MOST_DESIGNS} designs", field="events", value=designs)
    return tuple(found)
