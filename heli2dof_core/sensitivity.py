"""What the whole loop bears at both motors at once: sensitivity peak and disk margin."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, isinf

import numpy as np

from .engine import engine
from .kernels.layout import SENSITIVITY
from .loop import Loop
from .scratch import scratch
from .signals import Floats


@dataclass(frozen=True)
class Sensitivity:
    """Robustness of the loop opened at both motors' inputs, L(s), S = (I + L)⁻¹, T = I − S.

    Its attributes are those of the registry (`figures.SENSITIVITY`). The peak M_S is the maximum over ω of the
    largest singular value of S(jω), never below 1, as S(j∞) = I (Skogestad & Postlethwaite 2005, 2.4.3). The disk
    margin α has skew 0: 1/max μ((S − T)/2) with diagonal μ, at most 2 (Seiler, Packard & Gahinet, IEEE Control
    Systems 40 (2020) 78–95). A frequency is None where its value is approached as ω grows without bound.
    """

    peak: float
    peak_frequency: float | None
    disk_margin: float
    disk_frequency: float | None

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
    """Sensitivity peak and disk margin at the motors; None if the loop is not stable.

    For two independent complex changes μ is the largest singular value after the best diagonal scaling,
    which for two by two has a closed form: it makes both off-diagonal entries equally large.
    """
    if not loop.stable:
        return None
    both = np.empty(SENSITIVITY)
    engine().sensitivity_peaks(loop.polynomials, loop.connected_poles, scratch.sensitivity, both)
    return sensitivity_of(both)


def sensitivity_of(both: Floats) -> Sensitivity:
    """As the kernel has filled it, laid out as `kernels.layout` says."""
    peak, peak_frequency, disk_margin, disk_frequency = both.tolist()
    return Sensitivity(peak, _finite(peak_frequency), disk_margin, _finite(disk_frequency))


def _finite(frequency: float) -> float | None:
    return None if isinf(frequency) else frequency
