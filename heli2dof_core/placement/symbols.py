"""Full-rank placement of any controllable (A, B) whose entries hold letters: the formulas, and where they hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..errors import InvalidInputError, UncontrollableError, Wanted, nobody_leaves
from ..findings import Finding
from ..signals import Complexes
from ..tables import Shown
from .exact import decimal_fraction, exact_coefficients
from .groups import Group, assign, require_groups

if TYPE_CHECKING:  # SymPy is imported on the first placement
    import sympy as sp
    from sympy.polys.matrices import DomainMatrix

    from ..symbolic.entries import Entries, Letters
    from ..symbolic.grammar import Node
    from ..symbolic.luenberger import CanonicalForm

MOST_STATES = 6
LONGEST_FACTORED = 12
"""Terms of a numerator that is factored."""
_Parts = list[tuple[Any, "DomainMatrix"]]
"""A sum of matrices over the field, each times an expression in the poles."""
Poles = Sequence[complex] | Literal["symbols"]


@dataclass(frozen=True, repr=False)
class SymbolicPlacement(Shown):
    """K of u = −Kx + v in formulas; matrices are SymPy's, immutable.

    Attributes:
        A, B: as they were read, n×n and n×p.
        T: n×n, x̄ = Tx.
        Q: p×p, the nonzero rows of TB.
        K: p×n.
        closed_loop: A − BK.
        controllability_indices: σ, one per input, for letters in general position.
        groups: the blocks of the closed loop.
        holds_unless: all of this holds wherever none of these is 0, and nowhere else: there an entry divides by 0, or
            the controllability indices are others. Irreducible, each once.
        letters: by the name that was given, the symbol.
        findings: remarks.
    """

    A: sp.ImmutableMatrix
    B: sp.ImmutableMatrix
    T: sp.ImmutableMatrix
    Q: sp.ImmutableMatrix
    K: sp.ImmutableMatrix
    closed_loop: sp.ImmutableMatrix
    controllability_indices: tuple[int, ...]
    groups: tuple[Group, ...]
    holds_unless: tuple[sp.Expr, ...]
    letters: Mapping[str, sp.Symbol]
    findings: tuple[Finding, ...]

    def summary(self) -> str:
        """Indices and conditions."""
        indices = ", ".join(map(str, self.controllability_indices))
        conditions = ", ".join(f"{condition} ≠ 0" for condition in self.holds_unless)
        return f"controllability indices {indices}; {f'holds where {conditions}' if conditions else 'holds always'}"

    def _repr_html_(self) -> None:
        return None  # so that notebooks typeset K

    def _repr_latex_(self) -> str:
        import sympy as sp

        return rf"$\displaystyle K = {sp.latex(self.K)}$"


def symbolic_place(
    A: Any,
    B: Any,
    poles: Poles = "symbols",
    groups: Sequence[Group] | None = None,
    *,
    wanted: Wanted = nobody_leaves,
) -> SymbolicPlacement:
    """Places the poles of any controllable (A, B) in formulas (theory: steps 1–5), block-diagonal in x̄.

    >>> placed = symbolic_place([["0", "1"], ["a", "-b/m"]], [["0"], ["1/m"]])
    >>> placed.K
    Matrix([[a*m + m*p_1*p_2, -b + m*(-p_1 - p_2)]])
    >>> placed.holds_unless
    (m,)

    Args:
        A: n×n, up to six states: rows of texts in the grammar of `symbolic.grammar`, of numbers or of SymPy's
            expressions; or a matrix of SymPy's or NumPy's. A float is the shortest decimal number read as it.
        B: n×p, likewise.
        poles: n, complex ones with their conjugates, which numbers are taken as decimal; or ``symbols``: p_1 … p_n.
        groups: which poles go into the block of which input; by default in their order.
        wanted: called now and then; what it raises ends the work.

    Raises:
        InvalidInputError: an entry is no expression, with the field such as ``A.1.0`` and the position; a shape does
            not fit; or the formulas take too long.
        UnpairedPolesError: the poles, or a group of them, are not closed under conjugation.
        UncontrollableError: (A, B) is not controllable, whatever the letters are.
    """
    import sympy as sp

    from ..symbolic.budget import within_budget
    from ..symbolic.entries import read_matrices, symbols_of

    given = {name: _rows(matrix, name) for name, matrix in (("A", A), ("B", B))}
    n = _require_shapes(given)
    numbers = _numbers(poles, n)
    own = symbols_of(value for matrix in given.values() for row in matrix for value in row)
    trees = {name: _trees(matrix, name) for name, matrix in given.items()}
    with within_budget(wanted=wanted):
        read = read_matrices(trees, own)
        symbols = [sp.Symbol(f"p_{i + 1}") for i in range(n)] if numbers is None else []
        _require_free(read.letters, symbols)
        return _placed(read, numbers, symbols, groups)


def _placed(
    read: Entries, numbers: Complexes | None, symbols: Sequence[sp.Symbol], groups: Sequence[Group] | None
) -> SymbolicPlacement:
    import sympy as sp

    from ..symbolic.luenberger import canonical_form, chains, controllability_indices, leading_rows

    A, B = read.matrices
    _require_inputs(B)
    try:
        indices = controllability_indices(A, B)
    except UncontrollableError:
        raise UncontrollableError(
            "the inputs do not reach all states, whatever the letters are",
            field="B",
            hint="Add an input, or take the states that no input reaches out of the model.",
        ) from None
    dealt = np.arange(A.shape[0]).astype(np.complex128) if numbers is None else numbers
    chosen = require_groups(assign(dealt, indices) if groups is None else groups, dealt, indices)
    form = canonical_form(A, B, indices, leading_rows(A, B, indices))
    parts = _gain(form, chosen, numbers, symbols)
    closed = [(of, -B.matmul(part)) for of, part in parts]
    closed[0] = (closed[0][0], A + closed[0][1])
    matrices = {
        "A": [(1, A)],
        "B": [(1, B)],
        "T": [(1, form.T)],
        "Q": [(1, form.Q)],
        "K": parts,
        "closed_loop": closed,
    }
    conditions = _conditions(read, chains(A, B, indices).det())
    write = _Writer(read.letters, conditions)
    positive = read.letters.positive
    return SymbolicPlacement(
        **{name: sp.ImmutableMatrix(write.matrix(matrix)) for name, matrix in matrices.items()},
        controllability_indices=indices,
        groups=chosen,
        holds_unless=_told(conditions, read.letters),
        letters=read.letters.symbols,
        findings=(_positive(positive),) if positive else (),
    )


def _gain(
    form: CanonicalForm, groups: Sequence[Group], numbers: Complexes | None, symbols: Sequence[sp.Symbol]
) -> _Parts:
    """K = K₀ + Σ d_k K_k in the coefficients d_k of the groups' polynomials, which poles as numbers have in K₀.

    K is affine in them, since D is: so the field needs no generators for them, which would cost most of the time.
    """
    from ..symbolic.luenberger import desired_rows, feedback

    domain = form.T.domain
    fixed = [(group.inputs, [domain.zero] * len(group.poles)) for group in groups]
    if numbers is not None:
        for group, (_, coefficients) in zip(groups, fixed, strict=True):
            own = exact_coefficients(numbers[list(group.poles)], decimal_fraction)
            coefficients[:] = [domain(int(d.numerator)) / domain(int(d.denominator)) for d in own]
    D = desired_rows(form, fixed)
    parts: _Parts = [(1, feedback(form, D))]
    if numbers is None:
        mixing = form.Q.inv()
        for group, (_, coefficients) in zip(groups, fixed, strict=True):
            roots = [symbols[i] for i in group.poles]
            for k in range(len(roots)):
                coefficients[k] = domain.one
                step = D - desired_rows(form, fixed)
                coefficients[k] = domain.zero
                parts.append((_coefficient(roots, k), mixing.matmul(step).matmul(form.T)))
    return parts


class _Writer:
    """Writes elements as a person would: factored, denominators by the conditions, of which they are products."""

    def __init__(self, letters: Letters, conditions: Sequence[Any]) -> None:
        self._letters = letters
        self._conditions = conditions
        self._sides: dict[Any, tuple[int, sp.Expr]] = {}

    def matrix(self, parts: _Parts) -> sp.Matrix:
        """Σ of each part times what stands before it."""
        import sympy as sp

        def entry(elements: Sequence[Any]) -> sp.Expr:
            pairs = zip(elements, parts, strict=True)
            return sp.Add(*(sp.Mul(self._factored(x), of) for x, (of, _) in pairs if x))

        rows = zip(*(matrix.to_list() for _, matrix in parts), strict=True)
        return sp.Matrix([[entry(elements) for elements in zip(*row, strict=True)] for row in rows])

    def _factored(self, element: Any) -> sp.Expr:
        import sympy as sp

        (above, first), (below, second) = (self._side(side) for side in (element.numer, element.denom))
        return sp.Mul(sp.Rational(above, below), first, 1 / second)

    def _side(self, polynomial: Any) -> tuple[int, sp.Expr]:
        """Its content and the rest, factored; what is long stays one factor, as finding others takes long."""
        import sympy as sp

        if polynomial in self._sides:
            return self._sides[polynomial]
        rest, powers = polynomial, list[tuple[Any, int]]()
        for factor in self._conditions:
            power = 0
            while (divided := rest.div(factor))[1] == 0:
                rest, power = divided[0], power + 1
            powers.append((factor, power))
        number, found = rest.factor_list() if len(rest) <= LONGEST_FACTORED else _monomial_out(rest)
        written = [self._letters.in_letters(f.as_expr()) ** power for f, power in (*powers, *found)]
        self._sides[polynomial] = int(number), sp.Mul(*written)
        return self._sides[polynomial]


def _monomial_out(polynomial: Any) -> tuple[int, list[tuple[Any, int]]]:
    """Content, common powers of the letters, and what is left."""
    content, rest = polynomial.primitive()
    common = [min(powers) for powers in zip(*rest, strict=True)]
    found = [(x, power) for x, power in zip(polynomial.ring.gens, common, strict=True) if power]
    for x, power in found:
        rest = rest.exquo(x**power)
    return content, [*found, (rest, 1)]


def _coefficient(roots: Sequence[sp.Symbol], k: int) -> sp.Expr:
    """The coefficient of s^k in Π (s − p), the product not multiplied out with anything else."""
    from itertools import combinations

    import sympy as sp

    count = len(roots) - k
    return sp.Add(*((-1) ** count * sp.Mul(*chosen) for chosen in combinations(roots, count)))


def _conditions(read: Entries, determinant: Any) -> list[Any]:
    """What must not be 0: the irreducible factors of all divisors, and of the determinant of the columns kept.

    Where the entries exist and det M ≠ 0, the columns kept are independent, and each column left out still depends on
    those kept before it: an identity of rational functions says so. So the indices are these; T and Q exist, and
    nothing else is divided by. Where det M = 0 the scan keeps other columns.
    """
    factors = (f for x in (*read.divisors, determinant.numer) for f, _ in x.factor_list()[1])
    return list(dict.fromkeys(factors))


def _told(factors: Sequence[Any], letters: Letters) -> tuple[sp.Expr, ...]:
    """Conditions as expressions, the short ones first, without those that no letters break."""
    found = dict.fromkeys(letters.condition(f) for f in factors if not letters.never_zero(f))
    return tuple(sorted(found, key=lambda e: (e.count_ops(), str(e))))


def _positive(symbols: Sequence[sp.Symbol]) -> Finding:
    names = ", ".join(map(str, symbols))
    return Finding("positive_letters", "info", f"What stands under a root is taken as positive: {names}.")


def _rows(matrix: Any, field: str) -> list[list[Any]]:
    """A matrix row by row, of whatever kind it is."""
    rows = matrix.tolist() if hasattr(matrix, "tolist") else matrix
    if _is_list(rows) and all(map(_is_list, rows)):
        return [list(row) for row in rows]
    raise InvalidInputError(
        f"{field} is no matrix", field=field, hint="Give it row by row: [[a, b], [c, d]]."
    )


def _is_list(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0


def _require_shapes(given: Mapping[str, list[list[Any]]]) -> int:
    for name, rows in given.items():
        if len({len(row) for row in rows}) > 1:
            raise InvalidInputError(
                f"the rows of {name} have {sorted({len(row) for row in rows})} entries",
                field=name,
                hint="Give a matrix row by row, all rows of the same length.",
            )
    n, width = len(given["A"]), len(given["A"][0])
    if n != width or n > MOST_STATES:
        raise InvalidInputError(
            f"A has the shape ({n}, {width})",
            field="A",
            hint=f"Give a square matrix, row by row, of at most {MOST_STATES} states.",
        )
    rows, inputs = len(given["B"]), len(given["B"][0])
    if rows != n or inputs > n:
        raise InvalidInputError(
            f"B has the shape ({rows}, {inputs})",
            field="B",
            hint=f"Give a row per state of A, {n} in all, and at most as many columns, one per input.",
        )
    return n


def _numbers(poles: Poles, n: int) -> Complexes | None:
    if isinstance(poles, str):
        if poles != "symbols":
            raise InvalidInputError(
                f"poles is {poles!r}",
                field="poles",
                value=poles,
                hint="Give numbers, or symbols for p_1 … p_n.",
            )
        return None
    try:
        found = np.asarray(list(poles), dtype=complex)
    except (TypeError, ValueError) as error:
        raise InvalidInputError(f"poles is no list of numbers: {error}", field="poles") from error
    if not np.all(np.isfinite(found)):
        raise InvalidInputError("poles holds a number that is not finite", field="poles")
    if found.shape != (n,):
        raise InvalidInputError(
            f"{found.size} poles given for {n} states",
            field="poles",
            value=found.size,
            hint=f"Give {n} poles, complex ones with their conjugates.",
        )
    return found


def _trees(rows: list[list[Any]], field: str) -> list[list[Node]]:
    from ..symbolic.entries import entry_named, tree_of
    from ..symbolic.grammar import parse

    found: list[list[Node]] = []
    for i, row in enumerate(rows):
        found.append([])
        for j, value in enumerate(row):
            with entry_named(field, i, j, value):
                found[-1].append(parse(value) if isinstance(value, str) else tree_of(value))
    return found


def _require_free(letters: Letters, poles: Sequence[sp.Symbol]) -> None:
    taken = sorted({str(p) for p in poles} & {str(symbol) for symbol in letters.symbols.values()})
    if taken:
        raise InvalidInputError(
            f"{taken[0]} is a letter of the matrices and the name of a desired pole",
            field="A",
            value=taken[0],
            hint="Call the letter otherwise, or give the poles as numbers.",
        )


def _require_inputs(B: DomainMatrix) -> None:
    for j, column in enumerate(zip(*B.to_list(), strict=True), 1):
        if not any(column):
            raise InvalidInputError(
                f"column {j} of B is zero: that input does nothing", field="B", hint="Leave that column out."
            )
    if B.rank() < B.shape[1]:
        raise InvalidInputError(
            "the columns of B are dependent, whatever the letters are",
            field="B",
            hint="Leave out inputs that others can replace.",
        )
