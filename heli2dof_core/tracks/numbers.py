"""The numbers that can be swept: every float of a request under its own path, and those that move poles or gains.

Beside the paths of `request.quantities` there are

- ``poles.0`` … ``poles.3`` and ``rotor_poles.0``, ``rotor_poles.1``: a real pole;
- ``pitch-pair.re``, ``.im``, ``.frequency``, ``.damping`` and the same of ``yaw-pair``: a pair as it is told by its
  real and imaginary part, or by ωₙ and ζ; what is not swept stays;
- ``poles.factor``: all four poles times one factor;
- ``rotors.tau``: both rotors' time constants, alike;
- ``gain``, ``gain.pitch``, ``gain.yaw``: the factor on both motors' voltages, or on one motor's, from the open loop,
  0, to the loop as designed, 1, and beyond. These are no designs: see `sweeps.Gain`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import isfinite, sqrt
from typing import Any

from ..errors import InvalidInputError
from ..estimators import Observer
from ..evaluate import weights_of
from ..placement.registry import method
from ..poles import LARGEST, PoleSet
from ..quantities import Quantity, quantities_of
from ..request import Place, quantities
from ..rotors import USUAL_LAG, Rotor
from ..scenario import Digital, Disturbance
from ..spec import Spec

GAINS = {"gain": None, "gain.pitch": 0, "gain.yaw": 1}
"""Paths of the factor on motors' voltages, and which motor's; None: both."""
SAMPLE_TIME = "scenario.digital.sample_time"
PAIRS = {"pitch-pair": 0, "yaw-pair": 2}
LEAST_SHARE = 1e-3
"""Of the range's end, where a rotor's lag is to start at 0: there it is no state."""
MOST_FACTOR, MOST_GAIN, MOST_DAMPING, LEAST_FREQUENCY = 1e3, 1e4, 10.0, 1e-6


@dataclass(frozen=True)
class Number:
    """One number of a spec.

    Attributes:
        path: by which it is named.
        quantity: its meaning, unit and range.
        now: what it is in the spec; None where the spec has none of it.
        spec_at: the spec with another value of it; None of gains, which are no part of a spec.
    """

    path: str
    quantity: Quantity
    now: float | None
    spec_at: Callable[[float], Spec] | None

    @property
    def is_lag(self) -> bool:
        """Whether it is a rotor's time constant."""
        return self.path.startswith("rotors.") and self.path.endswith("tau")

    def usual_range(self) -> tuple[float, float]:
        """A range around its value in which something is to be seen, within what it may be."""
        low, high = self._around()
        return self.quantity.nearest(low), self.quantity.nearest(high)

    def _around(self) -> tuple[float, float]:
        now = self.now or 0.0
        own = {
            **dict.fromkeys(GAINS, (0.0, 3.0)),
            "operating_point.theta": (-0.7, 0.7),
            SAMPLE_TIME: (1e-3, max(0.1, 4.0 * now)),
        }
        if self.path in own:
            return own[self.path]
        if self.is_lag:
            return 0.0, 2.0 * (now or USUAL_LAG)
        if self.path.endswith(".damping"):
            return 0.05, max(1.5, 1.5 * now)
        if not now:
            return (-1.0, 1.0) if (self.quantity.low or 0.0) < 0.0 else (0.0, 1.0)
        share = 2.0 if self.path.startswith("parameters.") else 4.0
        return (now / share, share * now) if now > 0.0 else (share * now, now / share)


def swept_paths(spec: Spec) -> Iterator[str]:
    """The paths of all that can be swept in this spec."""
    yield from GAINS
    yield from _poles_of(spec)
    yield "rotors.tau"
    for path, place, known in quantities():
        if known.kind is float and _base(spec, place) is not None:
            yield path


def known_paths() -> tuple[str, ...]:
    """The paths of all that can be swept in one spec or another."""
    poles = (f"poles.{i}" for i in range(4))
    pairs = (f"{pair}.{part}" for pair in PAIRS for part in _OF_PAIR)
    floats = (path for path, _, known in quantities() if known.kind is float)
    return (*GAINS, *poles, *pairs, "poles.factor", "rotor_poles.0", "rotor_poles.1", "rotors.tau", *floats)


