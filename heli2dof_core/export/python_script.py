"""The design as a script for python-control: rig, K, loops, step response, in plain matrices."""

from __future__ import annotations

from ..evaluate import loop_of
from ..parameters import PARAMETER_INFO
from ..signals import Floats
from ..spec import Spec
from .format import Format
from .origin import origin


def render(spec: Spec, link: str = "") -> str:
    """A script that needs NumPy and python-control, and Matplotlib only where it is run by itself."""
    loop = loop_of(spec)
    design, scenario = loop.design, spec.scenario
    theta, psi, *start = scenario.resolved(spec.theta_0)
    order = len(loop.A)
    initial = [start[0] - spec.theta_0, *start[1:], *[0.0] * (order - 4)]
    wanted = design.poles.values if design.aims else design.closed_loop_poles.tolist()
    poles = ", ".join(repr(p) if p.imag else repr(p.real) for p in wanted)
    what = "asked for" if design.aims else "chosen by the method"
    numbers = [
        f"{name} = {value!r}  # {PARAMETER_INFO[name].meaning}, {PARAMETER_INFO[name].unit}"
        for name, value in spec.parameters.as_dict().items()
    ]
    return "\n".join(
        [
            *(f"# {line}" for line in origin(spec, FORMAT.name, link)),
            "import control as ct",
            "import numpy as np",
            "",
            *numbers,
            f"theta_0 = {spec.theta_0!r}  # operating point, rad",
            _PLANT,
            f"poles = np.array([{poles}])  # {what}, rad/s",
            _matrix("K", design.K, "u = -K x + v, V/rad and V s/rad"),
            _matrix("P", loop.proportional, "volts of each motor per error of pitch and yaw, V/rad"),
            *([] if loop.integral is None else [_matrix("I", loop.integral, "per integral, V/(rad s)")]),
            _matrix("F", loop.feedforward, "volts per reference, V/rad"),
            _INTEGRATING if loop.integral is not None else _STATIC,
            f"t = np.linspace(0.0, {scenario.duration!r}, {scenario.samples})  # s",
            f"reference = np.array([{theta!r} - theta_0, {psi!r}])  # deviations, rad",
            f"x_0 = np.array({initial!r})",
            _RESPONSE,
        ]
    )


def _matrix(name: str, rows: Floats, comment: str) -> str:
    inner = "\n".join(f"    [{', '.join(map(repr, row))}]," for row in rows.tolist())
    return f"{name} = np.array([  # {comment}\n{inner}\n])"


_PLANT = """
# The rig linearized at rest (theta_0, 0): x = [theta, psi, theta_dot, psi_dot], u = [V_p, V_y], deviations
alpha = J_p + m * l**2
beta_0 = J_y + m * l**2 * np.cos(theta_0) ** 2
thrust = np.array([[K_pp, K_py], [K_yp, K_yy]])
inertia = np.diag([alpha, beta_0])
A = np.zeros((4, 4))
A[:2, 2:] = np.eye(2)
A[2, 0] = (m * g * l * np.sin(theta_0) - K_s) / alpha
A[2, 2], A[3, 3] = -B_p / alpha, -B_y / beta_0
B = np.vstack([np.zeros((2, 2)), np.linalg.solve(inertia, thrust)])
C = np.eye(2, 4)
trim = np.linalg.solve(thrust, [m * g * l * np.cos(theta_0) + K_s * theta_0, 0.0])  # V
plant = ct.ss(A, B, C, np.zeros((2, 2)))

# State feedback"""

_OUTPUTS = """loop = ct.ss(
    A_loop,
    B_loop,
    np.vstack([np.eye(2, len(A_loop)), law]),
    np.vstack([np.zeros((2, 2)), law_of_reference]),
    inputs=["theta_ref", "psi_ref"],
    outputs=["theta", "psi", "V_p", "V_y"],
)
loop_poles = loop.poles()

# Linear step response: no limits; angles in deviations from theta_0, voltages from the trim"""

_INTEGRATING = f"""
# The whole loop: u = -K x + P e + I z + F r with e = r - C x and z' = e
law = np.hstack([-K - P @ C, I])
law_of_reference = P + F
A_loop = np.block([[A, np.zeros((4, 2))], [-C, np.zeros((2, 2))]]) + np.vstack([B, np.zeros((2, 2))]) @ law
B_loop = np.vstack([B @ law_of_reference, np.eye(2)])
{_OUTPUTS}"""

_STATIC = f"""
# The whole loop: u = -K x + P e + F r with e = r - C x
law = -K - P @ C
law_of_reference = P + F
A_loop = A + B @ law
B_loop = B @ law_of_reference
{_OUTPUTS}"""

_RESPONSE = """response = ct.forced_response(loop, t, np.tile(reference[:, None], len(t)), x_0)
theta, psi, V_p, V_y = response.outputs
theta = theta + theta_0
# Figures of merit, one entry at a time (entries that end at 0 have no shares of it):
# ct.step_info(loop["theta", "theta_ref"], T=t)


def distance(found, wanted):
    \"\"\"Largest distance between two sets of poles, each matched with its nearest one, rad/s.\"\"\"
    left = list(found)
    return max(abs(left.pop(int(np.argmin(np.abs(np.array(left) - p)))) - p) for p in wanted)


if __name__ == "__main__":
    print("K =", K, sep="\\n")
    placed = np.linalg.eigvals(A - B @ K)
    print("poles of A - BK:", placed, "rad/s, off by", distance(placed, poles))
    print("poles of the whole loop:", loop_poles, "rad/s")
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise SystemExit from None
    _, (angles, voltages) = plt.subplots(2, sharex=True)
    angles.plot(t, np.degrees(theta), label="theta")
    angles.plot(t, np.degrees(psi), label="psi")
    angles.set_ylabel("angle, deg")
    voltages.plot(t, V_p, label="V_p")
    voltages.plot(t, V_y, label="V_y")
    voltages.set_ylabel("voltage from trim, V")
    voltages.set_xlabel("t, s")
    for axes in (angles, voltages):
        axes.legend()
        axes.grid()
    plt.show()
"""

FORMAT = Format("python", "Script for python-control", ".py", "text/x-python; charset=utf-8", render)
