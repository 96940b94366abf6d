"""The format as JSON schema, for editors: made of the same records that read a lab's file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from .bodies import BodyPart
from .format import LAB, RIG
from .kinds import Amount, Schema

DIALECT = "https://json-schema.org/draft/2020-12/schema"
PUBLISHED = Path(__file__).with_name("schema.json")
"""The same as a file, which `make contract` writes."""


def lab_schema() -> Schema:
    """The whole schema; what recurs stands once, under ``$defs``."""
    amount = {"withUnit": Amount("").schema()["anyOf"][1]}
    bodies = {"design": BodyPart().schema(), "rig": BodyPart(RIG).schema()}
    own = _shared(LAB.schema(), bodies | amount)
    inner = amount | {name: _shared(part, amount) for name, part in bodies.items()}
    return {
        "$schema": DIALECT,
        "title": "A lab of heli2dof",
        "description": "Steps with goals and questions on a laboratory helicopter; see docs/labs.md.",
        **own,
        "$defs": inner,
    }


def _shared(schema: Any, parts: dict[str, Schema]) -> Any:
    """With references in place of the parts."""
    if isinstance(schema, list):
        return [_shared(each, parts) for each in schema]
    if not isinstance(schema, dict):
        return schema
    for name, part in parts.items():
        if {k: v for k, v in schema.items() if k != "description"} == part:
            words = {"description": schema["description"]} if "description" in schema else {}
            return {**words, "$ref": f"#/$defs/{name}"}
    return {name: _shared(each, parts) for name, each in schema.items()}


def schema_text() -> str:
    """As it is published, in `schema.json`."""
    return json.dumps(lab_schema(), indent=1, ensure_ascii=False) + "\n"
