"""Matrices of floats over the rational numbers, where nothing is rounded: a float is a fraction."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from math import frexp, lcm, ldexp
from operator import mul
from typing import TYPE_CHECKING, Any

import numpy as np

from ..signals import Complexes, Floats

if TYPE_CHECKING:  # SymPy is imported on the first use
    from sympy.polys.matrices import DomainMatrix

PRECISION = 120
"""Bits with which roots are looked for at least; doubled where they lie too close for that."""
BITS_PER_ROOT = 40
"""Bits per root: where n of them coincide but for an error ε of the coefficients, they are told to ε^(1/n) only."""
MOST_PRECISION = 1920
NOWHERE: Complexes = np.zeros(0, dtype=np.complex128)


def exact_matrix(matrix: Floats) -> DomainMatrix:
    """The same numbers as fractions."""
    from sympy import QQ
    from sympy.polys.matrices import DomainMatrix

    entries = [[QQ(*x.as_integer_ratio()) for x in row] for row in matrix.tolist()]
    return DomainMatrix(entries, matrix.shape, QQ)


def float_matrix(matrix: DomainMatrix) -> Floats:
    """The nearest floats."""
    rows: Iterable[Iterable[Any]] = matrix.to_list()
    return np.array([[float(Fraction(int(x.numerator), int(x.denominator))) for x in row] for row in rows])


Whole = list[list[int]]


def whole_matrix(matrix: DomainMatrix) -> tuple[Whole, int]:
    """The same over one denominator: whole numbers, and what they are divided by."""
    rows: list[list[Any]] = matrix.to_list()
    below = lcm(*(int(x.denominator) for row in rows for x in row))
    return [[int(x.numerator) * (below // int(x.denominator)) for x in row] for row in rows], below


def whole_product(left: Whole, right: Whole) -> Whole:
    """Of two matrices of whole numbers."""
    columns = [*zip(*right, strict=True)]
    return [[sum(map(mul, row, column)) for column in columns] for row in left]


def exact_fraction(number: float) -> Any:
    """The same number as a fraction."""
    from sympy import QQ

    return QQ(*float(number).as_integer_ratio())


def decimal_fraction(number: float) -> Any:
    """The shortest decimal number that is read as this float, as a fraction: 0.1 is 1/10."""
    from sympy import QQ

    written = Fraction(repr(float(number)))
    return QQ(written.numerator, written.denominator)


def exact_coefficients(
    poles: Iterable[complex], fraction: Callable[[float], Any] = exact_fraction
) -> list[Any]:
    """d₀ … of Π (s − p), exactly, the leading 1 left out; complex poles count once per pair."""
    from sympy import QQ

    polynomial = [QQ.one]
    for p in poles:
        if p.imag < 0:
            continue
        re, im = (fraction(part) for part in (p.real, p.imag))
        factor = [re * re + im * im, -2 * re, QQ.one] if p.imag else [-re, QQ.one]
        product = [QQ.zero] * (len(polynomial) + len(factor) - 1)
        for i, a in enumerate(polynomial):
            for j, b in enumerate(factor):
                product[i + j] += a * b
        polynomial = product
    return polynomial[:-1]


def exact_closed_loop(A: Floats, B: Floats, K: Floats) -> DomainMatrix:
    """A − BK without rounding, n×n."""
    return exact_matrix(A) - exact_matrix(B).matmul(exact_matrix(K))


def exact_eigenvalues(matrix: DomainMatrix, near: Complexes) -> list[Any]:
    """All eigenvalues as mpmath's numbers of `PRECISION` bits, each as often as it occurs.

    They are the roots of the characteristic polynomial, which is exact and split by multiplicity first
    (square-free factors), so that every root looked for is a simple one.

    Args:
        matrix: n×n, over the rational numbers.
        near: n guesses; their quality decides the time alone.

    Raises:
        ArithmeticError: roots lie too close for `MOST_PRECISION` bits.
    """
    return roots(_characteristic_polynomial(matrix), near)


def _characteristic_polynomial(matrix: DomainMatrix) -> list[Any]:
    """Of a square matrix, highest power first, by the method of Faddeev and Le Verrier in whole numbers.

    On four rows it takes a third of the time of one that is good for hundreds.
    """
    from sympy import QQ

    (own, unit), n = whole_matrix(matrix), matrix.shape[0]
    found, power = [QQ.one], 1
    product = [[0] * n for _ in range(n)]
    trace = 1  # of the coefficient before
    for k in range(1, n + 1):
        for i in range(n):
            product[i][i] += trace
        product = whole_product(own, product)
        trace, power = -sum(product[i][i] for i in range(n)) // k, power * unit
        found.append(QQ(trace, power))
    return found


def roots(polynomial: Sequence[Any], near: Complexes = NOWHERE) -> list[Any]:
    """The roots of a polynomial with rational coefficients, highest first; else as `exact_eigenvalues`."""
    from sympy import QQ
    from sympy.polys.sqfreetools import dup_sqf_list

    found: list[Any] = []
    factors = [(list(polynomial), 1)]
    if not _has_simple_roots(polynomial):
        factors = dup_sqf_list(list(polynomial), QQ)[1]
    for factor, multiplicity in factors:
        found += [root for root in _simple_roots(factor, near) for _ in range(multiplicity)]
    return found


def _has_simple_roots(polynomial: Sequence[Any]) -> bool:
    """Whether all roots surely are: the polynomial and its derivative have no common root even modulo a prime."""
    try:
        own = [int(c.numerator) * pow(int(c.denominator), -1, _PRIME) % _PRIME for c in polynomial]
    except ValueError:  # a denominator is a multiple of it
        return False
    if len(own) < 2 or own[0] == 0:
        return False
    n = len(own) - 1
    other = [c * (n - k) % _PRIME for k, c in enumerate(own[:-1])]
    while len(other) > 1:
        inverse, rest = pow(other[0], -1, _PRIME), own
        while len(rest) >= len(other):
            factor = rest[0] * inverse % _PRIME
            head = [(c - factor * d) % _PRIME for c, d in zip(rest, other, strict=False)]
            rest = [*head, *rest[len(other) :]][1:]
        while rest and rest[0] == 0:
            rest = rest[1:]
        if not rest:
            return False
        own, other = other, rest
    return True


_PRIME = 2**61 - 1


def _simple_roots(coefficients: Sequence[Any], near: Complexes) -> list[Any]:
    from mpmath import mp, mpf
    from mpmath.libmp import NoConvergence

    degree = len(coefficients) - 1
    precision = max(PRECISION, BITS_PER_ROOT * degree)
    if len(near) == degree and near.any():
        size = float(np.max(np.abs(near)))
        apart = 1e-9 * size * np.exp(1j * (1.0 + np.arange(degree)))  # equal guesses would stay equal
        found = _refined(coefficients, (near + apart).tolist(), precision)
        if found is not None:
            return found
    while precision <= MOST_PRECISION:
        with mp.workprec(2 * precision):
            polynomial = [mpf(int(c.numerator)) / int(c.denominator) for c in coefficients]
        with mp.workprec(precision):
            try:
                return list(mp.polyroots(polynomial, maxsteps=100, extraprec=precision))
            except NoConvergence:
                precision *= 2
    raise ArithmeticError("the poles lie too close together to be told apart")


def _refined(coefficients: Sequence[Any], guesses: list[complex], precision: int) -> list[Any] | None:
    """All roots to `precision` bits of the largest, from guesses; None where these do not lead there.

    By the iteration of Ehrlich and Aberth (Aberth, Math. Comp. 27 (1973) 339), which triples the digits of simple
    roots in each round, in whole numbers, each a multiple of a small power of two: tens of times as fast as numbers
    that carry their exponents.
    """
    from mpmath import mpc, mpf

    exponent, bits = frexp(max(map(abs, guesses)))[1], 2 * precision
    scaled, points = [], []
    for k, coefficient in enumerate(coefficients):
        share, shift = coefficient / coefficients[0], bits - exponent * k
        above, below = int(share.numerator), int(share.denominator)
        scaled.append((above << shift) // below if shift >= 0 else above // (below << -shift))
    for p in guesses:
        re, im = (int(ldexp(part, 60 - exponent)) for part in (p.real, p.imag))
        points.append((re << bits - 60, im << bits - 60))
    for _ in range(_MOST_ROUNDS):
        settled = True
        for i, (x, y) in enumerate(points):
            try:
                re, im = _aberth_step(scaled, points, i, bits)
            except ZeroDivisionError:  # two guesses have met, or one lies where the slope is 0
                return None
            points[i] = (x - re, y - im)
            step, own = max(abs(re), abs(im)), max(abs(x), abs(y))
            settled = settled and step >> precision == 0 and step <= own >> precision // 2
        if settled:
            tiny = 1 << precision  # what is left of a part that is 0
            parts = [[0 if abs(v) < tiny else v for v in point] for point in points]
            parts.sort(key=lambda point: (abs(point[1]), point[0]))
            return [mpc(*(mpf((v, exponent - bits)) for v in point)) for point in parts]
    return None


_MOST_ROUNDS = 30


def _aberth_step(scaled: list[int], points: list[tuple[int, int]], i: int, bits: int) -> tuple[int, int]:
    """How far a guess is from its root: Newton's step, corrected for the other roots."""
    x, y = points[i]
    a, b, c, d = scaled[0], 0, 0, 0  # the polynomial and its derivative there
    for coefficient in scaled[1:]:
        c, d = (c * x - d * y >> bits) + a, (c * y + d * x >> bits) + b
        a, b = (a * x - b * y >> bits) + coefficient, a * y + b * x >> bits
    if a == 0 and b == 0:
        return 0, 0
    re = im = 0
    for j, (u, v) in enumerate(points):
        if j != i:
            p, q = x - u, y - v
            size = p * p + q * q
            re += (p << 2 * bits) // size
            im -= (q << 2 * bits) // size
    # p / (p′ − p Σ)
    e, f = c - (a * re - b * im >> bits), d - (a * im + b * re >> bits)
    size = e * e + f * f
    return ((a * e + b * f) << bits) // size, ((b * e - a * f) << bits) // size


