"""A stretch of a flight's course, with its columns by name."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees

from ..frozen import Frozen
from ..kernels.flight_layout import ON_STOP, OUTSIDE, SENSED, SPEED, STATE, UNLIMITED, VOLTAGE, WISH
from ..signals import Floats
from ..tables import Shown, number


@dataclass(frozen=True, repr=False)
class FlightRows(Frozen, Shown):
    """What was flown, a row per tick, as each tick begins.

    Attributes:
        t: (N,), s.
        rows: (N, FLIGHT_ROW), laid out as `kernels.flight_layout` says; the properties are its columns.
    """

    t: Floats
    rows: Floats

    @property
    def theta(self) -> Floats:
        """Pitch, (N,), rad."""
        return self.rows[:, STATE]

    @property
    def psi(self) -> Floats:
        """Yaw, (N,), rad."""
        return self.rows[:, STATE + 1]

    @property
    def rates(self) -> Floats:
        """θ̇ and ψ̇, (N, 2), rad/s."""
        return self.rows[:, STATE + 2 : STATE + 4]

    @property
    def measured(self) -> Floats:
        """θ, ψ, θ̇, ψ̇ as the controller knew them at its last sample, (N, 4)."""
        return self.rows[:, SENSED : SENSED + 4]

    @property
    def voltages(self) -> Floats:
        """V_p and V_y, (N, 2), V."""
        return self.rows[:, VOLTAGE : VOLTAGE + 2]

    @property
    def asked(self) -> Floats:
        """The same as the controller or a hand asked for them, before their limits, (N, 2), V."""
        return self.rows[:, UNLIMITED : UNLIMITED + 2]

    @property
    def speeds(self) -> Floats:
        """Rotors' speeds v_p and v_y, (N, 2), V."""
        return self.rows[:, SPEED : SPEED + 2]

    @property
    def references(self) -> Floats:
        """Set points of θ and ψ, (N, 2), rad."""
        return self.rows[:, WISH : WISH + 2]

    @property
    def torques(self) -> Floats:
        """From outside, about pitch's and yaw's axis, (N, 2), N·m."""
        return self.rows[:, OUTSIDE : OUTSIDE + 2]

    @property
    def stops(self) -> Floats:
        """The stop that pitch rests on, −1, 0 or 1, (N,)."""
        return self.rows[:, ON_STOP]

    def summary(self) -> str:
        """How many ticks, when, and where the last one began."""
        if not len(self.t):
            return "nothing was flown"
        angles = (number(degrees(float(own[-1]))) for own in (self.theta, self.psi))
        words = "{}°, {}°".format(*angles)
        return f"{len(self.t)} ticks, {number(self.t[0])} to {number(self.t[-1])} s, then θ, ψ = {words}"
