"""Regulators of many weights at once, beside SciPy's and python-control's one by one."""

from __future__ import annotations

import control
import numpy as np
import pytest
from scipy.linalg import solve_continuous_are

from heli2dof_core import MethodUnavailableError, Spec, place
from heli2dof_core.placement.lqr import regulate, with_integrals
from heli2dof_core.placement.regulators import regulators

PRESETS = ("quanser-2dof-manual", "quanser-aero-2", "quanser-aero")


def _apart(K, known) -> float:
    return float(np.max(np.abs(K - known)) / np.max(np.abs(known)))


def _weights(rng, rows: int, states: int, decades: float):
    return 10 ** rng.uniform(-decades, decades, (rows, states)), 10 ** rng.uniform(
        -decades, decades, (rows, 2)
    )


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("integrates", [False, True])
def test_they_are_those_of_scipy_and_of_python_control(preset, integrates):
    A, B = place(Spec.from_preset(preset)).model
    if integrates:
        A, B = with_integrals(A, B, np.eye(2, 4))
    states, inputs = _weights(np.random.default_rng(11), 60, len(A), 2.0)
    found = regulators(A, B, states, inputs)
    assert found.shape == (60, 2, len(A)) and np.all(np.isfinite(found))
    for K, q, r in zip(found, states, inputs, strict=True):
        X = solve_continuous_are(A, B, np.diag(q), np.diag(r))
        assert _apart(K, B.T @ X / r[:, np.newaxis]) < 1e-9
        assert _apart(K, control.lqr(A, B, np.diag(q), np.diag(r), method="scipy")[0]) < 1e-9


@pytest.mark.parametrize("seed", range(8))
def test_they_are_those_of_any_system(seed):
    rng = np.random.default_rng(seed)
    k, p = 2 + seed, 1 + seed % 3
    A, B = rng.standard_normal((k, k)), rng.standard_normal((k, p))
    states, inputs = 10 ** rng.uniform(-2, 2, (20, k)), 10 ** rng.uniform(-2, 2, (20, p))
    found = regulators(A, B, states, inputs)
    known = np.flatnonzero(np.isfinite(found[:, 0, 0]))
    assert len(known) == 20 or k > 6  # by one input, some of so many states are hardly reached
    assert len(known) > 3
    for i in known:
        assert _apart(found[i], regulate(A, B, np.diag(states[i]), np.diag(inputs[i]))) < 1e-9


@pytest.mark.parametrize("decades", [4.0, 6.0, 10.0, 14.0])
def test_where_weights_are_far_apart_they_are_right_or_left_out(decades):
    A, B = place(Spec.from_preset()).model
    states, inputs = _weights(np.random.default_rng(12), 200, 4, decades)
    found = regulators(A, B, states, inputs)
    known = np.flatnonzero(np.isfinite(found[:, 0, 0]))
    assert len(known) > 5 and (len(known) < 200 or decades < 6.0)
    for i in known:
        assert _apart(found[i], regulate(A, B, np.diag(states[i]), np.diag(inputs[i]))) < 1e-9


@pytest.mark.parametrize("off", [0.0, 1e-14, 1e-10, 1e-7, 1e-4])
def test_poles_that_are_double_cost_no_digits(off):
    """Of ẍ = u the optimal poles are those of s⁴ − q₂ s² + q₁: both −1 where q = (1, 2), with one vector."""
    A, B = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]])
    states = np.array([[1.0, 2.0 + off], [1.0, 2.0], [4.0, 4.0 - off]])
    for K, (q, s) in zip(regulators(A, B, states, np.ones((3, 1))), states.tolist(), strict=True):
        exact = np.array([[q**0.5, (s + 2 * q**0.5) ** 0.5]])
        assert np.isnan(K[0, 0]) or _apart(K, exact) < 1e-9


def test_what_has_no_stabilizing_solution_is_left_out():
    unseen = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]])
    found = regulators(*unseen, np.array([[0.0, 1.0], [0.0, 0.0], [1.0, 0.0]]), np.ones((3, 1)))
    assert np.isnan(found[:2]).all() and np.isfinite(found[2]).all()
    unreached = np.diag([1.0, -2.0]), np.array([[0.0], [1.0]])
    with pytest.raises(MethodUnavailableError):
        regulate(*unreached, np.eye(2), np.eye(1))
    assert np.isnan(regulators(*unreached, np.ones((1, 2)), np.ones((1, 1)))).all()


@pytest.mark.parametrize("bad", [np.nan, np.inf, -1.0])
def test_weights_that_are_none_spoil_no_others(bad):
    A, B = place(Spec.from_preset()).model
    states, inputs = np.ones((3, 4)), np.ones((3, 2))
    alone = regulators(A, B, states[:1], inputs[:1])[0]
    states[1, 2] = bad
    inputs[2, 0] = bad
    found = regulators(A, B, states, inputs)
    assert np.array_equal(found[0], alone) and np.isnan(found[1:]).all()
