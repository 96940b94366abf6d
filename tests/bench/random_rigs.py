"""Figures of merit of random experiments with the nonlinear rig against SciPy's, figure by figure.

python -m tests.bench.random_rigs [300] [seed] [tolerance of the integration]
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace

from heli2dof_core.engine import warm_up
from tests.core.random_rigs import FINE, KINDS, random_rigs, worst_of

CLOSE = 1e-6


def main() -> None:
    count, seed = (int(sys.argv[i]) if len(sys.argv) > i else default for i, default in ((1, 300), (2, 0)))
    rtol = float(sys.argv[3]) if len(sys.argv) > 3 else FINE
    warm_up()
    start = time.perf_counter()
    cases = ((kind, loop, replace(scenario, rtol=rtol)) for kind, loop, scenario in random_rigs(count, seed))
    worst, given_up = worst_of(cases)
    print(f"{'':22}" + "".join(f"{kind:>30}" for kind in KINDS))
    for figure in sorted({figure for _, figure in worst}, key=lambda name: name.split()[::-1]):
        own = (worst.get((kind, figure)) for kind in KINDS)
        cells = ("" if one is None else f"{one[0]:.1e} ({one[1]})" for one in own)
        print(f"{figure:22}" + "".join(f"{cell:>30}" for cell in cells))
    print(f"{count} cases, {given_up} given up; {time.perf_counter() - start:.0f} s")
    far = {key: gap for key, gap in worst.items() if not key[1].startswith("raw") and not gap[0] < CLOSE}
    if far:
        sys.exit(f"farther than {CLOSE:g}: {far}")


if __name__ == "__main__":
    main()
