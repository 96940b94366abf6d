"""One number swept: where it takes the poles of the loop, and what becomes of figures of merit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidInputError
from ..frozen import Frozen
from ..many import SHARES, Measure
from ..requirements import measure_of
from ..signals import Complexes, Floats
from ..spec import Spec
from ..systems.model import System
from ..systems.zeros import invariant_zeros
from ..tables import Shown, Table, conjugates, number
from .courses import crossings_of, followed
from .numbers import Number, checked_range, number_at
from .sweeps import Gain, Plane, Sweep, border, side, sweep_of

Scale = Literal["linear", "log"]
FEWEST, MOST = 2, 2000
"""Values that may be asked for."""
MOST_MEASURES = 12
SHOWN_ROWS = 9


@dataclass(frozen=True)
class Crossing:
    """Where a pole, and with it its conjugate, passes the border of stability.

    Attributes:
        value: of the swept number, found to 1e-9 of it.
        pole: on the border, its imaginary part ≥ 0; rad/s, or in the z-plane.
        outwards: whether it leaves the stable side as the number grows.
    """

    value: float
    pole: complex
    outwards: bool


@dataclass(frozen=True, repr=False)
class Track(Frozen, Shown):
    """Poles and figures over one number.

    Attributes:
        number: what is swept; its `now` is the design's own value.
        values: (n,), ascending, in the number's unit: those asked for, the design's own where it lies between them,
            and more where poles move fast or meet. Values at which there is no such loop are left out.
        starts: where a stretch without gaps begins in them, 0 first.
        plane: s; or z where sample times are swept.
        poles: (n, order), each column the course of one pole of the whole loop; rad/s in the s-plane.
        stable: (n,), whether the loop is.
        crossings: of the border of stability, by value.
        zeros: where branches end as a gain grows without limit, rad/s; empty for other numbers.
        measures: what was measured.
        figures: (n, measures): NaN where there is none, ±∞ where it is unlimited, as `many.Many.values`.
    """

    number: Number
    values: Floats
    starts: tuple[int, ...]
    plane: Plane
    poles: Complexes
    stable: NDArray[np.bool_]
    crossings: tuple[Crossing, ...]
    zeros: Complexes
    measures: tuple[Measure, ...]
    figures: Floats

    @property
    def equivalent(self) -> Complexes:
        """The poles in the s-plane, rad/s: themselves, or ln z/Ts, whose real part is −∞ where z is 0."""
        if self.plane == "s":
            return self.poles
        with np.errstate(divide="ignore"):
            return (np.log(self.poles) / self.values[:, None]).astype(np.complex128)

    @property
    def at_now(self) -> int | None:
        """Which of the values is the design's own; None where it lies beside them."""
        if self.number.now is None:
            return None
        found = np.flatnonzero(self.values == self.number.now)
        return int(found[0]) if len(found) else None

    @property
    def on_border(self) -> NDArray[np.bool_]:
        """(n,), where the loop is not stable, but no pole lies beyond the border either: some lie on it."""
        beyond = side(self.poles, self.plane) > border(self.poles, self.plane)[:, None]
        return ~self.stable & ~np.any(beyond, axis=1)

    def summary(self) -> str:
        """What is swept, over what, and where the loop is stable."""
        about = self.number.quantity
        unit = f" {about.unit}" if about.unit else ""
        if not len(self.values):
            return f"{self.number.path}: there is no loop at any of its values"
        ends = f"{number(self.values[0].item())} to {number(self.values[-1].item())}{unit}"
        where = "stable in part"
        if self.stable.all() or not self.stable.any():
            where = "stable throughout" if self.stable.all() else "never stable"
        elif np.all(self.stable | self.on_border):
            told = ", ".join(f"{number(v)}{unit}" for v in self.values[self.on_border].tolist())
            where = f"stable except at {told}, where poles lie on the border of stability"
        at = ", ".join(f"{number(c.value, 6)}{unit}" for c in self.crossings)
        return f"{self.number.path} from {ends}; {where}" + (f"; crosses at {at}" if at else "")

    def tables(self) -> tuple[Table, ...]:
        """Where poles cross, and a few of the values with their poles and figures."""
        about = self.number.quantity
        head = f"{about.symbol or self.number.path}" + (f" ({about.unit})" if about.unit else "")
        crossed = [
            (
                number(c.value, 8),
                conjugates(c.pole, 6),
                "leaves stability" if c.outwards else "becomes stable",
            )
            for c in self.crossings
        ]
        picked = np.unique(np.linspace(0, max(len(self.values) - 1, 0), SHOWN_ROWS).round().astype(int))
        rows = []
        for i in picked.tolist() if len(self.values) else ():
            size = float(np.max(np.abs(self.poles[i])))
            upper = [_clean(p, size) for p in self.poles[i].tolist() if p.imag >= 0.0]
            upper.sort(key=lambda p: (-p.real, p.imag))
            figures = (m.written(v) for m, v in zip(self.measures, self.figures[i].tolist(), strict=True))
            told = ", ".join(conjugates(p) for p in upper)
            rows.append((number(self.values[i].item()), told, "yes" if self.stable[i] else "no", *figures))
        unit = "poles (rad/s)" if self.plane == "s" else "poles (z)"
        heads = (head, unit, "stable", *(m.words for m in self.measures))
        crossing = Table.of("poles on the border of stability", (head, "pole", ""), crossed)
        return (*((crossing,) if crossed else ()), Table.of("along the track", heads, rows))


