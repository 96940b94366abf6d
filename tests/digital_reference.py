"""The rig under a digital controller once more: a loop over the samples, SciPy's DOP853 between them.

Written from the definitions of `Digital` and `Scenario`; nothing of heli2dof's own simulation in it.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

from tests.reference import BEYOND, FREE, Piece, Reference


class DigitalReference(Reference):
    """Samples, encoders, filtered rates, noise, delay, sums for integrals; the voltages are held in between."""

    def __init__(self, loop, limits, scenario):
        super().__init__(loop, limits, scenario)
        self.digital, w, zeta = scenario.digital, 2 * np.pi * 20, 0.85
        continuous = (
            np.array([[0, 1], [-(w**2), -2 * zeta * w]]),
            np.array([[0.0], [1]]),
            np.eye(2),
            np.zeros((2, 1)),
        )
        self.F, self.b, *_ = cont2discrete(continuous, self.digital.sample_time)
        self.square = w**2
        trim = loop.design.plant.trim if scenario.trim_feedforward else np.zeros(2)
        self.before = np.clip(trim, -self.limits, self.limits)
        self.held = self.before

    def given(self, _y):
        """What the motors have until the next sample."""
        return self.held

    def counted(self, angles):
        """The angles as the encoders tell them."""
        seen = np.array(angles, dtype=float)
        for i, counts in enumerate(self.digital.encoders):
            if counts:
                width = 2 * np.pi / counts
                seen[i] = width * np.floor(seen[i] / width + 0.5)
        return seen

    def pieces(self, end, rtol=1e-12) -> Iterator[Piece]:
        """The course until `end`, at least a piece per sample."""
        digital, x, z = self.digital, self.y[:4].copy(), np.zeros(2)
        if abs(x[0]) >= self.travel:
            x[0], x[2] = np.sign(x[0]) * self.travel, 0.0
        count = int(np.ceil(end / digital.sample_time)) + 2
        noise = digital.noise * np.random.default_rng(digital.seed).standard_normal((count, 2))
        filters = np.zeros((2, 2))
        filters[:, 0] = self.counted(x[:2]) / self.square  # as if it had rested there
        waiting, disturbance = self.before, self.scenario.disturbance
        for k in range(count):
            now = k * digital.sample_time
            if now >= end * (1 - 1e-12):
                return
            angles = self.counted(x[:2] + noise[k])
            rates = x[2:]
            if digital.rates == "filtered":
                rates = self.square * filters[:, 1]
                filters = filters @ self.F.T + angles[:, None] * self.b.T
            asked = np.array(self.asked([*angles, *rates, *z]))
            fresh = np.clip(asked, -self.limits, self.limits)
            self.held, waiting = (waiting, fresh) if digital.delay else (fresh, fresh)
            z = z + digital.sample_time * self.error(angles, asked, fresh)
            if disturbance is not None and now >= disturbance.time - 1e-12:
                self.disturbed = (disturbance.V_p, disturbance.V_y)
            until = min((k + 1) * digital.sample_time, end)
            limited = np.abs(self.held) >= self.limits
            modes = tuple(BEYOND if at else FREE for at in limited)
            for sol in self.between(now, until, x, rtol):
                yield Piece(sol, modes, tuple(np.sign(self.held)))
                x = self.reached

    def error(self, angles, asked, fresh):
        """What the integrals add up in this sample, per second."""
        e = self.wanted - angles
        if self.I is None or not self.scenario.saturation:
            return e
        if self.scenario.anti_windup == "clamping":
            for i, m in enumerate(self.motor_of):
                if fresh[m] != asked[m] and self.I[m, i] * e[i] * asked[m] > 0:
                    e[i] = 0.0
        elif self.back is not None:
            e = e + self.back @ (fresh - asked)
        return e

    def between(self, now, until, x, rtol):
        """From a sample to the next one: dense outputs, one or, where a stop is met or left, several."""
        x = x.copy()
        if abs(x[0]) >= self.travel:
            self.rest(x)
        while now < until:
            near = self.stop or abs(x[0]) + 2 * (until - now) * (1 + abs(x[2])) > 0.8 * self.travel
            found = solve_ivp(
                self.moving, (now, until), x, "DOP853",
                dense_output=True, events=self.stops() if near else None, rtol=rtol, atol=1e-13,
            )  # fmt: skip
            assert found.status >= 0, found.message
            self.reached = x = found.y[:, -1].copy()
            if found.status == 1:
                x = found.y_events[0][0].copy()
                if self.stop:
                    self.stop = 0
                    x[0] *= 1 - 1e-12
                else:
                    self.rest(x)
                self.reached = x
            yield found.sol
            now = float(found.sol.ts[-1])

    def rest(self, x):
        """Pitch meets its stop."""
        self.stop = int(np.sign(x[0]))
        x[0], x[2] = self.stop * self.travel, 0.0
        if self.stop * self.mechanics(x)[0] <= 0:
            self.stop = 0
            x[0] *= 1 - 1e-12

    def moving(self, _t, x):
        pitch, yaw = self.driven(x.tolist(), *self.held)
        return [0.0, x[3], 0.0, yaw] if self.stop else [x[2], x[3], pitch, yaw]

    def stops(self):
        if self.stop:
            found = lambda _t, x: self.stop * self.mechanics([x[0], x[1], 0.0, x[3]])[0]  # noqa: E731
        else:
            found = lambda _t, x: self.travel - abs(x[0])  # noqa: E731
        found.terminal, found.direction = True, -1
        return [found]