def exact_eigenvectors(matrix: DomainMatrix, values: Sequence[Any]) -> Complexes | None:
    """Eigenvectors of length 1 as columns, for eigenvalues as `exact_eigenvalues` finds them.

    By one step of inverse iteration, whose shift misses the eigenvalue in the last of `PRECISION` bits; four times as
    many are computed with, which leaves room for units far apart. None where an eigenvalue occurs more than once: of
    such ones a matrix may have too few.
    """
    from mpmath import mp

    n = len(values)
    if len({complex(v) for v in values}) < n and len(set(values)) < n:
        return None
    columns = []
    with mp.workprec(4 * PRECISION):
        rows = [[mp.mpf(int(x.numerator)) / int(x.denominator) for x in row] for row in matrix.to_list()]
        size = max((abs(x) for row in rows for x in row), default=mp.mpf(1)) or mp.mpf(1)
        start = mp.matrix([mp.mpf(1) + mp.mpf(i) / (3 * n) for i in range(n)])
        for value in values:
            shifted = mp.matrix(rows)
            for i in range(n):
                shifted[i, i] -= value + size * mp.mpf(2) ** -PRECISION
            vector = mp.lu_solve(shifted, start)
            columns.append([complex(x / mp.norm(vector)) for x in vector])
    return np.array(columns).T
