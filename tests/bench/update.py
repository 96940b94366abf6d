"""One update of the page, and its kernels, as ratios to python-control, SciPy and C in the same run.

    python -m tests.bench.update [docs/performance.md]

The job: K, the loop's poles, RGA, the linear responses of the 2×2 PI loop over 501 points with voltages,
step metrics, classical margins, disk margin, and the nonlinear response of 5 s at 1e-6 with limits.
"""

from __future__ import annotations

import platform
import sys
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import control
import numpy as np
from scipy.integrate import solve_ivp

from heli2dof_core import Scenario, Spec, Uncertainty, close_loop, cloud, evaluate, place, preset
from heli2dof_core.engine import engine, warm_up
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import ABSOLUTE_TOLERANCE, NonlinearLoop, simulate_nonlinear
from heli2dof_core.spec import Digital
from tests.bench.placement import measured
from tests.reference import Reference


def spec_of(duration: float = 5.0, samples: int = 501, rtol: float = 1e-6) -> Spec:
    spec = Spec.from_preset(preset())
    scenario = Scenario(theta=0.5, psi=1.0, duration=duration, samples=samples, rtol=rtol)
    return replace(spec, scenario=scenario)


def python_control(spec: Spec) -> object:
    """The same job as python-control's documentation shows it; its nonlinear part by solve_ivp."""
    loop = close_loop(place(spec), spec.outer)
    model, s = loop.design, control.tf("s")
    K = control.place(model.plant.A, model.plant.B, spec.poles.array)
    inner = control.ss(model.plant.A - model.plant.B @ K, model.plant.B, np.eye(2, 4), 0)
    pi = control.append(
        *(control.tf2ss(g.kp * (1 + 1 / (g.ti * s))) for g in (spec.outer.pitch, spec.outer.yaw))
    )
    whole = control.feedback(control.series(pi, inner), np.eye(2))
    T = np.linspace(0, 5, 501)
    responses = control.step_response(whole, T)
    info = control.step_info(whole, T=T)
    G_0 = control.dcgain(inner)
    rga = G_0 * np.linalg.inv(G_0).T
    n = len(loop.A)
    B = np.zeros((n, 2))
    B[:4] = model.plant.B
    C_u = -loop.voltage_from_state
    L = control.ss(loop.A + B @ C_u, B, C_u, np.zeros((2, 2)))
    margins = [control.stability_margins(L[i, i]) for i in range(2)]
    disk = control.disk_margins(L, np.geomspace(0.01, 1000, 500))
    nonlinear = by_solve_ivp(spec)
    return K, whole.poles(), responses, info, rga, margins, disk, nonlinear


def by_solve_ivp(spec: Spec) -> object:
    """The nonlinear response by SciPy's RK45 at the same tolerance, its limits as they come."""
    loop = close_loop(place(spec), spec.outer)
    reference = Reference(loop, spec.limits, replace(spec.scenario, anti_windup="none"))
    reference.decide(reference.y, jumped=(0, 1))

    def rates(t: float, y: np.ndarray) -> object:
        u = reference.asked(y)
        for i in range(2):
            reference.mode[i] = "beyond" if abs(u[i]) > reference.limits[i] else "free"
            reference.side[i] = np.sign(u[i])
        return reference.rates(t, y)

    return solve_ivp(rates, (0, 5), reference.y, "RK45", t_eval=np.linspace(0, 5, 501), rtol=1e-6, atol=1e-7)


def jobs() -> dict[str, dict[str, Callable[[], object]]]:
    spec = spec_of()
    loop = close_loop(place(spec), spec.outer)
    system = NonlinearLoop.of(loop, spec.limits, spec.scenario)
    t, states = np.linspace(0, 5, 501), np.empty((501, 6))

    def kernel(rtol: float = 1e-6) -> object:
        numbers = (rtol, ABSOLUTE_TOLERANCE * rtol, 400_000)
        return engine().integrate(
            system.start.copy(), t, system.constants, system.modes.copy(), *numbers, states
        )

    def scaled(**change: float) -> Callable[[], object]:
        scenario = replace(spec.scenario, **change)
        return lambda: simulate_nonlinear(loop, spec.limits, scenario)

    return {
        "One update": {
            "python-control, as documented": lambda: python_control(spec),
            "heli2dof, evaluate": lambda: evaluate(spec),
        },
        "Nonlinear response, 5 s, 501 points, rtol 1e-6": {
            "SciPy solve_ivp (RK45)": lambda: by_solve_ivp(spec),
            "heli2dof, simulate_nonlinear": lambda: simulate_nonlinear(loop, spec.limits, spec.scenario),
            "heli2dof, its kernel alone": kernel,
            "digital rig, 2 ms": lambda: simulate_digital(loop, spec.limits, spec.scenario, Digital()),
        },
        "Linear response, 501 points": {
            "python-control, step_response": lambda: control.forced_response(
                control.ss(loop.A, loop.B, np.eye(6), 0), t, np.ones((2, 501)) * [[0.5], [1.0]]
            ),
            "heli2dof, simulate_linear": lambda: simulate_linear(loop, spec.scenario),
        },
        "Scaling of the nonlinear response": {
            "5 s, 501 points, 1e-6": scaled(),
            "5 s, 5001 points": scaled(samples=5001),
            "20 s": scaled(duration=20.0),
            "rtol 1e-9": scaled(rtol=1e-9),
            "rtol 1e-12": scaled(rtol=1e-12),
        },
        "Robustness cloud": {
            f"{n} rigs": (lambda n=n: cloud(spec, Uncertainty(samples=n))) for n in (200, 2000, 10_000)
        },
    }


def main() -> None:
    warm_up()
    warnings.simplefilter("ignore")
    machine = f"Python {platform.python_version()}, {platform.machine()}"
    lines = [f"{machine}, medians of one run; the first row of a table is 1."]
    for title, calls in jobs().items():
        times = measured(calls)
        peer = next(iter(times.values()))
        lines += ["", f"## {title}", "", "| | time | ratio |", "|---|---|---|"]
        lines += [
            f"| {name} | {1e3 * seconds:.3g} ms | {peer / seconds:.3g} |" for name, seconds in times.items()
        ]
    text = "\n".join(lines)
    print(text)
    if len(sys.argv) > 1:
        header = "# Performance\n\n`make bench` makes this anew. Ratios hold better than times: machines drift.\n\n"
        Path(sys.argv[1]).write_text(header + text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
