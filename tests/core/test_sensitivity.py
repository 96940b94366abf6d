"""Disk margin and sensitivity peak against python-control, and against what they promise."""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest

from heli2dof_core import PRESETS, OuterLoop, PIGains, Spec, Weights, close_loop, design, place, plant, preset
from heli2dof_core.interpreted import peaks
from heli2dof_core.sensitivity import loop_sensitivity
from tests.core.random_loops import random_stable_loops
from tests.core.test_nonlinear_response import random_loops


def loop_of(name):
    spec = Spec.from_preset(preset(name))
    return close_loop(place(spec), spec.outer)


def opened(loop):
    """L(s) and S(s) at both motors, interconnected by python-control."""
    B = loop.motors
    C_u = -loop.voltage_from_state
    L = control.ss(loop.A + B @ C_u, B, C_u, np.zeros((2, 2)))
    return L, control.feedback(control.ss([], [], [], np.eye(2)), L)


@pytest.mark.parametrize("name", PRESETS)
def test_sensitivity_of_the_presets_is_python_controls(name):
    loop = loop_of(name)
    own = loop_sensitivity(loop)
    L, S = opened(loop)
    near = own.disk_frequency * np.geomspace(0.5, 2, 401)
    margin, gain, phase = control.disk_margins(L, near)
    assert own.disk_margin == pytest.approx(float(margin), rel=1e-4)  # on its grid
    assert own.disk_margin <= margin * (1 + 1e-9)
    assert 20 * np.log10(own.gain_range[1]) == pytest.approx(float(gain), rel=1e-3)
    assert np.degrees(own.phase) == pytest.approx(float(phase), rel=1e-4)
    assert own.peak == pytest.approx(float(control.system_norm(S, p="inf")), rel=1e-6)


def response(loop, frequencies):
    """S(jω) = I + ∂u/∂x (jω − A)⁻¹ B, shape (n, 2, 2)."""
    c = list(loop.connected)
    B = loop.motors[c]
    pencil = 1j * frequencies[:, None, None] * np.eye(len(c)) - loop.A[np.ix_(c, c)]
    return np.eye(2) + loop.voltage_from_state[:, c] @ np.linalg.solve(pencil, B)


def rises_above(loop, level):
    """Whether σ(S(jω)) meets `level` > 1: the Hamiltonian matrix has an eigenvalue on the axis (Boyd et al. 1989)."""
    c = list(loop.connected)
    A, C, R = loop.A[np.ix_(c, c)], loop.voltage_from_state[:, c], level**2 - 1
    B = loop.motors[c]
    drift = A + B @ C / R
    H = np.block([[drift, B @ B.T / R], [-(1 + 1 / R) * C.T @ C, -drift.T]])
    scale = np.sqrt(np.linalg.norm(C.T @ C) / np.linalg.norm(B @ B.T))  # balance between states and costates
    T = np.diag([scale**0.5] * len(c) + [scale**-0.5] * len(c))
    values = np.linalg.eigvals(T @ H @ np.linalg.inv(T))
    return bool(np.any(np.abs(values.real) < 1e-7 * np.abs(values)))


def structured(S):
    """μ of S − ½ for two scalars: the least largest singular value over diagonal scalings, on refined grids."""
    M, centre, width = S - np.eye(2) / 2, 0.0, 12.0
    for _ in range(4):
        scalings = np.exp(np.linspace(centre - width, centre + width, 61))
        scaled = M * np.array([[np.ones(61), scalings], [1 / scalings, np.ones(61)]]).transpose(2, 0, 1)
        norms = np.linalg.norm(scaled, 2, axis=(1, 2))
        centre, width = float(np.log(scalings[np.argmin(norms)])), width / 20
    return float(norms.min())


def test_sensitivity_peak_of_random_loops_is_the_infinity_norm():
    """S rises to just below the peak told and never above it, by a criterion without any frequency."""
    checked = 0
    for loop in random_stable_loops(300, seed=6, edges=True):
        own = loop_sensitivity(loop)
        assert own.peak >= 1
        if own.peak_frequency is not None:
            size = np.linalg.norm(response(loop, np.array([own.peak_frequency]))[0], 2)
            assert size == pytest.approx(own.peak, rel=1e-9)
        if own.peak > 1.01:
            assert not rises_above(loop, own.peak * (1 + 1e-5))
            checked += 1
        else:
            around = np.abs(loop.connected_poles)
            grid = np.geomspace(0.01 * around.min(), 1e4 * around.max(), 4000)
            assert np.linalg.norm(response(loop, grid), 2, axis=(1, 2)).max() <= own.peak * (1 + 1e-9)
    assert checked > 150


def test_disk_margin_of_random_loops_is_the_least_over_frequency():
    """Against the μ of a fine grid with μ by search over scalings where it is largest."""
    for loop in random_stable_loops(60, seed=8, edges=True):
        own = loop_sensitivity(loop)
        if own.disk_frequency is not None:
            S = response(loop, np.array([own.disk_frequency]))[0]
            assert 1 / own.disk_margin == pytest.approx(structured(S), rel=1e-4)
        poles = loop.connected_poles
        near = (np.abs(poles.imag)[:, None] + np.abs(poles)[:, None] * np.geomspace(1e-4, 3, 200)).ravel()
        near = np.concatenate([[0.0], near, np.geomspace(1e-3, 1e4, 2000) * np.max(np.abs(poles))])
        (a, b), (c, d) = (response(loop, near) - np.eye(2) / 2).transpose(1, 2, 0)
        beside = np.sqrt(np.abs(b * c))
        alike = np.array([[a, beside * np.exp(1j * np.angle(b))], [beside * np.exp(1j * np.angle(c)), d]])
        assert np.linalg.norm(alike, 2, axis=(0, 1)).max() <= 1 / own.disk_margin * (1 + 1e-9)


