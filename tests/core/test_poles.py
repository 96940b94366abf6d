from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from heli2dof_core import InvalidInputError, PoleSet, UnpairedPolesError, match_poles, pole_error
from tests.strategies import pole_sets

complexes = st.complex_numbers(max_magnitude=100, allow_nan=False, allow_infinity=False)


@given(st.integers(1, 6).flatmap(lambda n: st.tuples(*[st.lists(complexes, min_size=n, max_size=n)] * 2)))
def test_matching_is_one_to_one_and_no_permutation_is_better(sets):
    wanted, found = sets
    order = match_poles(wanted, found)
    assert sorted(order) == list(range(len(wanted)))
    best = min(
        max(abs(w - found[i]) for w, i in zip(wanted, permutation, strict=True))
        for permutation in itertools.permutations(range(len(wanted)))
    )
    assert pole_error(wanted, found) == pytest.approx(best, abs=1e-12)


@given(pole_sets())
def test_coefficients_have_the_poles_as_roots(poles):
    d_10, d_11, d_20, d_21 = poles.coefficients
    np.testing.assert_allclose([1, d_11, d_10], np.poly(poles.array[:2]).real, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose([1, d_21, d_20], np.poly(poles.array[2:]).real, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("values", "field"),
    [
        ([-1 + 2j, -1, -3, -4], "poles.1"),
        ([-1 + 2j, -1 + 2j, -3, -4], "poles.1"),
        ([-1, -2, -3 + 1j, -4 - 1j], "poles.3"),
    ],
)
def test_unpaired_poles_name_the_second_of_the_pair(values, field):
    with pytest.raises(UnpairedPolesError) as caught:
        PoleSet(values)
    assert caught.value.field == field


@pytest.mark.parametrize(
    ("values", "field"),
    [
        ([-1, float("nan"), -3, -4], "poles.1"),
        ([-1, -2, float("-inf"), -4], "poles.2"),
        ([-1, -2, -3, -2e5], "poles.3"),
        ([-1, -2, -3], "poles"),
        ([-1, -2, -3, True], "poles.3"),
        ([-1, -2, -3, "x"], "poles.3"),
    ],
)
def test_unusable_poles_name_their_field(values, field):
    with pytest.raises(InvalidInputError) as caught:
        PoleSet(values)
    assert caught.value.field == field


def test_tiny_parts_count_as_zero():
    assert PoleSet([-1 + 1e-12j, -2, -1e-12, -3]).values == (-1, -2, 0, -3)
