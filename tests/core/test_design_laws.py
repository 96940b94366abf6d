"""Laws of placement, for random rigs, poles, operating points and structures."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import eig

from heli2dof_core import (
    PoleSet,
    Structure,
    StructureUnavailableError,
    UncontrollableError,
    design,
    interaction,
    plant,
    pole_error,
    preset,
    rga_over_frequency,
)
from heli2dof_core.controllability import controllability_indices
from heli2dof_core.signals import C
from tests.strategies import operating_points, pole_sets, rigs, structures


@given(rigs(), operating_points, pole_sets(), structures)
def test_eigenvalues_are_the_desired_poles_one_to_one(rig, theta_0, poles, structure):
    placed = design(plant(rig, theta_0), poles, structure)
    values, left, right = eig(placed.A_closed, left=True)
    with np.errstate(divide="ignore"):  # of a double pole, whose left and right eigenvectors are orthogonal
        condition = 1 / np.min(np.abs(np.sum(left.conj() * right, axis=0)))
    # Rounding moves an eigenvalue by condition · eps · ‖A − BK‖, a double one by the root of that.
    rounding = 1e-14 * np.linalg.norm(placed.A_closed)
    bound = 100 * min(condition * rounding, np.sqrt(rounding * np.linalg.norm(placed.A_closed)))
    assert pole_error(poles.array, values) <= bound + 1e-9
    wanted = np.poly(poles.array).real
    found = np.poly(values).real
    np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9 * np.max(np.abs(wanted)))


@given(rigs(), operating_points, pole_sets(), structures)
def test_order_within_a_pair_does_not_matter(rig, theta_0, poles, structure):
    p_1, p_2, p_3, p_4 = poles.values
    swapped = PoleSet([p_2, p_1, p_4, p_3])
    model = plant(rig, theta_0)
    one, other = design(model, poles, structure).K, design(model, swapped, structure).K
    np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12 * np.max(np.abs(one)))


@given(rigs(), operating_points, pole_sets(), structures)
def test_steady_state_inverse_and_rga_follow_from_the_closed_loop(rig, theta_0, poles, structure):
    placed = design(plant(rig, theta_0), poles, structure)
    G_0 = C @ np.linalg.solve(-placed.A_closed, placed.plant.B)
    product = G_0 @ placed.steady_state_inverse
    np.testing.assert_allclose(product, np.eye(2), atol=1e-7)
    rga = interaction(placed).rga
    assert rga is not None
    np.testing.assert_allclose(rga, G_0 * np.linalg.inv(G_0).T, rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(rga.sum(axis=0), 1, atol=1e-9)
    np.testing.assert_allclose(rga.sum(axis=1), 1, atol=1e-9)


@given(rigs(), pole_sets(), st.floats(0.1, 10), st.floats(0.1, 10))
def test_rga_does_not_depend_on_the_units_of_the_motors(rig, poles, first, second):
    """Scaling the inputs scales K's rows and leaves the RGA as it is."""
    scaled = rig.replaced(
        {
            "K_pp": rig.K_pp * first,
            "K_yp": rig.K_yp * first,
            "K_py": rig.K_py * second,
            "K_yy": rig.K_yy * second,
        }
    )
    one, other = design(plant(rig), poles), design(plant(scaled), poles)
    np.testing.assert_allclose(other.K * [[first], [second]], one.K, rtol=1e-9, atol=1e-9 * one.norm)
    np.testing.assert_allclose(interaction(other).rga, interaction(one).rga, rtol=1e-8, atol=1e-9)


@given(rigs(), operating_points, pole_sets())
def test_axis_decoupled_leaves_no_path_between_the_axes(rig, theta_0, poles):
    closed = design(plant(rig, theta_0), poles, Structure("axis-decoupled")).A_closed
    size = np.max(np.abs(closed))
    np.testing.assert_allclose(closed[[2, 2, 3, 3], [1, 3, 0, 2]], 0, atol=1e-12 * size)


@given(rigs(), operating_points, pole_sets())
def test_leading_axis_has_its_own_pair_and_is_not_driven_by_the_other(rig, theta_0, poles):
    for lead, own in (("pitch", [0, 2]), ("yaw", [1, 3])):
        closed = design(plant(rig, theta_0), poles, Structure("triangular", lead)).A_closed
        other = [i for i in range(4) if i not in own]
        np.testing.assert_allclose(closed[np.ix_(own, other)], 0, atol=1e-11 * np.max(np.abs(closed)))
        pair = poles.array[:2] if lead == "pitch" else poles.array[2:]
        block = closed[np.ix_(own, own)]
        np.testing.assert_allclose(np.poly(block), np.poly(pair).real, rtol=1e-8, atol=1e-8)


@given(rigs())
def test_every_controllable_rig_has_indices_two_and_two(rig):
    model = plant(rig)
    assert controllability_indices(model.A, model.B) == (2, 2)


def test_indices_of_a_chain_driven_at_its_end():
    """x₁ ← x₂ ← x₃ with inputs at x₃ and x₂: b₁, b₂ are kept, Ab₁ = b₂ is not, Ab₂ completes."""
    A = np.diag([1.0, 1.0], 1)
    B = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    assert controllability_indices(A, B) == (1, 2)
    with pytest.raises(UncontrollableError):
        controllability_indices(np.zeros((3, 3)), B)


def test_parallel_motors_are_refused_with_the_reason():
    parallel = preset().parameters.replaced({"K_yy": 0.0068 * 0.0219 / 0.204})
    with pytest.raises(UncontrollableError, match="K_pp K_yy = K_py K_yp"):
        plant(parallel)


def test_structures_that_do_not_exist_are_refused_with_the_reason():
    rig = preset().parameters
    for change, lead in (({"K_pp": 0.0}, "pitch"), ({"K_yy": 0.0}, "yaw")):
        with pytest.raises(StructureUnavailableError, match="divides"):
            design(plant(rig.replaced(change)), preset().poles, Structure("triangular", lead))
        other = "yaw" if lead == "pitch" else "pitch"
        assert (
            design(plant(rig.replaced(change)), preset().poles, Structure("triangular", other)).pole_error
            < 1e-6
        )


def test_rga_over_frequency_tends_to_the_one_at_rest(design):
    at = rga_over_frequency(design, np.array([0.0, 1e-6, 5.0]))
    np.testing.assert_allclose(at[0], interaction(design).rga, atol=1e-9)
    np.testing.assert_allclose(at[1], at[0], atol=1e-6)
    np.testing.assert_allclose(at.sum(axis=2), 1, atol=1e-9)


def test_a_pole_at_zero_is_placed_but_has_no_steady_state(spec):
    placed = design_with(spec, [0.0, -3.0, -4.0, -5.0])
    assert placed.pole_error < 1e-9
    assert {f.code for f in placed.findings} == {"imaginary_axis", "no_steady_state"}
    assert interaction(placed).rga is None


def test_right_half_plane_is_legal_with_a_finding(spec):
    placed = design_with(spec, [1.0, -3.0, -4.0, -5.0])
    assert [f.code for f in placed.findings] == ["right_half_plane"]


def design_with(spec, poles):
    return design(plant(spec.parameters, spec.theta_0), PoleSet(poles))
