"""Step responses of the real rig: gravity, coupling, voltage limits, anti-windup, travel stops."""

from __future__ import annotations

from collections.abc import Iterator
from math import copysign
from operator import mul

import numpy as np

from ..compiled import accelerations
from ..findings import Finding
from ..loop import Loop
from ..signals import INPUTS, Floats
from ..spec import Limits, Scenario
from .dormand_prince import EventFunction, State, StepBudgetError, integrate
from .response import Response, hold_when_diverged
from .stiff import integrate_stiff

CLAMPING_BAND = 0.01
"""Share of a voltage limit over which clamping fades in. Where both sides push the voltage onto its
limit, exact clamping slides along it; within the band it comes to rest there instead of chattering."""

STIFF = 2e4
"""Fastest pole times duration beyond which an implicit method is cheaper than explicit steps."""

MOST_IMPACTS = 1000

ABSOLUTE_TOLERANCE = 0.1
"""Absolute tolerance of the integration as a share of the relative one (states are of order 1)."""


class NonlinearLoop:
    """Right-hand side of the loop around the nonlinear rig (Eqs. 9–12), state [θ, ψ, θ̇, ψ̇, z_p, z_y].

    Angles are absolute; z is the integral of the errors. `rate` and the events work on plain floats.
    """

    def __init__(self, loop: Loop, limits: Limits, scenario: Scenario) -> None:
        plant = loop.design.plant
        self.size = 6 if loop.has_integrators else 4
        self.rest = np.zeros(self.size)
        self.rest[0] = plant.theta_0
        self.reference, start = scenario.resolved(plant.theta_0)
        self.start = np.concatenate([start, np.zeros(self.size - 4)])
        self._gain = loop.voltage_from_state
        trim = plant.trim if scenario.trim_feedforward else np.zeros(2)
        self._offset = trim + loop.voltage_from_reference @ (self.reference - self.rest[:2])
        self._offset = self._offset - self._gain @ self.rest
        self._rows = list(zip(self._gain.tolist(), self._offset.tolist(), strict=True))
        self._wanted = self.reference.tolist()
        self._limits = (limits.V_p, limits.V_y) if scenario.saturation else (np.inf, np.inf)
        self.travel = limits.theta if scenario.travel_stops and limits.theta is not None else np.inf
        self.resting = False
        self._parameters = tuple(plant.parameters.as_dict().values())
        self._accelerations = accelerations()
        self._windup = scenario.anti_windup if scenario.saturation else "none"
        if loop.integral is not None:
            self._prepare_anti_windup(loop.integral, loop.integral_times)

    def _prepare_anti_windup(self, effect: Floats, times: Floats) -> None:
        """`effect`: V/s of each motor per rad of each error; `times`: the integral times, s."""
        self._motor = [int(np.argmax(np.abs(effect[:, i]))) for i in range(2)]
        self._direction = [float(np.sign(effect[self._motor[i], i])) for i in range(2)]
        self._tracking = [[0.0, 0.0], [0.0, 0.0]]
        if self._windup == "back-calculation" and np.all(np.any(effect, axis=0)):
            # tracking time = T_i: z follows so that its voltage makes up for what the limit cuts off
            self._tracking = (np.linalg.pinv(effect) / times[:, None]).tolist()

    def command(self, states: Floats) -> Floats:
        """Voltages asked for, before the limits; `states` of shape (n,) or (n, m), V."""
        offset = self._offset if states.ndim == 1 else self._offset[:, None]
        return self._gain @ states + offset

    def voltages(self, states: Floats) -> Floats:
        """Voltages that the motors get, V."""
        limits = np.array(self._limits).reshape((2,) + (1,) * (states.ndim - 1))
        return np.clip(self.command(states), -limits, limits)

    def rate(self, state: State) -> State:
        """Time derivative of the state."""
        asked, given = self._motor_voltages(state)
        theta_dot, psi_dot = state[2], state[3]
        pitch, yaw = self._accelerations(state[0], theta_dot, psi_dot, *given, *self._parameters)
        if self.resting:
            theta_dot = pitch = 0.0
        if self.size == 4:
            return theta_dot, psi_dot, pitch, yaw
        return theta_dot, psi_dot, pitch, yaw, *self._integrate_errors(state, asked, given)

    def _motor_voltages(self, state: State) -> tuple[list[float], list[float]]:
        """Voltages asked for, and what the limits leave of them, V."""
        asked = [offset + sum(map(mul, row, state)) for row, offset in self._rows]
        given = [min(max(v, -limit), limit) for v, limit in zip(asked, self._limits, strict=True)]
        return asked, given

    def _integrate_errors(self, state: State, asked: State, given: State) -> State:
        errors = [self._wanted[0] - state[0], self._wanted[1] - state[1]]
        if self._windup == "back-calculation":
            cut = (given[0] - asked[0], given[1] - asked[1])
            return [e + t[0] * cut[0] + t[1] * cut[1] for e, t in zip(errors, self._tracking, strict=True)]
        if self._windup == "clamping":
            for i, motor in enumerate(self._motor):
                voltage, limit = asked[motor], self._limits[motor]
                beyond = (abs(voltage) - limit) / (CLAMPING_BAND * limit)
                if beyond > 0.0 and errors[i] * self._direction[i] * voltage > 0.0:
                    errors[i] *= max(1.0 - beyond, 0.0)
        return errors

    def past_stop(self, state: State) -> float:
        """Negative while pitch is within its travel, rad."""
        return abs(state[0]) - self.travel

    def torque_turned(self, state: State) -> float:
        """Negative while the acceleration presses pitch onto its stop, rad/s²."""
        _, given = self._motor_voltages(state)
        pitch, _ = self._accelerations(state[0], 0.0, state[3], *given, *self._parameters)
        return -copysign(pitch, pitch * state[0])

    @property
    def event(self) -> EventFunction | None:
        """What ends the present mode: an impact, or the release from a stop."""
        if not np.isfinite(self.travel):
            return None
        return self.torque_turned if self.resting else self.past_stop

    def switch(self, state: Floats) -> Floats:
        """The state after an impact (pitch rate 0) or a release; changes the mode."""
        state = state.copy()
        state[0], state[2] = np.copysign(self.travel, state[0]), 0.0
        self.resting = not self.resting and self.torque_turned(state.tolist()) < 0.0
        if not self.resting:  # just inside, so that the next impact is seen
            state[0] *= 1.0 - 1e-12
        return state


