"""Many designs at once: figures of each by one call of the kernel `run_designs`, the same as those of `evaluate`.

What is asked for decides what is computed: a map of settling times takes no margins, and one of margins no response.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from math import nan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..block import Task, given_numbers, size_of
from ..engine import engine
from ..errors import Heli2DofError, InvalidInputError, nobody_leaves
from ..estimators import estimator
from ..evaluate import evaluate, place
from ..kernels.update_layout import (
    AIMS,
    ASKED,
    DONE,
    DOUBTFUL,
    FACTORS,
    FOUND,
    FOUND_FIGURES,
    FOUND_OUTCOME,
    K_GIVEN,
    POLE_ERROR,
    STABLE,
    WITHOUT_LAG_MARGIN,
    WITHOUT_LINEAR,
    WITHOUT_MARGINS,
    WITHOUT_RIG,
    WITHOUT_SCENARIO,
    WITHOUT_UNSTABLE,
    block_shapes,
    designs_shapes,
    made,
    rigs_shapes,
)
from ..measured import MEASURED
from ..scratch import scratch
from ..signals import Complexes, Floats
from ..simulation.digital import NO_NOISE, noise_of
from ..spec import Spec
from .measure import SHARES, Measure
from .reading import values_of

MOST_STEPS = 20_000
"""Of a nonlinear response among many: a hundredth of a second's work, beyond which it has no figures."""
PART = 64
"""Designs between two checks whether the work is still wanted, for each thread; fewer where each is put on rigs."""
RIGS_EACH = 25
"""Rigs that take about as long as a design."""
RIGS_TIMES = 101
"""Times at which a response on an uncertain rig is looked at, as in `robustness`."""
RIGS_RTOL = 1e-5
_AXES = ("theta", "psi")


class Found(NamedTuple):
    """What the kernel has found of many designs.

    Attributes:
        rows: (n, FOUND), as `kernels.update_layout` says; NaN where a design does not exist.
        poles: of the loops, rad/s, (n, order), slowest first, zeros behind the connected ones.
    """

    rows: Floats
    poles: Complexes

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Of which designs the loop is stable, (n,); of none that does not exist."""
        return (self.rows[:, FOUND_OUTCOME] == DONE) & (self.rows[:, FOUND_FIGURES + STABLE] != 0.0)

    @property
    def abscissa(self) -> Floats:
        """The largest real part of each loop's poles, rad/s, (n,); NaN of what does not exist."""
        return np.where(self.rows[:, FOUND_OUTCOME] == DONE, self.poles[:, 0].real, nan)


