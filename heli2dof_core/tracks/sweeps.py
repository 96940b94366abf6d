"""What a number does to the loop: the poles at each of its values, and the figures there.

Four kinds: designs, each made anew for its value; one design's loop under a factor on its voltages; one design's law
on rigs that differ; and one law, run at different sample times.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import nan
from typing import Literal, Protocol

import numpy as np

from ..augmentation import augmented_loop
from ..errors import Heli2DofError, InvalidInputError
from ..evaluate import loop_of
from ..kernels.update_layout import (
    AIMS,
    CONNECTED,
    DONE,
    FOUND_FIGURES,
    FOUND_OUTCOME,
    GIVEN_INTEGRAL,
    GIVEN_INVERSE,
    GIVEN_K,
    OWN_INTEGRAL,
    PI_GAINS,
    STABLE,
)
from ..loop import Loop
from ..many import Many, Measure, evaluate_many
from ..plant import plant
from ..request import PARAMETERS, POINT, ROTOR, Place
from ..scenario import Digital
from ..signals import Complexes, Floats
from ..spec import Spec
from .numbers import GAINS, SAMPLE_TIME, Number
from .sampled import sampled_loop

Plane = Literal["s", "z"]
Check = Callable[[], None]
ON_THE_AXIS = 1e-9
"""A pole counts as on the stability border where it is as near to it, relative to the loop's fastest pole."""
AT_ZERO = 1e-7
"""Several poles as near to 0, relative to the fastest, are one multiple pole: rounding parts it by its root."""


class Sweep(Protocol):
    """How poles and figures follow from values of one number."""

    plane: Plane

    def poles(self, values: Floats) -> tuple[Complexes, np.ndarray]:
        """At n values: the poles (n, order), in any order, NaN where there is no such loop; and which are stable."""
        ...

    def figures(self, values: Floats, measures: Sequence[Measure], check: Check) -> Floats:
        """(n, measures), as `Many.values`."""
        ...


def sweep_of(spec: Spec, number: Number, values: Floats, *, kept: bool, threads: int) -> Sweep:
    """How this number is swept.

    Args:
        spec: the design.
        number: what is swept.
        values: of it; the first of which there is a loop says how many states it has.
        kept: whether the gains stay as they are and the rig alone changes.
        threads: for figures.

    Raises:
        Heli2DofError: there is no loop at any of the values, or no gains are kept where this number changes.
    """
    if number.spec_at is None:
        return Gain(spec, GAINS[number.path], threads)
    if number.path == SAMPLE_TIME:
        return Sampled(spec, number, threads)
    if kept:
        return Kept(spec, number)
    return Designs(number, values, threads)


