"""Figures of merit of linear responses once more, from dense samples and SciPy's splines.

What the kernels' are measured against. The definitions are those of the documentation, written down anew; nothing of
heli2dof's is used.
"""

from __future__ import annotations

from itertools import pairwise

import mpmath
import numpy as np
from scipy.interpolate import CubicSpline


def figures(t, angle, start, reference):
    """Of one stepped axis, by cubic splines through dense samples; None for what does not happen within t."""
    share = CubicSpline(t, (angle - start) / (reference - start))
    step, end = abs(reference - start), t[-1]
    turns = [x for x in share.derivative().roots(extrapolate=False) if 0 < x < end]
    candidates = np.array([t[0], *turns, end])
    values = share(candidates)
    top, bottom = int(np.argmax(values)), int(np.argmin(values))
    low, high = crossings(share, 0.1), crossings(share, 0.9)
    edges = sorted([*crossings(share, 0.98), *crossings(share, 1.02)])
    inside = abs(float(share(end)) - 1) <= 0.02
    zeros = np.array([t[0], *crossings(share, 1.0), end])
    error = CubicSpline(t, 1 - share(t))
    weighted = CubicSpline(t, t * (1 - share(t)))
    pieces = list(pairwise(zeros))
    below = -values[bottom] > values[top]
    return {
        "rise_time": high[0] - low[0] if len(low) and len(high) else None,
        "entered": (edges[-1] if edges else t[0]) if inside else None,
        "overshoot": 100 * max(values[top] - 1, 0.0),
        "undershoot": 100 * max(-values[bottom], 0.0),
        "peak": start + (reference - start) * values[bottom if below else top],
        "peak_time": candidates[bottom if below else top],
        "steady_state_error": reference - angle[-1],
        "iae": step * sum(abs(error.integrate(a, b)) for a, b in pieces),
        "itae": step * sum(abs(weighted.integrate(a, b)) for a, b in pieces),
    }


def crossings(spline, level):
    """Where a spline has a value, within its knots."""
    found = spline.solve(level, extrapolate=False)
    found = found[np.isfinite(found)]
    return found[np.abs(spline(found) - level) < 1e-7]  # on flat pieces the solver finds some that are none


def largest(t, values):
    """The largest size of a smooth course."""
    spline = CubicSpline(t, values)
    turns = [x for x in spline.derivative().roots(extrapolate=False) if np.isfinite(x)]
    return float(np.max(np.abs(spline(np.array([t[0], *turns, t[-1]])))))


class LinearCourse:
    """x(t) of ẋ = A x + B r from x₀, by the eigenvectors of the matrix that the constant 1 augments."""

    def __init__(self, A, B, reference, start, digits=None):
        """With `digits` by mpmath: where poles differ by 10⁵, LAPACK's slow modes are off by 3e-4."""
        n = len(A)
        M = np.zeros((n + 1, n + 1))
        M[:n, :n], M[:n, n] = A, B @ reference
        first = np.append(start, 1.0)
        if digits is None:
            self.values, self.vectors = np.linalg.eig(M)
            self.shares = np.linalg.solve(self.vectors, first.astype(complex))
            return
        with mpmath.workdps(digits):
            values, vectors = mpmath.eig(mpmath.matrix(M.tolist()))
            shares = mpmath.lu_solve(vectors, mpmath.matrix(first.tolist()))
        self.values = np.array([complex(value) for value in values])
        self.vectors = np.array(vectors.tolist(), dtype=complex)
        self.shares = np.array([complex(share) for share in shares])

    def __call__(self, t):
        modes = np.exp(np.multiply.outer(self.values, t)) * self.shares[:, None]
        return (self.vectors @ modes).real[:-1]

    def leaves(self, end, row, start, reference):
        """Whether an angle leaves the settling band after `end`, however much later."""
        slowest = np.min(np.abs(self.values.real[np.abs(self.values) > 1e-9]))
        t = end + np.linspace(0, 25 / slowest, 20_001)
        return bool(np.any(np.abs((self(t)[row] - start) / (reference - start) - 1) > 0.02))
