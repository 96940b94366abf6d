"""The margins of each motor's loop: every crossing of the unit circle and of the real axis, ω = 0 among them.

S = (I + L)⁻¹ = I − N M⁻¹ B, with the matrices of `polynomials`. With motor i's loop alone opened, L_i = 1/S_ii − 1
= (p_c − p_i)/p_i: p_c = det M, p_i the same with that motor opened. Both are monic and of one degree, so that
L_i(∞) = 0: at infinity nothing crosses.
"""

from __future__ import annotations

from cmath import phase
from math import nan, pi, sqrt

from . import examples
from .jit import copy_into, entry_point, keep_apart, kernel
from .layout import (
    DELAY_MARGIN,
    GAIN_MARGIN,
    GAIN_REDUCTION_MARGIN,
    MARGINS,
    PHASE_MARGIN,
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    ROUNDING,
    TERMS,
    VALUE,
    WHOLE_CLOSED,
    WHOLE_OPENED,
)
from .polynomials import (
    HALF,
    WHOLE_HALF,
    add_product,
    closed_loop_matrix,
    determinant,
    drop_rounding,
    even_and_odd_part,
    far_roots,
    horner,
    on_imaginary_axis,
    positive_roots,
)

# Rows of the scratch array p, (17, 16): det M, the same with a motor opened, the sizes of their terms, even and odd
# halves of both with their sizes, and the polynomial of ω² whose roots are sought, with rows for the search
CLOSED, OPENED, CLOSED_SIZES, OPENED_SIZES = range(4)
CLOSED_HALVES, OPENED_HALVES = 4, 8
SOUGHT, SIZES, CHAIN, BEFORE, ROOTS = range(12, 17)
FULL_TURN = 2.0 * pi
NEAR = 1e-6
"""Where a curve only touches circle or axis, it must come as near: the place of a double root is known no better."""
ON_AXIS = 1e3 * ROUNDING
"""An opened loop has a pole at jω if p_i(jω) is below this share of its terms: a root's rounding comes to theirs."""


@entry_point(
    lambda: (
        examples.given(*POLYNOMIALS),
        examples.zeros(*POLYNOMIALS),
        examples.zeros(*POLYNOMIAL_WORKSPACE),
        examples.zeros(2, MARGINS),
    )
)
def margins(f, g, p, table):
    """Gain, gain reduction, phase and delay margin of each motor into `table`, (2, 4); the loop is stable.

    L_i crosses the unit circle where Re S_ii = ½ and the real axis where Im S_ii = 0: with S_ii = p_i / p_c,
    both polynomials, these are the positive roots of two polynomials of ω², and ω = 0. None can be missed. Where the
    opened loop has poles at 0, `control.margin` may report a gain margin of 0 for a state-space model, though not
    for its transfer function; it is no crossing. Scratch: `g`, as `POLYNOMIALS` says, and `p`.
    """
    keep_apart()
    if len(f) == POLYNOMIALS[0]:  # no rotor takes time, nothing is estimated
        determinant(f, p[CLOSED], p[CLOSED_SIZES])
        even_and_odd_part(HALF, p, CLOSED, CLOSED_SIZES, CLOSED_HALVES)
        for motor in range(2):
            closed_loop_matrix(f, motor, g)
            determinant(g, p[OPENED], p[OPENED_SIZES])
            motor_margins(HALF, p, table, motor)
    else:
        copy_into(f[WHOLE_CLOSED, VALUE], p[CLOSED])
        copy_into(f[WHOLE_CLOSED, TERMS], p[CLOSED_SIZES])
        even_and_odd_part(WHOLE_HALF, p, CLOSED, CLOSED_SIZES, CLOSED_HALVES)
        for motor in range(2):
            copy_into(f[WHOLE_OPENED + motor, VALUE], p[OPENED])
            copy_into(f[WHOLE_OPENED + motor, TERMS], p[OPENED_SIZES])
            motor_margins(WHOLE_HALF, p, table, motor)


