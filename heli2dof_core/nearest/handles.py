"""What may be moved, as coordinates: pairs of poles, rotors' poles, PI loops; and how far a move is.

Poles count by how far they go, as a share of their distance from the origin; gains and integral times by the
logarithm of the ratio. So 0.1 is a pole that moves by a tenth of its size, or a gain that is raised by a tenth.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import hypot, log
from typing import Literal, get_args

import numpy as np

from ..errors import InvalidInputError
from ..frozen import Frozen
from ..kernels.update_layout import PI_GAINS, POLES, ROTOR_POLES
from ..placement.registry import method
from ..poles import ZERO, PoleSet
from ..scenario import PIGains
from ..signals import Floats
from ..spec import Spec

Handle = Literal["pitch-pair", "yaw-pair", "pitch-pi", "yaw-pi"]
Free = Literal["poles", "loops", "pitch-pair", "yaw-pair", "pitch-pi", "yaw-pi"]
HANDLES: tuple[Handle, ...] = get_args(Handle)
GROUPS: dict[str, tuple[Handle, ...]] = {"poles": HANDLES[:2], "loops": HANDLES[2:]}
NEAR_ORIGIN = 0.1
"""Poles nearer to the origin count as if they were so far from it, rad/s."""


@dataclass(frozen=True)
class Chart(Frozen):
    """One way in which handles can stand, by coordinates z: a pair of poles is either real or conjugate.

    The squared distance from the design is ``offset + |z|²``.

    Attributes:
        center: the values of z = 0, (n,): rad/s, and logarithms of kp and ti.
        scale: how much of a value is 1, (n,).
        offset: what is between the design and the chart's nearest point, squared.
        fill: writes values, (k, n), into rows of the kernel's numbers, (k, NUMBERS).
        read: values of one such row, (n,); of a pair that stands the other way, those of a double pole.
    """

    center: Floats
    scale: Floats
    offset: float
    fill: Callable[[Floats, Floats], None]
    read: Callable[[Floats], Floats]

    def values(self, z: Floats) -> Floats:
        """Of coordinates, (k, n)."""
        return self.center + self.scale * z

    def coordinates(self, values: Floats) -> Floats:
        """Of values, (k, n)."""
        return (values - self.center) / self.scale

    def distances(self, z: Floats) -> Floats:
        """From the design, (k,)."""
        return np.sqrt(self.offset + np.sum(z * z, axis=-1))


def handles_of(spec: Spec, free: Sequence[str]) -> tuple[Handle, ...]:
    """The handles that are free and move something in this design, in their own order.

    Raises:
        InvalidInputError: one is unknown, or none is left.
    """
    wanted: set[Handle] = set()
    for i, name in enumerate(free):
        if name not in GROUPS and name not in HANDLES:
            known = ", ".join((*GROUPS, *HANDLES))
            raise InvalidInputError(
                f"nothing that moves is called {name!r}",
                field=f"free.{i}",
                value=name,
                hint=f"Known are {known}.",
            )
        wanted |= {own for own in HANDLES if own in GROUPS.get(name, (name,))}
    own = method(spec.method)
    if own.weighted:
        wanted -= {*GROUPS["poles"]}
    if spec.outer.outer != "pi" or own.integrates:
        wanted -= {*GROUPS["loops"]}
    found = tuple(sorted(wanted, key=HANDLES.index))
    if not found:
        hint = "Free the poles, or the loops where there are PI loops."
        if own.weighted:
            hint = f"{own.title} chooses its poles by its weights: choose a method that places poles"
            hint += "." if own.integrates else ", or free PI loops."
        raise InvalidInputError("nothing of this design is free to move", field="free", hint=hint)
    return found


def charts(spec: Spec, handles: Sequence[Handle]) -> list[Chart]:
    """All ways in which these handles can stand, the design's own first."""
    each = [_pair(spec, int(name == "yaw-pair")) for name in handles if name in GROUPS["poles"]]
    each += [[own] for name in handles if name in GROUPS["loops"] if (own := _loop(spec, name))]
    return [_joined(own) for own in product(*each)]


def _joined(parts: Sequence[Chart]) -> Chart:
    ends = np.cumsum([len(own.center) for own in parts])[:-1].tolist()

    def fill(rows: Floats, values: Floats) -> None:
        for own, columns in zip(parts, np.split(values, ends, axis=1), strict=True):
            own.fill(rows, columns)

    def read(row: Floats) -> Floats:
        return np.concatenate([own.read(row) for own in parts])

    center, scale = (np.concatenate([getattr(own, name) for own in parts]) for name in ("center", "scale"))
    return Chart(center, scale, sum(own.offset for own in parts), fill, read)


def _size(p: complex) -> float:
    return max(abs(p), NEAR_ORIGIN)


