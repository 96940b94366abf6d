"""One experiment as numbers: references, start, limits, anti-windup and disturbance in the kernels' array."""

from __future__ import annotations

from math import inf

import numpy as np

from ..kernels.layout import BACK_CALCULATION, CLAMPING, NO_ANTI_WINDUP
from ..loop import Loop
from ..scenario import AntiWindup, Limits, Scenario
from ..signals import Floats, fixed

WINDUP: dict[AntiWindup, int] = {
    "none": NO_ANTI_WINDUP,
    "clamping": CLAMPING,
    "back-calculation": BACK_CALCULATION,
}
NOTHING = fixed(np.zeros((2, 2)))
"""The integral action of a loop that integrates nothing."""


def numbers(loop: Loop, limits: Limits | None, scenario: Scenario) -> list[float]:
    """The scenario on this loop, EXPERIMENT numbers, laid out as `layout` says.

    Without `limits` nothing saturates and pitch has no stops.
    """
    theta_0, disturbance = loop.design.plant.theta_0, scenario.disturbance
    bounds, stop, windup, back = (inf, inf), inf, NO_ANTI_WINDUP, [0.0] * 4
    if limits is not None and scenario.saturation:
        bounds = limits.V_p, limits.V_y
        windup = WINDUP[scenario.anti_windup] if loop.has_integrators else NO_ANTI_WINDUP
        if windup == BACK_CALCULATION:
            back = _tracking(loop, scenario.tracking_time)
    if limits is not None and scenario.travel_stops and limits.theta is not None:
        stop = limits.theta
    volts = (0.0, 0.0) if disturbance is None else (disturbance.V_p, disturbance.V_y)
    fed = float(scenario.trim_feedforward)
    return [*scenario.resolved(theta_0), *bounds, stop, fed, windup, *back, *volts]


def experiment(loop: Loop, limits: Limits | None, scenario: Scenario) -> Floats:
    """`numbers` as an array, as the kernels take them."""
    return np.array(numbers(loop, limits, scenario))


def _tracking(loop: Loop, tracking_time: float | None) -> list[float]:
    """The gains of back-calculation, 2×2 row by row, rad/(V·s).

    The integrals follow so that their voltage makes up for what the limits cut off, with `tracking_time`
    as time constant, or else T_i (Åström & Hägglund, Advanced PID Control, 2006, section 3.5, who
    advise between T_d and T_i; a PI controller has no T_d).
    """
    if loop.integral is None or not np.all(np.any(loop.integral, axis=0)):
        return [0.0] * 4
    times = loop.integral_times if tracking_time is None else np.full(2, tracking_time)
    return (np.linalg.pinv(loop.integral) / times[:, None]).ravel().tolist()
