"""Flights of rigs as benches have them, beside SciPy: friction, stops, curves, encoders, observers, hands.

Between two events that come from outside the rig is `MachineReference`'s, integrated by DOP853 from one of its own
events (an axis stands, breaks away, meets a stop, a rotor leaves its dead zone) to the next; the controller is typed
here from the docs: encoders round, filters and observers go on by their exact step, integrals by Euler's.
"""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.signal import cont2discrete

import heli2dof_core as heli
from heli2dof_core.flight import Rig
from tests.core.machine_reference import MachineReference

SEEDS = int(os.environ.get("HELI2DOF_MACHINE_FLIGHTS", "2"))
"""Random flights of each kind of rig."""
SAMPLES = 150
GRAVITY, OMEGA, ZETA = 9.81, 2 * np.pi * 20, 0.85


class Bench(MachineReference):
    """The rig under voltages that are held, with what acts from outside."""

    held = np.zeros(2)
    torque_outside = np.zeros(2)
    share = np.ones(2)
    hung = (0.0, 0.0)

    def given(self, u):
        return self.held

    def thrusts(self, v):
        return self.share * super().thrusts(v)

    def torques(self, y, V):
        torque, inertia = super().torques(y, V)
        mass, arm = self.hung
        ml2, (s, c) = mass * arm**2, (np.sin(y[0]), np.cos(y[0]))
        more = [-ml2 * s * c * y[3] ** 2 - mass * GRAVITY * arm * c, 2 * ml2 * s * c * y[2] * y[3]]
        return torque + more + self.torque_outside, np.add(inertia, [ml2, ml2 * c**2])

    def moved(self, y, w, seconds):
        """The state after so many seconds; rotors by their exact course. `w`, an estimator's, is the caller's."""
        out, _ = self.course(np.concatenate((y, w)), (0.0, seconds))
        assert out is not None
        y = y.copy()
        y[:4] = out[:, -1]
        for i, tau in enumerate(self.machine.tau):
            y[6 + i] = self.held[i] + (y[6 + i] - self.held[i]) * np.exp(-seconds / tau) if tau else 0.0
        return y


