"""What a user gives, quantity by quantity: meaning, unit and range stand once, on the field of its dataclass.

The REST API's requests and their schema, the command line's options, the page's controls and the checks of the core
read them here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import lru_cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from .checks import require_one_of, require_within
from .docstrings import with_attributes
from .errors import InvalidInputError

T = TypeVar("T", bound=type)


@dataclass(frozen=True)
class Quantity:
    """One quantity, as it is said of its field: ``duration: Annotated[float, Quantity("…", "s", 1e-3, 600.0)]``.

    Attributes:
        meaning: in a few words, without a full stop.
        unit: of its value, SI; empty without one.
        low, high: the lowest and the highest value allowed, in `unit`; None where it is no number.
        absent: what None stands for; empty where there must be a value.
        symbol: as printed, where it is not the field's name.
        parts: what its values are, by name, where it is a tuple of them.
    """

    meaning: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    absent: str = ""
    symbol: str = ""
    parts: Mapping[str, Quantity] = field(default_factory=dict)

    @property
    def described(self) -> str:
        """Meaning, unit, and what its absence says: for a schema, a help text, a docstring."""
        measured = f"{self.meaning}, {self.unit}" if self.unit else self.meaning
        return f"{measured}; {self.absent}" if self.absent else measured

    def nearest(self, value: float) -> float:
        """The value, or the end of the range that it is beyond."""
        low, high = self.low, self.high
        return value if low is None or high is None else min(max(value, low), high)


@dataclass(frozen=True)
class Field:
    """A quantity with its place in a dataclass.

    Attributes:
        name: of the field.
        kind: of a present value, or of one part of it: float, int, bool or a `Literal` of words.
        default: MISSING (of `dataclasses`) where there is none.
        quantity: what it is.
    """

    name: str
    kind: Any
    default: Any
    quantity: Quantity

    @property
    def choices(self) -> tuple[str, ...]:
        """The words that it may be; empty where it is no choice."""
        return get_args(self.kind) if get_origin(self.kind) is Literal else ()


@lru_cache(maxsize=64)
def quantities_of(cls: type) -> dict[str, Field]:
    """The fields of a dataclass that are quantities, by name and in order."""
    hints = get_type_hints(cls, include_extras=True)
    found = {}
    for own in fields(cls):
        if get_origin(hints[own.name]) is not Annotated:
            continue
        kind, quantity = get_args(hints[own.name])[:2]
        if isinstance(quantity, Quantity):
            found[own.name] = Field(own.name, _present(kind), own.default, quantity)
    return found


def documented(cls: T) -> T:
    """With its quantities in its docstring."""
    return with_attributes(cls, {name: f.quantity.described for name, f in quantities_of(cls).items()})


def require_valid(instance: object) -> None:
    """Checks every quantity of a dataclass' instance; numbers become floats where the field is one.

    Raises:
        InvalidInputError: a value is no finite number, out of its range, or an unknown word; its field is the
            quantity's name.
    """
    for name, known, words, (low, high) in _judged(type(instance)):
        value, about = getattr(instance, name), known.quantity
        # The usual cases, inline: every change of a design comes here some dozen times.
        if value is known.default or (value is None and about.absent) or (words and value in words):
            continue
        if type(value) is float and known.kind is float and low <= value <= high:
            continue
        if about.parts:
            checked = tuple(
                _checked(part, known.kind, own, f"{name}.{which}")
                for (which, own), part in zip(about.parts.items(), _parts(value, about, name), strict=True)
            )
        else:
            checked = _checked(value, known.kind, about, name)
        object.__setattr__(instance, name, checked)


@lru_cache(maxsize=64)
def _judged(cls: type) -> tuple[tuple[str, Field, tuple[str, ...], tuple[float, float]], ...]:
    """The quantities of which not every value is right, with the words or the range that they may be in."""
    found = []
    for name, known in quantities_of(cls).items():
        low, high = known.quantity.low, known.quantity.high
        if low is not None and high is not None:
            found.append((name, known, (), (low, high)))
        elif known.choices or known.quantity.parts:
            found.append((name, known, known.choices, _NONE))
    return tuple(found)


_NONE = (1.0, 0.0)
"""A range that holds nothing."""


def _parts(value: Any, about: Quantity, path: str) -> Sequence[Any]:
    if not isinstance(value, Sequence) or len(value) != len(about.parts):
        raise InvalidInputError(
            f"{path} is {value!r}, not {len(about.parts)} values",
            field=path,
            value=value,
            hint=f"Give {', '.join(about.parts)}.",
        )
    return value


def _checked(value: Any, kind: Any, about: Quantity, path: str) -> Any:
    if value is None and about.absent:
        return None
    if get_origin(kind) is Literal:
        require_one_of(value, kind, path)
        return value
    if about.low is None or about.high is None:
        return value
    number = require_within(value, path, about.unit, about.low, about.high)
    return number if kind is float else value


def _present(kind: Any) -> Any:
    """Without None, and of a tuple its items."""
    if get_origin(kind) in (Union, UnionType):
        kind = next(own for own in get_args(kind) if own is not NoneType)
    return _present(get_args(kind)[0]) if get_origin(kind) is tuple else kind
