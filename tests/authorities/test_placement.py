"""Published placements, canonical forms, regulators: numbers that others printed.

Each block names its source. Where a gain is not unique its closed loop is compared, and poles that
occur four times by their polynomial, as rounding the printed gain scatters them.
"""

from __future__ import annotations

import numpy as np
import pytest

from heli2dof_core import Weights, full_rank, place_poles, plant, pole_error, preset
from heli2dof_core.controllability import controllability_indices
from heli2dof_core.placement.lqr import regulate
from heli2dof_core.placement.varga import Varga

# SLICOT Library, documentation of SB01MD (single input, P. Petkov 1981): program data and results
SB01MD_A = np.array([[-1.0, 0, 2, -3], [1, -4, 3, -1], [0, 2, 4, -5], [0, 0, -1, -2]])
SB01MD_G = [[1.0, 29.0, 93.0, -76.0]]

# SLICOT Library, documentation of SB01DD (Petkov, Christov, Konstantinov, IEEE TAC 31, 1986), same A
SB01DD_B = np.array([[1.0, 0], [0, 0], [0, 0], [0, 1]])

# SLICOT Library, documentation of SB01BD (A. Varga, IEEE TAC 26, 1981): A + BF, two poles moved
SB01BD_A = np.array([[-6.8, 0, -207, 0], [1, 0, 0, 0], [43.2, 0, 0, -4.2], [0, 0, 1, 0]])
SB01BD_B = np.array([[5.64, 0], [0, 0], [0, 1.18], [0, 0]])
SB01BD_F = np.array([[-0.0876, -4.2138, 0.0837, -18.1412], [-0.0233, 18.2483, -0.4259, -4.8120]])
SB01BD_POLES = [-3.3984 + 94.5253j, -3.3984 - 94.5253j, -0.5 + 0.15j, -0.5 - 0.15j]

# SciPy, documentation of scipy.signal.place_poles, method KNV0 (reactor of Kautsky, Nichols and Van
# Dooren 1985 with its input matrix reshaped)
REACTOR_A = np.array(
    [
        [1.380, -0.2077, 6.715, -5.676],
        [-0.5814, -4.290, 0, 0.6750],
        [1.067, 4.273, -6.654, 5.893],
        [0.0480, 4.273, 1.343, -2.104],
    ]
)
SCIPY_B = np.array([[0, 5.679], [1.136, 1.136], [0, 0], [-3.146, 0]])
REACTOR_POLES = [-0.2, -0.5, -5.0566, -8.6659]
SCIPY_K = [
    [0.20071427, -0.96665799, 0.24066128, -0.10279785],
    [0.50587268, 0.57779091, 0.51795763, -0.41991442],
]


@pytest.mark.parametrize("method", ["full-rank", "ackermann", "bass-gura", "varga"])
def test_slicot_sb01md_quadruple_pole_with_an_integer_gain(method):
    result = place_poles(SB01MD_A, [[1.0], [0], [0], [0]], [-1, -1, -1, -1], method)
    tolerance = 1e-2 if method == "varga" else 1e-9
    np.testing.assert_allclose(result.placement.K, SB01MD_G, atol=tolerance)


def test_slicot_sb01dd_two_inputs():
    placed = full_rank(SB01MD_A, SB01DD_B, [-1, -1, -1, -1])
    assert placed.controllability_indices == (2, 2)
    np.testing.assert_allclose(np.poly(SB01MD_A - SB01DD_B @ placed.K), [1, 4, 6, 4, 1], atol=1e-10)


def test_slicot_sb01bd_printed_gain_and_ours_have_the_printed_poles():
    printed = np.linalg.eigvals(SB01BD_A + SB01BD_B @ SB01BD_F)
    assert pole_error(SB01BD_POLES, printed) < 2e-4
    for method in ("full-rank", "varga", "tits-yang"):
        K = place_poles(SB01BD_A, SB01BD_B, SB01BD_POLES, method).placement.K
        assert pole_error(SB01BD_POLES, np.linalg.eigvals(SB01BD_A - SB01BD_B @ K)) < 1e-9


