"""What the loop bears at both motors at once, over frequency: sensitivity peak and disk margin.

S(jω) = I − N M⁻¹ B (see `polynomials`) is a sum of fractions with the loop's poles, so that nothing about it changes
faster than with the distance from the nearest pole. Steps of a share of that distance, from ω = 0 on, therefore see
every maximum; each that may be the largest is then refined. Infinity, where S = I, is the last of the frequencies.
"""

from __future__ import annotations

from math import inf, sqrt

from . import examples
from .jit import entry_point, keep_apart, kernel
from .layout import (
    DISK_FREQUENCY,
    DISK_MARGIN,
    FREQUENCIES,
    PEAK_FREQUENCY,
    POLYNOMIALS,
    ROUNDING,
    SENSITIVITY,
    SENSITIVITY_PEAK,
    VALUE,
    WHOLE_ACROSS,
    WHOLE_CLOSED,
    WHOLE_OPENED,
)
from .polynomials import WHOLE_HALF, B, M, N

GOLDEN = (sqrt(5.0) - 1.0) / 2.0
STEP = 0.3
"""Of the distance from the nearest pole."""
WHOLE_STEP = STEP * 6 / 14
"""The same where the denominator has degree 14."""
REACH = 30.0
"""Times the fastest pole: beyond, S differs from I by the first terms of a series in 1/ω alone."""
WITHIN = 0.6
"""Least share of the largest value on the grid that a maximum must have there to be refined: between two frequencies
the size of S, whose denominator has degree 6 (or 14), cannot grow by as much as this allows."""
PRECISION = 1e-6
"""Of a maximum's place, as a share of its two steps; its height is then known to the square of that."""
ANGLES, DISKS = 1, 2  # rows of the grid, beside the frequencies


@kernel
def polynomial_entry(f, i, j, first, w, x):
    """An entry of M or N at s = jω, x = ω²."""
    return complex(f[i, j, first] - x * f[i, j, first + 2], w * (f[i, j, first + 1] - x * f[i, j, first + 3]))


@kernel
def value_at(f, row, w):
    """A polynomial of `kernels.whole` at s = jω."""
    even = odd = 0.0
    for k in range(len(WHOLE_HALF) - 1, -1, -1):
        even = f[row, VALUE, 2 * k] - w * w * even
        odd = f[row, VALUE, 2 * k + 1] - w * w * odd
    return complex(even, w * odd)


@kernel
def whole_sensitivity(f, w):
    """The same of a loop as `kernels.whole` makes it."""
    det = value_at(f, WHOLE_CLOSED, w)
    scale = 1.0 / (abs(det.real) + abs(det.imag))  # powers of ω are large, and squares of them larger
    det = det * scale
    by = det.conjugate() * (scale / squared(det))
    a, d = value_at(f, WHOLE_OPENED, w) * by, value_at(f, WHOLE_OPENED + 1, w) * by
    return a, value_at(f, WHOLE_ACROSS, w) * by, value_at(f, WHOLE_ACROSS + 1, w) * by, d


@kernel
def sensitivity(f, w):
    """The four entries of S(jω), row by row; the loop has no pole at jω."""
    if len(f) != POLYNOMIALS[0]:
        return whole_sensitivity(f, w)
    x = w * w
    m00, m01 = polynomial_entry(f, 0, 0, M, w, x), polynomial_entry(f, 0, 1, M, w, x)
    m10, m11 = polynomial_entry(f, 1, 0, M, w, x), polynomial_entry(f, 1, 1, M, w, x)
    det = m00 * m11 - m01 * m10
    by = det.conjugate() * (1.0 / squared(det))  # a complex quotient raises at 0 even where compiled
    x00, x01 = m11 * f[0, 0, B] - m01 * f[1, 0, B], m11 * f[0, 1, B] - m01 * f[1, 1, B]
    x10, x11 = m00 * f[1, 0, B] - m10 * f[0, 0, B], m00 * f[1, 1, B] - m10 * f[0, 1, B]
    n00, n01 = polynomial_entry(f, 0, 0, N, w, x), polynomial_entry(f, 0, 1, N, w, x)
    n10, n11 = polynomial_entry(f, 1, 0, N, w, x), polynomial_entry(f, 1, 1, N, w, x)
    return (
        1.0 - (n00 * x00 + n01 * x10) * by,
        -(n00 * x01 + n01 * x11) * by,
        -(n10 * x00 + n11 * x10) * by,
        1.0 - (n10 * x01 + n11 * x11) * by,
    )


@kernel
def squared(z):
    """|z|²."""
    return z.real * z.real + z.imag * z.imag


@kernel
def largest_singular_value(a, b, c, d):
    """Of [[a, b], [c, d]]: the root of the larger eigenvalue of its Gram matrix, without cancellation."""
    p, r = squared(a) + squared(c), squared(b) + squared(d)
    q = a.conjugate() * b + c.conjugate() * d
    half = 0.5 * (p - r)
    return sqrt(0.5 * (p + r) + sqrt(half * half + squared(q)))


@kernel
def structured_singular_value(a, b, c, d):
    """μ of [[a, b], [c, d]] for two scalars: its largest singular value after the best diagonal scaling.

    The best is that which makes both entries beside the diagonal equally large.
    """
    above, below = squared(b), squared(c)
    if above == 0.0 or below == 0.0:
        return sqrt(max(squared(a), squared(d)))
    scale = sqrt(sqrt(below / above))
    return largest_singular_value(a, b * scale, c * (1.0 / scale), d)


