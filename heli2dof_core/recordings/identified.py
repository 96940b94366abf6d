"""What a recording says about a rig: estimates with their intervals, progress on the way there, remarks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..findings import Finding
from ..frozen import Frozen
from ..parameters import Parameters
from ..rotors import AxisFriction, Rotors
from ..signals import Floats
from .unknowns import info
from .validation import Part
from .whiteness import Whiteness


@dataclass(frozen=True)
class Estimate:
    """One parameter.

    Attributes:
        name, unit: of the parameter; of rotors and friction its place in a design (``rotors.pitch.tau``).
        before, value: as it was, and as found.
        low, high: its 95 % interval, with what the model leaves out (`identify`).
        noise: half width of the interval of a model that leaves nothing out, correlated residuals considered.
        plain: likewise, where the residuals are taken for white.
    """

    name: str
    unit: str
    before: float
    value: float
    low: float
    high: float
    noise: float
    plain: float

    @property
    def allowed(self) -> float:
        """The value within the range that the parameter may have."""
        return info(self.name).nearest(self.value)


@dataclass(frozen=True)
class Progress:
    """How far the search is: simulations so far, and the residuals' root mean square of θ and ψ, rad."""

    evaluations: int
    rms: tuple[float, float]


@dataclass(frozen=True)
class Identification(Frozen):
    """What a recording says about a rig.

    Attributes:
        estimates: of the free parameters.
        parameters: the rig with them, each within its range.
        rotors, friction: likewise; quadratic curves say where they are matched, as the rig's trim may have moved.
        rms_before, rms: of the residuals of θ and ψ, rad; starting states are fitted in both. Before: None where
            the rig as it was thought to be runs away.
        residuals: measured minus simulated, (n, 2), rad, of what was fitted; 0 elsewhere.
        segments: (count, 2), first sample and last + 1, of what was fitted.
        parts: what was fitted, then what was held out where something was.
        before, after: angles of the rig as it was thought to be and as it was found, (n, 2), rad, in segments of both
            parts; NaN elsewhere, and where the rig as it was thought to be runs away.
        bounds: of these segments, (count, 2).
        whiteness: of the fitted residuals of pitch and yaw, weighted.
        lags: over which the residuals' correlation was taken into account, samples.
        evaluations: simulations of the recording.
        seconds: that it took.
        findings: remarks.
    """

    estimates: tuple[Estimate, ...]
    parameters: Parameters
    rotors: Rotors
    friction: AxisFriction
    rms_before: tuple[float, float] | None
    rms: tuple[float, float]
    residuals: Floats
    segments: NDArray[np.int64]
    parts: tuple[Part, ...]
    before: Floats
    after: Floats
    bounds: NDArray[np.int64]
    whiteness: tuple[Whiteness, Whiteness]
    lags: float
    evaluations: int
    seconds: float
    findings: tuple[Finding, ...]