class Many:
    """Designs of one structure: the same rotors, measurement and axes stepped, their numbers as they like.

    Args:
        spec: a design and its experiment; where the others are alike, they need not be said.
        measures: what is to be found.
        factors: of uncertain rigs, (rigs, FACTORS), by which their parameters and lags differ; needed for shares.
        threads: that compute, at most.
        most_steps: of a nonlinear response.
        unstable: whether responses of unstable loops are computed; else these have no figures.
    """

    def __init__(
        self,
        spec: Spec,
        measures: Sequence[Measure],
        *,
        factors: Floats | None = None,
        threads: int = 1,
        most_steps: int = MOST_STEPS,
        unstable: bool = True,
    ) -> None:
        self.spec, self.measures = _sparse(spec), tuple(measures)
        self._threads, self._most_steps = threads, most_steps
        self._unstable = unstable
        runs = frozenset[str]().union(*(own.runs for own in measures))
        scenario = self.spec.scenario
        self._alone = tuple(axis for axis in _AXES if axis in runs and getattr(scenario, axis) is not None)
        self._together = "both" in runs
        self._task = Task.of(self.spec, each_axis=bool(self._alone))
        self.order = self._task.rest.order
        shares = {own.name for own in measures} & set(SHARES)
        if shares and factors is None:
            raise InvalidInputError(
                f"{min(shares)} is of uncertain rigs, and none are described", field="uncertainty"
            )
        self._factors = np.zeros((0, FACTORS)) if factors is None or not shares else factors
        self._rigs_respond = "share_within_limits" in shares

    @cached_property
    def row(self) -> Floats:
        """The spec's own numbers, (NUMBERS,), to be copied and changed.

        Raises:
            Heli2DofError: the design does not exist, and the kernel cannot find K itself.
        """
        return self.numbers_of(self.spec)

    @cached_property
    def _pool(self) -> ThreadPoolExecutor:
        """Its threads; a search runs thousands of small generations, and they end with it."""
        return ThreadPoolExecutor(self._threads)

    @property
    def changes_in_place(self) -> bool:
        """Whether designs may be made of `row` by other numbers: the kernel finds K and L of each itself."""
        return self._task.rest.has_closed_form and not self._task.rest.has_kalman_filter

    def numbers_of(self, spec: Spec, *, given: bool = False) -> Floats:
        """A spec's row, with K and L from outside the kernel where this cannot find them, or with `given` always.

        Raises:
            Heli2DofError: the design does not exist.
        """
        sparse = _sparse(spec)
        task = Task.of(sparse, each_axis=bool(self._alone))
        placed, rest = None, task.rest
        if given or not rest.has_closed_form or rest.has_kalman_filter:
            placed = place(sparse)
        L = None
        if placed is not None and rest.has_kalman_filter:
            known = estimator(placed, sparse.scenario.measured, sparse.observer)
            L = known and known.L
        row = given_numbers(task, placed, L, self._most_steps)
        kinds = [own.name if own.name in SHARES else MEASURED[own.name].of for own in self.measures]
        models = {own.where.model for own in self.measures if own.runs}
        row[WITHOUT_MARGINS] = not {"margins", "sensitivity"} & set(kinds)
        row[WITHOUT_LAG_MARGIN] = "loop" not in kinds
        row[WITHOUT_LINEAR] = "linear" not in models
        row[WITHOUT_RIG] = "nonlinear" not in models
        row[WITHOUT_SCENARIO] = not self._together
        row[WITHOUT_UNSTABLE] = not self._unstable
        if not self._together and not self._rigs_respond:  # who is not stepped alone need not be stepped
            for axis in range(2):
                if _AXES[axis] not in self._alone:
                    row[ASKED + axis] = nan
        return row

    def run(
        self,
        rows: Floats,
        spec_of: Callable[[int], Spec] | None = None,
        check: Callable[[], None] = nobody_leaves,
    ) -> Found:
        """The designs of `rows`, (n, NUMBERS).

        Args:
            rows: copies of `row`, changed.
            spec_of: the spec of a row, asked for where the kernel does not find K by itself (another method, or a
                closed form that would lose digits), and where a pole's error takes exact numbers; without, such a
                design counts as one that does not exist, and such an error is what floats say.
            check: called after every few designs; what it raises ends the work.
        """
        found, poles = np.empty((len(rows), FOUND)), np.empty((len(rows), self.order), dtype=np.complex128)
        most = PART * RIGS_EACH // (RIGS_EACH + len(self._factors))
        size = max(1, min(most, -(-len(rows) // self._threads)))  # a small generation is shared, too
        parts = [slice(i, i + size) for i in range(0, len(rows), size)]
        for at in range(0, len(parts), self._threads):
            check()
            group = parts[at : at + self._threads]
            each = ((rows[part], found[part], poles[part]) for part in group)
            if len(group) == 1:
                for task in each:
                    self._fill(*task)
            else:
                list(self._pool.map(lambda task: self._fill(*task), each))
        for i in np.flatnonzero(found[:, FOUND_OUTCOME] != DONE).tolist():
            check()
            self._fill_given(i, spec_of, found, poles)
        if spec_of is not None and {"pole_error", "pole_error_bound"} & {own.name for own in self.measures}:
            exact = (rows[:, K_GIVEN] != 0.0) | (found[:, FOUND_FIGURES + DOUBTFUL] != 0.0)
            exact &= rows[:, AIMS] != 0.0  # who chose the poles misses none
            for i in np.flatnonzero(exact & (found[:, FOUND_OUTCOME] == DONE)).tolist():
                check()
                placed = evaluate(_sparse(spec_of(i)), most_steps=1).placed
                found[i, FOUND_FIGURES + POLE_ERROR : FOUND_FIGURES + DOUBTFUL] = placed.error, placed.bound
        return Found(found, poles)

    def _fill_given(
        self, i: int, spec_of: Callable[[int], Spec] | None, found: Floats, poles: Complexes
    ) -> None:
        part = slice(i, i + 1)
        try:
            if spec_of is not None:
                self._fill(self.numbers_of(spec_of(i), given=True)[np.newaxis], found[part], poles[part])
        except Heli2DofError:
            found[i, FOUND_OUTCOME] = nan
        if spec_of is None or found[i, FOUND_OUTCOME] != DONE:
            outcome = found[i, FOUND_OUTCOME]
            found[i], poles[i] = nan, nan
            found[i, FOUND_OUTCOME] = outcome
            found[i, FOUND_FIGURES + STABLE] = 0.0

    def _fill(self, rows: Floats, found: Floats, poles: Complexes) -> None:
        order, controller = self.order, self._task.rest.controller
        noise = NO_NOISE if controller is None else noise_of(self.spec.scenario, controller)
        # of poles alone a time is enough: nothing is integrated
        rigs, times = len(self._factors), RIGS_TIMES if self._rigs_respond else 1
        block, own, filled = (
            made(shapes)
            for shapes in (
                block_shapes(order, 2),
                rigs_shapes(order, rigs, times),
                designs_shapes(order, len(rows)),
            )
        )
        own[0][:] = np.linspace(0.0, self.spec.scenario.duration, times) if times > 1 else 0.0
        engine().run_designs(
            size_of(order),
            rows,
            noise,
            self._factors,
            RIGS_RTOL,
            *block,
            *scratch.update(order, 2),
            *own,
            *filled,
        )
        poles[:], found[:] = filled

    def values(self, rows: Floats, found: Found) -> Floats:
        """What was measured, (n, measures): NaN where there is none, ±∞ where it is unlimited, as which is better."""
        runs = ((None,) if self._together else ()) + self._alone
        return values_of(self.measures, rows, found.rows, runs)


def evaluate_many(
    specs: Sequence[Spec],
    measures: Sequence[Measure],
    *,
    factors: Floats | None = None,
    threads: int = 1,
    most_steps: int = MOST_STEPS,
    check: Callable[[], None] = nobody_leaves,
) -> Floats:
    """Figures of any designs, (n, measures), whatever they differ in; as `Many.values`.

    Args:
        specs: the designs, each with its experiment.
        measures: what is to be found.
        factors: as in `Many`.
        threads: likewise.
        most_steps: likewise.
        check: as in `Many.run`.
    """
    out = np.full((len(specs), len(measures)), nan)
    kinds: dict[tuple[object, ...], list[int]] = {}
    for i, spec in enumerate(specs):
        with suppress(Heli2DofError):  # a rig whose motors act alike has no design
            kinds.setdefault(_kind(spec), []).append(i)
    for places in kinds.values():
        many = Many(specs[places[0]], measures, factors=factors, threads=threads, most_steps=most_steps)
        rows, good = [], []
        for i in places:
            check()
            try:
                rows.append(many.numbers_of(specs[i]))
            except Heli2DofError:
                continue
            good.append(i)
        if good:
            table = np.array(rows)
            found = many.run(table, lambda k, own=tuple(good): specs[own[k]], check)
            out[good] = many.values(table, found)
    return out


def _kind(spec: Spec) -> tuple[object, ...]:
    """What designs have in common that `Many` runs together."""
    scenario = spec.scenario
    stepped = (scenario.theta is not None, scenario.psi is not None)
    heard = (scenario.noise, scenario.controller)
    return Task.of(_sparse(spec), each_axis=False).rest.order, *stepped, scenario.duration, *heard


def _sparse(spec: Spec) -> Spec:
    return spec if spec.scenario.samples == 2 else replace(spec, scenario=replace(spec.scenario, samples=2))
