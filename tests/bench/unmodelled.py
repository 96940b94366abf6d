"""How often intervals hold the truth where the model leaves something out.

`python -m tests.bench.unmodelled [runs [case [seed]]]`

The rigs' rotors lag and their axes rub; the model that is fitted knows neither. A third of each recording is held
out. Beside the intervals that are told stand those of noise alone, which are those of a model that is right.
"""

from __future__ import annotations

import sys
from statistics import median

from heli2dof_core import preset
from heli2dof_core.engine import warm_up
from heli2dof_core.recordings.identification import Identification, identify
from heli2dof_core.recordings.validation import HELD_OUT

from .actuated import Actuated, Truth, made

RUNS = 20
NOTHING = (1e-3, 1e-3)
CASES = {
    "lag of 30 to 60 ms": Actuated(tau=(0.03, 0.06), coulomb=(0.0, 0.0)),
    "lag of 0.1 to 0.2 s": Actuated(tau=(0.1, 0.2), coulomb=(0.0, 0.0)),
    "Coulomb friction of 0.01 to 0.03 N·m": Actuated(tau=NOTHING, coulomb=(0.01, 0.03)),
    "both, small": Actuated(tau=(0.03, 0.06), coulomb=(0.003, 0.01)),
    "both": Actuated(),
    "both, voltage steps": Actuated(closed=False),
    "dead zone of 1 V, quadratic thrust": Actuated(
        tau=NOTHING, coulomb=(0.0, 0.0), curve="quadratic", dead_zone=1.0, matched_at=14.0
    ),
}


def found(case: Actuated, seed: int) -> tuple[Truth, Identification]:
    """The truth, and what is found by a model without rotors and friction."""
    truth, recording = made(case, seed)
    return truth, identify(preset(case.name).parameters, recording, held_out=HELD_OUT)


def counted(done: list[tuple[Truth, Identification]]) -> list[tuple[str, int, int, float]]:
    """Per parameter: how often the interval held the truth, how often that of noise alone, its median width, %."""
    rows = []
    for i, first in enumerate(done[0][1].estimates):
        own = [(truth.of(first.name), result.estimates[i]) for truth, result in done]
        inside = sum(e.low <= true <= e.high for true, e in own)
        noise = sum(abs(e.value - true) <= e.noise for true, e in own)
        rows.append((first.name, inside, noise, median(50 * (e.high - e.low) / abs(true) for true, e in own)))
    return rows


def main(runs: int, only: str, first: int) -> None:
    """Prints a table per case."""
    warm_up()
    for name, case in CASES.items():
        if only not in name:
            continue
        rows = counted([found(case, seed) for seed in range(first, first + runs)])
        print(f"{name}, {runs} runs from seed {first}")
        for parameter, inside, noise, width in rows:
            print(f"  {parameter:5} inside {inside}, by noise alone {noise}; ± {width:.2g} %")
        count = runs * len(rows) / 100
        print(
            f"  {sum(r[1] for r in rows) / count:.0f} %, by noise alone {sum(r[2] for r in rows) / count:.0f} %",
            flush=True,
        )


if __name__ == "__main__":
    given = sys.argv[1:]
    main(
        int(given[0]) if given else RUNS,
        given[1] if len(given) > 1 else "",
        int(given[2]) if len(given) > 2 else 0,
    )
