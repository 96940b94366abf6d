"""One figure over a plane of designs: every place an update of its own, many at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Heli2DofError, InvalidInputError, nobody_leaves
from ..frozen import Frozen
from ..kernels.update_layout import NUMBERS
from ..many import SHARES, Many, Measure
from ..requirements import measure_of
from ..robustness import Uncertainty, uncertain_factors
from ..signals import AXES, OUTPUTS, Floats
from ..spec import Spec
from ..tables import Shown, Table, number
from .drawing import drawn
from .mapped import Truths
from .numbers import listed
from .planes import SIZE, Move, Plane, Scale, plane_of

MOST_PLACES = 16_384
"""Places of a map."""
MOST_RIGS = 1_000_000
"""Places times uncertain rigs of which the poles alone are asked for: some ten seconds' work."""
MOST_RESPONSES = 650_000
"""Places times uncertain rigs that respond: twice as long a work, as a rule."""
_COLUMNS, _ROWS = 7, 9
"""Of the table that people are shown."""


@dataclass(frozen=True, repr=False)
class DesignMap(Frozen, Shown):
    """A figure at every place of a plane.

    Attributes:
        spec: the design around which the others lie, and its experiment.
        plane: which two of its numbers are changed, and from where to where.
        measure: what was measured.
        uncertainty: of the rigs of which shares are told; None of other figures.
        values: in `unit`, (ny, nx), row j at y[j]: NaN where the loop is unstable or has no such figure, infinite
            where it has no limit.
        stable: bool, (ny, nx), whether the loop is.
        abscissa: largest real part of the loop's poles, rad/s, (ny, nx); NaN where no design exists.
        own: the figure of the spec itself, as in `values`.
    """

    spec: Spec
    plane: Plane
    measure: Measure
    uncertainty: Uncertainty | None
    values: Floats
    stable: NDArray[np.bool_]
    abscissa: Floats
    own: float

    @property
    def x(self) -> Floats:
        """rad/s, or k_p in V/rad, (nx,)."""
        return self.plane.x

    @property
    def y(self) -> Floats:
        """rad/s, or T_i in s, (ny,)."""
        return self.plane.y

    @property
    def valid(self) -> Truths:
        """Where there is a number."""
        return np.isfinite(self.values)

    @property
    def unlimited(self) -> Truths:
        """Where there is none because there is no limit, which is as good as can be."""
        return np.isinf(self.values)

    @property
    def unit(self) -> str:
        """Of `values`; empty of shares, ratios and numbers without one."""
        return self.measure.figure.unit

    @property
    def title(self) -> str:
        """What was measured, and of which response."""
        return self.measure.words

    @property
    def here(self) -> tuple[float, float] | None:
        """Where the spec itself stands in the plane; None where it does not."""
        return self.plane.place_of(self.spec)

    @property
    def best(self) -> tuple[float, float, float] | None:
        """Of the grid's places the best: x, y and its value; None where there is none or no better and worse."""
        return self._extreme(self.measure.figure.better)

    @property
    def worst(self) -> tuple[float, float, float] | None:
        """The worst of those that have a value."""
        return self._extreme({"lower": "higher", "higher": "lower"}.get(self.measure.figure.better, "none"))

    def spec_at(self, x: float, y: float) -> Spec:
        """The design at the grid's place nearest to (x, y), to be evaluated or mapped on.

        Distances are those of the picture: of logarithms where the plane has them.
        """
        i, j = self._nearest(self.x, x), self._nearest(self.y, y)
        return self.plane.spec_at(self.spec, j * len(self.x) + i)

    def _nearest(self, places: Floats, value: float) -> int:
        if self.plane.scale == "linear":
            return int(np.argmin(np.abs(places - value)))
        return int(np.argmin(np.abs(np.log(places / value)))) if value > 0.0 else 0

    def written(self, value: float) -> str:
        """A value as it is shown, with its unit; words where there is none (NaN) or no limit (infinite)."""
        return self.measure.written(value)

    def svg(self) -> str:
        """The map as a picture: filled contours, axes, legend; what is forbidden is hatched."""
        return drawn(self)

    def csv(self) -> str:
        """The map as numbers, a row per place."""
        return listed(self)

    def summary(self) -> str:
        """What was measured, from where to where, and how many places have it."""
        ends = (self.best, self.worst)
        reach = " to ".join(self.written(end[2]) for end in ends if end is not None)
        share = f"{100 * float(np.mean(self.valid)):.0f} %"
        over = f"{len(self.x)} × {len(self.y)} places of {self.plane.words}"
        return f"{self.title}: {f'{reach} over ' if reach else ''}{over}, {share} of which have it"

    def tables(self) -> tuple[Table, ...]:
        """Best, worst and own place, and the values on a coarse grid."""
        names = self.plane.labels
        places: list[tuple[str, str, str, str]] = []
        for word, end in (("best", self.best), ("worst", self.worst)):
            if end is not None:
                places.append((word, number(end[0]), number(end[1]), self.written(end[2])))
        x, y = self.here or (None, None)
        places.append(("here", number(x), number(y), self.written(self.own)))
        columns, rows = _some(len(self.x), _COLUMNS), _some(len(self.y), _ROWS)[::-1]
        cells = ((number(float(self.y[j]), 3), *(self._cell(j, i) for i in columns)) for j in rows)
        heads = (" \\ ".join(reversed(self.plane.names)), *(number(float(self.x[i]), 3) for i in columns))
        return Table.of(self.title, ("", *names, "value"), places), Table.of("places", heads, cells)

    def _repr_html_(self) -> str:
        return f"{self.svg()}{super()._repr_html_()}"

    def _cell(self, j: int, i: int) -> str:
        if self.stable[j, i]:
            return self.written(float(self.values[j, i]))
        return "unstable" if isfinite(self.abscissa[j, i]) else "no design"

    def _extreme(self, better: str) -> tuple[float, float, float] | None:
        if better == "none" or not np.any(self.valid):
            return None
        pick = np.nanargmin if better == "lower" else np.nanargmax
        j, i = np.unravel_index(int(pick(np.where(self.valid, self.values, nan))), self.values.shape)
        return float(self.x[i]), float(self.y[j]), float(self.values[j, i])