def number_at(spec: Spec, path: str) -> Number:
    """What a path stands for in a spec.

    Raises:
        InvalidInputError: there is no such number, or the spec has none of it.
    """
    if path in GAINS:
        which = "both motors' voltages" if path == "gain" else f"the {path.partition('.')[2]} motor's voltage"
        meaning = f"factor on {which}, deviations from the trim: 0 opens the loop, 1 is the design"
        return Number(path, Quantity(meaning, "", -MOST_GAIN, MOST_GAIN, symbol="k"), 1.0, None)
    special = _of_poles(spec, path)
    if special is not None:
        return special
    if path == "rotors.tau":
        both = [rotor.tau for rotor in spec.rotors.both]
        quantity = quantities_of(Rotor)["tau"].quantity
        own = replace(quantity, meaning=f"{quantity.meaning}, both rotors'")
        return Number(path, own, both[0] if both[0] == both[1] else None, partial(_with_lags, spec))
    for known_path, place, known in quantities():
        if known_path == path and known.kind is float:
            base = _base(spec, place)
            if base is None:
                raise InvalidInputError(
                    f"{spec.method} has no weights",
                    field="track.path",
                    value=path,
                    hint="Choose a quadratic method.",
                )
            own = place.names.get(path.rpartition(".")[2], path.rpartition(".")[2])
            now = _value(base, own) if _is_there(spec, place) else None
            return Number(path, known.quantity, now, partial(_with_value, spec, place, own))
    raise InvalidInputError(
        f"there is no number {path!r} to sweep",
        field="track.path",
        value=path,
        hint="Take the path of a number in a request, such as loops.pitch.kp, or gain, pitch-pair.damping, poles.0, "
        "rotors.tau.",
    )


def _base(spec: Spec, place: Place) -> Any:
    """The instance that holds a place's quantities; None where the spec's method has none."""
    if place.attribute == "weights":
        return weights_of(spec) if method(spec.method).weighted else None
    found: Any = spec
    for name in place.attribute.split(".") if place.attribute else ():
        found = getattr(found, name)
        if found is None:
            return _ASSUMED[place.attribute](spec)
    return found


def _is_there(spec: Spec, place: Place) -> bool:
    """Whether the spec says it, or leaves it out and with it what it is of."""
    return place.attribute == "weights" or all(
        getattr(own, name) is not None for own, name in _owners(spec, place)
    )


_ASSUMED: dict[str, Callable[[Spec], Any]] = {
    "observer": lambda _: Observer(),
    "scenario.digital": lambda spec: spec.scenario.controller or Digital(),
    "scenario.disturbance": lambda _: Disturbance(),
}
"""What is swept where the spec leaves it out."""


def _value(base: Any, own: str) -> float | None:
    name, _, part = own.partition(".")
    value = getattr(base, name)
    return value[[*quantities_of(type(base))[name].quantity.parts].index(part)] if part else value


def _with_value(spec: Spec, place: Place, own: str, value: float) -> Spec:
    """The spec with one value of one place changed."""
    base = _base(spec, place)
    name, _, part = own.partition(".")
    new: Any = value
    if part:
        parts = list(getattr(base, name))
        parts[[*quantities_of(type(base))[name].quantity.parts].index(part)] = value
        new = tuple(parts)
    changed = replace(base, **{name: new})
    for above in reversed(_owners(spec, place)):
        instance, attribute = above
        changed = replace(instance, **{attribute: changed})
    return changed


def _owners(spec: Spec, place: Place) -> list[tuple[Any, str]]:
    """From the spec down, which instance holds which attribute on the way to a place."""
    found, instance = [], spec
    for name in place.attribute.split(".") if place.attribute else ():
        found.append((instance, name))
        instance = getattr(instance, name)
    return found


def _with_lags(spec: Spec, tau: float) -> Spec:
    both = {axis: replace(getattr(spec.rotors, axis), tau=tau) for axis in ("pitch", "yaw")}
    return replace(spec, rotors=replace(spec.rotors, **both))


def _poles_of(spec: Spec) -> Iterator[str]:
    """Paths of the poles: a real pair's each, a pair's parts, all at once."""
    if not method(spec.method).places_poles:
        return
    for name, at in PAIRS.items():
        if spec.poles.values[at].imag == 0.0:
            yield f"poles.{at}"
            yield f"poles.{at + 1}"
        yield f"{name}.re"
        yield f"{name}.im"
        if _square(spec, at) > 0.0:
            yield f"{name}.frequency"
            yield f"{name}.damping"
    yield "poles.factor"
    if spec.place_rotors:
        yield from ("rotor_poles.0", "rotor_poles.1")


