"""The track of the loop's poles as the rotors' lag grows, against eigenvalues of matrices written down here."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from heli2dof_core import Spec
from heli2dof_core.evaluate import loop_of
from heli2dof_core.lag_track import lag_track
from heli2dof_core.poles import PoleSet
from heli2dof_core.rotors import USUAL_LAG, Rotor, Rotors

LAGGING = Rotors(Rotor(0.165), Rotor(0.165))
NEAR = PoleSet([-10 + 9.0000000827726197j, -10 - 9.0000000827726197j, -9.25, -8.76])
"""Their root is known to 6e-14 at once; secants went astray from there."""
CASES = {
    "the first design": {},
    "with its lag": {"rotors": LAGGING},
    "inner loop alone": {"rotors": LAGGING, "outer": "none"},
    "complex pairs": {"poles": [-12, -10, -3 + 4j, -3 - 4j], "rotors": Rotors(Rotor(0.05), Rotor(0.2))},
}


def spectrum(spec: Spec, tau: np.ndarray) -> np.ndarray:
    """Poles of [x, z, v] with u = −Kx + kp (r − y) + kp/ti z and τ v̇ = u − v (theory of the augmented model)."""
    loop = loop_of(spec)
    plant, law, n = loop.design.plant, loop.voltage_from_state, loop.voltage_from_state.shape[1]
    n = min(n, 6 if loop.has_integrators else 4)
    A = np.zeros((n + 2, n + 2))
    A[:4, :4], A[:4, n:] = plant.A, plant.B
    if loop.has_integrators:
        A[4:6, :2] = -np.eye(2)
    A[n:, :n], A[n:, n:] = law[:, :n] / tau[:, None], -np.diag(1 / tau)
    return np.linalg.eigvals(A)


@pytest.mark.parametrize("name", CASES)
def test_each_step_holds_the_eigenvalues_and_the_last_is_the_loop(name):
    spec = Spec.from_preset(**CASES[name])
    track = lag_track(loop_of(spec))
    assert track.assumed == ("rotors" not in CASES[name])
    if track.assumed:
        np.testing.assert_array_equal(track.tau, [USUAL_LAG, USUAL_LAG])
    for k in (0, 30, 75, -1):
        own = spectrum(spec, track.tau * track.share[k])
        away = np.abs(own[:, None] - track.poles[k])
        rows, columns = linear_sum_assignment(away)
        assert np.max(away[rows, columns] / np.maximum(1.0, np.abs(own[rows]))) < 1e-6
    assert track.share[-1] == 1.0


@pytest.mark.parametrize("name", CASES)
def test_paths_run_on_and_do_not_jump_to_one_another(name):
    """A path goes far in one step only where a pole comes from infinity, as the rotors' own at first."""
    poles = lag_track(loop_of(Spec.from_preset(**CASES[name]))).poles
    steps = np.abs(np.diff(poles, axis=0)) / np.maximum(1.0, np.abs(poles[1:]))
    assert np.all(np.quantile(steps[12:], 0.98, axis=0) < 0.25)


@pytest.mark.parametrize("name", CASES)
def test_where_poles_meet_on_the_real_axis_both_are_seen_to_meet(name):
    """Conjugates leave the axis at one point: the tracks are mirror images there, too."""
    poles = lag_track(loop_of(Spec.from_preset(**CASES[name]))).poles
    for k in range(1, len(poles)):
        left = np.flatnonzero((poles[k - 1].imag == 0) & (poles[k].imag > 0))
        for i in left:
            j = int(np.argmin(np.abs(poles[k] - poles[k, i].conjugate())))
            gap = abs(poles[k - 1, i] - poles[k - 1, j])
            assert gap < 0.05 * max(1.0, abs(poles[k, i]))


def test_margins_of_loops_that_are_decoupled_are_not_missed():
    """There each axis has a root of its own, which is found to rounding before any search begins."""
    rng = np.random.default_rng(19)
    loops = [loop_of(Spec.from_preset("quanser-2dof-manual", outer="none", poles=NEAR))]
    for _ in range(150):
        pitch, yaw = -rng.uniform(3.0, 14.0, 2) + 1j * rng.uniform(0.0, 12.0, 2)
        poles = PoleSet([pitch, pitch.conjugate(), yaw, yaw.conjugate()])
        loops.append(loop_of(Spec.from_preset("quanser-2dof-manual", outer="none", poles=poles)))
    limited = 0
    for loop in loops:
        design, margin = loop.design, loop.lag_margin

        def largest(tau, design=design):
            """The real part of the rightmost pole, by NumPy, where both rotors lag by τ."""
            A = np.zeros((6, 6))
            A[:4, :4], A[:4, 4:] = design.plant.A, design.plant.B
            A[4:, :4], A[4:, 4:] = -design.K / tau, -np.eye(2) / tau
            return float(np.max(np.linalg.eigvals(A).real))

        below = np.geomspace(1e-4, 50.0 if margin is None else 0.999 * margin, 60)
        assert all(largest(tau) < 0.0 for tau in below), (loop.design.poles, margin)
        if margin is not None:
            limited += 1
            assert largest(1.001 * margin) > 0.0
    assert limited > 100
