"""One update in numbers: from a spec to what the kernel `update` takes, and what it fills."""

from __future__ import annotations

from math import inf, nan
from typing import Any

import numpy as np

from .couplings import STRUCTURES, Structure
from .estimators import Observer
from .kernels.layout import ALL_STATES, FILTERED_RATES, OBSERVED
from .kernels.update_layout import NUMBERS
from .scenario import Digital, Disturbance, Scenario
from .simulation.experiment import WINDUP
from .spec import Spec

_MEASURED = {"states": ALL_STATES, "filtered": FILTERED_RATES, "observer": OBSERVED}
_FAMILIES = {structure: float(i) for i, structure in enumerate(STRUCTURES)}
_USUAL, _DIGITAL, _NO_DISTURBANCE = Observer(), Digital(), Disturbance()
_NOTHING_GIVEN = (0.0,) * (NUMBERS - 84)


def numbers_of(spec: Spec, each_axis: bool = False, most_steps: int = 0) -> list[float]:
    """All that `update` takes of a spec, laid out as `kernels.update_layout` says, without what only K needs."""
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
        *_NOTHING_GIVEN,
    ]
