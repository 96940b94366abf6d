"""Flights beside SciPy: the rig's equations written anew, integrated by DOP853 from event to event."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import heli2dof_core as heli
from heli2dof_core.flight import Rig

FLIGHTS = int(os.environ.get("HELI2DOF_FLIGHTS", "12"))
"""Random flights of the suite; 50 are a minute."""
LENGTH = 1.5
"""s, of each."""
GRAVITY = 9.81


@dataclass
class Acting:
    """What acts from outside, as a log's words say it."""

    reference: Any = (0.0, 0.0)
    push: Any = (0.0, 0.0)
    thrust: Any = (1.0, 1.0)
    hung: Any = (0.0, 0.0)
    gust: Any = (0.0, 0.0, 0.0, 1.0)
    """Largest torques, N·m, beginning and length in ticks."""


class Outsider:
    """The rig and its controller in NumPy, from the design's published matrices and docs alone."""

    def __init__(self, spec: heli.Spec, step: float) -> None:
        self.step = step
        self.take(spec)
        theta, psi = spec.scenario.resolved(spec.theta_0)[2:4]
        self.x = np.array([theta, psi, 0.0, 0.0, *self.trim])  # θ, ψ, θ̇, ψ̇, v_p, v_y
        self.z, self.computed, self.tick, self.gust = np.zeros(2), self.trim.copy(), 0, 0.0
        self.acting = Acting(reference=(spec.theta_0, 0.0))

    def take(self, spec: heli.Spec) -> None:
        self.spec, loop = spec, heli.loop_of(spec)
        self.K, self.trim = loop.design.K, np.array(loop.design.trim)
        pi = spec.outer.outer == "pi"
        zero = np.zeros((2, 2))
        self.integral = zero if loop.integral is None else loop.integral
        # ∂u/∂r of PI loops is their proportional part, of the inner loop alone the constant feedforward
        self.by_reference = loop.voltage_from_reference
        self.proportional = self.by_reference if pi else zero
        self.tau = np.array([spec.rotors.pitch.tau, spec.rotors.yaw.tau])
        self.limits = np.array([spec.limits.V_p, spec.limits.V_y])

    def asked(self) -> np.ndarray:
        """Voltages by the law: state feedback, PI or feedforward, trim."""
        x, r = self.x[:4], np.array(self.acting.reference)
        base = np.array([self.spec.theta_0, 0.0])
        u = self.trim - self.K @ (x - np.array([*base, 0.0, 0.0])) + self.by_reference @ (r - base)
        return u - self.proportional @ (x[:2] - base) + self.integral @ self.z

    def change(self, spec: heli.Spec) -> None:
        """Takes another design without a jump of the voltages as they are limited."""
        before = np.clip(self.asked(), -self.limits, self.limits)
        self.take(spec)
        self.z = np.zeros(2)
        self.z = np.linalg.solve(self.integral, before - self.asked())

    def sample(self) -> np.ndarray:
        """One sample of the controller: the voltages that the motors have until the next."""
        asked = self.asked()
        out = np.clip(asked, -self.limits, self.limits)
        e = np.array(self.acting.reference) - self.x[:2]
        for i in range(2):
            motor = int(np.abs(self.integral[:, i]).argmax())
            pushes = self.integral[motor, i] * e[i] * asked[motor] > 0.0
            if self.spec.scenario.anti_windup == "clamping" and out[motor] != asked[motor] and pushes:
                e[i] = 0.0
        digital = self.spec.scenario.digital
        assert digital is not None
        self.z = self.z + digital.sample_time * e
        late, self.computed = self.computed, out
        return late if digital.delay else out

    def rates(self, t: float, x: np.ndarray, volts: np.ndarray) -> list[float]:
        """Eqs. 9–12 with rotors, and what acts."""
        p, a = self.spec.parameters, self.acting
        theta, _, theta_dot, psi_dot = x[:4]
        v = np.where(self.tau > 0.0, x[4:], volts) * np.array(a.thrust)
        mass, arm = a.hung
        ml2 = p.m * p.l**2 + mass * arm**2
        gravity = p.m * p.g * p.l + mass * GRAVITY * arm
        torque = np.array(a.push) + self.gust * np.array(a.gust[:2])
        s, c = np.sin(theta), np.cos(theta)
        pitch = p.K_pp * v[0] + p.K_py * v[1] - p.B_p * theta_dot - p.K_s * theta
        pitch += torque[0] - ml2 * s * c * psi_dot**2 - gravity * c
        yaw = (
            p.K_yp * v[0]
            + p.K_yy * v[1]
            - p.B_y * psi_dot
            + 2 * ml2 * s * c * theta_dot * psi_dot
            + torque[1]
        )
        lag = [(volts[i] - x[4 + i]) / self.tau[i] if self.tau[i] > 0.0 else 0.0 for i in range(2)]
        return [theta_dot, psi_dot, pitch / (p.J_p + ml2), yaw / (p.J_y + ml2 * c * c), *lag]

    def fly(self, ticks: int, volts: np.ndarray) -> None:
        """By DOP853, under constant voltages; a gust is constant within a tick."""
        for _ in range(ticks):
            begun, length = self.acting.gust[2:]
            since = self.tick - begun
            self.gust = 0.5 * (1 - np.cos(2 * np.pi * since / length)) if 0 <= since < length else 0.0
            found = solve_ivp(
                self.rates, (0.0, self.step), self.x, method="DOP853", args=(volts,), rtol=1e-10, atol=1e-12
            )
            self.x, self.tick = found.y[:, -1], self.tick + 1