@kernel
def motor_margins(span, p, table, motor):
    """The margins of one motor, `motor`, from det M and the same with it opened."""
    even_and_odd_part(span, p, OPENED, OPENED_SIZES, OPENED_HALVES)
    for k in range(MARGINS):
        table[motor, k] = nan
    unit_circle(span, p)
    found, touched = crossings(span, p)
    for k in range(found + touched):
        x = p[ROOTS, k]
        opened = on_imaginary_axis(span, p, OPENED_HALVES, x)
        turned = opened - on_imaginary_axis(span, p, CLOSED_HALVES, x)  # −L_i p_i
        if k >= found and not abs(abs(turned) - abs(opened)) <= NEAR * abs(opened):
            continue
        lag = phase(turned * opened.conjugate()) % FULL_TURN  # above −180°, as a lag that closes it
        keep_smallest(table, motor, PHASE_MARGIN, min(lag, FULL_TURN - lag))
        keep_smallest(table, motor, DELAY_MARGIN, lag / sqrt(x))
    if p[SOUGHT, 0] == 0.0:  # L_i(0) = 1: a lead or lag by half a turn, which no delay makes there
        keep_smallest(table, motor, PHASE_MARGIN, pi)
    real_axis(span, p)
    found, touched = crossings(span, p)
    gain_margins(span, p, 0.0, False, table, motor)
    for k in range(found + touched):
        gain_margins(span, p, p[ROOTS, k], k >= found, table, motor)


@kernel
def crossings(span, p):
    """The positive roots of the polynomial that is sought, then where it touches 0: both numbers."""
    if len(span) == len(HALF):
        return positive_roots(p[SOUGHT], p[SIZES], p[CHAIN], p[ROOTS], p[BEFORE])
    return far_roots(p[SOUGHT], p[SIZES], p[CHAIN], p[ROOTS], p[BEFORE])


@kernel
def gain_margins(span, p, x, touches, table, motor):
    """What a crossing of the real axis at ω² = x says: with a gain factor of k, p_i + k (p_c − p_i) is 0."""
    opened = on_imaginary_axis(span, p, OPENED_HALVES, x)
    turned = opened - on_imaginary_axis(span, p, CLOSED_HALVES, x)
    size = turned.real * turned.real + turned.imag * turned.imag
    terms = horner(p[OPENED_SIZES], 2 * (len(span) - 1), sqrt(x))
    if size == 0.0 or abs(opened) <= ON_AXIS * terms:
        return
    product = opened * turned.conjugate()
    if touches and not abs(product.imag) <= NEAR * abs(product.real):
        return
    gain = product.real / size
    if gain > 1.0:
        keep_smallest(table, motor, GAIN_MARGIN, gain)
    elif 0.0 < gain < 1.0 and not gain < table[motor, GAIN_REDUCTION_MARGIN]:
        table[motor, GAIN_REDUCTION_MARGIN] = gain


@kernel
def add_halves(span, p, one, other, factor, shift):
    """Adds to the polynomial that is sought a product of two halves, by their rows; their sizes are two below."""
    add_product(span, p[one], p[one + 2], p[other], p[other + 2], factor, shift, p[SOUGHT], p[SIZES])


@kernel
def unit_circle(span, p):
    """Re S_ii = ½: 2 (E_i E_c + x O_i O_c) − (E_c² + x O_c²), a polynomial of x = ω²."""
    clear_sought(p)
    closed, opened = CLOSED_HALVES, OPENED_HALVES
    add_halves(span, p, opened, closed, 2.0, 0)
    add_halves(span, p, opened + 1, closed + 1, 2.0, 1)
    add_halves(span, p, closed, closed, -1.0, 0)
    add_halves(span, p, closed + 1, closed + 1, -1.0, 1)
    drop_rounding(p[SOUGHT], p[SIZES])


@kernel
def real_axis(span, p):
    """Im S_ii = 0: O_i E_c − E_i O_c."""
    clear_sought(p)
    add_halves(span, p, OPENED_HALVES + 1, CLOSED_HALVES, 1.0, 0)
    add_halves(span, p, OPENED_HALVES, CLOSED_HALVES + 1, -1.0, 0)
    drop_rounding(p[SOUGHT], p[SIZES])


@kernel
def keep_smallest(table, motor, column, number):
    """Keeps the smallest number of a column; nan is none yet."""
    if not number > table[motor, column]:
        table[motor, column] = number


@kernel
def clear_sought(p):
    """Zeros for the polynomial that is sought."""
    for k in range(p.shape[1]):
        p[SOUGHT, k] = p[SIZES, k] = 0.0
