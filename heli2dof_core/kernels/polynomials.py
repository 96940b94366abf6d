"""Real polynomials as arrays of coefficients, lowest power first; and the loop as matrices of them.

With the angles q alone as unknowns, rig and law are 2×2 matrices of polynomials, D(s) q = B u and u = −N(s) q. A
column of both is multiplied by s where that axis' error is integrated and the integral drives a motor: an integrator
that drives nothing is no part of the loop and leaves no trace. The loop's polynomial is det M, M = D + B N, without
eigenvectors, so that repeated poles do no harm. Beside each sum stand the sizes of its terms: they tell what is
rounding (`ROUNDING`).
"""

from __future__ import annotations

from math import sqrt

from . import examples
from .jit import entry_point, general
from .layout import (
    POLYNOMIALS,
    ROUNDING,
)

# f, (2, 2, 20), holds for each entry the coefficients of M, N and D, B, and the sizes of the terms of M
M, N, D, B, SIZE = 0, 4, 8, 12, 16
TOLERANCE = 1e-15
"""Relative width at which a root counts as found."""
HALF = (0,) * 4
"""As long as the even, or odd, half of a polynomial of degree 6; `WHOLE_HALF` of degree 14 (`kernels.whole`)."""
WHOLE_HALF = (0,) * 8


@entry_point(lambda: (*examples.plant(), examples.given(2, 6), examples.zeros(*POLYNOMIALS)))
def polynomial_matrices(A, inputs, law, f):
    """The matrices of polynomials into f: A (4, 4), inputs (4, 2), law = ∂u/∂[x, z], (2, 6) or (2, 4)."""
    for j in range(2):
        integrates = law.shape[1] == 6 and (law[0, 4 + j] != 0.0 or law[1, 4 + j] != 0.0)
        shift = 1 if integrates else 0
        for i in range(2):
            for k in range(f.shape[2]):
                f[i, j, k] = 0.0
            f[i, j, B] = inputs[2 + i, j]
            f[i, j, N + shift], f[i, j, N + shift + 1] = -law[i, j], -law[i, 2 + j]
            f[i, j, D + shift], f[i, j, D + shift + 1] = -A[2 + i, j], -A[2 + i, 2 + j]
            f[i, j, D + shift + 2] = 1.0 if i == j else 0.0
            if integrates:
                f[i, j, N] = law[i, 4 + j]  # z = −q/s
    closed_loop_matrix(f, -1, f)


@general
def closed_loop_matrix(f, opened, g):
    """M = D + B N and the sizes of its terms, without the motor `opened`, into g, which may be f."""
    for i in range(2):
        for j in range(2):
            for k in range(4):
                total = f[i, j, D + k]
                size = abs(total)
                for motor in range(2):
                    if motor != opened:
                        term = f[i, motor, B] * f[motor, j, N + k]
                        total += term
                        size += abs(term)
                g[i, j, M + k], g[i, j, SIZE + k] = total, size


@general
def determinant(f, r, sizes):
    """Det M, of degree 6 at most, into r, and the sizes of its terms; what is rounding becomes 0.

    What rounding makes of a product is either factor by the rounding of the other.
    """
    for k in range(len(r)):
        total = size = 0.0
        for i in range(max(0, k - 3), min(k, 3) + 1):
            j = k - i
            a, b, c, d = f[0, 0, M + i], f[0, 1, M + i], f[1, 0, M + j], f[1, 1, M + j]
            total += a * d - b * c
            size += abs(a) * f[1, 1, SIZE + j] + f[0, 0, SIZE + i] * abs(d)
            size += abs(b) * f[1, 0, SIZE + j] + f[0, 1, SIZE + i] * abs(c)
        r[k] = total if abs(total) > ROUNDING * size else 0.0
        sizes[k] = size