class Outsider:
    """A flight, sample by sample."""

    def __init__(self, spec: heli.Spec) -> None:
        self.time, self.bench = 0.0, Bench(spec, heli.loop_of(spec), travel=spec.limits.theta or np.inf)
        self.sticks: np.ndarray | None = None
        self.reference, self.turn, self.stuck = np.array([spec.theta_0, 0.0]), np.zeros(2), np.zeros(2)
        self.push, self.gust = np.zeros(2), (np.zeros(2), 0.0, 1.0)
        self.origin = np.array([spec.theta_0, 0.0])
        self.z = np.zeros(2)
        self.take(spec)
        self.reading = self.rounded(self.origin)
        self.filters = np.array([[angle / OMEGA**2, 0.0] for angle in self.reading])
        self.computed = self.loop.design.trim.copy()
        known = self.loop.estimator
        self.w = np.zeros(0 if known is None else known.order)
        if known is not None:
            self.w[[0, 2] if known.measured == "filtered" else [0, 1]] = self.reading - self.origin
        self.y = np.concatenate(([spec.theta_0, 0.0], np.zeros(4), self.computed))

    def take(self, spec: heli.Spec) -> None:
        """Another design for the same rig."""
        self.spec, self.loop, digital = spec, heli.loop_of(spec), spec.scenario.digital
        assert digital is not None
        self.digital, self.period = digital, digital.sample_time
        self.ticks = int(np.ceil(self.period / 0.002))  # of a sample
        self.limits = np.array([spec.limits.V_p, spec.limits.V_y])
        old = self.bench
        self.bench = Bench(spec, self.loop, travel=old.travel, rest=old.rest, way=old.way)
        self.bench.share, self.bench.hung = old.share, old.hung
        A = np.array([[0.0, 1.0], [-(OMEGA**2), -2 * ZETA * OMEGA]])
        own = (A, np.array([[0.0], [1.0]]), np.eye(2), np.zeros((2, 1)))
        self.F, self.b, *_ = cont2discrete(own, self.period)
        known = self.loop.estimator
        if known is not None:
            inputs = np.hstack((known.G, known.H))
            own = (known.F, inputs, np.eye(known.order), np.zeros((known.order, 4)))
            self.estimator = cont2discrete(own, self.period)[:2]

    def rounded(self, angles: np.ndarray) -> np.ndarray:
        widths = [2 * np.pi / counts if counts else 0.0 for counts in self.digital.encoders]
        return np.array([w * np.floor(a / w + 0.5) if w else a for a, w in zip(angles, widths, strict=True)])

    def seen(self) -> np.ndarray:
        """Angles and rates as the controller has them now."""
        angles = np.where(self.stuck, self.reading, self.rounded(self.y[:2]))
        rates = np.where(self.stuck, 0.0, self.y[2:4])
        if self.digital.rates == "filtered":
            rates = OMEGA**2 * self.filters[:, 1]
        return np.concatenate((angles, rates))

    def asked(self, seen: np.ndarray, z: np.ndarray) -> np.ndarray:
        self.bench.reference = self.reference
        return self.bench.asked(np.concatenate((seen, z, self.y[6:8], self.w)))

    def off_hands(self, volts: np.ndarray) -> None:
        """The controller goes on from these voltages without a jump."""
        rest = self.asked(self.seen(), np.zeros(2))
        self.sticks, self.z = None, np.linalg.solve(self.loop.integral, volts - rest)

    def change(self, spec: heli.Spec) -> None:
        before = np.clip(self.asked(self.seen(), self.z), -self.limits, self.limits)
        self.take(spec)
        self.off_hands(before)

    def step(self) -> None:
        """A sample of the controller, and the rig until the next."""
        seen = self.seen()
        self.reading = seen[:2]
        self.filters = self.filters @ self.F.T + seen[:2, None] * self.b.T
        asked = self.asked(seen, self.z) if self.sticks is None else self.sticks
        fresh = np.clip(asked, -self.limits, self.limits)
        if self.sticks is None:
            error = self.reference - seen[:2]
            against = (fresh != asked) & (np.diag(self.loop.integral) * error * asked > 0)
            clamps = self.spec.scenario.anti_windup == "clamping"
            self.z = self.z + self.period * np.where(against & clamps, 0.0, error)
        self.bench.held, self.computed = self.computed if self.digital.delay else fresh, fresh
        step = self.period / self.ticks
        for _ in range(self.ticks):
            largest, begun, length = self.gust
            since = self.time - begun
            share = 0.5 * (1 - np.cos(2 * np.pi * since / length)) if -1e-9 < since < length - 1e-9 else 0.0
            self.bench.torque_outside = self.push + share * largest
            self.y, self.time = self.bench.moved(self.y, self.w, step), self.time + step
            self.reference = self.reference + step * self.turn
        if self.w.size:
            F, G = self.estimator
            into = np.concatenate((seen[:2] - self.origin, self.bench.held - self.loop.design.trim))
            self.w = F @ self.w + G @ into


LAG = heli.Rotors(heli.Rotor(tau=0.05), heli.Rotor(tau=0.08))
CURVED = heli.Rotors(heli.Rotor(0.06, "quadratic", 1.0), heli.Rotor(0.0, "quadratic", 0.5, matched_at=6.0))
STICKY = heli.AxisFriction(heli.Friction(0.02, 0.03), heli.Friction(0.015, 0.02))
OBSERVER = heli.Observer(heli.PoleSet([-20.0, -22.0, -21.0, -23.0]))
COARSE, EXACT = (2048, 4096), {"encoders": (0, 0), "rates": "true"}
RIGS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "friction": ({"friction": STICKY}, EXACT),
    "curves": ({"rotors": CURVED}, EXACT),
    "friction and curves": ({"friction": STICKY, "rotors": CURVED}, {**EXACT, "delay": True}),
    "encoders": ({"rotors": LAG}, {"encoders": COARSE}),
    "filtered": ({"rotors": LAG, "measured": "filtered"}, {"encoders": COARSE, "rates": "true"}),
    "observer": (
        {"rotors": LAG, "friction": STICKY, "measured": "observer", "observer": OBSERVER},
        {"encoders": COARSE, "delay": True},
    ),
    "rotors placed": (
        {"rotors": LAG, "place_rotors": True, "measured": "observer", "observer": OBSERVER},
        {"encoders": COARSE},
    ),
}


