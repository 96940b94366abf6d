"""The designs among which is searched: points of a unit cube, each a design in numbers and as a spec.

A pair of poles is told by the geometric mean of its poles, and by its angle where it is complex or its ratio where it
is real: one coordinate goes from one to the other through the double pole, where both are the same, so that a search
need not know which kind a pair is. All sizes are logarithmic. What is chosen is rounded to four digits, which is what
people are told: the numbers that are told give the figures that are told.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import acos, log
from typing import Any

import numpy as np

from ..couplings import STRUCTURES, Structure, require_structure
from ..errors import Heli2DofError
from ..estimators import Observer
from ..kernels.update_layout import (
    CROSSWISE,
    DECOUPLED,
    FAMILY,
    OBSERVER_POLES,
    PI_GAINS,
    POLES,
    ROTOR_POLES,
    SHIFT,
    SHIFTED,
)
from ..poles import PoleSet
from ..scenario import PIGains
from ..signals import Floats
from ..spec import Spec
from ..weights import bryson_weights
from .ask import Bounds, Find, Free, Range

DIGITS = 4
_DECOUPLED = STRUCTURES.index(Structure("axis-decoupled"))
_SLOWEST, _FASTEST = 0.5, 20.0
"""Poles, rad/s, that are within reach of every search whose bounds are not said."""


@dataclass(frozen=True)
class Part:
    """Some of the coordinates, and what they mean.

    Attributes:
        size: how many they are.
        values: of points, (n, size) within 0 … 1, the numbers chosen, (n, k).
        fill: puts these into rows of numbers, (n, NUMBERS); None where the kernel does not find K itself.
        change: a spec with one row of these, (k,).
        point: where a spec stands, (size,), as far as it is within the bounds.
    """

    size: int
    values: Callable[[Floats], Floats]
    fill: Callable[[Floats, Floats], None]
    change: Callable[[Spec, list[float]], Spec]
    point: Callable[[Spec], Sequence[float]]


class Space:
    """The designs that differ from a spec by what is free.

    Args:
        spec: the design that is there, with rig and experiment.
        ask: what is free, and its bounds.

    Attributes:
        size: number of coordinates.
    """

    def __init__(self, spec: Spec, ask: Find) -> None:
        ask.require_possible(spec)
        self.spec = spec
        named = [(name, part) for name in ask.free for part in _PARTS[name](spec, ask.bounds)]
        self._parts = [part for _, part in named]
        self._weights = next((i for i, (name, _) in enumerate(named) if name == "weights"), None)
        self.size = sum(part.size for part in self._parts)

    def _values(self, points: Floats) -> list[Floats]:
        at, found = 0, []
        for part in self._parts:
            found.append(part.values(points[:, at : at + part.size]))
            at += part.size
        return found

    def rows(self, row: Floats, points: Floats) -> Floats:
        """The designs in numbers, (n, NUMBERS): `row` with what is free changed."""
        rows = np.tile(row, (len(points), 1))
        for part, values in zip(self._parts, self._values(points), strict=True):
            part.fill(rows, values)
        return rows

    def weights(self, points: Floats) -> Floats:
        """Diagonals of Q, R and, with integral action, Q_z of the designs, (n, k), where weights are free."""
        assert self._weights is not None
        return self._values(points)[self._weights]

    def design(self, point: Floats) -> Spec:
        """The design at one point, (size,).

        Raises:
            Heli2DofError: there is none.
        """
        spec = self.spec
        for part, values in zip(self._parts, self._values(point[np.newaxis]), strict=True):
            spec = part.change(spec, values[0].tolist())
        return spec

    def point_of(self, spec: Spec) -> Floats:
        """The point that is nearest to a design."""
        found = [value for part in self._parts for value in part.point(spec)]
        return np.clip(np.array(found, dtype=float), 0.0, 1.0)


def rounded(values: Floats) -> Floats:
    """To `DIGITS` significant digits."""
    sizes = np.abs(values)
    with np.errstate(divide="ignore"):
        lead = np.where(sizes > 0, np.floor(np.log10(np.where(sizes > 0, sizes, 1.0))), 0.0)
    places = (DIGITS - 1 - lead).astype(int)
    return np.array(
        [round(v, p) for v, p in zip(values.ravel().tolist(), places.ravel().tolist(), strict=True)]
    ).reshape(values.shape)


def _logarithmic(values: Floats, bounds: Range) -> Floats:
    low, high = log(bounds[0]), log(bounds[1])
    return np.exp(low + (high - low) * values)


def _from_logarithmic(value: float, bounds: Range) -> float:
    low, high = log(bounds[0]), log(bounds[1])
    return (log(min(max(abs(value), bounds[0]), bounds[1])) - low) / (high - low)


def pair_values(points: Floats, bounds: Range, damping: float) -> Floats:
    """Pairs of poles, (n, 4): real and imaginary part of the upper or slower one, then of the other."""
    mean, kind = _logarithmic(points[:, 0], bounds), 2.0 * points[:, 1] - 1.0
    angle = np.clip(kind, 0.0, None) * acos(damping)
    most = np.minimum(np.log(mean / bounds[0]), np.log(bounds[1] / mean))
    ratio = np.exp(np.clip(-kind, 0.0, None) * np.clip(most, 0.0, None))
    complex_pair = kind > 0
    re = rounded(np.where(complex_pair, -mean * np.cos(angle), -mean / ratio))
    im = rounded(np.where(complex_pair, mean * np.sin(angle), 0.0))
    other = rounded(np.where(complex_pair, re, -mean * ratio))
    return np.column_stack((re, im, other, -im + 0.0))


def pair_point(p: complex, q: complex, bounds: Range, damping: float) -> tuple[float, float]:
    """Where a pair stands, as `pair_values` has it."""
    mean = abs(p * q) ** 0.5
    mean = min(max(mean, bounds[0]), bounds[1])
    if p.imag:
        most = acos(damping)
        kind = acos(min(max(-p.real / abs(p), -1.0), 1.0)) / most if most else 0.0
    else:
        most = min(log(mean / bounds[0]), log(bounds[1] / mean))
        sizes = sorted((max(abs(p.real), 1e-9), max(abs(q.real), 1e-9)))
        kind = -min(0.5 * log(sizes[1] / sizes[0]) / most, 1.0) if most > 0 else 0.0
    return _from_logarithmic(mean, bounds), 0.5 * (kind + 1.0)


def _pole_bounds(given: Range | None, poles: Sequence[complex]) -> Range:
    if given is not None:
        return given
    sizes = [abs(p) for p in poles if p]
    low, high = (min(sizes), max(sizes)) if sizes else (_SLOWEST, _FASTEST)
    return min(_SLOWEST, 0.3 * low), max(_FASTEST, 3.0 * high)


def _pairs(
    at: int,
    bounds: Range,
    damping: float,
    read: Callable[[Spec], PoleSet],
    put: Callable[[Spec, PoleSet], Spec],
) -> list[Part]:
    def part(k: int) -> Part:
        own = slice(at + 4 * k, at + 4 * k + 4)

        def fill(rows: Floats, values: Floats) -> None:
            rows[:, own] = values

        def change(spec: Spec, values: list[float]) -> Spec:
            poles = list(read(spec).values)
            re, im, other, lower = values
            poles[2 * k], poles[2 * k + 1] = complex(re, im), complex(other, lower)
            return put(spec, PoleSet(poles))

        def point(spec: Spec) -> Sequence[float]:
            p, q = read(spec).values[2 * k : 2 * k + 2]
            return pair_point(p, q, bounds, damping)

        return Part(2, lambda points: pair_values(points, bounds, damping), fill, change, point)

    return [part(0), part(1)]


def _poles(spec: Spec, bounds: Bounds) -> list[Part]:
    own = _pole_bounds(bounds.poles, spec.poles.values)
    return _pairs(POLES, own, bounds.damping, lambda s: s.poles, lambda s, poles: s.with_poles(poles))


def _observer(spec: Spec, bounds: Bounds) -> list[Part]:
    def read(own: Spec) -> PoleSet:
        return (own.observer or Observer()).poles

    def put(own: Spec, poles: PoleSet) -> Spec:
        return replace(own, observer=replace(own.observer or Observer(), poles=poles))

    return _pairs(OBSERVER_POLES, _pole_bounds(bounds.observer, read(spec).values), bounds.damping, read, put)


def _sizes(
    at: Sequence[int],
    bounds: Sequence[Range],
    read: Callable[[Spec], Sequence[float]],
    put: Callable[[Spec, list[float]], Spec],
    sign: float = 1.0,
) -> list[Part]:
    """Numbers of one sign, each with its own bounds."""

    def values(points: Floats) -> Floats:
        columns = [_logarithmic(points[:, i], own) for i, own in enumerate(bounds)]
        return rounded(sign * np.column_stack(columns))

    def fill(rows: Floats, chosen: Floats) -> None:
        if at:
            rows[:, list(at)] = chosen

    def point(spec: Spec) -> Sequence[float]:
        return [_from_logarithmic(v, own) for v, own in zip(read(spec), bounds, strict=True)]

    return [Part(len(bounds), values, fill, put, point)]


def _rotor_poles(spec: Spec, bounds: Bounds) -> list[Part]:
    own = _pole_bounds(bounds.rotor_poles, spec.rotor_poles)

    def put(s: Spec, values: list[float]) -> Spec:
        return replace(s, rotor_poles=(values[0], values[1]))

    return _sizes((ROTOR_POLES, ROTOR_POLES + 1), (own, own), lambda s: s.rotor_poles, put, -1.0)


def _loops(spec: Spec, bounds: Bounds) -> list[Part]:
    def read(s: Spec) -> Sequence[float]:
        return s.outer.pitch.kp, s.outer.pitch.ti, s.outer.yaw.kp, s.outer.yaw.ti

    def put(s: Spec, values: list[float]) -> Spec:
        kp, ti, kq, tj = values
        return replace(s, outer=replace(s.outer, pitch=PIGains(kp, ti), yaw=PIGains(kq, tj)))

    own = []
    for i, value in enumerate(read(spec)):
        given, size = (bounds.ti if i % 2 else bounds.kp), abs(value) or 1.0
        own.append(given or ((size / 10, 30 * size) if i % 2 else (size / 30, 10 * size)))
    return _sizes(tuple(range(PI_GAINS, PI_GAINS + 4)), own, read, put)


def _weights(spec: Spec, bounds: Bounds) -> list[Part]:
    base = spec.weights or bryson_weights(spec.limits)
    kinds = ("states", "inputs", "integrals") if spec.method == "lqr-integral" else ("states", "inputs")
    now = {kind: getattr(base, kind) for kind in kinds}
    low, high = bounds.weights
    own = [(low * max(v, 1e-6), high * max(v, 1e-6)) for values in now.values() for v in values]

    def read(s: Spec) -> Sequence[float]:
        weights = s.weights or bryson_weights(s.limits)
        return [v for kind in kinds for v in getattr(weights, kind)]

    def put(s: Spec, values: list[float]) -> Spec:
        at, found = 0, {}
        for kind in kinds:
            size = len(now[kind])
            found[kind], at = tuple(values[at : at + size]), at + size
        return replace(s, weights=replace(base, **found))

    return _sizes((), own, read, put)


def _choice(
    options: Sequence[Any],
    fill: Callable[[Floats, Floats], None],
    put: Callable[[Spec, Any], Spec],
    read: Callable[[Spec], Any],
) -> list[Part]:
    """One of several things; `fill` gets their numbers."""
    count = len(options)

    def values(points: Floats) -> Floats:
        return np.minimum(np.floor(points * count), count - 1)

    def change(spec: Spec, chosen: list[float]) -> Spec:
        return put(spec, options[int(chosen[0])])

    def point(spec: Spec) -> Sequence[float]:
        own = read(spec)
        return [(options.index(own) + 0.5) / count if own in options else 0.5]

    return [Part(1, values, fill, change, point)]


def _structure(spec: Spec, _: Bounds) -> list[Part]:
    families = []
    for i, family in enumerate(STRUCTURES):
        try:
            require_structure(spec.parameters, family)
        except Heli2DofError:
            continue
        families.append(i)
    own = spec.structure.shift

    def fill(rows: Floats, values: Floats) -> None:
        family = np.array(families, dtype=float)[values[:, 0].astype(int)]
        rows[:, FAMILY] = family
        _leave_out_shift(rows)

    def put(s: Spec, i: int) -> Spec:
        shift = None if i == _DECOUPLED else own
        return replace(s, structure=replace(STRUCTURES[i], shift=shift))

    return _choice(families, fill, put, lambda s: STRUCTURES.index(s.structure.family))


def _leave_out_shift(rows: Floats) -> None:
    none = rows[:, FAMILY] == _DECOUPLED
    rows[none, SHIFTED] = rows[none, SHIFT] = 0.0


def _shift(_: Spec, bounds: Bounds) -> list[Part]:
    low, high = bounds.shift

    def fill(rows: Floats, values: Floats) -> None:
        rows[:, SHIFTED], rows[:, SHIFT] = 1.0, values[:, 0]
        _leave_out_shift(rows)

    def change(s: Spec, values: list[float]) -> Spec:
        if s.structure.coupling == "axis-decoupled":
            return s
        return replace(s, structure=replace(s.structure, shift=values[0]))

    def point(s: Spec) -> Sequence[float]:
        return [((s.structure.shift or 0.0) - low) / (high - low)]

    return [Part(1, lambda points: rounded(low + (high - low) * points), fill, change, point)]


def _flag(at: int, options: Sequence[Any], name: str) -> list[Part]:
    """A choice between two things of the outer loop."""

    def fill(rows: Floats, values: Floats) -> None:
        rows[:, at] = values[:, 0]

    def put(s: Spec, value: Any) -> Spec:
        return replace(s, outer=replace(s.outer, **{name: value}))

    return _choice(options, fill, put, lambda s: getattr(s.outer, name))


_PARTS: dict[Free, Callable[[Spec, Bounds], list[Part]]] = {
    "poles": _poles,
    "rotor_poles": _rotor_poles,
    "loops": _loops,
    "structure": _structure,
    "shift": _shift,
    "pairing": lambda _, __: _flag(CROSSWISE, ("diagonal", "cross"), "pairing"),
    "decoupler": lambda _, __: _flag(DECOUPLED, (False, True), "decoupler"),
    "observer": _observer,
    "weights": _weights,
}
