"""What an identification is held against: the part that was held out, whiteness, what the model leaves out."""

from __future__ import annotations

import statistics
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import solve_ivp

from heli2dof_core.errors import InvalidInputError, RecordingError
from heli2dof_core.recordings.identification import HELD_OUT, IDENTIFIABLE, identify
from heli2dof_core.recordings.inertias import by_inertias
from heli2dof_core.recordings.model_errors import bias_of
from heli2dof_core.recordings.recording import Recording
from heli2dof_core.recordings.validation import agreement, nrmse_fit, split_at, variance_accounted
from heli2dof_core.recordings.whiteness import BAND, LAGS, whiteness
from heli2dof_core.scenario import Digital
from heli2dof_core.simulation.recorded import run_held
from tests.bench.actuated import Actuated
from tests.bench.unmodelled import counted, found
from tests.core.test_identification import made

NOISY = Digital(encoders=(0, 0), rates="true", noise=1e-3, sample_time=0.005)


@pytest.fixture(scope="module")
def noisy():
    spec, _, rig, _, recording = made(duration=12.0, digital=NOISY)
    return spec, rig, recording, identify(spec.parameters, recording, held_out=HELD_OUT)


def test_what_is_held_out_is_not_fitted(noisy):
    """The same is found where the end was never recorded."""
    spec, _, recording, result = noisy
    row = split_at(recording, HELD_OUT)
    assert row is not None and abs(recording.t[row] - 8.0) < 0.01
    first = Recording(recording.t[:row], recording.angles[:row], recording.voltages[:row])
    alone = identify(spec.parameters, first)
    for one, other in zip(result.estimates, alone.estimates, strict=True):
        assert one.value == pytest.approx(other.value, rel=1e-6)
        assert one.noise == pytest.approx(other.noise, rel=1e-3)
    assert np.all(result.residuals[row:] == 0)
    assert np.max(result.segments) <= row


def test_both_parts_are_told_before_and_after(noisy):
    _, _, recording, result = noisy
    fitted, held = result.parts
    assert fitted.end < held.first
    assert held.end == recording.t[-1]
    for part in result.parts:
        assert part.before is not None
        for axis in range(2):
            assert part.after.fit[axis] > 98 > part.before.fit[axis]
            assert part.after.variance[axis] > 99.9
            assert part.after.rms[axis] == pytest.approx(1e-3, rel=0.1)
    rows = np.isfinite(result.after[:, 0])
    assert np.mean(rows) > 0.99
    left = recording.angles[rows] - result.after[rows]
    assert np.sqrt(np.mean(left**2)) == pytest.approx(1e-3, rel=0.1)
    assert all(axis.white for axis in result.whiteness)
    assert {f.code for f in result.findings}.isdisjoint({"pitch_not_validated", "yaw_not_validated"})


def test_a_rig_that_changes_is_not_validated(noisy):
    """Thrust falls by a tenth where the held-out part begins: seen, and the intervals grow by it."""
    spec, _, recording, result = noisy
    row = split_at(recording, HELD_OUT)
    weaker = recording.voltages.copy()
    weaker[row:] /= 0.9  # what is recorded is more than what acted
    changed = identify(spec.parameters, replace(recording, voltages=weaker), held_out=HELD_OUT)
    assert {f.code for f in changed.findings} >= {"pitch_not_validated", "yaw_not_validated"}
    for one, other in zip(changed.estimates, result.estimates, strict=True):
        if one.name in {"K_pp", "K_yy"}:
            assert one.value == pytest.approx(other.value, rel=1e-6)
            assert one.high - one.low > 1.2 * 0.05 * abs(one.value) > other.high - other.low


def test_figures_of_agreement():
    """By their definitions, with Python's own statistics."""
    rng = np.random.default_rng(2)
    y, left = rng.normal(3.0, 2.0, (50, 2)), rng.normal(0.1, 0.3, (50, 2))
    bounds = np.array([[0, 20], [30, 50]])
    own = agreement(y, left, bounds)
    rows = [*range(20), *range(30, 50)]
    for axis in range(2):
        ys, es = y[rows, axis].tolist(), left[rows, axis].tolist()
        assert own.variance[axis] == pytest.approx(
            100 * (1 - statistics.pvariance(es) / statistics.pvariance(ys))
        )
        mean = statistics.fmean(e * e for e in es)
        assert own.rms[axis] == pytest.approx(mean**0.5)
        assert own.fit[axis] == pytest.approx(100 * (1 - (mean / statistics.pvariance(ys)) ** 0.5))
    assert nrmse_fit(np.ones(3), np.zeros(3)) is variance_accounted(np.ones(3), np.zeros(3)) is None


