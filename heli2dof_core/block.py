"""One update in numbers: from a spec to what the kernel `update` takes, and what it fills."""

from __future__ import annotations

from functools import lru_cache
from math import inf, nan
from typing import Any

import numpy as np

from .couplings import STRUCTURES
from .design import FULL_RANK, Design
from .engine import engine
from .estimators import Observer
from .kernels.layout import ALL_STATES, FILTERED_RATES, FULL, LAGGED, OBSERVED, PLAIN, SIZES
from .kernels.update_layout import (
    AIMS,
    GIVEN_INTEGRAL,
    GIVEN_INVERSE,
    GIVEN_K,
    GIVEN_L,
    K_GIVEN,
    L_GIVEN,
    MOST_STEPS,
    NUMBERS,
    OWN_INTEGRAL,
    POLES,
    ROTOR_POLES,
    WITHOUT_MARGINS,
    block_shapes,
)
from .plant import plant
from .poles import PoleSet
from .scenario import Digital, Disturbance
from .scratch import scratch
from .signals import Floats
from .simulation.digital import NO_NOISE, noise_of
from .simulation.experiment import WINDUP
from .spec import Spec

Block = dict[str, Any]
"""Arrays by name, as `kernels.update_layout.block_shapes` says, in one piece of memory."""

_MEASURED = {"states": ALL_STATES, "filtered": FILTERED_RATES, "observer": OBSERVED}
_SIZES: dict[int, Any] = dict(zip((PLAIN, LAGGED, FULL), SIZES, strict=True))
_FAMILIES = {structure: float(i) for i, structure in enumerate(STRUCTURES)}
_USUAL, _DIGITAL, _NO_DISTURBANCE = Observer(), Digital(), Disturbance()
_CLOSED_FORM = tuple(float(i == AIMS) for i in range(K_GIVEN, NUMBERS))
_ANOTHER_METHOD, _EXACT = 1.0, 2.0
"""Where K comes from that is given."""


def _parts(poles: PoleSet) -> tuple[float, ...]:
    p, q, r, s = poles.values
    return p.real, p.imag, q.real, q.imag, r.real, r.imag, s.real, s.imag


_USUAL_POLES = _parts(_USUAL.poles)


class Rest:
    """What of a task no pole changes.

    Attributes:
        spec: what the user chose, poles apart.
        each_axis: as in `evaluate`.
        plant: the rig at its operating point.
        order: number of the loop's states.
        controller: the digital one that is simulated; None where it is continuous.
        alone: the axes that are stepped alone, each in an experiment behind the scenario's.
        runs: how many experiments there are.
        has_closed_form: whether `update` finds K itself.
        has_kalman_filter: whether L comes from a Riccati equation.
    """

    __slots__ = (
        "alone",
        "controller",
        "each_axis",
        "has_closed_form",
        "has_kalman_filter",
        "order",
        "plant",
        "runs",
        "spec",
    )

    def __init__(self, spec: Spec, *, each_axis: bool) -> None:
        self.spec, scenario = spec, spec.scenario
        self.each_axis, self.plant = each_axis, plant(spec.parameters, spec.theta_0)
        order = PLAIN if spec.actuators is None else LAGGED
        self.order = order if scenario.measured == "states" else FULL
        self.controller = scenario.controller
        stepped = (name for name in ("theta", "psi") if getattr(scenario, name) is not None)
        self.alone = tuple(stepped) if each_axis else ()
        self.runs = 1 + len(self.alone)
        self.has_closed_form = spec.method == FULL_RANK and not self.plant.nearly_parallel
        kalman = spec.observer is not None and spec.observer.method == "kalman"
        self.has_kalman_filter = kalman and scenario.measured == "observer"


class Task:
    """A spec as `update` takes it.

    Attributes:
        spec: what the user chose.
        rest: what of it no pole changes.
        numbers: laid out as `kernels.update_layout` says; nobody has given K, L and steps yet.
    """

    __slots__ = ("numbers", "rest", "spec")

    def __init__(self, spec: Spec, rest: Rest, numbers: Floats) -> None:
        self.spec, self.rest, self.numbers = spec, rest, numbers

    @classmethod
    def of(cls, spec: Spec, *, each_axis: bool) -> Task:
        """The spec's."""
        return cls(spec, Rest(spec, each_axis=each_axis), np.array(numbers_of(spec, each_axis)))

    def with_poles(self, poles: PoleSet) -> Task:
        """The same with other poles."""
        numbers = self.numbers.copy()
        numbers[POLES:ROTOR_POLES] = _parts(poles)
        return Task(self.spec.with_poles(poles), self.rest, numbers)


