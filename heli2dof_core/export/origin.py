"""Where an exported file comes from: rig, poles, version, and the call that makes it again."""

from __future__ import annotations

import json

from ..body import body_of
from ..placement.registry import METHODS
from ..presets import PRESETS, Preset
from ..signals import AXES
from ..spec import Spec
from ..version import package_version
from .machine import machine_lines, poles_in_words


def preset_of(spec: Spec) -> Preset:
    """The preset from which the spec differs least."""
    return PRESETS[body_of(spec)["preset"]]


def origin(spec: Spec, name: str, link: str = "") -> list[str]:
    """Plain lines in ASCII for the head of a file in the format `name`."""
    body = body_of(spec)
    preset, method = PRESETS[body["preset"]], METHODS[spec.method]
    changes = [f"{key} = {value!r}" for key, value in body.get("parameters", {}).items()]
    lines = [
        f"heli2dof {package_version()}",
        f"Rig: {preset.title}, preset {preset.name}" + (f", with {', '.join(changes)}" if changes else ""),
        f"Operating point: pitch {spec.theta_0!r} rad, yaw 0 rad",
        *machine_lines(spec),
        f"Requested poles: {poles_in_words(spec.poles.values)} rad/s"
        + (f", the rotors' {poles_in_words(spec.rotor_poles)} rad/s" if spec.place_rotors else "")
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