def test_too_little_to_be_held_out():
    spec, _, _, _, recording = made(duration=4.0, digital=NOISY)
    result = identify(spec.parameters, recording, held_out=0.01)
    assert len(result.parts) == 1
    assert "nothing_held_out" in {f.code for f in result.findings}
    assert "nothing_held_out" not in {f.code for f in identify(spec.parameters, recording).findings}
    for wrong in (-0.1, 0.9, float("nan")):
        with pytest.raises(InvalidInputError, match="held_out"):
            identify(spec.parameters, recording, held_out=wrong)
    few = Recording(recording.t[:40], recording.angles[:40], recording.voltages[:40])
    with pytest.raises(RecordingError, match="held out"):
        identify(spec.parameters, few, held_out=0.8)


def test_the_band_of_white_residuals():
    assert stats.norm.ppf(0.995) == pytest.approx(BAND, abs=1e-6)
    rng, n = np.random.default_rng(4), 800
    inside = []
    for _ in range(60):
        for axis in whiteness(np.array([[0, n]]), rng.standard_normal((n, 2)), np.zeros((n, 2, 1))):
            assert axis.band == pytest.approx(BAND / n**0.5)
            inside += (np.abs(axis.correlations) < axis.band).tolist()
    assert len(inside) == 120 * LAGS
    assert np.mean(inside) == pytest.approx(0.99, abs=0.005)


def test_bias_is_that_of_a_normal_law_given_the_residuals():
    """Amplitudes' mean and covariance by the other way: Λxᵀ(xΛxᵀ + σ²I)⁻¹r, of rows instead of shapes."""
    rng = np.random.default_rng(6)
    rows, likely, noise = 60, [0.5, 0.0, 2.0], 0.3
    J = rng.standard_normal((rows, 2, 2))
    shapes = [rng.standard_normal((rows, 2)) for _ in likely]
    responses, residuals = rng.standard_normal((rows, 3)), rng.standard_normal(rows)
    bias, spread = bias_of(J, shapes, likely, responses=responses, residuals=residuals, noise=noise)
    kept = [0, 2]
    prior, x = np.diag(np.array(likely)[kept] ** 2), responses[:, kept]
    gain = prior @ x.T @ np.linalg.inv(x @ prior @ x.T + noise**2 * np.eye(rows))
    amplitudes, covariance = gain @ residuals, prior - gain @ x @ prior
    G = np.linalg.pinv(J.reshape(-1, 2)) @ np.column_stack([shapes[i].ravel() for i in kept])
    more = np.abs(G) @ (amplitudes**2 / np.array(likely)[kept])
    np.testing.assert_allclose(bias, np.abs(G @ amplitudes) + more, rtol=1e-9)
    np.testing.assert_allclose(spread, G @ covariance @ G.T, rtol=1e-9)


@pytest.mark.parametrize(
    "case",
    [
        Actuated(tau=(0.03, 0.06), coulomb=(0.0, 0.0), duration=9.0),
        Actuated(tau=(1e-3, 1e-3), coulomb=(0.02, 0.05), duration=12.0),
    ],
    ids=["lag", "friction"],
)
def test_intervals_hold_the_truth_where_the_model_leaves_something_out(case):
    """Those of noise alone do not. More cases, and where this ends, are the bench's."""
    runs = 3
    rows = counted([found(case, seed) for seed in range(40, 40 + runs)])
    total = runs * len(rows)
    assert sum(row[1] for row in rows) >= 0.95 * total
    assert sum(row[2] for row in rows) < 0.8 * total


