"""Random attempts at a lab, and their figures by others: NumPy, python-control, SciPy.

The linear loop is built here from the student's parameters, by the equations of the theory sheet; of heli2dof's it
has K alone, which is held to the poles asked for. The rig's course is `tests.reference`'s.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import control
import numpy as np

from heli2dof_core import Spec, loop_of, place, spec_of
from heli2dof_core.labs import Lab, student_rig
from tests.core.random_rigs import turn
from tests.figures import LinearCourse, figures, largest
from tests.rig_figures import Axis, Course, settling_gap

AXES, MOTORS = ("theta", "psi"), ("V_p", "V_y")
RTOL = 1e-9


@dataclass(frozen=True)
class Attempt:
    """A student's seed and what they hand in."""

    seed: int
    design: dict


def random_attempts(count: int, seed: int):
    """Designs of all kinds on the helicopter: a third of them unstable, some that saturate."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        scale = 10 ** rng.uniform(-0.3, 0.3)
        poles = [_pole(p * scale) for p in (*_pair(rng), *_pair(rng))]
        hasty = i % 3 == 0  # integrates too fast to be stable
        pi = hasty or bool(rng.random() < 0.7)
        kp, ti = rng.uniform(2, 40, 2), rng.uniform(0.1, 1.5, 2) / (40 if hasty else 1)
        loops = {axis: {"kp": kp[n], "ti": ti[n]} for n, axis in enumerate(("pitch", "yaw"))}
        yield Attempt(
            int(rng.integers(2**40)),
            {
                "preset": "quanser-2dof-manual",
                "poles": poles,
                "outer": "pi" if pi else "none",
                "loops": loops,
                "coupling": str(rng.choice(["triangular", "axis-decoupled", "input-diagonal"])),
            },
        )


def _pair(rng):
    re = -rng.uniform(1.5, 9)
    if rng.random() < 0.5:
        im = rng.uniform(0.5, 9)
        return complex(re, im), complex(re, -im)
    return complex(re), complex(-rng.uniform(1.5, 9))


def _pole(p):
    return {"re": p.real, "im": p.imag} if p.imag else p.real


class Others:
    """An attempt's figures, none of them by heli2dof.

    Attributes:
        stable: by the eigenvalues of the whole loop.
        poles: these, rad/s.
    """

    def __init__(self, lab: Lab, attempt: Attempt, scenario: dict) -> None:
        rig = student_rig(lab, attempt.seed)
        self.spec: Spec = spec_of({**attempt.design, **rig, "scenario": scenario})
        p = self.spec.parameters
        alpha, beta = p.J_p + p.m * p.l**2, p.J_y + p.m * p.l**2
        self.A = np.zeros((4, 4))
        self.A[0, 2] = self.A[1, 3] = 1.0
        self.A[2, 2], self.A[3, 3], self.A[2, 0] = -p.B_p / alpha, -p.B_y / beta, -p.K_s / alpha
        self.B = np.zeros((4, 2))
        self.B[2:] = [[p.K_pp / alpha, p.K_py / alpha], [p.K_yp / beta, p.K_yy / beta]]
        self.trim = np.linalg.solve(
            [[p.K_pp, p.K_py], [p.K_yp, p.K_yy]], [p.m * p.g * p.l, 0.0]
        )  # level: gravity is balanced
        self.K = place(self.spec).K
        self._close()

    def _close(self):
        outer, C = self.spec.outer, np.eye(2, 4)
        inner = self.A - self.B @ self.K
        if outer.outer == "none":
            static = np.linalg.inv(-C @ np.linalg.solve(inner, self.B))
            self.loop, self.by_reference = inner, self.B @ static
            self.u_of_state, self.u_of_reference = -self.K, static
        else:
            kp = np.diag([outer.pitch.kp, outer.yaw.kp])
            ki = np.diag([outer.pitch.kp / outer.pitch.ti, outer.yaw.kp / outer.yaw.ti])
            self.u_of_state = np.hstack([-self.K - kp @ C, ki])
            self.u_of_reference = kp
            self.loop = np.zeros((6, 6))
            self.loop[:4] = self.B @ self.u_of_state
            self.loop[:4, :4] += self.A
            self.loop[4:, :4] = -C
            self.by_reference = np.vstack([self.B @ kp, np.eye(2)])
        self.poles = np.linalg.eigvals(self.loop)
        self.stable = bool(np.max(self.poles.real) < 0)

    def linear(self, axis: int) -> dict:
        """Figures of one axis' step by the linear model, and both motors' peaks, trim included."""
        scenario = self.spec.scenario
        size = (scenario.theta, scenario.psi)[axis]
        reference = np.array([size, 0.0] if axis == 0 else [0.0, size])
        course = LinearCourse(self.loop, self.by_reference, reference, np.zeros(len(self.loop)))
        t = np.linspace(0, scenario.duration, 6001)
        x = course(t)
        found = figures(t, x[axis], 0.0, size)
        leaves = course.leaves(scenario.duration, axis, 0.0, size)
        found["settling_time"] = None if leaves else found["entered"]
        found["coupling_peak"] = largest(t, x[1 - axis])
        u = self.u_of_state @ x + (self.u_of_reference @ reference)[:, None]
        for i, motor in enumerate(MOTORS):
            found[motor] = largest(t, u[i] + self.trim[i])
        return found

    def rig(self, axis: int) -> dict:
        """Figures of one axis' step by the nonlinear rig."""
        alone = {AXES[1 - axis]: None, "samples": 2}
        scenario, loop = replace(self.spec.scenario, **alone), loop_of(self.spec)
        course = Course(loop, self.spec.limits, scenario, scenario.duration + turn(loop, scenario), rtol=RTOL)
        own = Axis(course, axis, 0.0, getattr(scenario, AXES[axis]))
        found = own.figures()
        entered = found["entered"]
        stays = entered is not None and settling_gap(own, entered, turn(loop, scenario)) < 1e-6
        found["settling_time"] = entered if stays else None
        found["coupling_peak"] = course.deviation(1 - axis, 0.0)
        for i, motor in enumerate(MOTORS):
            told = course.motor(i)
            found[motor], found[f"{motor} saturated"] = told["motor_peak"], told["saturated"]
            found[f"{motor} effort"] = told["effort"]
        return found

    def margins(self, motor: int) -> dict:
        """Gain and phase margin by python-control, the other motor's loop closed."""
        n = len(self.loop)
        B = np.zeros((n, 2))
        B[:4] = self.B
        A = self.loop - np.outer(B[:, motor], self.u_of_state[motor])
        system = control.ss(A, B[:, [motor]], -self.u_of_state[[motor]], 0)
        gains, phases, _, _, crossovers, _ = control.stability_margins(system, returnall=True)
        above = gains[gains > 1]
        lags = np.radians(phases % 360)
        size = np.minimum(lags, 2 * np.pi - lags)
        return {
            "gain_margin": float(above.min()) if len(above) else None,
            "phase_margin": float(size.min()) if len(size) else None,
            "delay_margin": float(np.min(lags / crossovers)) if len(lags) else None,
        }
