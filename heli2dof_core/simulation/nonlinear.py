"""Step responses of the real rig: gravity, coupling, voltage limits, anti-windup, travel stops."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..engine import engine
from ..findings import Finding
from ..loop import Loop
from ..signals import INPUTS, Floats
from ..spec import AntiWindup, Limits, Scenario
from .response import Response, hold_when_diverged

ABSOLUTE_TOLERANCE = 0.1
"""Absolute tolerance of the integration as a share of the relative one (states are of order 1)."""

_WINDUP: dict[AntiWindup, int] = {"none": 0, "clamping": 1, "back-calculation": 2}
_OUTCOMES = {1: "more steps would be needed than are worth it", 2: "its modes switch without end"}


@dataclass(frozen=True)
class NonlinearLoop:
    """The loop around the nonlinear rig (Eqs. 9–12) as `kernels.rig` takes it.

    Attributes:
        constants, modes: laid out as `kernels.rig` says.
        gain, offset: u = gain y + offset, 2×6 and 2, V.
        start: θ, ψ, θ̇, ψ̇, z_p, z_y at t = 0.
        reference: θ_ref, ψ_ref, absolute, rad.
        limits: of the voltages, V; infinite without saturation.
        travel: of pitch, rad; infinite without stops.
        disturbed_from: when the disturbance within `constants` sets in, s; infinite without one.
        order: how many of the states mean anything: 6, or 4 where nothing integrates.
    """

    constants: Floats
    modes: NDArray[np.int64]
    gain: Floats
    offset: Floats
    start: Floats
    reference: Floats
    limits: Floats
    travel: float
    disturbed_from: float
    order: int

    @classmethod
    def of(cls, loop: Loop, limits: Limits, scenario: Scenario) -> NonlinearLoop:
        """The loop, limits and scenario as numbers; the loop's deviations become absolute."""
        plant = loop.design.plant
        reference, start = scenario.resolved(plant.theta_0)
        rest = np.array([plant.theta_0, 0.0])
        gain = np.zeros((2, 6))
        gain[:, : loop.voltage_from_state.shape[1]] = loop.voltage_from_state
        trim = plant.trim if scenario.trim_feedforward else np.zeros(2)
        offset = trim + loop.voltage_from_reference @ (reference - rest) - gain[:, :2] @ rest
        ceilings = np.array([limits.V_p, limits.V_y]) if scenario.saturation else np.full(2, np.inf)
        travel = limits.theta if scenario.travel_stops and limits.theta is not None else np.inf
        motors, tracking = _anti_windup(loop, scenario.tracking_time)
        disturbance = scenario.disturbance
        disturbed = [0.0, 0.0] if disturbance is None else [disturbance.V_p, disturbance.V_y]
        since = np.inf if disturbance is None else disturbance.time
        rig = rig_constants(plant.parameters)
        constants = np.concatenate(
            [rig, gain.ravel(), offset, ceilings, reference, tracking.ravel(), [travel], disturbed]
        )
        windup = _WINDUP[scenario.anti_windup] if loop.has_integrators and scenario.saturation else 0
        modes = np.array([0, 0, 1, 1, 0, *motors, windup], dtype=np.int64)
        first = np.concatenate([start, np.zeros(2)])
        return cls(constants, modes, gain, offset, first, reference, ceilings, travel, since, len(loop.A))

    def voltages(self, states: Floats) -> Floats:
        """What the motors get in `states`, (6, n): shape (2, n), V."""
        asked = self.gain @ states + self.offset[:, None]
        return np.clip(asked, -self.limits[:, None], self.limits[:, None])


def rig_constants(p: Any) -> list[Any]:
    """The rig's part of `kernels.rig`'s constants; `p` has Parameters' fields, as numbers or arrays."""
    ml2 = p.m * p.l**2
    return [p.K_pp, p.K_py, p.K_yp, p.K_yy, p.alpha, p.J_y, ml2, p.m * p.g * p.l, p.B_p, p.B_y, p.K_s]


def _anti_windup(loop: Loop, tracking_time: float | None) -> tuple[list[int], Floats]:
    """Which motor each integrator drives, and the gains of back-calculation, 2×2.

    The integrals follow so that their voltage makes up for what the limits cut off, with `tracking_time`
    as time constant, or else T_i (Åström & Hägglund, Advanced PID Control, 2006, section 3.5, who
    advise between T_d and T_i; a PI controller has no T_d).
    """
    effect = loop.integral  # V/s of each motor per rad of each error
    if effect is None:
        return [0, 1], np.zeros((2, 2))
    motors = [int(np.argmax(np.abs(effect[:, i]))) for i in range(2)]
    if not np.all(np.any(effect, axis=0)):
        return motors, np.zeros((2, 2))
    times = loop.integral_times if tracking_time is None else np.full(2, tracking_time)
    return motors, np.asarray(np.linalg.pinv(effect) / times[:, None], dtype=np.float64)


def simulate_nonlinear(loop: Loop, limits: Limits, scenario: Scenario) -> Response:
    """Response of the nonlinear rig under the loop, adaptive with tolerance `scenario.rtol`.

    The rig starts at rest at its operating point unless `scenario.initial` says otherwise. Whatever
    changes the rates abruptly is located: a voltage that reaches or leaves its limit, an integrator
    that clamping stops or lets go, pitch that meets its stop (without rebound) or leaves it.
    """
    system = NonlinearLoop.of(loop, limits, scenario)
    t = np.linspace(0.0, scenario.duration, scenario.samples)
    states = np.full((scenario.samples, 6), np.nan)
    outcome, impacts = _integrate(system, scenario.rtol, t, states)
    voltages = system.voltages(np.ascontiguousarray(states.T))
    return response_of(system, t, states, voltages, outcome=outcome, impacts=impacts)


def _integrate(system: NonlinearLoop, rtol: float, t: Floats, states: Floats) -> tuple[int, int]:
    """Fills `states` before and after the disturbance sets in; the outcome and the number of impacts."""
    y, modes, kernels = system.start.copy(), system.modes.copy(), engine()
    numbers = (rtol, ABSOLUTE_TOLERANCE * rtol, kernels.most_steps)
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
    """What a kernel has filled, as a response: states (n, 6), NaN where none was reached; voltages (2, n)."""
    course, voltages, findings = hold_when_diverged(t, np.ascontiguousarray(states.T), voltages)
    saturated = _share_at_limit(voltages, system.limits)
    if outcome:
        words = f"The simulation was given up: {_OUTCOMES[outcome]}."
        findings.append(Finding("integration_stopped", "warning", words))
    findings += _remarks(system, saturated, impacts)
    reference = (float(system.reference[0]), float(system.reference[1]))
    start = (float(system.start[0]), float(system.start[1]))
    return Response(
        "nonlinear",
        t,
        course[:2],
        voltages,
        reference,
        start,
        saturated,
        tuple(findings),
        course[: system.order],
    )


def _share_at_limit(voltages: Floats, limits: Floats) -> tuple[float, float]:
    share = np.mean(np.abs(voltages) >= limits[:, None] * (1.0 - 1e-9), axis=1)
    return float(share[0]), float(share[1])


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