def simulate_nonlinear(loop: Loop, limits: Limits, scenario: Scenario) -> Response:
    """Response of the nonlinear rig under the loop, adaptive with tolerance `scenario.rtol`.

    The rig starts at rest at its operating point unless `scenario.initial` says otherwise. Pitch
    meets its stops without rebound: the impact is located, the pitch rate set to 0, and the stop
    is left when the torque turns.
    """
    system = NonlinearLoop(loop, limits, scenario)
    t = np.linspace(0.0, scenario.duration, scenario.samples)
    states, impacts, findings = _run(system, loop, scenario, t)
    angles, voltages, diverged = hold_when_diverged(t, states[:2], system.voltages(states))
    saturated = _share_at_limit(voltages, limits, scenario.saturation)
    findings += [*diverged, *_remarks(saturated, impacts, system, limits)]
    reference = (float(system.reference[0]), float(system.reference[1]))
    start = (float(system.start[0]), float(system.start[1]))
    return Response("nonlinear", t, angles, voltages, reference, start, saturated, tuple(findings))


def _run(
    system: NonlinearLoop, loop: Loop, scenario: Scenario, t: Floats
) -> tuple[Floats, int, list[Finding]]:
    """States at all t (NaN where none was reached), the number of impacts, and remarks."""
    states = np.full((system.size, scenario.samples), np.nan)
    findings: list[Finding] = []
    state, time, done, impacts = system.start, 0.0, 0, 0
    if abs(state[0]) > system.travel:
        state = system.switch(state)
        findings.append(
            Finding("starts_on_stop", "warning", "The start lies beyond a stop of the pitch travel.")
        )
    rtol, atol = scenario.rtol, ABSOLUTE_TOLERANCE * scenario.rtol
    fastest = float(np.max(np.abs(loop.poles)))
    method = integrate_stiff if fastest * scenario.duration > STIFF else integrate
    try:
        while done < scenario.samples and impacts < MOST_IMPACTS:
            segment = method(system.rate, time, state, t[done:], event=system.event, rtol=rtol, atol=atol)
            reached = segment.states.shape[1]
            states[:, done : done + reached] = segment.states
            done, time, state = done + reached, segment.t, segment.state
            if segment.event:
                impacts += not system.resting
                state = system.switch(state)
    except StepBudgetError as error:
        findings.append(Finding("integration_stopped", "warning", f"The simulation was given up: {error}."))
    return states, impacts, findings


def _share_at_limit(voltages: Floats, limits: Limits, saturation: bool) -> tuple[float, float]:
    if not saturation:
        return 0.0, 0.0
    ceiling = np.array([[limits.V_p], [limits.V_y]])
    share = np.mean(np.abs(voltages) >= ceiling, axis=1)
    return float(share[0]), float(share[1])


def _remarks(
    saturated: tuple[float, float], impacts: int, system: NonlinearLoop, limits: Limits
) -> Iterator[Finding]:
    for signal, share, limit in zip(INPUTS, saturated, (limits.V_p, limits.V_y), strict=True):
        if share:
            yield Finding(
                f"saturation_{signal.name}",
                "warning",
                f"The {signal.meaning} is at its limit of ±{limit:g} V for {100 * share:.0f} % of the time.",
            )
    if impacts:
        degrees = np.degrees(system.travel)
        yield Finding("travel_stop", "warning", f"Pitch hits a stop of its travel at ±{degrees:.1f}°.")
    if abs(system.reference[0]) > system.travel:
        degrees = np.degrees(system.travel)
        yield Finding(
            "reference_beyond_stop",
            "warning",
            f"The pitch reference lies beyond the rig's travel of ±{degrees:.1f}°: it cannot be reached.",
        )
