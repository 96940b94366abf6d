"""Published relative gains and pairings."""

from __future__ import annotations

from itertools import combinations, permutations

import numpy as np
import pytest

from heli2dof_core import (
    InvalidInputError,
    best_pairing,
    diagonal_dominance,
    niederlinski_index,
    relative_gain_array,
)

# S. Skogestad and I. Postlethwaite, Multivariable Feedback Control, 2nd ed. 2005
FCC = np.array([[16.8, 30.5, 4.30], [-16.7, 31.0, -1.41], [1.27, 54.1, 5.40]])  # Example 3.10
FCC_RGA = [[1.50, 0.99, -1.48], [-0.41, 0.97, 0.45], [-0.08, -0.95, 2.03]]
BLENDING = np.array([[1.0, 1.0], [0.4, -0.1]])  # Example 3.9
DISTILLATION = np.array([[87.8, -86.4], [108.2, -109.6]])  # section 3.7.2

# M. Castaño Arranz, findICI (MATLAB Central 62030): Petlyuk column of K. E. Häggblom 1997; these two
# pairings alone keep integrity whatever loops are opened
PETLYUK = np.array(
    [
        [153.45, -179.34, 0.23, 0.03],
        [-157.67, 184.75, -0.10, 21.63],
        [24.63, -28.97, -0.23, -0.1],
        [-4.8, 6.09, 0.13, -2.41],
    ]
)
PETLYUK_PAIRINGS = {(2, 3, 0, 1), (0, 1, 2, 3)}


def test_rga_of_a_fluid_catalytic_cracker():
    np.testing.assert_allclose(relative_gain_array(FCC), FCC_RGA, atol=5.1e-3)


def test_rga_of_a_blending_process_and_of_a_distillation_column():
    np.testing.assert_allclose(relative_gain_array(BLENDING), [[0.2, 0.8], [0.8, 0.2]], atol=1e-12)
    np.testing.assert_allclose(relative_gain_array(DISTILLATION), [[35.1, -34.1], [-34.1, 35.1]], atol=0.05)
    assert best_pairing(BLENDING) == (1, 0)
    assert best_pairing(DISTILLATION) == (0, 1)


def test_niederlinski_finds_the_pairings_with_integrity():
    def keeps_integrity(pairing):
        G = PETLYUK[:, pairing]
        subsets = (s for size in range(1, 5) for s in combinations(range(4), size))
        return all((niederlinski_index(G[np.ix_(s, s)]) or -1) > 0 for s in subsets)

    assert {p for p in permutations(range(4)) if keeps_integrity(p)} == PETLYUK_PAIRINGS
    assert sum((niederlinski_index(PETLYUK, p) or -1) > 0 for p in permutations(range(4))) == 12


def test_rga_of_a_singular_matrix_of_ones_by_the_pseudo_inverse():
    """J. Uhlmann, Appl. Math. Lett. 2019, eqs. 19–22: for plants that are not square the pseudo-inverse
    makes the RGA depend on units; our own rigs are square and regular, where it does not."""
    tall = np.ones((3, 2))
    np.testing.assert_allclose(relative_gain_array(tall), tall / 6, atol=1e-12)
    with pytest.raises(InvalidInputError, match="singular"):
        relative_gain_array(np.zeros((2, 2)))


def test_rga_of_plants_that_are_not_square_sums_to_their_rank():
    """Skogestad and Postlethwaite, appendix A.4.2: columns of a tall plant sum to 1, all to the rank."""
    rng = np.random.default_rng(2)
    for shape in ((6, 3), (2, 5), (4, 4)):
        for _ in range(50):
            G = rng.normal(size=shape) + 1j * rng.normal(size=shape)
            rga = relative_gain_array(G)
            axis = 0 if shape[0] >= shape[1] else 1
            np.testing.assert_allclose(rga.sum(axis=axis), 1, atol=1e-9)
            assert rga.sum() == pytest.approx(min(shape))
            if shape[0] == shape[1]:
                scaled = np.diag(rng.uniform(0.1, 9, 4)) @ G @ np.diag(rng.uniform(0.1, 9, 4))
                np.testing.assert_allclose(relative_gain_array(scaled), rga, atol=1e-9)


def test_dominance_of_a_plant_that_is_dominant_by_rows_only():
    G = np.array([[4.0, 3.0], [0.1, 1.0]])
    rows, columns = diagonal_dominance(G)
    np.testing.assert_allclose(rows, [0.75, 0.1])
    np.testing.assert_allclose(columns, [0.025, 3.0])
    assert np.isinf(diagonal_dominance(np.array([[0.0, 1], [1, 1]]))[0][0])
