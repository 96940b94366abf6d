"""The planes that maps are drawn over: which two numbers of a design are changed, and from where to where."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10
from typing import Literal, get_args

import numpy as np

from ..checks import require_one_of, require_within
from ..errors import InvalidInputError
from ..frozen import Frozen
from ..kernels.update_layout import NUMBERS, PI_GAINS, POLES
from ..placement.registry import method
from ..poles import LARGEST, ZERO, PoleSet
from ..quantities import quantities_of
from ..scenario import PIGains
from ..signals import AXES, Floats
from ..spec import Spec

Move = Literal["pitch-pair", "yaw-pair", "pitch-pi", "yaw-pi"]
Scale = Literal["linear", "log"]
Range = tuple[float, float]
LARGEST_SIDE = 256
"""Places along one side, at most."""
SIZE = (64, 48)
_ROOM = 1.25
"""By how much a proposal goes beyond the fastest pole."""
_FACTOR = 10.0
"""By which a proposal's gains are smaller and larger than the design's own."""
_GAINS = (0.1, 100.0)
"""Where the design's own gain is none to begin from, V/rad."""


@dataclass(frozen=True)
class Plane(Frozen):
    """A grid of places.

    Attributes:
        move: what is moved.
        real: of a pair, whether both poles are real, x and y; else they are conjugates, x ± jy.
        scale: how places lie apart.
        x: rad/s, or k_p in V/rad, (nx,), rising.
        y: rad/s, or T_i in s, (ny,), rising.
    """

    move: Move
    real: bool
    scale: Scale
    x: Floats
    y: Floats

    @property
    def axis(self) -> str:
        """Whose pair or gains they are: pitch, yaw."""
        return self.move.partition("-")[0]

    @property
    def of_pair(self) -> bool:
        """Whether poles are moved, rather than gains."""
        return self.move.endswith("-pair")

    @property
    def labels(self) -> tuple[str, str]:
        """Names and units of x and y."""
        n = 1 + 2 * AXES.index(self.axis)
        if self.real:
            return f"p{_SUBSCRIPTS[n]} (rad/s)", f"p{_SUBSCRIPTS[n + 1]} (rad/s)"
        if self.of_pair:
            both = f"p{_SUBSCRIPTS[n]}, p{_SUBSCRIPTS[n + 1]}"
            return f"Re {both} (rad/s)", f"± Im {both} (rad/s)"
        return "kₚ (V/rad)", "Tᵢ (s)"

    @property
    def names(self) -> tuple[str, str]:
        """The same for programs."""
        if self.real:
            return "p_1", "p_2"
        return ("re", "im") if self.of_pair else ("kp", "ti")

    @property
    def words(self) -> str:
        """What is moved, for people."""
        if not self.of_pair:
            return f"{self.axis} loop's gains"
        return f"{self.axis}'s pair, both poles real" if self.real else f"{self.axis}'s pair"

    def rows(self, row: Floats) -> Floats:
        """Numbers of a design as `update` takes them with each place's instead, row by row of y, (ny·nx, NUMBERS)."""
        rows = np.empty((len(self.y), len(self.x), NUMBERS))
        rows[:] = row
        x, y = _zeroed(self.x), _zeroed(self.y)[:, None]
        if self.of_pair:
            at = POLES + 4 * AXES.index(self.axis)
            own = (x, 0.0, y, 0.0) if self.real else (x, y, x, 0.0 - y)
        else:
            at, own = PI_GAINS + 2 * AXES.index(self.axis), (self.x, self.y[:, None])
        for i, values in enumerate(own):
            rows[:, :, at + i] = values
        return rows.reshape(-1, NUMBERS)

    def spec_at(self, spec: Spec, i: int) -> Spec:
        """The spec with the numbers of a place, in the order of `rows`."""
        x, y = float(self.x[i % len(self.x)]), float(self.y[i // len(self.x)])
        if not self.of_pair:
            gains = PIGains(x, y)
            return spec.changed(pitch=gains) if self.axis == "pitch" else spec.changed(yaw=gains)
        pair = (complex(x), complex(y)) if self.real else (complex(x, y), complex(x, -y))
        own = spec.poles.values
        return spec.with_poles(PoleSet((*pair, *own[2:]) if self.axis == "pitch" else (*own[:2], *pair)))

    def place_of(self, spec: Spec) -> tuple[float, float] | None:
        """Where a spec stands in this plane; None where it does not."""
        if not self.of_pair:
            own = getattr(spec.outer, self.axis)
            return own.kp, own.ti
        p, q = spec.poles.values[2 * AXES.index(self.axis) :][:2]
        if self.real:
            return None if p.imag else (p.real, q.real)
        return (p.real, abs(p.imag)) if p.imag or p == q else None


def plane_of(
    spec: Spec,
    move: Move,
    over: Sequence[Sequence[float]] | None,
    size: Sequence[int],
    scale: Scale | None,
    *,
    real: bool,
) -> Plane:
    """The plane that is asked for; what is left out is proposed around the spec's own place.

    Raises:
        InvalidInputError: there is no such plane, or the design does not depend on its numbers.
    """
    require_one_of(move, Move, "move")
    of_pair = move.endswith("-pair")
    _require_effect(spec, move)
    scale = scale or ("linear" if of_pair else "log")
    require_one_of(scale, Scale, "scale")
    if real and not of_pair:
        raise InvalidInputError("gains are no poles", field="real", value=real, hint="Leave it out.")
    if of_pair and scale == "log":
        raise InvalidInputError(
            "a plane of poles has no logarithms", field="scale", value=scale, hint="Leave it out."
        )
    sides, limits = _size(size), _limits(move, real=real)
    if over is not None and len(over) != 2:
        raise InvalidInputError(
            f"{len(over)} ranges are given", field="over", value=len(over), hint="Give two: of x, then of y."
        )
    own = []
    for i, side in enumerate(over or _proposed(spec, move, real=real)):
        own.append(_spaced(*_ends(side, f"over.{i}", *limits[i]), sides[i], scale, f"over.{i}.0"))
    return Plane(move, real, scale, *own)


def _require_effect(spec: Spec, move: Move) -> None:
    known = method(spec.method)
    if move.endswith("-pair") and not known.places_poles:
        raise InvalidInputError(
            f"{known.title} chooses its poles by its weights, so nothing depends on where these are",
            field="move",
            value=move,
            hint="Choose a method that places poles, or map the gains of a loop.",
        )
    if move.endswith("-pi") and (known.integrates or spec.outer.outer != "pi"):
        raise InvalidInputError(
            "no PI loops are closed around this design",
            field="move",
            value=move,
            hint="Map a pair of poles, or choose another method."
            if known.integrates
            else 'Give "outer": "pi", or map a pair of poles.',
        )


def _size(size: Sequence[int]) -> tuple[int, int]:
    if not isinstance(size, Sequence) or len(size) != 2:
        raise InvalidInputError(
            f"the size {size!r} is not two numbers", field="size", value=str(size), hint="Give two: 64, 48."
        )
    for i, n in enumerate(size):
        if isinstance(n, bool) or not isinstance(n, int):
            raise InvalidInputError(f"size is {n!r}, no whole number", field=f"size.{i}", value=n)
        require_within(n, f"size.{i}", "", 2, LARGEST_SIDE)
    return size[0], size[1]


def _limits(move: Move, *, real: bool) -> tuple[tuple[str, float, float], tuple[str, float, float]]:
    """Units and largest ranges of x and y."""
    if move.endswith("-pair"):
        return ("rad/s", -LARGEST, LARGEST), ("rad/s", -LARGEST if real else 0.0, LARGEST)
    kp, ti = (quantities_of(PIGains)[name].quantity for name in ("kp", "ti"))
    return (kp.unit, kp.low or 0.0, kp.high or 0.0), (ti.unit, ti.low or 0.0, ti.high or 0.0)


def _ends(side: Sequence[float], path: str, unit: str, low: float, high: float) -> Range:
    """Both ends of a range that is given."""
    if not isinstance(side, Sequence) or isinstance(side, str) or len(side) != 2:
        raise InvalidInputError(
            f"{side!r} is no range", field=path, value=str(side), hint="Give its two ends, the lower first."
        )
    first, last = (require_within(end, f"{path}.{i}", unit, low, high) for i, end in enumerate(side))
    if not last - first > 1e-9 * max(abs(first), abs(last)):
        raise InvalidInputError(
            f"{path} ends at {last:g} {unit}, not above {first:g}",
            field=f"{path}.1",
            value=last,
            hint="Give the lower end first, and the upper one beyond it.",
        )
    return first, last


def _spaced(first: float, last: float, n: int, scale: Scale, path: str) -> Floats:
    """`n` places over a range."""
    if scale == "linear":
        return np.linspace(first, last, n)
    if not first > 0.0:
        raise InvalidInputError(
            f"{path} is {first:g}, which has no logarithm",
            field=path,
            value=first,
            hint='Begin above 0, or give "scale": "linear".',
        )
    return np.geomspace(first, last, n)


def _proposed(spec: Spec, move: Move, *, real: bool) -> tuple[Range, Range]:
    """A range around the design's own numbers, its ends round."""
    if move.endswith("-pair"):
        far = _rounded_up(_ROOM * max(abs(p) for p in spec.poles.values) or 1.0)
        return (-far, 0.0), ((-far, 0.0) if real else (0.0, 0.75 * far))
    own = getattr(spec.outer, move.partition("-")[0])
    kp, ti = (quantities_of(PIGains)[name].quantity for name in ("kp", "ti"))
    gains = _around(own.kp) if own.kp > 0 else _GAINS
    return (gains[0], kp.nearest(gains[1])), (ti.nearest(_around(own.ti)[0]), ti.nearest(_around(own.ti)[1]))


def _around(value: float) -> Range:
    return float(f"{value / _FACTOR:.2g}"), float(f"{value * _FACTOR:.2g}")


def _rounded_up(value: float) -> float:
    """To two digits, but not beyond what a pole may be."""
    unit = 10.0 ** (floor(log10(value)) - 1)
    return min(float(f"{ceil(value / unit - 1e-9) * unit:.2g}"), LARGEST)


def _zeroed(values: Floats) -> Floats:
    """As `PoleSet` has them."""
    return np.where(np.abs(values) < ZERO, 0.0, values)


_SUBSCRIPTS = "₀₁₂₃₄"
MOVES: tuple[Move, ...] = get_args(Move)
