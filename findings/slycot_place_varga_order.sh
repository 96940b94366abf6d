#!/bin/sh
# slycot (SB01BD, control.place_varga): the order of the wanted poles decides which poles are placed.
#
# One expects: a set of poles that is closed under conjugation is a set; order does not matter, as for control.place.
# What happens: conjugates must stand side by side. For −1+j, −2+j, −1−j, −2−j on a chain of four integrators the
#   result has −1 ± j twice and −2 ± j not at all, without a warning or an error.
# Seen with: slycot 0.7.1, control 0.10.2, scipy 1.17.1, numpy 2.4.6.
# Why it matters: poles come sorted by imaginary part, or two per axis, from s-planes, eigenvalues and tables. The
#   loop is stable, so that only a look at the eigenvalues tells.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet control==0.10.2 slycot==0.7.1 scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'EOF'
import warnings

import control as ct
import numpy as np

warnings.simplefilter("error")
A, B = np.diag(np.ones(3), 1), np.eye(4)[:, 3:]
wanted = [-1 + 1j, -2 + 1j, -1 - 1j, -2 - 1j]
paired = sorted(wanted, key=lambda p: p.real)
for place, order in ((ct.place, wanted), (ct.place_varga, wanted), (ct.place_varga, paired)):
    K = place(A, B, order)
    print(place.__name__, order, "->", np.round(np.poly(A - B @ K), 6))
asked, twice = np.poly(wanted).real, np.poly([-1 + 1j, -1 - 1j] * 2).real
assert np.allclose(np.poly(A - B @ ct.place(A, B, wanted)), asked)
assert np.allclose(np.poly(A - B @ ct.place_varga(A, B, paired)), asked)
assert np.allclose(np.poly(A - B @ ct.place_varga(A, B, wanted)), twice)
EOF
