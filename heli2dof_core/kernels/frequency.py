"""What the loop bears, over frequency: margins at each motor, disk margin and sensitivity peak at both.

With the angles q alone as unknowns, rig and law are 2×2 matrices of polynomials, D(s) q = B u and
u = −N(s) q, both times s where errors are integrated. Hence S = (I + L)⁻¹ = I − N M⁻¹ B, M = D + B N: no
eigenvectors, so repeated poles do no harm. With motor i's loop alone opened, L_i = 1/S_ii − 1.
"""

from __future__ import annotations

from cmath import phase
from math import exp, log, nan, pi, sqrt

from ..layout import (
    DELAY_MARGIN,
    DISK_FREQUENCY,
    DISK_MARGIN,
    FREQUENCIES,
    GAIN_MARGIN,
    GAIN_REDUCTION_MARGIN,
    MARGINS,
    PEAK_FREQUENCY,
    PHASE_MARGIN,
    SENSITIVITY_PEAK,
)
from .jit import kernel
from .polynomials import add_product, determinant, drop_rounding, positive_roots

# f, (2, 2, 16), holds for each entry the coefficients of M, N and D, lowest power first, and B
M, N, D, B = 0, 4, 8, 12
# Rows of the scratch array p, (11, 16): det M, the same with a motor opened, their even and odd parts, and
# the polynomial of ω² whose roots are sought, with rows for the search
CLOSED, OPENED, CLOSED_EVEN, CLOSED_ODD, EVEN, ODD, SOUGHT, SIZES, CHAIN, BEFORE, ROOTS = range(11)
GOLDEN = (sqrt(5.0) - 1.0) / 2.0
PRECISION = 1e-6  # of a peak's frequency, relative; its height is then known to the square of that


@kernel
def describe(A, inputs, law, integrates, f):
    """The matrices of polynomials into f: A (4, 4), inputs (4, 2), law = ∂u/∂[x, z], (2, 6) or (2, 4)."""
    shift = 1 if integrates else 0
    for i in range(2):
        for j in range(2):
            for k in range(16):
                f[i, j, k] = 0.0
            f[i, j, B] = inputs[2 + i, j]
            f[i, j, N + shift], f[i, j, N + shift + 1] = -law[i, j], -law[i, 2 + j]
            f[i, j, D + shift], f[i, j, D + shift + 1] = -A[2 + i, j], -A[2 + i, 2 + j]
            f[i, j, D + shift + 2] = 1.0 if i == j else 0.0
            if integrates:
                f[i, j, N] = law[i, 4 + j]  # z = −q/s
    close(f, -1)


@kernel
def close(f, opened):
    """M = D + B N, without the motor `opened`."""
    for i in range(2):
        for j in range(2):
            for k in range(4):
                f[i, j, M + k] = f[i, j, D + k]
                for motor in range(2):
                    if motor != opened:
                        f[i, j, M + k] += f[i, motor, B] * f[motor, j, N + k]


@kernel
def entry(f, i, j, first, w, x):
    """An entry of M or N at s = jω, x = ω²."""
    return complex(f[i, j, first] - x * f[i, j, first + 2], w * (f[i, j, first + 1] - x * f[i, j, first + 3]))


@kernel
def sensitivity(f, w):
    """The four entries of S(jω), row by row."""
    x = w * w
    m00, m01 = entry(f, 0, 0, M, w, x), entry(f, 0, 1, M, w, x)
    m10, m11 = entry(f, 1, 0, M, w, x), entry(f, 1, 1, M, w, x)
    det = m00 * m11 - m01 * m10
    by = inverse(det)
    x00, x01 = m11 * f[0, 0, B] - m01 * f[1, 0, B], m11 * f[0, 1, B] - m01 * f[1, 1, B]
    x10, x11 = m00 * f[1, 0, B] - m10 * f[0, 0, B], m00 * f[1, 1, B] - m10 * f[0, 1, B]
    n00, n01 = entry(f, 0, 0, N, w, x), entry(f, 0, 1, N, w, x)
    n10, n11 = entry(f, 1, 0, N, w, x), entry(f, 1, 1, N, w, x)
    return (
        1.0 - (n00 * x00 + n01 * x10) * by,
        -(n00 * x01 + n01 * x11) * by,
        -(n10 * x00 + n11 * x10) * by,
        1.0 - (n10 * x01 + n11 * x11) * by,
    )