def random_spec(rng: np.random.Generator, kind: str) -> heli.Spec:
    (parts, digital), period = RIGS[kind], float(rng.choice([0.005, 0.008, 0.01]))
    spec = heli.Spec.from_preset(
        "quanser-2dof-manual",
        poles=[-rng.uniform(3, 5), -rng.uniform(3, 5), complex(-3, 2), complex(-3, -2)],
        pitch=(rng.uniform(2, 8), rng.uniform(0.6, 1.5)),
        yaw=(rng.uniform(2, 8), rng.uniform(0.6, 1.5)),
        **parts,
    )
    own = {"digital": heli.Digital(period, **digital), "anti_windup": "clamping", "noise": (0.0, 0.0)}
    return replace(spec, scenario=replace(spec.scenario, initial=(None, None, 0.0, 0.0), **own))


class Both:
    """The rig and the outsider, to whom the same happens: a method for each word."""

    def __init__(self, kind: str, rng: np.random.Generator) -> None:
        self.kind, self.rng = kind, rng
        spec = random_spec(rng, kind)
        self.rig, self.other = Rig(spec), Outsider(spec)
        self.rig.do("reference", *self.other.reference)

    def reference(self) -> None:
        self.other.reference, self.other.turn = self.rng.uniform([-0.2, -0.8], [0.2, 0.8]), np.zeros(2)
        self.rig.do("reference", *self.other.reference)

    def turn(self) -> None:
        self.other.turn = self.rng.uniform(-0.3, 0.3, 2)
        self.rig.do("turn", *self.other.turn)

    def push(self) -> None:
        self.other.push = self.rng.uniform(-0.3, 0.3, 2)
        self.rig.do("push", *self.other.push)

    def gust(self) -> None:
        torques, ticks = self.rng.uniform(-0.5, 0.5, 2), int(self.rng.integers(50, 300))
        self.other.gust = (torques, self.other.time, ticks * self.rig.controller.tick)
        self.rig.do("gust", *torques, ticks)

    def thrust(self) -> None:
        self.other.bench.share = self.rng.uniform(0.6, 1.1, 2)
        self.rig.do("thrust", *self.other.bench.share)

    def hung(self) -> None:
        self.other.bench.hung = (self.rng.uniform(0, 0.2), self.rng.uniform(-0.2, 0.2))
        self.rig.do("hung", *self.other.bench.hung)

    def stuck(self) -> None:
        self.other.stuck = np.array([1.0, 0.0]) if not self.other.stuck.any() else np.zeros(2)
        self.rig.do("stuck", *self.other.stuck)

    def hands(self) -> None:
        if self.other.sticks is None:
            self.other.sticks = self.rng.uniform([-10, -10], [22, 10])  # up to a stop, or down to one
            self.rig.do("hands", 1)
            self.rig.do("sticks", *self.other.sticks)
        else:
            self.rig.do("hands", 0)
            self.other.off_hands(self.other.sticks)

    def design(self) -> None:
        other = self.other
        # at a limit the new voltage would be it but for rounding, which decides whether clamping acts
        if other.sticks is None and np.all(np.abs(other.asked(other.seen(), other.z)) < other.limits):
            new = random_spec(self.rng, self.kind)
            self.rig.change(new)
            other.change(new)

    def step(self) -> float:
        """A sample of both; how far they are apart then, rad and rad/s."""
        self.other.step()
        self.rig.fly(self.other.time - self.rig.time)
        return float(np.abs(self.other.y[:4] - self.rig.y[:4]).max())


WORDS = ("reference", "turn", "push", "gust", "thrust", "hung", "stuck", "hands", "design")


@pytest.mark.parametrize("seed", range(SEEDS))
@pytest.mark.parametrize("kind", RIGS)
def test_a_flight_of_a_bench_is_what_scipy_makes_of_it(kind, seed):
    rng = np.random.default_rng(100 * seed + list(RIGS).index(kind))
    both = Both(kind, rng)
    due = dict(
        zip(rng.permutation(SAMPLES - 10)[: 2 * len(WORDS)].tolist(), rng.permutation(WORDS * 2), strict=True)
    )
    apart, stood = [], 0
    for n in range(SAMPLES):
        if n in due:
            getattr(both, due[n])()
        apart.append(both.step())
        stood += both.other.y[3] == 0.0
    assert max(apart) <= 1e-7 and both.rig.time == pytest.approx(both.other.time)
    assert both.rig.takeovers and (stood > 1 or "friction" not in RIGS[kind][0])
