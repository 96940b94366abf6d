"""Identification: derivatives, overlays and intervals against what is known of synthetic recordings."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

from heli2dof_core import OuterLoop, PoleSet, Spec, close_loop, place, preset
from heli2dof_core.errors import CancelledError, InvalidInputError, RecordingError
from heli2dof_core.recordings.covariance import (
    grouped_covariance,
    groups_of,
    plain_covariance,
    student_quantile,
)
from heli2dof_core.recordings.identification import IDENTIFIABLE, identify
from heli2dof_core.recordings.overlay import (
    driven_by_references,
    driven_by_voltages,
    driven_in_segments,
    nrmse_fit,
)
from heli2dof_core.recordings.recording import Recording
from heli2dof_core.recordings.samples import deviating_rig, reference_steps, sample_recording
from heli2dof_core.recordings.segments import bridged, cut, fit_of, segment_length
from heli2dof_core.rotors import Rotors
from heli2dof_core.scenario import Digital, Limits, Scenario
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.recorded import run_held, run_recorder, run_segments
from tests.bench.identification import MANUAL, Case, run

EXACT = Digital(encoders=(0, 0), rates="true")


def made(name="quanser-2dof-manual", duration=8.0, deviation=0.1, digital=EXACT, seed=1):
    base = preset(name)
    spec = Spec.from_preset(base, rotors=Rotors())
    loop = close_loop(place(spec), spec.outer)
    rig = deviating_rig(spec.parameters, deviation, seed)
    size = (abs(base.scenario.theta or 0), abs(base.scenario.psi or 0))
    own = sample_recording(loop, spec.limits, digital, rig=rig, duration=duration, size=size)
    return spec, loop, rig, own, Recording(own.t, own.measured, own.voltages, own.references)


@pytest.mark.parametrize("noise", [0.0, 1e-3])
def test_the_recorder_is_the_digital_rig(noise):
    """Under constant references, to the integrator's tolerance, encoders, filters and delay included."""
    spec, loop, *_ = made()
    digital = Digital(sample_time=0.005, delay=True, noise=noise, seed=3)
    scenario = Scenario(theta=0.1, psi=0.3, duration=2.0, samples=401, digital=digital, rtol=1e-10)
    own = run_recorder(loop, spec.limits, digital, np.tile([0.1, 0.3], (401, 1)))
    other = simulate_digital(loop, spec.limits, scenario, digital)
    np.testing.assert_allclose(own.states[:, :2].T, other.angles, atol=1e-6)
    assert np.max(np.abs(own.measured - own.states[:, :2])) > 1e-4


def test_held_voltages_lead_where_the_recorder_went():
    """An integrator of another kind; stops are met, too."""
    _, _, rig, own, recording = made(duration=4.0)
    states = run_held(rig, own.states[0, :4], own.t, own.voltages, None)
    np.testing.assert_allclose(states[:, :2], own.states[:, :2], atol=2e-5)
    fallen = run_held(rig, np.zeros(4), recording.t, np.zeros_like(own.voltages), 0.3)
    assert fallen[-1, 0] == -0.3
    assert fallen[-1, 2] == 0.0
    assert np.min(fallen[:, 0]) >= -0.3


@pytest.mark.parametrize("name", ["quanser-2dof-manual", "quanser-aero-2"])
def test_sensitivities_are_derivatives(name):
    _, _, rig, own, recording = made(name, duration=2.0)
    start, bounds = own.states[:1, :4].copy(), np.array([[0, len(own.t)]])
    start[0, 2:] = 0.3, -0.4

    def angles(deltas):
        p = SimpleNamespace(**rig.as_dict(), alpha=rig.alpha)
        for parameter, delta in zip(IDENTIFIABLE, deltas[4:], strict=True):
            setattr(p, parameter, getattr(p, parameter) + delta)
        return run_segments(p, start + deltas[:4], bounds, recording.t, recording.voltages, step=0.01)

    slopes = angles(np.zeros(11))[1]
    for i in range(11):
        size = 1e-5 * (abs(getattr(rig, IDENTIFIABLE[i - 4])) + 1e-3) if i >= 4 else 1e-5
        step = size * np.eye(11)[i]
        numeric = (angles(step)[0] - angles(-step)[0]) / (2 * size)
        np.testing.assert_allclose(slopes[:, :, i], numeric, atol=1e-5 * (1e-9 + np.max(np.abs(numeric))))


