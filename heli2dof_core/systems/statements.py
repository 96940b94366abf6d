"""The statements of a pasted text: matrices, letters' values, desired poles, and what is passed over.

A = [0 1; -2 -3];  B = [0; 1]         MATLAB and Octave
A = np.array([[0, 1], [-2, -3]])      Python
A:                                     rows under a heading, or blocks of rows by themselves
  0   1
 -2  -3
m = 2;  k = 3*m                        letters
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from ..symbolic.grammar import NAME, Node, WrittenError, parse
from .text import Entry, Text

Rows = tuple[tuple[Entry, ...], ...]
MATRICES = ("A", "B", "C", "D")
OTHER_LETTERS = {"F": "A", "G": "B", "H": "C", "J": "D"}
"""The same in the letters of Franklin and Powell, read so where there is no A."""
POLES = ("p", "P", "J", "poles", "desired_poles", "mu", "pc", "p_c")
OBSERVER_POLES = ("q", "observer_poles", "obs_poles", "pe", "p_e", "po", "p_o")
_BLANKS = " \t\r\n,;"
_ASSIGNED = re.compile(rf"({NAME.pattern})[ \t]*(?::=|=(?!=)|:(?=[ \t\r]*(?:\n|\[|$)))")
_ALONE = re.compile(rf"({'|'.join(MATRICES)})[ \t\r]*(?:\n|$)")
_CALL = re.compile(r"((?:[A-Za-z_]\w*\.)*[A-Za-z_]\w*)[ \t]*\(")
_ARRAYS = {"array", "asarray", "matrix", "mat", "Matrix", "ImmutableMatrix"}
_MADE = {"eye": 1.0, "zeros": 0.0, "ones": 1.0, "identity": 1.0}
_PASSED = re.compile(
    r"(?:import|from|print|clear|clc|close|clearvars|format|syms|pkg|echo|hold|figure|disp)\b|[A-Za-z_.]\w*[ \t]*\("
)
_TRANSPOSED = re.compile(r"[ \t]*(?:\.?'|\.T\b|\.transpose\(\))")


@dataclass
class Statements:
    """What a text says.

    Attributes:
        matrices: by name, row by row.
        where: of matrices and letters by name, where they begin.
        letters: by name the expressions that they are.
        vectors: rows of expressions under other names, as desired poles.
        passed: what was not looked at, as it stands.
    """

    matrices: dict[str, Rows] = field(default_factory=dict)
    where: dict[str, int] = field(default_factory=dict)
    letters: dict[str, Entry] = field(default_factory=dict)
    vectors: dict[str, list[str]] = field(default_factory=dict)
    passed: list[str] = field(default_factory=list)


def read_statements(given: str) -> tuple[Text, Statements]:
    """All statements of a text.

    Raises:
        PastedError: one cannot be read.
    """
    text = Text(given)
    reader = _Reader(text)
    reader.read()
    return text, reader.found


class _Reader:
    def __init__(self, text: Text) -> None:
        self.text, self.found, self.at = text, Statements(), 0

    def read(self) -> None:
        text = self.text
        while (at := text.skip(self.at, _BLANKS)) < len(text.plain):
            named = _ASSIGNED.match(text.plain, at)
            alone = _ALONE.match(text.plain, at)
            if named or alone:
                name = (named or alone)[1]  # pyright: ignore[reportOptionalSubscript]
                self.at = named.end() if named else at + len(name)
                self._assigned(name, at)
            elif _PASSED.match(text.plain, at) and not re.match(r"sqrt\b", text.plain[at:]):
                self._pass_over(at, at)
            else:
                self.at = at
                name = next((name for name in MATRICES if name not in self.found.matrices), None)
                if name is None:
                    raise text.refuse(
                        "A, B, C and D are all given before this", at, "Give what it is: name = value."
                    )
                self._keep(name, self._matrix(at), at)

    def _assigned(self, name: str, start: int) -> None:
        """The value of a name, which stands before `self.at`."""
        text, own = self.text, self._own_name(name, start)
        at = text.skip(self.at)
        call = _CALL.match(text.plain, at)
        function = call[1].rpartition(".")[2] if call else ""
        matrix = own in MATRICES
        ends = at >= len(text.plain) or text.plain[at] == "\n"
        if text.plain.startswith("[", at) or function in _ARRAYS or (function in _MADE):
            if matrix or own in OTHER_LETTERS:
                self._keep(own, self._matrix(at), start)
                if own not in POLES or "A" not in self.found.matrices:
                    return
                self.found.vectors[own] = [e.text for row in self.found.matrices[own] for e in row]
            else:
                self._vector(own, at, start)
        elif call and function != "sqrt":
            if matrix:
                raise text.refuse(
                    f"{own} is given by {call[1]}( ), which is not computed here",
                    at,
                    "Write the matrix with its entries.",
                )
            self._pass_over(start, at)
        elif ends:
            if not matrix:
                raise text.refuse(f"{name} has no value", start, "Write name = value, or leave it out.")
            self.at = text.skip(at, _BLANKS)
            self._keep(own, self._matrix(self.at), start)
        else:
            entry = text.expression(at, end := self._end_of_scalar(at))
            self.at = end
            if matrix:
                self._keep(own, ((entry,),), start)
            elif own in self.found.letters:
                raise text.refuse(f"{name} is given a second time", start, "Leave one of them out.")
            else:
                self.found.letters[own] = entry
                self.found.where[own] = start

    def _own_name(self, name: str, start: int) -> str:
        try:
            return parse(name).name
        except WrittenError as error:
            raise self.text.refuse(str(error).partition(": ")[2], start, error.hint) from None

    def _keep(self, name: str, rows: Rows, start: int) -> None:
        if name in self.found.matrices:
            raise self.text.refuse(f"{name} is given a second time", start, "Leave one of them out.")
        width = len(rows[0])
        for i, row in enumerate(rows, 1):
            if len(row) != width:
                raise self.text.refuse(
                    f"row {i} of {name} has {len(row)} entries, and row 1 has {width}",
                    row[0].start,
                    "Give every row as many entries.",
                )
        self.found.matrices[name] = rows
        self.found.where[name] = start

    def _vector(self, name: str, at: int, start: int) -> None:
        """Bracketed, but no matrix of the system: desired poles may be complex, so it is kept as it stands."""
        text = self.text
        opened = text.plain.find("[", at)
        if name not in (*POLES, *OBSERVER_POLES, "x0", "x_0") or opened < 0:
            self._pass_over(start, at)
            return
        end = text.closing(opened)
        inner = text.plain[opened : end + 1].strip("[] \t\r\n")
        self.found.vectors[name] = _complex_words(inner)
        self.at = end + 1
        self._end_of_call(at, opened)
        self._transposed(())

    def _pass_over(self, start: int, at: int) -> None:
        """To the end of the statement, which brackets may carry over lines."""
        text, i = self.text, at
        while i < len(text.plain) and text.plain[i] not in ";\n":
            i = text.closing(i) if text.plain[i] in "([" else i
            i += 1
        self.at = i
        self.found.passed.append(" ".join(text.given[start:i].split())[:60])

    def _end_of_scalar(self, at: int) -> int:
        text, i = self.text, at
        while i < len(text.plain) and text.plain[i] not in ",;\n":
            i = text.closing(i) if text.plain[i] == "(" else i
            i += 1
        return i

    def _matrix(self, at: int) -> Rows:
        """The matrix that stands here, whatever the notation; leaves `self.at` behind it."""
        text = self.text
        call = _CALL.match(text.plain, at)
        function = call[1].rpartition(".")[2] if call else ""
        if call and function in _MADE:
            return self._transposed(self._made(function, call.end() - 1))
        if call and function in _ARRAYS:
            opened = text.skip(call.end(), _BLANKS)
            if not text.plain.startswith("[", opened):
                raise text.refuse(
                    f"expected [ after {call[1]}(", opened, "Write its rows as lists: [[1, 2], [3, 4]]."
                )
            rows = self._bracketed(opened)
            self._end_of_call(at, opened)
            return self._transposed(rows)
        if text.plain.startswith("[", at):
            return self._transposed(self._bracketed(at))
        return self._bare_rows(at)

    def _end_of_call(self, at: int, opened: int) -> None:
        """Behind the bracket of np.array( … , dtype=float), where there is one before `opened`."""
        before = self.text.plain.find("(", at)
        if 0 <= before < opened:
            self.at = self.text.closing(before) + 1

    def _transposed(self, rows: Rows) -> Rows:
        if found := _TRANSPOSED.match(self.text.plain, self.at):
            self.at = found.end()
            return tuple(zip(*rows, strict=True)) if rows and len({len(r) for r in rows}) == 1 else rows
        after = self.text.skip(self.at)
        if self.text.plain[after : after + 1] in tuple("*/^+-@"):
            raise self.text.refuse(
                "matrices are not computed with here",
                after,
                "Write the matrix with its entries; letters may have values.",
            )
        return rows

    def _made(self, function: str, opened: int) -> Rows:
        """eye(n), zeros(n, m), ones(n, m); in Python the shape may be a tuple."""
        text, end = self.text, self.text.closing(opened)
        sizes = re.findall(r"\d+", text.plain[opened:end].partition("dtype")[0])
        self.at = end + 1
        if not 1 <= len(sizes) <= 2 or any(not 1 <= int(size[:4]) <= 12 for size in sizes):
            raise text.refuse(f"expected one or two sizes up to 12 in {function}( )", opened)
        n, m = int(sizes[0]), int(sizes[-1])
        square = function in ("eye", "identity")
        own = {
            True: Entry("1", opened, Node("number", 1, parse("1").value)),
            False: Entry("0", opened, parse("0")),
        }
        return tuple(
            tuple(own[bool(_MADE[function]) and (not square or i == j)] for j in range(m)) for i in range(n)
        )

    def _bracketed(self, at: int) -> Rows:
        """[1 2; 3 4], [[1, 2], [3, 4]], or one row."""
        text, end = self.text, self.text.closing(at)
        first = text.skip(at + 1, _BLANKS)
        self.at = end + 1
        rows = tuple(self._lists(first, end) if text.plain[first] == "[" else self._lines(at + 1, end))
        rows = tuple(row for row in rows if row)
        if not rows:
            raise text.refuse("this matrix has no entries", at, "Write them row by row: [1 2; 3 4].")
        return rows

    def _lists(self, at: int, end: int) -> Iterator[tuple[Entry, ...]]:
        text = self.text
        while at < end:
            if text.plain[at] != "[":
                raise text.refuse(
                    f"expected [ of the next row, found {text.plain[at]!r}",
                    at,
                    "Write rows as lists: [[1, 2], [3, 4]].",
                )
            closed = text.closing(at)
            inner = text.skip(at + 1, _BLANKS)
            if text.plain[inner] == "[":
                raise text.refuse(
                    "three brackets stand within one another", inner, "Write rows as lists: [[1, 2], [3, 4]]."
                )
            yield text.row(at + 1, closed)
            at = text.skip(closed + 1, _BLANKS)

    def _lines(self, at: int, end: int) -> Iterator[tuple[Entry, ...]]:
        """Rows that end at a semicolon or a line's end."""
        text, begin = self.text, at
        for i in range(at, end + 1):
            if i == end or text.plain[i] in ";\n":
                yield text.row(begin, i)
                begin = i + 1

    def _bare_rows(self, at: int) -> Rows:
        """Lines of entries up to an empty one, a heading or an assignment."""
        text, rows, i = self.text, list[tuple[Entry, ...]](), at
        while i < len(text.plain):
            start, end = text.skip(i), text.line_end(i)
            ended = text.plain[start:end].strip() == "" or (
                rows and (_ASSIGNED.match(text.plain, start) or _ALONE.match(text.plain, start))
            )
            if ended:
                break
            for begin, stop in _halves(text.plain, start, end):
                rows.append(text.row(begin, stop))
            i = end + 1
        self.at = min(i, len(text.plain))
        rows = [row for row in rows if row]
        if not rows:
            raise text.refuse("expected a matrix here", at, "Write its rows: [1 2; 3 4], or a line for each.")
        return tuple(rows)


def _halves(plain: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """A line of rows with semicolons between them."""
    begin = start
    for i in range(start, end + 1):
        if i == end or plain[i] == ";":
            yield begin, i
            begin = i + 1


def _complex_words(inner: str) -> list[str]:
    """Numbers of a list; [-2+2j -2 - 2j, -10] are three: blanks around signs within a number go."""
    joined = re.sub(r"\s*([-+−–*])\s+", r"\1", re.sub(r"[;,\n\r]+", ",", inner))
    return [word for word in re.split(r"[\s,]+", joined) if word]
