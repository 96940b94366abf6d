"""What is no body of a request, whatever else JSON may hold: told by its path before anything is made of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .checks import checked_number, shortly
from .errors import InvalidInputError
from .quantities import Field

TEXT, POLES, SPLIT = "text", "poles", "split"
"""What is no quantity: a name, poles, and which of them belong together."""
_MOST_POLES = 4

Tree = Mapping[str, Any]
"""Names of fields, each with what stands there: a tree of an object, a `Field`, or TEXT, POLES or SPLIT."""


def require_shape(values: object, tree: Tree, path: str = "") -> None:
    """Refuses what has other fields than a tree, or other kinds of values.

    Ranges and words are judged by who takes the values; null is as good as left out.

    Raises:
        InvalidInputError: it names the field.
    """
    if not isinstance(values, Mapping):
        raise _refused(path, values, "not an object")
    for name, value in values.items():
        own = f"{path}.{name}".lstrip(".")
        if not isinstance(name, str) or name not in tree:
            raise InvalidInputError(
                f"there is no field {shortly(own)[1:-1]}",
                field=own[:200],
                value=value,
                hint="Known are " + ", ".join(tree) + ".",
            )
        if value is not None:
            _require_kind(value, tree[name], own)


def _require_kind(value: Any, known: Any, path: str) -> None:
    if isinstance(known, Mapping):
        require_shape(value, known, path)
    elif isinstance(known, Field):
        if known.kind is bool and not isinstance(value, bool):
            raise _refused(path, value, "neither true nor false")
        if known.kind is int:
            _require_whole(value, path)
    elif known == TEXT:
        if not isinstance(value, str):
            raise _refused(path, value, "not a text")
    else:
        for i, part in enumerate(_listed(value, path)):
            _require_part(part, known, f"{path}.{i}")


def _require_part(part: Any, known: str, path: str) -> None:
    if known == POLES:
        _require_pole(part, path)
        return
    for k, place in enumerate(_listed(part, path)):
        _require_whole(place, f"{path}.{k}")


def _require_whole(value: Any, path: str) -> None:
    if isinstance(value, bool) or not isinstance(value, int):
        raise _refused(path, value, "not a whole number")


def _listed(value: Any, path: str) -> Sequence[Any]:
    if not isinstance(value, (list, tuple)) or len(value) > _MOST_POLES:  # pyright: ignore[reportUnknownArgumentType]
        raise _refused(path, value, f"not a list of up to {_MOST_POLES}")
    return value  # pyright: ignore[reportUnknownVariableType]


def _require_pole(pole: Any, path: str) -> None:
    if isinstance(pole, Mapping):
        if pole.keys() != {"re", "im"}:
            raise _refused(path, pole, 'not a number or {"re", "im"}')
        checked_number(pole["re"], f"{path}.re")
        checked_number(pole["im"], f"{path}.im")
    elif not isinstance(pole, complex):
        checked_number(pole, path)


def _refused(path: str, value: object, words: str) -> InvalidInputError:
    return InvalidInputError(
        f"{path} is {shortly(value)}, {words}".lstrip(),
        field=path,
        value=value,
        hint="Give it as the REST calls take it (docs/api.md).",
    )
