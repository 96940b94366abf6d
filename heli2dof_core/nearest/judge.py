"""Whether designs meet requirements, many at once, and by how much they miss or keep each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf
from typing import NamedTuple

import numpy as np

from ..errors import Heli2DofError, InvalidInputError
from ..kernels.update_layout import DONE, FOUND_FIGURES, FOUND_OUTCOME, K_GIVEN, POLES, ROTORS_PLACED, STABLE
from ..many import Many, Measure
from ..measured import MEASURED
from ..requirements import Requirement
from ..signals import Floats
from ..spec import Spec
from .handles import Chart, spec_at

NOTHING = 10.0
"""What a design that does not exist misses a limit by."""
MOST_STEPS = 5_000
"""Of a response: one that takes more is of no design that somebody would want."""


class Verdict(NamedTuple):
    """What was found of some designs.

    Attributes:
        missed: by how much each limit is missed, (k, limits): shares of the limits, negative where there is room; in
            the last column that of stability.
        met: whether all are met, (k,).
    """

    missed: Floats
    met: np.ndarray


class Judge:
    """Judges designs around one spec.

    A limit is met where the figure itself keeps it and also where it does as it is shown, so that nobody who reads
    either is told otherwise.

    Attributes:
        of: which requirement each limit belongs to.
        stepped: the axes that are stepped.
        tried: how many designs were looked at.
        least: by how much each requirement was missed at least, by any of these that is near, (requirements,).
        closest: the numbers of the near one that comes closest to meeting all.
    """

    def __init__(
        self,
        spec: Spec,
        requirements: Sequence[Requirement],
        within: float,
        threads: int,
        check: Callable[[], None],
    ) -> None:
        self.spec, self._within, self._check = spec, within, check
        self._limits: list[tuple[int, float, float, float, bool]] = []
        measures: list[Measure] = []
        self.of: list[int] = []
        for i, own in enumerate(requirements):
            for single in _singles(spec, own, i):
                for limit, sign in ((own.max, 1.0), (own.min, -1.0)):
                    if limit is None:
                        continue
                    low, high = own.edges
                    edge = min(limit, high) if sign > 0 else max(limit, low)
                    signed = bool(own.measured and own.measured.figure.signed)
                    self._limits.append((len(measures), edge, sign, own.scale(limit), signed))
                    self.of.append(i)
                measures.append(single)
        self.many = Many(spec, measures, threads=threads, most_steps=MOST_STEPS, unstable=False)
        self.stepped = _stepped(spec)
        self._rate = max(abs(p) for p in spec.poles.values) or 1.0
        self.tried = 0
        self.least = np.full(len(requirements), NOTHING)
        self.closest, self._closest = self.many.row, inf

    @property
    def places_outside(self) -> bool:
        """Whether K is found outside the kernel, design by design."""
        return bool(self.many.row[K_GIVEN])

    def rows(self, chart: Chart, z: Floats) -> Floats:
        """The kernel's numbers of some designs, (k, NUMBERS)."""
        rows = np.tile(self.many.row, (len(z), 1))
        chart.fill(rows, chart.values(z))
        return rows

    def spec_of(self, row: Floats) -> Spec:
        """The spec of a row."""
        return spec_at(self.spec, row)

    def of_chart(self, chart: Chart, z: Floats) -> Verdict:
        """Of coordinates, (k, n)."""
        return self(self.rows(chart, z), chart.distances(z))

    def __call__(self, rows: Floats, far: Floats) -> Verdict:
        """Of rows of numbers, and how far each is from the design, (k,): steps and samples go beyond what is near."""
        self.tried += len(rows)
        asked = rows
        rows, exists = self._given(rows)
        found = self.many.run(rows, lambda i: self.spec_of(asked[i]), self._check)
        values = self.many.values(rows, found)
        exists &= found.rows[:, FOUND_OUTCOME] == DONE
        stable = exists & (found.rows[:, FOUND_FIGURES + STABLE] != 0.0)
        slowest = found.poles[:, 0].real
        missed = np.full((len(rows), len(self._limits) + 1), NOTHING)
        missed[exists, -1] = slowest[exists] / self._rate
        with np.errstate(divide="ignore"):
            # where nothing settles, a guess that falls with the slowest pole shows the way to where something does
            late = np.where(slowest < 0, -4.0 / slowest, inf)
        for column, (at, edge, sign, scale, signed) in enumerate(self._limits):
            value = np.abs(values[:, at]) if signed else values[:, at]
            absent = np.isnan(value)
            if self.many.measures[at].name == "settling_time":
                value = np.where(absent & stable, np.maximum(late, self.spec.scenario.duration), value)
            own = sign * (value - edge) / scale
            own = np.where(np.isinf(value), np.where(sign * value > 0, NOTHING, -1.0), own)
            missed[:, column] = np.where(np.isnan(own), 1.0, np.clip(own, -NOTHING, NOTHING))
            missed[~stable, column] = NOTHING
        met = stable & np.all(missed[:, :-1] <= 0.0, axis=1)
        self._note(asked, missed[:, :-1], stable & (far <= self._within))
        return Verdict(missed, met)

    def _note(self, rows: Floats, missed: Floats, counts: np.ndarray) -> None:
        """What comes closest, limit by limit, and to all, of those that count: stable, and near."""
        if not np.any(counts):
            return
        for i in range(len(self.least)):
            worst = missed[np.ix_(counts, np.array(self.of) == i)].max(axis=1)
            self.least[i] = min(self.least[i], worst.min())
        most = np.where(counts, missed.max(axis=1, initial=-NOTHING), inf)
        i = int(np.argmin(most))
        if most[i] < self._closest:
            self._closest, self.closest = float(most[i]), rows[i].copy()

    def _given(self, rows: Floats) -> tuple[Floats, np.ndarray]:
        """The rows, with K of their own where the kernel does not find it by itself; and whether there is one."""
        exists = np.ones(len(rows), dtype=bool)
        if not self.places_outside:
            return rows, exists
        out, places = rows.copy(), slice(POLES, ROTORS_PLACED)
        for i in np.flatnonzero(np.any(rows[:, places] != self.many.row[places], axis=1)).tolist():
            self._check()
            try:
                out[i] = self.many.numbers_of(self.spec_of(rows[i]), given=True)
            except (Heli2DofError, np.linalg.LinAlgError):
                exists[i] = False
        return out, exists


