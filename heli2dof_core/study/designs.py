"""The designs of a study: a list, a grid or random ones, each made of the study's own by what it changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from math import prod
from typing import Any, Protocol

import numpy as np

from ..errors import InvalidInputError
from ..request import Body, quantities, spec_of

PAIRS = {"pitch-pair": 0, "yaw-pair": 2}
"""A pair of poles, and where it begins among the four."""
_PARTS = ("re", "im", "first", "second")
_ROTORS = {"rotor-poles.pitch": 0, "rotor-poles.yaw": 1}
Changes = dict[str, Any]


class Designs(Protocol):
    """Designs by number, from 0."""

    @property
    def count(self) -> int:
        """How many."""
        ...

    @property
    def paths(self) -> tuple[str, ...]:
        """What each of them sets, as a summary heads its columns."""
        ...

    def changes(self, i: int) -> Changes:
        """What the ith one sets, by path."""
        ...

    def body(self, base: Body, i: int) -> Body:
        """The request's body of the ith one."""
        ...


@dataclass(frozen=True)
class Listed:
    """Bodies, each over the study's own."""

    bodies: tuple[Body, ...] = ({},)

    @property
    def count(self) -> int:
        """How many."""
        return len(self.bodies)

    @property
    def paths(self) -> tuple[str, ...]:
        """None: each has its own."""
        return ()

    def changes(self, i: int) -> Changes:
        """None that a column could tell."""
        return {}

    def body(self, base: Body, i: int) -> Body:
        """The body with the study's own below it."""
        return merged(base, self.bodies[i])


@dataclass(frozen=True)
class Grid:
    """Every value with every other; the last path's values follow one another.

    Attributes:
        values: by path.
    """

    values: Mapping[str, tuple[Any, ...]]

    @property
    def count(self) -> int:
        """How many."""
        return prod(map(len, self.values.values()))

    @property
    def paths(self) -> tuple[str, ...]:
        """Of the numbers that are set."""
        return (*self.values,)

    def changes(self, i: int) -> Changes:
        """The values at the ith place."""
        found: Changes = {}
        for path in reversed(self.paths):
            i, at = divmod(i, len(self.values[path]))
            found[path] = self.values[path][at]
        return {path: found[path] for path in self.paths}

    def body(self, base: Body, i: int) -> Body:
        """The study's own with these values."""
        return changed(base, self.changes(i))


@dataclass(frozen=True)
class Random:
    """Designs at random places, each of which has random numbers of its own.

    Attributes:
        ranges: by path, from, to, and whether the logarithm is uniform.
        count: how many.
        seed: of the places.
    """

    ranges: Mapping[str, tuple[float, float, bool]]
    count: int
    seed: int = 0

    @property
    def paths(self) -> tuple[str, ...]:
        """Of the numbers that are set."""
        return (*self.ranges,)

    def changes(self, i: int) -> Changes:
        """The values at the ith place."""
        numbers = np.random.PCG64(self.seed)
        numbers.advance(i * len(self.ranges))
        shares = np.random.Generator(numbers).random(len(self.ranges)).tolist()
        return {
            path: _between(low, high, share, logarithmic=logarithmic)
            for (path, (low, high, logarithmic)), share in zip(self.ranges.items(), shares, strict=True)
        }

    def body(self, base: Body, i: int) -> Body:
        """The study's own with these values."""
        return changed(base, self.changes(i))


def spaced(low: float, high: float, count: int, *, logarithmic: bool) -> tuple[float, ...]:
    """Values from one end to the other, both within."""
    if count == 1:
        return (low,)
    shares = (k / (count - 1) for k in range(count))
    return tuple(_between(low, high, share, logarithmic=logarithmic) for share in shares)


def _between(low: float, high: float, share: float, *, logarithmic: bool) -> float:
    if share in (0.0, 1.0):
        return high if share else low
    return float(low * (high / low) ** share) if logarithmic else low + share * (high - low)


@cache
def known_paths() -> tuple[str, ...]:
    """What a grid or random designs may set."""
    pairs = (f"{pair}.{part}" for pair in PAIRS for part in _PARTS)
    return (*pairs, *_ROTORS, "method", *(path for path, _, _ in quantities()))


def require_path(path: str) -> None:
    """Refuses what no design has.

    Raises:
        InvalidInputError: with what is like it.
    """
    known = known_paths()
    if path not in known:
        alike = get_close_matches(path, known, 3)
        hint = (
            f"Did you mean {' or '.join(alike)}?" if alike else "Numbers are named as docs/api.md has them."
        )
        raise InvalidInputError(f"there is no number {path!r} of a design", field=path, hint=hint)


def merged(base: Body, over: Mapping[str, Any]) -> Body:
    """A body with another's fields in place of its own; what has fields itself is merged alike."""
    found = dict(base)
    for name, value in over.items():
        own = found.get(name)
        both = isinstance(value, Mapping) and isinstance(own, Mapping) and name != "poles"
        found[name] = merged(dict(own or {}), value) if both else value
    return found


def changed(base: Body, changes: Mapping[str, Any]) -> Body:
    """A body with some numbers set."""
    body, of_pairs = dict(base), {}
    for path, value in changes.items():
        pair, _, part = path.partition(".")
        if pair in PAIRS:
            of_pairs.setdefault(pair, {})[part] = value
        elif path in _ROTORS:
            own = body.get("rotor_poles") or [*spec_of(base).rotor_poles]
            body["rotor_poles"] = [value if k == _ROTORS[path] else pole for k, pole in enumerate(own)]
        else:
            *above, last = path.split(".")
            level = body
            for name in above:
                level[name] = dict(level.get(name) or {})
                level = level[name]
            level[last] = value
    if of_pairs:
        poles: list[Any] = [*spec_of(base).poles.values]
        for pair, own in of_pairs.items():
            at = PAIRS[pair]
            poles[at : at + 2] = _pair(own, poles[at : at + 2])
        body["poles"] = [_told(pole) for pole in poles]
        body.pop("split", None)  # the poles are in pairs already
    return body


def _pair(own: Mapping[str, float], poles: Sequence[complex]) -> tuple[complex, complex]:
    """Both poles with what is set of them: real ones by name, else the upper one's parts."""
    if "first" in own or "second" in own:
        return complex(own.get("first", poles[0].real)), complex(own.get("second", poles[1].real))
    re, im = own.get("re", poles[0].real), abs(own.get("im", poles[0].imag))
    return complex(re, im), complex(re, -im)


def _told(pole: complex) -> Any:
    return {"re": pole.real, "im": pole.imag} if pole.imag else pole.real
