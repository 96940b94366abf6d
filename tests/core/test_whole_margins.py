"""Margins, stability and lag margin of loops with rotors and estimators, against python-control and eigenvalues."""

from __future__ import annotations

import control
import numpy as np
import pytest
from scipy.optimize import brentq

import heli2dof_core as heli
from heli2dof_core import Rotor, Rotors, Spec
from heli2dof_core.engine import engine
from heli2dof_core.kernels.layout import (
    DELAY_MARGIN,
    DISK_FREQUENCY,
    DISK_MARGIN,
    GAIN_MARGIN,
    MARGINS,
    PEAK_FREQUENCY,
    PHASE_MARGIN,
    SENSITIVITY,
    SENSITIVITY_PEAK,
)
from heli2dof_core.margins import loop_margins
from heli2dof_core.scratch import scratch
from heli2dof_core.sensitivity import loop_sensitivity
from tests.core.whole_loops import KINDS, random_whole_loops


def lagged(tau, **changes):
    return heli.loop_of(Spec.from_preset(**changes).changed(rotors=Rotors(Rotor(tau), Rotor(tau))))


def test_what_lag_does_is_what_the_theory_says():
    """Largest real parts of the whole loop and of the inner one alone, to every digit of the sheet."""
    whole = {0.05: -4.11, 0.1: -1.42, 0.156: -0.12, 0.1648: 0.00, 0.2: 0.36}
    inner = {0.05: -6.48, 0.1: -3.75, 0.156: -2.11, 0.165: -1.96, 0.2: -1.49}
    for known, outer in ((whole, "pi"), (inner, "none")):
        for tau, largest in known.items():
            assert (
                f"{lagged(tau, outer=outer).poles[0].real + 0.0:.2f}".replace("-0.00", "0.00")
                == f"{largest:.2f}"
            )
    assert f"{heli.loop_of(Spec.from_preset()).poles[0].real:.2f}" == "-4.10"
    assert f"{heli.loop_of(Spec.from_preset(outer='none')).poles[0].real:.2f}" == "-8.76"
    margin = heli.loop_of(Spec.from_preset()).lag_margin
    assert margin is not None and f"{margin:.4f}" == "0.1648"
    assert lagged(0.2).lag_margin == pytest.approx(
        margin, rel=1e-12
    )  # of the design, whatever its rotors are
    assert lagged(0.9999 * margin).stable and not lagged(1.0001 * margin).stable


def test_stability_is_that_of_the_eigenvalues():
    for loop in random_whole_loops(150, 3, stable=False):
        largest = np.max(loop.connected_poles.real)
        if abs(largest) > 1e-6 * np.max(np.abs(loop.connected_poles)):
            assert loop.stable == bool(largest < 0)


def first_instability(loop, start):
    """By eigenvalues: the least τ that a scan in steps of 1 % finds, bisected."""

    def stable(tau):
        return np.max(np.linalg.eigvals(loop.with_lags([tau, tau]).closed()[0]).real) < 0

    grid = np.geomspace(max(start, 1e-6), 1e4, 2400)
    first = next((i for i, tau in enumerate(grid) if not stable(tau)), None)
    if first in (None, 0):
        return np.inf if first is None else 0.0
    low, high = grid[first - 1], grid[first]
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return high


def test_lag_margin_is_where_eigenvalues_cross():
    """Three hundred loops of all kinds: states, filters, observers, rotors fed back."""
    worst, limited = 0.0, 0
    for loop in random_whole_loops(300, 4):
        start = 0.0 if not loop.K_v.any() else float(loop.tau.max())
        if not loop.with_lags([max(start, 1e-9)] * 2).stable:
            continue
        found = engine().lag_margin(loop.polynomials, start, scratch.lag)
        expected = first_instability(loop, start)
        if not np.isfinite(found) or found > 9e3:
            assert expected > 9e3
            continue
        limited += 1
        worst = max(worst, abs(found - expected) / expected)
    assert limited > 200
    assert worst < 1e-6


def response(model, w):
    """C (jωI − A)⁻¹ B of a state-space model at w, (n, outputs, inputs)."""
    A, B, C = (np.asarray(part) for part in (model.A, model.B, model.C))
    return C @ np.linalg.solve(1j * w[:, None, None] * np.eye(len(A)) - A, B.astype(complex))


def crossings(function, w):
    """Where a real function of ω changes its sign, by a grid and SciPy's brentq."""
    values = function(w)
    for k in np.nonzero(values[:-1] * values[1:] < 0)[0]:
        yield brentq(lambda x: float(function(np.array([x]))[0]), w[k], w[k + 1], rtol=1e-13)