_RATE = Quantity("a real pole", "rad/s", -LARGEST, LARGEST)
_OF_PAIR = {
    "re": Quantity(
        "real part of the pair, or the middle of a real one", "rad/s", -LARGEST, LARGEST, symbol="Re"
    ),
    "im": Quantity("imaginary part of the pair", "rad/s", 0.0, LARGEST, symbol="Im"),
    "frequency": Quantity(
        "natural frequency of the pair, its damping ratio kept",
        "rad/s",
        LEAST_FREQUENCY,
        LARGEST,
        symbol="ωₙ",
    ),
    "damping": Quantity(
        "damping ratio of the pair, its natural frequency kept", "", -MOST_DAMPING, MOST_DAMPING, symbol="ζ"
    ),
}


def _of_poles(spec: Spec, path: str) -> Number | None:
    """A number of the poles; None where the path is of something else."""
    name, _, part = path.partition(".")
    if name not in (*PAIRS, "poles", "rotor_poles"):
        return None
    if path not in _poles_of(spec):
        raise InvalidInputError(
            f"{path} cannot be swept in this design",
            field="track.path",
            value=path,
            hint="Possible are "
            + (", ".join(_poles_of(spec)) or "no poles, as the method chooses them")
            + ".",
        )
    if name == "rotor_poles":
        at = int(part)
        return Number(path, _RATE, spec.rotor_poles[at], partial(_with_rotor_pole, spec, at))
    if path == "poles.factor":
        quantity = Quantity("factor on all four poles", "", 1 / MOST_FACTOR, MOST_FACTOR)
        return Number(path, quantity, 1.0, partial(_scaled, spec))
    if name == "poles":
        at = int(part)
        return Number(path, _RATE, spec.poles.values[at].real, partial(_with_pole, spec, at))
    at = PAIRS[name]
    return Number(path, _OF_PAIR[part], _pair_value(spec, at, part), partial(_with_pair, spec, at, part))


def _with_rotor_pole(spec: Spec, at: int, value: float) -> Spec:
    both = list(spec.rotor_poles)
    both[at] = value
    return replace(spec, rotor_poles=(both[0], both[1]))


def _with_pole(spec: Spec, at: int, value: float) -> Spec:
    return _with_poles(spec, at, [complex(value)])


def _scaled(spec: Spec, factor: float) -> Spec:
    return _with_poles(spec, 0, [factor * p for p in spec.poles.values])


def _with_poles(spec: Spec, at: int, new: list[complex]) -> Spec:
    values = list(spec.poles.values)
    values[at : at + len(new)] = new
    return spec.with_poles(PoleSet(values))


def _square(spec: Spec, at: int) -> float:
    """ωₙ² of a pair, the product of its poles."""
    return (spec.poles.values[at] * spec.poles.values[at + 1]).real


def _pair_value(spec: Spec, at: int, part: str) -> float | None:
    p, q = spec.poles.values[at : at + 2]
    middle = 0.5 * (p + q).real
    if part == "re":
        return middle
    if part == "im":
        return abs(p.imag) if p.imag or p == q else None  # two different real poles have none
    omega = sqrt(_square(spec, at))
    return omega if part == "frequency" else -middle / omega


def _with_pair(spec: Spec, at: int, part: str, value: float) -> Spec:
    p, q = spec.poles.values[at : at + 2]
    middle, square = 0.5 * (p + q).real, 0.25 * ((p - q) ** 2).real  # p, q = middle ± √square
    if part == "re":
        middle = value
    elif part == "im":
        square = -(value**2)
    elif part == "frequency":
        factor = value / sqrt(_square(spec, at))
        return _with_poles(spec, at, [factor * p, factor * q])
    else:
        own = _square(spec, at)
        middle, square = -value * sqrt(own), own * (value**2 - 1.0)
    root = complex(sqrt(square)) if square >= 0.0 else complex(0.0, sqrt(-square))
    return _with_poles(spec, at, [middle + root, middle - root])


def checked_range(number: Number, over: tuple[float, float] | None) -> tuple[float, float]:
    """The range, from low to high.

    Raises:
        InvalidInputError: it is none, or beyond what the number may be.
    """
    low, high = number.usual_range() if over is None else over
    about = number.quantity
    for value in (low, high):
        if not isfinite(value) or about.nearest(value) != value:
            unit = f" {about.unit}" if about.unit else ""
            raise InvalidInputError(
                f"{value:g}{unit} is beyond what {number.path} may be",
                field="track.over",
                value=value,
                hint=f"Stay within {about.low:g} to {about.high:g}{unit}.",
            )
    if not low < high:
        raise InvalidInputError(
            f"the range from {low:g} to {high:g} is none",
            field="track.over",
            value=high,
            hint="Give the lower end first.",
        )
    if number.is_lag and low == 0.0:
        low = LEAST_SHARE * high
    return low, high