@kernel
def frequency_gain(f, w, disk):
    """The largest singular value of S(jω), or μ of S − ½ = (S − T)/2."""
    a, b, c, d = sensitivity(f, w)
    return structured_singular_value(a - 0.5, b, c, d - 0.5) if disk else largest_singular_value(a, b, c, d)


@entry_point(
    lambda: (
        examples.given(*POLYNOMIALS),
        examples.poles(),
        examples.zeros(3, FREQUENCIES),
        examples.zeros(SENSITIVITY),
    )
)
def sensitivity_peaks(f, poles, grid, both):
    """Sensitivity peak and disk margin, each with its frequency, into `both`, (4,); the loop is stable.

    `poles` are the loop's, complex; scratch: `grid`, (3, FREQUENCIES).
    """
    keep_apart()
    count = sample_frequencies(f, poles, grid)
    both[SENSITIVITY_PEAK], both[PEAK_FREQUENCY] = global_maximum(f, grid, ANGLES, count)
    mu, both[DISK_FREQUENCY] = global_maximum(f, grid, DISKS, count)
    both[DISK_MARGIN] = 1.0 / mu


@kernel
def sample_frequencies(f, poles, grid):
    """Frequencies from 0 to infinity with both sizes there into `grid`; their number."""
    fastest = 0.0
    for pole in poles:
        fastest = max(fastest, squared(pole))
    end = REACH * sqrt(fastest)
    share = STEP if len(f) == POLYNOMIALS[0] else WHOLE_STEP
    w, count = 0.0, 0
    while count < FREQUENCIES - 1:
        a, b, c, d = sensitivity(f, w)
        grid[0, count] = w
        grid[ANGLES, count] = largest_singular_value(a, b, c, d)
        grid[DISKS, count] = structured_singular_value(a - 0.5, b, c, d - 0.5)
        count += 1
        if w >= end:
            break
        nearest = inf
        for pole in poles:
            away = w - abs(pole.imag)
            nearest = min(nearest, pole.real * pole.real + away * away)
        w += share * sqrt(nearest) + ROUNDING * end
    grid[0, count], grid[ANGLES, count], grid[DISKS, count] = inf, 1.0, 0.5
    return count + 1


@kernel
def global_maximum(f, grid, row, count):
    """The highest of all maxima, and where: at infinity unless a frequency rises above that by more than rounding."""
    last = count - 1
    best, where = grid[row, last], inf
    known = best
    for k in range(last):
        known = max(known, grid[row, k])
    for k in range(count):
        here = grid[row, k]
        before, after = grid[row, max(k - 1, 0)], grid[row, min(k + 1, last)]
        if here < before or here < after or here < WITHIN * known:
            continue
        if here > best * (1.0 + 4.0 * ROUNDING):
            best, where = here, grid[0, k]
        # towards infinity in 1/ω: a negative ω stands for it, so that both kinds of search rise
        tail = k >= last - 1
        low = grid[0, max(k - 1, 0)]
        high = grid[0, min(k + 1, last)]
        if tail:
            low, high = (-1.0 / low if low > 0.0 else -inf), 0.0
        if low > -inf:
            top, at = brent_maximum(f, low, high, tail, row == DISKS)
            if top > best * (1.0 + 4.0 * ROUNDING):
                best, where = top, at
    return best, where


@kernel
def brent_maximum(f, low, high, tail, disk):
    """A maximum between two frequencies, or between two −1/ω: Brent's method, by parabolas or golden section.

    Source: Brent, Algorithms for Minimization without Derivatives (1973), chapter 5.
    """
    end = PRECISION * (high - low) + ROUNDING * max(abs(low), abs(high))
    place = second = third = low + (1.0 - GOLDEN) * (high - low)
    top = at_second = at_third = frequency_gain(f, -1.0 / place if tail else place, disk)
    step = before = 0.0
    for _ in range(100):
        if max(place - low, high - place) <= 2.0 * end:
            break
        # the vertex of the parabola through the three best, as a step p/q from the best
        r, q = (place - second) * (top - at_third), (place - third) * (top - at_second)
        p, q = (place - third) * q - (place - second) * r, 2.0 * (r - q)
        if q < 0.0:
            p, q = -p, -q
        if abs(p) < 0.5 * q * abs(before) and q * (low - place) < p < q * (high - place):
            before, step = step, p / q
            if min(place + step - low, high - place - step) < 2.0 * end:
                step = end if place < 0.5 * (low + high) else -end
        else:
            before = high - place if place < 0.5 * (low + high) else low - place
            step = (1.0 - GOLDEN) * before
        if abs(step) < end:
            step = end if step > 0.0 else -end
        other = place + step
        here = frequency_gain(f, -1.0 / other if tail else other, disk)
        if here >= top:
            low, high = (place, high) if step > 0.0 else (low, place)
            third, second, place = second, place, other
            at_third, at_second, top = at_second, top, here
        else:
            low, high = (low, other) if step > 0.0 else (other, high)
            if here >= at_second or second == place:
                third, second, at_third, at_second = second, other, at_second, here
            elif here >= at_third or third in (place, second):
                third, at_third = other, here
    return top, -1.0 / place if tail else place
