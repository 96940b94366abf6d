"""What the whole loop bears at both motors at once: sensitivity peak and disk margin."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan

import numpy as np

from .engine import engine
from .layout import FREQUENCIES, SENSITIVITY
from .loop import Loop


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

    For two independent complex changes μ is the largest singular value after the best diagonal scaling,
    which for two by two has a closed form: it makes both off-diagonal entries equally large.
    """
    if not loop.stable:
        return None
    both = np.empty(SENSITIVITY)
    engine().peaks(loop.polynomials, loop.poles, np.empty(FREQUENCIES + 2 * len(loop.poles)), both)
    return Sensitivity(*both.tolist())
