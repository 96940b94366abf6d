"""Random specs of all kinds that one kernel answers: rigs, structures, loops, rotors, observers, controllers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from heli2dof_core import Heli2DofError, Observer, PIGains, Spec
from heli2dof_core.couplings import Structure
from heli2dof_core.presets import PRESETS
from heli2dof_core.rotors import AxisFriction, Friction, Rotor, Rotors
from heli2dof_core.scenario import Digital, Disturbance
from tests.strategies import STRUCTURES

PRESET_NAMES = tuple(PRESETS)


def random_specs(count: int, seed: int, **scenario) -> Iterator[Spec]:
    """Specs whose values are all allowed; some of their loops are unstable. `scenario`: what all of them share."""
    rng = np.random.default_rng(seed)
    found = 0
    while found < count:
        try:
            spec = _spec(rng)
            yield replace(spec, scenario=replace(spec.scenario, **scenario))
            found += 1
        except Heli2DofError:
            continue


def _spec(rng) -> Spec:
    spec = Spec.from_preset(PRESET_NAMES[rng.integers(len(PRESET_NAMES))])
    scale = 10 ** rng.uniform(-0.5, 0.5)
    loops = [PIGains(rng.uniform(1, 40), rng.uniform(0.05, 1.0)) for _ in range(2)]
    spec = spec.changed(
        poles=[scale * p for p in (*_pair(rng), *_pair(rng))],
        pitch=loops[0],
        yaw=loops[1],
        outer="pi" if rng.random() < 0.7 else "none",
        pairing="cross" if rng.random() < 0.2 else "diagonal",
        decoupler=bool(rng.random() < 0.3),
        theta_0=rng.uniform(-0.4, 0.4),
        reference=tuple(None if rng.random() < 0.15 else rng.uniform(-0.4, 0.4) for _ in range(2)),
        duration=rng.uniform(0.5, 8.0),
        measured=("states", "states", "filtered", "observer")[rng.integers(4)],
        observer=Observer(Spec.from_preset(poles=[3 * scale * p for p in (*_pair(rng), *_pair(rng))]).poles),
    )
    structure = STRUCTURES[rng.integers(4)]
    if structure.coupling != "axis-decoupled" and rng.random() < 0.3:
        structure = Structure(structure.coupling, structure.lead, rng.uniform(-1, 1))
    p = spec.parameters
    varied = {name: getattr(p, name) * rng.uniform(0.8, 1.25) for name in vars(p)}
    kinds = _machine(rng) if rng.random() < 0.5 else {}
    experiment = {
        "saturation": bool(rng.random() < 0.8),
        "anti_windup": ("none", "clamping", "back-calculation")[rng.integers(3)],
        "travel_stops": bool(rng.random() < 0.8),
        "trim_feedforward": bool(rng.random() < 0.8),
        "digital": _digital(rng) if rng.random() < 0.3 else None,
        "disturbance": Disturbance(*rng.uniform(-2, 2, 2), rng.uniform(0, 1)) if rng.random() < 0.3 else None,
    }
    scenario = replace(spec.scenario, **experiment)
    return replace(spec, structure=structure, scenario=scenario, **kinds).changed(parameters=varied)


def _machine(rng) -> dict:
    def rotor() -> Rotor:
        curve = "quadratic" if rng.random() < 0.3 else "linear"
        tau = rng.uniform(0.01, 0.3) if rng.random() < 0.8 else 0.0
        return Rotor(tau, curve, rng.uniform(0, 1) if curve == "quadratic" else 0.0)

    both = Rotors(rotor(), rotor())
    friction = AxisFriction()
    if rng.random() < 0.4:
        friction = AxisFriction(*(Friction(rng.uniform(0, 0.01), rng.uniform(0, 0.02)) for _ in range(2)))
    placed = both.pitch.tau > 0 and both.yaw.tau > 0 and rng.random() < 0.6
    return {
        "rotors": both,
        "friction": friction,
        "place_rotors": bool(placed),
        "rotor_poles": tuple(rng.uniform(-30, -8, 2)),
    }


def _digital(rng) -> Digital:
    counts = tuple(int(c) for c in rng.integers(0, 3, 2) * 4096)
    return Digital(
        rng.uniform(0.001, 0.01),
        delay=bool(rng.random() < 0.3),
        encoders=counts,
        rates="true" if rng.random() < 0.3 else "filtered",
    )


def _pair(rng) -> tuple[complex, complex]:
    re = -rng.uniform(1, 12)
    if rng.random() < 0.5:
        im = rng.uniform(0.5, 12)
        return complex(re, im), complex(re, -im)
    return complex(re), complex(-rng.uniform(1, 15))