class Designs:
    """A design for each value: gains are chosen anew, as a request with this value would have it."""

    plane: Plane = "s"

    def __init__(self, number: Number, values: Floats, threads: int) -> None:
        assert number.spec_at is not None
        self._spec_at, self._threads = number.spec_at, threads
        self._many = self._first(values.tolist())
        self._connected = 0

    def _first(self, values: list[float]) -> Many:
        refused: Heli2DofError | None = None
        for value in values[len(values) // 2 :] + values[: len(values) // 2]:
            try:
                return Many(self._spec_at(value), ())
            except Heli2DofError as error:
                refused = refused or error
        raise refused or InvalidInputError("there are no values", field="track.over")

    def poles(self, values: Floats) -> tuple[Complexes, np.ndarray]:
        """As `Sweep`."""
        rows, there = [], []
        for i, value in enumerate(values.tolist()):
            try:
                rows.append(self._many.numbers_of(self._spec_at(value)))
            except Heli2DofError:
                continue
            there.append(i)
        poles = np.full((len(values), self._many.order), complex(nan, nan))
        stable = np.zeros(len(values), dtype=bool)
        if rows:
            own = values[there].tolist()
            found = self._many.run(np.array(rows), lambda k: self._spec_at(own[k]))
            done = found.rows[:, FOUND_OUTCOME] == DONE
            poles[there] = np.where(done[:, None], found.poles, complex(nan, nan))
            stable[there] = done & (found.rows[:, FOUND_FIGURES + STABLE] != 0.0)
            connected = found.rows[done, FOUND_FIGURES + CONNECTED]
            self._connected = max(self._connected, int(connected.max(initial=0)))
        return poles[:, : self._connected], stable

    def figures(self, values: Floats, measures: Sequence[Measure], check: Check) -> Floats:
        """As `Sweep`."""
        return _of_designs(self._spec_at, values, measures, self._threads, check)


class _OfMatrices:
    """Poles as eigenvalues of a matrix that a value gives."""

    plane: Plane = "s"

    def matrix(self, value: float) -> Floats:
        """A of the loop, or Φ, m×m."""
        raise NotImplementedError

    def poles(self, values: Floats) -> tuple[Complexes, np.ndarray]:
        """As `Sweep`."""
        found: list[Floats | None] = []
        for value in values.tolist():
            try:
                found.append(self.matrix(value))
            except Heli2DofError:
                found.append(None)
        size = max((len(A) for A in found if A is not None), default=0)
        poles = np.full((len(values), size), complex(nan, nan))
        there = [i for i, A in enumerate(found) if A is not None and len(A) == size]
        if there:
            poles[there] = np.linalg.eigvals(np.array([found[i] for i in there]))
            if self.plane == "s":
                poles[there] = gathered(poles[there])
        return poles, np.all(side(poles, self.plane) < -border(poles, self.plane)[:, None], axis=1)


class Gain(_OfMatrices):
    """The loop as designed, with a factor on both motors' voltages or on one's, as margins have it.

    The factor acts between controller and rig: an observer knows the voltages without it.
    """

    def __init__(self, spec: Spec, motor: int | None, threads: int) -> None:
        self._spec, self._motor, self._threads = spec, motor, threads
        loop = loop_of(spec)
        at = np.ix_(loop.connected, loop.connected)
        motors = (0, 1) if motor is None else (motor,)
        self.inputs, self.law = (
            loop.motors[list(loop.connected)],
            loop.voltage_from_state[:, list(loop.connected)],
        )
        self.inputs, self.law = self.inputs[:, motors], self.law[list(motors)]
        self._change = self.inputs @ self.law
        # with both, nothing of the law is left: made without it, so that what is 0 is so exactly
        self.open = without_voltages(loop)[at] if motor is None else loop.A[at] - self._change
        self._estimator = loop.estimator

    def matrix(self, value: float) -> Floats:
        """As in `_OfMatrices`."""
        return self.open + value * self._change

    def figures(self, values: Floats, measures: Sequence[Measure], check: Check) -> Floats:
        """As `Sweep`; the law times the factor as a law of its own.

        Raises:
            InvalidInputError: no law is like it: an observer would know of the factor, or a decoupler mixes motors.
        """
        spec, motor = self._spec, self._motor
        if self._estimator is not None and self._estimator.L is not None:
            raise _no_figures(
                "an observer would know of the factor", "Measure the states, or leave figures out."
            )
        outer, pi = spec.outer, spec.outer.outer == "pi"
        if motor is not None and pi and outer.decoupler:
            raise _no_figures(
                "a decoupler mixes the motors", "Sweep gain, of both motors, or leave figures out."
            )
        many = Many(spec, measures, threads=self._threads)
        rows = np.tile(many.numbers_of(spec, given=True), (len(values), 1))
        rows[:, AIMS] = 0.0
        for j in (0, 1) if motor is None else (motor,):
            rows[:, GIVEN_K + 6 * j : GIVEN_K + 6 * j + 6] *= values[:, None]
            if rows[0, OWN_INTEGRAL]:
                rows[:, GIVEN_INTEGRAL + 2 * j : GIVEN_INTEGRAL + 2 * j + 2] *= values[:, None]
            elif pi:
                axis = 1 - j if outer.pairing == "cross" else j
                rows[:, PI_GAINS + 2 * axis] *= values
            else:
                rows[:, GIVEN_INVERSE + 2 * j : GIVEN_INVERSE + 2 * j + 2] *= values[:, None]
        return many.values(rows, many.run(rows, None, check))


_OF_RIG: tuple[Place, ...] = (PARAMETERS, POINT, *ROTOR.values())
"""What a law may be kept for, while it changes."""


class Kept(_OfMatrices):
    """One law on rigs that differ: K, the outer loops and an estimator stay as they were designed."""

    def __init__(self, spec: Spec, number: Number) -> None:
        path = number.path
        prefixes = [*(f"{place.path}." for place in _OF_RIG), "rotors."]
        if number.spec_at is None or not any(path.startswith(prefix) for prefix in prefixes):
            raise InvalidInputError(
                f"gains cannot be kept where {path} is swept, which is of the law",
                field="track.kept",
                value=True,
                hint="Keep them for a number of the rig: parameters, operating_point.theta, rotors.",
            )
        self._spec_at = number.spec_at
        self._loop = loop_of(spec)

    def matrix(self, value: float) -> Floats:
        """As in `_OfMatrices`."""
        spec, loop = self._spec_at(value), self._loop
        design = replace(loop.design, plant=plant(spec.parameters, spec.theta_0), actuators=spec.actuators)
        outer = (loop.proportional, loop.integral, loop.voltage_from_reference)
        _, A, _, places, _ = augmented_loop(design, design.actuators, loop.estimator, outer)
        apart = {loop.places[i] for i in range(len(loop.A)) if i not in loop.connected}
        kept = [i for i, place in enumerate(places) if place not in apart]
        return A[np.ix_(kept, kept)]

    def figures(self, values: Floats, measures: Sequence[Measure], check: Check) -> Floats:
        """As `Sweep`; there are none.

        Raises:
            InvalidInputError: always, where any are asked for.
        """
        raise _no_figures(
            "figures are of designs, and the gains are kept", "Leave out the figures, or keep no gains."
        )


class Sampled(_OfMatrices):
    """One law under a digital controller that samples at different rates: poles in the z-plane."""

    plane: Plane = "z"

    def __init__(self, spec: Spec, number: Number, threads: int) -> None:
        assert number.spec_at is not None
        self._digital = spec.scenario.controller or Digital()
        self._loop = loop_of(spec)
        self._open = without_voltages(self._loop)
        self._spec_at, self._threads = number.spec_at, threads

    def matrix(self, value: float) -> Floats:
        """As in `_OfMatrices`."""
        whole = sampled_loop(self._loop, self._open, replace(self._digital, sample_time=value))
        kept = [*self._loop.connected, *range(len(self._loop.A), len(whole))]
        return whole[np.ix_(kept, kept)]

    def figures(self, values: Floats, measures: Sequence[Measure], check: Check) -> Floats:
        """As `Sweep`."""
        return _of_designs(self._spec_at, values, measures, self._threads, check)


def _of_designs(
    spec_at: Callable[[float], Spec], values: Floats, measures: Sequence[Measure], threads: int, check: Check
) -> Floats:
    """Figures of the specs at these values; NaN where there is none."""
    out = np.full((len(values), len(measures)), nan)
    specs, there = [], []
    for i, value in enumerate(values.tolist()):
        try:
            specs.append(spec_at(value))
        except Heli2DofError:
            continue
        there.append(i)
    if specs:
        out[there] = evaluate_many(specs, measures, threads=threads, check=check)
    return out


def without_voltages(loop: Loop) -> Floats:
    """A of the loop's states where the motors have no voltage, n×n; an estimator still knows what is asked for."""
    design, own = loop.design, loop.estimator
    nothing = np.zeros((2, 2))
    outer = (nothing, None if loop.integral is None else nothing, nothing)
    idle = replace(design, K=np.zeros_like(design.K))
    _, A, _, _, _ = augmented_loop(idle, design.actuators, own, outer)
    if own is not None:
        inner = [i for i, place in enumerate(loop.places) if place >= 8]
        A[inner] += own.H @ loop.voltage_from_state
    return A


def gathered(poles: Complexes) -> Complexes:
    """The rows (n, order) with each multiple pole at 0 in one place: the mean, which rounding leaves alone."""
    size = np.abs(poles)
    near = size <= AT_ZERO * np.max(size, axis=1, keepdims=True, initial=0.0)
    count = near.sum(axis=1, keepdims=True)
    mean = np.where(near, poles.real, 0.0).sum(axis=1, keepdims=True) / np.maximum(count, 1)
    return np.where(near & (count > 1), mean + 0j, poles)


def side(poles: Complexes, plane: Plane) -> Floats:
    """How far poles lie on the wrong side of the border: Re p, rad/s, or ln |z|."""
    if plane == "s":
        return poles.real
    with np.errstate(divide="ignore"):
        return np.log(np.abs(poles))


def border(poles: Complexes, plane: Plane) -> Floats:
    """Within which a pole of these rows (n, order) counts as on the border, (n,), in the unit of `side`."""
    if plane == "z":
        return np.full(len(poles), ON_THE_AXIS)
    return ON_THE_AXIS * np.max(np.abs(poles), axis=1, initial=0.0)


def _no_figures(why: str, hint: str) -> InvalidInputError:
    return InvalidInputError(
        f"there are no figures along this track: {why}", field="track.measures", hint=hint
    )
