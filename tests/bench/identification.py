"""How often the 95 % intervals of an identification contain the truth: `python -m tests.bench.identification [runs]`.

Each run is a digital rig of its own: parameters off its data sheet by up to 15 %, random reference steps, encoders,
filtered rates and noise by its seed. Also given: intervals that take the residuals for white, and the time.
"""

from __future__ import annotations

import sys
from statistics import median

from heli2dof_core import Spec, close_loop, place, preset
from heli2dof_core.engine import warm_up
from heli2dof_core.identification import Identification, identify
from heli2dof_core.parameters import Parameters
from heli2dof_core.recordings import Recording
from heli2dof_core.sample_recordings import deviating_rig, sample_recording
from heli2dof_core.spec import Digital

RUNS = 100
CASES = (
    # preset, noise in rad, duration in s, sample time in s
    ("quanser-2dof-manual", 1e-3, 20.0, 0.002),
    ("quanser-2dof-manual", 0.0, 20.0, 0.002),
    ("quanser-aero-2", 1e-3, 30.0, 0.002),
)


def run(
    name: str, noise: float, duration: float, sample_time: float, seed: int
) -> tuple[Parameters, Identification]:
    """The true rig, and what is found on its recording."""
    base = preset(name)
    spec = Spec.from_preset(base)
    loop = close_loop(place(spec), spec.outer)
    digital = Digital(sample_time, encoders=base.encoders, noise=noise, seed=seed)
    rig = deviating_rig(spec.parameters, 0.15, seed)
    size = (abs(base.scenario.theta or 0.0), abs(base.scenario.psi or 0.0))
    made = sample_recording(loop, spec.limits, digital, rig=rig, duration=duration, size=size)
    recording = Recording(made.t, made.measured, made.voltages, made.references)
    return rig, identify(spec.parameters, recording, travel=spec.limits.theta)


def main(runs: int) -> None:
    """Prints a table per case."""
    warm_up()
    for name, noise, duration, sample_time in CASES:
        done = [run(name, noise, duration, sample_time, seed) for seed in range(runs)]
        print(f"{name}, noise {noise:g} rad, {duration:g} s at {1 / sample_time:g} Hz, {runs} runs")
        together = 0
        for i, first in enumerate(done[0][1].estimates):
            truth = [getattr(rig, first.name) for rig, _ in done]
            own = [result.estimates[i] for _, result in done]
            inside = sum(e.low <= true <= e.high for e, true in zip(own, truth, strict=True))
            white = sum(abs(e.value - true) <= e.plain for e, true in zip(own, truth, strict=True))
            width = median((e.high - e.low) / 2 / abs(true) for e, true in zip(own, truth, strict=True))
            print(
                f"  {first.name:5} inside {inside} of {runs}, taken for white {white}; ± {100 * width:.3g} %"
            )
        for rig, result in done:
            together += all(e.low <= getattr(rig, e.name) <= e.high for e in result.estimates)
        times = [result.seconds for _, result in done]
        print(f"  all at once {together}; median {median(times):.2f} s, longest {max(times):.2f} s")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else RUNS)
