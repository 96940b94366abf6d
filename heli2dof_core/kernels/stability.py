"""Whether a loop is stable whatever the rounding of its numbers: Kharitonov's theorem with Routh's scheme.

All polynomials whose coefficients lie in given intervals are Hurwitz if and only if four of them are (Kharitonov,
Differentsial'nye Uravneniya 14 (1978) 2086); here the intervals are what rounding may have made of each coefficient.
Eigenvalues would not do: rounding moves a k-fold one by the k-th root of 1e-16.
"""

from __future__ import annotations

from . import examples
from .jit import copy_into, entry_point, keep_apart, kernel
from .layout import (
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    ROUNDING,
    TERMS,
    VALUE,
    WHOLE_CLOSED,
)
from .polynomials import determinant

# Rows of the scratch array, (17, 16), that are used here
TOTAL, SIZES, UPPER, LOWER = 0, 1, 2, 3


@entry_point(lambda: (examples.given(*POLYNOMIALS), examples.zeros(*POLYNOMIAL_WORKSPACE)))
def is_stable(f, p):
    """Whether every pole of the loop lies left of the imaginary axis, and not by rounding."""
    keep_apart()
    if len(f) == POLYNOMIALS[0]:
        determinant(f, p[TOTAL], p[SIZES])
    else:
        copy_into(f[WHOLE_CLOSED, VALUE], p[TOTAL])
        copy_into(f[WHOLE_CLOSED, TERMS], p[SIZES])
    return hurwitz(p[TOTAL], p[SIZES], p[UPPER], p[LOWER])


@kernel
def hurwitz(a, sizes, upper, lower):
    """Whether all roots of a, monic, lie left of the axis, its coefficients known to `ROUNDING` of their `sizes`.

    To these intervals comes a shift of the axis by `ROUNDING` of the scale, which changes aₖ by (k + 1) aₖ₊₁ of it.
    """
    degree = len(a) - 1
    while degree > 0 and a[degree] == 0.0:
        degree -= 1
    scale = 0.0
    for k in range(degree):
        scale = max(scale, (sizes[k] / a[degree]) ** (1.0 / (degree - k)))
    for kind in range(4):
        for k in range(degree + 1):
            width = 0.0
            if k < degree:
                width = ROUNDING * (sizes[k] + (k + 1) * scale * abs(a[k + 1]))
            # the signs go − − + +, each of the four beginning one place later
            coefficient = a[k] - width if (k + kind) % 4 < 2 else a[k] + width
            if not coefficient > 0.0:
                return False
            if (degree - k) % 2 == 0:
                upper[(degree - k) // 2] = coefficient
            else:
                lower[(degree - k) // 2] = coefficient
        if not routh(upper, lower, degree):
            return False
    return True


@kernel
def routh(upper, lower, degree):
    """Whether the scheme's first column is positive; its first two rows, highest power first, are used up."""
    long, short = degree // 2 + 1, (degree + 1) // 2
    for _ in range(degree - 1):
        if not lower[0] > 0.0:
            return False
        ratio = upper[0] / lower[0]
        for k in range(long - 1):
            upper[k] = upper[k + 1] - (ratio * lower[k + 1] if k + 1 < short else 0.0)
        long -= 1
        upper, lower, long, short = lower, upper, short, long
    return lower[0] > 0.0