@kernel
def inverse(z):
    """1/z; infinite or not a number, but no error, where z is 0."""
    return z.conjugate() / squared(z)


@kernel
def squared(z):
    """|z|²."""
    return z.real * z.real + z.imag * z.imag


@kernel
def largest_singular_value(a, b, c, d, scaled):
    """Of [[a, b], [c, d]]; `scaled`: after the diagonal scaling that makes it smallest, μ of two scalars.

    That scaling makes both entries beside the diagonal equally large.
    """
    beside = 2.0 * sqrt(squared(b) * squared(c)) if scaled else squared(b) + squared(c)
    total = squared(a) + squared(d) + beside
    product = squared(a * d - b * c)
    return sqrt(0.5 * (total + sqrt(max(total * total - 4.0 * product, 0.0))))


@kernel
def size(f, w, disk):
    """The largest singular value of S(jω), or μ of S − ½."""
    a, b, c, d = sensitivity(f, w)
    if disk:
        return largest_singular_value(a - 0.5, b, c, d - 0.5, True)
    return largest_singular_value(a, b, c, d, False)


@kernel
def peaks(f, poles, frequencies, both):
    """Sensitivity peak and disk margin, each with its frequency, into `both`, (4,).

    Largest on a grid that holds the poles' own frequencies too, then by golden section between its
    neighbours. `poles` are complex; scratch: `frequencies`, (FREQUENCIES + 2·poles,).
    """
    slowest, fastest = abs(poles[0]), abs(poles[0])
    for p in poles:
        slowest, fastest = min(slowest, abs(p)), max(fastest, abs(p))
    low, high = log(0.01 * max(slowest, 1e-3)), log(100.0 * fastest)
    for k in range(FREQUENCIES):
        frequencies[k] = exp(low + (high - low) * k / (FREQUENCIES - 1))
    count = FREQUENCIES
    for p in poles:
        if p.imag > 0.0:
            for w in (p.imag, abs(p)):  # where a lightly damped pair may have its narrow peak
                at = count
                while frequencies[at - 1] > w:
                    frequencies[at] = frequencies[at - 1]
                    at -= 1
                frequencies[at] = w
                count += 1
    best = disk_best = 0.0
    at = disk_at = 0
    for k in range(count):
        a, b, c, d = sensitivity(f, frequencies[k])
        here = largest_singular_value(a, b, c, d, False)
        if here > best:
            best, at = here, k
        here = largest_singular_value(a - 0.5, b, c, d - 0.5, True)
        if here > disk_best:
            disk_best, disk_at = here, k
    both[SENSITIVITY_PEAK], both[PEAK_FREQUENCY] = highest(f, frequencies, count, at, best, False)
    mu, both[DISK_FREQUENCY] = highest(f, frequencies, count, disk_at, disk_best, True)
    both[DISK_MARGIN] = 1.0 / mu


@kernel
def highest(f, frequencies, count, at, known, disk):
    """The highest value between the neighbours of a grid point, and where."""
    low, high = log(frequencies[max(at - 1, 0)]), log(frequencies[min(at + 1, count - 1)])
    best, where = known, frequencies[at]
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = size(f, exp(left), disk), size(f, exp(right), disk)
    while high - low > PRECISION:
        if at_left > at_right:
            high, right, at_right = right, left, at_left
            left = high - GOLDEN * (high - low)
            at_left = size(f, exp(left), disk)
        else:
            low, left, at_left = left, right, at_right
            right = low + GOLDEN * (high - low)
            at_right = size(f, exp(right), disk)
    if max(at_left, at_right) > best:
        best, where = max(at_left, at_right), exp(0.5 * (low + high))
    return best, where


