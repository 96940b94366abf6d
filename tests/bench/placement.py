"""Time per placement, as ratios to python-control's `place` in the same run: python -m tests.bench.placement.

Medians of rounds that take all contestants in turn, so that a machine that drifts hits all alike.
"""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from time import perf_counter

import control
import numpy as np

from heli2dof_core import METHODS, Heli2DofError, Structure, Weights, design, plant, preset
from heli2dof_core.compiled import gain
from heli2dof_core.placement.method import Task
from heli2dof_core.signals import C

ROUNDS = 15
PEER = "control.place"


def main() -> None:
    for name in ("quanser-2dof-manual", "quanser-aero-2"):
        rig = preset(name)
        print(f"\n{rig.title}: seconds per call, and the ratio to {PEER}")
        times = measured(contestants(rig))
        for contestant, seconds in sorted(times.items(), key=lambda item: item[1]):
            print(f"  {contestant:34} {1e6 * seconds:10.1f} µs   1/{times[PEER] / seconds:.4g}")


def contestants(rig) -> dict[str, Callable[[], object]]:
    model, poles = plant(rig.parameters, rig.theta_0), rig.poles
    numbers = (*poles.coefficients, *rig.parameters.as_dict().values(), rig.theta_0)
    weights = Weights((30.0, 30.0, 1.0, 1.0), (0.002, 0.004), (100.0, 100.0))
    task = Task(model.A, model.B, poles.array, C, weights)
    calls: dict[str, Callable[[], object]] = {PEER: lambda: control.place(model.A, model.B, poles.array)}
    for coupling, lead in (("triangular", "pitch"), ("axis-decoupled", "pitch")):
        closed_form = gain(Structure(coupling, lead))  # with Ĝ(0)⁻¹, as a design asks for
        calls[f"closed form, {coupling}"] = lambda f=closed_form: f(*numbers)
    calls["design (closed form, poles, findings)"] = lambda: design(model, poles)
    for method in METHODS.values():
        try:
            method.place(task)
        except Heli2DofError:
            continue
        calls[method.name + (", exact, any system" if method.name == "full-rank" else "")] = (
            lambda own=method: own.place(task)
        )
    return calls


def measured(calls: dict[str, Callable[[], object]]) -> dict[str, float]:
    """Median seconds of a call of each, over rounds; quick ones are called more often within a round."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(ROUNDS):
        for name, call in calls.items():
            begin = perf_counter()
            call()
            repeats = max(1, int(3e-2 / (perf_counter() - begin)))
            for _ in range(repeats):
                begin = perf_counter()
                call()
                times[name].append(perf_counter() - begin)
    return {name: median(values) for name, values in times.items()}


if __name__ == "__main__":
    np.seterr(all="ignore")
    main()
