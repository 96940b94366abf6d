"""Where an exported file comes from: rig, poles, version, and the call that makes it again."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, fields
from typing import Any

from ..placement.registry import METHODS
from ..presets import PRESETS, Preset
from ..scenario import Digital, Scenario
from ..signals import AXES, INPUTS, OUTPUTS, STATES, Signal
from ..spec import Spec
from ..tables import number
from ..version import package_version
from ..weights import bryson_weights

Body = dict[str, Any]


def request_of(spec: Spec) -> Body:
    """The body of the REST calls (docs/api.md) that stands for this spec.

    It names the preset from which the spec differs least, and nothing else but these differences.
    """
    bodies = [_body(spec, preset) for preset in PRESETS.values()]
    return min(bodies, key=_size)


def preset_of(spec: Spec) -> Preset:
    """The preset from which the spec differs least."""
    return PRESETS[request_of(spec)["preset"]]


def origin(spec: Spec, name: str, link: str = "") -> list[str]:
    """Plain lines in ASCII for the head of a file in the format `name`."""
    body = request_of(spec)
    preset, method = PRESETS[body["preset"]], METHODS[spec.method]
    changes = [f"{key} = {value!r}" for key, value in body.get("parameters", {}).items()]
    lines = [
        f"heli2dof {package_version()}",
        f"Rig: {preset.title}, preset {preset.name}" + (f", with {', '.join(changes)}" if changes else ""),
        f"Operating point: pitch {spec.theta_0!r} rad, yaw 0 rad",
        f"Requested poles: {poles_in_words(spec.poles.values)} rad/s"
        + ("" if method.places_poles else f" ({method.name} chooses its own)"),
        f"Placement: {structure_in_words(spec)}; outer loop: {outer_in_words(spec)}",
        f"Made again by POST /api/v1/export/{name} with the body",
        json.dumps(body),
    ]
    return [*lines, f"Link: {link}"] if link else lines


def structure_in_words(spec: Spec) -> str:
    """The placement method and, for full-rank placement, its structure."""
    if not METHODS[spec.method].structured:
        return spec.method
    structure = spec.structure
    shift = "" if structure.shift is None else f", shift {structure.shift!r}"
    return f"full-rank, {structure.title}{shift}"


def outer_in_words(spec: Spec) -> str:
    """What is around the state feedback."""
    outer = spec.outer
    if METHODS[spec.method].integrates:
        return "the method's own integral action"
    if outer.outer == "none":
        return "none, v = G(0)^-1 r"
    gains = [
        f"{axis} kp {pi.kp!r} V/rad, Ti {pi.ti!r} s"
        for axis, pi in zip(AXES, (outer.pitch, outer.yaw), strict=True)
    ]
    more = (", cross pairing" if outer.pairing == "cross" else "") + (
        ", decoupler" if outer.decoupler else ""
    )
    return f"PI, {'; '.join(gains)}{more}"


def poles_in_words(poles: Iterable[complex]) -> str:
    """Poles as text, in ASCII."""
    return ", ".join(number(p, 6, minus="-", gap="") for p in poles)


def _size(value: object) -> int:
    if isinstance(value, dict):
        return sum(map(_size, value.values()))
    return sum(map(_size, value)) if isinstance(value, list) else 1


def _body(spec: Spec, preset: Preset) -> Body:
    structure, base = spec.structure, preset.structure
    outer = _outer(spec, preset)
    body: Body = {
        "preset": preset.name,
        "parameters": _differences(spec.parameters.as_dict(), preset.parameters.as_dict()),
        "limits": _differences(vars(spec.limits), vars(preset.limits)),
        "operating_point": {} if spec.theta_0 == preset.theta_0 else {"theta": spec.theta_0},
        "poles": [] if spec.poles == preset.poles else [_pole(p) for p in spec.poles.values],
        **({} if spec.method == "full-rank" else {"method": spec.method}),
        **({} if structure.coupling == base.coupling else {"coupling": structure.coupling}),
        **({} if structure.lead == base.lead else {"lead": structure.lead}),
        **({} if structure.shift is None else {"shift": structure.shift}),
        "weights": _weights(spec, preset),
        **outer,
        "scenario": _scenario(spec.scenario, preset),
    }
    return {name: value for name, value in body.items() if value not in ({}, [])}


def _differences(own: Mapping[str, Any], base: Mapping[str, Any]) -> Body:
    return {name: value for name, value in own.items() if value != base[name]}


def _pole(p: complex) -> float | Body:
    return {"re": p.real, "im": p.imag} if p.imag else p.real


def _outer(spec: Spec, preset: Preset) -> Body:
    own, base = asdict(spec.outer), asdict(preset.outer)
    loops = {axis: _differences(own.pop(axis), base.pop(axis)) for axis in AXES}
    return {**_differences(own, base), "loops": {axis: gains for axis, gains in loops.items() if gains}}


def _weights(spec: Spec, preset: Preset) -> Body:
    """Those of a quadratic method; others do not look at them."""
    if METHODS[spec.method].places_poles:
        return {}
    own, base = spec.weights or bryson_weights(spec.limits), bryson_weights(preset.limits)
    kinds: tuple[tuple[str, tuple[Signal, ...]], ...] = (
        ("states", STATES),
        ("inputs", INPUTS),
        ("integrals", OUTPUTS),
    )
    return {
        kind: {signal.name: value for signal, value in zip(signals, getattr(own, kind), strict=True)}
        for kind, signals in kinds
        if getattr(own, kind) != getattr(base, kind)
    }


def _scenario(scenario: Scenario, preset: Preset) -> Body:
    base, usual = preset.scenario, Scenario()
    own = {f.name: getattr(scenario, f.name) for f in fields(scenario)}
    reference = {name: own.pop(name) for name in ("theta", "psi")}
    initial, digital, disturbance = (own.pop(name) for name in ("initial", "digital", "disturbance"))
    body = _differences(own, vars(usual) | {"duration": base.duration, "samples": base.samples})
    if (scenario.theta, scenario.psi) != (base.theta, base.psi):
        body["reference"] = {name: angle for name, angle in reference.items() if angle is not None}
    if initial != usual.initial:
        start = zip((signal.name for signal in STATES), initial, strict=True)
        body["initial"] = {name: value for name, value in start if value is not None}
    if digital is not None:
        body["digital"] = _digital(digital, preset)
    if disturbance is not None:
        body["disturbance"] = asdict(disturbance)
    return body


def _digital(digital: Digital, preset: Preset) -> Body:
    own = asdict(digital)
    theta, psi = own.pop("encoders")
    return own if (theta, psi) == preset.encoders else {**own, "encoders": {"theta": theta, "psi": psi}}