def test_scipys_documented_knv0_gain():
    own = place_poles(REACTOR_A, SCIPY_B, REACTOR_POLES, "knv0").placement.K
    np.testing.assert_allclose(own, SCIPY_K, atol=6e-9)
    ours = full_rank(REACTOR_A, SCIPY_B, REACTOR_POLES).K
    assert pole_error(REACTOR_POLES, np.linalg.eigvals(REACTOR_A - SCIPY_B @ ours)) < 1e-9


@pytest.mark.parametrize("method", ["full-rank", "ackermann", "bass-gura", "varga"])
def test_single_input_textbook_gains(method):
    """Altair Compose, reference of `acker` (Ogata's inverted pendulum) and of `place` (magnetic levitation)."""
    pendulum = place_poles([[0.0, 1], [20.6, 0]], [[0.0], [1]], [-1.8 + 2.4j, -1.8 - 2.4j], method)
    np.testing.assert_allclose(pendulum.placement.K, [[29.6, 3.6]], atol=1e-9)
    levitation = place_poles(
        [[0.0, 1, 0], [980, 0, -2.8], [0, 0, -100]], [[0.0], [0], [100]], [-10 + 11j, -10 - 11j, -51], method
    )
    np.testing.assert_allclose(levitation.placement.K, [[-288.75357, -7.93214, -0.29]], atol=6e-6)


def test_luenbergers_transformation_of_a_textbook_example():
    """TinyControl, test_canonical.py, test_ctrb_trans_mat: indices (2, 1) and T."""
    A, B = np.array([[-1.0, -4, -2], [0, 6, -1], [1, 7, -1]]), np.array([[2.0, 0], [0, 0], [1, 1]])
    placed = full_rank(A, B, [-1, -2, -3])
    assert placed.controllability_indices == (2, 1)
    np.testing.assert_allclose(placed.T, [[0, -1, 0], [0, -6, 1], [-0.5, 3, 1]], atol=1e-14)


# R. Byers and S. G. Nash, Int. J. Control 49 (1989) 97: benchmark set, with the indices that harold's
# test_controllability_indices expects
BENCHMARKS = [
    ("chemical reactor", REACTOR_A, [[0, 0], [5.679, 0], [1.136, -3.146], [1.136, 0]], (2, 2)),
    (
        "distillation column",
        [
            [-0.1094, 0.0628, 0, 0, 0],
            [1.306, -2.132, 0.9807, 0, 0],
            [0, 1.595, -3.149, 1.547, 0],
            [0, 0.0355, 2.632, -4.257, 1.855],
            [0, 0.0023, 0, 0.1636, -0.1625],
        ],
        [[0, 0], [0.638, 0], [0.0838, -0.1396], [0.1004, -0.206], [0.0063, -0.0128]],
        (3, 2),
    ),
    (
        "nuclear rocket engine",
        [[-65.0, 65, -19.5, 19.5], [0.1, -0.1, 0, 0], [1, 0, -0.5, -1], [0, 0, 0.4, 0]],
        [[65.0, 0], [0, 0], [0, 0], [0, 0.4]],
        (2, 2),
    ),
    (
        "Miminis 1",
        [
            [5.8765, 9.3456, 4.5634, 9.3520],
            [6.6526, 0.5867, 3.5829, 0.6534],
            [0, 9.6738, 7.4876, 4.7654],
            [0, 0, 6.6784, 2.5678],
        ],
        [[3.9878, 0.5432], [0, 2.7650], [0, 0], [0, 0]],
        (1, 3),
    ),
    (
        "aircraft 1",
        [
            [0, 1, 0, 0],
            [1.40e-4, -2.04, -1.95, -1.33e-2],
            [-2.51e-4, 1, -1.32, -2.38e-2],
            [-5.61e-1, 0, 0.358, -2.79e-1],
        ],
        [[0, 0, 0], [-5.33, 6.45e-3, -2.67e-1], [-1.60e-1, -1.16e-2, -2.51e-1], [0, 1.06e-1, 8.62e-2]],
        (2, 1, 1),
    ),
    (
        "ill-conditioned",
        [[0, 0, 0, 0], [1, 10, 100, 1000], [0, 1, 10, 100], [0, 0, 1, 10]],
        [[1, 0], [0, 1], [0, 0], [0, 0]],
        (1, 3),
    ),
]


