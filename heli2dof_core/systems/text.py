"""Where things stand in a pasted text: its characters without comments, places as line and column."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import InvalidInputError
from ..symbolic.grammar import Node, WrittenError, parse

LONGEST = 20_000
"""Characters of a text."""
MOST_ENTRIES = 12 * 12
"""Of one matrix."""
_CONTINUED = re.compile(r"\.\.\.[^\n]*\n|\\[ \t]*\n")
_COMMENT = re.compile(r"(?:%|#|//)[^\n]*")
_PROMPT = re.compile(r"^[ \t]*>>>?", re.MULTILINE)
_BLANKS = " \t\r\f\v\xa0"
_OPERATORS = "*/^·×⋅∙÷∕"
_SIGNS = "+-−–"


class PastedError(InvalidInputError):
    """A pasted text cannot be read; `line` and `column`, from 1, say where."""

    def __init__(self, message: str, line: int, column: int, hint: str = "") -> None:
        super().__init__(f"line {line}, column {column}: {message}", field="text", hint=hint)
        self.line, self.column = line, column


@dataclass(frozen=True)
class Entry:
    """An expression in the text: how it is written, where it begins, what it is."""

    text: str
    start: int
    node: Node


class Text:
    """A text whose comments and continued line ends are blanks, so that places stay.

    Attributes:
        given: as it came.
        plain: as long, without comments.
    """

    def __init__(self, given: str) -> None:
        self.given = given
        if len(given) > LONGEST:
            raise PastedError(
                f"the text has {len(given)} characters, and at most {LONGEST} are read",
                *self.place(LONGEST),
                "Paste the matrices alone.",
            )

        def blank(found: re.Match[str]) -> str:
            return " " * len(found.group())

        self.plain = _PROMPT.sub(blank, _COMMENT.sub(blank, _CONTINUED.sub(blank, given)))

    def place(self, at: int) -> tuple[int, int]:
        """Line and column of a character, from 1."""
        before = self.given[:at]
        return before.count("\n") + 1, at - (before.rfind("\n") + 1) + 1

    def refuse(self, message: str, at: int, hint: str = "") -> PastedError:
        """The error that names this place."""
        return PastedError(message, *self.place(at), hint)

    def skip(self, at: int, what: str = _BLANKS) -> int:
        """The first place from here on with another character."""
        while at < len(self.plain) and self.plain[at] in what:
            at += 1
        return at

    def line_end(self, at: int) -> int:
        """Of the line in which this place is."""
        end = self.plain.find("\n", at)
        return len(self.plain) if end < 0 else end

    def closing(self, at: int) -> int:
        """Where the bracket that opens here is closed.

        Raises:
            PastedError: nowhere, or by another kind of bracket.
        """
        pairs, waiting = {"[": "]", "(": ")"}, list[tuple[str, int]]()
        for i in range(at, len(self.plain)):
            c = self.plain[i]
            if c in pairs:
                waiting.append((pairs[c], i))
            elif c in "])":
                wanted, opened = waiting.pop()
                if c != wanted:
                    line, column = self.place(opened)
                    raise self.refuse(
                        f"expected {wanted!r} for the bracket in line {line}, column {column}, found {c!r}", i
                    )
                if not waiting:
                    return i
        raise self.refuse(
            "this bracket is never closed", waiting[-1][1], f"Write {waiting[-1][0]} at its end."
        )

    def expression(self, start: int, end: int) -> Entry:
        """What stands there, as one expression.

        Raises:
            PastedError: it is none.
        """
        start = self.skip(start, _BLANKS + "\n")
        written = self.plain[start:end].rstrip()
        try:
            return Entry(written, start, parse(_dotless(written)))
        except WrittenError as error:
            message = str(error).partition(": ")[2]
            raise self.refuse(message, min(start + error.position - 1, len(self.plain)), error.hint) from None

    def row(self, start: int, end: int) -> tuple[Entry, ...]:
        """The entries of a row, with commas or blanks between them, as MATLAB reads them."""
        return tuple(self.expression(*part) for part in self._parts(start, end))

    def _parts(self, start: int, end: int) -> Iterator[tuple[int, int]]:
        begin, depth, comma = start, 0, False
        for i in range(start, end):
            c = self.plain[i]
            depth += (c in "([") - (c in ")]")
            if depth:
                continue
            if c == ",":
                if not self.plain[begin:i].strip():
                    if comma or not self.plain[start:i].strip():
                        raise self.refuse("an entry is missing before this comma", i, "Write 0 for nothing.")
                else:
                    yield begin, i
                begin, comma = i + 1, True
            elif c in _BLANKS + "\n" and self._separates(begin, i, end):
                yield begin, i
                begin, comma = i, False
        if self.plain[begin:end].strip():
            yield begin, end

    def _separates(self, begin: int, at: int, end: int) -> bool:
        """Whether this blank ends an entry: [1 -2] are two, [1 - 2] and [1 -  2] one."""
        before, after = self.plain[begin:at].rstrip(), self.skip(at, _BLANKS + "\n")
        if not before or after >= end or (at + 1 < after and self.plain[at + 1] in _BLANKS + "\n"):
            return False  # of several blanks the last one decides
        if before[-1] in _OPERATORS + _SIGNS + "(" or re.search(r"\bsqrt$", before):
            return False
        c, following = self.plain[after], self.plain[after + 1 : after + 2]
        if c in _SIGNS:
            return bool(following) and following not in _BLANKS + "\n"
        return c not in _OPERATORS + "),." or (c == "." and following.isdigit())


def _dotless(written: str) -> str:
    """Entry by entry, as in MATLAB's .* ./ and .^, is the same for numbers; the place of what follows stays."""
    return re.sub(r"(?<![0-9])\.(?=[*/^])", " ", written)