def design_map(
    spec: Spec,
    move: Move,
    measure: Measure | Mapping[str, Any] | str = "settling_time",
    over: Sequence[Sequence[float]] | None = None,
    size: Sequence[int] = SIZE,
    *,
    real: bool = False,
    scale: Scale | None = None,
    uncertainty: Uncertainty | None = None,
    threads: int = 1,
    check: Callable[[], None] = nobody_leaves,
) -> DesignMap:
    """A figure of merit at every place where a pair of poles, or the PI gains of an axis, might be.

    >>> from heli2dof_core import Spec
    >>> found = design_map(Spec.from_preset(), "yaw-pair", {"measure": "settling_time", "axis": "psi"}, size=(3, 2))
    >>> found.values.shape
    (2, 3)

    Args:
        spec: a design and its experiment; all but what is moved stays.
        move: pitch-pair, yaw-pair: x ± jy; pitch-pi, yaw-pi: k_p and T_i of that axis' error.
        measure: a figure's name, both axes and motors meant; or with ``axis``, ``motor``, ``model``, ``steps``; or a
            share of uncertain rigs, ``share_stable`` or ``share_within_limits``.
        over: ((x first, last), (y first, last)); by default around the spec's own place.
        size: places along x and along y.
        real: of a pair, whether both poles are real, x and y.
        scale: of gains: log, the default, or linear.
        uncertainty: of the rigs of which shares are told.
        threads: that compute, at most.
        check: called after every few designs; what it raises ends the work.

    Raises:
        InvalidInputError: there is no such plane or figure, or the design does not depend on what is moved.
        Heli2DofError: the rig cannot be controlled.
    """
    measured = measure if isinstance(measure, Measure) else measure_of(measure)
    plane = plane_of(spec, move, over, size, scale, real=real)
    _require_stepped(spec, measured)
    factors = None
    if measured.name in SHARES:
        if uncertainty is None:
            raise InvalidInputError(
                f"{measured.name} is of uncertain rigs, and none are described",
                field="uncertainty",
                hint="Say how far the rigs may differ from the nominal one.",
            )
        factors = uncertain_factors(spec, uncertainty)
    most = MOST_RESPONSES if measured.name == "share_within_limits" else MOST_RIGS
    _require_few(len(plane.x) * len(plane.y), 0 if factors is None else len(factors), most)
    many = Many(spec, (measured,), factors=factors, threads=threads, unstable=False)
    specs = _Specs(spec, plane)
    rows, there = _rows_one_by_one(many, specs, check) if not many.changes_in_place else _rows(many, specs)
    table, abscissa = np.full((2, len(specs)), nan)
    stable = np.zeros(len(specs), dtype=bool)
    if len(there):
        found = many.run(rows, lambda i: specs[int(there[i])], check)
        stable[there], abscissa[there] = found.stable, found.abscissa
        table[there] = np.where(found.stable, many.values(rows, found)[:, 0], nan)
    rigs = None if factors is None else uncertainty
    shape, own = (len(plane.y), len(plane.x)), float(table[-1])
    values, slowest = table[:-1].reshape(shape).copy(), abscissa[:-1].reshape(shape).copy()
    return DesignMap(spec, plane, measured, rigs, values, stable[:-1].reshape(shape).copy(), slowest, own)