@pytest.mark.parametrize("name", ["quanser-2dof-manual", "quanser-aero-2"])
def test_exact_recordings_give_the_rig_exactly(name):
    spec, _, rig, _, recording = made(name, deviation=0.2)
    found = identify(spec.parameters, recording, travel=spec.limits.theta)
    for estimate in found.estimates:
        assert estimate.value == pytest.approx(getattr(rig, estimate.name), rel=2e-4)
    assert max(found.rms) < 1e-5 < max(found.rms_before)
    assert found.parameters == spec.parameters.replaced({e.name: e.value for e in found.estimates})


def test_the_truth_lies_near_as_the_intervals_say():
    """Not three half widths away, and they say something; how often it lies inside is counted by the bench."""
    rig, found = run(Case(MANUAL, duration=6.0, sample_time=0.008), 200)
    for e in found.estimates:
        half = (e.high - e.low) / 2
        assert half < 0.1 * abs(e.value) + 1e-3
        assert abs(e.value - getattr(rig, e.name)) < 3 * half


def test_rounding_without_noise_is_told():
    """It is no noise: the intervals are then too narrow."""
    unseen = {"yaw_dead_band_unseen"}  # its voltage passes 0 on this rig
    codes = {f.code for f in run(Case(MANUAL, 0.0, 6.0, 0.004), 1)[1].findings}
    assert codes >= {"coarse_pitch_encoder", "coarse_yaw_encoder"}
    assert {f.code for f in run(Case(MANUAL, 1e-3, 6.0, 0.004), 1)[1].findings} <= unseen


def test_correlated_residuals_widen_the_intervals():
    """A mean of an AR(1) series: σ²/n (1 + ρ)/(1 − ρ), which the plain covariance underrates ninefold."""
    rng, n, rho = np.random.default_rng(0), 40_000, 0.8
    noise = np.empty((n, 1))
    last = 0.0
    for k, e in enumerate(rng.standard_normal(n)):
        last = rho * last + e
        noise[k] = last
    J = np.ones((n, 1, 1))
    variance = 1 / (1 - rho**2)
    truth = variance / n * (1 + rho) / (1 - rho)
    groups = groups_of(np.array([[0, n]]))
    assert len(groups) == 20
    means = [
        np.mean(grouped_covariance(J, np.roll(noise, shift, axis=0), groups)) for shift in range(0, 2000, 100)
    ]
    assert np.mean(means) == pytest.approx(truth, rel=0.3)
    assert plain_covariance(J, noise, 1)[0, 0] == pytest.approx(variance / n, rel=0.1)
    white = [np.mean(grouped_covariance(J, rng.standard_normal((n, 1)), groups)) for _ in range(40)]
    assert np.mean(white) == pytest.approx(1 / n, rel=0.15)


def test_for_white_residuals_the_intervals_are_unbiased():
    """Groups within segments whose starting states were fitted: the mean of many draws is σ²(JᵀJ)⁻¹."""
    rng = np.random.default_rng(3)
    bounds, rows = np.array([[0, 60], [60, 120]]), 120
    J, starts = rng.standard_normal((rows, 2, 3)).cumsum(axis=0), np.zeros((rows, 2, 4))
    for a, b in bounds.tolist():
        Q, _ = np.linalg.qr(np.vander(np.arange(2 * (b - a)), 4).astype(float))
        starts[a:b] = Q.reshape(b - a, 2, 4)
        part = J[a:b].reshape(-1, 3)
        J[a:b] = (part - Q @ (Q.T @ part)).reshape(b - a, 2, 3)
    A, groups = J.reshape(-1, 3), groups_of(bounds)
    total = np.zeros((3, 3))
    for _ in range(300):
        r = rng.standard_normal((rows, 2))
        for a, b in bounds.tolist():
            Q, own = starts[a:b].reshape(-1, 4), r[a:b].ravel()
            r[a:b] = (own - Q @ (Q.T @ own)).reshape(-1, 2)
        r = (r.ravel() - A @ np.linalg.lstsq(A, r.ravel(), rcond=None)[0]).reshape(rows, 2)
        total += grouped_covariance(J, r, groups, starts) / 300
    np.testing.assert_allclose(np.diag(total), np.diag(np.linalg.inv(A.T @ A)), rtol=0.15)


