"""Random designs of every kind through `evaluate`: no exception but a refusal, no contradiction.

python -m tests.bench.random_designs [20000] [seed]
"""

from __future__ import annotations

import sys
import time
import warnings
from collections import Counter
from dataclasses import replace

import numpy as np

from heli2dof_core import Heli2DofError, Report, Scenario, Spec, evaluate
from heli2dof_core.engine import warm_up
from tests.core.random_loops import opened, random_spec

SHORT = Scenario(theta=0.1, psi=0.2, duration=1.0, samples=21)


def run(count: int, seed: int) -> Counter[str]:
    """How many were refused, stable and not; raises AssertionError where two figures contradict."""
    rng, seen = np.random.default_rng(seed), Counter[str]()
    for _ in range(count):
        spec = replace(random_spec(rng), scenario=SHORT)
        try:
            report = evaluate(spec, most_steps=2000)
        except Heli2DofError as refusal:
            seen[f"refused: {type(refusal).__name__}"] += 1
            continue
        try:
            check(spec, report)
        except AssertionError as error:
            raise AssertionError(f"{spec!r}, {spec.parameters}, θ₀ = {spec.theta_0}, {spec.outer}") from error
        seen["stable" if report.loop.stable else "not stable"] += 1
    return seen


def check(spec: Spec, report: Report) -> None:
    """Poles, stability, steady state, RGA, margins and remarks agree."""
    loop, design = report.loop, report.design
    wanted = spec.poles.values
    codes = {finding.code for finding in report.findings}
    assert np.all(np.isfinite(design.K)) and np.all(np.isfinite(loop.poles))
    steady = design.steady_state is not None
    assert design.stable == (steady and all(p.real < 0 for p in wanted))
    assert steady == (report.interaction.rga is not None) == ("no_steady_state" not in codes)
    assert not steady or 0 not in wanted
    assert steady or min(map(abs, wanted)) < 1e-6 * max(map(abs, wanted)) + 1e-9
    assert (report.margins is None) == (report.sensitivity is None) == (not loop.stable)
    assert ("imaginary_axis" in codes or "right_half_plane" in codes) == (not design.stable)
    if spec.outer.outer == "none":
        assert loop.stable == design.stable, loop.poles
    scale = max(abs(loop.connected_poles))
    if abs(loop.connected_poles[0].real) > 1e-3 * scale:
        assert loop.stable == (loop.connected_poles[0].real < 0)
    if report.margins is None or report.sensitivity is None:
        return
    assert report.sensitivity.peak >= 1 and 0 < report.sensitivity.disk_margin <= 2
    for motor, own in enumerate(report.margins):
        A, b, c = opened(loop, motor)
        for gain in (own.gain_margin, own.gain_reduction_margin):
            if gain is not None:
                values = np.linalg.eigvals(A + gain * np.outer(b, c))
                nearest = np.min(np.abs(values.real)) / max(abs(values))
                assert nearest < 1e-4, (motor, gain, values)  # a double pole moves with the root of rounding


def main() -> None:
    count, seed = (int(sys.argv[i]) if len(sys.argv) > i else default for i, default in ((1, 20_000), (2, 0)))
    warm_up()
    warnings.simplefilter("error")
    start = time.perf_counter()
    for name, number in run(count, seed).most_common():
        print(f"{number:6d} {name}")
    print(f"{time.perf_counter() - start:.0f} s")


if __name__ == "__main__":
    main()
