"""Covariance of least-squares estimates whose residuals are correlated in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..signals import Floats

FEWEST_GROUPS = 20
"""Groups of samples that are wanted; longer segments are divided for that."""
QUANTILES = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228)
"""Student's t for 95 % with 1 to 10 degrees of freedom (Abramowitz & Stegun, 1964, table 26.10)."""
_NORMAL = 1.959964
_DETERMINED = 1e-4


def plain_covariance(J: Floats, r: Floats, unknowns: int) -> Floats:
    """σ² (JᵀJ)⁻¹, (k, k): right where residuals are white. J (n, outputs, k), r (n, outputs)."""
    columns = J.reshape(-1, J.shape[-1])
    variance = float(np.sum(r**2)) / max(1, r.size - unknowns)
    return np.asarray(variance * np.linalg.inv(columns.T @ columns), dtype=np.float64)


def groups_of(bounds: NDArray[np.int64]) -> NDArray[np.int64]:
    """Groups of samples that are taken for independent: the segments, the longest divided until there are enough."""
    parts = max(1, int(np.ceil(FEWEST_GROUPS / len(bounds))))
    groups = []
    for first, end in bounds.tolist():
        marks = np.linspace(first, end, min(parts, max(1, (end - first) // 2)) + 1).astype(np.int64)
        groups += list(zip(marks[:-1].tolist(), marks[1:].tolist(), strict=True))
    return np.array(groups, dtype=np.int64)


def grouped_covariance(
    J: Floats, r: Floats, groups: NDArray[np.int64], basis: Floats | None = None, power: float = 0.5
) -> Floats:
    """The sandwich over groups of samples, (k, k): right whatever the correlation within a group is.

    (JᵀJ)⁻¹ S (JᵀJ)⁻¹ with S of the groups' scores J_gᵀ(I − H_gg)^(−1/2) r_g (Bell & McCaffrey, Survey Methodology 28
    (2002) 169–181, "CR2"; Cameron & Miller, J. Human Resources 50 (2015) 317–372, section VI.B). H_gg is what the fit
    takes out of a group's residuals, starting states included: they swallow the slow part of correlated noise, which
    sums over lags of the residuals (Newey & West) therefore miss. For white residuals S is unbiased. With the power 1
    ("CR3", the jackknife) it is too large for them, and meant for correlated ones.

    Args:
        J: derivatives of the residuals, (n, outputs, k), starting states eliminated.
        r: residuals, (n, outputs).
        groups: first and last + 1 of each, (groups, 2).
        power: of (I − H_gg)⁻¹.
        basis: orthonormal in each segment, of what its starting state can do, (n, outputs, states).
    """
    k = J.shape[-1]
    columns = J.reshape(-1, k)
    Q, R = np.linalg.qr(columns)
    root = np.linalg.inv(R)
    scaled = Q.reshape(J.shape)
    S = np.zeros((k, k))
    for a, b in groups.tolist():
        own, residuals = scaled[a:b].reshape(-1, k), r[a:b].ravel()
        taken = own if basis is None else np.hstack([own, basis[a:b].reshape(len(own), -1)])
        U, s, _ = np.linalg.svd(taken, full_matrices=False)
        left = 1.0 - np.minimum(s, 1.0) ** 2
        # What a group alone determines is left as it is: of that there are no residuals.
        gain = np.where(left > _DETERMINED, np.maximum(left, _DETERMINED) ** -power, 1.0) - 1.0
        score = own.T @ (residuals + U @ (gain * (U.T @ residuals)))
        S += np.outer(score, score)
    return np.asarray(root @ S @ root.T, dtype=np.float64)


def student_quantile(freedom: int) -> float:
    """Student's t for 95 %, two-sided; beyond the table by Cornish and Fisher's expansion, exact to 3e-3."""
    if freedom <= len(QUANTILES):
        return QUANTILES[max(1, freedom) - 1]
    z, n = _NORMAL, freedom
    return z + (z**3 + z) / (4 * n) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * n**2)
