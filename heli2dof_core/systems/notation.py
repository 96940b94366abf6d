"""Expressions as they were typed, in LaTeX."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import Decimal, localcontext
from fractions import Fraction

from ..symbolic.grammar import Node, parse


def latex_of_rows(rows: Sequence[Sequence[str]]) -> str:
    """A matrix of expressions."""
    body = r" \\ ".join(" & ".join(latex_of(parse(entry)) for entry in row) for row in rows)
    return rf"\left[\begin{{matrix}}{body}\end{{matrix}}\right]"


def latex_of(node: Node) -> str:
    """An expression; what was divided stands in fractions."""
    return _WRITERS[node.kind](node)


def _power(node: Node) -> str:
    base = node.parts[0]
    inner = latex_of(base) if base.kind in ("letter", "number") else rf"\left({latex_of(base)}\right)"
    return rf"{{{inner}}}^{{{_number(node.value)}}}"


def _sum(node: Node) -> str:
    words = ""
    for sign, part in zip(node.signs, node.parts, strict=True):
        inner = (
            rf"\left({latex_of(part)}\right)"
            if part.kind == "sum" and (words or sign < 0)
            else latex_of(part)
        )
        words += ("-" if sign < 0 else "+" if words else "") + inner
    return words


def _quotient(node: Node) -> str:
    above, below = ([p for s, p in zip(node.signs, node.parts, strict=True) if s == own] for own in (1, -1))
    if not below:
        return _product(above)
    if above[0].kind == "sum" and above[0].signs == (-1,):  # −k/m: the sign stands before the fraction
        return rf"-\frac{{{_product([above[0].parts[0], *above[1:]])}}}{{{_product(below)}}}"
    return rf"\frac{{{_product(above)}}}{{{_product(below)}}}"


def _product(factors: Sequence[Node]) -> str:
    if len(factors) == 1:
        return latex_of(factors[0])
    words, before = "", None
    for factor in factors:
        inner = latex_of(factor)
        if factor.kind == "sum":
            inner = inner if factor.signs == (-1,) and not words else rf"\left({inner}\right)"
        if words:
            words += (
                r" \cdot "
                if factor.kind == "number" or (before and before.kind == "number" and inner[:1].isdigit())
                else r" \, "
            )
        words, before = words + inner, factor
    return words


def _number(value: Fraction) -> str:
    below = value.denominator
    for prime in (2, 5):
        while below % prime == 0:
            below //= prime
    if below != 1:
        return rf"\frac{{{value.numerator}}}{{{value.denominator}}}"
    with localcontext() as context:
        context.prec = 60
        text = format((Decimal(value.numerator) / Decimal(value.denominator)).normalize(), "f")
    if len(text) > 10:
        mantissa, _, tens = f"{float(value):.6e}".partition("e")
        return rf"{mantissa.rstrip('0').rstrip('.')} \cdot 10^{{{int(tens)}}}"
    return text


def _letter(name: str) -> str:
    from sympy import Symbol, latex

    return latex(Symbol(name))


_WRITERS: dict[str, Callable[[Node], str]] = {
    "number": lambda node: _number(node.value),
    "letter": lambda node: _letter(node.name),
    "sqrt": lambda node: rf"\sqrt{{{latex_of(node.parts[0])}}}",
    "power": _power,
    "sum": _sum,
    "product": _quotient,
}
