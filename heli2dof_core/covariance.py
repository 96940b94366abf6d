"""Covariance of least-squares estimates whose residuals are correlated in time."""

from __future__ import annotations

import numpy as np

from .signals import Floats


def plain_covariance(J: Floats, r: Floats, unknowns: int) -> Floats:
    """σ² (JᵀJ)⁻¹, (k, k): right where residuals are white. J (n, outputs, k), r (n, outputs)."""
    columns = J.reshape(-1, J.shape[-1])
    variance = float(np.sum(r**2)) / max(1, r.size - unknowns)
    return np.asarray(variance * np.linalg.inv(columns.T @ columns), dtype=np.float64)


def sandwich_covariance(J: Floats, r: Floats, unknowns: int) -> tuple[Floats, float]:
    """(JᵀJ)⁻¹ S (JᵀJ)⁻¹, and the lags that S covers: right where residuals are correlated in time, too.

    S is the long-run covariance of the scores J_tᵀ r_t with Bartlett's weights (Newey & West, Econometrica 55
    (1987) 703–708), over as many lags as Andrews' rule for first-order autoregressions says (Econometrica 59
    (1991) 817–858, Eqs. 6.2, 6.4), scaled for the `unknowns` that were fitted.

    Args:
        J: derivatives of the residuals, (n, outputs, k).
        r: residuals, (n, outputs).
        unknowns: fitted values in all.
    """
    columns = J.reshape(-1, J.shape[-1])
    bread = np.linalg.inv(columns.T @ columns)
    scores = np.einsum("tik,ti->tk", J, r)
    lags = _lags(scores)
    S = scores.T @ scores
    for lag in range(1, int(lags) + 1):
        weight = 1.0 - lag / (lags + 1.0)
        across = scores[lag:].T @ scores[:-lag]
        S += weight * (across + across.T)
    return r.size / max(1, r.size - unknowns) * bread @ S @ bread, lags


def _lags(scores: Floats) -> float:
    n = len(scores)
    before, after = scores[:-1], scores[1:]
    power = np.sum(before**2, axis=0)
    rho = np.clip(np.sum(before * after, axis=0) / np.where(power > 0, power, 1.0), -0.99, 0.99)
    variance = np.mean((after - rho * before) ** 2, axis=0)
    weight = np.where(variance > 0, 1.0 / np.where(variance > 0, variance, 1.0), 0.0)
    top = np.sum(weight**2 * 4 * rho**2 * variance**2 / ((1 - rho) ** 6 * (1 + rho) ** 2))
    bottom = np.sum(weight**2 * variance**2 / (1 - rho) ** 4)
    return float(min(1.1447 * (top / bottom * n) ** (1 / 3), n / 8)) if bottom > 0 else 0.0
