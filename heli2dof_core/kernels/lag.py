"""How slow both rotors may be alike: the least τ at which a loop is no longer stable.

With the same time constant τ the loop's polynomial is d(s, τ) = d₀ + τ s d₁ + τ² s² d₂, made of polynomials of s: of
det M, of what M and D have mixed, and of det D. At s = jω both its real and its imaginary part are quadratics in τ.
They have a root in common where their resultant is 0, which is a polynomial of ω²: there is no grid, so none can be
missed. No pole passes 0, as d(0, τ) does not depend on τ.
"""

from __future__ import annotations

from cmath import sqrt as complex_sqrt
from math import inf, log2, sqrt

from . import examples
from .jit import entry_point, general, keep_apart
from .layout import LAG_WORKSPACE, POLYNOMIALS, ROUNDING, TERMS, VALUE, WHOLE_LAG
from .polynomials import (
    SIZE,
    WHOLE_HALF,
    D,
    M,
    add_product,
    drop_rounding,
    even_and_odd_part,
    far_roots,
    on_imaginary_axis,
)
from .stability import hurwitz

# Rows of the scratch array p, (29, 32): d₀, d₁, d₂ with their sizes; even and odd halves of each with theirs; three
# products of halves with theirs; and rows for the search, which stability uses as well
PARTS, PART_SIZES, HALVES, PRODUCTS, SOUGHT, SIZES, CHAIN, BEFORE, ROOTS = 0, 3, 6, 18, 24, 25, 26, 27, 28
WIDE = (0,) * 16
ALIKE = 10.0 * ROUNDING
"""Two τ at one frequency that differ by a root of this, as a share, are one: as of two axes with the same poles."""
NEAR, FOUND, ENOUGH = 1e-2, 1e-9, 1e-12
"""How near a real number τ is where a search begins, what counts as one, and where the search ends, as shares of τ.
Below the last, secants would follow rounding."""


@entry_point(lambda: (examples.given(*POLYNOMIALS), 0.0, examples.zeros(*LAG_WORKSPACE)))
def lag_margin(f, start, p):
    """The least τ from `start` on, s, at which the loop is not stable; inf where there is none.

    f is the loop's, of either kind (`layout.POLYNOMIALS`, `layout.WHOLE_POLYNOMIALS`); its own time constants do not
    count. Scratch: p.
    """
    keep_apart()
    parts_of(f, p)
    if not stable_at(p, start):
        return start
    degree = 15
    while degree > 0 and p[SOUGHT, degree] == 0.0:
        degree -= 1
    # all of one size by a change of the unit of time, to a power of 2
    unit = 2.0 ** round(log2(p[SOUGHT, 0] / p[SOUGHT, degree]) / degree)
    factor = 1.0 / p[SOUGHT, 0]
    for k in range(16):
        for row in range(PARTS, HALVES):
            p[row, k] *= factor
        factor *= unit
    start *= unit
    best = inf
    resultant(p)
    found, touched = far_roots(p[SOUGHT], p[SIZES], p[CHAIN], p[ROOTS], p[BEFORE])
    for k in range(found + touched):
        w = sqrt(p[ROOTS, k])
        for one in lags(p, w):
            if one.real > 0.0 and abs(one.imag) <= NEAR * one.real:
                lag = real_lag(p, w, one)
                if start < lag < best:
                    best = lag
    return best / unit


@general
def parts_of(f, p):
    """D₀, d₁ and d₂ with their sizes."""
    for row in range(HALVES):
        for k in range(p.shape[1]):
            p[row, k] = 0.0
    if len(f) != POLYNOMIALS[0]:
        for part in range(3):
            for k in range(f.shape[2]):
                p[PARTS + part, k] = f[WHOLE_LAG + part, VALUE, k]
                p[PART_SIZES + part, k] = f[WHOLE_LAG + part, TERMS, k]
        return
    for part in range(3):
        for kind in range(1 if part != 1 else 2):
            one = D if part == 2 or kind == 1 else M
            other = M if part == 0 or kind == 1 else D
            for i in range(4):
                for j in range(4):
                    for c in range(2):
                        add_term(f, one, other, c, i, j, p, part)
        drop_rounding(p[PARTS + part], p[PART_SIZES + part])


