"""What a quantity is stands on the core's dataclass; requests, their schema, errors and options follow it."""

from __future__ import annotations

from typing import Any, get_args

import pytest
from pydantic import ValidationError

from app.cli.fields import ALL, Option
from app.cli.values import Assignment, Choice, Name
from app.contract.experiment import StepRequest
from app.contract.places import COLUMNS, UNCERTAINTY
from app.contract.problems import problem_of
from app.contract.recordings import OverlayRequest
from app.contract.robustness import RobustnessRequest
from heli2dof_core import Heli2DofError
from heli2dof_core.request import path_of, quantities
from tests.page_quantities import PAGE, module

QUANTITIES = {path: (place, known) for path, place, known in (*quantities(), *quantities([COLUMNS]))}
OF_COLUMNS = {path: known for path, (place, known) in QUANTITIES.items() if place is COLUMNS}
OF_DESIGNS = {path: known for path, (_, known) in QUANTITIES.items() if path not in OF_COLUMNS}


def body(path: str, value: object) -> dict[str, Any]:
    """A request's body with one value in it."""
    for name in reversed(path.split(".")):
        value = {name: value}
    assert isinstance(value, dict)
    return value


def refused(path: str, value: object) -> dict[str, Any]:
    """The problem that the REST API answers with."""
    with pytest.raises((Heli2DofError, ValidationError)) as caught:
        if path in OF_COLUMNS:
            OverlayRequest.model_validate(body(path, value)).columns.to_columns()
        else:
            StepRequest.model_validate(body(path, value)).to_spec()
    return problem_of(caught.value)


def leaf(schema: dict[str, Any], path: str) -> dict[str, Any]:
    """What a request's schema says of a path."""
    at = schema
    for name in path.split("."):
        options = [at, *at.get("anyOf", ())]
        at = next(o for o in options if "$ref" in o or "properties" in o)
        if "$ref" in at:
            at = schema["$defs"][at["$ref"].rpartition("/")[2]]
        at = at["properties"][name]
    return at


@pytest.mark.parametrize("path", [path for path, (_, q) in QUANTITIES.items() if q.quantity.low is not None])
def test_a_number_beyond_its_range_is_refused_by_its_path_and_the_schema_says_the_range(path):
    known = QUANTITIES[path][1]
    low, high = known.quantity.low, known.quantity.high
    assert low is not None and high is not None
    for value in (low - 1, high + (1 if known.kind is int else max(1.0, abs(high)))):
        problem = refused(path, value)
        assert problem["field"] == path and problem["detail"].startswith(f"{path} is ")
    schema = (OverlayRequest if path in OF_COLUMNS else StepRequest).model_json_schema()
    said = leaf(schema, path)
    number = next(o for o in (said, *said.get("anyOf", ())) if "minimum" in o)
    assert (number["minimum"], number["maximum"]) == (low, high)
    assert said["description"] == known.quantity.described


@pytest.mark.parametrize("path", [path for path, (_, q) in QUANTITIES.items() if q.choices or q.kind is bool])
def test_a_word_that_is_none_is_refused_by_its_path(path):
    assert refused(path, "no such word")["field"] == path


def test_the_range_of_an_uncertainty_is_refused_by_the_requests_path():
    for given, path in (({"J_p": 2.0}, "uncertainty.J_p"), ({"J": 0.1}, "uncertainty.J")):
        with pytest.raises(Heli2DofError) as caught:
            RobustnessRequest(uncertainty=given).to_uncertainty()
        assert problem_of(caught.value)["field"] == path
    for name in UNCERTAINTY.fields:
        assert path_of(name) == name


@pytest.mark.parametrize("option", ALL, ids=lambda option: option.flag)
def test_every_option_stands_for_a_field_and_completes_its_words(option: Option):
    if isinstance(option.kind, Name | Choice | Assignment):
        words = [*option.kind.names()]
        assert words and all(isinstance(word, str) for word in words)
    if option.path in QUANTITIES:
        known = QUANTITIES[option.path][1]
        assert known.quantity.described.lower() in option.about.lower()
        if isinstance(option.kind, Name):
            assert (*option.kind.names(),) == get_args(known.kind)


def test_every_quantity_outside_the_nested_experiment_has_an_option():
    nested = ("scenario.digital.", "scenario.initial.", "scenario.disturbance.")
    paths = {option.path for option in ALL}
    assigned = ("parameters", "limits", "weights.states", "weights.inputs", "weights.integrals")
    assert paths.issuperset(assigned)  # name=value
    nested += tuple(f"{path}." for path in assigned)
    assert [path for path in QUANTITIES if path not in paths and not path.startswith(nested)] == []


def test_the_pages_module_is_current():
    """`make contract` writes it anew."""
    assert PAGE.read_text("utf-8") == module()
