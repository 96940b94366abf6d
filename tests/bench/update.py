"""One update of the page, and its kernels, as ratios to python-control, SciPy and C in the same run.

    python -m tests.bench.update [docs/performance.md]

What one update holds is said in `peers`. Of the file the sections by other scripts stay, from `BY_OTHERS` on.
"""

from __future__ import annotations

import os
import platform
import sys
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import control
import numpy as np
from threadpoolctl import ThreadpoolController, threadpool_limits

from heli2dof_core import Scenario, Spec, Uncertainty, close_loop, cloud, evaluate, place, preset
from heli2dof_core.engine import engine, warm_up
from heli2dof_core.kernels.layout import PAPER, WORKSPACE
from heli2dof_core.rotors import Rotor, Rotors
from heli2dof_core.scenario import Digital
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import ABSOLUTE_TOLERANCE, NonlinearLoop, simulate_nonlinear
from tests.bench import floor, peers, round_trip
from tests.bench.placement import measured

HEADER = """# Performance

`make bench` makes this anew. Ratios hold better than times: machines drift. One update is K, the poles of the whole
loop, the RGA, the linear responses of the 2×2 PI loop over 501 points with voltages, step metrics, classical margins,
disk margin, and the nonlinear response of 5 s at a tolerance of 1e-6 with limits. `evaluate` computes all that; the
report's words are made where they are read, which the second of its rows includes. BLAS runs on one thread, as the
server sets it and as python-control is quickest; on all cores, as it is installed, only where a row says so.
"""


def spec_of(duration: float = 5.0, samples: int = 501, rtol: float = 1e-6) -> Spec:
    spec = Spec.from_preset(preset())
    scenario = Scenario(theta=0.5, psi=1.0, duration=duration, samples=samples, rtol=rtol)
    return replace(spec, scenario=scenario)


def jobs() -> dict[str, dict[str, Callable[[], object]]]:
    spec = spec_of()
    slow = spec.changed(rotors=Rotors(Rotor(0.16), Rotor(0.16)), place_rotors=True)
    seen = slow.changed(measured="observer")
    job, loop = peers.Job(spec), close_loop(place(spec), spec.outer)
    system = NonlinearLoop.of(loop, spec.limits, spec.scenario)
    t, states, w = np.linspace(0, 5, 501), np.empty((501, 6)), np.empty(WORKSPACE)
    tolerances = 1e-6, ABSOLUTE_TOLERANCE * 1e-6

    def kernel() -> object:
        y, modes = system.start.copy(), system.modes.copy()
        return engine().integrate(PAPER, y, t, system.constants, modes, *tolerances, 400_000, w, states)

    def scaled(**change: float) -> Callable[[], object]:
        scenario = replace(spec.scenario, **change)
        return lambda: simulate_nonlinear(loop, spec.limits, scenario)

    return {
        "One update": {
            "python-control, as documented, BLAS as installed": on_all_cores(
                lambda: peers.as_documented(job)
            ),
            "python-control, as documented": lambda: peers.as_documented(job),
            "python-control, at its best": lambda: peers.at_its_best(job),
            "NumPy and SciPy": lambda: peers.by_scipy(job),
            "heli2dof, evaluate": lambda: evaluate(spec),
            "heli2dof, evaluate and every remark": lambda: evaluate(spec).findings,
            "heli2dof, evaluate with each axis alone (the page)": lambda: evaluate(spec, each_axis=True),
            "the same, rotors that lag": lambda: evaluate(slow, each_axis=True),
            "the same, rotors and an observer": lambda: evaluate(seen, each_axis=True),
        },
        "Nonlinear response, 5 s, 501 points, rtol 1e-6": {
            "SciPy solve_ivp (RK45)": lambda: peers.by_solve_ivp(job, loop.design.K),
            "heli2dof, simulate_nonlinear": lambda: simulate_nonlinear(loop, spec.limits, spec.scenario),
            "heli2dof, its kernel alone": kernel,
            "the same method in C, -O3": floor.call(floor.compiled(), system, t, states, *tolerances),
            "heli2dof, digital rig at 2 ms": lambda: simulate_digital(
                loop, spec.limits, spec.scenario, Digital()
            ),
        },
        "Linear response, 501 points, two outputs and two voltages": {
            "python-control, forced_response": lambda: control.forced_response(
                control.ss(*job.whole(loop.design.K)), t, np.ones((2, 501)) * [[0.5], [1.0]]
            ),
            "heli2dof, simulate_linear": lambda: simulate_linear(loop, spec.scenario),
        },
        "Scaling of the nonlinear response": {
            "5 s, 501 points, rtol 1e-6": scaled(),
            "5001 points": scaled(samples=5001),
            "20 s": scaled(duration=20.0),
            "rtol 1e-9": scaled(rtol=1e-9),
            "rtol 1e-12": scaled(rtol=1e-12),
        },
        "Robustness: nonlinear responses and poles of uncertain rigs, two threads": {
            f"{n} rigs": (lambda n=n: cloud(spec, Uncertainty(samples=n)))
            for n in (200, 2000, 10_000, 20_000)
        },
    }


def on_all_cores(call: Callable[[], object]) -> Callable[[], object]:
    """The call with BLAS as it is installed: on as many threads as there are cores."""
    blas = ThreadpoolController()

    def run() -> object:
        with blas.limit(limits=os.cpu_count(), user_api="blas"):
            return call()

    return run


BY_OTHERS = "\n## Drags beside slow work\n"
"""What `docs/performance.md` holds from here on has been measured by scripts that its sections name."""


def main() -> None:
    warm_up()
    threadpool_limits(1, "blas")  # as the server does; python-control is quicker so, too
    warnings.simplefilter("ignore")
    text = f"{HEADER}\n{machine()}; medians of one run; the first row of a table is 1."
    for title, calls in [*jobs().items()]:
        text += table(title, measured(calls))
    trips = round_trip.round_trips()
    whole, bare, own, work = trips.values()
    text += table("Over the live socket, on loopback", trips)
    text += f"""
A full update over the socket takes {whole / (bare + own):.2f} times a bare exchange and `evaluate` together, and
{whole / (bare + work):.2f} times a bare exchange and all that the server computes for it together.
"""
    print(text)
    if len(sys.argv) > 1:
        path = Path(sys.argv[1])
        kept = path.read_text("utf-8").partition(BY_OTHERS) if path.exists() else ("", "", "")
        path.write_text(text + "".join(kept[1:]), encoding="utf-8")


def machine() -> str:
    """Processor, cores and Python."""
    info = Path("/proc/cpuinfo")
    names = [line.split(":")[1].strip() for line in info.read_text().splitlines() if "model name" in line]
    return f"{names[0]}, {len(names)} cores, Python {platform.python_version()}"


def table(title: str, times: dict[str, float]) -> str:
    peer = next(iter(times.values()))
    rows = [f"| {name} | {1e3 * seconds:.3g} ms | {peer / seconds:.3g} |" for name, seconds in times.items()]
    return "\n".join(["", "", f"## {title}", "", "| | time | ratio |", "|---|---|---|", *rows, ""])


if __name__ == "__main__":
    main()