@general
def even_and_odd_part(span, p, row, sizes, first):
    """p(jω) = E(ω²) + jω O(ω²): from row `first` of p on, the coefficients of E, O and the sizes of both.

    `span` is a tuple as long as a half: a loop over it is unrolled.
    """
    for k in range(2 * len(span)):
        sign = 1.0 if k % 4 < 2 else -1.0
        p[first + k % 2, k // 2] = sign * p[row, k]
        p[first + 2 + k % 2, k // 2] = p[sizes, k]


@general
def on_imaginary_axis(span, p, first, x):
    """p(jω) from its halves, x = ω²."""
    top = len(span) - 1
    return complex(horner(p[first], top, x), sqrt(x) * horner(p[first + 1], top, x))


@general
def add_product(span, p, sizes_p, q, sizes_q, factor, shift, r, sizes):
    """R += factor xˢʰⁱᶠᵗ p q; `sizes` gathers what the rounding of either makes of each coefficient."""
    for i in range(len(span)):
        own = sizes_p[i]
        if own != 0.0:
            for j in range(len(span)):
                other = sizes_q[j]
                if other != 0.0:
                    r[i + j + shift] += factor * p[i] * q[j]
                    sizes[i + j + shift] += abs(factor) * (abs(p[i]) * other + own * abs(q[j]))


@general
def drop_rounding(r, sizes):
    """Coefficients that are nothing but rounding become 0, so that no root comes of them."""
    for k in range(len(r)):
        if abs(r[k]) <= ROUNDING * sizes[k]:
            r[k] = 0.0


@general
def horner(p, degree, x):
    """p(x) by Horner's scheme."""
    total = p[degree]
    for k in range(degree - 1, -1, -1):
        total = total * x + p[k]
    return total


@general
def positive_roots(p, sizes, chain, roots, before):
    """All x > 0 where p changes its sign, in order, into `roots`, then those where it may touch 0; both numbers.

    Between two neighbouring roots of its derivative a polynomial is monotonic, so a change of sign there
    holds exactly one root: found so for the derivatives in turn, none can be missed. The first of them is the lowest
    whose coefficients change their sign once at most, since by Descartes' rule it has no more positive roots than
    that. It may touch 0 where an extremum is nothing but rounding, as `sizes` tell it; where its own coefficients
    change their sign once, it has one simple root and touches nowhere. Scratch: `chain` and `before`, as long as p.
    """
    bottom, top, first = to_be_searched(p)
    if first < 0:
        return 0, 0
    # Cauchy's bounds; a root of a derivative that lies outside separates nothing
    largest = smallest = 0.0
    for k in range(bottom, top + 1):
        if k < top:
            largest = max(largest, abs(p[k] / p[top]))
        if k > bottom:
            smallest = max(smallest, abs(p[k] / p[bottom]))
    low, high = 1.0 / (1.0 + smallest), 1.0 + largest
    return roots_within(p, sizes, low, high, top, first, chain, roots, before)


@general
def far_roots(p, sizes, chain, roots, before):
    """The same for degrees at which Cauchy's bounds would overflow; those are Fujiwara's, Tohoku 10 (1916) 167."""
    bottom, top, first = to_be_searched(p)
    if first < 0:
        return 0, 0
    largest = smallest = 0.0
    for k in range(bottom, top + 1):
        if k < top and p[k] != 0.0:
            largest = max(largest, abs(p[k] / p[top]) ** (1.0 / (top - k)))
        if k > bottom and p[k] != 0.0:
            smallest = max(smallest, abs(p[k] / p[bottom]) ** (1.0 / (k - bottom)))
    return roots_within(p, sizes, 0.5 / smallest, 2.0 * largest, top, first, chain, roots, before)


@general
def to_be_searched(p):
    """The lowest and the highest power in p, and how often to derive it until its signs change once at most.

    The last is below 0 where no sign changes, and no root is positive.
    """
    top = len(p) - 1
    while top > 0 and p[top] == 0.0:
        top -= 1
    bottom = 0
    while bottom < top and p[bottom] == 0.0:
        bottom += 1
    first, changes, sign = top, 0, p[top]
    while first > 0:
        if p[first - 1] * sign < 0.0:
            if changes == 1:
                break
            changes, sign = 1, p[first - 1]
        first -= 1
    return bottom, top, first if changes else -1


@general
def roots_within(p, sizes, low, high, top, first, chain, roots, before):
    """The roots of `positive_roots` between two bounds, beginning with the derivative of order `first`."""
    found = extrema = 0
    for order in range(first, -1, -1):
        degree = top - order
        for k in range(degree + 1):
            weight = 1.0
            for j in range(order):
                weight *= (k + order - j) / top  # only the ratios matter: this keeps them small
            chain[k] = weight * p[k + order]
        for i in range(found):
            before[i] = roots[i]
        extrema = found
        count, left, sign = 0, low, horner(chain, degree, low)
        for i in range(extrema + 1):
            right = before[i] if i < extrema else high
            following = horner(chain, degree, right)
            if (sign < 0.0) != (following < 0.0):
                roots[count] = root_between(chain, degree, left, right, sign)
                count += 1
            left, sign = right, following
        found = count
    touched = 0
    for i in range(extrema):
        settled = abs(horner(p, top, before[i])) <= ROUNDING * horner(sizes, top, before[i])
        if settled and found + touched < len(roots):
            roots[found + touched] = before[i]
            touched += 1
    return found, touched


@general
def root_between(p, degree, low, high, at_low):
    """The root between two positive x where p changes its sign: Laguerre's steps, halved by ratio where they leave.

    It is found where p is nothing but rounding of its terms. Source of the step, which converges from afar: Press et
    al., Numerical Recipes, 3rd ed. (2007), 9.5.
    """
    x = sqrt(low * high)
    for _ in range(200):
        y, slope, bend = p[degree], 0.0, 0.0
        size = abs(y)
        for k in range(degree - 1, -1, -1):
            a = p[k]
            bend = bend * x + slope  # half the second derivative
            slope = slope * x + y
            y = y * x + a
            size = size * x + abs(a)
        if (y < 0.0) == (at_low < 0.0):
            low = x
        else:
            high = x
        following = x
        if y != 0.0:
            g = slope / y
            square = (degree - 1) * ((degree - 1) * g * g - 2.0 * degree * bend / y)
            spread = sqrt(square) if square > 0.0 else 0.0
            below = g + spread if g > 0.0 else g - spread
            if below != 0.0:
                following = x - degree / below
        if abs(y) <= ROUNDING * size or high - low <= TOLERANCE * high:
            return min(max(following, low), high)
        x = following if low < following < high else sqrt(low * high)
    return x
