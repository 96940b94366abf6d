#!/bin/sh
# pymoo: one design whose objectives are NaN can be the whole answer of NSGA-II.
#
# One expects: a design that could not be measured (NaN) is worse than every other, as with pymoo's own GA for one
#   objective; at least that its place among the others does not matter.
# What happens: non-dominated sorting depends on where the row of NaN stands. First, it is the first front, alone, and
#   all others are dominated; in the middle it is the second front, alone, before what is measured; last, it is last.
#   minimize with NSGA2 ends, for 3 of 10 seeds, with res.F = [[nan nan]], although 38 or 39 of 40 designs in its
#   last generation are good, and else with a front without NaN. Nothing is warned of.
# Seen with: pymoo 0.6.2, moocore 0.3.2, numpy 2.4.6.
# Why it matters: the settling time of a loop that does not settle is NaN in most tools. Give a large number, or
#   better a constraint (out["G"]), before it reaches the optimizer.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pymoo==0.6.2 moocore==0.3.2 numpy==2.4.6
"$folder/venv/bin/python" - <<'EOF'
import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.algorithms.soo.nonconvex.ga import GA
from pymoo.core.problem import ElementwiseProblem
from pymoo.optimize import minimize
from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting

good = [[1.0, 2.0], [2.0, 1.0], [3.0, 3.0]]
seen = []
for place in range(4):
    rows = good[:place] + [[np.nan, np.nan]] + good[place:]
    fronts = [[rows[i] for i in front] for front in NonDominatedSorting().do(np.array(rows))]
    print(f"NaN in row {place}: fronts", fronts)
    seen.append(fronts)
assert len(seen[0][0]) == 1 and np.isnan(seen[0][0]).all()
assert [fronts[0] for fronts in seen[1:]] == [good[:2]] * 3


class Far(ElementwiseProblem):
    """Two distances; what lies beyond 0.3 cannot be measured. The front is the line from (0, 0) to (0.3, 0)."""

    def __init__(self, objectives):
        super().__init__(n_var=2, n_obj=objectives, xl=-1.0, xu=1.0)

    def _evaluate(self, x, out, *args, **kwargs):
        figures = np.array([x[0] ** 2 + x[1] ** 2, (x[0] - 0.5) ** 2 + x[1] ** 2])[: self.n_obj]
        out["F"] = figures if x[0] <= 0.3 else np.full(self.n_obj, np.nan)


lost = []
for seed in range(10):
    result = minimize(Far(2), NSGA2(pop_size=40), ("n_gen", 20), seed=seed)
    front, last = np.atleast_2d(result.F), result.pop.get("F")
    measured = int(np.isfinite(last).all(axis=1).sum())
    if np.isnan(front).all():
        print(f"NSGA-II, seed {seed}: res.F = {front.tolist()}, {measured} of 40 in the last generation are measured")
        assert len(front) == 1 and measured > 30
        lost.append(seed)
    else:
        assert np.isfinite(front).all() and len(front) > 10
    assert np.isfinite(minimize(Far(1), GA(pop_size=40), ("n_gen", 20), seed=seed).F).all()
print(f"NSGA-II: NaN alone for {len(lost)} of 10 seeds; GA, one objective: for none")
assert 0 < len(lost) < 10
EOF