def rhs(_t, y, p, volts):
    """The rig's equations, written out (theory: section 1)."""
    theta, _, theta_dot, psi_dot = y
    s, c, ml2 = np.sin(theta), np.cos(theta), p.m * p.l**2
    pitch = p.K_pp * volts[0] + p.K_py * volts[1] - p.B_p * theta_dot - p.m * p.g * p.l * c
    pitch -= p.K_s * theta + ml2 * psi_dot**2 * s * c
    yaw = p.K_yp * volts[0] + p.K_yy * volts[1] - p.B_y * psi_dot + 2 * ml2 * psi_dot * theta_dot * s * c
    return [theta_dot, psi_dot, pitch / (p.J_p + ml2), yaw / (p.J_y + ml2 * c * c)]


def test_derivatives_by_inertias():
    """Against SciPy's DOP853 on equations written out here."""
    _, _, rig, _, recording = made(
        "quanser-2dof-manual", duration=2.0, digital=replace(NOISY, sample_time=0.05)
    )
    t, volts, start = recording.t, recording.voltages, np.array([0.1, -0.2, 0.4, -0.5])

    def course(p):
        rows, y = [start], start
        for k in range(len(t) - 1):
            y = solve_ivp(rhs, t[k : k + 2], y, "DOP853", args=(p, volts[k]), rtol=1e-11, atol=1e-12).y[:, -1]
            rows.append(y)
        return np.array(rows)[:, :2]

    bounds = np.array([[0, len(t)]])
    found = by_inertias(
        ["J_p", "J_y"],
        rig,
        start[None],
        bounds,
        t=t,
        volts=volts,
        step=0.005,
        rotors=None,
        wanted=lambda: None,
    )
    for i, name in enumerate(("J_p", "J_y")):
        h = 1e-3 * getattr(rig, name)
        sides = [
            course(SimpleNamespace(**{**rig.as_dict(), name: getattr(rig, name) + s * h})) for s in (1, -1)
        ]
        numeric = (sides[0] - sides[1]) / (2 * h)
        np.testing.assert_allclose(found[:, :, i], numeric, atol=3e-5 * np.max(np.abs(numeric)))


@pytest.mark.parametrize("free", [("J_p",), ("K_pp", "B_p", "J_p"), (*IDENTIFIABLE[:6], "J_p", "J_y")])
def test_exact_recordings_give_inertias_too(free):
    _, _, rig, own, recording = made(duration=6.0)
    rig = rig.replaced({"J_p": 1.3 * rig.J_p, "J_y": 0.8 * rig.J_y})
    thought = rig.replaced({name: 1.1 * getattr(rig, name) for name in free})
    states = run_held(rig, own.states[0, :4], recording.t, own.voltages, None)
    result = identify(thought, Recording(recording.t, states[:, :2], own.voltages), free)
    for e in result.estimates:
        assert e.value == pytest.approx(getattr(rig, e.name), rel=2e-3), e.name
    assert max(result.rms) < 1e-5


def test_an_inertia_that_scales_with_all_that_is_free_is_refused(noisy):
    """Pitch rests at level: of yaw the motion shows K/(J_y + m l²) and B_y/(J_y + m l²) alone."""
    spec, _, _, _ = noisy
    rig = spec.parameters.replaced({"K_py": 0.0, "K_yp": 0.02})
    t = np.arange(800, dtype=np.float64) / 100
    volts = np.column_stack([np.full(800, rig.m * rig.g * rig.l / rig.K_pp), 3 * np.sign(np.sin(2 * t))])
    states = run_held(rig, np.zeros(4), t, volts, None)
    assert np.max(np.abs(states[:, 0])) < 1e-9
    recording = Recording(t, states[:, :2], volts)
    with pytest.raises(RecordingError, match="apart") as refused:
        identify(rig, recording, ("K_yp", "K_yy", "B_y", "J_y"))
    assert "K_yy/(J_y + m l²)" in refused.value.hint
    held = identify(rig, recording, ("K_yp", "B_y", "J_y"))
    assert held.estimates[-1].value == pytest.approx(rig.J_y, rel=1e-3)


def test_an_inertia_that_is_hardly_told_is_said_to_be_a_ratio(noisy):
    spec, _, recording, _ = noisy
    result = identify(spec.parameters, recording, (*IDENTIFIABLE[:6], "J_y"))
    words = {f.code: f.message for f in result.findings}["only_ratios"]
    assert "J_y is known to ±" in words
    assert "K_yy/(J_y + m l²)" in words
    assert "only_ratios" not in {
        f.code for f in identify(spec.parameters, recording, ("K_yp", "B_y", "J_y")).findings
    }