def random_spec(rng: np.random.Generator, sample_time: float, delay: bool, lag: bool) -> heli.Spec:
    """A design whose parts are random, on a rig without stops; PI loops, so that changes can be bumpless."""
    poles = [-rng.uniform(2, 12) for _ in range(4)]
    if rng.random() < 0.5:
        pole = complex(-rng.uniform(2, 6), rng.uniform(1, 6))
        poles[2:] = [pole, pole.conjugate()]
    spec = heli.Spec.from_preset(
        "quanser-2dof-manual",
        poles=poles,
        pitch=(rng.uniform(1, 20), rng.uniform(0.2, 2.0)),
        yaw=(rng.uniform(1, 20), rng.uniform(0.2, 2.0)),
        decoupler=bool(rng.random() < 0.3),
    )
    if lag:
        spec = spec.changed(rotors=heli.Rotors(heli.Rotor(tau=0.05), heli.Rotor(tau=0.03)))
    digital = heli.Digital(sample_time, delay=delay, encoders=(0, 0), rates="true")
    windup = "clamping" if rng.random() < 0.5 else "none"
    return replace(
        spec,
        scenario=replace(
            spec.scenario,
            digital=digital,
            travel_stops=False,
            anti_windup=windup,
            initial=(None, None, 0.0, 0.0),
        ),
    )


@pytest.mark.parametrize("seed", range(FLIGHTS))
def test_a_flight_is_what_scipy_makes_of_the_same_events(seed):
    rng = np.random.default_rng(seed)
    period = float(rng.choice([0.002, 0.004, 0.01]))
    delay, lag = bool(rng.random() < 0.3), bool(rng.random() < 0.5)
    spec = random_spec(rng, period, delay, lag)
    rig, other = Rig(spec), Outsider(spec, period / round(period / 0.002))
    rig.do("reference", spec.theta_0, 0.0)
    worst, per_sample = 0.0, round(period / 0.002)
    while other.tick * other.step < LENGTH - 1e-9:
        if rng.random() < 0.08:
            word = rng.choice(["reference", "push", "thrust", "hung", "gust", "design"])
            if word == "reference":
                other.acting.reference = (spec.theta_0 + rng.uniform(-0.2, 0.2), rng.uniform(-1, 1))
                rig.do("reference", *other.acting.reference)
            elif word == "push":
                other.acting.push = tuple(rng.uniform(-0.2, 0.2, 2))
                rig.do("push", *other.acting.push)
            elif word == "thrust":
                other.acting.thrust = tuple(rng.uniform(0.5, 1.2, 2))
                rig.do("thrust", *other.acting.thrust)
            elif word == "hung":
                other.acting.hung = (rng.uniform(0, 0.3), rng.uniform(-0.2, 0.2))
                rig.do("hung", *other.acting.hung)
            elif word == "gust":
                other.acting.gust = (*rng.uniform(-0.2, 0.2, 2), other.tick, int(rng.integers(20, 200)))
                rig.do("gust", *other.acting.gust[:2], other.acting.gust[3])
            elif np.abs(other.asked()).max() < other.limits.min():
                # at a limit the new voltage would be it but for rounding, which decides whether clamping acts
                new = random_spec(rng, period, delay, lag)
                other.change(new)
                rig.change(new)
        other.fly(per_sample, other.sample())
        rig.step()
        worst = max(worst, float(np.abs(other.x[:4] - rig.y[:4]).max()))
    assert worst <= 1e-5
