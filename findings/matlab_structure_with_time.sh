#!/bin/sh
# SciPy and pymatreader on Simulink's "structure with time": the shape of what is read depends on reader and number of
#   signals.
#
# One expects: run.signals is a list of structures, one per signal, in both (pymatreader reads by scipy.io), also
#   where there is one.
# What happens: SciPy (simplify_cells) gives a dict for one signal and a list of dicts for several; pymatreader gives
#   a dict for one and, for several, a dict of lists. Code that was tried with a log of one signal fails with two, and
#   the other way round.
# Seen with: scipy 1.17.1, pymatreader 1.3.2, numpy 2.4.6, h5py 3.16.0; savemat writes the fields that Simulink
#   writes, and a file of GNU Octave reads the same.
# Why it matters: rigs log through Simulink's To Workspace blocks or scopes, one signal or several per block.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet scipy==1.17.1 pymatreader==1.3.2 numpy==2.4.6 h5py==3.16.0
cd "$folder"
"$folder/venv/bin/python" - <<'EOF'
import numpy as np
from pymatreader import read_mat
from scipy.io import loadmat, savemat

t = np.linspace(0, 1, 5)
kind = [("values", object), ("label", object)]


def log(*labels):
    signals = np.array([[(t[:, None] ** k, label) for k, label in enumerate(labels)]], dtype=kind)
    return {"time": t[:, None], "signals": signals}


savemat("run.mat", {"one": log("pitch"), "two": log("pitch", "yaw")})
shapes = {}
for name, data in (("scipy", loadmat("run.mat", simplify_cells=True)), ("pymatreader", read_mat("run.mat"))):
    for log_name in ("one", "two"):
        signals = data[log_name]["signals"]
        inner = signals[0] if isinstance(signals, list) else signals["label"]
        shapes[name, log_name] = f"{type(signals).__name__} of {type(inner).__name__}"
        print(name, log_name, shapes[name, log_name])
assert shapes["scipy", "one"] == shapes["pymatreader", "one"] == "dict of str"
assert shapes["scipy", "two"] == "list of dict"
assert shapes["pymatreader", "two"] == "dict of list"
EOF
