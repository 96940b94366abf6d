"""Interaction, comparison and the edge cases that are told."""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest
import sympy as sp

from heli2dof_core import (
    METHODS,
    Components,
    InvalidInputError,
    Parameters,
    PoleSet,
    Rotor,
    Rotors,
    Spec,
    Structure,
    close_loop,
    compare,
    compare_splits,
    design,
    evaluate,
    interaction,
    place,
    plant,
    preset,
    rga_over_frequency,
    suggest_pi,
)
from heli2dof_core.interaction import closed_loop_response, dominance_over_frequency
from heli2dof_core.presets import PRESETS
from heli2dof_core.symbolic.names import PARAMETERS, c, p_1, p_2, p_3, p_4, s, theta_0
from heli2dof_core.symbolic.rga import relative_gains_of_s
from heli2dof_core.walkthrough import walk_through
from tests.strategies import STRUCTURES

AERO = Spec.from_preset(preset("quanser-aero"))


@pytest.mark.parametrize("structure", [*STRUCTURES, Structure("triangular", "yaw", 0.4)], ids=str)
def test_symbolic_rga_of_s_is_the_numeric_one_at_every_frequency(structure):
    from heli2dof_core.symbolic.linearization import linear_model
    from heli2dof_core.symbolic.names import cos_0, sin_0

    rig, angle, poles = preset("quanser-2dof-manual").parameters, 0.2, PoleSet([-3 + 4j, -3 - 4j, -5, -6])
    names = {PARAMETERS[name]: value for name, value in rig.as_dict().items()}
    names |= {sin_0: np.sin(angle), cos_0: np.cos(angle), theta_0: angle}
    names |= dict(zip((p_1, p_2, p_3, p_4), poles.values, strict=True))
    shifted = structure.shift is not None
    names |= {c: structure.shift} if shifted else {}
    symbolic = (
        relative_gains_of_s(structure.family, shifted=shifted).subs(linear_model().definitions).subs(names)
    )
    at = np.array([0.1, 1.0, 7.0, 300.0])
    numeric = rga_over_frequency(design(plant(rig, angle), poles, structure), at)
    for w, own in zip(at, numeric, strict=True):
        value = np.array(symbolic.subs(s, sp.I * w).evalf().tolist(), dtype=complex)
        np.testing.assert_allclose(own, value, rtol=1e-8, atol=1e-10)


def test_the_aeros_user_is_told_that_the_rga_advises_against_the_diagonal_pairing():
    report = evaluate(AERO)
    rga = report.interaction.rga
    assert rga is not None and rga[0, 0] == pytest.approx(0.299, abs=5e-4)
    assert report.interaction.pairing == (("theta", "V_y"), ("psi", "V_p"))
    assert report.interaction.niederlinski == pytest.approx(1 / 0.299, rel=2e-3)
    advice = next(f for f in report.findings if f.code == "pairing_cross")
    assert advice.severity == "warning"
    assert "does not make diagonal pairing unstable" in advice.message
    assert report.loop.stable


def test_the_cross_pairing_works_with_the_signs_of_the_paths():
    cross = replace(AERO.outer, pairing="cross")
    suggested = suggest_pi(place(AERO), cross)
    assert suggested.loop.stable
    G_0 = np.linalg.inv(place(AERO).steady_state_inverse)
    assert G_0[0, 1] > 0 > G_0[1, 0]
    proportional = close_loop(place(AERO), suggested.outer).proportional
    np.testing.assert_array_equal(np.sign(proportional), [[0, -1], [1, 0]])
    wrong = replace(suggested.outer, pitch=replace(suggested.outer.pitch, kp=-suggested.outer.pitch.kp))
    assert not close_loop(place(AERO), wrong).stable


def test_crossing_what_should_not_be_crossed_is_told(spec):
    crossed = evaluate(replace(spec, outer=replace(spec.outer, pairing="cross")))
    advice = next(f for f in crossed.findings if f.code == "pairing_diagonal")
    assert advice.severity == "error"  # λ₁₂ is negative
    heeded = evaluate(replace(AERO, outer=replace(AERO.outer, pairing="cross")))
    assert not {"pairing_cross", "pairing_diagonal"} & {f.code for f in heeded.findings}


def test_dominance_of_the_papers_example_holds_at_all_frequencies(design):
    at = np.geomspace(1e-3, 1e5, 500)
    rows, columns = dominance_over_frequency(design, at)
    assert max(np.max(rows), np.max(columns)) < 0.35
    G = closed_loop_response(design, at)
    np.testing.assert_allclose(rows[:, 0], np.abs(G[:, 0, 1] / G[:, 0, 0]))
    high = np.abs(design.plant.B[2, 1] / design.plant.B[2, 0])
    assert rows[-1, 0] == pytest.approx(high, rel=1e-3)


