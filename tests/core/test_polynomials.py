"""Positive roots of polynomials that were made of their roots, NumPy's sums of powers, and the sizes of both."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import polynomial

from heli2dof_core.interpreted import polynomials as plain


def found(coefficients):
    """By the interpreted kernel, in its order; lowest power first."""
    p = np.array(coefficients, dtype=float)
    n = len(p)
    roots = np.zeros(n)
    count = plain.positive_roots(p, np.zeros(n), roots, np.zeros(n))
    return roots[:count]


def test_every_positive_root_is_found_and_no_other():
    """Of random signs, sizes over six decades, conjugate pairs and powers of x among the factors."""
    rng = np.random.default_rng(5)
    for _ in range(300):
        degree = int(rng.integers(1, 7))
        positive = int(rng.integers(0, degree + 1))
        wanted = 10 ** (np.sort(rng.uniform(-3, 3, positive)) + 0.1 * np.arange(positive))
        others = list(-(10 ** rng.uniform(-3, 3, degree - positive)))
        if len(others) >= 2:  # two of the others may be conjugates, or roots at 0
            pair = complex(others[0], others[1]) * np.exp(1j * rng.uniform(-1, 1))
            others[:2] = rng.choice([[pair, pair.conjugate()], [0, 0], others[:2]])
        p = polynomial.polyfromroots([*wanted, *others]).real * rng.choice([-2.5, 1.0])
        np.testing.assert_allclose(found(p), wanted, rtol=1e-7)


def test_simple_roots_beside_a_multiple_one_are_found():
    """A double root is none or two crossings, as rounding has it, a triple one is one or three; no other is lost."""
    touch, cross = [1.0, -2.0, 1.0], [-1.0, 3.0, -3.0, 1.0]
    for sign in (1.0, -1.0):
        np.testing.assert_allclose(found(sign * np.array(cross)), 1.0, atol=1e-4)
        assert len(found(sign * np.array(cross))) in (1, 3)
        for simple in (0.25, 4.0):
            roots = found(sign * polynomial.polymul(touch, [-simple, 1.0]))
            np.testing.assert_allclose(roots[abs(roots - 1) > 1e-6], [simple])
            assert len(roots) in (1, 3)


@pytest.mark.parametrize("p", [[3.0], [0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [-1.0, 0.0, 0.0]])
def test_constants_and_powers_of_x_have_no_positive_root(p):
    assert found(p).size == 0


def test_leading_and_trailing_zeros_take_nothing_away():
    for before, after in ((0, 0), (2, 0), (0, 2), (1, 1)):
        np.testing.assert_allclose(found([0.0] * before + [-6.0, 5.0, -1.0] + [0.0] * after), [2.0, 3.0])


def test_a_root_is_found_to_the_last_digits_in_few_steps():
    """Newton's steps double the digits: a bisection of the same interval takes about fifty."""

    class Counted(np.ndarray):
        reads = 0

        def __getitem__(self, key):
            Counted.reads += 1
            return super().__getitem__(key)

    rng = np.random.default_rng(8)
    steps = []
    for _ in range(100):
        roots = np.cumsum(rng.uniform(0.5, 2, 4))
        p = polynomial.polyfromroots(roots).view(Counted)
        k = int(rng.integers(4))
        ends = [0.5 * roots[0], *((roots[1:] + roots[:-1]) / 2), 2 * roots[-1]]
        at_low = float(polynomial.polyval(ends[k], np.asarray(p)))
        Counted.reads = 0
        root = plain.root_between(p, 4, ends[k], ends[k + 1], at_low)
        assert root == pytest.approx(roots[k], rel=1e-12)
        steps.append(Counted.reads / 5)
    assert np.median(steps) < 10


def test_sums_that_are_nothing_but_rounding_are_dropped():
    """p q − q p: what is left is rounding, and is measured by what was added; what is more than that stays."""
    rng = np.random.default_rng(6)
    for _ in range(50):
        p, q = rng.normal(size=4) * 10.0 ** rng.integers(-6, 6, 4), rng.normal(size=3)
        r, sizes = np.zeros(8), np.zeros(8)
        plain.add_product(p, q, 3.0, 1, r, sizes)
        np.testing.assert_allclose(r, [0, *(3 * polynomial.polymul(p, q)), 0], atol=1e-12 * max(sizes))
        bound = polynomial.polymul(abs(p), abs(q))
        np.testing.assert_allclose(sizes, [0, *(3 * bound), 0])
        plain.add_product(-1.5 * p, q, 2.0, 1, r, sizes)
        r[1] += 1e-11 * sizes[1]
        plain.drop_rounding(r, sizes)
        assert r[1] != 0 and not r[2:].any()