@pytest.mark.parametrize("freedom", [1, 5, 10, 11, 20, 100])
def test_students_quantiles_are_scipys(freedom):
    assert student_quantile(freedom) == pytest.approx(stats.t.ppf(0.975, freedom), abs=3e-3)


def test_fit_is_matlabs():
    y = np.array([0.0, 1.0, 2.0, 3.0])
    assert nrmse_fit(y, y) == 100
    assert nrmse_fit(y, np.full(4, 1.5)) == pytest.approx(0)
    assert nrmse_fit(y, y + 0.5) == pytest.approx(100 * (1 - 1.0 / np.sqrt(5)))
    assert nrmse_fit(np.ones(4), y) is None


def test_overlays_fit_the_rig_that_was_recorded():
    spec, loop, rig, _, recording = made(duration=6.0)
    assert min(driven_by_voltages(rig, recording).fit) > 99  # pyright: ignore[reportArgumentType]
    right, wrong = driven_in_segments(rig, recording), driven_in_segments(spec.parameters, recording)
    assert min(right.fit) > 99.9 > max(wrong.fit)  # pyright: ignore[reportArgumentType]
    assert len(right.segments) > 1
    _, loop, _, _, recording = made(duration=6.0, deviation=0.0)
    under = driven_by_references(loop, spec.limits, recording)
    assert min(under.fit) > 99  # pyright: ignore[reportArgumentType]
    np.testing.assert_allclose(under.voltages, recording.voltages, atol=0.3)
    with pytest.raises(RecordingError, match="references"):
        driven_by_references(loop, spec.limits, replace(recording, references=None))


def test_bumpless_start_in_the_middle_of_a_run():
    """The integrals start so that the first voltages are the recorded ones."""
    spec, loop, _, _, recording = made(duration=6.0, deviation=0.0)
    t, y, v, r = (
        part[1000:] for part in (recording.t, recording.angles, recording.voltages, recording.references)
    )
    late = Recording(t - t[0], y, v, r)
    under = driven_by_references(loop, spec.limits, late)
    np.testing.assert_allclose(under.voltages[0], late.voltages[0], atol=0.05)
    assert min(under.fit) > 97  # pyright: ignore[reportArgumentType]


def test_segments_avoid_the_stops_and_what_grows():
    _, _, rig, _, recording = made(duration=6.0)
    assert 0.5 < segment_length(rig, recording) < 6
    aero = Spec.from_preset(preset("quanser-aero-2")).parameters
    assert segment_length(aero, recording) == recording.t[-1]
    angles = recording.angles.copy()
    angles[500:1500, 0] = -0.7
    bounds = cut(replace(recording, angles=angles), 2.0, 0.705)
    assert all(end <= 500 or first >= 1500 for first, end in bounds.tolist())
    with pytest.raises(RecordingError, match="stops"):
        cut(replace(recording, angles=np.full_like(angles, -0.7)), 2.0, 0.7)


def holed(recording, kept):
    return Recording(recording.t[kept], recording.angles[kept], recording.voltages[kept])


