"""Real polynomials as arrays of coefficients, lowest power first."""

from __future__ import annotations

from math import sqrt

from .jit import kernel

TOLERANCE = 1e-15
"""Relative width at which a root counts as found."""
ROUNDING = 1e-13
"""A sum below this share of its terms' sizes counts as 0."""


@kernel
def add_product(p, q, factor, shift, r, sizes):
    """R += factor xˢʰⁱᶠᵗ p q; r must be long enough. `sizes` gathers the sizes of what is added."""
    for i in range(len(p)):
        if p[i] != 0.0:
            for j in range(len(q)):
                if q[j] != 0.0:
                    term = factor * p[i] * q[j]
                    r[i + j + shift] += term
                    sizes[i + j + shift] += abs(term)


@kernel
def drop_rounding(r, sizes):
    """Coefficients that are nothing but rounding become 0, so that no root comes of them."""
    for k in range(len(r)):
        if abs(r[k]) <= ROUNDING * sizes[k]:
            r[k] = 0.0


@kernel
def determinant(f, first, r):
    """Det of a 2×2 matrix of polynomials of degree 3, whose coefficients stand from `first` on."""
    for k in range(len(r)):
        total = size = 0.0
        for i in range(max(0, k - 3), min(k, 3) + 1):
            straight = f[0, 0, first + i] * f[1, 1, first + k - i]
            crosswise = f[0, 1, first + i] * f[1, 0, first + k - i]
            total += straight - crosswise
            size += abs(straight) + abs(crosswise)
        r[k] = total if abs(total) > ROUNDING * size else 0.0


@kernel
def value(p, degree, x):
    """p(x) by Horner's scheme."""
    total = p[degree]
    for k in range(degree - 1, -1, -1):
        total = total * x + p[k]
    return total


@kernel
def positive_roots(p, chain, roots, before):
    """All simple roots x > 0 of p, in order, into `roots`; their number.

    Between two neighbouring roots of its derivative a polynomial is monotonic, so a change of sign there
    holds exactly one root: found so for all derivatives in turn, none can be missed. Scratch: `chain`
    and `before`, as long as p.
    """
    top = len(p) - 1
    while top > 0 and p[top] == 0.0:
        top -= 1
    bottom = 0
    while bottom < top and p[bottom] == 0.0:
        bottom += 1
    if bottom == top:
        return 0
    # Cauchy's bounds; a root of a derivative that lies outside separates nothing
    largest = smallest = 0.0
    for k in range(bottom, top + 1):
        if k < top:
            largest = max(largest, abs(p[k] / p[top]))
        if k > bottom:
            smallest = max(smallest, abs(p[k] / p[bottom]))
    low, high = 1.0 / (1.0 + smallest), 1.0 + largest
    found = 0
    for order in range(top - 1, -1, -1):
        degree = top - order
        for k in range(degree + 1):
            weight = 1.0
            for j in range(order):
                weight *= (k + order - j) / top  # only the ratios matter: this keeps them small
            chain[k] = weight * p[k + order]
        for i in range(found):
            before[i] = roots[i]
        count, left, sign = 0, low, value(chain, degree, low)
        for i in range(found + 1):
            right = before[i] if i < found else high
            following = value(chain, degree, right)
            if (sign < 0.0) != (following < 0.0):
                roots[count] = root_between(chain, degree, left, right, sign)
                count += 1
            left, sign = right, following
        found = count
    return found


@kernel
def root_between(p, degree, low, high, at_low):
    """The root between two positive x where p changes its sign: Newton's steps, halved by ratio where they leave."""
    x = sqrt(low * high)
    for _ in range(200):
        y, slope = p[degree], 0.0
        for k in range(degree - 1, -1, -1):
            slope = slope * x + y
            y = y * x + p[k]
        if (y < 0.0) == (at_low < 0.0):
            low = x
        else:
            high = x
        following = x - y / slope if slope != 0.0 else low
        if not low < following < high:
            following = sqrt(low * high)
        if abs(following - x) <= TOLERANCE * x or high - low <= TOLERANCE * high:
            return following
        x = following
    return x
