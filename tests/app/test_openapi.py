"""The OpenAPI document: units at every number, an example for every call that takes a body, and the examples work."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

from app.main import create_app
from tests.app.class_room import in_class

DOCUMENT = create_app().openapi()
SCHEMAS: dict[str, Any] = DOCUMENT["components"]["schemas"]


def numeric(schema: dict[str, Any]) -> bool:
    """Whether numbers stand there, and no named schema that describes itself."""
    if "$ref" in schema:
        return False
    parts = [
        *schema.get("anyOf", ()),
        *schema.get("allOf", ()),
        schema.get("items"),
        schema.get("additionalProperties"),
    ]
    return schema.get("type") in ("number", "integer") or any(
        numeric(p) for p in parts if isinstance(p, dict)
    )


def numbers() -> Iterator[tuple[str, dict[str, Any]]]:
    for name, schema in SCHEMAS.items():
        for field, about in schema.get("properties", {}).items():
            if numeric(about):
                yield f"{name}.{field}", about


def test_every_number_says_what_it_is():
    found = dict(numbers())
    assert len(found) > 150
    assert [name for name, about in found.items() if not about.get("description")] == []


def bodies() -> list[tuple[str, str, Any]]:
    """Path, name and value of every example."""
    found = []
    for path, operations in DOCUMENT["paths"].items():
        content = operations.get("post", {}).get("requestBody", {}).get("content", {})
        for name, example in content.get("application/json", {}).get("examples", {}).items():
            found.append((path, name, example))
    return found


def test_every_body_has_an_example():
    with_body = {
        path
        for path, operations in DOCUMENT["paths"].items()
        if "application/json" in operations.get("post", {}).get("requestBody", {}).get("content", {})
    }
    assert with_body == {path for path, _, _ in bodies()}


@pytest.mark.parametrize(
    ("path", "name", "example"), bodies(), ids=lambda value: value if isinstance(value, str) else ""
)
def test_examples_are_answered(client, path, name, example):
    assert example["summary"]
    value = example["value"]
    if "{key}" in path or "{key}" in str(value):
        recording = client.post("/api/v1/recordings/sample", json={"length": 5}).content
        key = client.post("/api/v1/recordings?name=a.csv", content=recording).json()["id"]
        path = path.replace("{key}", key)
        value = json.loads(json.dumps(value).replace("{key}", key))
    headers = {}
    if "/labs/" in path or "/classes" in path:
        path, value, headers = in_class(client, path, value)
    form = "python" if "/system/" in path else "csv"
    address = path.replace("{name}", "csv").replace("{format}", form)
    reply = client.post(address, json=value, headers=headers)
    assert reply.status_code in (200, 204), reply.text
