"""What the whole loop bears at both motors at once: sensitivity peak and disk margin."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import atan

import numpy as np

from .loop import Loop
from .signals import Complexes, Floats

GRID = 100
"""Frequencies of the first search, from a hundredth of the slowest to a hundred times the fastest pole."""
ZOOMS = 4
"""Searches, each around the largest value of the last one and twelve times finer."""
ILL_CONDITIONED = 1e7
"""Condition of the eigenvectors beyond which responses are solved for, not summed over poles."""


@dataclass(frozen=True)
class Sensitivity:
    """Robustness of the loop opened at both motors' inputs, L(s), S = (I + L)⁻¹, T = I − S.

    Attributes:
        peak: M_S = max over ω of the largest singular value of S(jω): its inverse is the smallest
            distance to instability by an additive change of L (Skogestad & Postlethwaite 2005, 2.4.3).
        peak_frequency: where, rad/s.
        disk_margin: α of the largest disks of independent simultaneous changes of gain and phase at
            both motors that the loop bears, skew 0: 1/max μ((S − T)/2) with diagonal μ (Seiler,
            Packard & Gahinet, IEEE Control Systems 40 (2020) 78–95).
        disk_frequency: where it is reached, rad/s.
    """

    peak: float
    peak_frequency: float
    disk_margin: float
    disk_frequency: float

    @property
    def gain_range(self) -> tuple[float, float | None]:
        """Factors on both motors' gains that the disk margin guarantees; None where unlimited."""
        alpha = self.disk_margin
        return (2 - alpha) / (2 + alpha), (2 + alpha) / (2 - alpha) if alpha < 2 else None

    @property
    def phase(self) -> float:
        """Phase change at both motors that the disk margin guarantees, ±rad."""
        return 2 * atan(self.disk_margin / 2)


def loop_sensitivity(loop: Loop) -> Sensitivity | None:
    """Sensitivity peak and disk margin at the motors; None if the loop is unstable.

    S(jω) = I − C_u (jωI − A)⁻¹ B with the whole loop's A and the voltages' u = −C_u x. For two
    independent complex changes μ is the largest singular value after the best diagonal scaling, which
    for two by two has a closed form: it makes both off-diagonal entries equally large.
    """
    if not loop.stable:
        return None
    response = _sensitivity_response(loop)
    size = np.abs(loop.poles)
    frequencies = np.geomspace(0.01 * max(float(size.min()), 1e-3), 100 * float(size.max()), GRID)
    peak, at = _largest(lambda w: _largest_singular_value(response(w)), frequencies)
    mu, at_disk = _largest(lambda w: _structured(response(w) - 0.5 * np.eye(2)), frequencies)
    return Sensitivity(peak, at, 1 / mu, at_disk)


def _sensitivity_response(loop: Loop) -> Callable[[Floats], Complexes]:
    """S(jω) for many ω, (n, 2, 2): as a sum over the poles where their eigenvectors allow it."""
    n = len(loop.A)
    B = np.zeros((n, 2))
    B[:4] = loop.design.plant.B
    C_u = -loop.voltage_from_state
    values, vectors = np.linalg.eig(loop.A)
    if np.linalg.cond(vectors) > ILL_CONDITIONED:

        def solved(w: Floats) -> Complexes:
            pencil = 1j * w[:, None, None] * np.eye(n) - loop.A
            return np.asarray(np.eye(2) - C_u @ np.linalg.solve(pencil, B), dtype=np.complex128)

        return solved
    outputs, inputs = (C_u @ vectors).T, np.linalg.solve(vectors, B.astype(complex))
    residues = (outputs[:, :, None] * inputs[:, None, :]).reshape(n, 4)

    def summed(w: Floats) -> Complexes:
        modes = 1 / (1j * w[:, None] - values[None, :])
        return np.asarray(np.eye(2) - (modes @ residues).reshape(-1, 2, 2), dtype=np.complex128)

    return summed


def _largest(size: Callable[[Floats], Floats], frequencies: Floats) -> tuple[float, float]:
    found = 0.0, 0.0
    for _ in range(ZOOMS):
        values = size(frequencies)
        best = int(np.argmax(values))
        low, high = frequencies[max(best - 1, 0)], frequencies[min(best + 1, len(frequencies) - 1)]
        found = float(values[best]), float(frequencies[best])
        frequencies = np.geomspace(low, high, 25)
    return found


def _largest_singular_value(M: Complexes, scaled: bool = False) -> Floats:
    """Of each 2×2 matrix; `scaled`: after the diagonal scaling that makes it smallest."""
    a, b, c, d = np.abs(M[:, 0, 0]), np.abs(M[:, 0, 1]), np.abs(M[:, 1, 0]), np.abs(M[:, 1, 1])
    cross = 2 * b * c if scaled else b**2 + c**2
    total = a**2 + d**2 + cross
    determinant = np.abs(M[:, 0, 0] * M[:, 1, 1] - M[:, 0, 1] * M[:, 1, 0])
    return np.asarray(np.sqrt((total + np.sqrt(np.maximum(total**2 - 4 * determinant**2, 0.0))) / 2))


def _structured(M: Complexes) -> Floats:
    return _largest_singular_value(M, scaled=True)
