#!/bin/sh
# python-control: installing slycot changes answers, not only speed and what is available.
#
# One expects: slycot is an optional accelerator; ss(tf) and lqr give the same with and without it.
# What happens: (1) ss((s − 1)/((s − 1)(s + 1))) has the poles ±1 without slycot and −1 alone with it: the realization
#   is made minimal and the cancelled unstable pole is gone, without a word. (2) lqr of the double integrator with Q =
#   diag(0, 1), for which no stabilizing gain exists, raises with slycot; without, it returns K = [0, 1], which leaves
#   a pole at 0.
# Seen with: control 0.10.2, slycot 0.7.1, scipy 1.17.1, numpy 2.4.6.
# Why it matters: the same homework is stable on one machine and unstable on the other. Build unstable loops as state
#   space and look at the poles after lqr.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
cat > "$folder/ask.py" <<'EOF'
import sys

import control as ct
import numpy as np

s = ct.tf("s")
poles = np.sort(ct.ss((s - 1) / ((s - 1) * (s + 1))).poles().real)
try:
    K = ct.lqr([[0, 1], [0, 0]], [[0], [1]], np.diag([0, 1]), [[1]])[0]
    lqr = str(np.round(K, 9).tolist())
except Exception as error:
    lqr = type(error).__name__
print("slycot:", ct.slycot_check(), "| poles of ss(tf):", poles, "| lqr:", lqr)
expected = {"with": ([-1.0], "SlycotArithmeticError"), "without": ([-1.0, 1.0], "[[0.0, 1.0]]")}[sys.argv[1]]
assert np.allclose(poles, expected[0]) and lqr == expected[1]
EOF
"$folder/venv/bin/pip" install --quiet control==0.10.2 scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" -W ignore "$folder/ask.py" without
"$folder/venv/bin/pip" install --quiet slycot==0.7.1 numpy==2.4.6
"$folder/venv/bin/python" -W ignore "$folder/ask.py" with
