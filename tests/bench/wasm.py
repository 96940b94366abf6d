"""The page's kernels in Node, as ratios to the compiled ones on the same arguments: python -m tests.bench.wasm.

Arguments are those of random designs, of all kinds and for the preset's own as the page asks for it.
"""

from __future__ import annotations

from collections import defaultdict
from time import perf_counter

import numpy as np

from heli2dof_core import evaluate
from heli2dof_core.engine import warm_up
from tests.bench.update import spec_of
from tests.wasm.designs import random_designs
from tests.wasm.replay import Call, recorded, replayed

DESIGNS, ROUNDS = 60, 100


def main() -> None:
    with recorded() as page:
        report = evaluate(spec_of(), each_axis=True)
        _ = report.margins, report.sensitivity
    with recorded() as others:
        designs = random_designs(np.random.default_rng(1))
        for _ in range(DESIGNS):
            report = evaluate(next(designs))
            _ = report.margins, report.sensitivity
    for title, calls in (("the page's update", page), (f"{DESIGNS} random designs", others)):
        print(f"\n{title}: compiled, WebAssembly, ratio")
        rows: dict[str, list[float]] = defaultdict(lambda: [0.0, 0.0])
        answers, _ = replayed(calls, repeat=ROUNDS)
        for call, answer in zip(calls, answers, strict=True):
            for name in (call.kernel, "all"):
                rows[name][0] += compiled(call)
                rows[name][1] += answer.seconds
        for name, (native, page_s) in rows.items():
            print(f"  {name:24}{1e6 * native:10.1f} µs{1e6 * page_s:10.1f} µs{page_s / native:8.2f}")


def compiled(call: Call) -> float:
    """The shortest time of the compiled kernel, s."""
    function, best = getattr(warm_up(), call.kernel), np.inf
    for _ in range(ROUNDS):
        given = [value.copy() if isinstance(value, np.ndarray) else value for value in call.before.values()]
        start = perf_counter()
        function(*given)
        best = min(best, perf_counter() - start)
    return float(best)


if __name__ == "__main__":
    main()