@pytest.mark.parametrize(("A", "B", "indices"), [b[1:] for b in BENCHMARKS], ids=[b[0] for b in BENCHMARKS])
def test_byers_and_nashs_benchmarks(A, B, indices):
    A, B = np.array(A, dtype=float), np.array(B, dtype=float)
    assert controllability_indices(A, B) == indices
    poles = -np.arange(1.0, len(A) + 1)
    K = full_rank(A, B, poles).K
    assert pole_error(poles, np.linalg.eigvals(A - B @ K)) < 1e-6


def test_varga_leaves_no_pole_alone():
    """SB01BD's own example leaves two poles; ours are all placed, those far left too."""
    K = Varga().place(_task(SB01BD_A, SB01BD_B, [-1, -2, -3, -4])).K
    assert pole_error([-1, -2, -3, -4], np.linalg.eigvals(SB01BD_A - SB01BD_B @ K)) < 1e-8


def _task(A, B, poles):
    from heli2dof_core.placement.method import Task

    return Task(A, B, np.array(poles, dtype=complex))


# MathWorks, Control System Toolbox, reference of `lqr`: inverted pendulum, four decimals
PENDULUM_A = np.array([[0, 1, 0, 0], [0, -0.1, 3, 0], [0, 0, 0, 1], [0, -0.5, 30, 0]])
PENDULUM_B = np.array([[0.0], [2], [0], [5]])


def test_matlabs_documented_lqr():
    result = place_poles(
        PENDULUM_A, PENDULUM_B, [-1] * 4, "lqr", weights=Weights((1.0, 0.0, 1.0, 0.0), (1.0,))
    )
    np.testing.assert_allclose(result.placement.K, [[-1.0, -1.7559, 16.9145, 3.2274]], atol=5e-5)
    printed = [-0.8684 + 0.8523j, -0.8684 - 0.8523j, -5.4941 + 0.4564j, -5.4941 - 0.4564j]
    assert pole_error(printed, result.closed_loop_poles) < 1e-4


def test_altairs_documented_lqr_of_an_aircrafts_pitch():
    A, B = (
        np.array([[-0.313, 56.7, 0], [-0.0139, -0.426, 0], [0, 56.7, 0]]),
        np.array([[0.232], [0.0203], [0]]),
    )
    K = regulate(A, B, np.diag([0.0, 0, 2]), np.eye(1))
    np.testing.assert_allclose(K, [[-0.50335, 52.86451, 1.41421]], atol=6e-6)


def test_quansers_published_lqr_gain_of_the_aero():
    """BlueRiverTech/quanser-openai-driver, AeroClassicControl: the gain, four decimals; weights
    diag(200, 75, 0, 0) and 0.005 reproduce all eight entries from our preset's parameters."""
    model = plant(preset("quanser-aero").parameters)
    K = regulate(model.A, model.B, np.diag([200.0, 75, 0, 0]), 0.005 * np.eye(2))
    printed = [[98.2088, -103.0645, 32.2643, -29.0750], [156.3469, 66.1643, 45.5122, 17.1068]]
    np.testing.assert_allclose(K, printed, atol=5e-5)


def test_integral_gains_of_quansers_laboratory_weights_keep_their_identity():
    """With R = I an optimal integral block obeys K_zᵀ K_z = Q_z: weights of Quanser's manual, 50 on both."""
    model = plant(preset().parameters)
    Q = np.diag([200.0, 150, 100, 200, 50, 50])
    K = regulate(model.A, model.B, Q, np.eye(2), integrate=np.eye(2, 4))
    np.testing.assert_allclose(K[:, 4:].T @ K[:, 4:], 50 * np.eye(2), rtol=1e-9, atol=1e-9)
    recalled = [[18.9, 1.98, 7.48, 1.53, 7.03, 0.770], [-2.22, 19.4, -0.450, 11.9, -0.770, 7.03]]
    np.testing.assert_allclose(K, recalled, rtol=1e-2)
