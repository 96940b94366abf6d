"""A flight of which every n-th row is kept, while the others are only counted."""

from __future__ import annotations

from dataclasses import dataclass, replace
from hashlib import sha256

import numpy as np

from ..errors import InvalidInputError, Wanted, nobody_leaves
from ..frozen import Frozen
from ..kernels.flight_layout import FLIGHT_ROW
from ..signals import Floats
from .course import FlightCourse, Flown, fly_log
from .log import FlightLog

MOST_KEPT = 400_000
"""Rows of a course that are kept at once: the longest flight at ticks of 1.7 ms; 61 MB."""
FEWEST_SAMPLES, MOST_SAMPLES = 2, 20_001


@dataclass(frozen=True)
class ThinFlight(Frozen):
    """Every n-th row of a flight, and the last state.

    Attributes:
        log: it was made from.
        t: (N,), s.
        rows: (N, FLIGHT_ROW), laid out as `kernels.flight_layout` says.
        every: n.
        flown: how it went.
        digest: SHA-256 of all rows that were flown, as little-endian 64-bit floats, in hexadecimal digits.
    """

    log: FlightLog
    t: Floats
    rows: Floats
    every: int
    flown: Flown
    digest: str

    def course(self) -> FlightCourse:
        """The same as a course, whose rows are those that are kept, without the last state."""
        return FlightCourse(self.t[: self._flown], self.rows[: self._flown], self.log, self.flown)

    def thinned(self, samples: int) -> ThinFlight:
        """So many of its rows at most, evenly by ticks, with the last state."""
        every = max(1, -(-self._flown // (samples - 1)))
        kept = np.r_[np.arange(0, self._flown, every), np.arange(self._flown, len(self.t))]
        return replace(self, t=self.t[kept], rows=self.rows[kept], every=self.every * every)

    @property
    def _flown(self) -> int:
        """Rows that were flown: all but the last state."""
        return -(-self.flown.ticks // self.every)


def require_kept(log: FlightLog, every: int) -> None:
    """Refuses a course of too many rows.

    Raises:
        InvalidInputError: more than `MOST_KEPT` would be kept.
    """
    if log.ticks > every * MOST_KEPT:
        raise InvalidInputError(
            f"these are {-(-log.ticks // every)} rows, more than {MOST_KEPT}",
            field="every",
            value=every,
            hint=f"Give {-(-log.ticks // MOST_KEPT)} or more.",
        )


def thin_flight(
    log: FlightLog,
    every: int = 1,
    *,
    last: bool = True,
    wanted: Wanted = nobody_leaves,
) -> ThinFlight:
    """Makes a flight again and keeps every n-th row.

    Args:
        log: of it.
        every: n.
        last: whether the last state is kept, too, as the row that the next tick would have.
        wanted: as in `fly_log`.

    Raises:
        InvalidInputError: more than `MOST_KEPT` rows would be kept.
        Heli2DofError: as `fly_log`.
    """
    require_kept(log, every)
    kept_t, kept, digest, done = [np.zeros(0)], [np.zeros((0, FLIGHT_ROW))], sha256(), 0

    def take(t: Floats, rows: Floats) -> None:
        nonlocal done
        digest.update(np.ascontiguousarray(rows, dtype="<f8").data)
        own = slice(-done % every, None, every)
        kept_t.append(t[own].copy() if every > 1 else t)
        kept.append(rows[own].copy() if every > 1 else rows)
        done += len(t)

    flown = fly_log(log, take, wanted=wanted)
    if last and flown.last is not None:
        kept_t.append(np.array([flown.duration]))
        kept.append(flown.last[None])
    return ThinFlight(log, np.concatenate(kept_t), np.concatenate(kept), every, flown, digest.hexdigest())


def sampled_flight(log: FlightLog, samples: int, *, wanted: Wanted = nobody_leaves) -> ThinFlight:
    """Makes a flight again and keeps so many rows at most, evenly by ticks, with the last state.

    Raises:
        Heli2DofError: as `fly_log`.
    """
    return thin_flight(log, max(1, -(-log.ticks // (samples - 1))), wanted=wanted)
