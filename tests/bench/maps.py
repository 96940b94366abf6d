"""Maps of 64 × 48 designs, per design and as ratios to python-control in the same run: python -m tests.bench.maps.

python-control computes the linear figures of one design alone; the maps' designs are nonlinear where it says so.
Ratios are of processor time, so that neighbours on the machine do not count.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from statistics import median
from time import perf_counter, process_time

import numpy as np
from threadpoolctl import threadpool_limits

from heli2dof_core import Spec, Uncertainty, design_map
from heli2dof_core.engine import warm_up
from tests.bench import peers

SIZE = (64, 48)
RTOL = 1e-5
"""The page's own, as exact as a screen; the library's is 1e-8."""
OVER = ((-15.0, 0.0), (0.0, 11.25))
PSI = {"measure": "settling_time", "axis": "psi"}
MAPS = {
    "settling time of yaw, nonlinear": PSI,
    "settling time, either axis, nonlinear": {"measure": "settling_time"},
    "largest voltage of yaw's step, nonlinear": {"measure": "V_peak", "axis": "psi"},
    "settling time of yaw, linear": PSI | {"model": "linear"},
    "disk margin": "disk_margin",
    "lag margin": "lag_margin",
}


def main(rounds: int = 9) -> None:
    warm_up()
    exact = Spec.from_preset()
    spec = replace(exact, scenario=replace(exact.scenario, rtol=RTOL))
    job = peers.Job(spec)
    calls = {
        "python-control, as documented, a design": (lambda: peers.linear_as_documented(job), 1),
        "python-control, at its best, a design": (lambda: peers.linear_at_its_best(job), 1),
    }
    for name, measure in MAPS.items():
        for threads in (1, 2):
            calls[f"{name}, {threads} thread{'s' * (threads - 1)}"] = (
                lambda m=measure, n=threads: design_map(spec, "yaw-pair", m, OVER, SIZE, threads=n),
                SIZE[0] * SIZE[1],
            )
    calls["settling time of yaw, nonlinear, to 1e-8, 1 thread"] = (
        lambda: design_map(exact, "yaw-pair", PSI, OVER, SIZE),
        SIZE[0] * SIZE[1],
    )
    rigs = Uncertainty(samples=20)
    calls["share of 20 uncertain rigs within limits, 2 threads"] = (
        lambda: design_map(spec, "yaw-pair", "share_within_limits", OVER, SIZE, uncertainty=rigs, threads=2),
        SIZE[0] * SIZE[1],
    )
    picture = design_map(spec, "yaw-pair", PSI, OVER, SIZE)
    calls["its picture, SVG"] = (picture.svg, SIZE[0] * SIZE[1])
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in calls}
    for _ in range(rounds):  # in turn, so that a machine that drifts hits all alike
        for name, (call, _designs) in calls.items():
            begin, spent = perf_counter(), process_time()
            call()
            times[name].append((perf_counter() - begin, process_time() - spent))
    wall, spent = ({name: median(own[k] for own in each) for name, each in times.items()} for k in (0, 1))
    documented, best = list(spent.values())[:2]
    print(f"{'':54} {'s':>7} {'CPU s':>7} {'µs/design':>10} {'documented':>11} {'at its best':>11}")
    for name, (_, designs) in calls.items():
        each = spent[name] / designs
        ratios = f"{documented / each:10.0f}× {best / each:10.0f}×"
        print(f"{name:54} {wall[name]:7.3f} {spent[name]:7.3f} {1e6 * each:10.1f} {ratios}")


if __name__ == "__main__":
    np.seterr(all="ignore")
    with threadpool_limits(1, "blas"):
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
