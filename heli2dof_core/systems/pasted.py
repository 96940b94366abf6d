"""A system as people paste it: from MATLAB, Python or a page of text, in numbers or with letters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..errors import InvalidInputError
from ..findings import Finding
from ..placement.method import MOST_STATES
from ..symbolic.grammar import WrittenError, letters
from .model import System
from .statements import MATRICES, OBSERVER_POLES, OTHER_LETTERS, POLES, Rows, Statements, read_statements
from .text import Entry, PastedError, Text
from .values import Values, complex_number, value_of

MOST_LETTERS = 40


@dataclass(frozen=True)
class Pasted:
    """A system as it was read.

    Attributes:
        system: in numbers.
        rows: A, B, C and D, those that were given, as expressions, row by row.
        letters: those of the matrices, each with its value; 1 where none is given.
        missing: letters without a value, for which `system` takes 1.
        poles, observer_poles: desired ones, where the text has some; n of them.
        findings: what was passed over or taken otherwise than it stands.
    """

    system: System
    rows: Mapping[str, Sequence[Sequence[str]]]
    letters: Mapping[str, float]
    missing: tuple[str, ...]
    poles: tuple[complex, ...] | None
    observer_poles: tuple[complex, ...] | None
    findings: tuple[Finding, ...]

    @property
    def symbolic(self) -> bool:
        """Whether there are letters."""
        return bool(self.letters)


def read_system(given: str) -> Pasted:
    """Reads a system.

    >>> read_system("A = [0 1; -k/m 0], B = [0; 1/m], m = 2").missing
    ('k',)

    Args:
        given: statements of MATLAB or Python, or rows under headings or by themselves; see `statements`.

    Raises:
        PastedError: it cannot be read; with line, column and what to do.
        InvalidInputError: it can, but is no system.
    """
    text, found = read_statements(given)
    remarks = list[Finding]()
    _other_letters(found, remarks)
    for name in "AB":
        if name not in found.matrices:
            raise text.refuse(
                f"there is no {name}", len(given.rstrip()), "Give A and B: A = [0 1; -2 -3], B = [0; 1]."
            )
    _require_shapes(text, found, remarks)
    system, values = _numbers(text, found)
    own = dict.fromkeys(
        name
        for rows in found.matrices.values()
        for row in rows
        for entry in row
        for name in letters(entry.node)
    )
    missing = tuple(values.missing)
    if missing:
        remarks.append(
            Finding(
                "letters_without_values",
                "warning",
                f"{'These letters have' if len(missing) > 1 else 'This letter has'} no value, and numbers take 1: "
                f"{', '.join(missing)}. Write {next(iter(missing))} = value.",
            )
        )
    if found.passed:
        shown = "; ".join(found.passed[:3]) + (" …" if len(found.passed) > 3 else "")
        remarks.append(Finding("passed_over", "info", f"Not looked at: {shown}"))
    return Pasted(
        system,
        {
            name: [[e.text for e in row] for row in found.matrices[name]]
            for name in MATRICES
            if name in found.matrices
        },
        {name: values(name) for name in own},
        missing,
        _poles(found, POLES, len(system.A), remarks),
        _poles(found, OBSERVER_POLES, len(system.A), remarks),
        tuple(remarks),
    )


def _other_letters(found: Statements, remarks: list[Finding]) -> None:
    """F, G, H and J in place of A, B, C and D."""
    if "A" in found.matrices or "F" not in found.matrices:
        for other in OTHER_LETTERS:
            found.matrices.pop(other, None)
        return
    for other, name in OTHER_LETTERS.items():
        if other in found.matrices:
            found.matrices[name] = found.matrices.pop(other)
            found.where[name] = found.where[other]
    remarks.append(Finding("other_letters", "info", "F, G, H and J were read as A, B, C and D."))


def _require_shapes(text: Text, found: Statements, remarks: list[Finding]) -> None:
    """Raises PastedError where a matrix does not fit; turns a B that is written as a row, and a C as a column."""
    matrices, where = found.matrices, found.where
    n = len(matrices["A"])
    if len(matrices["A"][0]) != n or n > MOST_STATES:
        raise text.refuse(
            f"A has {n} rows and {len(matrices['A'][0])} columns",
            where["A"],
            f"Give a square matrix of at most {MOST_STATES} states.",
        )
    for name, row in (("B", True), ("C", False)):
        rows = matrices.get(name)
        if rows is None or n == 1:
            continue
        if (len(rows), len(rows[0])) == ((1, n) if row else (n, 1)):
            matrices[name] = tuple(zip(*rows, strict=True))
            kind = ("row", "column") if row else ("column", "row")
            remarks.append(
                Finding(
                    f"{name}_turned", "info", f"{name} is written as a {kind[0]} and was read as a {kind[1]}."
                )
            )
    p = len(matrices["B"][0])
    q = len(matrices["C"]) if "C" in matrices else n
    wanted = {"B": (n, p), "C": (q, n), "D": (q, p)}
    if (
        "D" in matrices
        and matrices["D"] == ((matrices["D"][0][0],),)
        and matrices["D"][0][0].text in ("0", "0.0")
    ):
        zero = matrices["D"][0][0]
        matrices["D"] = tuple((zero,) * p for _ in range(q))  # D = 0, as books print it
    for name, (high, wide) in wanted.items():
        rows = matrices.get(name)
        if rows is not None and (len(rows), len(rows[0])) != (high, wide):
            raise text.refuse(
                f"{name} has {len(rows)} rows and {len(rows[0])} columns, and {high} and {wide} would fit",
                where[name],
                "B has a row per state, C a column per state, D a row per output and a column per input.",
            )


def _numbers(text: Text, found: Statements) -> tuple[System, Values]:
    if len(found.letters) > MOST_LETTERS:
        raise InvalidInputError(
            f"{len(found.letters)} letters are given, and at most {MOST_LETTERS} are possible", field="text"
        )
    values = Values({name: entry.node for name, entry in found.letters.items()})
    for name, entry in found.letters.items():
        try:
            values(name)
        except WrittenError as error:
            raise _placed(text, error, entry.start) from None
        except RecursionError:
            raise text.refuse(
                f"{name} is given by too many others", entry.start, "Give it a number."
            ) from None

    def numbers(rows: Rows) -> list[list[float]]:
        return [[_value(text, entry, values) for entry in row] for row in rows]

    given = {name: numbers(rows) for name, rows in found.matrices.items() if name in MATRICES}
    try:
        return System.of(given["A"], given["B"], given.get("C"), given.get("D")), values
    except InvalidInputError as error:
        if error.field not in found.where:
            raise
        raise text.refuse(str(error), found.where[error.field], error.hint) from None


def _value(text: Text, entry: Entry, values: Values) -> float:
    try:
        return value_of(entry.node, values)
    except WrittenError as error:
        raise _placed(text, error, entry.start) from None


def _placed(text: Text, error: WrittenError, start: int) -> PastedError:
    return text.refuse(str(error).partition(": ")[2], start + error.position - 1, error.hint)


def _poles(
    found: Statements, names: Sequence[str], n: int, remarks: list[Finding]
) -> tuple[complex, ...] | None:
    """The desired poles of a text; none where they are not n readable numbers, which a remark says."""
    for name in names:
        words = found.vectors.get(name)
        if words is None:
            continue
        try:
            poles = tuple(complex_number(word) for word in words)
        except InvalidInputError:
            poles = ()
        if len(poles) == n:
            return poles
        remarks.append(
            Finding(
                "poles_passed_over",
                "info",
                f"{name} has {len(words)} entries; as desired poles this system needs {n} numbers.",
            )
        )
    return None
