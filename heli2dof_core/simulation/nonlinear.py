"""Step responses of the real rig: gravity, coupling, voltage limits, anti-windup, travel stops."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import degrees

import numpy as np
from numpy.typing import NDArray

from ..engine import engine
from ..findings import Finding
from ..layout import (
    BOUND,
    CONSTANTS,
    DIVERGED,
    GAIN,
    LIMIT,
    MODES,
    OFFSET,
    REFERENCE,
    START,
    STOP,
    TRACKING,
    WANTED,
    WORKSPACE,
)
from ..loop import Loop
from ..signals import INPUTS, Floats
from ..spec import Limits, Scenario
from .experiment import NOTHING, experiment
from .response import Response, divergence

ABSOLUTE_TOLERANCE = 0.1
"""Absolute tolerance of the integration as a share of the relative one (states are of order 1)."""

_OUTCOMES = {
    1: "it takes too many steps; shorten the duration or loosen the tolerance",
    2: "it switches between limits without end",
}


@dataclass(frozen=True)
class NonlinearLoop:
    """The loop around the nonlinear rig (Eqs. 9–12) as `kernels.rig` takes it.

    Attributes:
        experiment: laid out as `layout` says.
        constants, modes: laid out as `kernels.rig` says.
        start: θ, ψ, θ̇, ψ̇, z_p, z_y at t = 0.
        disturbed_from: when the disturbance within `constants` sets in, s; infinite without one.
        order: how many of the states mean anything: 6, or 4 where nothing integrates.
    """

    experiment: Floats
    constants: Floats
    modes: NDArray[np.int64]
    start: Floats
    disturbed_from: float
    order: int

    @classmethod
    def of(cls, loop: Loop, limits: Limits, scenario: Scenario) -> NonlinearLoop:
        """The loop, limits and scenario as numbers; the loop's deviations become absolute."""
        plant, x = loop.design.plant, experiment(loop, limits, scenario)
        constants, modes, start = np.empty(CONSTANTS), np.empty(MODES, dtype=np.int64), np.zeros(6)
        integral = NOTHING if loop.integral is None else loop.integral
        engine().compose(
            plant.constants,
            plant.trim,
            plant.theta_0,
            loop.voltage_from_state,
            loop.voltage_from_reference,
            integral,
            x,
            constants,
            modes,
        )
        start[:4] = x[START:BOUND]
        since = np.inf if scenario.disturbance is None else scenario.disturbance.time
        return cls(x, constants, modes, start, since, len(loop.A))

    @property
    def gain(self) -> Floats:
        """∂u/∂y, 2×6: u = `gain` y + `offset`, V."""
        return self.constants[GAIN:OFFSET].reshape(2, 6)

    @property
    def offset(self) -> Floats:
        """Voltages at y = 0, shape (2,), V."""
        return self.constants[OFFSET:LIMIT]

    @property
    def reference(self) -> Floats:
        """θ_ref, ψ_ref, absolute, shape (2,), rad."""
        return self.constants[WANTED:TRACKING]

    @property
    def limits(self) -> Floats:
        """Of the voltages, shape (2,), V; infinite without saturation."""
        return self.constants[LIMIT:WANTED]


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
    kernels = engine()
    held = kernels.hold(states, voltages, DIVERGED)
    shares = [kernels.share_at_limit(voltages[i], system.limits[i]) for i in range(2)]
    numbers = (*shares, held, outcome, impacts)
    return limited_response(system.experiment, t, states[: system.order], voltages, numbers)


def limited_response(
    x: Floats, t: Floats, states: Floats, voltages: Floats, numbers: Sequence[float]
) -> Response:
    """The course of an experiment with its remarks; `numbers` from SHARE on as `layout` says."""
    pitch, yaw, held, outcome, impacts = numbers
    theta, psi, theta_start, psi_start = x[: START + 2].tolist()
    findings = [*divergence(t, int(held))]
    if outcome:
        words = f"The simulation stopped early: {_OUTCOMES[int(outcome)]}."
        findings.append(Finding("integration_stopped", "warning", words))
    findings += _remarks(x, (pitch, yaw), impacts)
    start = (theta_start, psi_start)
    return Response(
        "nonlinear",
        t,
        states[:2],
        voltages,
        (theta, psi),
        start,
        (pitch, yaw),
        tuple(findings),
        states,
    )


def _remarks(x: Floats, saturated: tuple[float, float], impacts: float) -> Iterator[Finding]:
    for signal, share, limit in zip(INPUTS, saturated, x[BOUND:STOP].tolist(), strict=True):
        if share:
            yield Finding(
                f"saturation_{signal.name}",
                "warning",
                f"The {signal.meaning} is at its limit of ±{limit:g} V for {100 * share:.0f} % of the time.",
            )
    travel = float(x[STOP])
    stop = f"±{degrees(travel):.1f}°"
    if abs(x[START]) > travel:
        yield Finding(
            "starts_on_stop",
            "warning",
            "The start angle lies beyond the pitch travel. The rig starts on its stop.",
        )
    if impacts:
        yield Finding("travel_stop", "warning", f"Pitch hits a stop of its travel at {stop}.")
    if abs(x[REFERENCE]) > travel:
        yield Finding(
            "reference_beyond_stop",
            "warning",
            f"The pitch reference lies beyond the travel of {stop} and cannot be reached. Choose a smaller step.",
        )
