"""One update of the page as others would compute it: python-control, as documented and at its best, and SciPy.

The job: K, the loop's poles, RGA, the linear responses of the 2×2 PI loop over 501 points with voltages,
step metrics, classical margins, disk margin, and the nonlinear response of 5 s at 1e-6 with limits.
"""

from __future__ import annotations

import control
import numpy as np
from scipy.integrate import odeint, solve_ivp
from scipy.linalg import expm
from scipy.signal import place_poles

from heli2dof_core import Spec, plant
from heli2dof_core.compiled import accelerations
from heli2dof_core.simulation.nonlinear import ABSOLUTE_TOLERANCE

SAMPLES = 501
FREQUENCIES = np.geomspace(0.01, 1000, 200)
_STATES = ["theta", "psi", "theta_dot", "psi_dot"]


class Job:
    """A spec as plain numbers, for those who do not know our types."""

    def __init__(self, spec: Spec) -> None:
        model = plant(spec.parameters, spec.theta_0)
        self.A, self.B, self.trim = model.A, model.B, model.trim
        self.poles = spec.poles.array
        self.pi = [(loop.kp, loop.ti) for loop in (spec.outer.pitch, spec.outer.yaw)]
        self.reference = np.array(spec.scenario.resolved(spec.theta_0)[:2])
        self.limits = np.array([spec.limits.V_p, spec.limits.V_y])
        self.rtol = spec.scenario.rtol
        self.T = np.linspace(0.0, spec.scenario.duration, SAMPLES)
        self.parameters = tuple(spec.parameters.as_dict().values())

    def rates(self, x: np.ndarray, u: np.ndarray) -> list[float]:
        """ẋ of the nonlinear rig under voltages within their limits (Eqs. 9–12)."""
        V_p, V_y = np.clip(u, -self.limits, self.limits)
        return [x[2], x[3], *accelerations()(x[0], x[2], x[3], V_p, V_y, *self.parameters)]

    def loop_rates(self, y: np.ndarray, K: np.ndarray) -> list[float]:
        """ẏ of rig, state feedback and PI loops together, y = [x, z]."""
        e = self.reference - y[:2]
        (kp, ti), (kq, tj) = self.pi
        u = self.trim - K @ y[:4] + [kp * (e[0] + y[4] / ti), kq * (e[1] + y[5] / tj)]
        return [*self.rates(y[:4], u), e[0], e[1]]

    def whole(self, K: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """The linear loop from references to [θ, ψ, V_p, V_y], by hand."""
        P, P_i = np.diag([kp for kp, _ in self.pi]), np.diag([kp / ti for kp, ti in self.pi])
        F = np.hstack([-K - P @ np.eye(2, 4), P_i])
        A = np.zeros((6, 6))
        A[:4] = self.B @ F
        A[:4, :4] += self.A
        A[4:, :2] = -np.eye(2)
        B = np.vstack([self.B @ P, np.eye(2)])
        return A, B, np.vstack([np.eye(2, 6), F]), np.vstack([np.zeros((2, 2)), P])


def linear_as_documented(job: Job) -> tuple:
    """python-control, each step as its user guide shows it: all but the nonlinear response."""
    rig = control.ss(
        job.A, job.B, np.eye(4), 0, inputs=["V_p", "V_y"], outputs=_STATES, states=_STATES, name="rig"
    )
    K = control.place(job.A, job.B, job.poles)
    feedback = control.ss([], [], [], -K, inputs=_STATES, outputs=["K_p", "K_y"], name="K")
    s = control.tf("s")
    loops = [
        control.ss(kp * (1 + 1 / (ti * s)), inputs=[f"e_{a}"], outputs=[f"w_{a}"], name=f"PI_{a}")
        for a, (kp, ti) in zip("py", job.pi, strict=True)
    ]
    errors = [
        control.summing_junction([f"r_{a}", f"-{angle}"], f"e_{a}")
        for a, angle in zip("py", _STATES[:2], strict=True)
    ]
    motors = [control.summing_junction([f"w_{a}", f"K_{a}"], f"V_{a}") for a in "py"]
    whole = control.interconnect(
        [rig, feedback, *loops, *errors, *motors],
        inputs=["r_p", "r_y"],
        outputs=["theta", "psi", "V_p", "V_y"],
    )
    responses = control.step_response(whole, job.T)
    info = control.step_info(whole[:2, :], T=job.T)
    inner = control.feedback(rig, control.ss([], [], [], K))
    G_0 = control.dcgain(inner)[:2]
    rga = G_0 * np.linalg.inv(G_0).T
    opened = control.interconnect(
        [
            rig,
            feedback,
            *loops,
            *(control.summing_junction([f"-{v}"], f"e_{a}") for a, v in zip("py", _STATES[:2], strict=True)),
            *(control.summing_junction([f"-w_{a}", f"-K_{a}"], f"u_{a}") for a in "py"),
        ],
        inputs=["V_p", "V_y"],
        outputs=["u_p", "u_y"],
    )
    margins = [control.stability_margins(motor_loop(opened, i)) for i in range(2)]
    disk = control.disk_margins(opened, FREQUENCIES)
    return K, whole.poles(), responses, info, rga, margins, disk


def as_documented(job: Job) -> object:
    """python-control, each step as its user guide shows it."""
    K, *others = linear_as_documented(job)
    plant_nl = control.nlsys(
        lambda t, x, u, params: job.rates(x, u), inputs=["V_p", "V_y"], outputs=_STATES, states=4, name="rig"
    )
    law = control.nlsys(
        lambda t, z, u, params: u[:2] - u[2:4],
        lambda t, z, u, params: (
            job.trim - K @ u[2:6] + [kp * (u[i] - u[2 + i] + z[i] / ti) for i, (kp, ti) in enumerate(job.pi)]
        ),
        inputs=["r_p", "r_y", *_STATES],
        outputs=["V_p", "V_y"],
        states=2,
        name="law",
    )
    real = control.interconnect([plant_nl, law], inputs=["r_p", "r_y"], outputs=[*_STATES[:2], "V_p", "V_y"])
    nonlinear = control.input_output_response(
        real,
        job.T,
        np.outer(job.reference, np.ones(SAMPLES)),
        solve_ivp_kwargs={"rtol": job.rtol, "atol": ABSOLUTE_TOLERANCE * job.rtol},
    )
    return K, *others, nonlinear


def motor_loop(opened: control.StateSpace, motor: int) -> control.StateSpace:
    """The loop seen at one motor while the other stays closed."""
    other = 1 - motor
    A = opened.A - np.outer(opened.B[:, other], opened.C[other])
    return control.ss(A, opened.B[:, [motor]], opened.C[[motor]], 0)


def linear_at_its_best(job: Job) -> tuple:
    """python-control with all that slows it left out: matrices by hand, one system, one response for all."""
    K = control.place(job.A, job.B, job.poles)
    A, B, C, D = job.whole(K)
    whole = control.ss(A, B, C, D)
    responses = control.forced_response(whole, job.T, np.outer(job.reference, np.ones(SAMPLES)))
    info = [control.step_info(angle, T=job.T) for angle in responses.outputs[:2]]
    inner = control.ss(job.A - job.B @ K, job.B, np.eye(2, 4), 0)
    G_0 = control.dcgain(inner)
    rga = G_0 * np.linalg.inv(G_0).T
    B_u = np.vstack([job.B, np.zeros((2, 2))])
    opened = control.ss(A - B_u @ C[2:], B_u, -C[2:], 0)
    margins = [control.stability_margins(motor_loop(opened, i)) for i in range(2)]
    disk = control.disk_margins(opened, FREQUENCIES)
    return K, np.linalg.eigvals(A), responses, info, rga, margins, disk


def at_its_best(job: Job) -> object:
    """The same with the nonlinear response."""
    K, *others = linear_at_its_best(job)
    real = control.nlsys(lambda t, y, u, params: job.loop_rates(y, K), None, inputs=2, states=6)
    nonlinear = control.input_output_response(
        real,
        job.T,
        0,
        solve_ivp_method="LSODA",
        solve_ivp_kwargs={"rtol": job.rtol, "atol": ABSOLUTE_TOLERANCE * job.rtol},
    )
    return K, *others, nonlinear


def by_scipy(job: Job) -> object:
    """NumPy and SciPy, written for speed by one who knows them."""
    K = place_poles(job.A, job.B, job.poles).gain_matrix
    A, B, C, D = job.whole(K)
    G_0 = np.linalg.inv(job.A - job.B @ K)[:2] @ -job.B
    rga = G_0 * np.linalg.inv(G_0).T
    augmented = np.zeros((7, 7))
    augmented[:6, :6], augmented[:6, 6] = A, B @ job.reference
    step = expm(augmented * job.T[1])
    states = np.zeros((7, SAMPLES))
    states[6, 0] = 1.0
    done, power = 1, step
    while done < SAMPLES:
        more = min(done, SAMPLES - done)
        states[:, done : done + more] = power @ states[:, :more]
        done, power = done + more, power @ power
    outputs = C @ states[:6] + (D @ job.reference)[:, None]
    shares = outputs[:2] / job.reference[:, None]
    rise = [np.argmax(s >= 0.9) - np.argmax(s >= 0.1) for s in shares]
    settled = [SAMPLES - np.argmax(np.abs(s - 1)[::-1] > 0.02) for s in shares]
    info = rise, settled, shares.max(1), np.trapezoid(np.abs(shares - 1), job.T)
    B_u = np.vstack([job.B, np.zeros((2, 2))])
    values, vectors = np.linalg.eig(A)
    residues = (C[2:] @ vectors)[:, None, :] * np.linalg.solve(vectors, B_u.astype(complex)).T
    S = np.eye(2) + np.einsum("ijk,wk->wij", residues, 1 / (1j * FREQUENCIES[:, None] - values))
    loops = 1 / np.stack([S[:, 0, 0], S[:, 1, 1]]) - 1
    crossings = [np.flatnonzero(np.diff(np.sign(np.abs(L) - 1))) for L in loops]
    margins = [np.angle(-L[at]) for L, at in zip(loops, crossings, strict=True)]
    M = S - np.eye(2) / 2
    scaled = np.sqrt(np.abs(M[:, 0, 1] * M[:, 1, 0]))
    M[:, 0, 1] = M[:, 1, 0] = scaled
    disk = 1 / np.linalg.norm(M, 2, axis=(1, 2)).max()
    tolerances = {"rtol": job.rtol, "atol": ABSOLUTE_TOLERANCE * job.rtol}
    nonlinear = odeint(lambda y, t: job.loop_rates(y, K), np.zeros(6), job.T, **tolerances)
    return K, values, outputs, info, rga, margins, disk, nonlinear


def by_solve_ivp(job: Job, K: np.ndarray) -> object:
    """The nonlinear response alone, by the method that ours uses."""
    tolerances = {"rtol": job.rtol, "atol": ABSOLUTE_TOLERANCE * job.rtol}
    span = (0.0, float(job.T[-1]))
    return solve_ivp(lambda t, y: job.loop_rates(y, K), span, np.zeros(6), "RK45", job.T, **tolerances)
