"""What expressions are worth: letters get numbers."""

from __future__ import annotations

import re
from cmath import isfinite, sqrt
from collections.abc import Callable, Mapping
from math import pi
from math import sqrt as real_sqrt

from ..symbolic.grammar import Node, WrittenError, parse

KNOWN = {"pi": pi}
"""Letters that have a value unless another one is given."""
LARGEST_POLE = 1e9
"""rad/s."""
_DIGITS = r"((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
_UNIT_BEHIND = re.compile(_DIGITS + r"[ij](?![A-Za-z0-9_])")
_UNIT_BEFORE = re.compile(r"(?<![A-Za-z0-9_])[ij]" + _DIGITS)


def value_of(node: Node, letter: Callable[[str], float]) -> float:
    """The number that an expression is.

    Raises:
        WrittenError: it divides by 0, is the root of what is negative, or too large.
    """

    def real_root(value: complex, at: Node) -> complex:
        if value.real < 0:
            raise WrittenError(
                f"this is the root of {value.real:.4g}, which is not real",
                at.position,
                "Entries of a system are real numbers.",
            )
        return real_sqrt(value.real)

    return _finite(node, lambda at: letter(at.name), real_root).real


def complex_number(text: str) -> complex:
    """A complex number as MATLAB, Python and books write it: -2+4j, -2+j*4, -2-4i, 4*i.

    Raises:
        WrittenError: it is none.
    """

    def letter(at: Node) -> complex:
        if at.name in ("i", "j"):
            return 1j
        if at.name not in KNOWN:
            raise WrittenError(f"{at.name!r} is no number", at.position, "Write a pole as -2+4j.")
        return KNOWN[at.name]

    written = _UNIT_BEFORE.sub(r"(\1*j)", _UNIT_BEHIND.sub(r"(\1*j)", text))
    found = complex(_finite(parse(written), letter, lambda value, _at: sqrt(value)))
    if not abs(found) < LARGEST_POLE:
        raise WrittenError("this is too large a number", 1, "Give the system in other units of time.")
    return found


def _finite(
    node: Node, letter: Callable[[Node], complex], root: Callable[[complex, Node], complex]
) -> complex:
    """The value by a letter's and a root's; in complex numbers, whose real parts are computed as floats are."""

    def value(at: Node) -> complex:
        if at.kind == "number":
            return float(at.value)
        if at.kind == "letter":
            return letter(at)
        parts = [value(part) for part in at.parts]
        if at.kind == "sum":
            return sum(sign * part for sign, part in zip(at.signs, parts, strict=True))
        if at.kind == "product":
            total: complex = 1.0
            for sign, part, of in zip(at.signs, parts, at.parts, strict=True):
                total = total * part if sign > 0 else total / _divisor(part, of)
            return total
        if at.kind == "sqrt":
            return root(parts[0], at.parts[0])
        base = root(parts[0], at) if at.value.denominator == 2 else parts[0]
        power = at.value.numerator
        return (_divisor(base, at) if power < 0 else base) ** power

    try:
        found = value(node)
    except OverflowError:
        found = complex("inf")
    if not isfinite(found):
        raise WrittenError("this is too large a number", node.position, "Give it in other units.")
    return found


def _divisor(value: complex, node: Node) -> complex:
    if not value:
        raise WrittenError("this is a division by 0", node.position, "Divide by what is not 0.")
    return value


class Values:
    """The letters' values, each computed when it is asked for; those that are given by others, of these.

    Attributes:
        missing: letters that were asked for and have none.
    """

    def __init__(self, given: Mapping[str, Node]) -> None:
        self._given = given
        self._known = dict[str, float]()
        self._under_way = set[str]()
        self.missing = dict[str, None]()

    def __call__(self, name: str) -> float:
        """Its value; 1 where it has none, which `missing` tells.

        Raises:
            WrittenError: it is given by itself.
        """
        if name in self._known:
            return self._known[name]
        if name not in self._given:
            if name not in KNOWN:
                self.missing[name] = None
            return KNOWN.get(name, 1.0)
        if name in self._under_way:
            raise WrittenError(f"{name} is given by itself", 1, "Give it a number.")
        self._under_way.add(name)
        self._known[name] = value_of(self._given[name], self)
        self._under_way.discard(name)
        return self._known[name]
