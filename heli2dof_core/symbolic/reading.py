"""Gains beyond the paper's model as a person reads them: the plant's entries are letters, what recurs has a name.

In physical letters an entry of the six-state K takes a line and a half. With b_ij and ν for entries of A⁺, each is
a sum of few terms: thrusts, divided by thrusts, times a polynomial in the desired coefficients and the rig's own.
Those polynomials recur, so each gets a name, h₁, h₂ …, where it is longer than one product.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from ..errors import InvalidInputError
from .full_rank import FullRank, member
from .names import (
    COEFFICIENTS_OF_OBSERVER_POLES,
    COEFFICIENTS_OF_TRIPLES,
    Delta,
    Name,
    a,
    alpha,
    b_11,
    b_12,
    b_21,
    b_22,
    beta_0,
    c,
    d_10,
    d_11,
    d_12,
    d_20,
    d_21,
    d_22,
    nu_p,
    nu_y,
    phi_p,
    phi_y,
    tau_p,
    tau_y,
)
from .names import PARAMETERS as P
from .rotors import COEFFICIENTS, with_rotors

_rate_p, _rate_y = sp.symbols("rate_p rate_y")
_THRUSTS = (
    b_11,
    b_22,
    b_12,
    b_21,
)  # in this order b₁₁b₂₂ leads the determinant, and is what division takes out
_OUTER = (*_THRUSTS, c)
_INNER = (d_10, d_11, d_12, d_20, d_21, d_22, a, nu_p, nu_y, _rate_p, _rate_y)
_DEGREE = {d_10: 3, d_11: 2, d_12: 1, d_20: 3, d_21: 2, d_22: 1, a: 2}  # in 1/s; all others: 1
FIELD = sp.QQ.frac_field(*_OUTER, *_INNER)
"""Of the same derivation as `rotors` and `observer`, in the letters of the plant's entries."""
_DETERMINANT = FIELD.from_sympy(b_11 * b_22 - b_12 * b_21).numer
RATES = {_rate_p: 1 / tau_p, _rate_y: 1 / tau_y}
"""Letters of `FIELD` that people read as fractions."""

ENTRIES: dict[sp.Symbol, sp.Expr] = {
    b_11: P["K_pp"] * phi_p / alpha,
    b_12: P["K_py"] * phi_y / alpha,
    b_21: P["K_yp"] * phi_p / beta_0,
    b_22: P["K_yy"] * phi_y / beta_0,
    nu_p: P["B_p"] / alpha,
    nu_y: P["B_y"] / beta_0,
}
"""What the letters of the plant's entries stand for; a is one already."""


@dataclass(frozen=True)
class Reading:
    """A gain and what its names stand for.

    Attributes:
        gain: K, 2×6, or L, 4×2, immutable.
        T, Q: of the canonical form (of the dual pair for L), in the same letters, immutable.
        definitions: in the order in which they can be put in, last first: each stands on those before it.
        names: those of the groups h₁, h₂ …, with unit and where they occur.
    """

    gain: sp.ImmutableMatrix
    T: sp.ImmutableMatrix
    Q: sp.ImmutableMatrix
    definitions: dict[sp.Symbol, sp.Expr]
    names: tuple[Name, ...]

    def written_out(self, expression: Any, kept: Collection[sp.Symbol] = ()) -> Any:
        """With every name put in, but those kept: physical letters, α, β₀, a, the poles."""
        for symbol, value in reversed(self.definitions.items()):
            if symbol not in kept:
                expression = expression.subs(symbol, value)
        return expression


@cache
def plant_in_letters() -> tuple[DomainMatrix, DomainMatrix]:
    """(A, B) of the four states; B's columns are what the rotors' speeds do."""
    A = sp.zeros(4, 4)
    A[0, 2] = A[1, 3] = 1
    A[2, 0], A[2, 2], A[3, 3] = a, -nu_p, -nu_y
    return _to_field(A), _to_field(sp.Matrix([[0, 0], [0, 0], [b_11, b_12], [b_21, b_22]]))


@cache
def gain_in_letters(structure: Structure, *, shifted: bool = False) -> FullRank:
    """The placement of `rotors.full_rank_with_rotors`, in these letters."""
    rates = (FIELD.from_sympy(_rate_p), FIELD.from_sympy(_rate_y))
    polynomials = [[FIELD.from_sympy(d) for d in triple] for triple in COEFFICIENTS]
    return member(
        *with_rotors(*plant_in_letters(), rates), structure, polynomials, _shift(structure, shifted)
    )


