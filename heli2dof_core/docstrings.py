"""Docstrings that are made of what a class says of its fields."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import cleandoc
from typing import TypeVar

T = TypeVar("T", bound=type)


def with_attributes(cls: T, described: Mapping[str, str]) -> T:
    """The class with its attributes, name → words, at the end of its docstring."""
    if cls.__doc__:
        lines = (f"    {name}: {words}." for name, words in described.items())
        cls.__doc__ = "\n".join((cleandoc(cls.__doc__), "", "Attributes:", *lines))
    return cls
