"""The smallest JSON body of the REST calls that stands for a spec: what differs from one of the presets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, fields
from typing import Any

from .estimators import Observer
from .placement.registry import METHODS
from .presets import PRESETS, Preset
from .request import WEIGHTED, Body
from .scenario import Digital, Scenario
from .signals import AXES, STATES
from .spec import Spec
from .weights import bryson_weights


def body_of(spec: Spec) -> Body:
    """The body of the REST calls (docs/api.md) that stands for this spec.

    It names the preset from which the spec differs least, and nothing else but these differences.
    """
    bodies = [_differing(spec, preset) for preset in PRESETS.values()]
    return min(bodies, key=_size)


def _size(value: object) -> int:
    if isinstance(value, dict):
        return sum(map(_size, value.values()))
    return sum(map(_size, value)) if isinstance(value, list) else 1


def _differing(spec: Spec, preset: Preset) -> Body:
    body: Body = {
        "preset": preset.name,
        "parameters": _differences(spec.parameters.as_dict(), preset.parameters.as_dict()),
        "limits": _differences(vars(spec.limits), vars(preset.limits)),
        "operating_point": {} if spec.theta_0 == preset.theta_0 else {"theta": spec.theta_0},
        "poles": [] if spec.poles == preset.poles else [_pole_body(p) for p in spec.poles.values],
        **({} if spec.method == "full-rank" else {"method": spec.method}),
        **_differences(vars(spec.structure), vars(preset.structure)),
        "weights": _weights_body(spec, preset),
        **_outer_body(spec, preset),
        **_machine_body(spec, preset),
        "scenario": _scenario_body(spec.scenario, preset),
    }
    return {name: value for name, value in body.items() if value not in ({}, [])}


def _differences(own: Mapping[str, Any], base: Mapping[str, Any]) -> Body:
    return {name: value for name, value in own.items() if value != base[name]}


def _pole_body(p: complex) -> float | Body:
    return {"re": p.real, "im": p.imag} if p.imag else p.real


def _outer_body(spec: Spec, preset: Preset) -> Body:
    own, base = asdict(spec.outer), asdict(preset.outer)
    loops = {axis: _differences(own.pop(axis), base.pop(axis)) for axis in AXES}
    return {**_differences(own, base), "loops": {axis: gains for axis, gains in loops.items() if gains}}


def _machine_body(spec: Spec, preset: Preset) -> Body:
    parts = {
        name: {
            axis: _differences(own, asdict(getattr(preset, name))[axis])
            for axis, own in asdict(getattr(spec, name)).items()
        }
        for name in ("rotors", "friction")
    }
    body: Body = {
        name: {axis: own for axis, own in by_axis.items() if own} for name, by_axis in parts.items()
    }
    if spec.place_rotors != preset.place_rotors:
        body["place_rotors"] = spec.place_rotors
    if spec.rotor_poles != preset.rotor_poles:
        body["rotor_poles"] = [*spec.rotor_poles]
    if spec.observer is not None:
        own, usual = vars(spec.observer), vars(Observer())
        body["observer"] = {
            name: value for name, value in own.items() if name != "poles" and value != usual[name]
        }
        body["observer"]["poles"] = [_pole_body(p) for p in spec.observer.poles.values]
    return body


def _weights_body(spec: Spec, preset: Preset) -> Body:
    """Those of a quadratic method; others do not look at them."""
    if METHODS[spec.method].places_poles:
        return {}
    own, base = spec.weights or bryson_weights(spec.limits), bryson_weights(preset.limits)
    return {
        kind: {signal.name: value for signal, value in zip(signals, getattr(own, kind), strict=True)}
        for kind, signals in WEIGHTED.items()
        if getattr(own, kind) != getattr(base, kind)
    }


def _scenario_body(scenario: Scenario, preset: Preset) -> Body:
    base, usual = preset.scenario, Scenario()
    own = {f.name: getattr(scenario, f.name) for f in fields(scenario)}
    reference = {name: own.pop(name) for name in ("theta", "psi")}
    initial, noise, digital, disturbance = (
        own.pop(name) for name in ("initial", "noise", "digital", "disturbance")
    )
    body = _differences(own, vars(usual) | {"duration": base.duration, "samples": base.samples})
    if (scenario.theta, scenario.psi) != (base.theta, base.psi):
        body["reference"] = {name: angle for name, angle in reference.items() if angle is not None}
    if initial != usual.initial:
        start = zip((signal.name for signal in STATES), initial, strict=True)
        body["initial"] = {name: value for name, value in start if value is not None}
    if noise != usual.noise:
        body["noise"] = dict(zip(("theta", "psi"), noise, strict=True))
    if digital is not None:
        body["digital"] = _digital_body(digital, preset)
    if disturbance is not None:
        body["disturbance"] = asdict(disturbance)
    return body


def _digital_body(digital: Digital, preset: Preset) -> Body:
    own = asdict(digital)
    theta, psi = own.pop("encoders")
    return own if (theta, psi) == preset.encoders else {**own, "encoders": {"theta": theta, "psi": psi}}
