"""The design as a script for python-control: rig, K, loops, step response, in plain matrices."""

from __future__ import annotations

from ..evaluate import loop_of
from ..loop import Loop
from ..parameters import PARAMETER_INFO
from ..spec import Spec
from .dialect import PYTHON
from .format import Format
from .origin import origin
from .script_loop import estimator_lines, gain_comment, loop_lines, machine_lines, model_names, start_of


def render(spec: Spec, link: str = "") -> str:
    """A script that needs NumPy and python-control, and Matplotlib only where it is run by itself."""
    loop = loop_of(spec)
    design, scenario, matrix = loop.design, spec.scenario, PYTHON.matrix
    theta, psi, *_ = scenario.resolved(spec.theta_0)
    wanted = design.wanted.tolist() if design.aims else design.closed_loop_poles.tolist()
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
            *machine_lines(loop, PYTHON),
            *_rig(loop),
            *estimator_lines(loop, PYTHON),
            *_observer_poles(loop),
            "\n# State feedback",
            f"poles = np.array([{_numbers(wanted)}])  # {what}, rad/s",
            matrix("K", design.K, gain_comment(loop)),
            matrix("P", loop.proportional, "volts of each motor per error of pitch and yaw, V/rad"),
            *([] if loop.integral is None else [matrix("I", loop.integral, "per integral, V/(rad s)")]),
            matrix("F", loop.feedforward, "volts per reference, V/rad"),
            "",
            *loop_lines(loop, PYTHON),
            _OUTPUTS,
            f"t = np.linspace(0.0, {scenario.duration!r}, {scenario.samples})  # s",
            f"reference = np.array([{theta!r} - theta_0, {psi!r}])  # deviations, rad",
            f"x_0 = np.array({start_of(loop, scenario)!r})",
            _response(loop),
        ]
    )


def _numbers(poles: list[complex]) -> str:
    return ", ".join(repr(p) if p.imag else repr(p.real) for p in poles)


def _rig(loop: Loop) -> list[str]:
    """The rig as it is as a system of python-control, where it is not `plant`."""
    if loop.actuators is None:
        return []
    A, B = ("A_plus", "B_plus") if loop.actuators.lags else ("A", "B_thrust")
    if B == "B_thrust" and not loop.actuators.square.any():
        return []
    return [f"rig = ct.ss({A}, {B}, np.eye(2, len({A})), np.zeros((2, 2)))"]


def _observer_poles(loop: Loop) -> list[str]:
    if loop.estimator is None or loop.estimator.wanted is None:
        return []
    return [f"observer_poles = np.array([{_numbers(loop.estimator.wanted.tolist())}])  # asked for, rad/s"]


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
plant = ct.ss(A, B, C, np.zeros((2, 2)))"""

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


def _response(loop: Loop) -> str:
    """The linear step response, and the checks of a script that is run by itself."""
    A, B = model_names(loop)
    observed = ""
    if loop.estimator is not None and loop.estimator.L is not None:
        off = (
            ', "rad/s, off by", distance(observed, observer_poles))'
            if loop.estimator.wanted is not None
            else ', "rad/s")'
        )
        observed = _OBSERVED.format(off=off)
    return _RESPONSE.replace("<A - B @ K>", f"{A} - {B} @ K").replace("<observed>", observed)


_OBSERVED = """    observed = np.linalg.eigvals(A - L @ C)
    print("poles of A - LC:", observed{off}
"""

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
    placed = np.linalg.eigvals(<A - B @ K>)
    print("poles of A - BK:", placed, "rad/s, off by", distance(placed, poles))
<observed>    print("poles of the whole loop:", loop_poles, "rad/s")
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