@general
def add_term(f, one, other, c, i, j, p, part):
    """What two coefficients have in a determinant whose first row is of one matrix, its second of the other."""
    a, b = f[0, c, one + i], f[1, 1 - c, other + j]
    size_a = f[0, c, SIZE + i] if one == M else abs(a)
    size_b = f[1, 1 - c, SIZE + j] if other == M else abs(b)
    p[PARTS + part, i + j] += a * b if c == 0 else -a * b
    p[PART_SIZES + part, i + j] += abs(a) * size_b + size_a * abs(b)


@general
def stable_at(p, tau):
    """Whether d(s, τ) is stable; its coefficients stay in the row SOUGHT."""
    for k in range(p.shape[1]):
        total = size = 0.0
        factor = 1.0
        for part in range(3):
            if k >= part:
                total += factor * p[PARTS + part, k - part]
                size += factor * p[PART_SIZES + part, k - part]
            factor *= tau
        p[SOUGHT, k] = total if abs(total) > ROUNDING * size else 0.0
        p[SIZES, k] = size
    return hurwitz(p[SOUGHT], p[SIZES], p[CHAIN], p[BEFORE])


@general
def resultant(p):
    """Of Re d(jω, τ) and Im d(jω, τ) by τ, a polynomial of x = ω²: x g² − h₀₁ h₁₂.

    With dₖ(jω) = Eₖ + jω Oₖ, g = E₀ O₂ − E₂ O₀ and h_kl = E_k E_l + x O_k O_l.
    """
    for row in range(PRODUCTS, ROOTS):
        for k in range(p.shape[1]):
            p[row, k] = 0.0
    for part in range(3):
        even_and_odd_part(WHOLE_HALF, p, PARTS + part, PART_SIZES + part, HALVES + 4 * part)
    g, first, second = PRODUCTS, PRODUCTS + 2, PRODUCTS + 4
    zero, one, two = HALVES, HALVES + 4, HALVES + 8
    add_halves(p, zero, two + 1, 1.0, 0, g)
    add_halves(p, zero + 1, two, -1.0, 0, g)
    add_halves(p, zero, one, 1.0, 0, first)
    add_halves(p, zero + 1, one + 1, 1.0, 1, first)
    add_halves(p, one, two, 1.0, 0, second)
    add_halves(p, one + 1, two + 1, 1.0, 1, second)
    r, sizes = p[SOUGHT], p[SIZES]
    add_product(WIDE, p[g], p[g + 1], p[g], p[g + 1], 1.0, 1, r, sizes)
    add_product(WIDE, p[first], p[first + 1], p[second], p[second + 1], -1.0, 0, r, sizes)
    drop_rounding(r, sizes)


@general
def add_halves(p, one, other, factor, shift, row):
    """Adds a product of two halves, by their rows, to that in `row`."""
    add_product(WHOLE_HALF, p[one], p[one + 2], p[other], p[other + 2], factor, shift, p[row], p[row + 1])


@general
def lags(p, w):
    """Both τ, complex, with d(jω, τ) = 0."""
    x = w * w
    a = on_imaginary_axis(WHOLE_HALF, p, HALVES, x)
    b = on_imaginary_axis(WHOLE_HALF, p, HALVES + 4, x) * complex(0.0, w)
    c = on_imaginary_axis(WHOLE_HALF, p, HALVES + 8, x) * -x
    square, product = b * b, 4.0 * a * c
    under = square - product
    root = complex_sqrt(under) if abs(under) > ALIKE * (abs(square) + abs(product)) else complex(0.0, 0.0)
    if b.real * root.real + b.imag * root.imag < 0.0:
        root = -root
    q = -0.5 * (b + root)
    return quotient(q, c), quotient(a, q)


@general
def quotient(a, b):
    """A/b; 0 where b is, which is no τ that counts."""
    size = b.real * b.real + b.imag * b.imag
    return a * b.conjugate() * (1.0 / size) if size > 0.0 else complex(0.0, 0.0)


@general
def real_lag(p, w, lag):
    """The real τ near `lag` by secants on its imaginary part over ω; 0 where it has none."""
    step, best = 1e-6 * w, lag
    for _ in range(40):
        if abs(best.imag) <= ENOUGH * best.real:
            break
        one, other = lags(p, w + step)
        following = one if abs(one - lag) < abs(other - lag) else other
        slope = (following.imag - lag.imag) / step
        w, lag = w + step, following
        if abs(lag.imag) < abs(best.imag):
            best = lag
        if slope == 0.0:
            break
        step = -lag.imag / slope
        if abs(step) <= ROUNDING * w:
            break
        step = min(max(step, -0.1 * w), 0.1 * w)
    return best.real if abs(best.imag) <= FOUND * best.real else 0.0
