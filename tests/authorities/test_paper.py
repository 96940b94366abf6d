"""The paper's printed numbers, and what its printed formulas give.

Source: T. V. Mumcu, K. K. Çandır, İ. Üstoğlu, "Symbolic Pole Assignment of 2DoF Conventional
Helicopter", Sections III and IV, Eqs. 21–23. The numbers are the paper's, typed off it.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from heli2dof_core import PoleSet, Spec, close_loop, design, interaction, place, plant, pole_error, preset

PRINTED_K = np.array([[51.227, -3.278, 5.446, -0.374], [-10.556, 98.333, -1.205, 11.221]])
PRINTED_OPEN_LOOP_POLES = [0.0, 0.0, -9.24979, -8.76343]
PRINTED_POLES = [-12.0, -10.0, -9.25, -8.76]


def formula_as_printed(rig, p_1, p_2, p_3, p_4):
    """Eqs. 21–22 to the letter: α in every entry, B_p/β for B_y/β."""
    alpha, beta, gamma = rig.alpha, rig.beta, rig.gamma
    first, second = -p_1 - p_2 - rig.B_p / alpha, -p_3 - p_4 - rig.B_p / beta
    K_pp, K_py, K_yp = rig.K_pp, rig.K_py, rig.K_yp
    return np.array(
        [
            [
                p_1 * p_2 * alpha / K_pp - K_py * K_yp * p_3 * p_4 * alpha / (K_pp * gamma),
                K_py * p_3 * p_4 * alpha / gamma,
                first * alpha / K_pp - K_py * K_yp * alpha * second / (K_pp * gamma),
                K_py * alpha * second / gamma,
            ],
            [
                K_yp * p_3 * p_4 * alpha / gamma,
                -K_pp * p_3 * p_4 * alpha / gamma,
                K_yp * alpha * second / gamma,
                -K_pp * alpha * second / gamma,
            ],
        ]
    )


def test_printed_gain_follows_from_the_printed_formula_to_every_digit():
    rig = preset("paper-as-computed").parameters
    np.testing.assert_array_equal(formula_as_printed(rig, *PRINTED_POLES).round(3), PRINTED_K)


def test_printed_gain_does_not_follow_from_the_printed_table():
    rig = preset("paper-table-1").parameters
    assert np.any(formula_as_printed(rig, *PRINTED_POLES).round(3) != PRINTED_K)


def test_printed_open_loop_poles():
    found = np.linalg.eigvals(plant(preset("paper-as-computed").parameters).A)
    assert pole_error(PRINTED_OPEN_LOOP_POLES, found) < 0.5e-5


def test_printed_rga():
    """Eq. 23: λ₁₁ = 1 + (73/7127) p₃p₄/(p₁p₂), exactly, from the unrounded thrust constants."""
    rig = preset("paper-as-computed").parameters
    K_pp, K_py, K_yp, K_yy = (Fraction(str(getattr(rig, n))) for n in ("K_pp", "K_py", "K_yp", "K_yy"))
    assert K_py * K_yp / (K_pp * K_yy - K_py * K_yp) == Fraction(73, 7127)
    rga = interaction(place(Spec.from_preset(preset("paper-as-computed")))).rga
    assert rga[0, 0] == pytest.approx(1 + 73 / 7127 * (9.25 * 8.76) / (12 * 10), abs=1e-12)


@pytest.mark.parametrize(
    ("name", "poles"),
    [
        ("paper-as-computed", [-12.004, -9.997, -8.794, -8.730]),
        ("quanser-2dof-manual", [-12.082, -9.943, -6.128 + 6.268j, -6.128 - 6.268j]),
    ],
)
def test_where_the_printed_gain_really_puts_the_poles(name, poles):
    """The errata's consequence: the yaw pair misses, on the physical plant by far."""
    model = plant(preset(name).parameters)
    assert pole_error(poles, np.linalg.eigvals(model.A - model.B @ PRINTED_K)) < 2e-3


def test_printed_sign_convention_is_unstable():
    """Eqs. 16–18 print A + BK; the printed K stabilizes with A − BK only."""
    model = plant(preset("paper-as-computed").parameters)
    assert np.max(np.linalg.eigvals(model.A + model.B @ PRINTED_K).real) > 1


def test_manual_rig_with_the_corrected_gain(spec):
    """The default rig's numbers, as computed independently in 30 digits for the theory sheet."""
    placed = place(spec)
    expected = [[51.170053, -3.455990, 5.458165, -0.619410], [-10.544461, 103.679711, -1.889862, 18.582295]]
    np.testing.assert_allclose(placed.K, expected, atol=1e-6, rtol=0)
    assert placed.pole_error < 1e-9
    assert interaction(placed).rga[0, 0] == pytest.approx(1.006916, abs=1e-6)
    np.testing.assert_allclose(placed.plant.trim, [12.535, -3.813], atol=5e-4)


def test_pi_moves_the_placed_poles(spec, complex_poles):
    loop = close_loop(place(spec))
    expected = [-4.10 + 2.61j, -4.10 - 2.61j, -5.98 + 5.97j, -5.98 - 5.97j, -9.84, -10.0]
    assert pole_error(expected, loop.poles) < 6e-3
    assert loop.stable
    slow = close_loop(design(plant(spec.parameters), complex_poles))
    assert slow.poles[0].real == pytest.approx(0.47, abs=5e-3)
    assert "pi_unstable" in {f.code for f in slow.findings}


def test_no_dyadic_design_exists_without_a_first_feedback(spec):
    """Section III compares with Ackermann's formula: (A, Bf) is uncontrollable for every f here."""
    model = plant(spec.parameters)
    generator = np.random.default_rng(1)
    for f in generator.normal(size=(50, 2)):
        b = model.B @ f
        columns = [b]
        for _ in range(3):
            columns.append(model.A @ columns[-1])
        scaled = np.column_stack([c / np.linalg.norm(c) for c in columns])
        assert np.linalg.matrix_rank(scaled, tol=1e-9) == 3


def test_pole_set_of_the_paper_is_the_preset(spec):
    assert spec.poles == PoleSet(PRINTED_POLES)
