"""The rig with rotors, thrust curves and friction once more, in plain Python: SciPy's DOP853 from event to event."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp

MOST_EVENTS = 400


@dataclass
class MachineReference:
    """A loop around the rig, from the sheet: accelerations typed here, the law from its definition.

    State: θ, ψ, θ̇, ψ̇, z_p, z_y, v_p, v_y and what an estimator has. Modes: the limit that each motor is at, the part
    of its thrust curve, each axis' way (0: stuck), and the stop that pitch rests on.
    """

    spec: object
    loop: object
    limits: tuple[float, float] = (np.inf, np.inf)
    travel: float = np.inf
    tracking: np.ndarray | None = None
    at: list = field(default_factory=lambda: [0, 0])
    zone: list = field(default_factory=lambda: [1, 1])
    way: list = field(default_factory=lambda: [1, 1])
    rest: int = 0

    def __post_init__(self):
        self.p, self.machine = self.spec.parameters, self.loop.actuators
        scenario = self.spec.scenario
        self.reference = np.array(scenario.resolved(self.spec.theta_0)[:2])
        self.origin = np.array([self.spec.theta_0, 0.0])

    def asked(self, y):
        """u = trim − K (x̂ − x₀) + P e + I z."""
        loop, K, trim = self.loop, self.loop.design.K, self.loop.design.trim
        angles, error = y[:2] - self.origin, self.reference - y[:2]
        known = np.concatenate((angles, y[2:4]))
        if loop.estimator is not None:
            w = y[8 : 8 + loop.estimator.order]
            known = loop.estimator.from_state @ w + loop.estimator.from_angles @ angles
        if K.shape[1] == 6 and len(known) == 4:
            known = np.concatenate((known, y[6:8] - trim))
        u = trim - K @ known + loop.proportional @ error + loop.feedforward @ (self.reference - self.origin)
        return u if loop.integral is None else u + loop.integral @ y[4:6]

    def given(self, u):
        return np.array([self.at[i] * self.limits[i] if self.at[i] else u[i] for i in range(2)])

    def speeds(self, y, V):
        return np.array([y[6 + i] if self.machine.tau[i] > 0 else V[i] for i in range(2)])

    def thrusts(self, v):
        out = np.array(v)
        for i in range(2):
            s, dead = self.machine.square[i], self.machine.dead_zone[i]
            if s:
                out[i] = self.zone[i] * s * (v[i] - self.zone[i] * dead) ** 2
        return out

    def torques(self, y, V):
        """What accelerates each axis besides friction, N·m, and the inertias."""
        p, ml2 = self.p, self.p.m * self.p.l**2
        f = self.thrusts(self.speeds(y, V))
        s, c = np.sin(y[0]), np.cos(y[0])
        pitch = p.K_pp * f[0] + p.K_py * f[1] - p.B_p * y[2] - p.K_s * y[0]
        pitch -= ml2 * s * c * y[3] ** 2 + p.m * p.g * p.l * c
        yaw = p.K_yp * f[0] + p.K_yy * f[1] - p.B_y * y[3] + 2 * ml2 * s * c * y[2] * y[3]
        return np.array([pitch, yaw]), np.array([p.J_p + ml2, p.J_y + ml2 * c**2])

    def rates(self, _t, y):
        u = self.asked(y)
        V = self.given(u)
        torque, inertia = self.torques(y, V)
        acceleration = np.array(
            [
                (torque[i] - self.way[i] * self.machine.coulomb[i]) / inertia[i] if self.sliding(i) else 0.0
                for i in range(2)
            ]
        )
        rates = np.array(y[2:4])
        if self.rest:
            acceleration[0] = rates[0] = 0.0
        error = self.reference - y[:2]
        if self.tracking is not None:
            error = error + self.tracking @ (V - u)
        tau = self.machine.tau
        rotors = [(V[i] - y[6 + i]) / tau[i] if tau[i] > 0 else 0.0 for i in range(2)]
        out = [*rates, *acceleration, *error, *rotors]
        known = self.loop.estimator
        if known is not None:
            w = y[8:]
            out += [*(known.F @ w + known.G @ (y[:2] - self.origin) + known.H @ (V - self.loop.design.trim))]
        return np.array(out)

    def sliding(self, axis):
        return self.machine.breakaway[axis] == 0 or self.way[axis] != 0

    def guards(self):
        """Functions that are positive while the modes hold, with what to do when one is not any more."""
        found = [guard for i in range(2) for guard in (*self.motor_guards(i), *self.friction_guards(i))]
        if self.rest:
            found.append((self.pressing, "leave", 0))
        elif np.isfinite(self.travel):
            found.append((lambda y: self.travel - abs(y[0]), "meet", 0))
        return found

    def motor_guards(self, i):
        if np.isfinite(self.limits[i]):
            side = self.at[i]
            beyond = (lambda y: side * self.asked(y)[i] - self.limits[i], "inside", i)
            within = (lambda y: self.limits[i] - abs(self.asked(y)[i]), "limit", i)
            yield beyond if side else within
        if self.machine.square[i]:
            dead, zone = self.machine.dead_zone[i], self.zone[i]
            yield (
                (lambda y: zone * self.speed(y, i) - dead if zone else dead - abs(self.speed(y, i))),
                "zone",
                i,
            )

    def friction_guards(self, i):
        if self.machine.breakaway[i] and not (i == 0 and self.rest):
            way = self.way[i]
            if way:
                yield lambda y: way * y[2 + i], "stand", i
            else:
                yield lambda y: self.machine.breakaway[i] - abs(self.torque(y, i)), "break", i

    def speed(self, y, i):
        return self.speeds(y, self.given(self.asked(y)))[i]

    def torque(self, y, i):
        return self.torques(y, self.given(self.asked(y)))[0][i]

    def pressing(self, y):
        return self.rest * self.torque(y, 0) + self.machine.breakaway[0]

    def settle(self, y):
        """Modes of motors and thrust curves by the state alone."""
        u = self.asked(y)
        for i in range(2):
            self.at[i] = int(np.sign(u[i])) if abs(u[i]) > self.limits[i] else 0
        v = self.speeds(y, self.given(u))
        for i in range(2):
            dead = self.machine.dead_zone[i]
            self.zone[i] = 0 if dead and abs(v[i]) <= dead else (1 if v[i] >= 0 else -1)

    def find_way(self, y, i):
        torque = self.torque(y, i)
        if y[2 + i] != 0:
            self.way[i] = int(np.sign(y[2 + i]))
        elif abs(torque) <= self.machine.breakaway[i]:
            self.way[i] = 0
        else:
            self.way[i] = int(np.sign(torque))

    def switch(self, what, i, y):
        if what == "limit":
            self.at[i] = int(np.sign(self.asked(y)[i]))
        elif what == "inside":
            self.at[i] = 0
        elif what == "zone":
            v, dead = self.speed(y, i), self.machine.dead_zone[i]
            if dead:
                self.zone[i] = 0 if self.zone[i] else int(np.sign(v))
            else:
                self.zone[i] = -self.zone[i]
        elif what == "stand":
            y[2 + i] = 0.0
            self.find_way(y, i)
        elif what == "break":
            self.find_way(y, i)
            if self.way[i] == 0:  # at the very edge
                self.way[i] = int(np.sign(self.torque(y, i)))
        elif what == "meet":
            self.rest = int(np.sign(y[0]))
            y[0], y[2] = self.rest * self.travel, 0.0
            self.settle(y)
            if self.pressing(y) <= 0:
                self.switch("leave", 0, y)
        else:
            self.way[0], self.rest = -self.rest, 0
            y[0] *= 1 - 1e-12

    def course(self, y, t, rtol=1e-10, step=0.01):
        """θ, ψ, θ̇, ψ̇ at t, (4, len(t)); None where it switches too often. And the number of events."""
        y, now, out, events = np.array(y, dtype=float), t[0], np.empty((4, len(t))), 0
        self.settle(y)
        if abs(y[0]) >= self.travel:
            self.switch("meet", 0, y)
        for i in range(2):
            if self.machine.breakaway[i]:
                self.find_way(y, i)
        out[:, 0], done = y[:4], 1
        while done < len(t):
            guards = self.guards()
            functions = []
            for guard, _, _ in guards:

                def event(_t, y, guard=guard):
                    return guard(y)

                event.terminal, event.direction = True, -1
                functions.append(event)
            solved = solve_ivp(
                self.rates,
                (now, t[-1]),
                y,
                "DOP853",
                rtol=rtol,
                atol=1e-2 * rtol,
                events=functions,
                dense_output=True,
                max_step=step,
            )
            here = solved.t[-1]
            while done < len(t) and t[done] <= here:
                out[:, done] = solved.sol(t[done])[:4]
                done += 1
            y, now = solved.y[:, -1].copy(), here
            if solved.status == 1:
                events += 1
                if events > MOST_EVENTS:
                    return None, events
                which = next(n for n, times in enumerate(solved.t_events) if len(times))
                self.switch(*guards[which][1:], y)
            else:
                break
        return out, events
