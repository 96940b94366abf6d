"""Checks of single values, all raising InvalidInputError with field, value and range."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Protocol, TypeVar, get_args

from .errors import InvalidInputError

T = TypeVar("T")
_QUOTED = 80
"""Characters of a value in a message."""


class Named(Protocol):
    """What registries hold."""

    @property
    def name(self) -> str:
        """By which it is found."""
        ...


N = TypeVar("N", bound=Named)


def checked_number(value: object, path: str) -> float:
    """`value` as a finite float, or InvalidInputError naming `path`."""
    with contextlib.suppress(OverflowError):  # a whole number of a thousand digits is none
        if isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value):
            return float(value)
    raise InvalidInputError(
        f"{path} is {shortly(value)}, not a finite number",
        field=path,
        value=value,
        hint="Give a finite number.",
    )


def shortly(value: object) -> str:
    """A value as a message quotes it: nothing long, whatever it is."""
    try:
        text = repr(value)
    except ValueError:  # a whole number of more digits than Python writes
        return "a very long number"
    return text if len(text) <= _QUOTED else f"{text[:_QUOTED]}…"


def require_within(value: object, path: str, unit: str, low: float, high: float) -> float:
    """`value` as a float between `low` and `high` (in `unit`), or InvalidInputError."""
    number = checked_number(value, path)
    if not low <= number <= high:
        span = f"{low:g} and {high:g} {unit}".rstrip()
        raise InvalidInputError(
            f"{path} is {f'{number:g} {unit}'.rstrip()}, not between {span}",
            field=path,
            value=value,
            hint=f"Give a value between {span}.",
        )
    return number


def by_name(items: Iterable[N]) -> Mapping[str, N]:
    """A registry of what has names, in order; two of one name are a mistake of who wrote them."""
    known: dict[str, N] = {}
    for item in items:
        if item.name in known:
            raise ValueError(f"{item.name!r} is the name of two: {known[item.name]!r} and {item!r}")
        known[item.name] = item
    return MappingProxyType(known)


def require_known(name: str, known: Mapping[str, T], what: str) -> T:
    """`known[name]`, or InvalidInputError that lists the names; `what` is the field and the noun."""
    if name not in known:
        raise InvalidInputError(
            f"there is no {what} {name!r}", field=what, value=name, hint="Known are " + ", ".join(known) + "."
        )
    return known[name]


def require_one_of(value: object, choices: object, path: str) -> None:
    """Raises InvalidInputError unless `value` is one of the `Literal` type `choices`."""
    if value not in get_args(choices):
        raise InvalidInputError(
            f"{path} is {value!r}, which does not exist",
            field=path,
            value=value,
            hint="Known are " + ", ".join(get_args(choices)) + ".",
        )
