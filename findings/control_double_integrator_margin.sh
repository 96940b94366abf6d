#!/bin/sh
# python-control: the gain margin of a loop with two integrators depends on how the loop is written.
#
# One expects: (s + 0.1)/s² crosses −180° nowhere (its phase rises from −180° to −90°), so that its gain margin is
#   infinite, as transfer function and as state space.
# What happens: as a transfer function it is inf. As a state-space model it is 1e-14 or so at ω = 0 or next to it, in
#   most of twenty bases of small whole numbers: the double pole at 0 is rounded apart, and then the phase does cross.
# Seen with: control 0.10.2, scipy 1.17.1, numpy 2.4.6.
# Why it matters: position-controlled rigs have two integrators (inertia and PI control) and are state-space models. A
#   margin of 1e-16 reads as "unstable as soon as the gain drops", or as a bug of whoever reports infinity.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet control==0.10.2 scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" -W ignore - <<'EOF'
import control as ct
import numpy as np

s = ct.tf("s")
L = (s + 0.1) / s**2
phases = np.angle([L(1j * w) for w in np.geomspace(1e-6, 1e6, 100)], deg=True)
print("phase of L(jω) between", phases.min(), "and", phases.max(), "degrees")
assert -180 < phases.min() and phases.max() < -89
assert ct.margin(L)[0] == np.inf
print("transfer function: gain margin", ct.margin(L)[0])
A, b, c = np.array([[0.0, 1], [0, 0]]), np.array([[0.0], [1]]), np.array([[0.1, 1]])
tiny = 0
for k in range(1, 21):
    T, inverse = np.array([[k, k - 1.0], [k + 1, k]]), np.array([[k, 1.0 - k], [-k - 1, k]])
    moved = T @ A @ inverse  # exact: whole numbers
    gain, _, frequency, _ = ct.margin(ct.ss(moved, T @ b, c @ inverse, 0))
    tiny += bool(gain < 1e-9)
    if k < 5:
        print(f"A = {moved.tolist()}: gain margin {gain:.2g} at {frequency:.2g} rad/s")
print("below 1e-9 in", tiny, "of 20 bases")
assert tiny >= 5
EOF
