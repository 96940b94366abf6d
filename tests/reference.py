"""The rig's loop once more, by SciPy: DOP853 from event to event, the equations typed from the theory sheet.

Slow and careful, and nothing of heli2dof's own simulation in it: what the kernels are measured against.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, sin
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

FREE, BEYOND, SLIDING = "free", "beyond", "sliding"


@dataclass(frozen=True)
class Piece:
    """A stretch without events: SciPy's dense output, and the motors' modes on it."""

    sol: Any
    mode: tuple[str, str]
    side: tuple[float, float]


class Reference:
    """One loop with limits, stops, anti-windup and disturbance; modes are re-decided at every event."""

    def __init__(self, loop, limits, scenario):
        plant = loop.design.plant
        self.rig, self.K, self.scenario = plant.parameters, loop.design.K, scenario
        self.P, self.I = loop.proportional, loop.integral
        theta, psi, *start = scenario.resolved(plant.theta_0)
        self.wanted = np.array([theta, psi])
        trim = plant.trim if scenario.trim_feedforward else np.zeros(2)
        fixed = trim + loop.feedforward @ (self.wanted - [plant.theta_0, 0.0])
        of_state = np.hstack([-self.K, np.zeros((2, 2)) if self.I is None else self.I])
        of_state[:, :2] -= self.P
        fixed = fixed + self.P @ self.wanted + self.K @ [plant.theta_0, 0, 0, 0]
        self.law = [(*row, constant) for row, constant in zip(of_state.tolist(), fixed.tolist(), strict=True)]
        self.limits = np.array([limits.V_p, limits.V_y]) if scenario.saturation else np.full(2, np.inf)
        self.travel = limits.theta if scenario.travel_stops and limits.theta else np.inf
        self.y = np.concatenate([start, np.zeros(2)])
        self.ml2 = self.rig.m * self.rig.l**2
        self.motor_of = [0, 0] if self.I is None else [int(np.argmax(np.abs(self.I[:, i]))) for i in range(2)]
        self.mode, self.side, self.stop = [FREE, FREE], [1.0, 1.0], 0
        self.disturbed, self.back = (0.0, 0.0), tracking_gains(loop, scenario)
        self.longest = min(
            0.02, 0.3 / np.max(np.abs(loop.poles))
        )  # no voltage passes a limit twice in a step

    def asked(self, y):
        """u = trim − K (x − x₀) + P (r − y) + I z + F (r − y₀), collected as it depends on the state."""
        a, b, c, d, e, f = y
        return [p * a + q * b + r * c + s * d + t * e + u * f + k for p, q, r, s, t, u, k in self.law]

    def given(self, y):
        u = self.asked(y)
        return [u[i] if self.mode[i] == FREE else self.side[i] * self.limits[i] for i in range(2)]

    def mechanics(self, y):
        return self.driven(y, *self.given(y))

    def driven(self, y, V_p, V_y):
        """Accelerations under these voltages and the disturbance's."""
        r, (theta, _, theta_dot, psi_dot, *_) = self.rig, y
        V_p, V_y = V_p + self.disturbed[0], V_y + self.disturbed[1]
        s, c, ml2 = sin(theta), cos(theta), self.ml2
        pitch = r.K_pp * V_p + r.K_py * V_y - r.B_p * theta_dot - r.K_s * theta - r.m * r.g * r.l * c
        pitch = (pitch - ml2 * s * c * psi_dot**2) / (r.J_p + ml2)
        yaw = r.K_yp * V_p + r.K_yy * V_y - r.B_y * psi_dot + 2 * ml2 * s * c * theta_dot * psi_dot
        return pitch, yaw / (r.J_y + ml2 * c**2)

    def pushing(self, y):
        if self.mode == [FREE, FREE]:
            return [False, False]
        e = self.wanted - y[:2]
        return [
            self.I is not None and self.mode[m] != FREE and self.I[m, i] * e[i] * self.side[m] > 0
            for i, m in enumerate(self.motor_of)
        ]

    def shares(self, y):
        """λ of each motor, from u̇ = 0 on those that slide."""
        pitch, yaw = self.mechanics(y)
        x_dot = np.array([0 if self.stop else y[2], y[3], 0 if self.stop else pitch, yaw])
        e, push = self.wanted - y[:2], self.pushing(y)
        gradient = -self.K.copy()
        gradient[:, :2] -= self.P
        known = gradient @ x_dot
        S = np.zeros((2, 2))
        for i, m in enumerate(self.motor_of):
            if push[i]:
                S[:, m] += self.I[:, i] * e[i]
            else:
                known = known + self.I[:, i] * e[i]
        share = np.array([0.0 if mode == BEYOND else 1.0 for mode in self.mode])
        sliding = [i for i in range(2) if self.mode[i] == SLIDING]
        if sliding:
            fixed = [i for i in range(2) if i not in sliding]
            right = -(known + S[:, fixed] @ share[fixed])[sliding]
            share[sliding] = np.linalg.lstsq(S[np.ix_(sliding, sliding)], right, rcond=None)[0]
        return share

    def rates(self, _t, y):
        y = y.tolist()  # plain floats are several times as fast as NumPy's
        pitch, yaw = self.mechanics(y)
        e = [self.wanted[0] - y[0], self.wanted[1] - y[1]]
        if self.I is None:
            z = [0.0, 0.0]
        elif self.scenario.anti_windup == "clamping" and self.scenario.saturation and any(self.pushing(y)):
            share, push = self.shares(y), self.pushing(y)
            z = [e[i] * share[m] if push[i] else e[i] for i, m in enumerate(self.motor_of)]
        elif self.back is not None:
            cut = np.subtract(self.given(y), self.asked(y))
            z = (e + self.back @ cut).tolist()
        else:
            z = e
        if self.stop:
            return [0.0, y[3], 0.0, yaw, *z]
        return [y[2], y[3], pitch, yaw, *z]

    def events(self):
        found = []
        for i in range(2):
            if self.mode[i] == SLIDING:
                found.append(lambda _t, y, i=i: self.shares(y)[i])
                found.append(lambda _t, y, i=i: 1 - self.shares(y)[i])
            elif self.mode[i] == FREE:
                found.append(lambda _t, y, i=i: 1 - self.asked(y)[i] / self.limits[i])
                found.append(lambda _t, y, i=i: 1 + self.asked(y)[i] / self.limits[i])
            else:
                found.append(lambda _t, y, i=i: self.side[i] * self.asked(y)[i] / self.limits[i] - 1)
        if self.stop:
            found.append(lambda _t, y: self.stop * self.mechanics(np.array([y[0], y[1], 0, *y[3:]]))[0])
        elif np.isfinite(self.travel):
            found.append(lambda _t, y: self.travel - abs(y[0]))
        return [_ends(event) for event in found]

    def decide(self, y, jumped=()):
        """Modes at a point: what lies beyond is beyond; on the limit, what the rates say."""
        clamping = self.scenario.anti_windup == "clamping" and self.I is not None
        u = self.asked(y)
        for i in range(2):
            near = abs(abs(u[i]) / self.limits[i] - 1) < 1e-9 and i not in jumped
            self.side[i] = np.sign(u[i])
            if not near:
                self.mode[i] = BEYOND if abs(u[i]) > self.limits[i] else FREE
                continue
            drift = {}
            for share in (0.0, 1.0):
                self.mode[i] = BEYOND
                rates = np.array(self.rates(0, y))
                if share and clamping:
                    e, push = self.wanted - y[:2], self.pushing(y)
                    for j, m in enumerate(self.motor_of):
                        if m == i and push[j]:
                            rates[4 + j] = e[j]
                gradient = -self.K.copy()
                gradient[:, :2] -= self.P
                total = gradient @ rates[:4] + (0 if self.I is None else self.I @ rates[4:])
                drift[share] = total[i] * self.side[i]
            nothing = 1e-7 * abs(drift[1.0] - drift[0.0])  # where sliding ends one of them is 0
            if drift[0.0] >= -nothing:
                self.mode[i] = BEYOND
            else:
                self.mode[i] = SLIDING if clamping and drift[1.0] > nothing else FREE

    def run(self, t, rtol=1e-12):
        """The states at all t, (len(t), 6)."""
        states = np.empty((len(t), 6))
        for piece in self.pieces(t[-1], rtol):
            here = (t >= piece.sol.ts[0]) & (t <= piece.sol.ts[-1])
            if np.any(here):
                states[here] = piece.sol(t[here]).T
        return states

    def pieces(self, end, rtol=1e-12) -> Iterator[Piece]:
        """The course until `end`, from event to event."""
        y, sets_in = self.y.copy(), self.scenario.disturbance
        if abs(y[0]) >= self.travel:
            self.meet_stop(y)
        if sets_in is None or sets_in.time >= end:
            yield from self.undisturbed(0.0, end, y, rtol)
            return
        if sets_in.time > 0:
            for piece in self.undisturbed(0.0, sets_in.time, y, rtol):
                y = piece.sol(sets_in.time)
                yield piece
        self.disturbed = (sets_in.V_p, sets_in.V_y)
        if self.stop:
            y[0] = self.stop * self.travel
            self.meet_stop(y)
        yield from self.undisturbed(sets_in.time, end, y, rtol)

    def meet_stop(self, y):
        """Pitch is at a stop: its rate is gone, and it rests there while the torque presses."""
        self.stop = int(np.sign(y[0]))
        y[0], y[2] = self.stop * self.travel, 0.0
        self.decide(y, jumped=(0, 1))
        if self.stop * self.mechanics(y)[0] <= 0:
            self.stop = 0
            y[0] *= 1 - 1e-12

    def undisturbed(self, now, end, y, rtol):
        """From a state to the end while nothing acts on the motors from outside, or a constant does."""
        self.decide(y, jumped=(0, 1))
        for _ in range(2000):
            solution = solve_ivp(
                self.rates,
                (now, end),
                y,
                "DOP853",
                dense_output=True,
                events=self.events(),
                rtol=rtol,
                atol=1e-13,
                max_step=self.longest,
            )
            assert solution.status >= 0, solution.message
            yield Piece(solution.sol, tuple(self.mode), tuple(self.side))
            if solution.status != 1:
                return
            fired = next(i for i, times in enumerate(solution.t_events) if len(times))
            now, y = float(solution.t_events[fired][0]), solution.y_events[fired][0].copy()
            if now >= end:
                return
            at_stop = fired == len(solution.t_events) - 1 and (self.stop or np.isfinite(self.travel))
            if at_stop and self.stop:
                self.stop = 0
                y[0] *= 1 - 1e-12
            elif at_stop:
                self.meet_stop(y)
            else:
                self.decide(y)
        raise AssertionError("too many events")


def _ends(function):
    """An event where a function turns negative; it may begin at 0, which is then no zero to be found."""

    def event(t, y):
        return function(t, y) + 1e-13

    event.terminal, event.direction = True, -1
    return event


def tracking_gains(loop, scenario):
    """∂ż/∂(given − asked) of back-calculation, 2×2: with T_i as time constant unless the scenario names one."""
    chosen = scenario.anti_windup == "back-calculation" and scenario.saturation and loop.integral is not None
    if not chosen or not np.all(np.any(loop.integral, axis=0)):
        return None
    own = (loop.outer.pitch.ti, loop.outer.yaw.ti)
    times = [t if scenario.tracking_time is None else scenario.tracking_time for t in own]
    return np.linalg.inv(loop.integral) / np.array(times)[:, None]
