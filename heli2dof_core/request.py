"""The JSON body of the REST calls that stands for a design and its experiment: from it, to it, and what stands where.

One table says where the core's quantities stand in a body: requests and their schema, presets' replies, the command
line's options, the page's module of quantities and the field that an error names follow from it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, replace
from functools import cache, cached_property
from typing import Any, TypeVar

from .body_shape import POLES, SPLIT, TEXT, require_shape
from .checks import require_known
from .couplings import Structure
from .design import FULL_RANK
from .errors import within_field
from .estimators import Observer
from .parameters import Parameters
from .placement.method import Weights
from .placement.registry import METHODS
from .poles import PoleSet
from .presets import DEFAULT, Preset, preset
from .quantities import Field, quantities_of
from .rotors import Friction, Rotor
from .scenario import Digital, Disturbance, Limits, OuterLoop, PIGains, Scenario
from .signals import AXES, INPUTS, OUTPUTS, STATES, Signal
from .spec import Spec
from .weights import bryson_weights

T = TypeVar("T")
Body = dict[str, Any]


@dataclass(frozen=True)
class Place:
    """Quantities of one class of the core, in one object of a request.

    Attributes:
        path: of that object in the request's JSON; empty for the request itself.
        attribute: by which the class' instance is reached in the core, from a `Spec`; empty for the `Spec` itself.
        cls: the class.
        names: in the object → of the field, or of one part of it (``initial.theta``); by default all of the class
            under their own names, but for what other places hold.
        by_preset: names of which the preset has its own value: what is left out comes from there; None: of all.
    """

    path: str
    attribute: str
    cls: type
    names: Mapping[str, str] = field(default_factory=dict)
    by_preset: Collection[str] | None = ()

    @cached_property
    def fields(self) -> dict[str, Field]:
        """The quantities by their names in the object."""
        known = quantities_of(self.cls)
        names = self.names or {name: name for name in known if name not in _elsewhere(self)}
        return {name: _part(known, own) for name, own in names.items()}

    def proposed(self, name: str) -> bool:
        """Whether what is left out comes from the preset."""
        return self.by_preset is None or name in self.by_preset

    def given(self, values: Mapping[str, Any] | None) -> dict[str, Any]:
        """What an object says, by the fields of the core; where it gives a tuple's part, the whole of it."""
        found: dict[str, Any] = {}
        if not values:
            return found
        known = self.fields
        for name, value in values.items():
            own = known.get(name)
            if own is None or (value is None and not own.quantity.absent):
                continue
            if "." in self.names.get(name, ""):
                return self._whole(values)
            found[own.name] = value
        return found

    def _whole(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """A tuple of which some parts are given."""
        (field,) = {known.name for known in self.fields.values()}
        given = [(values.get(name), known) for name, known in self.fields.items()]
        return {
            field: tuple(
                known.default if v is None and not known.quantity.absent else v for v, known in given
            )
        }

    def changed(self, base: T, values: Mapping[str, Any] | None, **others: Any) -> T:
        """`base` with what an object says, and with `others`; errors name the core's field."""
        changes = {**self.given(values), **others}
        if all(getattr(base, name) == value for name, value in changes.items()):
            return base
        with within_field(self.attribute):
            return replace(base, **changes)  # pyright: ignore[reportArgumentType, reportCallIssue, reportUnknownVariableType]

    def proposal(self, instance: object) -> dict[str, Any]:
        """What a preset's own instance proposes there, by the names in the object; what is absent is left out."""
        own = {
            name: _value(instance, self.names.get(name, name)) for name in self.fields if self.proposed(name)
        }
        return {name: value for name, value in own.items() if value is not None}


STRUCTURE = Place("", "structure", Structure, by_preset=None)
OUTER = Place("", "outer", OuterLoop, by_preset=None)
LOOP = {axis: Place(f"loops.{axis}", f"outer.{axis}", PIGains, by_preset=None) for axis in AXES}
POINT = Place("operating_point", "", Spec, {"theta": "theta_0"}, by_preset=None)
PARAMETERS = Place("parameters", "parameters", Parameters, by_preset=None)
LIMITS = Place("limits", "limits", Limits, by_preset=None)
ROTOR = {axis: Place(f"rotors.{axis}", f"rotors.{axis}", Rotor, by_preset=None) for axis in AXES}
FRICTION = {axis: Place(f"friction.{axis}", f"friction.{axis}", Friction, by_preset=None) for axis in AXES}
ROTORS = Place("", "", Spec, {"place_rotors": "place_rotors"}, by_preset=None)
OBSERVER = Place("observer", "observer", Observer)
SCENARIO = Place("scenario", "scenario", Scenario, by_preset=("duration", "samples"))
REFERENCE = Place(
    "scenario.reference", "scenario", Scenario, {"theta": "theta", "psi": "psi"}, by_preset=None
)
INITIAL = Place(
    "scenario.initial",
    "scenario",
    Scenario,
    {name: f"initial.{name}" for name in ("theta", "psi", "theta_dot", "psi_dot")},
)
NOISE = Place("scenario.noise", "scenario", Scenario, {"theta": "noise.theta", "psi": "noise.psi"})
DIGITAL = Place("scenario.digital", "scenario.digital", Digital)
ENCODERS = Place(
    "scenario.digital.encoders",
    "scenario.digital",
    Digital,
    {"theta": "encoders.theta", "psi": "encoders.psi"},
)
DISTURBANCE = Place("scenario.disturbance", "scenario.disturbance", Disturbance)
MACHINE = (*ROTOR.values(), *FRICTION.values())
WEIGHTED: dict[str, tuple[Signal, ...]] = {"states": STATES, "inputs": INPUTS, "integrals": OUTPUTS}
"""Per kind of weights the signals that they belong to."""
WEIGHTS = {
    kind: Place(
        f"weights.{kind}",
        "weights",
        Weights,
        {signal.name: f"{kind}.{signal.name}" for signal in signals},
        by_preset=None,
    )
    for kind, signals in WEIGHTED.items()
}
DESIGN = (
    *(POINT, PARAMETERS, LIMITS, STRUCTURE, OUTER, *LOOP.values(), *MACHINE, ROTORS, OBSERVER),
    *WEIGHTS.values(),
)
EXPERIMENT = (SCENARIO, REFERENCE, INITIAL, NOISE, DIGITAL, ENCODERS, DISTURBANCE)
_WHOLES = {"outer": "loops", "spread": "uncertainty"}
"""What no quantity of its own stands for: in the core → in a request."""
_ALL = (*DESIGN, *EXPERIMENT)


def quantities(places: Iterable[Place] | None = None) -> Iterator[tuple[str, Place, Field]]:
    """Every quantity at some places, by default of a design and its experiment: its path, its place, what it is."""
    for place in _ALL if places is None else places:
        for name, known in place.fields.items():
            yield f"{place.path}.{name}".lstrip("."), place, known


def path_of(field: str) -> str:
    """The path in a request of what the core calls `field`; other paths as they are."""
    first, dot, rest = field.partition(".")
    if first in _WHOLES and (first == "spread" or not dot):
        return f"{_WHOLES[first]}{dot}{rest}"
    for place in sorted(_ALL, key=lambda p: -len(p.attribute)):
        if place.attribute and field != place.attribute and not field.startswith(f"{place.attribute}."):
            continue
        rest = field.removeprefix(place.attribute).removeprefix(".")
        for name in place.fields:
            own = place.names.get(name, name)
            if rest == own or rest.startswith(f"{own}."):
                return f"{place.path}.{name}{rest.removeprefix(own)}".lstrip(".")
    return field


def _elsewhere(place: Place) -> set[str]:
    return {
        own.partition(".")[0]
        for other in _ALL
        if other is not place and other.attribute == place.attribute
        for own in other.names.values()
    }


def _part(known: Mapping[str, Field], own: str) -> Field:
    name, _, part = own.partition(".")
    found = known[name]
    if not part:
        return found
    at = [*found.quantity.parts].index(part)
    default = found.default[at] if isinstance(found.default, tuple) and found.default else MISSING
    return replace(found, default=default, quantity=found.quantity.parts[part])


def _value(instance: object, own: str) -> Any:
    """Of a field, or of one part of it."""
    name, _, part = own.partition(".")
    value = getattr(instance, name)
    return value[[*quantities_of(type(instance))[name].quantity.parts].index(part)] if part else value


def spec_of(body: Mapping[str, Any]) -> Spec:
    """The spec for which a body stands; what it leaves out comes from its preset, or from the default one.

    >>> spec_of({"poles": [-12, -10, {"re": -3, "im": 4}, {"re": -3, "im": -4}], "lead": "yaw"}).structure.lead
    'yaw'

    Raises:
        Heli2DofError: a value is out of its range or unknown; its field is the core's (see `path_of`).
    """
    require_shape(body, _tree())
    return judged_spec(body)


def judged_spec(body: Mapping[str, Any]) -> Spec:
    """As `spec_of`, of a body whose fields' names a schema has judged already."""
    base, loops = preset(_given(body, "preset", DEFAULT)), body.get("loops") or {}
    method = _given(body, "method", FULL_RANK)
    require_known(method, METHODS, "method")  # also where another is used
    pi = {axis: place.changed(getattr(base.outer, axis), loops.get(axis)) for axis, place in LOOP.items()}
    return Spec(
        parameters=PARAMETERS.changed(base.parameters, body.get("parameters")),
        limits=LIMITS.changed(base.limits, body.get("limits")),
        theta_0=POINT.given(body.get("operating_point")).get("theta_0", base.theta_0),
        poles=_poles(body.get("poles"), body.get("split"), base),
        structure=STRUCTURE.changed(base.structure, body),
        outer=OUTER.changed(base.outer, body, **pi),
        scenario=_scenario(body.get("scenario") or {}, base),
        method=method,
        weights=_weights(body.get("weights") or {}, bryson_weights(base.limits)),
        rotors=_by_axis(ROTOR, base.rotors, body.get("rotors")),
        friction=_by_axis(FRICTION, base.friction, body.get("friction")),
        place_rotors=base.place_rotors if body.get("place_rotors") is None else body["place_rotors"],
        rotor_poles=_rotor_poles(body.get("rotor_poles"), base),
        observer=_observer(body.get("observer")),
    )


def _given(body: Mapping[str, Any], name: str, default: str) -> str:
    value = body.get(name)
    return default if value is None else value


def _by_axis(places: Mapping[str, Place], base: T, given: Mapping[str, Any] | None) -> T:
    """Rotors or friction with what is given of each axis."""
    if not given:
        return base
    own = {axis: place.changed(getattr(base, axis), given.get(axis)) for axis, place in places.items()}
    return type(base)(**own)


def _rotor_poles(given: Any, base: Preset) -> Any:
    return base.rotor_poles if given is None else tuple(_complex(pole) for pole in given)


def _observer(given: Mapping[str, Any] | None) -> Observer | None:
    if given is None:
        return None
    poles = given.get("poles")
    with within_field("observer"):
        whole = {} if poles is None else {"poles": PoleSet(_complex(pole) for pole in poles)}
    return OBSERVER.changed(Observer(), given, **whole)


@cache
def _tree() -> dict[str, Any]:
    """The names of a body's fields, below one another, with what stands there (see `body_shape`)."""
    whole = dict.fromkeys(("preset", "method", "scenario.model"), TEXT)
    whole |= dict.fromkeys(("poles", "rotor_poles", "observer.poles"), POLES)
    tree: dict[str, Any] = {}
    for path, kind in ({**whole, "split": SPLIT} | {path: known for path, _, known in quantities()}).items():
        *above, name = path.split(".")
        level = tree
        for part in above:
            level = level.setdefault(part, {})
        level[name] = kind
    return tree


NAMES = set(_tree())
"""What a body holds of a design and its experiment, right below itself."""


def _poles(poles: Any, split: Any, base: Preset) -> PoleSet:
    if poles is None and split is None:
        return base.poles
    return poles_of(base.poles.values if poles is None else [_complex(pole) for pole in poles], split)


def poles_of(values: Sequence[complex], split: Any) -> PoleSet:
    """The poles asked for, dealt into pairs as `split` says, if it says so."""
    return PoleSet(values) if split is None else PoleSet.dealt(values, split)


def _complex(pole: Any) -> complex:
    return complex(pole["re"], pole["im"]) if isinstance(pole, Mapping) else pole


def _scenario(given: Mapping[str, Any], base: Preset) -> Scenario:
    others = INITIAL.given(given["initial"]) if "initial" in given else {}
    if given.get("reference") is not None:
        others |= {"theta": None, "psi": None, **REFERENCE.given(given["reference"])}
    if given.get("noise") is not None:
        others |= NOISE.given(given["noise"])
    digital = given.get("digital")
    if digital is not None:
        counts = digital.get("encoders")
        encoders = {} if counts is None else ENCODERS.given(counts)
        others["digital"] = DIGITAL.changed(Digital(encoders=base.encoders), digital, **encoders)
    if given.get("disturbance") is not None:
        others["disturbance"] = DISTURBANCE.changed(Disturbance(), given["disturbance"])
    return SCENARIO.changed(base.scenario, given, **others)


def _weights(given: Mapping[str, Mapping[str, Any]], base: Weights) -> Weights:
    def merged(kind: str, signals: tuple[Signal, ...]) -> tuple[float, ...]:
        own = given.get(kind) or {}
        values = (own.get(signal.name) for signal in signals)
        return tuple(b if v is None else v for v, b in zip(values, getattr(base, kind), strict=True))

    return Weights(**{kind: merged(kind, signals) for kind, signals in WEIGHTED.items()}) if given else base