@cache
def paper_gain_in_letters(structure: Structure, *, shifted: bool = False) -> FullRank:
    """The placement of `full_rank.full_rank`, in these letters."""
    polynomials = [[FIELD.from_sympy(d) for d in triple[:2]] for triple in COEFFICIENTS]
    return member(*plant_in_letters(), structure, polynomials, _shift(structure, shifted))


@cache
def observer_in_letters(structure: Structure, *, shifted: bool = False) -> FullRank:
    """The placement of `observer.observer`'s dual pair, in these letters; its K is Lᵀ."""
    A, _ = plant_in_letters()
    polynomials = [[FIELD.from_sympy(d) for d in triple[:2]] for triple in COEFFICIENTS]
    dual = (A.transpose(), _to_field(sp.eye(4, 2)))
    return member(*dual, structure, polynomials, _shift(structure, shifted))


@cache
def read_gain(structure: Structure, *, shifted: bool = False) -> Reading:
    """K, 2×6, of the six states.

    Args:
        structure: which member of the family; its own `shift` is not looked at.
        shifted: leave the basis' shift c a symbol.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    placed, writer = gain_in_letters(structure, shifted=shifted), _Writer()
    K = writer.matrix(placed.K, "k")
    definitions = {**ENTRIES, Delta: b_11 * b_22 - b_12 * b_21, **COEFFICIENTS_OF_TRIPLES, **writer.groups}
    return Reading(K, *_basis(placed), definitions, writer.names())


@cache
def read_observer(structure: Structure, *, shifted: bool = False) -> Reading:
    """L, 4×2, of the observer: `observer.observer` in these letters, and in the poles q₁ … q₄.

    With rotors that lag it is the same: their speeds are simulated along, not corrected.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    placed = observer_in_letters(structure, shifted=shifted)
    L = placed.K.transpose().to_Matrix().subs(COEFFICIENTS_OF_OBSERVER_POLES)
    own = {symbol: ENTRIES[symbol] for symbol in (nu_p, nu_y)}
    gain = sp.ImmutableMatrix(L.applyfunc(lambda entry: sp.collect(sp.expand(entry), (nu_p, nu_y, c))))
    return Reading(gain, *_basis(placed), own, ())


class _Writer:
    """Writes elements of `FIELD` as sums of terms, and names what recurs in them."""

    def __init__(self) -> None:
        self.groups: dict[sp.Symbol, sp.Expr] = {}
        self._known: dict[Any, sp.Symbol] = {}
        self._where: dict[sp.Symbol, list[str]] = {}

    def matrix(self, matrix: DomainMatrix, letter: str = "") -> sp.ImmutableMatrix:
        """Entry by entry; with a letter for the entries their groups get names."""
        rows = [
            [self._entry(element, f"{letter}_{i}{j}" if letter else "") for j, element in enumerate(row, 1)]
            for i, row in enumerate(matrix.to_list(), 1)
        ]
        return sp.ImmutableMatrix(rows)

    def names(self) -> tuple[Name, ...]:
        return tuple(
            Name(
                str(h), f"h_{{{str(h)[2:]}}}", f"group of terms, in {', '.join(self._where[h])}", _unit(value)
            )
            for h, value in self.groups.items()
        )

    def _entry(self, element: Any, where: str) -> sp.Expr:
        return sp.Add(
            *(self._group(coefficient, where) * outer.subs(RATES) for coefficient, outer in _terms(element))
        )

    def _group(self, polynomial: Any, where: str) -> sp.Expr:
        """A coefficient by its name, if it has several terms, and what all of these share before it."""
        content, rest, shared = monomial_out(polynomial)
        if len(rest) == 1 or not where:
            return (content * shared * sp.factor(rest.as_expr())).subs(RATES)
        key = frozenset(
            rest.terms()
        )  # an element's own hash is that of an earlier state where it was made in place
        if key not in self._known:
            self._known[key] = sp.Symbol(f"h_{len(self._known) + 1}")
            self.groups[self._known[key]] = collected(rest)
        name = self._known[key]
        places = self._where.setdefault(name, [])
        if where not in places:
            places.append(where)
        return content * shared.subs(RATES) * name


def collected(polynomial: Any) -> sp.Expr:
    """What is inside a group, sorted by the rig's own letters."""
    return sp.collect(polynomial.as_expr(), (a, nu_p, nu_y, _rate_p, _rate_y)).subs(RATES)


