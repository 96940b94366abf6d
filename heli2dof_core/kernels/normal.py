"""Normal noise by its place, of sums, products and roots alone: the same digits in a browser."""

from __future__ import annotations

from math import pi, sqrt

from .jit import kernel
from .trigonometry import sine_and_cosine


@kernel
def mixed(x):
    """32 bits, each of which depends on all that go in (finalizer of MurmurHash3, A. Appleby)."""
    x ^= x >> 16
    x = (x * 0x85EBCA6B) & 0xFFFFFFFF
    x ^= x >> 13
    x = (x * 0xC2B2AE35) & 0xFFFFFFFF
    return x ^ (x >> 16)


@kernel
def uniform(seed, place, part):
    """Between 0 and 1, both excluded: by its place, whatever was drawn before."""
    low = int(place) & 0xFFFFFFFF
    high = (int(place) >> 32) & 0xFFFFFFFF
    word = mixed((int(seed) & 0xFFFFFFFF) ^ mixed(low ^ mixed(high ^ mixed(part + 0x9E3779B9))))
    return (word + 0.5) / 4294967296.0


@kernel
def normal(seed, place):
    """Of mean 0 and standard deviation 1 (Box & Muller, Ann. Math. Stat. 29 (1958) 610)."""
    radius = sqrt(-2.0 * logarithm(uniform(seed, place, 0)))
    _, cosine = sine_and_cosine(2.0 * pi * uniform(seed, place, 1))
    return radius * cosine


@kernel
def logarithm(x):
    """The natural logarithm, 0 < x ≤ 1, by the series of the inverse hyperbolic tangent."""
    # C's own and a browser's differ in the last digit
    halvings = 0
    while x < 0.7071067811865476:
        x *= 2.0
        halvings += 1
    share = (x - 1.0) / (x + 1.0)
    square, total = share * share, 0.0
    for j in range(10, -1, -1):
        total = total * square + 1.0 / (2 * j + 1)
    return 2.0 * share * total - halvings * 0.6931471805599453
