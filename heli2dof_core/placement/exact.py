"""Matrices of floats over the rational numbers, where nothing is rounded: a float is a fraction."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
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

    entries = [[exact_fraction(x) for x in row] for row in matrix]
    return DomainMatrix(entries, matrix.shape, QQ)


def float_matrix(matrix: DomainMatrix) -> Floats:
    """The nearest floats."""
    rows: Iterable[Iterable[Any]] = matrix.to_list()
    return np.array([[float(Fraction(int(x.numerator), int(x.denominator))) for x in row] for row in rows])


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
    return roots(matrix.charpoly(), near)


def roots(polynomial: Sequence[Any], near: Complexes = NOWHERE) -> list[Any]:
    """The roots of a polynomial with rational coefficients, highest first; else as `exact_eigenvalues`."""
    from sympy import QQ
    from sympy.polys.sqfreetools import dup_sqf_list

    found: list[Any] = []
    for factor, multiplicity in dup_sqf_list(list(polynomial), QQ)[1]:
        found += [root for root in _simple_roots(factor, near) for _ in range(multiplicity)]
    return found


def _simple_roots(coefficients: Sequence[Any], near: Complexes) -> list[Any]:
    from mpmath import mp, mpc, mpf
    from mpmath.libmp import NoConvergence

    degree = len(coefficients) - 1
    precision = max(PRECISION, BITS_PER_ROOT * degree)
    size = float(np.max(np.abs(near), initial=0.0)) or 1.0
    apart = 1e-9 * size * np.exp(1j * (1.0 + np.arange(degree)))  # equal guesses would stay equal
    start = near[:degree] + apart if len(near) == degree else None
    while precision <= MOST_PRECISION:
        with mp.workprec(2 * precision):
            polynomial = [mpf(int(c.numerator)) / int(c.denominator) for c in coefficients]
        with mp.workprec(precision):
            guesses = None if start is None else [mpc(complex(p)) for p in start]
            try:
                return list(mp.polyroots(polynomial, maxsteps=100, extraprec=precision, roots_init=guesses))
            except NoConvergence:
                precision *= 2
                start = None
    raise ArithmeticError("the poles lie too close together to be told apart")


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
