"""Attributes that are computed when they are first read."""

from __future__ import annotations

from functools import cached_property
from typing import Any, TypeVar

T = TypeVar("T")


class computed(cached_property[T]):  # noqa: N801 # a decorator, as its base
    """As `functools.cached_property`, which before Python 3.12 takes a lock: a microsecond for each value.

    Two threads may compute it twice; what they find is the same.
    """

    def __get__(self, instance: Any, owner: type[Any] | None = None) -> Any:
        """The value, kept under its own name: the next time nobody comes here."""
        if instance is None:
            return self
        value = vars(instance)[self.attrname] = self.func(instance)
        return value
