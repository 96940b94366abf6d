"""The page's types of all that the server is asked and replies: `python -m tests.page_types` writes them.

Made of the OpenAPI document and of the sockets' models, which it has no place for. What does not exist is left
out of a reply (`app.contract.model.present`), so that null is no value of an optional field there; in requests it
is. Tests hold the file to the contract, and replies to this.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from textwrap import wrap
from typing import Any

from pydantic.json_schema import models_json_schema

from app.contract.evaluation import LiveRequest
from app.contract.find_replies import FindProgress
from app.contract.identification import IdentificationReply, IdentifyRequest
from app.main import create_app
from tests.children import ROOT

PAGE = ROOT / "static" / "contract.d.ts"
WIDTH = 120
HEAD = """/**
 * What the server is asked and what it replies. Made of the contract (app/contract) by `python -m tests.page_types`;
 * not to be changed by hand.
 */
"""
SOCKETS = {
    LiveRequest: "validation",
    IdentifyRequest: "validation",
    IdentificationReply: "serialization",
    FindProgress: "serialization",
}
WHOLE = {"Guess", "IdentificationReply", "Preview"}
"""Replies that have all their fields: null says what others say by leaving one out."""
REF = "#/components/schemas/"
Schema = Mapping[str, Any]


def contract() -> tuple[dict[str, Schema], set[str]]:
    """Every schema by its name, and the names of those that stand in requests."""
    document = create_app().openapi()
    _, more = models_json_schema([*SOCKETS.items()], ref_template=f"{REF}{{model}}")
    known = dict(sorted((document["components"]["schemas"] | more["$defs"]).items()))
    calls = [operation for path in document["paths"].values() for operation in path.values()]
    asked = {model.__name__ for model, mode in SOCKETS.items() if mode == "validation"}
    waiting = asked | {name for call in calls for name in _named(call.get("requestBody"))}
    while waiting:
        asked |= waiting
        waiting = {name for parent in waiting for name in _named(known[parent])} - asked
    return known, asked


def module() -> str:
    """The whole file."""
    known, asked = contract()
    return HEAD + "".join(f"\n{_interface(name, known, name in asked)}" for name in known)


def _named(part: Any) -> Iterator[str]:
    """Names of the schemas that stand anywhere in this one."""
    if isinstance(part, dict):
        yield from (ref.removeprefix(REF) for key, ref in part.items() if key == "$ref")
        part = [value for key, value in part.items() if key != "examples"]
    for value in part if isinstance(part, list) else ():
        yield from _named(value)


def _interface(name: str, known: Mapping[str, Schema], asked: bool) -> str:
    base, required = _base(name, known), known[name].get("required", ())
    head = f"export interface {name} extends {base} {{" if base else f"export interface {name} {{"
    lines = [*_comment(known[name].get("description", ""), ""), head]
    if "properties" not in known[name]:
        return "\n".join((*lines[:-1], f"export type {name} = {_union(known[name])};", ""))
    for key, about in known[name]["properties"].items():
        if base and key in known[base]["properties"]:
            continue
        optional = name not in WHOLE and key not in required
        kinds = [kind for kind in _kinds(about) if asked or not optional or kind != "null"]
        lines += [*_comment(about.get("description", ""), "  "), *_field(f"{key}{'?' * optional}", kinds)]
    return "\n".join((*lines, "}", ""))


def _base(name: str, known: Mapping[str, Schema]) -> str:
    """Of a request, the largest other one whose fields it has all."""
    requests = {
        key: {
            (field, field in about.get("required", ()), _union(part))
            for field, part in about["properties"].items()
        }
        for key, about in known.items()
        if key.endswith("Request")
    }
    parts = [key for key, fields in requests.items() if name in requests and fields < requests[name]]
    return max(parts, key=lambda key: len(requests[key]), default="")


def _field(name: str, kinds: list[str]) -> list[str]:
    if len(line := f"  {name}: {' | '.join(kinds)};") <= WIDTH:
        return [line]
    return [f"  {name}:", *(f"    | {kind}" for kind in kinds[:-1]), f"    | {kinds[-1]};"]


def _union(schema: Schema) -> str:
    return " | ".join(_kinds(schema))


def _kinds(schema: Schema) -> list[str]:
    """The types of which a value has one."""
    values = [schema["const"]] if "const" in schema else schema.get("enum", [[]])
    several = {"array": _array, "object": _object}.get(kind := schema.get("type", "unknown"))
    if "$ref" in schema:
        return [schema["$ref"].removeprefix(REF)]
    if parts := schema.get("anyOf") or schema.get("oneOf"):
        return [kind for part in parts for kind in _kinds(part)]
    if all(isinstance(value, str | int) for value in values):
        return [repr(value) if isinstance(value, str) else json.dumps(value) for value in values]
    return [several(schema) if several else {"integer": "number"}.get(kind, kind)]


def _array(schema: Schema) -> str:
    if "prefixItems" in schema:
        return f"[{', '.join(map(_union, schema['prefixItems']))}]"
    kinds, count = _kinds(schema["items"]), schema.get("maxItems")
    if len(kinds) > 1:
        return f"({' | '.join(kinds)})[]"
    return f"[{', '.join(kinds * count)}]" if count and count == schema.get("minItems") else f"{kinds[0]}[]"


def _object(schema: Schema) -> str:
    if parts := [f"{key}: {_union(about)}" for key, about in schema.get("properties", {}).items()]:
        return f"{{ {'; '.join(parts)} }}"
    of = schema.get("additionalProperties")
    return f"Record<string, {_union(of) if isinstance(of, dict) else 'unknown'}>"


def _comment(words: str, indent: str) -> list[str]:
    assert "*/" not in words
    if len(line := f"{indent}/** {words} */") <= WIDTH and "\n" not in words:
        return [line] if words else []
    lines = [line for part in words.split("\n\n") for line in ("", *wrap(part, WIDTH - 3 - len(indent)))]
    return [f"{indent}/**", *(f"{indent} * {line}".rstrip() for line in lines[1:]), f"{indent} */"]


if __name__ == "__main__":
    PAGE.write_text(module(), encoding="utf-8")
