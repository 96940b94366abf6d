"""The examples that the page's tests hold its goals to are this core's."""

from __future__ import annotations

import json

import pytest

from tests.labs.page_examples import FILE, examples


def test_the_page_s_examples_are_up_to_date():
    kept = json.loads(FILE.read_text("utf-8"))
    now = json.loads(json.dumps(examples()))
    for name in ("small", "goals", "values"):
        assert kept[name] == _near(now[name]), f"{name}: call `python -m tests.labs.page_examples`"
    for old, new in zip(kept["attempts"], now["attempts"], strict=True):
        assert (old["told"], old["body"]) == (new["told"], _near(new["body"])), (
            "call `python -m tests.labs.page_examples`"
        )


def _near(value: object) -> object:
    """The same to 1e-9, since processors differ in the last digits."""
    if isinstance(value, dict):
        return {name: _near(own) for name, own in value.items()}
    if isinstance(value, list):
        return [_near(own) for own in value]
    return pytest.approx(value, rel=1e-9) if isinstance(value, float) else value
