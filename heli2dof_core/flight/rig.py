"""The rig in hand: it stands or flies, one steps it, pushes it, and changes its controller in the air."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np

from ..body import body_of
from ..checks import require_within
from ..engine import engine
from ..kernels.flight_layout import (
    ENDED_AS,
    FLIGHT_MEMORY,
    FLIGHT_ROW,
    HAS,
    MANUAL,
    NOISE,
    PHASE,
    REFERENCE,
    SEED,
    STATE,
    TICK,
    TOLD,
    TURN,
    TURN_FROM,
)
from ..kernels.layout import ENDED, MORE_MODES, OUT_OF_BOUNDS, OUT_OF_STEPS, REST, TRAVEL, WORKSPACE
from ..signals import Floats
from ..simulation.nonlinear import ABSOLUTE_TOLERANCE
from ..spec import Spec
from ..tables import Shown, number
from .controller import FLOWN, FlightController
from .events import DESIGN, act, keep_gust, nothing_acts, require_event, whole_number
from .rows import FlightRows

Event = tuple[Any, ...]
"""(tick, word, values …), as it stands in a log."""
TOLERANCE = 1e-8
"""Of the integration within a tick, relative; absolute a tenth of it."""
MOST_STEPS = 2000
"""Of the integrator in one tick: a rig that takes more has left what can be flown."""
LONGEST = 660.0
"""Longest flight, s."""
LARGEST_SEED = 2**32 - 1


@dataclass(frozen=True)
class Takeover:
    """How a controller took over in the air.

    Attributes:
        tick: when.
        jump: of V_p and V_y that remains, V.
        jump_without: what it would have been with the integrals as they were, V.
        bumpless: whether the integrals drive both motors, so that neither voltage need jump.
        time: s.
    """

    tick: int
    jump: tuple[float, float]
    jump_without: tuple[float, float]
    bumpless: bool
    time: float


class Rig(Shown):
    """The nonlinear rig under a design's digital controller, in steps.

    >>> import heli2dof_core as heli
    >>> rig = heli.Rig(heli.Spec.from_preset("quanser-2dof-manual"))
    >>> rig.do("reference", 0.0, 0.5)
    >>> rig.fly(1.0).theta.shape
    (500,)

    Attributes:
        spec: what it was made of.
        controller: that flies now, with the design that it is of.
        seed: of the noise on measured angles.
        events: all that has been done to it, in order: what a log keeps.
        takeovers: one for each change of the controller, and for each time that it was switched on again.
        samples: (tick, ticks in a sample) from which tick on each controller samples, and how often.
    """

    def __init__(self, spec: Spec, *, seed: int = 0) -> None:
        """At rest where the design's experiment begins.

        Args:
            spec: rig, design, and the start of its experiment.
            seed: of the noise on measured angles, 0 to 2³² − 1.

        Raises:
            Heli2DofError: the design does not exist, or the seed is none.
        """
        self.spec = spec
        self.seed = whole_number(_plain(seed), "seed", 0, LARGEST_SEED)
        self.controller = FlightController.of(spec)
        self.events: list[Event] = []
        self.takeovers: list[Takeover] = []
        self.samples: list[tuple[int, int]] = []
        self._start()

    def _start(self) -> None:
        own = self.controller
        self.u = nothing_acts()
        self.u[SEED] = self.seed
        self.y, self.s = np.zeros(len(FLOWN)), np.zeros(FLIGHT_MEMORY)
        self._free = np.zeros(MORE_MODES, dtype=np.int64)
        self._scratch = (np.zeros(WORKSPACE), np.empty_like(own.c), np.empty_like(own.c), np.zeros(2))
        self._course = np.empty((2, len(FLOWN)))
        self._before = 0.0
        """Time of the tick from which `_since` counts, s."""
        self._since = 0
        self._waiting: list[tuple[Any, ...]] = []
        engine().begin_flight(FLOWN, own.start, own.c, own.m, own.k, self.y, self.s, self._free)
        self._noise()
        self.samples.append((0, own.ticks_per_sample))
        theta, psi = own.spec.scenario.resolved(own.spec.theta_0)[:2]
        act(self.u, "reference", (theta, psi), 0, own.tick)

    def _noise(self) -> None:
        self.u[NOISE : NOISE + 2] = self.controller.spec.scenario.noises

    @property
    def tick(self) -> int:
        """Ticks flown."""
        return int(self.s[TICK])

    @property
    def time(self) -> float:
        """Seconds flown."""
        return self._before + (self.tick - self._since) * self.controller.tick

    @property
    def theta(self) -> float:
        """Pitch, rad."""
        return float(self.y[0])

    @property
    def psi(self) -> float:
        """Yaw, rad."""
        return float(self.y[1])

    @property
    def rates(self) -> tuple[float, float]:
        """θ̇ and ψ̇, rad/s."""
        return float(self.y[2]), float(self.y[3])

    @property
    def volts(self) -> tuple[float, float]:
        """V_p and V_y that the motors have had since the last sample, V."""
        return float(self.s[HAS]), float(self.s[HAS + 1])

    @property
    def reference(self) -> tuple[float, float]:
        """Set points of θ and ψ now, rad."""
        now = (
            self.u[REFERENCE : REFERENCE + 2]
            + (self.tick - self.u[TURN_FROM]) * self.controller.tick * self.u[TURN : TURN + 2]
        )
        return float(now[0]), float(now[1])

    @property
    def ended(self) -> str:
        """Why it flies no more; empty while it does."""
        how = int(self.s[ENDED_AS])
        if how == ENDED:
            return ""
        return (
            "It has turned more than 150 times."
            if how == OUT_OF_BOUNDS
            else "Its course cannot be followed any more."
        )

    def summary(self) -> str:
        """When, where, and under which voltages; why it flies no more."""
        angles = "{}°, {}°".format(*(number(degrees(own)) for own in (self.theta, self.psi)))
        volts = "{} V, {} V".format(*map(number, self.volts))
        return f"at {number(self.time)} s, θ, ψ = {angles}, V_p, V_y = {volts}. {self.ended}".rstrip(". ")

    def row(self) -> Floats | None:
        """The row of the course that the next tick would have, (FLIGHT_ROW,); nothing is flown.

        None where there is no next tick. What waits for it, as a new controller, does not show in the row yet.
        """
        if self.ended:
            return None
        own, (w, scratch, plant, grid), rows = self.controller, self._scratch, np.zeros((1, FLIGHT_ROW))
        engine().fly(
            FLOWN, self.y.copy(), self.s.copy(), self._free.copy(), own.c, own.m, own.k, own.estimated, self.u, 1,
            TOLERANCE, ABSOLUTE_TOLERANCE * TOLERANCE, MOST_STEPS, w, scratch, plant, grid, self._course, rows,
        )  # fmt: skip
        return rows[0] if np.isfinite(rows).all() else None

    def do(self, word: str, *values: float) -> None:
        """Something happens now: one of `events.WORDS`, until something else of its kind does.

        Raises:
            InvalidInputError: there is no such word, or a value is none of it.
        """
        own = [_plain(value) for value in values]
        require_event(self.tick, word, own, "event")
        self._do(word, own)

    def _do(self, word: str, values: Sequence[float]) -> None:
        self.events.append((self.tick, word, *map(float, values)))
        before, hands = self.u.copy(), self.u[MANUAL]
        act(self.u, word, values, self.tick, self.controller.tick)
        if hands != 0.0 and self.u[MANUAL] == 0.0:
            self._later(self._waiting[0][0] if self._waiting else self.controller, before)

    def change(self, spec: Spec) -> None:
        """Another design flies on, from the controller's next sample on, without a jump where that can be.

        Raises:
            Heli2DofError: the design does not exist; the old one flies on.
        """
        new = FlightController.of(spec)
        self.events.append((self.tick, DESIGN, body_of(spec)))
        self._later(new, self.u.copy())

    def _later(self, new: FlightController, before: Floats) -> None:
        """`new` takes over at the next sample from what acted `before`."""
        self._waiting = [(new, self._waiting[0][1] if self._waiting else before)]

    @property
    def _until_sample(self) -> int:
        """Ticks to the controller's next sample."""
        return self.controller.ticks_per_sample - int(self.s[PHASE])

    def _settle(self) -> None:
        """Who waits takes over where a sample begins."""
        if not self._waiting or self.s[PHASE] != 0.0:
            return
        (new, before), self._waiting = self._waiting[0], []
        old, told = self.controller, np.zeros(TOLD)
        if new.tick != old.tick:  # references move on from where they are, and a gust blows on as long
            act(self.u, "turn", self.u[TURN : TURN + 2].tolist(), self.tick, old.tick)
            keep_gust(self.u, self.tick, old.tick / new.tick)
        engine().take_over(
            FLOWN, self.y, self.s, old.c, old.m, old.k, before, new.c, new.m, new.k, self.u,
            self._scratch[1], np.zeros(14), told,
        )  # fmt: skip
        if not np.isfinite(told).all():
            self.s[ENDED_AS] = OUT_OF_STEPS
            return
        if abs(self.y[0]) < new.c[TRAVEL]:  # another rig's stop may be farther away
            self._free[REST] = 0
        self._before, self._since = self.time, self.tick
        self.controller = new
        self._noise()
        self.samples.append((self.tick, new.ticks_per_sample))
        a, b, c, d, bumpless = told.tolist()
        self.takeovers.append(Takeover(self.tick, (a, b), (c, d), bool(bumpless), self._before))

    def step(self, volts: Sequence[float] | None = None) -> FlightRows:
        """Flies one sample of the controller; with `volts` (V_p, V_y) by hand, else by the controller.

        Returns:
            The course of this sample, none of it where the flight has ended: see `ended`.

        Raises:
            InvalidInputError: these are no two voltages.
        """
        if volts is not None:
            own = np.ravel(volts).tolist()
            require_event(self.tick, "sticks", own, "event")
            if self.u[MANUAL] == 0.0:
                self._do("hands", [1])
            self._do("sticks", own)
        elif self.u[MANUAL] != 0.0:
            self._do("hands", [0])
        rows, t = self.fly_ticks(self.controller.ticks_per_sample)
        return FlightRows(t, rows)

    def fly(self, seconds: float) -> FlightRows:
        """Flies on, to the tick that is nearest; less where the flight ends: see `ended`.

        Raises:
            InvalidInputError: this is no time from 0 to `LONGEST`.
        """
        end = self.time + require_within(_plain(seconds), "seconds", "s", 0.0, LONGEST)
        rows, times = [np.zeros((0, FLIGHT_ROW))], [np.zeros(0)]
        while not self.ended:
            self._settle()
            ticks = round((end - self.time) / self.controller.tick)
            if ticks < 1:
                break
            if self._waiting:  # whose ticks may be others
                ticks = min(ticks, self._until_sample)
            own, t = self.fly_ticks(ticks)
            rows.append(own)
            times.append(t)
        return FlightRows(np.concatenate(times), np.concatenate(rows))

    def fly_ticks(self, ticks: int) -> tuple[Floats, Floats]:
        """The same by ticks: rows of the course, (ticks, FLIGHT_ROW), and when each began, (ticks,), s."""
        rows, t, done = np.zeros((ticks, FLIGHT_ROW)), np.zeros(ticks), 0
        while done < ticks and not self.ended:
            self._settle()
            count = ticks - done
            if self._waiting:
                count = min(count, self._until_sample)
            own = self.controller
            w, scratch, plant, grid = self._scratch
            begun = self.time
            flown = engine().fly(
                FLOWN, self.y, self.s, self._free, own.c, own.m, own.k, own.estimated, self.u, count,
                TOLERANCE, ABSOLUTE_TOLERANCE * TOLERANCE, MOST_STEPS, w, scratch, plant, grid, self._course,
                rows[done:],
            )  # fmt: skip
            count = self._numbers(rows[done : done + int(flown)])
            t[done : done + count] = begun + own.tick * np.arange(count)
            done += count
        return rows[:done], t[:done]

    def _numbers(self, rows: Floats) -> int:
        """How many of the rows that were just flown are numbers: at the first that is none the flight has ended.

        An observer that runs away, under hands or not, is infinite before the rig is.
        """
        good = np.isfinite(rows).all(axis=1)
        if good.all():
            return len(rows)
        first = int(good.argmin())
        self.y[:4] = rows[first, STATE : STATE + 4]
        self.s[TICK] -= len(rows) - first
        self.s[ENDED_AS] = OUT_OF_STEPS
        return first


def _plain(value: Any) -> Any:
    """A number of NumPy's as one of Python's, by which values are judged."""
    return value.item() if isinstance(value, np.generic) else value
