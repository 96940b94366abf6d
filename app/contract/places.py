"""Where the core's quantities stand in the body of a request: the one table between the core's names and the API's.

Requests, their schema, replies of presets, the command line's options, the page's module of quantities and the field
that an error names follow from it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from heli2dof_core.couplings import Structure
from heli2dof_core.errors import within_field
from heli2dof_core.parameters import Parameters
from heli2dof_core.quantities import Field, quantities_of
from heli2dof_core.recordings.recording import Columns
from heli2dof_core.robustness import Uncertainty
from heli2dof_core.scenario import Digital, Disturbance, Limits, OuterLoop, PIGains, Scenario
from heli2dof_core.spec import Spec

T = TypeVar("T")


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

    def fields(self) -> dict[str, Field]:
        """The quantities by their names in the object."""
        known = quantities_of(self.cls)
        names = self.names or {name: name for name in known if name not in _elsewhere(self)}
        return {name: _part(known, own) for name, own in names.items()}

    def proposed(self, name: str) -> bool:
        """Whether what is left out comes from the preset."""
        return self.by_preset is None or name in self.by_preset

    def given(self, request: Any) -> dict[str, Any]:
        """What a request's object says, by the fields of the core; where it gives a tuple's part, the whole of it."""
        values: dict[str, Any] = {}
        own = request.model_fields_set
        for name, known in self.fields().items():
            value = getattr(request, name)
            if "." in self.names.get(name, ""):
                values.setdefault(known.name, []).append(value)
            elif name in own and (value is not None or known.quantity.absent):
                values[known.name] = value
        return {name: tuple(v) if isinstance(v, list) else v for name, v in values.items()}

    def changed(self, base: T, request: Any, **others: Any) -> T:
        """`base` with what the request's object says, and with `others`; errors name the core's field."""
        changes = {**self.given(request), **others}
        if not changes:
            return base
        with within_field(self.attribute):
            return replace(base, **changes)  # pyright: ignore[reportArgumentType, reportCallIssue, reportUnknownVariableType]

    def proposal(self, instance: object) -> dict[str, Any]:
        """What a preset's own instance proposes there, by the names in the object; what is absent is left out."""
        own = {
            name: getattr(instance, known.name)
            for name, known in self.fields().items()
            if self.proposed(name)
        }
        return {name: value for name, value in own.items() if value is not None}


STRUCTURE = Place("", "structure", Structure, by_preset=None)
OUTER = Place("", "outer", OuterLoop, by_preset=None)
LOOP = {axis: Place(f"loops.{axis}", f"outer.{axis}", PIGains, by_preset=None) for axis in ("pitch", "yaw")}
POINT = Place("operating_point", "", Spec, {"theta": "theta_0"}, by_preset=None)
PARAMETERS = Place("parameters", "parameters", Parameters, by_preset=None)
LIMITS = Place("limits", "limits", Limits, by_preset=None)
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
DIGITAL = Place("scenario.digital", "scenario.digital", Digital)
ENCODERS = Place(
    "scenario.digital.encoders",
    "scenario.digital",
    Digital,
    {"theta": "encoders.theta", "psi": "encoders.psi"},
)
DISTURBANCE = Place("scenario.disturbance", "scenario.disturbance", Disturbance)
DESIGN = (POINT, PARAMETERS, LIMITS, STRUCTURE, OUTER, *LOOP.values())
EXPERIMENT = (SCENARIO, REFERENCE, INITIAL, DIGITAL, ENCODERS, DISTURBANCE)
UNCERTAINTY = Place("", "", Uncertainty)
COLUMNS = Place("columns", "columns", Columns)
_WHOLES = {"outer": "loops", "spread": "uncertainty"}
"""What no quantity of its own stands for: in the core → in a request."""
_ALL = (*DESIGN, *EXPERIMENT, COLUMNS)


def quantities() -> Iterator[tuple[str, Place, Field]]:
    """Every quantity of a design and its experiment: its path in a request, its place, and what it is."""
    for place in _ALL:
        for name, known in place.fields().items():
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
        for name in place.fields():
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
    return replace(found, default=found.default[at], quantity=found.quantity.parts[part])
