"""Step metrics of a response, with python-control's `step_info` names in snake case."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .signals import INPUTS, OUTPUTS, Floats
from .simulation.response import Response

RISE = (0.1, 0.9)
SETTLED = 0.02


@dataclass(frozen=True)
class AxisMetrics:
    """How one stepped axis follows its reference; what does not happen within t is None.

    Attributes:
        rise_time: from 10 % to 90 % of the step, s.
        settling_time: after it the axis stays within 2 % of the step around the reference, s.
        overshoot: largest excess beyond the reference, % of the step.
        peak: angle of the largest deviation from the start, rad.
        peak_time: when, s.
        steady_state_error: reference minus the last value, rad.
        iae: integral of the absolute error over t, ∫ |e| dt, rad·s.
        itae: the same weighted with time, ∫ t |e| dt, rad·s² (Graham & Lathrop, Trans. AIEE 72 (1953) 273).
    """

    rise_time: float | None
    settling_time: float | None
    overshoot: float
    peak: float
    peak_time: float
    steady_state_error: float
    iae: float
    itae: float


@dataclass(frozen=True)
class MotorMetrics:
    """What one motor has to do.

    Attributes:
        peak: its largest |voltage|, V.
        saturated: share of time at its limit.
        effort: ∫ (V − V_trim)² dt, V²·s: what the control costs beyond holding still.
    """

    peak: float
    saturated: float
    effort: float


@dataclass(frozen=True)
class StepMetrics:
    """All metrics of one response.

    Attributes:
        axes: by output name, the axes that are stepped.
        coupling_peak: largest deviation of the other axis where one alone is stepped, rad.
        motors: by input name.
    """

    axes: dict[str, AxisMetrics]
    coupling_peak: float | None
    motors: dict[str, MotorMetrics]


def step_metrics(response: Response, trim: Floats) -> StepMetrics:
    """Metrics of a response; axes whose reference equals their start are not stepped.

    Args:
        response: linear or nonlinear.
        trim: the voltages that count as rest, shape (2,), V; zeros where they are deviations already.
    """
    steps = [r - s for r, s in zip(response.reference, response.start, strict=True)]
    stepped = [i for i, step in enumerate(steps) if step != 0.0]
    axes = {OUTPUTS[i].name: _axis(response.t, response.angles[i], response, i) for i in stepped}
    coupling = None
    if len(stepped) == 1:
        other = 1 - stepped[0]
        coupling = float(np.max(np.abs(response.angles[other] - response.start[other])))
    motors = {
        signal.name: MotorMetrics(
            float(np.max(np.abs(response.voltages[i]))),
            response.saturated[i],
            float(np.trapezoid((response.voltages[i] - trim[i]) ** 2, response.t)),
        )
        for i, signal in enumerate(INPUTS)
    }
    return StepMetrics(axes, coupling, motors)


def _axis(t: Floats, angle: Floats, response: Response, index: int) -> AxisMetrics:
    start, reference = response.start[index], response.reference[index]
    share = (angle - start) / (reference - start)
    low, high = (_first_crossing(t, share, level) for level in RISE)
    at = int(np.argmax(np.abs(angle - start)))
    return AxisMetrics(
        rise_time=None if low is None or high is None else high - low,
        settling_time=_settling(t, share),
        overshoot=100.0 * max(float(np.max(share)) - 1.0, 0.0),
        peak=float(angle[at]),
        peak_time=float(t[at]),
        steady_state_error=float(reference - angle[-1]),
        iae=float(np.trapezoid(np.abs(reference - angle), t)),
        itae=float(np.trapezoid(t * np.abs(reference - angle), t)),
    )


def _first_crossing(t: Floats, share: Floats, level: float) -> float | None:
    """When `share` first reaches `level`, between samples by straight line."""
    above = share >= level
    if not above.any():
        return None
    i = int(np.argmax(above))
    if i == 0:
        return float(t[0])
    fraction = (level - share[i - 1]) / (share[i] - share[i - 1])
    return float(t[i - 1] + fraction * (t[i] - t[i - 1]))


def _settling(t: Floats, share: Floats) -> float | None:
    error = np.abs(share - 1.0)
    outside = np.flatnonzero(error > SETTLED)
    if not len(outside):
        return float(t[0])
    last = int(outside[-1])
    if last == len(t) - 1:
        return None
    fraction = (error[last] - SETTLED) / (error[last] - error[last + 1])
    return float(t[last] + fraction * (t[last + 1] - t[last]))
