"""The published JSON schema says what the reader does: it takes the labs that ship, and finds what is wrong."""

from __future__ import annotations

import re
from pathlib import Path

import jsonschema
import pytest

from heli2dof_core.labs import LabError, read_lab
from heli2dof_core.labs.library import SHIPPED
from heli2dof_core.labs.nodes import nodes_of
from heli2dof_core.labs.schema import PUBLISHED, lab_schema, schema_text
from heli2dof_core.labs.template import TEMPLATE
from tests.labs.test_reading import SMALL, WRONG

VALIDATOR = jsonschema.Draft202012Validator(lab_schema())
FILES = (*sorted(SHIPPED.glob("*.yaml")), TEMPLATE, Path(__file__).with_name("small.yaml"))
BEYOND = (
    "could vary|not 0|name of two|neither|is named|min is above|has no motor|no choice|quantity|not measured|not "
    "known|no tolerance|negative|Known are pi|poles|no pole|K\\[i,j\\]|slowest_pole|out of range|does not fit"
)
"""What no schema says: whether names meet, whether a unit fits, whether it is a design."""


def faults(text: str) -> list[jsonschema.ValidationError]:
    return list(VALIDATOR.iter_errors(nodes_of(text).plain))


def test_it_is_a_schema():
    jsonschema.Draft202012Validator.check_schema(lab_schema())


def test_the_published_schema_is_that_of_the_reader():
    assert PUBLISHED.read_text(encoding="utf-8") == schema_text(), "run `make contract`"


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_labs_are_valid(file):
    assert [f"{error.json_path}: {error.message}" for error in faults(file.read_text(encoding="utf-8"))] == []


@pytest.mark.parametrize(
    ("old", "new", "path", "words"), [(o, n, p, w) for o, n, _, p, w in WRONG if p], ids=str
)
def test_what_is_wrong_is_found_at_its_field(old, new, path, words):
    text = SMALL.replace(old, new)
    with pytest.raises(LabError):
        read_lab(text)
    found = faults(text)
    if not found:
        assert re.search(BEYOND, words), (path, words)
        return
    paths = {error.json_path.removeprefix("$").lstrip(".") for error in found}
    assert any(path.startswith(own) for own in paths), (path, paths)


def test_it_finds_half_of_what_is_wrong():
    """So that an editor marks unknown names and words while they are written."""
    told = [bool(faults(SMALL.replace(old, new))) for old, new, _, path, _ in WRONG if path]
    assert sum(told) > 0.5 * len(told)


def test_every_field_is_described():
    """An editor shows these words."""

    def objects(schema):
        if isinstance(schema, dict):
            if schema.get("additionalProperties") is False and "$defs" not in schema:
                yield schema
            for own in schema.values():
                yield from objects(own)
        elif isinstance(schema, list):
            for own in schema:
                yield from objects(own)

    top = lab_schema()
    assert all(own.get("description") for own in top["properties"].values())
    step = top["properties"]["steps"]["items"]
    assert all(own.get("description") for own in step["properties"].values())
    assert sum(1 for _ in objects(top)) > 10