def test_a_negative_relative_gain_is_told_as_unstable():
    poles = PoleSet([-1.8 + 1j, -1.8 - 1j, -2.0, -2.4])
    placed = design(plant(AERO.parameters), poles, Structure())
    found = interaction(placed)
    assert found.rga[0, 0] < 0 and found.niederlinski < 0
    assert found.findings[0].severity == "error"
    assert "Niederlinski index is −" in found.findings[0].message.replace("-", "−")
    assert not suggest_or_none(placed)


def suggest_or_none(placed):
    try:
        return suggest_pi(placed).loop.stable
    except InvalidInputError:
        return False


@pytest.mark.parametrize("name", PRESETS)
def test_all_methods_side_by_side(name):
    spec = Spec.from_preset(preset(name))
    comparison = compare(spec)
    assert [row.method for row in comparison.rows] == ["full-rank"] * 4 + [
        n for n in METHODS if n != "full-rank"
    ]
    for row in comparison.rows:
        assert (row.report is None) != (row.unavailable is None)
        if row.report is not None and row.method != "lqr-integral":
            expected = np.linalg.eigvals(row.report.design.A_closed)
            assert row.report.design.closed_loop_poles.sum().real == pytest.approx(expected.sum().real)
    dyadic = next(row for row in comparison.rows if row.method == "ackermann")
    if preset(name).rig == "helicopter":
        assert "no mix of the inputs" in str(dyadic.unavailable)
        assert "nothing to compare" in comparison.claim
    else:
        assert dyadic.report.design.norm > 3 * comparison.rows[0].report.design.norm
        assert "times the median" in comparison.claim


def test_splits_are_the_designs_of_the_reordered_poles(spec):
    found = compare_splits(spec)
    assert len(found) == 6
    assert found[0].pairs == ((0, 1), (2, 3))
    np.testing.assert_array_equal(found[0].design.K, place(spec).K)
    assert len({round(split.design.norm, 6) for split in found}) == 6
    with pytest.raises(InvalidInputError) as caught:
        PoleSet.dealt([-1, -2, -3, -4], [[0, 1], [1, 2]])
    assert caught.value.field == "split"


def test_integral_action_of_lqr_replaces_the_pi_loops_and_leaves_no_error(spec):
    report = evaluate(replace(spec, method="lqr-integral"), each_axis=True)
    assert report.loop.stable and len(report.loop.poles) == 6
    assert {f.code for f in report.design.findings} == {"own_poles"}
    assert "own_integral_action" in {f.code for f in report.findings}
    for axis, steps in report.axis_steps.items():
        for step in steps.values():
            assert abs(step.metrics.axes[axis].steady_state_error) < 2e-3
    K_z = report.design.integral
    np.testing.assert_allclose(report.loop.voltage_from_state[:, 4:], K_z)
    np.testing.assert_array_equal(report.loop.voltage_from_reference, 0)


EDGES = [
    ([-3, -3, -4, -5], {}, "repeated_poles"),
    ([-12, -10, -9.2601626395701, -5], {}, "open_loop_pole"),
    ([-1e4, -3, -4, -5], {}, "far_out"),
    ([0, -3, -4, -5], {}, "no_steady_state"),
    ([2j, -2j, -4, -5], {}, "imaginary_axis"),
    ([1, -3, -4, -5], {}, "right_half_plane"),
    ([-12, -10, -9, -8], {"K_yy": 0.0068 * 0.0219 / 0.204 * 1.01}, "nearly_uncontrollable"),
]


@pytest.mark.parametrize(("poles", "change", "code"), EDGES, ids=[e[2] for e in EDGES])
def test_edge_cases_are_told_not_hidden(spec, poles, change, code):
    placed = design(plant(spec.parameters.replaced(change)), PoleSet(poles))
    finding = next(f for f in placed.findings if f.code == code)
    assert len(finding.message) > 40
    assert np.all(np.isfinite(placed.K))
    scale = max(abs(p) for p in placed.poles.values)
    assert placed.pole_error < 1e-6 * scale * scale


def test_ordinary_designs_carry_no_remark(spec):
    assert place(spec).findings == ()


def test_shift_and_triangular_without_own_thrust(spec):
    """With a shift given the triangular structure needs no division by K_pp."""
    rig = plant(spec.parameters.replaced({"K_pp": 0.0}))
    assert design(rig, spec.poles, Structure("triangular", "pitch", shift=0.5)).pole_error < 1e-8
    with pytest.raises(InvalidInputError) as caught:
        Structure("axis-decoupled", shift=1.0)
    assert caught.value.field == "shift"


def test_shift_zero_and_own_shift_are_the_named_members(spec):
    model = plant(spec.parameters, 0.1)
    rig = spec.parameters
    for named, given in (
        (Structure("input-diagonal"), Structure("input-diagonal", shift=0.0)),
        (Structure(), Structure(shift=rig.K_py / rig.K_pp)),
        (Structure("triangular", "yaw"), Structure("triangular", "yaw", shift=rig.K_yp / rig.K_yy)),
    ):
        one, other = design(model, spec.poles, named), design(model, spec.poles, given)
        np.testing.assert_allclose(one.K, other.K, rtol=1e-9, atol=1e-9)
    assert str(c) == "c"