class _Specs:
    """The specs of all places, and behind them the one around which they lie; made when asked for."""

    def __init__(self, spec: Spec, plane: Plane) -> None:
        self.spec, self.plane = spec, plane
        self.places = len(plane.x) * len(plane.y)

    def __len__(self) -> int:
        return self.places + 1

    def __getitem__(self, i: int) -> Spec:
        return self.spec if i == self.places else self.plane.spec_at(self.spec, i)


def _rows(many: Many, specs: _Specs) -> tuple[Floats, NDArray[np.int64]]:
    """Numbers of all designs, and which they are: all."""
    return np.vstack((specs.plane.rows(many.row), many.row)), np.arange(len(specs))


def _rows_one_by_one(
    many: Many, specs: _Specs, check: Callable[[], None]
) -> tuple[Floats, NDArray[np.int64]]:
    """Numbers of those designs that exist, K of each found by its method, and which they are."""
    rows, there = [], []
    for i in range(len(specs)):
        check()
        try:
            rows.append(many.numbers_of(specs[i]))
        except Heli2DofError:
            continue
        there.append(i)
    return np.array(rows).reshape(-1, NUMBERS), np.array(there, dtype=np.int64)


def _require_stepped(spec: Spec, measure: Measure) -> None:
    """A figure of a step needs one."""
    where, scenario = measure.where, spec.scenario
    if measure.name in SHARES or not measure.runs:
        return
    theta, psi, theta_from, psi_from, *_ = scenario.resolved(spec.theta_0)
    moves: dict[str, bool] = {"theta": theta != theta_from, "psi": psi != psi_from}
    if where.steps == "alone":
        moves = {name: own and getattr(scenario, name) is not None for name, own in moves.items()}
    wanted = (where.axis,) if where.axis in moves else tuple(moves)
    if any(moves[name] for name in wanted if name is not None):
        return
    words = (
        AXES[[signal.name for signal in OUTPUTS].index(wanted[0] or "")] if len(wanted) == 1 else "no axis"
    )
    raise InvalidInputError(
        f"{words} is {'not ' if len(wanted) == 1 else ''}stepped, so there is nothing to measure",
        field="axis",
        value=where.axis,
        hint="Give a reference that differs from where the axis starts.",
    )


def _require_few(places: int, rigs: int, most: int) -> None:
    if places > MOST_PLACES:
        raise InvalidInputError(
            f"{places} places are too many",
            field="size",
            value=places,
            hint=f"Ask for at most {MOST_PLACES}: a coarser grid.",
        )
    if places * rigs > most:
        raise InvalidInputError(
            f"{places} places times {rigs} rigs are too many",
            field="uncertainty.samples",
            value=rigs,
            hint=f"Ask for at most {most // places} rigs, or for a coarser grid.",
        )


def _some(count: int, most: int) -> list[int]:
    """Indices spread over `count`, both ends among them."""
    return sorted({round(k * (count - 1) / (min(count, most) - 1)) for k in range(min(count, most))})
