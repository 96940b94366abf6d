"""What the requests' fields are made of: strict models, ranges, whole numbers, poles."""

from __future__ import annotations

from itertools import permutations
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema

from heli2dof_core.presets import PRESETS
from heli2dof_core.scenario import LONGEST


class Strict(BaseModel):
    """Unknown fields, text for numbers, NaN and infinity are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


def within(low: float, high: float) -> Any:
    """A range for the schema alone: the core checks it too, and its message names the unit."""
    return Field(json_schema_extra={"minimum": low, "maximum": high})


def optional(low: float, high: float) -> Any:
    """A number within a range, or none."""
    number: Any = Annotated[float, within(low, high)]
    return number | None


def _whole(value: Any) -> Any:
    """2.0 is an integer in JSON Schema's sense, and so here."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


Whole = Annotated[int, BeforeValidator(_whole)]
PresetName = Annotated[str, Field(json_schema_extra={"enum": [*PRESETS]})]
Seconds = Annotated[float, within(1e-3, LONGEST)]
Angle = Annotated[float, within(-100.0, 100.0)]


def _complex(value: Any) -> complex:
    """A plain number, or ``{"re": …, "im": …}``; ranges are the core's business."""
    parts = (value, 0.0)
    if isinstance(value, dict):
        if set(value) != {"re", "im"}:
            raise ValueError('a complex number is {"re": -3.0, "im": 4.0}')
        parts = (value["re"], value["im"])
    if any(isinstance(part, bool) or not isinstance(part, (int, float)) for part in parts):
        raise ValueError('a pole is a number, or {"re": -3.0, "im": 4.0}')
    try:
        return complex(*parts)
    except OverflowError as error:
        raise ValueError("a pole's parts must be finite numbers") from error


_NUMBER = {"type": "number", "minimum": -1e5, "maximum": 1e5}
Pole = Annotated[
    complex,
    BeforeValidator(_complex),
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