def _singles(spec: Spec, requirement: Requirement, i: int) -> list[Measure]:
    """A requirement on both axes or motors as one on each: the worse of two is no smooth function."""
    measure, known = requirement.measure, MEASURED.get(requirement.measure.name)
    if known is None or requirement.share is not None:
        raise InvalidInputError(
            "shares of uncertain rigs cannot be required here",
            field=f"require.{measure.name}",
            hint="Leave the share out, or let the finder look (POST /api/v1/find).",
        )
    where = measure.where
    wheres = [where]
    if known.may_have_axis and where.axis not in ("theta", "psi") and not _whole(known.of, where.steps):
        wheres = [replace(where, axis=axis) for axis in _stepped(spec)]
    if known.may_have_axis and where.axis in ("theta", "psi") and where.axis not in _stepped(spec):
        wheres = []
    if not wheres or (known.may_have_axis and not _stepped(spec)):
        raise InvalidInputError(
            f"{requirement.words}: the experiment does not step that axis",
            field=f"require.{measure.name}",
            value=i,
            hint="Give the axis a reference that differs from where it starts.",
        )
    if known.may_have_motor and where.motor not in ("V_p", "V_y"):
        wheres = [replace(own, motor=motor) for own in wheres for motor in ("V_p", "V_y")]
    return [Measure(measure.name, own) for own in wheres]


def _whole(of: str, steps: str) -> bool:
    """Whether a figure is of one course only, whatever the axis."""
    return of == "motor" and steps == "together"


def _stepped(spec: Spec) -> list[str]:
    """The axes whose reference is not where they start."""
    scenario = spec.scenario
    found = []
    for axis, base, reference, start in zip(
        ("theta", "psi"),
        (spec.theta_0, 0.0),
        (scenario.theta, scenario.psi),
        scenario.initial,
        strict=False,
    ):
        if reference is not None and reference != (base if start is None else start):
            found.append(axis)
    return found