def monomial_out(polynomial: Any) -> tuple[sp.Expr, Any, sp.Expr]:
    """Its content, signed so that the rest leads with a positive number; the rest; what all its terms share."""
    content, rest = polynomial.primitive()
    if rest.LC < 0:
        content, rest = -content, -rest
    common = [min(powers) for powers in zip(*rest.monoms(), strict=True)]
    shared = sp.Mul(*(x**n for x, n in zip(FIELD.symbols, common, strict=True)))
    if any(common):
        rest = rest.exquo(rest.ring.from_expr(shared))
    return sp.Rational(int(content.numerator), int(content.denominator)), rest, shared


def _terms(element: Any) -> Iterator[tuple[Any, sp.Expr]]:
    """Σ coefficient × (thrusts, over thrusts and the determinant): the coefficients hold neither thrusts nor c."""
    above, (below, power) = element.numer, _without_determinant(element.denom, -1)
    for k in range(power, -1, -1):
        above, piece = above.div(_DETERMINANT) if k else (above, above)
        for coefficient, outer in _by_thrusts(piece):
            yield coefficient, outer / (below.as_expr() * Delta**k)


def parts(element: Any) -> Iterator[tuple[Any, sp.Expr]]:
    """The same sum with the fewest differences of thrusts: for floats.

    `_terms` takes Δ out of a product as often as it can, which leaves pieces that nearly cancel where b₁₁b₂₂ is
    small against b₁₂b₂₁. Here what belongs to a product of the letters within, and to a power of c, stays in one
    piece, in lowest terms.
    """
    below, power = _without_determinant(element.denom, -1)
    ring, many = element.numer.ring, len(_THRUSTS)
    outers, inners = dict[tuple[int, ...], Any](), dict[Any, tuple[Any, Any, int]]()
    for powers, number in element.numer.terms():
        thrusts = powers[:many] + (0,) * (len(powers) - many)
        outers[powers[many:]] = outers.get(powers[many:], ring.zero) + ring.from_dict({thrusts: number})
    for (shift, *within), polynomial in outers.items():
        content, outer = polynomial.primitive()
        if outer.LC < 0:
            content, outer = -content, -outer
        outer, taken = _without_determinant(outer, power)
        outer = outer.mul_monom((0,) * many + (shift,) + (0,) * len(within))
        inner = ring.from_dict({(0,) * (many + 1) + tuple(within): content})
        key = frozenset(outer.terms()), power - taken
        inners[key] = inners.get(key, (ring.zero,))[0] + inner, outer, power - taken
    for inner, outer, left in inners.values():
        yield inner, outer.as_expr() / (below.as_expr() * Delta**left)


def _without_determinant(polynomial: Any, most: int) -> tuple[Any, int]:
    """What is left when Δ is divided out, `most` times at most (−1: as often as it goes), and how often that was."""
    power = 0
    while power != most and (divided := polynomial.div(_DETERMINANT))[1] == 0:
        polynomial, power = divided[0], power + 1
    return polynomial, power


def _by_thrusts(polynomial: Any) -> Iterator[tuple[Any, sp.Expr]]:
    """The same polynomial as Σ coefficient × product of thrusts and c."""
    ring, many, parts = polynomial.ring, len(_OUTER), dict[tuple[int, ...], Any]()
    for powers, number in polynomial.terms():
        inner = (0,) * many + powers[many:]
        parts[powers[:many]] = parts.get(powers[:many], ring.zero) + ring.from_dict({inner: number})
    for powers, coefficient in parts.items():
        yield coefficient, sp.Mul(*(x**n for x, n in zip(_OUTER, powers, strict=True)))


def _basis(placed: FullRank) -> tuple[sp.ImmutableMatrix, sp.ImmutableMatrix]:
    writer = _Writer()
    return writer.matrix(placed.form.T), writer.matrix(placed.form.Q)


def _unit(value: sp.Expr) -> str:
    """Of a group, whose terms all have the same power of 1/s."""
    first = sp.Add.make_args(sp.expand(value))[0]
    powers = first.as_powers_dict()
    degree = sum(n * _DEGREE.get(x, 1) for x, n in powers.items() if x.is_Symbol and x not in (tau_p, tau_y))
    degree -= sum(powers.get(tau, 0) for tau in (tau_p, tau_y))
    return "1/s" if degree == 1 else f"1/s{'⁰¹²³⁴⁵⁶⁷⁸⁹'[int(degree)]}"


def _shift(structure: Structure, shifted: bool) -> Any:
    if not shifted:
        return None
    if structure.coupling == "axis-decoupled":
        raise InvalidInputError("the axis-decoupled structure has no shift", field="shifted")
    return FIELD.from_sympy(c)


def _to_field(matrix: sp.MatrixBase) -> DomainMatrix:
    return DomainMatrix.from_Matrix(matrix).convert_to(FIELD).to_dense()
