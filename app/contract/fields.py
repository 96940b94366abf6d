"""What the requests' fields are made of: strict models, ranges, whole numbers, poles."""

from __future__ import annotations

from dataclasses import MISSING
from itertools import permutations
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema, create_model

from heli2dof_core.poles import LARGEST
from heli2dof_core.presets import PRESETS
from heli2dof_core.quantities import Field as Quantified
from heli2dof_core.request import Place


class Strict(BaseModel):
    """Unknown fields, text for numbers, NaN and infinity are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


def _whole(value: Any) -> Any:
    """2.0 is an integer in JSON Schema's sense, and so here."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


Whole = Annotated[int, BeforeValidator(_whole)]


def asked(*places: Place) -> type[Strict]:
    """The base of a request's object: the quantities that stand there, with their ranges, defaults and words.

    Ranges are for the schema alone: the core checks them too, and its messages name the unit.
    """
    own: dict[str, Any] = {}
    for place in places:
        for name, known in place.fields.items():
            required = known.default is MISSING
            proposed = place.proposed(name) or required
            kind = _kind(known)
            none = proposed or known.default is None
            default = None if proposed else known.default
            own[name] = (
                kind | None if none else kind,
                Field(default=default, description=known.quantity.described),
            )
    return create_model("Asked", __base__=Strict, **own)


def _kind(known: Quantified) -> Any:
    about = known.quantity
    if about.low is None:
        return known.kind
    bounds = Field(json_schema_extra={"minimum": about.low, "maximum": about.high})
    return Annotated[Whole if known.kind is int else float, bounds]


PresetName = Annotated[str, Field(json_schema_extra={"enum": [*PRESETS]})]


def complex_number(value: Any) -> complex:
    """A plain number, or ``{"re": …, "im": …}``; ranges are the core's business."""
    re, im = value, 0.0
    if isinstance(value, dict):
        if value.keys() != _PARTS:
            raise ValueError('a complex number is {"re": -3.0, "im": 4.0}')
        re, im = value["re"], value["im"]
    if not (_is_number(re) and _is_number(im)):
        raise ValueError('a pole is a number, or {"re": -3.0, "im": 4.0}')
    try:
        return complex(re, im)
    except OverflowError as error:
        raise ValueError("a pole's parts must be finite numbers") from error


def _is_number(part: Any) -> bool:
    return type(part) is float or (isinstance(part, (int, float)) and not isinstance(part, bool))


_PARTS = {"re", "im"}
_NUMBER = {"type": "number", "minimum": -LARGEST, "maximum": LARGEST}
Pole = Annotated[
    complex,
    BeforeValidator(complex_number),
    WithJsonSchema(
        {
            "anyOf": [
                _NUMBER,
                {
                    "type": "object",
                    "properties": {"re": _NUMBER, "im": _NUMBER},
                    "required": ["re", "im"],
                    "additionalProperties": False,
                },
            ],
            "description": "rad/s; a real pole may be a plain number",
        }
    ),
]

Split = Annotated[
    list[list[Annotated[Whole, Field(ge=0, le=3)]]],
    Field(json_schema_extra={"enum": [[[a, b], [c, d]] for a, b, c, d in permutations(range(4))]}),
]
Weight = Annotated[float, Field(ge=0, le=1e12)]
PositiveWeight = Annotated[float, Field(ge=1e-12, le=1e12)]
