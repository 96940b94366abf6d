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
from .kernels.layout import ALL_STATES, FILTERED_RATES, OBSERVED, SIZES
from .kernels.update_layout import (
    AIMS,
    GIVEN_INTEGRAL,
    GIVEN_INVERSE,
    GIVEN_K,
    GIVEN_L,
    K_GIVEN,
    L_GIVEN,
    NUMBERS,
    OWN_INTEGRAL,
    block_shapes,
)
from .plant import plant
from .scenario import Digital, Disturbance
from .scratch import scratch
from .signals import Floats
from .simulation.digital import NO_NOISE, noise_of
from .simulation.experiment import WINDUP
from .spec import Spec

Block = dict[str, Any]
"""Arrays by name, as `kernels.update_layout.block_shapes` says, in one piece of memory."""

_MEASURED = {"states": ALL_STATES, "filtered": FILTERED_RATES, "observer": OBSERVED}
_FAMILIES = {structure: float(i) for i, structure in enumerate(STRUCTURES)}
_USUAL, _DIGITAL, _NO_DISTURBANCE = Observer(), Digital(), Disturbance()
_CLOSED_FORM = tuple(float(i == AIMS) for i in range(K_GIVEN, NUMBERS))
_ANOTHER_METHOD, _EXACT = 1.0, 2.0
"""Where K comes from that is given."""


def fill_block(
    spec: Spec, *, placed: Design | None, L: Floats | None, each_axis: bool, most_steps: int | None
) -> Block:
    """What the kernel `update` makes of a spec.

    Args:
        spec: what the user chose.
        placed: its design, where the kernel cannot find K itself: of another method, or where a closed form would
            lose digits.
        L: gain of the observer, 4×2, where it is no full-rank one's.
        each_axis: as in `evaluate`.
        most_steps: as in `evaluate`.
    """
    kernels, scenario = engine(), spec.scenario
    numbers = given_numbers(spec, placed, L, each_axis=each_axis, most_steps=most_steps or kernels.most_steps)
    size = size_of(spec)
    order = len(size)
    memory = np.empty((), _layout(order, scenario.samples))
    block = {name: memory[name] for name in memory.dtype.names or ()}
    noise = NO_NOISE if scenario.controller is None else noise_of(scenario, scenario.controller)
    kernels.update(size, numbers, noise, *block.values(), *scratch.update(order, scenario.samples))
    return block


def has_closed_form(spec: Spec) -> bool:
    """Whether `update` finds K itself."""
    return spec.method == FULL_RANK and not plant(spec.parameters, spec.theta_0).nearly_parallel


def size_of(spec: Spec) -> Any:
    """As many zeros as the kernels' states of a spec's loop (`kernels.layout.SIZES`)."""
    papers, with_rotors, full = SIZES
    if spec.scenario.measured != "states":
        return full
    return papers if spec.actuators is None else with_rotors


def given_numbers(
    spec: Spec, placed: Design | None, L: Floats | None, *, each_axis: bool, most_steps: int
) -> Floats:
    """`numbers_of` with K and L where these come from outside the kernel, (NUMBERS,)."""
    numbers = np.array(numbers_of(spec, each_axis, most_steps))
    if placed is not None:
        _give(numbers, placed)
    if L is not None:
        numbers[L_GIVEN], numbers[GIVEN_L:] = 1.0, L.ravel()
    return numbers


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


@lru_cache(maxsize=64)
def _layout(order: int, samples: int) -> np.dtype[np.void]:
    return np.dtype([(name, kind, shape) for name, (shape, kind) in block_shapes(order, samples).items()])


def numbers_of(spec: Spec, each_axis: bool, most_steps: int) -> list[float]:
    """All that `update` takes of a spec, laid out as `kernels.update_layout` says; K and L are not given yet."""
    limits, structure, outer, observer = spec.limits, spec.structure, spec.outer, spec.observer or _USUAL
    pitch, yaw = outer.pitch, outer.yaw
    rotors, frictions = spec.rotors.both, spec.friction.both
    scenario = spec.scenario
    digital, disturbance = scenario.controller, scenario.disturbance
    own, volts = digital or _DIGITAL, disturbance or _NO_DISTURBANCE
    return [
        *vars(spec.parameters).values(),
        spec.theta_0,
        limits.V_p,
        limits.V_y,
        inf if limits.theta is None else limits.theta,
        *(part for pole in spec.poles.values for part in (pole.real, pole.imag)),
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
        *(rotor.tau for rotor in rotors),
        *(rotor.curve == "quadratic" for rotor in rotors),
        *(rotor.dead_zone for rotor in rotors),
        *(rotor.matched_at or 0.0 for rotor in rotors),
        *(friction.coulomb for friction in frictions),
        *(friction.static or 0.0 for friction in frictions),
        _MEASURED[scenario.measured],
        *(part for pole in observer.poles.values for part in (pole.real, pole.imag)),
        _FAMILIES[observer.structure],
        *(nan if angle is None else angle for angle in (scenario.theta, scenario.psi)),
        *(nan if angle is None else angle for angle in scenario.initial),
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
        most_steps,
        *_CLOSED_FORM,
    ]