def test_a_segment_ends_at_a_gap_and_the_rig_is_found_across_gaps():
    spec, _, rig, _, recording = made(duration=8.0, deviation=0.2)
    t = recording.t
    gappy = holed(recording, ~(((t > 2) & (t < 2.3)) | ((t > 5) & (t < 6))))
    edges = np.flatnonzero(np.diff(gappy.t) > 0.1) + 1
    for bounds in (cut(gappy, 2.0, None), driven_by_voltages(rig, gappy).segments):
        assert not any(first < edge < end for edge in edges for first, end in bounds.tolist())
    assert min(driven_in_segments(rig, gappy).fit) > 99.9  # pyright: ignore[reportArgumentType]
    found = identify(spec.parameters, gappy)
    for estimate in found.estimates:
        assert estimate.value == pytest.approx(getattr(rig, estimate.name), rel=5e-4)


def test_missing_rows_are_bridged():
    """Voltages between rows that are there; where one leaps meanwhile, a new segment begins."""
    spec, _, rig, _, recording = made(duration=8.0, deviation=0.2)
    kept = np.random.default_rng(1).random(len(recording.t)) > 0.05
    kept[0] = True
    sparse = holed(recording, kept)
    wide = bridged(sparse)
    assert np.any(wide.voltages != sparse.voltages)
    naive, better = (run_segments_rms(rig, own, cut(wide, 1.0, None)) for own in (sparse, wide))
    assert better < 0.5 * naive
    for estimate in identify(spec.parameters, sparse).estimates:
        assert estimate.low <= getattr(
            rig, estimate.name
        ) <= estimate.high or estimate.value == pytest.approx(getattr(rig, estimate.name), rel=0.02)


def run_segments_rms(rig, recording, bounds):
    fitted = fit_of(rig, recording, bounds)
    return float(np.sqrt(np.mean(fitted.residuals**2)))


def with_band(band, soft, seed=0, duration=12.0):
    """A closed loop around a rig whose motors answer no voltage within ± `band`; full states are fed back."""
    base = preset("quanser-2dof-manual")
    spec = Spec.from_preset(base)
    loop = close_loop(place(spec), spec.outer)
    rig, step = deviating_rig(spec.parameters, 0.15, seed), 0.004
    references = reference_steps(duration, step, 0.2, 0.4, theta_0=spec.theta_0, seed=seed)
    x, z, rest = np.array([spec.theta_0, 0, 0, 0.0]), np.zeros(2), np.array([spec.theta_0, 0, 0, 0.0])
    seen, sent = np.empty((len(references), 2)), np.empty((len(references), 2))
    for k, wish in enumerate(references):
        u = loop.design.plant.trim + loop.voltage_from_state @ np.concatenate([x - rest, z])
        u = np.clip(u + loop.voltage_from_reference @ (wish - rest[:2]), -24, 24)
        seen[k], sent[k] = x[:2], u
        acting = np.where(np.abs(u) < band, 0.0, u - soft * band * np.sign(u))
        z = z + step * (wish - x[:2])
        x = run_held(rig, x, np.array([0.0, step]), np.array([acting, acting]), None)[1]
    noise = 1e-3 * np.random.default_rng(seed).standard_normal(seen.shape)
    return spec, Recording(step * np.arange(len(seen)), seen + noise, sent)


@pytest.mark.parametrize(
    ("band", "soft", "code"),
    [(0.0, 0, ""), (0.5, 1, "model_error"), (0.5, 0, "yaw_dead_band_unseen")],
)
def test_a_dead_band_is_told(band, soft, code):
    """What the residuals show is named; what they cannot show, though it would move the values, too."""
    spec, recording = with_band(band, soft)
    codes = {f.code for f in identify(spec.parameters, recording).findings}
    assert code in ("", *codes), codes
    assert ("model_error" in codes) <= (band > 0)


def test_correlated_noise_is_told():
    spec, recording = with_band(0.0, 0, seed=2)
    last, noise = np.zeros(2), np.empty_like(recording.angles)
    for k, e in enumerate(np.random.default_rng(1).standard_normal(noise.shape)):
        noise[k] = last = 0.97 * last + np.sqrt(1 - 0.97**2) * 1e-3 * e
    told = identify(spec.parameters, replace(recording, angles=recording.angles + noise)).findings
    said = {f.code: f.message for f in told}
    assert "in pitch and yaw are not white" in said["correlated_residuals"] and "model_error" not in said
    assert "correlated_residuals" not in {f.code for f in identify(spec.parameters, recording).findings}


