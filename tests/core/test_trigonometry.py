"""The kernels' sine and cosine against mpmath's to 50 digits."""

from __future__ import annotations

import math
from importlib import import_module

import numpy as np
import pytest
from mpmath import mp, mpf

sine_and_cosine = import_module("heli2dof_core.interpreted.trigonometry").sine_and_cosine


def in_last_digits(found: float, x: float, function) -> float:
    """The error in units of the last digit of what is right."""
    with mp.workdps(50):
        right = function(mpf(x))
        return float(abs(mpf(found) - right) / mpf(math.ulp(float(right))))


@pytest.mark.parametrize(("largest", "most"), [(math.pi / 4, 0.8), (10.0, 0.8), (1e3, 0.8), (1e6, 0.8)])
def test_both_are_right_to_the_last_digit_or_the_one_beside_it(largest, most):
    for x in np.random.default_rng(0).uniform(-largest, largest, 400).tolist():
        sine, cosine = sine_and_cosine(x)
        assert in_last_digits(sine, x, mp.sin) < most
        assert in_last_digits(cosine, x, mp.cos) < most


def test_where_either_is_nearly_nothing_its_digits_are_right():
    for k in range(1, 2000, 41):
        for x in (k * math.pi / 2, math.nextafter(k * math.pi / 2, 0.0)):
            sine, cosine = sine_and_cosine(x)
            assert in_last_digits(sine, x, mp.sin) < 0.8
            assert in_last_digits(cosine, x, mp.cos) < 0.8


def test_they_are_odd_and_even_and_know_what_is_special():
    for x in [0.0, 1e-300, 1e-9, 0.5, math.pi / 4, math.nextafter(math.pi / 4, 1.0), 2.0, 300.0]:
        sine, cosine = sine_and_cosine(x)
        assert sine_and_cosine(-x) == (-sine, cosine)
    assert sine_and_cosine(0.0) == (0.0, 1.0)
    assert all(map(math.isnan, sine_and_cosine(math.nan)))
    assert sine_and_cosine(1e9) == (math.sin(1e9), math.cos(1e9))