@pytest.mark.parametrize(
    ("poles", "outer", "peak"),
    [
        ([-12, -10, -9.25, -8.76], "none", 1.0000029),
        ([-7614 + 57081j, -7614 - 57081j] * 2, "none", 3.815),
        ([-1e-3 + 40j, -1e-3 - 40j, -3, -4], "none", None),
        ([-1e-5 + 40j, -1e-5 - 40j, -1e-5 + 41j, -1e-5 - 41j], "none", None),
    ],
)
def test_no_peak_is_missed_or_cut_off(poles, outer, peak):
    """Beyond the poles, in narrow resonances, and far out."""
    spec = Spec.from_preset(poles=poles, outer=outer)
    loop = close_loop(place(spec), spec.outer)
    own = loop_sensitivity(loop)
    if peak is not None:
        assert own.peak == pytest.approx(peak, rel=2e-4 if peak > 2 else 1e-7)
    pair = np.concatenate(
        [np.abs(loop.poles.imag) + x * np.abs(loop.poles.real) for x in np.linspace(-3, 3, 601)]
    )
    assert np.linalg.norm(response(loop, np.abs(pair)), 2, axis=(1, 2)).max() <= own.peak * (1 + 1e-6)
    if 1.01 < own.peak < 1e4:
        assert not rises_above(loop, own.peak * (1 + 1e-4))


def test_a_maximum_is_refined_in_few_steps_whatever_the_interval(monkeypatch):
    """Golden section would take 29 steps each; where rounding decides between neighbouring floats, it ends too."""
    sizes, size = [], peaks.frequency_gain

    def counted(*arguments):
        sizes.append(arguments)
        return size(*arguments)

    monkeypatch.setattr(peaks, "frequency_gain", counted)
    f, rng, steps = loop_of(next(iter(PRESETS))).polynomials, np.random.default_rng(10), []
    for w in 10 ** rng.uniform(-6, 6, 100):
        for width in (0, 1e-16, 1e-15, 1e-12, 1e-6, 1.0, 1e4):
            for low, high, tail in ((w, w + w * width, False), (-w - w * width, -w, True), (-w, 0.0, True)):
                sizes.clear()
                top, _ = peaks.brent_maximum(f, low, high, tail, False)
                steps.append(len(sizes))
                middle = low + 0.5 * (high - low)
                assert top >= size(f, -1 / middle if tail else middle, False) - 1e-6
    assert max(steps) < 40 and np.median(steps) < 25


def test_where_only_infinity_reaches_one_no_frequency_is_named():
    """LQR with R = I: no singular value of S is above 1 (Kalman's inequality)."""
    plain = Weights((1.0, 1.0, 0.1, 0.1), (1.0, 1.0))
    spec = replace(Spec.from_preset(outer="none"), method="lqr", weights=plain)
    own = loop_sensitivity(close_loop(place(spec), spec.outer))
    assert own.peak == 1 and own.peak_frequency is None


def test_gains_within_the_disk_margin_keep_the_loop_stable_and_one_beyond_all_directions_does_not():
    """Both motors' gains scaled at once, to every corner of the guaranteed range."""
    for loop, _ in random_loops(25, seed=7):
        own = loop_sensitivity(loop)
        low, high = own.gain_range
        n = len(loop.A)
        B = np.zeros((n, 2))
        B[:4] = loop.design.plant.B
        C_u = -loop.voltage_from_state
        opened_A = loop.A + B @ C_u
        top = 100.0 if high is None else high
        for corner in ((low, low), (low, top), (top, low), (top, top)):
            factors = 1 + (np.array(corner) - 1) * 0.999
            closed = opened_A - B @ np.diag(factors) @ C_u
            assert np.max(np.linalg.eigvals(closed).real) < 1e-9


def test_an_unstable_loop_has_no_margin():
    slow = design(plant(preset().parameters), preset().poles.dealt([-3, -2, -3, -2], [[0, 1], [2, 3]]))
    loop = close_loop(slow, OuterLoop(pitch=PIGains(30, 0.1), yaw=PIGains(30, 0.1)))
    assert not loop.stable
    assert loop_sensitivity(loop) is None


def test_effort_and_itae_are_the_integrals_that_they_say(spec):
    from heli2dof_core import evaluate

    fine = replace(
        spec, scenario=replace(spec.scenario, samples=20_001)
    )  # for the sums; the figures need no samples
    report = evaluate(fine, each_axis=True)
    step = report.axis_steps["theta"]["nonlinear"]
    response, metrics = step.response, step.metrics
    t, dt = response.t, response.t[1]
    excess = response.voltages - report.design.plant.trim[:, None]
    simple = np.sum(0.5 * (excess[:, 1:] ** 2 + excess[:, :-1] ** 2) * dt, axis=1)
    assert metrics.motors["V_p"].effort == pytest.approx(simple[0], rel=1e-5)
    assert metrics.motors["V_y"].effort == pytest.approx(simple[1], rel=1e-5)
    error = t * np.abs(response.reference[0] - response.angles[0])
    assert metrics.axes["theta"].itae == pytest.approx(np.sum(0.5 * (error[1:] + error[:-1]) * dt), rel=1e-5)