@pytest.mark.parametrize("seed", [29, 36])
def test_slow_and_white_noise_together_are_no_model_error(seed):
    """A filter of first order leaves them correlated: in two of forty runs that looked like a dead band."""
    case = Case(MANUAL, 1e-3, 10.0, 0.004, encoders=False, rho=0.97, slow=1e-3)
    codes = {f.code for f in run(case, seed)[1].findings}
    assert "correlated_residuals" in codes and "model_error" not in codes


@pytest.mark.parametrize("change", ["volts", "time", "huge"])
def test_a_rig_that_runs_away_is_refused_wherever_it_is_simulated(change):
    spec, loop, _, _, recording = made(duration=2.0)
    wrong = {
        "volts": replace(recording, voltages=30 * recording.voltages),
        "time": replace(recording, t=900 * recording.t),
        "huge": replace(recording, angles=recording.angles + 5e8 * recording.t[:, None] ** 4),
    }[change]
    own = spec.parameters
    for simulate in (
        lambda: driven_by_voltages(own, wrong),
        lambda: driven_in_segments(own, wrong),
        lambda: driven_by_references(loop, spec.limits, wrong),
        lambda: identify(own, wrong, ["K_pp", "K_yy"], segment=4.0),
    ):
        try:
            result = simulate()
        except (RecordingError, InvalidInputError) as error:
            assert error.hint
        else:
            fit = getattr(result, "fit", (0.0,))
            assert all(v is None or np.isfinite(v) for v in fit)


def test_whoever_does_not_wait_ends_any_simulation():
    spec, loop, _, _, recording = made(duration=4.0)
    long = replace(recording, t=100 * recording.t)

    def leave():
        raise CancelledError("enough")

    for simulate in (
        lambda: driven_by_voltages(spec.parameters, long, wanted=leave),
        lambda: driven_in_segments(spec.parameters, long, wanted=leave),
        lambda: driven_by_references(loop, spec.limits, recording, wanted=leave),
        lambda: identify(spec.parameters, recording, wanted=leave),
    ):
        with pytest.raises(CancelledError):
            simulate()
    stiff = spec.parameters.replaced({"B_p": 10.0, "J_p": 1e-4, "m": 1e-3})
    with pytest.raises(RecordingError, match="steps"):
        driven_by_voltages(stiff, replace(recording, t=900 * recording.t))


def test_refusals():
    spec, _, _, _, recording = made(duration=3.0)
    for free in (["m"], []):
        with pytest.raises(InvalidInputError):
            identify(spec.parameters, recording, free)
    silent = replace(recording, voltages=np.zeros_like(recording.voltages))
    with pytest.raises(RecordingError, match="nothing about K_"):
        identify(spec.parameters, silent, ["K_pp", "B_p"])

    def stop(progress):
        raise CancelledError("enough")

    with pytest.raises(CancelledError):
        identify(spec.parameters, recording, report=stop)


def test_runaway_loops_are_not_recorded():
    base = Spec.from_preset(preset())
    spec = replace(base, poles=PoleSet([-3.0, -4.0, 1.0, 2.0]), outer=OuterLoop(outer="none"))
    loop = close_loop(place(spec), spec.outer)
    with pytest.raises(InvalidInputError, match="runs away"):
        sample_recording(loop, Limits(1e3, 1e3), EXACT, rig=spec.parameters, duration=30.0, size=(0.1, 0.1))


def test_steps_are_seeded_and_within():
    steps = reference_steps(20.0, 0.01, 0.2, 0.5, theta_0=0.1, seed=4)
    np.testing.assert_array_equal(steps, reference_steps(20.0, 0.01, 0.2, 0.5, theta_0=0.1, seed=4))
    assert np.all(np.abs(steps - [0.1, 0.0]) <= [0.2, 0.5])
    assert np.all(np.sum(np.diff(steps, axis=0) != 0, axis=0) >= 6)