def _pair(spec: Spec, axis: int) -> list[Chart]:
    """A pair as two real poles and as two conjugates, as it is first; with the rotor's pole where it is placed."""
    p, q = spec.poles.values[2 * axis : 2 * axis + 2]
    first = POLES + 4 * axis

    def real(rows: Floats, values: Floats) -> None:
        rows[:, first : first + 4 : 2], rows[:, first + 1 : first + 4 : 2] = values, 0.0

    def conjugate(rows: Floats, values: Floats) -> None:
        # as far below the axis as above it, so that the coordinate has no end
        re, im = values[:, 0], np.abs(values[:, 1])
        im = np.where(im < ZERO, 0.0, im)
        rows[:, first : first + 4 : 2] = re[:, np.newaxis]
        rows[:, first + 1], rows[:, first + 3] = im, -im

    def real_of(row: Floats) -> Floats:
        return row[first : first + 4 : 2].copy()

    def conjugate_of(row: Floats) -> Floats:
        return np.array([0.5 * (row[first] + row[first + 2]), abs(row[first + 1])])

    if p.imag:
        size, above = _size(p), abs(p.imag)
        # both poles move: by the same on their sides, or each to its place on the axis
        own = [
            Chart(np.array([p.real, above]), np.full(2, size / 2**0.5), 0.0, conjugate, conjugate_of),
            Chart(np.full(2, p.real), np.full(2, size), 2 * (above / size) ** 2, real, real_of),
        ]
    else:
        a, b = p.real, q.real
        w, v = 1 / _size(a) ** 2, 1 / _size(b) ** 2
        middle = (w * a + v * b) / (w + v)
        offset = w * (middle - a) ** 2 + v * (middle - b) ** 2
        own = [
            Chart(np.array([a, b]), np.array([_size(a), _size(b)]), 0.0, real, real_of),
            Chart(np.array([middle, 0.0]), np.full(2, (w + v) ** -0.5), offset, conjugate, conjugate_of),
        ]
    if not spec.place_rotors:
        return own
    rotor = spec.rotor_poles[axis]

    def third(rows: Floats, values: Floats) -> None:
        rows[:, ROTOR_POLES + axis] = values[:, 0]

    def third_of(row: Floats) -> Floats:
        return row[ROTOR_POLES + axis : ROTOR_POLES + axis + 1].copy()

    beside = Chart(np.array([rotor]), np.array([_size(rotor)]), 0.0, third, third_of)
    return [_joined((pair, beside)) for pair in own]


def _loop(spec: Spec, name: str) -> Chart | None:
    """Gain and integral time by their logarithms; a loop without gain has nothing that could be multiplied."""
    axis = int(name == "yaw-pi")
    own = (spec.outer.pitch, spec.outer.yaw)[axis]
    if not own.kp:
        return None
    first, sign = PI_GAINS + 2 * axis, 1.0 if own.kp > 0 else -1.0

    def fill(rows: Floats, values: Floats) -> None:
        rows[:, first] = sign * np.exp(values[:, 0])
        rows[:, first + 1] = np.exp(values[:, 1])

    def read(row: Floats) -> Floats:
        return np.log(np.abs(row[first : first + 2]))

    return Chart(np.array([log(abs(own.kp)), log(own.ti)]), np.ones(2), 0.0, fill, read)


def spec_at(spec: Spec, row: Floats) -> Spec:
    """The spec with the poles and loops of a row of the kernel's numbers.

    Raises:
        InvalidInputError: one of them is out of its range.
    """
    re, im = row[POLES : POLES + 8 : 2].tolist(), row[POLES + 1 : POLES + 8 : 2].tolist()
    kp, ti, kp_yaw, ti_yaw = row[PI_GAINS : PI_GAINS + 4].tolist()
    return replace(
        spec,
        poles=PoleSet(complex(a, b) for a, b in zip(re, im, strict=True)),
        rotor_poles=tuple(row[ROTOR_POLES : ROTOR_POLES + 2].tolist()),
        outer=replace(spec.outer, pitch=PIGains(kp, ti), yaw=PIGains(kp_yaw, ti_yaw)),
    )


def moved(before: Spec, after: Spec) -> tuple[Handle, ...]:
    """The handles that stand elsewhere."""
    p, q = before.poles.values, after.poles.values
    rotors = [a != b for a, b in zip(before.rotor_poles, after.rotor_poles, strict=True)]
    own = (
        p[:2] != q[:2] or rotors[0],
        p[2:] != q[2:] or rotors[1],
        before.outer.pitch != after.outer.pitch,
        before.outer.yaw != after.outer.yaw,
    )
    return tuple(name for name, there in zip(HANDLES, own, strict=True) if there)


def distance(before: Spec, after: Spec) -> float:
    """How far one design is from another, as `Chart` counts it; poles of a pair by their nearer pairing."""
    squares = 0.0
    for i in (0, 2):
        (p, q), (r, s) = before.poles.values[i : i + 2], after.poles.values[i : i + 2]
        squares += min(
            (abs(a - p) / _size(p)) ** 2 + (abs(b - q) / _size(q)) ** 2 for a, b in ((r, s), (s, r))
        )
    if before.place_rotors:
        for a, b in zip(before.rotor_poles, after.rotor_poles, strict=True):
            squares += ((b - a) / _size(a)) ** 2
    for a, b in ((before.outer.pitch, after.outer.pitch), (before.outer.yaw, after.outer.yaw)):
        if a.kp and b.kp / a.kp > 0:
            squares += hypot(log(b.kp / a.kp), log(b.ti / a.ti)) ** 2
    return squares**0.5
