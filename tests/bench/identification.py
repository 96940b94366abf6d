"""How often 95 % intervals by noise contain the truth: `python -m tests.bench.identification [runs]`.

Each run is a digital rig of its own: parameters off its data sheet by up to 15 %, random reference steps, encoders,
filtered rates and noise by its seed. Also given: intervals that take the residuals for white, and the time.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np

from heli2dof_core import Spec, close_loop, place, preset
from heli2dof_core.engine import warm_up
from heli2dof_core.parameters import Parameters
from heli2dof_core.recordings.identification import Identification, identify
from heli2dof_core.recordings.recording import Recording
from heli2dof_core.recordings.samples import deviating_rig, sample_recording
from heli2dof_core.scenario import Digital
from heli2dof_core.signals import Floats

RUNS = 100


@dataclass(frozen=True)
class Case:
    """One kind of recording.

    Attributes:
        name: of the preset.
        noise: on the measured angles, rad; the controller sees it.
        duration, sample_time: s.
        encoders: whether the angles are rounded to their counts.
        rho, slow: first-order autoregressive noise that is added afterwards: correlation of successive values, and
            standard deviation, rad.
    """

    name: str
    noise: float = 1e-3
    duration: float = 20.0
    sample_time: float = 0.002
    encoders: bool = True
    rho: float = 0.0
    slow: float = 0.0

    def __str__(self) -> str:
        kind = f"noise {self.noise:g} rad" + (
            f", AR(1) {self.slow:g} rad ρ {self.rho:g}" if self.slow else ""
        )
        angles = "encoders" if self.encoders else "exact angles"
        return f"{self.name}, {angles}, {kind}, {self.duration:g} s at {1 / self.sample_time:g} Hz"


MANUAL = "quanser-2dof-manual"
CASES = (
    Case(MANUAL, encoders=False),
    Case(MANUAL),
    Case("quanser-aero-2", duration=30.0),
    *(Case(MANUAL, noise=0.0, encoders=False, rho=rho, slow=1e-3) for rho in (0.3, 0.6, 0.9, 0.97)),
    Case(MANUAL, encoders=False, rho=0.97, slow=1e-3),
    Case(MANUAL, noise=0.0),
)


def run(case: Case, seed: int) -> tuple[Parameters, Identification]:
    """The true rig, and what is found on its recording."""
    base = preset(case.name)
    spec = Spec.from_preset(base)
    loop = close_loop(place(spec), spec.outer)
    counts = base.encoders if case.encoders else (0, 0)
    digital = Digital(case.sample_time, encoders=counts, noise=case.noise, seed=seed)
    rig = deviating_rig(spec.parameters, 0.15, seed)
    size = (abs(base.scenario.theta or 0.0), abs(base.scenario.psi or 0.0))
    made = sample_recording(loop, spec.limits, digital, rig=rig, duration=case.duration, size=size)
    angles = made.measured + case.slow * autoregressive(case.rho, len(made.t), seed)
    recording = Recording(made.t, angles, made.voltages, made.references)
    return rig, identify(spec.parameters, recording, travel=spec.limits.theta)


def autoregressive(rho: float, count: int, seed: int) -> Floats:
    """Noise of variance 1 for both axes, (count, 2), successive values correlated by `rho`."""
    noise = np.random.default_rng([seed, 1]).standard_normal((count, 2))
    for k in range(1, count):
        noise[k] = rho * noise[k - 1] + np.sqrt(1 - rho**2) * noise[k]
    return noise


def tell(
    case: object, done: Sequence[tuple[Any, Identification]], truth: Callable[[Any, str], float]
) -> None:
    """Prints a case's table: how often each interval held the truth of its rig, by name."""
    runs = len(done)
    print(f"{case}, {runs} runs")
    together = hits = plain = 0
    for i, first in enumerate(done[0][1].estimates):
        right = [truth(rig, first.name) for rig, _ in done]
        own = [result.estimates[i] for _, result in done]
        inside = sum(abs(e.value - true) <= e.noise for e, true in zip(own, right, strict=True))
        white = sum(abs(e.value - true) <= e.plain for e, true in zip(own, right, strict=True))
        hits, plain = hits + inside, plain + white
        width = median(e.noise / abs(true) for e, true in zip(own, right, strict=True))
        print(f"  {first.name:5} inside {inside} of {runs}, taken for white {white}; ± {100 * width:.3g} %")
    for rig, result in done:
        together += all(abs(e.value - truth(rig, e.name)) <= e.noise for e in result.estimates)
    each, times = runs * len(done[0][1].estimates) / 100, [result.seconds for _, result in done]
    told = Counter(finding.code for _, result in done for finding in result.findings)
    print(
        f"  {hits / each:.1f} % of all intervals, taken for white {plain / each:.1f} %; all at once {together}"
    )
    print(f"  findings {dict(told)}; median {median(times):.2f} s, longest {max(times):.2f} s", flush=True)


def main(runs: int) -> None:
    """Prints a table per case."""
    warm_up()
    for case in CASES:
        tell(case, [run(case, seed) for seed in range(runs)], getattr)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else RUNS)
