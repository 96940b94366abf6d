"""Whether residuals are white: their correlation over time lags, and a test of all lags at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..frozen import Frozen
from ..signals import Floats

LAGS = 25
"""Lags that are looked at, as MATLAB's `resid` does."""
BAND = 2.575829
"""Quantile of the normal distribution for 99 %, two-sided."""
FALSE_ALARMS = 1e-3
"""How often white residuals of an axis are said to be correlated."""


@dataclass(frozen=True)
class Whiteness(Frozen):
    """What the residuals of one axis say.

    Attributes:
        correlations: of residuals 1 … `LAGS` samples apart.
        probability: with which white residuals would be correlated as much.
        band: 99 % of the correlations of white residuals lie within ± so much, as MATLAB's `resid` draws it.
        span: the first of the lags from 1 on over which they are not correlated visibly, in samples.
    """

    correlations: Floats
    probability: float
    band: float
    span: int

    @property
    def white(self) -> bool:
        """Whether nothing speaks against it."""
        return self.probability > FALSE_ALARMS


def correlations(bounds: NDArray[np.int64], r: Floats, lags: int) -> Floats:
    """Of residuals 1 … `lags` samples apart within segments, (lags, outputs), as shares of their power."""
    together, power = np.zeros((lags, r.shape[1])), np.full(r.shape[1], 1e-300)
    for a, b in bounds.tolist():
        power += np.sum(r[a:b] ** 2, axis=0)
        for k in range(1, lags + 1):
            together[k - 1] += np.sum(r[a : b - k] * r[a + k : b], axis=0)
    return together / power


def autoregression(rho: Floats) -> Floats:
    """Coefficients a of r_t = Σ a_k r_{t−k} + white noise, (order,), from correlations at lags 1 … order.

    Source: the equations of Yule and Walker (Ljung, System Identification, 1999, section 10.1).
    """
    from scipy.linalg import solve_toeplitz

    row = np.concatenate([[1.0 + 1e-9], rho[:-1]])
    return np.asarray(solve_toeplitz(row, rho), dtype=np.float64)


def whiteness(bounds: NDArray[np.int64], r: Floats, basis: Floats) -> list[Whiteness]:
    """Ljung and Box's test of each axis' residuals, within segments.

    Source: Ljung & Box, Biometrika 65 (1978) 297–303; Ljung, System Identification, 1999, section 16.6. Fitted
    starting states make white residuals correlated, by −(σ²/n) Σ H_{t,t+τ} with the fit's projection H; that is taken
    out, and what is left counts by its own number of pairs.

    Args:
        bounds: first and last + 1 of each segment, (segments, 2).
        r: weighted residuals, (n, outputs).
        basis: orthonormal in each segment, of what its starting state can do, (n, outputs, states).
    """
    from scipy.special import chdtrc

    outputs = r.shape[1]
    shortest = int(np.min(np.diff(bounds, axis=1)))
    lags = min(LAGS, max(1, shortest // 2))
    count, freedom = 0, np.zeros(outputs)
    pairs, taken = np.zeros(lags), np.zeros((lags, outputs))
    for a, b in bounds.tolist():
        H = basis[a:b]
        count += b - a
        freedom += np.sum(H**2, axis=(0, 2))
        for k in range(1, lags + 1):
            pairs[k - 1] += b - a - k
            taken[k - 1] += np.sum(H[:-k] * H[k:], axis=(0, 2))
    visible = np.any(r != 0, axis=0)  # residuals that are 0 are white
    corrected = correlations(bounds, r, lags) + visible * taken / np.maximum(count - freedom, 1.0)
    found = []
    for i in range(outputs):
        rho = corrected[:, i].copy()
        Q = float(np.sum(rho**2 * count**2 / np.maximum(pairs, 1.0)))
        below = np.abs(rho) < 2.0 / np.sqrt(np.maximum(pairs, 1.0))
        span = int(np.argmax(below)) + 1 if np.any(below) else lags
        found.append(Whiteness(rho, float(chdtrc(lags, Q)), BAND / np.sqrt(max(count, 1)), span))
    return found
