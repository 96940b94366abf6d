"""What happens in a flight, each at a tick: the words of a log, what they carry, and what they do to what acts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..checks import require_within
from ..errors import InvalidInputError
from ..kernels.flight_layout import (
    FLIGHT_INPUTS,
    GUST,
    GUST_FROM,
    GUST_TICKS,
    HUNG,
    MANUAL,
    PUSH,
    REFERENCE,
    STICK,
    STUCK,
    THRUST,
    TURN,
    TURN_FROM,
)
from ..signals import Floats

GRAVITY = 9.81
"""m/s², of what is hung on the rig."""
DESIGN = "design"
"""The word of an event that changes the design: it takes effect at the controller's next sample."""


@dataclass(frozen=True)
class Word:
    """One kind of event.

    Attributes:
        values: what it carries, each with its unit and range.
        meaning: in a sentence.
        whole: names of those that are whole numbers.
    """

    values: tuple[tuple[str, str, float, float], ...]
    meaning: str
    whole: tuple[str, ...] = ()


WORDS: dict[str, Word] = {
    "reference": Word(
        (("theta", "rad", -100.0, 100.0), ("psi", "rad", -1e4, 1e4)), "the set points are these and rest"
    ),
    "turn": Word(
        (("theta_dot", "rad/s", -20.0, 20.0), ("psi_dot", "rad/s", -20.0, 20.0)),
        "the set points move on from where they are, at these rates",
    ),
    "hands": Word(
        (("on", "", 0.0, 1.0),),
        "1: the sticks are the motors' voltages and the controller is off; 0: it is on",
        whole=("on",),
    ),
    "sticks": Word((("V_p", "V", -1e3, 1e3), ("V_y", "V", -1e3, 1e3)), "what the sticks ask of the motors"),
    "push": Word(
        (("theta", "N·m", -100.0, 100.0), ("psi", "N·m", -100.0, 100.0)),
        "a hand pushes the body on and on",
    ),
    "gust": Word(
        (("theta", "N·m", -100.0, 100.0), ("psi", "N·m", -100.0, 100.0), ("ticks", "", 1.0, 1e6)),
        "a gust of this largest torque, (1 − cos)/2 over so many ticks from now on; a new one ends the old",
        whole=("ticks",),
    ),
    "thrust": Word(
        (("pitch", "", 0.0, 2.0), ("yaw", "", 0.0, 2.0)), "share of its thrust that each rotor has, 1: all"
    ),
    "hung": Word(
        (("mass", "kg", 0.0, 10.0), ("arm", "m", -1.0, 1.0)),
        "a mass hangs so far before the pivot, under 9.81 m/s²; 0 kg: none",
    ),
    "stuck": Word(
        (("theta", "", 0.0, 1.0), ("psi", "", 0.0, 1.0)),
        "1: this encoder goes on to tell its last reading",
        whole=("theta", "psi"),
    ),
}
"""All but DESIGN, which carries a body of the REST calls."""


def whole_number(value: Any, path: str, low: int, high: int) -> int:
    """A value as a whole number in a range; 2.0 is one, as in JSON's own sense.

    Raises:
        InvalidInputError: it is none.
    """
    number = require_within(value, path, "", low, high)
    if number != int(number):
        raise InvalidInputError("this is a whole number", field=path, value=value)
    return int(number)


def require_event(tick: Any, word: Any, values: Sequence[Any], path: str) -> None:
    """Refuses what is no event.

    Raises:
        InvalidInputError: it names the value.
    """
    if isinstance(tick, bool) or not isinstance(tick, int) or tick < 0:
        raise InvalidInputError("a tick is a whole number from 0 on", field=f"{path}[0]", value=tick)
    known = WORDS.get(word) if isinstance(word, str) else None
    if known is None:
        hint = f"Known are {', '.join(WORDS)} and {DESIGN}."
        raise InvalidInputError(
            "this is no word of a flight's log", field=f"{path}[1]", value=word, hint=hint
        )
    if len(values) != len(known.values):
        names = ", ".join(name for name, *_ in known.values)
        raise InvalidInputError(
            f"{word} takes {len(known.values)} values: {names}", field=path, value=len(values)
        )
    for k, (value, (name, unit, low, high)) in enumerate(zip(values, known.values, strict=True)):
        good = isinstance(value, (int, float)) and not isinstance(value, bool) and low <= value <= high
        if not good or (name in known.whole and value != int(value)):
            kind = "whole number" if name in known.whole else "number"
            raise InvalidInputError(
                f"{name} of {word} is a {kind} from {low:g} to {high:g} {unit}".rstrip(),
                field=f"{path}[{k + 2}]",
                value=value,
            )


def nothing_acts() -> Floats:
    """What acts where nobody does anything, laid out as `kernels.flight_layout` says."""
    u = np.zeros(FLIGHT_INPUTS)
    u[THRUST : THRUST + 2] = 1.0
    return u


def _refer(u: Floats, values: Sequence[float], tick: int, step: float) -> None:
    u[REFERENCE : REFERENCE + 2], u[TURN : TURN + 2], u[TURN_FROM] = values, 0.0, tick


def _turn(u: Floats, values: Sequence[float], tick: int, step: float) -> None:
    since = (tick - u[TURN_FROM]) * step
    u[REFERENCE : REFERENCE + 2] += since * u[TURN : TURN + 2]
    u[TURN : TURN + 2], u[TURN_FROM] = values, tick


def _hang(u: Floats, values: Sequence[float], tick: int, step: float) -> None:
    mass, arm = values
    u[HUNG], u[HUNG + 1] = mass * arm * arm, mass * GRAVITY * arm


def _gust(u: Floats, values: Sequence[float], tick: int, step: float) -> None:
    u[GUST], u[GUST + 1], u[GUST_FROM], u[GUST_FROM + 1] = values[0], values[1], tick, values[2]


def _put(at: int) -> Callable[[Floats, Sequence[float], int, float], None]:
    def put(u: Floats, values: Sequence[float], tick: int, step: float) -> None:
        u[at : at + len(values)] = values

    return put


_ACTS = {
    "reference": _refer,
    "turn": _turn,
    "hands": _put(MANUAL),
    "sticks": _put(STICK),
    "push": _put(PUSH),
    "gust": _gust,
    "thrust": _put(THRUST),
    "hung": _hang,
    "stuck": _put(STUCK),
}


def keep_gust(u: Floats, tick: int, ratio: float) -> None:
    """A gust that blows lasts as long as it would have, though ticks are shorter from this one on by `ratio`."""
    since = tick - u[GUST_FROM]
    if 0.0 < since < u[GUST_TICKS]:
        u[GUST_FROM], u[GUST_TICKS] = tick - since * ratio, u[GUST_TICKS] * ratio


def act(u: Floats, word: str, values: Sequence[float], tick: int, step: float) -> None:
    """Puts an event's values into what acts, at a tick that is `step` s long."""
    _ACTS[word](u, values, tick, step)