@pytest.mark.parametrize("kind", KINDS)
def test_margins_are_those_of_the_frequency_response(kind):
    """Of each motor's loop, the other closed: python-control's state-space model, SciPy's root finder."""
    for loop in random_whole_loops(12, 5, (kind,)):
        table, fastest = np.empty((2, MARGINS)), np.max(np.abs(loop.connected_poles))
        engine().margins(loop.polynomials, *scratch.margins, table)
        w = np.geomspace(1e-5 * fastest, 1e2 * fastest, 6000)
        for motor in range(2):
            opened, own = loop.opened(motor), table[motor]
            lags, gains = [], []
            for x in crossings(lambda w, L=opened: np.abs(response(L, w)[:, 0, 0]) - 1.0, w):
                lag = np.angle(-response(opened, np.array([x]))[0, 0, 0]) % (2 * np.pi)
                lags.append((min(lag, 2 * np.pi - lag), lag / x))
            for x in crossings(lambda w, L=opened: response(L, w)[:, 0, 0].imag, w):
                L = response(opened, np.array([x]))[0, 0, 0].real
                gains += [-1 / L] if L < 0 else []
            expected = min(lags)[0] if lags else np.nan
            np.testing.assert_allclose(own[PHASE_MARGIN], expected, rtol=1e-6)
            np.testing.assert_allclose(
                own[DELAY_MARGIN], min(d for _, d in lags) if lags else np.nan, rtol=1e-6
            )
            above = [gain for gain in gains if gain > 1]
            if above:  # others are at ω = 0 or infinity
                assert own[GAIN_MARGIN] <= min(above) * (1 + 1e-6)
            if own[GAIN_MARGIN] == own[GAIN_MARGIN]:
                at_zero = -1 / response(opened, np.array([1e-9 * fastest]))[0, 0, 0].real
                known = [*above, *([at_zero] if at_zero > 1 else [])]
                assert min(abs(own[GAIN_MARGIN] / gain - 1) for gain in known) < 1e-5


@pytest.mark.parametrize("kind", KINDS)
def test_sensitivity_and_disk_margin_are_the_largest_over_frequency(kind):
    for loop in random_whole_loops(12, 6, (kind,)):
        both, fastest = np.empty(SENSITIVITY), np.max(np.abs(loop.connected_poles))
        engine().sensitivity_peaks(loop.polynomials, loop.connected_poles, scratch.sensitivity, both)
        A, B, C, _ = loop.closed()
        closed = control.ss(A, B, C, np.zeros((2, 2)))
        beside = np.linspace(-3.0, 3.0, 301)
        near = [abs(p.imag) + beside * abs(p.real) for p in loop.connected_poles]
        w = np.concatenate((np.geomspace(1e-4 * fastest, 1e2 * fastest, 2000), *near))
        w = np.unique(w[w > 0])

        def peak(w, model=closed):
            return np.linalg.svd(np.eye(2) + response(model, w), compute_uv=False)[:, 0]

        def size(w, model=closed):
            S = response(model, w) + 0.5 * np.eye(2)
            a, off, d = S[:, 0, 0], np.sqrt(np.abs(S[:, 0, 1] * S[:, 1, 0])), S[:, 1, 1]
            turn = np.exp(1j * np.angle(S[:, 0, 1] * S[:, 1, 0]))
            scaled = np.stack([np.stack([a, off + 0j], -1), np.stack([off * turn, d], -1)], -2)
            return np.linalg.svd(scaled, compute_uv=False)[:, 0]

        for function, value, at, least in (
            (peak, both[SENSITIVITY_PEAK], both[PEAK_FREQUENCY], 1.0),
            (size, 1.0 / both[DISK_MARGIN], both[DISK_FREQUENCY], 0.5),
        ):
            assert value >= np.max(function(w)) * (1 - 1e-6)  # nothing is higher
            there = function(np.array([at]))[0] if np.isfinite(at) else least
            assert value == pytest.approx(there, rel=1e-6)  # and there it is as high


@pytest.mark.parametrize("measured", ["states", "filtered", "observer"])
@pytest.mark.parametrize("place", [False, True])
def test_loops_and_their_polynomials_agree(measured, place):
    """The loop's own state matrix has the roots of its polynomial; margins exist and shrink with an observer."""
    spec = Spec.from_preset(poles=[-4, -5, -3 + 2j, -3 - 2j], pitch=(5, 0.8), yaw=(5, 0.8)).changed(
        rotors=Rotors(Rotor(0.08), Rotor(0.05)), place_rotors=place, rotor_poles=(-12, -13), measured=measured
    )
    loop = heli.loop_of(spec)
    coefficients = loop.polynomials[0, 0]
    for pole in loop.poles:
        value = np.polyval(coefficients[::-1], pole)
        assert abs(value) < 1e-7 * np.polyval(np.abs(coefficients[::-1]), abs(pole))
    assert loop.stable == bool(loop.poles[0].real < 0)
    assert loop_margins(loop) is not None and loop_sensitivity(loop) is not None


def test_what_hardly_lags_has_the_papers_margins():
    """τ → 0: margins, sensitivity and disk margin tend to those of the rig without rotors."""
    own, near = heli.loop_of(Spec.from_preset()), lagged(1e-9)
    for a, b in zip(loop_margins(own), loop_margins(near), strict=True):
        for name, value in vars(a).items():
            assert getattr(b, name) == pytest.approx(value, rel=1e-5) if value is not None else True
    assert loop_sensitivity(near).disk_margin == pytest.approx(loop_sensitivity(own).disk_margin, rel=1e-6)


def test_separation_holds_and_margins_do_not():
    """Poles of A − BK and of A − LC together to 1e-9; the disk margin shrinks (Doyle 1978)."""
    spec = Spec.from_preset(outer="none")
    plain, estimated = heli.loop_of(spec), heli.loop_of(spec.changed(measured="observer"))
    expected = [*plain.design.closed_loop_poles, *estimated.estimator.poles]
    assert heli.pole_error(expected, estimated.poles) < 1e-9 * np.max(np.abs(expected))
    assert loop_sensitivity(estimated).disk_margin < 0.9 * loop_sensitivity(plain).disk_margin