@pytest.mark.parametrize("structure", [*STRUCTURES, Structure(shift=0.7)], ids=str)
def test_walkthrough_leads_from_the_plant_to_the_gain(spec, structure):
    placed = design(plant(spec.parameters, 0.2), spec.poles, structure)
    w = walk_through(placed)
    assert w.T is not None and w.A_bar is not None and w.B_bar is not None and w.coefficients is not None
    np.testing.assert_allclose(w.T @ placed.plant.A, w.A_bar @ w.T, atol=1e-9)
    np.testing.assert_allclose(w.B_bar[[1, 3]], w.Q, atol=1e-12)
    np.testing.assert_allclose(w.B_bar[[0, 2]], 0, atol=1e-12)
    d_10, d_11, d_20, d_21 = w.coefficients.values()
    expected = np.polymul([1, d_11, d_10], [1, d_21, d_20])
    np.testing.assert_allclose(np.poly(w.closed_loop_bar), expected, rtol=1e-8)
    np.testing.assert_allclose(w.G_0 @ placed.steady_state_inverse, np.eye(2), atol=1e-12)
    assert w.constants["alpha"] == pytest.approx(spec.parameters.alpha)
    np.testing.assert_allclose(np.linalg.solve(w.Q, w.K_bar @ w.T), placed.K, rtol=1e-9, atol=1e-9)  # Eq. 19
    assert w.controllability_indices == (2, 2)


def test_walkthrough_of_another_method_has_the_plant_and_no_canonical_form(spec):
    other = place(replace(spec, method="lqr"))
    w = walk_through(other)
    assert (w.T, w.Q, w.A_bar, w.B_bar, w.K_bar, w.closed_loop_bar, w.coefficients) == (None,) * 7
    assert w.constants == walk_through(place(spec)).constants
    np.testing.assert_allclose(w.controllability_matrix[:, :2], other.plant.B)
    np.testing.assert_allclose(w.G_0 @ other.steady_state_inverse, np.eye(2), atol=1e-12)


def test_thrust_constants_follow_from_the_components():
    """Quanser's design file prints these constants beside its components."""
    rig = preset("quanser-2dof-design-file")
    printed = {
        "K_pp": 0.20413345,
        "K_yy": 0.071988045,
        "K_yp": 0.0219277,
        "K_py": 0.0068125,
        "l": 0.185670126,
    }
    for name, value in printed.items():
        assert getattr(rig.parameters, name) == pytest.approx(value, abs=6e-8)
    assert rig.components is not None
    with pytest.raises(InvalidInputError) as caught:
        Components(**{**rig.components.as_dict(), "R_p": 0.0})
    assert caught.value.field == "R_p"
    heavier = replace(rig.components, m_p=0.5)
    moved = Parameters.from_components(heavier, J_p=0.04, J_y=0.04, m=1.4, B_p=0.8, B_y=0.3)
    assert moved.l > rig.parameters.l


@pytest.mark.parametrize("place_rotors", [False, True])
def test_the_rga_of_lagging_rotors_is_python_controls_frequency_response(place_rotors):
    """Series of rotors and rig under the state feedback; at ω = 0 the lag does not count."""
    tau, changes = (0.05, 0.16), {"poles": [-4, -5, -3 + 2j, -3 - 2j]}
    lagging = Rotors(*map(Rotor, tau))
    spec = Spec.from_preset(rotors=lagging, place_rotors=place_rotors, **changes)
    placed, frequencies = place(spec), np.array([0.0, 0.3, 1.0, 4.0, 20.0])
    rig = control.ss(placed.plant.A, placed.plant.B, np.eye(4), np.zeros((4, 2)))
    motors = control.ss(-np.diag(1 / np.array(tau)), np.diag(1 / np.array(tau)), np.eye(2), np.zeros((2, 2)))
    both = control.append(control.series(motors, rig), motors)  # the speeds once more, as outputs
    both = control.ss(both.A, both.B @ np.vstack((np.eye(2), np.eye(2))), both.C, 0)
    K = placed.K if place_rotors else np.hstack((placed.K, np.zeros((2, 2))))
    closed = control.feedback(both, control.ss([], [], [], K))
    G = np.moveaxis(closed(1j * frequencies), -1, 0)[:, :2]
    theirs = G * np.swapaxes(np.linalg.inv(G), -1, -2)
    np.testing.assert_allclose(rga_over_frequency(placed, frequencies), theirs, rtol=1e-8, atol=1e-10)
    static = interaction(placed).rga
    np.testing.assert_allclose(theirs[0].real, static, rtol=1e-8)
    if not place_rotors:
        plain = Spec.from_preset(**changes)
        np.testing.assert_allclose(static, interaction(place(plain)).rga, rtol=1e-9)
        assert abs(rga_over_frequency(place(plain), frequencies)[3] - theirs[3]).max() > 1e-3
