"""Design bodies in labs: parts of them in a file, whole ones for a step, and each as a flat table of what they say.

A flat table holds every quantity under its path (``loops.pitch.kp``), and the wholes ``preset``, ``method``,
``poles.pitch``, ``poles.yaw``, ``rotor_poles`` and ``observer.poles``; what is absent is left out.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from copy import deepcopy
from typing import Any

from ..errors import Heli2DofError
from ..presets import DEFAULT, PRESETS
from ..quantities import Field, quantities_of
from ..request import Body, Place, path_of, quantities, spec_of
from ..spec import Spec
from .amounts import plain_number
from .kinds import Amount, Flag, Kind, ListOf, MapOf, Number, OneOf, Reading, Schema, Unusable, known
from .nodes import Fields, Items, Node, Scalar

Flat = dict[str, Any]
WHOLES = ("preset", "method", "poles.pitch", "poles.yaw", "rotor_poles", "observer.poles")
PATHS: dict[str, tuple[Place, Field]] = {path: (place, known) for path, place, known in quantities()}
"""Every quantity of a body: its place and what it is."""


def flat_of(spec: Spec, preset: str) -> Flat:
    """All that a spec says."""
    values = [_pole(p) for p in spec.poles.values]
    found: Flat = {"preset": preset, "method": spec.method}
    found |= {"poles.pitch": values[:2], "poles.yaw": values[2:], "rotor_poles": [*spec.rotor_poles]}
    if spec.observer is not None:
        found["observer.poles"] = [_pole(p) for p in spec.observer.poles.values]
    for path, (place, _) in PATHS.items():
        instance: Any = spec
        for name in filter(None, place.attribute.split(".")):
            instance = None if instance is None else getattr(instance, name)
        value = None if instance is None else _part_of(instance, place, path)
        if value is not None:
            found[path] = value
    return found


def _part_of(instance: Any, place: Place, path: str) -> Any:
    name = path.removeprefix(f"{place.path}.")
    own, _, part = place.names.get(name, name).partition(".")
    value = getattr(instance, own)
    if not part or value is None:
        return value
    return value[[*quantities_of(type(instance))[own].quantity.parts].index(part)]


def _pole(p: complex) -> float | Body:
    return {"re": p.real, "im": p.imag} if p.imag else p.real


def body_of_flat(flat: Mapping[str, Any]) -> Body:
    """The body that says all that a flat table says; a reference always, so that none comes from the preset."""
    body: Body = {"scenario": {"reference": {}}}
    for path, value in flat.items():
        if path.startswith("poles."):
            continue
        *above, last = path.split(".")
        level = body
        for name in above:
            level = level.setdefault(name, {})
        level[last] = deepcopy(value)
    body["poles"] = [*flat["poles.pitch"], *flat["poles.yaw"]]
    return body


def flat_body(body: Mapping[str, Any]) -> Flat:
    """A body as a flat table, with all that comes from its preset.

    Raises:
        Heli2DofError: as `spec_of`.
    """
    return flat_of(spec_of(body), body.get("preset", DEFAULT))


def merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> Body:
    """A body with what another says; a reference and lists are replaced as a whole, None takes away."""
    found = dict(base)
    for name, value in changes.items():
        if value is None:
            found.pop(name, None)
        elif isinstance(value, Mapping) and isinstance(found.get(name), Mapping) and name != "reference":
            found[name] = merged(found[name], value)
        else:
            found[name] = deepcopy(value)
    return found


_COMPLEX = re.compile(
    r"\s*(?P<re>[^±]*?[^\s±eE+−–-])?\s*(?P<sign>±|\+/?-|[+−–-])?\s*(?P<im>[^\s±]*?)\s*\*?[ij]\s*"
)


class Poles:
    """A list of poles: numbers, ``-3 ± 4j`` for two, ``-3 + 4j``, or ``{re: -3, im: 4}``."""

    def __init__(self, count: int) -> None:
        self.count = count

    def read(self, node: Node, at: Reading, path: str) -> list[Any]:
        """As a body holds them."""
        if not isinstance(node, Items):
            raise at.refuse(
                node, path, f"this is {node.kind}, not a list of poles", "Write [-2, -3, -4 ± 2j]."
            )
        found: list[Any] = []
        for i, item in enumerate(node.items):
            at.places[f"{path}[{i}]"] = item
            found += self._pole(item, at, f"{path}[{i}]")
        if len(found) != self.count:
            hint = f"Give {self.count}; -3 ± 4j counts as two."
            raise at.refuse(node, path, f"there are {len(found)} poles", hint)
        return found

    def _pole(self, node: Node, at: Reading, path: str) -> list[Any]:
        if isinstance(node, Fields):
            parts = {
                name: Number(-1e5, 1e5).read(own, at, f"{path}.{name}")
                for name, (_, own) in node.fields.items()
            }
            if set(parts) == {"re", "im"}:
                return [parts]
        elif isinstance(node, Scalar):
            value = node.value
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                return [float(value)]
            poles = _poles_in(node.text)
            if poles:
                return poles
        raise at.refuse(node, path, "this is no pole", "Write -3, -3 + 4j, -3 ± 4j or {re: -3, im: 4}.")

    def schema(self) -> Schema:
        """An array."""
        pole: Schema = {
            "anyOf": [
                {"type": ["number", "string"]},
                {
                    "type": "object",
                    "properties": {"re": {"type": "number"}, "im": {"type": "number"}},
                    "required": ["re", "im"],
                    "additionalProperties": False,
                },
            ]
        }
        return {"type": "array", "items": pole, "minItems": (self.count + 1) // 2, "maxItems": self.count}


def _poles_in(text: str) -> list[Any]:
    """One pole, or two conjugates; none where it is no pole."""
    real = plain_number(text)
    if real is not None:
        return [real]
    match = _COMPLEX.fullmatch(text)
    if match is None:
        return []
    re_, im = plain_number(match["re"] or "0"), plain_number(match["im"] or "1")
    if re_ is None or im is None:
        return []
    if match["sign"] in ("±", "+-", "+/-"):
        return [{"re": re_, "im": im}, {"re": re_, "im": -im}]
    return [{"re": re_, "im": -im if match["sign"] in ("-", "−", "–") else im}]


class BodyPart:
    """A part of a design body (docs/api.md): values in SI units, or text with a unit."""

    def __init__(self, sections: tuple[str, ...] = ()) -> None:
        """`sections`: the names right below it that are allowed; all where empty."""
        self.tree: dict[str, Any] = {}
        for path, (_, field) in PATHS.items():
            self._put(path, _kind_of(field))
        words = {"preset": OneOf(tuple(PRESETS)), "method": OneOf(_methods()), "poles": Poles(4)}
        words |= {"rotor_poles": Poles(2), "observer.poles": Poles(4)}
        words |= {"split": ListOf(ListOf(Number(0, 3, whole=True), 2, 2), 2, 2)}
        for path, kind in words.items():
            self._put(path, kind)
        if sections:
            self.tree = {name: own for name, own in self.tree.items() if name in sections}

    def _put(self, path: str, kind: Kind[Any]) -> None:
        *above, last = path.split(".")
        level = self.tree
        for name in above:
            level = level.setdefault(name, {})
        level[last] = kind

    def read(self, node: Node, at: Reading, path: str) -> Body:
        """The part, with plain values; null takes away what a design has."""
        return self._read(node, at, path, self.tree)

    def _read(self, node: Node, at: Reading, path: str, tree: Mapping[str, Any]) -> Body:
        if not isinstance(node, Fields):
            hint = f"Give fields: {', '.join([*tree][:6])} …"
            raise at.refuse(node, path, f"this is {node.kind}, not a part of a design", hint)
        found, bad = {}, False
        for name, (key, value) in node.fields.items():
            own = f"{path}.{name}"
            at.places[own] = value
            if name not in tree:
                at.tell(key, own, f"a design has no field {name} here", known(name, [*tree]))
                bad = True
                continue
            try:
                found[name] = self._value(value, at, own, tree[name])
            except Unusable:
                bad = True
        if bad:
            raise Unusable(path)
        return found

    def _value(self, node: Node, at: Reading, path: str, kind: Any) -> Any:
        if isinstance(node, Scalar) and not node.quoted and node.value is None:
            return None
        if isinstance(kind, dict):
            return self._read(node, at, path, kind)
        return kind.read(node, at, path)

    def schema(self) -> Schema:
        """An object with the names of the contract."""
        return _object(self.tree)


def _object(tree: Mapping[str, Any]) -> Schema:
    properties = {}
    for name, own in tree.items():
        inner = _object(own) if isinstance(own, dict) else own.schema()
        properties[name] = {"anyOf": [inner, {"type": "null"}]}
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _kind_of(field: Field) -> Kind[Any]:
    about = field.quantity
    if field.choices:
        return OneOf(field.choices)
    if field.kind is bool:
        return Flag()
    low, high = about.low, about.high
    assert low is not None and high is not None, field.name
    return Number(low, high, whole=True) if field.kind is int else Amount(about.unit, low, high)


def _methods() -> tuple[str, ...]:
    from ..placement.registry import METHODS

    return tuple(METHODS)


SPREAD = MapOf(Amount("", 0.0, 0.95), names="parameters")
"""Relative half widths, by what they are of."""


def tell_refusal(error: Heli2DofError, at: Reading, path: str) -> None:
    """Notes what the core refuses of a body, where it stands in the file."""
    inner = re.sub(r"\.(\d+)(?=\.|$)", r"[\1]", path_of(error.field)) if error.field else ""
    at.tell_at(f"{path}.{inner}" if inner else path, str(error), error.hint)
