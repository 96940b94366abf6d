"""Figures of merit of one controller on many rigs: of each rig what `evaluate` tells of the nominal one.

Controller and trim stay as they were designed. Nothing is sampled: margins and responses come from the kernels that
an update uses, with the rig's own numbers, so that a rig without differences has the nominal figures, bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import inf, nan
from typing import Any

import numpy as np

from .block import size_of
from .engine import engine
from .errors import InvalidInputError
from .figures import AXIS_METRICS
from .kernels.layout import ALL_STATES, COURSE, MARGINS, MOTOR_METRICS, PLAIN, TAU
from .kernels.update_layout import (
    ANGLE,
    CONNECTED,
    DONE,
    FOUND,
    FOUND_AXES,
    FOUND_COURSES,
    FOUND_FIGURES,
    FOUND_INVERSE,
    FOUND_K,
    FOUND_MARGINS,
    FOUND_MOTORS,
    FOUND_OUTCOME,
    FOUND_RUNS,
    FOUND_SENSITIVITY,
    LAG_MARGIN,
    MEASURED,
    MOST_STEPS,
    NO_EIGENVALUES,
    OWN_INTEGRAL,
    PI_LOOPS,
    ROTORS_PLACED,
    RTOL,
    STABLE,
    WITHOUT_LAG_MARGIN,
    WITHOUT_LINEAR,
    WITHOUT_MARGINS,
    WITHOUT_RIG,
    WITHOUT_UNSTABLE,
    block_shapes,
    made,
    rigs_shapes,
    scratch_shapes,
)
from .many import MOST_STEPS as MANY_STEPS
from .many import SHARES, Found, Many, Measure
from .scenario import Scenario
from .scratch import scratch
from .signals import Complexes, Floats
from .simulation.digital import NO_NOISE
from .simulation.nonlinear import ABSOLUTE_TOLERANCE
from .spec import Spec

RTOL_OF_NOTHING = 1e-3
"""Of the response that `run_rigs` is asked for at its first time alone: nothing is integrated."""
SLICE = 16
"""Rigs between two checks whether the work is still wanted: a few milliseconds."""


def require_continuous(scenario: Scenario) -> None:
    """Refuses what the kernels of uncertain rigs do not know.

    Raises:
        InvalidInputError: the scenario has a digital controller, noise or a disturbance.
    """
    for name, there in (
        ("digital", scenario.digital is not None),
        ("disturbance", scenario.disturbance is not None),
        ("noise", any(scenario.noise)),
    ):
        if there:
            raise InvalidInputError(
                f"uncertain rigs take no {name}: their controller is continuous and their motors undisturbed",
                field=f"scenario.{name}",
                hint="Leave it out.",
            )


class OnRigs:
    """One design, to be put on rigs that differ from its own.

    Args:
        spec: the nominal rig with its design and experiment.
        measures: what is to be found; linear responses are those of a rig that the nominal trim holds at rest.
        most_steps: of a nonlinear response.
        unstable: whether responses of unstable loops are computed; else these have no figures.

    Raises:
        InvalidInputError: the scenario has what uncertain rigs do not take, or a measure is a share of them.
        Heli2DofError: the design does not exist.
    """

    def __init__(
        self,
        spec: Spec,
        measures: Sequence[Measure],
        *,
        most_steps: int = MANY_STEPS,
        unstable: bool = True,
    ) -> None:
        _require_of_each(measures)
        many = Many(spec, measures, unstable=unstable, most_steps=most_steps)
        self._begin(many, many.row)
        if self._block["outcome"][0] != DONE:
            self._begin(many, many.numbers_of(spec, given=True))
        self._require_done()

    @classmethod
    def of(cls, many: Many, row: Floats) -> OnRigs:
        """A design among many, by its numbers (NUMBERS,).

        Raises:
            InvalidInputError: as above; where K has to come from outside the kernel, the numbers have to hold it.
        """
        own = cls.__new__(cls)
        own._begin(many, row)
        own._require_done()
        return own

    def _begin(self, many: Many, row: Floats) -> None:
        require_continuous(many.spec.scenario)
        _require_of_each(many.measures)
        self.many, self._order, self._row = many, many.order, row
        self._block = self._designed(row)
        self._runs = int(self._block["outcome"][1])
        self._states = int(self._block["figures"][CONNECTED])
        self._apart = _apart(row, self._block["integral"])
        simple = row[MEASURED] == ALL_STATES and not row[ROTORS_PLACED]
        self._simple = simple and not np.any(self._block["actuators"][:2])
        shapes = rigs_shapes(self._order, 1, 1)
        self._room = dict(zip(shapes, made(shapes), strict=True))
        sizes = {"states": (self._order + 1, 2), "voltages": (2, 2), "axes": (2, AXIS_METRICS)}
        sizes |= {"motors": (2, MOTOR_METRICS), "course": (COURSE,)}
        self._of_run = {name: np.zeros(shape) for name, shape in sizes.items()}

    def _require_done(self) -> None:
        if self._block["outcome"][0] != DONE:
            raise InvalidInputError("there is no such design: nothing was found for these poles")

    @property
    def row(self) -> Floats:
        """The design's numbers, K and L within where they come from outside the kernel, (NUMBERS,)."""
        return self._row

    def found(self, factors: Floats, check: Callable[[], None] = lambda: None) -> Found:
        """What the kernels have found of each rig, as `Many.run` gives it of each design.

        Args:
            factors: by which each rig's parameters and time constants differ from the nominal ones, (n, FACTORS).
            check: called after every few rigs; what it raises ends the work.
        """
        rows, poles = (
            np.full((len(factors), FOUND), nan),
            np.zeros((len(factors), self._order), np.complex128),
        )
        block = self._block
        rows[:, FOUND_FIGURES:FOUND_SENSITIVITY] = block["figures"]
        rows[:, FOUND_K:FOUND_INVERSE] = block["K"].ravel()
        rows[:, FOUND_INVERSE:] = block["inverse"].ravel()
        work = dict(zip(scratch_shapes(self._order, 2), scratch.update(self._order, 2), strict=True))
        room = (*block.values(), *work.values(), *self._room.values())
        for i in range(len(factors)):
            if i % SLICE == 0:
                check()
            self._fill(factors[i : i + 1], rows[i], poles[i], work, room)
        return Found(rows, poles)

    def values(self, factors: Floats, check: Callable[[], None] = lambda: None) -> Floats:
        """What was measured, (n, measures): NaN where there is none, ±∞ where it is unlimited; as `Many.values`."""
        found = self.found(factors, check)
        return self.values_of(found)

    def values_of(self, found: Found) -> Floats:
        """The same of what was found."""
        return self.many.values(np.broadcast_to(self._row, (len(found.rows), len(self._row))), found)

    def _designed(self, row: Floats) -> dict[str, Any]:
        """The block of the nominal design, without margins and responses."""
        quick = row.copy()
        quick[[WITHOUT_MARGINS, WITHOUT_LAG_MARGIN, WITHOUT_LINEAR, WITHOUT_RIG]] = 1.0
        quick[WITHOUT_UNSTABLE] = 0.0  # its experiments are wanted as numbers
        shapes = block_shapes(self._order, 2)
        block = dict(zip(shapes, made(shapes), strict=True))
        room = scratch.update(self._order, 2)
        engine().update(size_of(self._order), quick, NO_NOISE, *block.values(), *room)
        return block

    def _fill(
        self, factors: Floats, row: Floats, poles: Complexes, work: dict[str, Any], room: tuple[Any, ...]
    ) -> None:
        """One rig, of factors (1, FACTORS); `work` is this thread's scratch by name, `room` all that is filled."""
        numbers, own = self._row, self._room
        engine().run_rigs(size_of(self._order), numbers, factors, RTOL_OF_NOTHING, *room)
        connected = own["rig_poles"][0, : self._states]
        row[FOUND_OUTCOME], row[FOUND_RUNS] = DONE, 0.0
        if np.isnan(connected).any():
            row[FOUND_OUTCOME] = NO_EIGENVALUES
            return
        poles[: self._states] = connected
        stable = own["stable"][0] != 0.0
        row[FOUND_FIGURES + STABLE] = stable
        self._judge(row, connected, work, stable=stable)
        if stable or not numbers[WITHOUT_UNSTABLE]:
            ends = _with_zeros(connected, self._apart)
            for run in range(self._runs):
                self._respond(run, row, ends, work)
            row[FOUND_RUNS] = self._runs

    def _judge(self, row: Floats, connected: Complexes, work: Mapping[str, Any], *, stable: bool) -> None:
        """Lag margin, margins and sensitivity, of the polynomials that `run_rigs` has left."""
        kernels, numbers = engine(), self._row
        loop = work["f"] if self._simple else work["f_whole"]
        row[FOUND_FIGURES + LAG_MARGIN] = nan
        if not numbers[WITHOUT_LAG_MARGIN]:
            start = float(max(self._room["rig_actuators"][:2])) if numbers[ROTORS_PLACED] else 0.0
            least = kernels.lag_margin(loop, start, work["lag"])
            row[FOUND_FIGURES + LAG_MARGIN] = least if least > start or stable else inf
        if stable and not numbers[WITHOUT_MARGINS]:
            table = np.full((2, MARGINS), nan)
            kernels.margins(loop, work["opened"], work["p"], table)
            row[FOUND_MARGINS:FOUND_COURSES] = table.ravel()
            both = row[FOUND_SENSITIVITY:FOUND_MARGINS]
            kernels.sensitivity_peaks(loop, connected, work["frequencies"], both)

    def _respond(self, run: int, row: Floats, ends: Complexes, work: Mapping[str, Any]) -> None:
        """Both models' responses in one experiment, as far as they are wanted."""
        numbers, own, x = self._row, self._room, self._block["experiments"][run]
        kernels, size, block, t = engine(), size_of(self._order), self._block, self._block["t"]
        states, voltages, axes, motors, course = self._of_run.values()
        most = int(numbers[MOST_STEPS])
        for model in range(2):
            axes.fill(0.0)
            motors.fill(0.0)
            course.fill(0.0)
            if model == 0 and not numbers[WITHOUT_LINEAR]:
                kernels.run_linear(
                    size, numbers[ANGLE], block["law"], block["by_reference"], own["rig_whole"], own["rig_driven"],
                    ends, x, work["inner"][0], t, most, block["trim"], work["v"], work["ladder"], work["nodes"],
                    work["followed"], states, voltages, axes, motors, course,
                )  # fmt: skip
            if model == 1 and not numbers[WITHOUT_RIG]:
                c, modes, rtol = work["c"], work["m"], float(numbers[RTOL])
                kernels.nonlinear_loop(
                    size, work["rig"], block["trim"], numbers[ANGLE], block["law"], block["by_reference"],
                    block["integral"], x, work["more"], c, modes,
                )  # fmt: skip
                if len(size) > PLAIN:
                    c[TAU : TAU + 2] = own["rig_actuators"][:2]
                kernels.run_nonlinear(
                    size, c, modes, ends, x, work["inner"][1], t, inf, rtol, ABSOLUTE_TOLERANCE * rtol, most,
                    block["trim"], work["w"], work["raw"], work["grid"], work["followed"], states[: self._order],
                    voltages, axes, motors, course,
                )  # fmt: skip
            n = 2 * run + model
            at = FOUND_COURSES + n * COURSE
            row[at : at + COURSE] = course
            at = FOUND_MOTORS + 2 * n * MOTOR_METRICS
            row[at : at + 2 * MOTOR_METRICS] = motors.ravel()
            at = FOUND_AXES + 2 * n * AXIS_METRICS
            row[at : at + 2 * AXIS_METRICS] = axes.ravel()


def _require_of_each(measures: Sequence[Measure]) -> None:
    for own in measures:
        if own.name in SHARES:
            raise InvalidInputError(
                f"{own.name} is of all rigs together, not of each", field="measure", hint="Leave it out."
            )


def _apart(row: Floats, integral: Floats) -> int:
    """How many integrals drive nothing: they are no part of the loop, but poles at 0."""
    if not row[PI_LOOPS] and not row[OWN_INTEGRAL]:
        return 0
    return sum(not np.any(integral[:, axis]) for axis in range(2))


def _with_zeros(connected: Complexes, apart: int) -> Complexes:
    """All poles, from the right to the left, and of conjugates the upper first."""
    if not apart:
        return np.ascontiguousarray(connected)
    poles = np.concatenate((connected, np.zeros(apart, dtype=np.complex128)))
    return poles[np.lexsort((-poles.imag, -poles.real))]
