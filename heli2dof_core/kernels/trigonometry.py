"""Sine and cosine at once, from the same sums wherever the kernels run.

A step of the integrator spends half of its time on C's sine and cosine, one call each; and the browser's differ from
them in the last digit, which a long course may carry far. So both come from polynomials here: the angle is taken to
within π/4 of a multiple of π/2, which is subtracted in pieces of 33 bits (Cody and Waite, Software Manual for the
Elementary Functions, 1980), and the polynomials are Chebyshev's interpolation, by mpmath to 50 digits, of
(sin √z/√z − 1)/z and (cos √z − 1 + z/2)/z² for z up to (π/4)².
"""

from __future__ import annotations

from math import cos, floor, pi, sin

from .jit import kernel

FIRST, SECOND, THIRD = 1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21
"""π/2 in three pieces: of the first two multiples by whole numbers below a million are exact."""
LARGEST = 1e6
"""Angle, rad, up to which that serves: a thousand times what counts as diverged."""
S1, S2, S3 = -0.16666666666666666, 0.008333333333330936, -0.00019841269836740532
S4, S5, S6 = 2.7557316093198404e-06, -2.5051129896450185e-08, 1.5917988979397435e-10
C1, C2, C3 = 0.041666666666666664, -0.0013888888888887389, 2.48015872987544e-05
C4, C5, C6 = -2.755731726587808e-07, 2.087614504941318e-09, -1.138254464534925e-11
# the parentheses below are those of the fewest operations one after the other (Estrin)


@kernel
def sine_and_cosine(x):
    """Both of an angle, rad, right to the last digit or the one beside it."""
    if abs(x) <= pi / 4:
        return near_zero(x, 0.0)
    if not abs(x) <= LARGEST:
        return sin(x), cos(x)
    turns = floor(x * (2.0 / pi) + 0.5)
    first, second = x - turns * FIRST, turns * SECOND
    rest = first - second
    third = turns * THIRD - ((first - rest) - second)
    angle = rest - third
    sine, cosine = near_zero(angle, (rest - angle) - third)
    quarter = int(turns) & 3
    if quarter == 0:
        return sine, cosine
    if quarter == 1:
        return cosine, -sine
    if quarter == 2:
        return -sine, -cosine
    return -cosine, sine


@kernel
def near_zero(x, more):
    """Of x + `more`, of which |x| is at most π/4 and `more` below the last digit of x."""
    z = x * x
    zz = z * z
    odd = (S1 + z * S2) + zz * ((S3 + z * S4) + zz * (S5 + z * S6))
    even = (C1 + z * C2) + zz * ((C3 + z * C4) + zz * (C5 + z * C6))
    half = 0.5 * z
    top = 1.0 - half
    return x + (x * z * odd + more * top), top + (((1.0 - top) - half) + (zz * even - x * more))