@kernel
def margins(f, p, table):
    """Gain, gain reduction, phase and delay margin of each motor into `table`, (2, 4); f as described.

    L_i crosses the unit circle where Re S_ii = ½ and the real axis where Im S_ii = 0: with S_ii = p_i / p_c,
    both polynomials, these are the positive roots of two polynomials of ω². None can be missed, and
    the integrators at ω = 0, where `control.margin` reports a gain margin of 0, are no crossing.
    """
    determinant(f, M, p[CLOSED])
    halves(p, CLOSED, CLOSED_EVEN, CLOSED_ODD)
    for motor in range(2):
        close(f, motor)
        determinant(f, M, p[OPENED])
        halves(p, OPENED, EVEN, ODD)
        close(f, -1)
        for k in range(MARGINS):
            table[motor, k] = nan
        unit_circle(p)
        for k in range(positive_roots(p[SOUGHT], p[CHAIN], p[ROOTS], p[BEFORE])):
            w = sqrt(p[ROOTS, k])
            lag = phase(-loop(f, motor, w)) % (2.0 * pi)  # above −180°, as a lag that closes it
            smallest(table, motor, PHASE_MARGIN, min(lag, 2.0 * pi - lag))
            smallest(table, motor, DELAY_MARGIN, lag / w)
        real_axis(p)
        for k in range(positive_roots(p[SOUGHT], p[CHAIN], p[ROOTS], p[BEFORE])):
            gain = -1.0 / loop(f, motor, sqrt(p[ROOTS, k])).real
            if gain > 1.0:
                smallest(table, motor, GAIN_MARGIN, gain)
            elif 0.0 < gain < 1.0 and not gain < table[motor, GAIN_REDUCTION_MARGIN]:
                table[motor, GAIN_REDUCTION_MARGIN] = gain


@kernel
def unit_circle(p):
    """Re S_ii = ½: 2 (E_i E_c + x O_i O_c) − (E_c² + x O_c²), a polynomial of x = ω²."""
    clear(p[SOUGHT])
    clear(p[SIZES])
    add_product(p[EVEN], p[CLOSED_EVEN], 2.0, 0, p[SOUGHT], p[SIZES])
    add_product(p[ODD], p[CLOSED_ODD], 2.0, 1, p[SOUGHT], p[SIZES])
    add_product(p[CLOSED_EVEN], p[CLOSED_EVEN], -1.0, 0, p[SOUGHT], p[SIZES])
    add_product(p[CLOSED_ODD], p[CLOSED_ODD], -1.0, 1, p[SOUGHT], p[SIZES])
    drop_rounding(p[SOUGHT], p[SIZES])


@kernel
def real_axis(p):
    """Im S_ii = 0: O_i E_c − E_i O_c."""
    clear(p[SOUGHT])
    clear(p[SIZES])
    add_product(p[ODD], p[CLOSED_EVEN], 1.0, 0, p[SOUGHT], p[SIZES])
    add_product(p[EVEN], p[CLOSED_ODD], -1.0, 0, p[SOUGHT], p[SIZES])
    drop_rounding(p[SOUGHT], p[SIZES])


@kernel
def loop(f, motor, w):
    """L_i(jω) = 1/S_ii − 1."""
    a, _, _, d = sensitivity(f, w)
    return inverse(a if motor == 0 else d) - 1.0


@kernel
def smallest(table, motor, column, number):
    """Keeps the smallest number of a column; nan is none yet."""
    if not number > table[motor, column]:
        table[motor, column] = number


@kernel
def clear(row):
    """Zeros."""
    for k in range(len(row)):
        row[k] = 0.0


@kernel
def halves(p, row, even, odd):
    """p(jω) = E(ω²) + jω O(ω²): the coefficients of E and O."""
    clear(p[even])
    clear(p[odd])
    for k in range(7):
        sign = 1.0 if k % 4 < 2 else -1.0
        p[even if k % 2 == 0 else odd, k // 2] = sign * p[row, k]
