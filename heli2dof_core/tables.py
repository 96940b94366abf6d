"""How results show themselves: one line as text, small tables in a notebook and on the command line.

A result says what is worth seeing of it (`Shown`), in words and tables of text; nothing here knows what it shows.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

MINUS = "−"
NOTHING = "—"
"""Stands where there is no value."""


@dataclass(frozen=True)
class Table:
    """A small table of text; the first column heads its rows.

    Attributes:
        title: above it.
        columns: their heads, one per cell of a row.
        rows: cells, as they are to be read.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    @classmethod
    def of(cls, title: str, columns: Iterable[str], rows: Iterable[Iterable[str]]) -> Table:
        """From anything that can be walked through."""
        return cls(title, tuple(columns), tuple(tuple(row) for row in rows))

    @classmethod
    def matrix(cls, title: str, matrix: Any, rows: Sequence[str], columns: Sequence[str]) -> Table:
        """A matrix of numbers with the names of its rows and columns."""
        cells = (
            (name, *map(number, row)) for name, row in zip(rows, np.asarray(matrix).tolist(), strict=True)
        )
        return cls.of(title, ("", *columns), cells)

    @property
    def numeric(self) -> tuple[bool, ...]:
        """Per column, whether numbers alone stand there: these align to the right, words to the left."""
        return tuple(all(row[i][:1] in _NUMERIC for row in self.rows) for i in range(len(self.columns)))


_NUMERIC = "−0123456789" + NOTHING


class Shown:
    """Base of a result: a repr of one line without arrays, and its tables where a notebook shows it."""

    __slots__ = ()

    def summary(self) -> str:
        """One line, without the numbers of arrays: what the repr says after the type's name."""
        raise NotImplementedError

    def tables(self) -> tuple[Table, ...]:
        """What a notebook and the command line show; numbers of four digits, for people."""
        return ()

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.summary()}>"

    def _repr_html_(self) -> str | None:
        parts = "".join(map(_html, self.tables()))
        return f"<div><p><b>{type(self).__name__}</b>: {escape(self.summary())}</p>{parts}</div>"


def number(value: complex | None, digits: int = 4, *, minus: str = MINUS, gap: str = " ") -> str:
    """A number as people write it, with a true minus; `NOTHING` for None.

    >>> number(-0.000012345), number(-3 + 4j), number(None), number(-3 - 4j, minus="-", gap="")
    ('−1.234e−05', '−3 + 4j', '—', '-3-4j')
    """
    if value is None:
        return NOTHING
    if isinstance(value, complex) and value.imag:
        sign = "+" if value.imag > 0 else minus
        return gap.join((number(value.real, digits, minus=minus), sign, _imaginary(value, digits, minus)))
    return f"{value.real + 0.0:.{digits}g}".replace("-", minus)  # + 0.0: no negative zero


def conjugates(p: complex, digits: int = 4) -> str:
    """A pole that stands for its conjugate, too.

    >>> conjugates(-3 - 4j), conjugates(-12)
    ('−3 ± 4j', '−12')
    """
    return f"{number(p.real, digits)} ± {_imaginary(p, digits)}" if p.imag else number(p.real, digits)


def _imaginary(p: complex, digits: int, minus: str = MINUS) -> str:
    return number(abs(p.imag), digits, minus=minus) + "j"


def poles(values: Iterable[complex], digits: int = 4) -> str:
    """Poles in one line; conjugates that follow one another as one.

    >>> poles([-12, -10, -3 + 4j, -3 - 4j])
    '−12, −10, −3 ± 4j'
    """
    left, words = [complex(p) for p in values], []
    while left:
        p, *left = left
        if p.imag and left and abs(left[0] - p.conjugate()) <= 1e-9 * abs(p):
            left.pop(0)
            words.append(conjugates(p, digits))
        else:
            words.append(number(p, digits))
    return ", ".join(words)


def latex_matrix(name: str, matrix: Any) -> str:
    """A matrix of numbers as a displayed formula."""
    rows = r" \\ ".join(" & ".join(map(_latex, row)) for row in np.asarray(matrix).tolist())
    return rf"$\displaystyle {name} = \begin{{bmatrix}} {rows} \end{{bmatrix}}$"


def _latex(value: float) -> str:
    mantissa, _, exponent = f"{value:.4g}".partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


def _html(table: Table) -> str:
    sides = [f"text-align:{'right' if numeric else 'left'}" for numeric in table.numeric]
    heads = zip(table.columns, sides, strict=True)
    head = "".join(f'<th scope="col" style="{side}">{escape(name)}</th>' for name, side in heads)
    rows = "".join(f"<tr>{_cells(row, sides)}</tr>" for row in table.rows)
    caption = f"<caption>{escape(table.title)}</caption>"
    return f"<table>{caption}<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def _cells(row: tuple[str, ...], sides: list[str]) -> str:
    first, *rest = (f' style="{side}">{escape(cell)}</' for cell, side in zip(row, sides, strict=True))
    return f'<th scope="row"{first}th>' + "".join(f"<td{cell}td>" for cell in rest)
