#!/bin/sh
# SciPy: differential_evolution ends with NaN where one design of its first generation was NaN.
#
# One expects: NaN is worse than every number (a trial that is NaN is indeed never taken), so that what cannot be
#   measured dies out, as it does with inf.
# What happens: the best of a generation is found by argmin, for which NaN is the least, and a trial replaces its
#   parent where trial <= parent, which is never true of NaN. So a NaN of the first generation is "the best" for good:
#   it leads the mutation, the search never converges, runs to maxiter, and returns x of that design and fun = nan.
#   The least that the same generation holds is near the optimum all the while. success is False, but the message
#   tells of the number of iterations only. With inf in NaN's place the optimum is found.
# Seen with: scipy 1.17.1, numpy 2.4.6.
# Why it matters: figures of loops are NaN where they have none (control_step_info_slow_mode.sh), and the natural cure
#   for the message, a larger maxiter, cannot help. Return inf.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'EOF'
import numpy as np
from scipy.optimize import differential_evolution


def figure(x, none):
    """The least is 0 at (0.2, 0.2); where x[0] > 0.9, a twentieth of the box, there is no figure."""
    return float(np.sum((x - 0.2) ** 2)) if x[0] <= 0.9 else none


for seed in range(5):
    nan, inf = (
        differential_evolution(figure, [(-1, 1)] * 2, args=(none,), rng=seed, maxiter=200)
        for none in (np.nan, np.inf)
    )
    least, stay = np.nanmin(nan.population_energies), int(np.isnan(nan.population_energies).sum())
    print(f"seed {seed}, NaN: x {nan.x}, fun {nan.fun}, {nan.nit} iterations: {nan.message}")
    print(f"        {stay} of {len(nan.population)} are NaN to the end, the least of the others is {least:.1g}")
    print(f"        inf: x {inf.x}, fun {inf.fun:.1g}, {inf.nit} iterations")
    assert np.isnan(nan.fun) and nan.x[0] > 0.9 and not nan.success and nan.nit == 200
    assert 0 < stay < 10 and least < 1e-3
    assert inf.success and inf.fun < 1e-9
EOF
