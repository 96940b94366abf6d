#!/bin/sh
# python-control: step_info misses the settling time of a response with a small slow part.
#
# One expects: step_info(system) chooses its window so that the response has settled: all poles are known.
# What happens: the window follows the fast mode, since the slow one's residue is small. Of 0.97/(s/10 + 1) +
#   0.03/(s/0.04 + 1), which enters the 2 % band at ln(0.03/0.02)/0.04 = 10.14 s, the settling time is NaN. With T=500
#   it is 10.20 s: the first sample inside, not the crossing.
# Seen with: control 0.10.2, scipy 1.17.1, numpy 2.4.6.
# Why it matters: a PI controller whose zero nearly cancels a slow pole leaves just such a tail. NaN reads as "never
#   settles". Give T, with a step well below the accuracy wanted.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet control==0.10.2 scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" -W ignore - <<'EOF'
import control as ct
import numpy as np

s = ct.tf("s")
G = 0.97 / (s / 10 + 1) + 0.03 / (s / 0.04 + 1)
exact = np.log(0.03 / 0.02) / 0.04
default, long = ct.step_info(G), ct.step_info(G, T=500)
t = ct.step_response(ct.ss(G), T=500).time
print("default window ends at", ct.step_response(G).time[-1], "s; settling time", default["SettlingTime"])
print("T=500: samples every", t[1], "s; settling time", long["SettlingTime"], "exact", exact)
assert np.isnan(default["SettlingTime"])
assert exact < long["SettlingTime"] < exact + t[1] and np.isclose(long["SettlingTime"] % t[1] % t[1], 0, atol=1e-6)
EOF
