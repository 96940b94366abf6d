"""Random designs of every kind that the page could be asked for: each has kernels called in its own way."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from heli2dof_core import AxisFriction, Friction, Rotor, Rotors, Scenario, Spec
from heli2dof_core.scenario import Digital, Disturbance
from tests.core.random_loops import random_spec


def random_designs(rng) -> Iterator[Spec]:
    """Without end: with and without rotors, friction, estimators, limits, disturbances and sampling."""
    while True:
        spec = replace(random_spec(rng, edges=False), scenario=_scenario(rng))
        if rng.random() < 0.5:
            spec = replace(spec, rotors=Rotors(_rotor(rng), _rotor(rng)))
        if rng.random() < 0.3:
            spec = replace(spec, friction=AxisFriction(_friction(rng), _friction(rng)))
        yield spec


def _rotor(rng):
    lag = float(rng.choice([0.0, 0.01, 0.05, 0.16]))
    if rng.random() < 0.4:
        return Rotor(lag, "quadratic", float(rng.choice([0.0, 1.0])), matched_at=12.0)
    return Rotor(lag)


def _friction(rng):
    coulomb = rng.uniform(0.0, 0.02)
    return Friction(coulomb, coulomb * rng.uniform(1.0, 1.5))


def _scenario(rng):
    duration = rng.uniform(1.0, 6.0)
    return Scenario(
        theta=rng.uniform(-0.4, 0.4),
        psi=rng.uniform(-1.5, 1.5),
        duration=duration,
        samples=int(rng.integers(21, 201)),
        saturation=bool(rng.random() < 0.8),
        anti_windup=("none", "clamping", "back-calculation")[rng.integers(3)],
        travel_stops=bool(rng.random() < 0.8),
        measured=("states", "filtered", "observer")[rng.choice(3, p=(0.6, 0.2, 0.2))],
        digital=Digital(0.01, delay=bool(rng.random() < 0.5)) if rng.random() < 0.3 else None,
        disturbance=Disturbance(*rng.uniform(-3, 3, 2), time=duration / 2) if rng.random() < 0.3 else None,
    )
