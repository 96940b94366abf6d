"""Step responses of the real rig: gravity, coupling, voltage limits, anti-windup, travel stops."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..engine import engine
from ..findings import Finding
from ..layout import (
    BACK_CALCULATION,
    CLAMPING,
    CONSTANTS,
    DISTURBANCE,
    GAIN,
    LIMIT,
    NO_ANTI_WINDUP,
    OFFSET,
    TRACKING,
    TRAVEL,
    WANTED,
    WORKSPACE,
)
from ..loop import Loop
from ..signals import INPUTS, Floats
from ..spec import AntiWindup, Limits, Scenario
from .response import Response, hold_when_diverged

ABSOLUTE_TOLERANCE = 0.1
"""Absolute tolerance of the integration as a share of the relative one (states are of order 1)."""

_WINDUP: dict[AntiWindup, int] = {
    "none": NO_ANTI_WINDUP,
    "clamping": CLAMPING,
    "back-calculation": BACK_CALCULATION,
}
_OUTCOMES = {1: "more steps would be needed than are worth it", 2: "its modes switch without end"}


@dataclass(frozen=True)
class NonlinearLoop:
    """The loop around the nonlinear rig (Eqs. 9–12) as `kernels.rig` takes it.

    Attributes:
        constants, modes: laid out as `kernels.rig` says.
        start: θ, ψ, θ̇, ψ̇, z_p, z_y at t = 0.
        reference: θ_ref, ψ_ref, absolute, rad.
        travel: of pitch, rad; infinite without stops.
        disturbed_from: when the disturbance within `constants` sets in, s; infinite without one.
        order: how many of the states mean anything: 6, or 4 where nothing integrates.
    """

    constants: Floats
    modes: NDArray[np.int64]
    start: Floats
    reference: Floats
    travel: float
    disturbed_from: float
    order: int

    @classmethod
    def of(cls, loop: Loop, limits: Limits, scenario: Scenario) -> NonlinearLoop:
        """The loop, limits and scenario as numbers; the loop's deviations become absolute."""
        plant = loop.design.plant
        reference, start = scenario.resolved(plant.theta_0)
        rest = np.array([plant.theta_0, 0.0])
        law = loop.voltage_from_state
        constants, first = np.zeros(CONSTANTS), np.zeros(6)
        first[:4] = start
        constants[:GAIN] = rig_constants(plant.parameters)
        constants[GAIN:OFFSET].reshape(2, 6)[:, : law.shape[1]] = law
        constants[OFFSET:LIMIT] = loop.voltage_from_reference @ (reference - rest) - law[:, :2] @ rest
        if scenario.trim_feedforward:
            constants[OFFSET:LIMIT] += plant.trim
        constants[LIMIT:WANTED] = (limits.V_p, limits.V_y) if scenario.saturation else np.inf
        constants[WANTED:TRACKING] = reference
        windup = _WINDUP[scenario.anti_windup] if loop.has_integrators and scenario.saturation else 0
        if windup == BACK_CALCULATION:
            constants[TRACKING:TRAVEL] = _tracking(loop, scenario.tracking_time).ravel()
        travel = limits.theta if scenario.travel_stops and limits.theta is not None else np.inf
        constants[TRAVEL] = travel
        since = np.inf
        if scenario.disturbance is not None:
            constants[DISTURBANCE:] = scenario.disturbance.V_p, scenario.disturbance.V_y
            since = scenario.disturbance.time
        modes = np.array([0, 0, 1, 1, 0, *_motors(loop), windup], dtype=np.int64)
        return cls(constants, modes, first, reference, travel, since, len(loop.A))

    @property
    def gain(self) -> Floats:
        """∂u/∂y, 2×6: u = `gain` y + `offset`, V."""
        return self.constants[GAIN:OFFSET].reshape(2, 6)

    @property
    def offset(self) -> Floats:
        """Voltages at y = 0, shape (2,), V."""
        return self.constants[OFFSET:LIMIT]

    @property
    def limits(self) -> Floats:
        """Of the voltages, shape (2,), V; infinite without saturation."""
        return self.constants[LIMIT:WANTED]


def rig_constants(p: Any) -> list[Any]:
    """The rig's part of `kernels.rig`'s constants; `p` has Parameters' fields, as numbers or arrays."""
    ml2 = p.m * p.l**2
    return [p.K_pp, p.K_py, p.K_yp, p.K_yy, p.alpha, p.J_y, ml2, p.m * p.g * p.l, p.B_p, p.B_y, p.K_s]


def _motors(loop: Loop) -> tuple[int, int]:
    """Which motor each integrator drives, in the main."""
    if loop.integral is None:
        return 0, 1
    (a, b), (c, d) = loop.integral.tolist()  # V/s of each motor per rad of each error
    return int(abs(c) > abs(a)), int(abs(d) > abs(b))


