"""A design as a flight takes it: its rig and its digital controller in numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..block import Task, given_numbers
from ..engine import engine
from ..errors import InvalidInputError
from ..estimators import estimator
from ..evaluate import place
from ..frozen import Frozen
from ..kernels.flight_layout import FLIGHT_CONTROLLER, TICKS
from ..kernels.layout import SIZES, TIME
from ..kernels.update_layout import (
    DONE,
    EACH_AXIS,
    STABLE,
    WITHOUT_LAG_MARGIN,
    WITHOUT_LINEAR,
    WITHOUT_MARGINS,
    WITHOUT_RIG,
    WITHOUT_SCENARIO,
    block_shapes,
    made,
    scratch_shapes,
)
from ..scenario import SAMPLED, Digital
from ..signals import Floats
from ..simulation.digital import NO_NOISE
from ..spec import Spec

FLOWN = SIZES[2]
"""The size of every flight's loop, that of `kernels.flight`, which would load Numba."""
SAMPLES = 2
"""Of the responses that an update would have: a flight asks for none."""


@dataclass(frozen=True)
class FlightController(Frozen):
    """A design's rig and controller as `kernels.flight.fly` takes them.

    Attributes:
        spec: the design; `flyable` of it.
        numbers: of its update, (NUMBERS,): what makes the same controller anywhere.
        c, k, estimated: Floats, laid out as `kernels.layout` and `kernels.flight_layout` say.
        m: modes, likewise.
        start: where its experiment begins, (14,).
        stable: whether the linear loop is.
    """

    spec: Spec
    numbers: Floats
    c: Floats
    k: Floats
    estimated: Floats
    m: NDArray[np.int64]
    start: Floats
    stable: bool

    @classmethod
    def of(cls, spec: Spec) -> FlightController:
        """That of a design.

        Raises:
            Heli2DofError: the design does not exist.
        """
        flown = flyable(spec)
        task = Task.of(flown, each_axis=False)
        rest = task.rest
        placed = None if rest.has_closed_form and not rest.has_kalman_filter else place(flown)
        found = _made(task, placed)
        if found["outcome"][0] != DONE and placed is None:
            found = _made(task, place(flown))  # which takes exact numbers, or says why there is none
        if found["outcome"][0] != DONE:
            raise InvalidInputError(
                "the eigenvalues of its loop were not found", hint="Move a pole, or change a gain."
            )
        return cls(
            flown,
            found["numbers"],
            found["c"],
            found["k"],
            found["estimated"],
            found["m"],
            found["start"],
            bool(found["figures"][STABLE]),
        )

    @property
    def ticks_per_sample(self) -> int:
        """Ticks in a sample of the controller."""
        return int(self.k[TICKS])

    @property
    def tick(self) -> float:
        """Length of a tick, s."""
        return float(self.k[TIME] / self.k[TICKS])


def flyable(spec: Spec) -> Spec:
    """The same with a digital controller: a continuous one is flown as one that samples every 2 ms, exactly."""
    scenario = spec.scenario
    digital = scenario.digital
    if digital is None:
        rates = "true" if scenario.measured == "states" else "filtered"
        digital = Digital(SAMPLED, encoders=(0, 0), rates=rates)
    return replace(
        spec, scenario=replace(scenario, digital=digital, duration=1.0, samples=SAMPLES, disturbance=None)
    )


def _made(task: Task, placed: Any) -> dict[str, Any]:
    spec, rest = task.spec, task.rest
    L = None
    if placed is not None and rest.has_kalman_filter:
        own = estimator(placed, spec.scenario.measured, spec.observer)
        L = own and own.L
    numbers = given_numbers(task, placed, L, 1)
    for flag in (WITHOUT_MARGINS, WITHOUT_LAG_MARGIN, WITHOUT_LINEAR, WITHOUT_RIG, WITHOUT_SCENARIO):
        numbers[flag] = 1.0
    numbers[EACH_AXIS] = 0.0
    shapes = {**block_shapes(len(FLOWN), SAMPLES), **scratch_shapes(len(FLOWN), SAMPLES)}
    arrays = made(shapes)
    k = np.zeros(FLIGHT_CONTROLLER)
    engine().flight_controller(FLOWN, numbers, NO_NOISE, *arrays, k)
    by_name = dict(zip(shapes, arrays, strict=True))
    return {
        "numbers": numbers,
        "k": k,
        **{n: by_name[n].copy() for n in ("outcome", "c", "m", "estimated", "start", "figures")},
    }
