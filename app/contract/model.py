"""What replies are made of: their models' base, figures and quantities as fields; poles, findings, voltages.

Replies are encoded straight from the core's arrays; a test holds every reply against its model. What does not exist
is left out.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import is_dataclass
from typing import Any, Optional

import numpy as np
import orjson
from pydantic import BaseModel, ConfigDict, Field, create_model

from heli2dof_core import Finding as CoreFinding
from heli2dof_core.figures import DESIGN, Figure
from heli2dof_core.findings import Severity
from heli2dof_core.request import Place
from heli2dof_core.signals import INPUTS

Reply = dict[str, Any]

OF_GAINS = {name: figure for name, figure in DESIGN.items() if name != "relative_gain"}
"""What is replied of K besides K; the relative gain stands in the RGA."""


class Model(BaseModel):
    """A reply's part: all numbers are finite, and nothing is said that is not described here."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


def told_by(known: Mapping[str, Figure]) -> type[Model]:
    """A reply of figures, as the registry names and describes them; one that may be absent is left out then."""
    return _of(
        (name, bool if figure.notation == "flag" else float, figure.described, bool(figure.absent))
        for name, figure in known.items()
    )


def proposed(*places: Place) -> type[Model]:
    """A reply of the quantities that a preset proposes; one that may be absent is left out then."""
    return _of(
        (name, known.kind, known.quantity.described, bool(known.quantity.absent))
        for place in places
        for name, known in place.fields.items()
        if place.proposed(name)
    )


def _of(parts: Iterable[tuple[str, Any, str, bool]]) -> type[Model]:
    """A reply's base: per part its name, kind, description, and whether it may be absent."""
    own: dict[str, Any] = {
        name: (kind | None, Field(None, description=words)) if absent else (kind, Field(description=words))
        for name, kind, words, absent in parts
    }
    return create_model("Parts", __base__=Model, **own)


def parts_of(*models: type[Model], without: Collection[str] = ()) -> type[Model]:
    """A reply of what other replies hold, each part of which may be left out."""
    own: dict[str, Any] = {
        name: (Optional[field.annotation], Field(None, description=field.description))  # noqa: UP045
        for model in models
        for name, field in model.model_fields.items()
        if name not in without
    }
    return create_model("Parts", __base__=Model, **own)


def described(model: Any, summary: str) -> dict[str, Any]:
    """Route options that put a reply's model into the schema; its errors are put there for all routes at once."""
    return {"summary": summary, "responses": {200: {"model": model, "description": summary}}}


def present(values: Reply) -> Reply:
    """What exists: None is left out."""
    return {name: value for name, value in values.items() if value is not None}


def reply_of(model: type[BaseModel], source: object, **own: Any) -> Reply:
    """The model's fields: what `source` has by their names, or what is given; what is None is left out."""
    reply: Reply = {}
    for name in model.__pydantic_fields__:
        value = own[name] if name in own else getattr(source, name, None)
        if value is not None:
            reply[name] = value if isinstance(value, _PLAIN) else plain(value)
    return reply


_PLAIN = (float, str, int, dict)


def plain(value: Any) -> Any:
    """A value of the core in JSON's own kinds; complex numbers as ``{"re", "im"}``."""
    if isinstance(value, np.ndarray):
        numbers = value.tolist()
        return poles_reply(numbers) if value.dtype.kind == "c" else numbers
    if isinstance(value, complex):
        return {"re": value.real, "im": value.imag}
    if isinstance(value, tuple):
        return [item if isinstance(item, _PLAIN) else plain(item) for item in value]
    return {name: plain(item) for name, item in vars(value).items()} if is_dataclass(value) else value


class Complex(Model):
    """A complex number."""

    re: float = Field(description="real part")
    im: float = Field(description="imaginary part")


def poles_reply(poles: Iterable[complex]) -> list[Reply]:
    """Complex numbers as ``{"re", "im"}``."""
    values: Iterable[complex] = poles.tolist() if isinstance(poles, np.ndarray) else poles
    return [{"re": p.real, "im": p.imag} for p in values]


class Finding(Model):
    """A remark on a design or response that is legal but deserves a word."""

    code: str
    severity: Severity
    message: str


def fixed(value: Any) -> orjson.Fragment:
    """A part of replies that is sent more than once, as JSON."""
    return orjson.Fragment(orjson.dumps(value))


def findings_reply(findings: Iterable[CoreFinding]) -> list[Reply]:
    """Findings as objects."""
    return [vars(finding) for finding in findings]


class Voltages(Model):
    """Motor voltages, V."""

    V_p: float = Field(description="pitch motor, V")
    V_y: float = Field(description="yaw motor, V")


def voltages_reply(values: Sequence[float]) -> Reply:
    """Motor voltages, V, by motor."""
    return {signal.name: value for signal, value in zip(INPUTS, values, strict=True)}


class Angles(Model):
    """Angles, rad; left out where there is none."""

    theta: float | None = Field(None, description="pitch, rad")
    psi: float | None = Field(None, description="yaw, rad")
