#!/bin/sh
# python-control: step_info of a multivariable loop fails, or is absurd, because of the entries that ought to be 0.
#
# One expects: step_info(system) of a 2×2 loop with integral action gives each diagonal entry's overshoot and times;
#   where one output returns to 0 after a step of the other, something that says "no step here".
# What happens: all figures are shares of that entry's final value, which is 0 but for rounding. Depending on the sign
#   of some 1e-17, the overshoot is 1e15 % and more, or an IndexError that loses all four entries.
# Seen with: control 0.10.2, scipy 1.17.1, numpy 2.4.6.
# Why it matters: two axes, each with a PI controller, are a rig's usual loop. Ask for one entry at a time and measure
#   an off-diagonal one by its peak.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet control==0.10.2 scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" -W ignore - <<'EOF'
import control as ct
import numpy as np

A = np.diag([-1.0, -2.0])
absurd = failed = 0
for b, kp, ki in [(b, kp, ki) for b in (0.1, 0.2, 0.3, -0.3) for kp in (2, 3, 5) for ki in (2, 3, 7)]:
    B = np.array([[1, b], [0.2, 1]])  # two axes that push one another, each with a PI controller
    closed = np.block([[A - kp * B, ki * B], [-np.eye(2), np.zeros((2, 2))]])
    loop = ct.ss(closed, np.vstack([kp * B, np.eye(2)]), np.eye(2, 4), 0)
    assert np.allclose(ct.dcgain(loop), np.eye(2)) and loop.poles().real.max() < 0
    try:
        entries = ct.step_info(loop)
        absurd += max(entries[0][1]["Overshoot"], entries[1][0]["Overshoot"]) > 1e12
    except IndexError as error:
        failed += 1
        message = error
print("last loop, entry by entry: settles after", [ct.step_info(loop[i, i])["SettlingTime"] for i in range(2)], "s")
print(f"of 36 stable loops {absurd} have an overshoot above 1e12 %, {failed} end with IndexError: {message}")
assert absurd > 0 and failed > 0
EOF