def _tracking(loop: Loop, tracking_time: float | None) -> Floats:
    """The gains of back-calculation, 2×2, rad/(V·s).

    The integrals follow so that their voltage makes up for what the limits cut off, with `tracking_time`
    as time constant, or else T_i (Åström & Hägglund, Advanced PID Control, 2006, section 3.5, who
    advise between T_d and T_i; a PI controller has no T_d).
    """
    if loop.integral is None or not np.all(np.any(loop.integral, axis=0)):
        return np.zeros((2, 2))
    times = loop.integral_times if tracking_time is None else np.full(2, tracking_time)
    return np.asarray(np.linalg.pinv(loop.integral) / times[:, None], dtype=np.float64)


def simulate_nonlinear(
    loop: Loop, limits: Limits, scenario: Scenario, most_steps: int | None = None
) -> Response:
    """Response of the nonlinear rig under the loop, adaptive with tolerance `scenario.rtol`.

    The rig starts at rest at its operating point unless `scenario.initial` says otherwise. Whatever
    changes the rates abruptly is located: a voltage that reaches or leaves its limit, an integrator
    that clamping stops or lets go, pitch that meets its stop (without rebound) or leaves it. After
    `most_steps`, by default half a second's work or two, it is given up and a finding says so.
    """
    system = NonlinearLoop.of(loop, limits, scenario)
    t = scenario.times
    states = np.full((scenario.samples, 6), np.nan)
    outcome, impacts = _integrate(system, scenario.rtol, most_steps or engine().most_steps, t, states)
    course, voltages = np.empty((6, len(t))), np.empty((2, len(t)))
    engine().trajectories(states, system.constants, course, voltages)
    return response_of(system, t, course, voltages, outcome=outcome, impacts=impacts)


def _integrate(
    system: NonlinearLoop, rtol: float, most_steps: int, t: Floats, states: Floats
) -> tuple[int, int]:
    """Fills `states` before and after the disturbance sets in; the outcome and the number of impacts."""
    y, modes, kernels = system.start.copy(), system.modes.copy(), engine()
    numbers = (rtol, ABSOLUTE_TOLERANCE * rtol, most_steps, np.empty(WORKSPACE))
    calm = system.constants.copy()
    calm[-2:] = 0.0
    before = int(np.searchsorted(t, system.disturbed_from))
    if before == len(t):
        outcome, _, _, _, impacts = kernels.integrate(y, t, calm, modes, *numbers, states)
        return outcome, impacts
    impacts, at = 0, max(system.disturbed_from, 0.0)
    for constants, grid, place in (
        (calm, np.append(t[:before], at), slice(0, before)),
        (system.constants, np.insert(t[before:], 0, at), slice(before, len(t))),
    ):
        if grid[-1] <= grid[0]:
            continue
        course = np.full((len(grid), 6), np.nan)
        outcome, _, _, _, hits = kernels.integrate(y, grid, constants, modes, *numbers, course)
        impacts += hits
        states[place] = course[:-1] if place.start == 0 and before else course[1:]
        if outcome:
            return outcome, impacts
    return 0, impacts


def response_of(
    system: NonlinearLoop, t: Floats, states: Floats, voltages: Floats, *, outcome: int, impacts: int
) -> Response:
    """What a kernel has filled, as a response: states (6, n) and voltages (2, n), NaN where none was reached."""
    findings = hold_when_diverged(t, states, voltages)
    at_limit = engine().share_at_limit
    saturated = at_limit(voltages[0], system.limits[0]), at_limit(voltages[1], system.limits[1])
    if outcome:
        words = f"The simulation was given up: {_OUTCOMES[outcome]}."
        findings.append(Finding("integration_stopped", "warning", words))
    findings += _remarks(system, saturated, impacts)
    reference = (float(system.reference[0]), float(system.reference[1]))
    start = (float(system.start[0]), float(system.start[1]))
    own = states[: system.order]
    return Response("nonlinear", t, own[:2], voltages, reference, start, saturated, tuple(findings), own)


def _remarks(system: NonlinearLoop, saturated: tuple[float, float], impacts: int) -> Iterator[Finding]:
    for signal, share, limit in zip(INPUTS, saturated, system.limits, strict=True):
        if share:
            yield Finding(
                f"saturation_{signal.name}",
                "warning",
                f"The {signal.meaning} is at its limit of ±{limit:g} V for {100 * share:.0f} % of the time.",
            )
    stop = f"±{np.degrees(system.travel):.1f}°"
    if abs(system.start[0]) > system.travel:
        yield Finding("starts_on_stop", "warning", "The start lies beyond a stop of the pitch travel.")
    if impacts:
        yield Finding("travel_stop", "warning", f"Pitch hits a stop of its travel at {stop}.")
    if abs(system.reference[0]) > system.travel:
        yield Finding(
            "reference_beyond_stop",
            "warning",
            f"The pitch reference lies beyond the rig's travel of {stop}: it cannot be reached.",
        )
