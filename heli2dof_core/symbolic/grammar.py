"""Expressions that people type: numbers, letters, + − * / ^, brackets and sqrt. Nothing else means anything.

    sum      = term (("+" | "-") term)*
    term     = sign (("*" | "/") sign)*
    sign     = ("+" | "-") sign | power
    power    = atom [("^" | "**") sign]
    atom     = number | letter | "sqrt" "(" sum ")" | "(" sum ")"

A text becomes a tree of `Node`s and is never run as code. Lengths and depths are bounded, so that reading is quick.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from ..errors import InvalidInputError

LONGEST = 200
"""Characters of an entry."""
DEEPEST = 16
"""Brackets, signs and powers within one another."""
LONGEST_NAME = 24
MOST_DIGITS = 30
LARGEST_TENS = 30
"""Powers of ten in a number's exponent."""
LARGEST_POWER = 12

Kind = Literal["number", "letter", "sum", "product", "power", "sqrt"]


@dataclass(frozen=True)
class Node:
    """A part of an expression.

    Attributes:
        kind: what it is.
        position: of its first character in the text, from 1; of an exponent's base where it is a power.
        value: a number's value, a power's exponent; of each part of a sum or product ±1: added or taken away, a
            factor or a divisor.
        name: a letter's name.
        parts: what it is made of.
    """

    kind: Kind
    position: int
    value: Fraction = Fraction(0)
    name: str = ""
    parts: tuple[Node, ...] = ()
    signs: tuple[int, ...] = ()


class WrittenError(InvalidInputError):
    """A text is no expression; `position` says where, from 1."""

    def __init__(self, message: str, position: int, hint: str = "") -> None:
        super().__init__(f"position {position}: {message}", hint=hint)
        self.position = position


