"""Arrays that nobody can change, so that results are as frozen as their types say."""

from __future__ import annotations

from inspect import get_annotations
from typing import Any, ClassVar, TypeVar

from numpy import ndarray

T = TypeVar("T")
_ARRAYS = ("Floats", "Complexes", "NDArray")
"""By these words the annotation of a field says that it holds arrays."""


def frozen(value: T) -> T:
    """The same, its arrays read-only from now on: an array, or what tuples, lists and dictionaries hold of them."""
    if isinstance(value, ndarray):
        value.setflags(False)  # pyright: ignore[reportCallIssue] # by name, as the stubs know it, it takes thrice as long
    elif isinstance(value, (tuple, list)):
        for part in value:
            frozen(part)
    elif isinstance(value, dict):
        for part in value.values():
            frozen(part)
    return value


def read_only(array: Any) -> Any:
    """The array itself where nobody can change it, else such a copy of it: the caller's own stays as it is."""
    return frozen(array.copy()) if array.flags.writeable else array


class Frozen:
    """Base of a frozen dataclass that holds arrays: they are read-only from its making on.

    Arrays that are made later, in a cached property, pass through `frozen`.
    """

    __slots__ = ()
    _arrays: ClassVar[tuple[str, ...]] = ()

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        own = (
            name for name, kind in get_annotations(cls).items() if any(word in str(kind) for word in _ARRAYS)
        )
        cls._arrays = (*cls._arrays, *own)

    def __post_init__(self) -> None:
        for name in self._arrays:
            value = getattr(self, name)
            if type(value) is ndarray:  # the usual case, inline: an update makes two dozen
                value.setflags(False)  # pyright: ignore[reportCallIssue]
            else:
                frozen(value)