def fill_block(
    task: Task, *, placed: Design | None, L: Floats | None, most_steps: int | None, passing: bool
) -> Block:
    """What the kernel `update` makes of a task.

    Args:
        task: the spec in numbers.
        placed: its design, where the kernel cannot find K itself: of another method, or where a closed form would
            lose digits.
        L: gain of the observer, 4×2, where it is no full-rank one's.
        most_steps: as in `evaluate`.
        passing: whether this thread's next passing block may overwrite it.
    """
    kernels, rest = engine(), task.rest
    numbers = given_numbers(task, placed, L, most_steps or kernels.most_steps)
    noise = NO_NOISE if rest.controller is None else noise_of(task.spec.scenario, rest.controller)
    room = (rest.order, task.spec.scenario.samples)
    block = scratch.block(room, _room) if passing else _room(*room)
    kernels.update(size_of(rest.order), numbers, noise, *block.values(), *scratch.update(*room))
    return block


def given_numbers(task: Task, placed: Design | None, L: Floats | None, most_steps: int) -> Floats:
    """The task's numbers with steps, and with K and L where these come from outside the kernel, (NUMBERS,)."""
    numbers = task.numbers.copy()
    numbers[MOST_STEPS] = most_steps
    if placed is not None:
        _give(numbers, placed)
    if L is not None:
        numbers[L_GIVEN], numbers[GIVEN_L:WITHOUT_MARGINS] = 1.0, L.ravel()
    return numbers


def size_of(order: int) -> Any:
    """What kernels take for a loop of so many states."""
    return _SIZES[order]


def _give(numbers: Floats, placed: Design) -> None:
    """Puts a design into the numbers."""
    K = np.zeros((2, 6))
    K[:, : placed.K.shape[1]] = placed.K
    numbers[K_GIVEN] = _EXACT if placed.structure is not None else _ANOTHER_METHOD
    numbers[GIVEN_K:GIVEN_INVERSE] = K.ravel()
    numbers[GIVEN_INVERSE:OWN_INTEGRAL] = placed.steady_state_inverse.ravel()
    numbers[AIMS] = placed.aims
    if placed.integral is not None:
        numbers[OWN_INTEGRAL], numbers[GIVEN_INTEGRAL:AIMS] = 1.0, placed.integral.ravel()


def _room(order: int, samples: int) -> Block:
    memory = np.empty((), _layout(order, samples))
    return {name: memory[name] for name in memory.dtype.names or ()}


@lru_cache(maxsize=64)
def _layout(order: int, samples: int) -> np.dtype[np.void]:
    return np.dtype([(name, kind, shape) for name, (shape, kind) in block_shapes(order, samples).items()])


def numbers_of(spec: Spec, each_axis: bool) -> list[float]:
    """All that `update` takes of a spec, laid out as `kernels.update_layout` says.

    Nobody has given K, L and steps yet.
    """
    limits, structure, outer, observer = spec.limits, spec.structure, spec.outer, spec.observer or _USUAL
    pitch, yaw = outer.pitch, outer.yaw
    scenario, (a, b), (c, d) = spec.scenario, spec.rotors.both, spec.friction.both
    digital, disturbance = scenario.controller, scenario.disturbance
    own, volts = digital or _DIGITAL, disturbance or _NO_DISTURBANCE
    theta, psi, *rates = scenario.initial
    return [
        *vars(spec.parameters).values(),
        spec.theta_0,
        limits.V_p,
        limits.V_y,
        inf if limits.theta is None else limits.theta,
        *_parts(spec.poles),
        *spec.rotor_poles,
        spec.place_rotors,
        _FAMILIES[structure.family],
        structure.shift is not None,
        structure.shift or 0.0,
        outer.outer == "pi",
        pitch.kp,
        pitch.ti,
        yaw.kp,
        yaw.ti,
        outer.pairing == "cross",
        outer.decoupler,
        a.tau,
        b.tau,
        a.curve == "quadratic",
        b.curve == "quadratic",
        a.dead_zone,
        b.dead_zone,
        a.matched_at or 0.0,
        b.matched_at or 0.0,
        c.coulomb,
        d.coulomb,
        c.static or 0.0,
        d.static or 0.0,
        _MEASURED[scenario.measured],
        *(_USUAL_POLES if observer is _USUAL else _parts(observer.poles)),
        _FAMILIES[observer.structure],
        nan if scenario.theta is None else scenario.theta,
        nan if scenario.psi is None else scenario.psi,
        nan if theta is None else theta,
        nan if psi is None else psi,
        *rates,
        scenario.duration,
        scenario.saturation,
        WINDUP[scenario.anti_windup],
        scenario.tracking_time or 0.0,
        scenario.travel_stops,
        scenario.trim_feedforward,
        scenario.rtol,
        digital is not None,
        own.sample_time,
        own.delay,
        *own.encoders,
        own.rates == "filtered",
        disturbance is not None,
        volts.V_p,
        volts.V_y,
        volts.time if disturbance else inf,
        each_axis,
        0.0,
        *_CLOSED_FORM,
    ]
