"""Positive roots of polynomials that were made of their roots, NumPy's sums of powers, and the sizes of both."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import polynomial

from heli2dof_core.interpreted import polynomials as plain


def search(coefficients, rounding=0.0):
    """Changes of sign and touches by the interpreted kernel, in its order; lowest power first."""
    p = np.array(coefficients, dtype=float)
    n = len(p)
    roots = np.zeros(n)
    count, touched = plain.positive_roots(p, rounding * abs(p), np.zeros(n), roots, np.zeros(n))
    return roots[:count], roots[count : count + touched]


def found(coefficients):
    return search(coefficients)[0]


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


def test_where_a_polynomial_only_touches_zero_is_told_apart():
    """A double root that no rounding moves off the axis is no change of sign, yet it is told; a near miss is not."""
    for root in (0.25, 1.0, 8.0):  # exact in floats
        touch = [root**2, -2 * root, 1.0]
        changes, touches = search(touch, 1.0)
        assert changes.size == 0
        np.testing.assert_allclose(touches, [root])
        changes, touches = search([touch[0] * (1 + 1e-9), *touch[1:]], 1.0)
        assert changes.size == 0 and touches.size == 0


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
        p, q = rng.normal(size=4) * 10.0 ** rng.integers(-6, 6, 4), rng.normal(size=4)
        own, other, span = 2 * abs(p), abs(q), (0,) * len(p)
        r, sizes = np.zeros(8), np.zeros(8)
        plain.add_product(span, p, own, q, other, 3.0, 1, r, sizes)
        np.testing.assert_allclose(r, [0, *(3 * polynomial.polymul(p, q))], atol=1e-12 * max(sizes))
        bound = polynomial.polymul(abs(p), abs(q))
        np.testing.assert_allclose(sizes, [0, *(3 * 3 * bound)])
        plain.add_product(span, -1.5 * p, own, q, other, 2.0, 1, r, sizes)
        r[1] += 1e-11 * sizes[1]
        plain.drop_rounding(r, sizes)
        assert r[1] != 0 and not r[2:].any()


def test_a_root_far_from_the_middle_of_its_bounds_is_found_in_few_steps_too():
    """Between Cauchy's bounds, decades apart: Newton's steps from afar would come nearer by a sixth each."""

    class Counted(np.ndarray):
        reads = 0

        def __getitem__(self, key):
            Counted.reads += 1
            return super().__getitem__(key)

    rng = np.random.default_rng(9)
    steps = []
    for _ in range(100):
        others = -(10 ** rng.uniform(-3, 3, 5))
        wanted = 10 ** rng.uniform(-3, 3)
        p = polynomial.polyfromroots([wanted, *others])
        assert np.count_nonzero(np.diff(np.sign(p))) == 1  # Descartes: one positive root
        bounds = 1 / (1 + np.max(abs(p / p[0]))), 1 + np.max(abs(p / p[-1]))
        Counted.reads = 0
        root = plain.root_between(p.view(Counted), 6, *bounds, p[0])
        assert root == pytest.approx(wanted, rel=1e-9)
        steps.append(Counted.reads / 7)
    assert max(steps) < 20 and np.median(steps) < 8