def _clean(pole: complex, size: float) -> complex:
    """Without parts that are rounding alone."""
    re, im = (0.0 if abs(part) < 1e-12 * size else part for part in (pole.real, pole.imag))
    return complex(re, im)


def track(
    spec: Spec,
    path: str,
    over: tuple[float, float] | None = None,
    points: int = 200,
    measures: Sequence[Measure | Mapping[str, Any] | str] = (),
    *,
    scale: Scale = "linear",
    kept: bool = False,
    threads: int = 1,
    check: Callable[[], None] = lambda: None,
) -> Track:
    """Sweeps one number of a design and its rig.

    >>> import heli2dof_core as heli
    >>> found = heli.track(heli.Spec.from_preset(), "gain.pitch", (0.0, 2.0))
    >>> found.at_now is not None and bool(found.stable[found.at_now])
    True

    Args:
        spec: the design.
        path: of the number, as in a request (``loops.pitch.kp``), or one of those that `numbers` names.
        over: the range, low to high, in the number's unit; by default one around its value.
        points: values asked for, both ends among them.
        measures: figures to be found at each of them, or as a request has them.
        scale: how they are spaced: evenly, or by equal factors.
        kept: whether the gains stay as they are designed for the spec and only the rig changes; else the design is
            made anew for each value. Only for numbers of the rig.
        threads: that compute figures, at most.
        check: called after every few of them; what it raises ends the work.

    Raises:
        Heli2DofError: there is no such number, range or design; or no such figures.
    """
    measures = [each if isinstance(each, Measure) else measure_of(each) for each in measures]
    own = number_at(spec, path)
    low, high = checked_range(own, over)
    values = _spaced(low, high, points, scale)
    if own.now is not None and low < own.now < high:
        values = np.union1d(values, [own.now])
    if len(measures) > MOST_MEASURES:
        raise InvalidInputError(
            f"{len(measures)} figures are asked for",
            field="track.measures",
            value=len(measures),
            hint=f"Ask for at most {MOST_MEASURES}.",
        )
    for i, measure in enumerate(measures):
        if measure.name in SHARES:
            raise InvalidInputError(
                "shares of uncertain rigs have no track",
                field=f"track.measures.{i}.measure",
                value=measure.name,
                hint="Ask for a figure of one rig; a map tells shares.",
            )
    sweep = sweep_of(spec, own, values, kept=kept, threads=threads)
    course = followed(sweep, values, check)
    crossings = crossings_of(sweep, course, check)
    figures = np.empty((len(course.values), 0))
    if measures:
        figures = sweep.figures(course.values, measures, check)
    return Track(
        own,
        course.values,
        course.starts,
        sweep.plane,
        course.poles,
        course.stable,
        tuple(Crossing(*found) for found in crossings),
        _zeros(sweep),
        tuple(measures),
        figures,
    )


def _spaced(low: float, high: float, points: int, scale: Scale) -> Floats:
    if not FEWEST <= points <= MOST:
        raise InvalidInputError(
            f"{points} values are asked for",
            field="track.points",
            value=points,
            hint=f"Ask for {FEWEST} to {MOST}.",
        )
    if scale == "linear":
        return np.linspace(low, high, points)
    if not low * high > 0.0:
        raise InvalidInputError(
            f"a range from {low:g} to {high:g} has no equal factors",
            field="track.scale",
            value=scale,
            hint="Keep away from 0, or take a linear scale.",
        )
    return np.geomspace(low, high, points)


def _zeros(sweep: Sweep) -> Complexes:
    """Finite ends of the branches of a gain."""
    if not isinstance(sweep, Gain):
        return np.zeros(0, dtype=np.complex128)
    return invariant_zeros(
        System(sweep.open, sweep.inputs, sweep.law, np.zeros((len(sweep.law), sweep.inputs.shape[1])))
    )
