"""Matrices of shapes that fit nothing are refused with the field that is wrong, whatever the library would say."""

from __future__ import annotations

import numpy as np
import pytest

from heli2dof_core import InvalidInputError, best_pairing, place_poles, relative_gain_array
from heli2dof_core.placement.method import MOST_STATES, require_system
from heli2dof_core.relative_gains import MOST_LOOPS

A = np.diag([1.0, 2.0, 3.0])
B = np.eye(3)[:, :2]
POLES = [-1, -2, -3]


@pytest.mark.parametrize(
    ("field", "system"),
    [
        ("A", (np.ones(3), B, POLES)),
        ("A", (5.0, B, POLES)),
        ("A", (np.ones((2, 3)), B, POLES)),
        ("A", (np.ones((3, 3, 3)), B, POLES)),
        ("A", (np.zeros((0, 0)), np.zeros((0, 0)), [])),
        ("A", (np.eye(MOST_STATES + 1), np.eye(MOST_STATES + 1)[:, :1], [-1] * (MOST_STATES + 1))),
        ("A", ([["a"]], B, POLES)),
        ("A", (A * np.nan, B, POLES)),
        ("B", (A, np.ones(3), POLES)),
        ("B", (A, np.ones(4), POLES)),
        ("B", (A, 1.0, POLES)),
        ("B", (A, np.ones((3, 1, 1)), POLES)),
        ("B", (A, np.eye(2), POLES)),
        ("B", (A, np.eye(4)[:, :2], POLES)),
        ("B", (A, np.zeros((3, 0)), POLES)),
        ("B", (A, np.ones((3, 4)), POLES)),
        ("B", (A, np.where(B > 0, np.inf, B), POLES)),
        ("B", (A, np.ones((3, 2)), POLES)),
        ("B", (A, np.zeros((3, 1)), POLES)),
        ("poles", (A, B, POLES[:2])),
        ("poles", (A, B, [*POLES, -4])),
        ("poles", (A, B, [POLES])),
        ("poles", (A, B, -1)),
        ("poles", (A, B, [-1, -2, np.inf])),
        ("poles", (A, B, [-1, -2, "a"])),
    ],
)
def test_systems_of_other_shapes_name_the_field(field, system):
    with pytest.raises(InvalidInputError) as caught:
        place_poles(*system)
    assert caught.value.field == field


def test_the_largest_and_the_smallest_system_are_taken():
    for n, m in ((1, 1), (MOST_STATES, 1), (MOST_STATES, MOST_STATES), (3, 3)):
        system = require_system(np.eye(n), np.eye(n)[:, :m], -np.arange(1, n + 1))
        assert [part.shape for part in system] == [(n, n), (n, m), (n,)]


@pytest.mark.parametrize(
    "shape", [(), (2,), (0,), (2, 3), (3, 2), (2, 2, 2), (MOST_LOOPS + 1, MOST_LOOPS + 1)]
)
def test_no_pairing_where_inputs_and_outputs_are_not_as_many(shape):
    with pytest.raises(InvalidInputError) as caught:
        best_pairing(np.random.default_rng(1).normal(size=shape))
    assert caught.value.field == "G"


@pytest.mark.parametrize("gains", [1.0, [1.0, 2.0], []])
def test_relative_gains_are_those_of_a_matrix(gains):
    with pytest.raises(InvalidInputError) as caught:
        relative_gain_array(gains)
    assert caught.value.field == "G"


def test_as_many_loops_as_stated_are_paired():
    """Of a scaled permutation, whose relative gains are that permutation, the pairing is the permutation."""
    rng = np.random.default_rng(3)
    for n in (1, 2, 4, MOST_LOOPS):
        order = tuple(rng.permutation(n).tolist())
        gains = np.diag(rng.uniform(-9, 9, n)) @ np.eye(n)[list(order)] @ np.diag(rng.uniform(1, 9, n))
        assert best_pairing(gains) == order
