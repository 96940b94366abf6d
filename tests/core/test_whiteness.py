"""Ljung and Box's test of residuals: its false alarms where starting states were fitted, and what it finds."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats
from scipy.signal import lfilter

from heli2dof_core.recordings import whiteness as module
from heli2dof_core.recordings.whiteness import LAGS, autoregression, whiteness


def segments(count, length):
    """Bounds, and an orthonormal basis of four smooth courses of both axes in each."""
    t = np.linspace(-1, 1, length)
    own = np.array([[1 + 0 * t, 0 * t], [t, t**2], [t**2, np.exp(t)], [np.sin(3 * t), 1 + t]])
    Q, _ = np.linalg.qr(own.transpose(2, 1, 0).reshape(-1, 4))
    bounds = np.array([[i * length, (i + 1) * length] for i in range(count)])
    return bounds, np.tile(Q.reshape(length, 2, 4), (count, 1, 1))


def fitted(noise, bounds, basis):
    """What is left of noise when each segment's starting state follows it."""
    left = noise.copy()
    for a, b in bounds.tolist():
        Q = basis[a:b].reshape(-1, 4)
        left[a:b] -= (Q @ (Q.T @ left[a:b].ravel())).reshape(-1, 2)
    return left


def test_without_starting_states_it_is_the_textbooks():
    """Q of Ljung & Box, n (n + 2) Σ ρ_k²/(n − k), against χ², but for n + 2 in place of n."""
    rng, n = np.random.default_rng(5), 2000
    r = lfilter([1], [1, -0.05], rng.standard_normal((n, 2)), axis=0)
    for own, axis in zip(whiteness(np.array([[0, n]]), r, np.zeros((n, 2, 1))), r.T, strict=True):
        rho = np.array([axis[:-k] @ axis[k:] for k in range(1, LAGS + 1)]) / (axis @ axis)
        Q = n * (n + 2) * np.sum(rho**2 / (n - np.arange(1, LAGS + 1)))
        np.testing.assert_allclose(own.correlations, rho, atol=1e-12)
        assert own.probability == pytest.approx(stats.chi2.sf(Q * n / (n + 2), LAGS), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("count", "length"), [(8, 400), (12, 250), (30, 80)])
def test_white_noise_is_rarely_said_to_be_correlated(count, length):
    """At 5 % and at 0.1 %; left out of account, the starting states make 7, 15 and 65 % of the 5 %."""
    bounds, basis = segments(count, length)
    rng, chances = np.random.default_rng(length), []
    for _ in range(200):
        noise = fitted(rng.standard_normal((count * length, 2)), bounds, basis)
        chances += [axis.probability for axis in whiteness(bounds, noise, basis)]
    assert 0.03 < np.mean(np.array(chances) < 0.05) < 0.08
    assert np.mean(np.array(chances) < module.FALSE_ALARMS) < 0.006


def test_the_filter_that_whitens_is_the_process_itself():
    """An autoregression's own correlations give its coefficients back; further ones are 0."""
    a = np.array([1.2, -0.6, 0.2])
    impulse = lfilter([1], [1, *-a], np.eye(1, 4000)[0])
    powers = np.array([impulse[: 4000 - k] @ impulse[k:] for k in range(9)])
    np.testing.assert_allclose(autoregression(powers[1:] / powers[0]), [*a, 0, 0, 0, 0, 0], atol=1e-6)


@pytest.mark.parametrize("rho", [-0.3, 0.15, 0.3, 0.9])
def test_weak_correlation_is_seen(rho):
    """Of one axis alone, too, and whatever its sign."""
    bounds, basis = segments(12, 250)
    rng = np.random.default_rng(1)
    for _ in range(20):
        noise = rng.standard_normal((3000, 2))
        noise[:, 1] = np.sqrt(1 - rho**2) * lfilter([1], [1, -rho], noise[:, 1])
        white, other = whiteness(bounds, fitted(noise, bounds, basis), basis)
        assert white.probability > 1e-5
        assert not other.white and other.correlations[0] == pytest.approx(rho, abs=0.1)


def test_segments_shorter_than_the_lags_are_tested_over_what_they_have():
    bounds, basis = segments(40, 14)
    (axis, _) = whiteness(bounds, fitted(np.ones((560, 2)).cumsum(axis=0) % 3, bounds, basis), basis)
    assert len(axis.correlations) == 7 and 1 <= axis.span <= 7
    assert all(axis.white for axis in whiteness(bounds, np.zeros((560, 2)), basis))
