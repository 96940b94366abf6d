"""Pieces of an HTML page: tables, numeric matrices as MathML, sentences. All text is escaped here."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from ..signals import Floats
from ..tables import number


def pole(p: complex) -> str:
    """A pole for people."""
    return number(p, 6)


def table(head: Sequence[str], rows: Iterable[Sequence[str]], caption: str = "") -> str:
    """A table whose first column names the rows."""
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    top = "".join(f'<th scope="col">{escape(cell)}</th>' for cell in head)
    body = "".join(
        f'<tr><th scope="row">{escape(row[0])}</th>'
        + "".join(f"<td>{escape(c)}</td>" for c in row[1:])
        + "</tr>"
        for row in rows
    )
    return f'<div class="wide"><table>{title}<thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>'


def matrix(name: str, rows: Floats, digits: int = 6) -> str:
    """``name = [numbers]`` as one math element; `name` is MathML."""
    cells = "".join(
        "<mtr>" + "".join(f"<mtd><mn>{number(value, digits)}</mn></mtd>" for value in row) + "</mtr>"
        for row in rows.tolist()
    )
    inner = f"<mo>[</mo><mtable>{cells}</mtable><mo>]</mo>"
    return f'<math display="block"><mrow>{name}<mo>=</mo>{inner}</mrow></math>'


def formula(name: str, mathml: str) -> str:
    """``name = expression``: a name as MathML before a whole math element."""
    large = mathml.replace("<math ", '<math displaystyle="true" ', 1)  # fractions of full size
    return f'<p class="formula"><math><mrow>{name}<mo>=</mo></mrow></math> {large}</p>'


def indexed(base: str, index: str) -> str:
    """A letter with a subscript, as MathML."""
    return f"<msub><mi>{escape(base)}</mi><mn>{escape(index)}</mn></msub>"


def figure(picture: str, caption: str) -> str:
    """A drawing with its caption."""
    return f"<figure>{picture}<figcaption>{escape(caption)}</figcaption></figure>"


def section(title: str, *parts: str) -> str:
    """A section with its heading."""
    return f"<section><h2>{escape(title)}</h2>{''.join(parts)}</section>"


def paragraph(text: str, kind: str = "") -> str:
    """One paragraph of plain text."""
    named = f' class="{kind}"' if kind else ""
    return f"<p{named}>{escape(text)}</p>"
