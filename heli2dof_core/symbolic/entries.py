"""Matrices of expressions over a field of rational functions in their letters.

A root of letters is no rational function of them, but of their roots: where √k occurs, the field has a generator r in
k's place with k = r², and zero is recognised as everywhere. Letters under a root are so taken as positive, and
√(k m) is √k √m.
"""

from __future__ import annotations

import builtins
import keyword
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import comb, isqrt
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..errors import InvalidInputError
from .grammar import Node, WrittenError, letters

MOST_LETTERS = 16
MOST_TERMS = 100
"""Of numerator and denominator of an entry, multiplied out."""
MOST_BITS = 512
"""Of a coefficient."""
MOST_DEGREE = 24
DEEPEST_ROOT = 3
"""Square roots of square roots of one letter."""

Tree = Sequence[Sequence[Node]]


@dataclass(frozen=True)
class Letters:
    """The field that matrices are read over.

    Attributes:
        domain: rational functions over the whole numbers.
        symbols: by the letter's name the symbol that stands for it in results.
        roots: by the letter's name how often its square root is taken; the generator is its 2^roots-th root.
    """

    domain: Any
    symbols: Mapping[str, sp.Symbol]
    roots: Mapping[str, int]
    _generators: Mapping[str, Any] = field(repr=False, compare=False)

    @classmethod
    def of(cls, names: Sequence[str], roots: Mapping[str, int], own: Mapping[str, sp.Symbol]) -> Letters:
        """The field of these letters; `own` are symbols that some have already."""
        symbols = {name: own.get(name, sp.Symbol(printable(name))) for name in names}
        stand_in = {name: sp.Dummy(f"r_{name}") if roots.get(name) else symbols[name] for name in names}
        generators = [*stand_in.values()] or [sp.Dummy("nothing")]
        domain = sp.ZZ.frac_field(*generators)
        found = dict(zip(generators, domain.gens, strict=True))
        return cls(domain, symbols, dict(roots), {name: found[stand_in[name]] for name in names})

    @property
    def positive(self) -> tuple[sp.Symbol, ...]:
        """The letters under roots, which are taken as positive."""
        return tuple(self.symbols[name] for name, count in self.roots.items() if count)

    def element(self, name: str) -> Any:
        """The letter in the field."""
        return self._generators[name] ** 2 ** self.roots.get(name, 0)

    def in_letters(self, expression: sp.Expr) -> Any:
        """With roots of letters in place of what stands for them."""
        written = {
            self.domain.to_sympy(self._generators[name]): self.symbols[name] ** sp.Rational(1, 2**count)
            for name, count in self.roots.items()
            if count
        }
        return expression.xreplace(written) if written else expression

    def condition(self, factor: Any) -> sp.Expr:
        """An irreducible polynomial as a condition; of a root alone its letter."""
        for name, generator in self._generators.items():
            if factor == generator.numer:
                return self.symbols[name]
        return self.in_letters(factor.as_expr())

    def never_zero(self, factor: Any) -> bool:
        """Whether a polynomial is positive, or negative, wherever the letters under roots are positive."""
        rooted = {
            i
            for i, g in enumerate(self.domain.gens)
            if any(self._generators[name] == g for name, count in self.roots.items() if count)
        }
        powers = [i for monomial in factor for i, power in enumerate(monomial) if power]
        signs = {int(c) > 0 for c in factor.values()}
        return len(factor) > 1 and len(signs) == 1 and set(powers) <= rooted

    def root(self, value: Any, position: int) -> Any:
        """√ of an element.

        Raises:
            WrittenError: it is no number or product of letters and numbers.
            _Rooted: it is, but the field lacks a root; with the letters.
        """
        sides = [_monomial(side) for side in (value.numer, value.denom)]
        if not value:
            return value
        sides = [side for side in sides if side is not None]
        if len(sides) < 2:
            raise WrittenError(
                "sqrt takes numbers, and products of letters and numbers",
                position,
                "Give the root of a sum a letter of its own.",
            )
        names = {generator: name for name, generator in self._generators.items()}
        found, lacking = self.domain.one, []
        for (powers, number), up in zip(sides, (1, -1), strict=True):
            root = isqrt(abs(number))
            if number < 0 or root * root != number:
                raise WrittenError(
                    f"sqrt of {number} is {'not real' if number < 0 else 'no fraction'}",
                    position,
                    "Give the root of a number a letter of its own, or a decimal number.",
                )
            found = found * root**up if up > 0 else found / root
            for generator, power in zip(self.domain.gens, powers, strict=True):
                if power % 2:
                    lacking.append(names[generator])
                found = found * generator ** (up * (power // 2))
        if lacking:
            raise _RootedError(lacking)
        return found


@dataclass(frozen=True)
class Entries:
    """Matrices as they were read.

    Attributes:
        letters: the field.
        matrices: the matrices over it.
        divisors: what is divided by somewhere in them, numerators over the field's ring.
    """

    letters: Letters
    matrices: tuple[DomainMatrix, ...]
    divisors: tuple[Any, ...]


class _RootedError(Exception):
    def __init__(self, names: Sequence[str]) -> None:
        super().__init__()
        self.names = names


def read_matrices(trees: Mapping[str, Tree], own: Mapping[str, sp.Symbol]) -> Entries:
    """Matrices of expressions, by their fields' names, over one field of rational functions.

    Args:
        trees: by field such as ``A`` the matrix.
        own: symbols that letters have already.

    Raises:
        InvalidInputError: an entry is beyond a limit, divides by 0, or has a root that is none of its letters';
            the field names which, as ``A.1.0``.
    """
    names = list(
        dict.fromkeys(
            name for tree in trees.values() for row in tree for node in row for name in letters(node)
        )
    )
    if len(names) > MOST_LETTERS:
        raise InvalidInputError(
            f"the matrices have {len(names)} letters, and at most {MOST_LETTERS} are possible",
            field="A",
            hint="Give numbers for some of them, or one letter for a whole expression.",
        )
    roots: dict[str, int] = {}
    while True:
        known = Letters.of(names, roots, own)
        try:
            return _read(trees, known)
        except _RootedError as rooted:
            for name in rooted.names:
                roots[name] = roots.get(name, 0) + 1
                if roots[name] > DEEPEST_ROOT:
                    raise InvalidInputError(
                        f"square roots of {name} stand within one another more than {DEEPEST_ROOT} deep",
                        field="A",
                        hint="Give the root a letter of its own.",
                    ) from None


def _read(trees: Mapping[str, Tree], known: Letters) -> Entries:
    divisors: dict[Any, None] = {}
    matrices = []
    for matrix, tree in trees.items():
        rows: list[list[Any]] = []
        for i, row in enumerate(tree):
            rows.append([])
            for j, node in enumerate(row):
                with entry_named(matrix, i, j):
                    rows[-1].append(_value(node, known, divisors))
        matrices.append(DomainMatrix(rows, (len(rows), len(rows[0])), known.domain))
    return Entries(known, tuple(matrices), tuple(divisors))


class entry_named:  # noqa: N801
    """Whatever is refused in here is of this entry, counted from 0."""

    def __init__(self, matrix: str, row: int, column: int, value: object = None) -> None:
        self._where = matrix, row, column
        self._value = value

    def __enter__(self) -> None:
        return None

    def __exit__(self, _kind: object, error: BaseException | None, _trace: object) -> None:
        if isinstance(error, InvalidInputError) and not error.field:
            matrix, row, column = self._where
            error.args = (f"{matrix}, row {row + 1}, column {column + 1}, {error}",)
            error.field = f"{matrix}.{row}.{column}"
            if error.value is None and isinstance(self._value, (str, int, float)):
                error.value = self._value


def _value(node: Node, known: Letters, divisors: dict[Any, None]) -> Any:
    """The value of an expression in the field; what it divides by is added to `divisors`."""
    match node.kind:
        case "number":
            return known.domain(node.value.numerator) / known.domain(node.value.denominator)
        case "letter":
            return known.element(node.name)
        case "sqrt":
            return known.root(_value(node.parts[0], known, divisors), node.position)
        case "power":
            return _power(node, known, divisors)
        case "sum":
            total = known.domain.zero
            for part, sign in zip(node.parts, node.signs, strict=True):
                value = _value(part, known, divisors)
                total = _bounded(total + value if sign > 0 else total - value, part)
            return total
        case "product":
            total = known.domain.one
            for part, sign in zip(node.parts, node.signs, strict=True):
                value = _value(part, known, divisors)
                total = _bounded(total * value if sign > 0 else total * _inverse(value, part, divisors), part)
            return total


def _power(node: Node, known: Letters, divisors: dict[Any, None]) -> Any:
    base, exponent = _value(node.parts[0], known, divisors), node.value
    if exponent.denominator == 2:
        base, exponent = known.root(base, node.position), 2 * exponent
    count = abs(exponent.numerator)
    for side in (base.numer, base.denom):
        if comb(len(side) + count - 1, count) > MOST_TERMS or _bits(side) * count > MOST_BITS:
            raise _too_large(node)
    value = _bounded(base**count, node)
    return _inverse(value, node, divisors) if exponent < 0 else value


def _inverse(value: Any, node: Node, divisors: dict[Any, None]) -> Any:
    if not value:
        raise WrittenError("this is a division by 0", node.position, "Divide by what is not 0.")
    divisors[value.numer] = None
    return 1 / value


def _bounded(value: Any, node: Node) -> Any:
    for side in (value.numer, value.denom):
        degree = max(map(sum, side), default=0)
        if len(side) > MOST_TERMS or degree > MOST_DEGREE or _bits(side) > MOST_BITS:
            raise _too_large(node)
    return value


def _bits(polynomial: Any) -> int:
    return max((abs(int(c)).bit_length() for c in polynomial.values()), default=0)


def _too_large(node: Node) -> WrittenError:
    return WrittenError(
        f"multiplied out this has more than {MOST_TERMS} terms, degree {MOST_DEGREE} or {MOST_BITS // 4} digits",
        node.position,
        "Give a letter for a part of it.",
    )


def _monomial(polynomial: Any) -> tuple[tuple[int, ...], int] | None:
    """Powers and coefficient, where it has one term."""
    terms = list(polynomial.terms())
    return (terms[0][0], int(terms[0][1])) if len(terms) == 1 else None


def tree_of(value: object) -> Node:
    """The tree of a SymPy expression or a number.

    A float is the shortest decimal number that is read as it: 0.1 is 1/10.

    Raises:
        InvalidInputError: it is not finite, or has more in it than the grammar knows.
    """
    if isinstance(value, bool) or value is None:
        raise InvalidInputError("expected a number or an expression", value=str(value))
    if isinstance(value, (int, Fraction)):
        return _sized_number(Fraction(value))
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, sp.Basic):
        return _of_sympy(value)
    raise InvalidInputError("expected a number or an expression", value=type(value).__name__)


def _number(value: float) -> Node:
    try:
        return _sized_number(Fraction(repr(float(value))))
    except ValueError:
        raise InvalidInputError("expected a finite number", value=str(value)) from None


def _sized_number(value: Fraction) -> Node:
    if max(abs(value.numerator), value.denominator).bit_length() > MOST_BITS:
        raise InvalidInputError(
            "the number has too many digits", hint="Give it in other units, or a letter for it."
        )
    return Node("number", 1, value)


def _of_sympy(value: sp.Basic) -> Node:
    match value:
        case sp.Rational():
            return _sized_number(Fraction(int(value.p), int(value.q)))
        case sp.Float():
            return _number(float(value))
        case sp.Symbol():
            return Node("letter", 1, name=value.name)
        case sp.Add():
            parts = tuple(_of_sympy(part) for part in value.args)
            return Node("sum", 1, parts=parts, signs=(1,) * len(parts))
        case sp.Mul():
            parts = tuple(_of_sympy(part) for part in value.args)
            return Node("product", 1, parts=parts, signs=(1,) * len(parts))
        case sp.Pow(base=base, exp=sp.Rational() as exponent) if exponent.q in (1, 2):
            return Node("power", 1, Fraction(int(exponent.p), int(exponent.q)), parts=(_of_sympy(base),))
        case _:
            raise InvalidInputError(
                f"{type(value).__name__} is no part of a rational expression",
                value=str(value)[:LONGEST_SHOWN],
                hint="Give letters, numbers, sums, products, powers and square roots; or a letter for the whole.",
            )


LONGEST_SHOWN = 200


def symbols_of(values: Iterator[object]) -> dict[str, sp.Symbol]:
    """The symbols of SymPy expressions, by name.

    Raises:
        InvalidInputError: two of them have one name.
    """
    found: dict[str, sp.Symbol] = {}
    for value in values:
        for symbol in value.atoms(sp.Symbol) if isinstance(value, sp.Basic) else ():
            if found.setdefault(symbol.name, symbol) != symbol:
                raise InvalidInputError(
                    f"two different symbols are called {symbol}",
                    field="A",
                    hint="Give them one set of assumptions.",
                )
    return found


def printable(name: str) -> str:
    """A name that parses back as a symbol: what has a meaning in SymPy or Python gets an underscore, as gamma_."""
    taken = name in sp.__all__ or hasattr(sp, name) or hasattr(builtins, name) or keyword.iskeyword(name)
    return f"{name}_" if taken else name