_NUMBER = re.compile(r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_GREEK = "\u0391-\u03a1\u03a3-\u03a9\u03b1-\u03c1\u03c3-\u03c9"
_SUBSCRIPTS = "\u2080-\u2089"
NAME = re.compile(f"[A-Za-z{_GREEK}][A-Za-z0-9_{_GREEK}{_SUBSCRIPTS}]*")
_SAME = {"−": "-", "–": "-", "·": "*", "×": "*", "⋅": "*", "∙": "*", "÷": "/", "∕": "/", "**": "^"}
_OPERATOR = re.compile(r"\*\*|[-+*/^()−–·×⋅∙÷∕]")
_START = "a number, a letter, sqrt( or an opening bracket"
_NEXT = "+, −, *, /, ^"


@dataclass(frozen=True)
class _Token:
    kind: Literal["number", "name", "operator", "end"]
    text: str
    position: int

    def __str__(self) -> str:
        return "the end" if self.kind == "end" else f"{self.text!r}"


def parse(text: str) -> Node:
    """The tree of an expression.

    Raises:
        WrittenError: it is none, or is beyond a limit; with the position and what was expected there.
    """
    if len(text) > LONGEST:
        raise WrittenError(
            f"an entry has at most {LONGEST} characters, this one {len(text)}",
            LONGEST + 1,
            "Give a letter for a part of it.",
        )
    return _Parser(list(_tokens(text))).whole()


def letters(node: Node) -> Iterator[str]:
    """The names of its letters, in the order in which they occur."""
    if node.kind == "letter":
        yield node.name
    for part in node.parts:
        yield from letters(part)


def _tokens(text: str) -> Iterator[_Token]:
    at = 0
    while at < len(text):
        if text[at].isspace():
            at += 1
            continue
        for kind, pattern in (("number", _NUMBER), ("name", NAME), ("operator", _OPERATOR)):
            if found := pattern.match(text, at):
                written = found.group()
                yield _Token(kind, _SAME.get(written, written), at + 1)  # pyright: ignore[reportArgumentType]
                at = found.end()
                break
        else:
            raise WrittenError(
                f"{text[at]!r} is no part of an expression",
                at + 1,
                "Write numbers, letters, + - * / ^, brackets and sqrt( ).",
            )
    yield _Token("end", "", len(text) + 1)


class _Parser:
    """Reads tokens from left to right; `depth` counts what is within what."""

    def __init__(self, tokens: list[_Token]) -> None:
        self._tokens = tokens
        self._at = 0
        self._depth = 0

    def whole(self) -> Node:
        """All of it.

        Raises:
            WrittenError: something follows.
        """
        node = self._sum()
        token = self._token
        if token.kind == "end":
            return node
        hint = ""
        if token.kind in ("name", "number") or token.text == "(":
            before = self._tokens[self._at - 1]
            hint = f"Write the product with *: {before.text}*{token.text}."
            if token.text == "(" and before.kind == "name":
                hint = f"The only function is sqrt. A product is written with *: {before.text}*(…)."
        raise WrittenError(f"expected {_NEXT} or the end, found {token}", token.position, hint)

    @property
    def _token(self) -> _Token:
        return self._tokens[self._at]

    def _take(self) -> _Token:
        token = self._token
        self._at += token.kind != "end"
        return token

    def _within(self) -> None:
        self._depth += 1
        if self._depth > DEEPEST:
            raise WrittenError(
                f"brackets, signs and powers stand within one another more than {DEEPEST} deep",
                self._token.position,
                "Give a letter for the inner part.",
            )

    def _sum(self) -> Node:
        return self._chain("sum", "+", "-")

    def _term(self) -> Node:
        return self._chain("product", "*", "/")

    def _chain(self, kind: Literal["sum", "product"], plain: str, inverse: str) -> Node:
        inner = self._term if kind == "sum" else self._sign
        parts, signs = [inner()], [1]
        while self._token.kind == "operator" and self._token.text in (plain, inverse):
            signs.append(1 if self._take().text == plain else -1)
            parts.append(inner())
        if len(parts) == 1:
            return parts[0]
        return Node(kind, parts[0].position, parts=tuple(parts), signs=tuple(signs))

    def _sign(self) -> Node:
        token = self._token
        if token.kind != "operator" or token.text not in "+-":
            return self._power()
        self._within()
        self._take()
        inner = self._sign()
        self._depth -= 1
        return inner if token.text == "+" else Node("sum", token.position, parts=(inner,), signs=(-1,))

    def _power(self) -> Node:
        base = self._atom()
        if self._token.text != "^":
            return base
        self._within()
        self._take()
        position = self._token.position
        exponent = _constant(self._sign())
        self._depth -= 1
        if exponent is None or 2 * exponent != int(2 * exponent) or abs(exponent) > LARGEST_POWER:
            raise WrittenError(
                f"expected a whole number or half of one, within ±{LARGEST_POWER}, as exponent",
                position,
                "Write a^2, a^-1 or a^(1/2); exponents have no letters.",
            )
        return Node("power", base.position, exponent, parts=(base,))

    def _atom(self) -> Node:
        token = self._take()
        if token.kind == "number":
            return Node("number", token.position, _number(token))
        if token.kind == "name" and token.text == "sqrt":
            if self._token.text != "(":
                raise WrittenError(
                    f"expected an opening bracket after sqrt, found {self._token}", self._token.position
                )
            return Node("sqrt", token.position, parts=(self._bracketed(self._take()),))
        if token.kind == "name":
            return Node("letter", token.position, name=_name(token))
        if token.text == "(":
            return self._bracketed(token)
        raise WrittenError(f"expected {_START}, found {token}", token.position)

    def _bracketed(self, opened: _Token) -> Node:
        self._within()
        node = self._sum()
        self._depth -= 1
        if self._token.text != ")":
            raise WrittenError(
                f"expected {_NEXT} or a closing bracket for the one at position {opened.position}, "
                f"found {self._token}",
                self._token.position,
            )
        self._take()
        return node


def _constant(node: Node) -> Fraction | None:
    """The value of an exponent; None where it has letters or roots, or powers too large to be one."""
    if node.kind == "number":
        return node.value
    if node.kind == "power":
        base = _constant(node.parts[0])
        small = base is not None and base != 0 and max(abs(base.numerator), base.denominator) <= LARGEST_POWER
        return base**node.value.numerator if base and small and node.value.denominator == 1 else None
    if node.kind not in ("sum", "product"):
        return None
    values = [_constant(part) for part in node.parts]
    total = Fraction(0) if node.kind == "sum" else Fraction(1)
    for value, sign in zip(values, node.signs, strict=True):
        if value is None or (node.kind == "product" and sign < 0 and not value):
            return None
        total = total + sign * value if node.kind == "sum" else total * value**sign
    return total


def _number(token: _Token) -> Fraction:
    mantissa, _, tens = token.text.lower().partition("e")
    if len(mantissa) > MOST_DIGITS + 1 or len(tens) > 6 or abs(int(tens or 0)) > LARGEST_TENS:
        raise WrittenError(
            f"numbers have at most {MOST_DIGITS} digits and exponents within ±{LARGEST_TENS}",
            token.position,
            "Give the number in other units, or a letter for it.",
        )
    return Fraction(token.text)


def _name(token: _Token) -> str:
    """The letter's name in ASCII: Greek letters by theirs, lowered digits behind an underscore."""
    parts, lowered = [], False
    for character in token.text:
        name = "" if character.isascii() else unicodedata.name(character)
        if name.startswith("SUBSCRIPT"):
            parts.append(f"{'' if lowered or parts[-1] == '_' else '_'}{unicodedata.digit(character)}")
            lowered = True
            continue
        lowered = False
        if name:
            word = name.rpartition(" ")[2].lower().replace("lamda", "lambda")
            name = word.capitalize() if "CAPITAL" in name else word
        parts.append(name or character)
    text = "".join(parts)
    if len(text) > LONGEST_NAME or text.endswith("_") or "__" in text:
        raise WrittenError(
            f"letters have names of at most {LONGEST_NAME} characters, and underscores only within them, one by one",
            token.position,
            "Write it like K_pp or omega_0.",
        )
    return text
