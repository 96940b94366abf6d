#!/bin/sh
# Numba: a jitted function that another one calls with whole constants is compiled once for each constant.
#
# One expects: one version per types, int64 here, as when Python calls it.
# What happens: the calling function hands on Literal[int](0), Literal[int](1) …, and the callee is compiled for each of
#   them from the beginning: its types are inferred, it is lowered and optimised anew. Python's own calls share one.
# Seen with: numba 0.68.1, llvmlite 0.50.0, numpy 2.4.6.
# Why it matters: kernels that work on rows of a table call each other with row numbers. Ours, for polynomials, had twelve
#   versions of the innermost function; without them all kernels compile a fifth faster, and WebAssembly made of them is
#   smaller by a tenth. No option tells; only the dispatcher's `signatures` do.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet numba==0.68.1 llvmlite==0.50.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'EOF'
import numpy as np
from numba import njit


@njit
def row_sum(a, row):
    total = 0.0
    for x in a[row]:
        total += x
    return total


@njit
def three_rows(a):
    return row_sum(a, 0) + row_sum(a, 1) + row_sum(a, 2)


a = np.ones((3, 4))
assert three_rows(a) == 12.0
kinds = sorted(str(types[1]) for types in row_sum.signatures)
print("called by a jitted function with 0, 1, 2:", kinds)
assert kinds == ["Literal[int](0)", "Literal[int](1)", "Literal[int](2)"]
for row in range(3):
    row_sum(a, row)
kinds = sorted(str(types[1]) for types in row_sum.signatures)
print("and by Python with 0, 1, 2:", kinds)
assert kinds == ["Literal[int](0)", "Literal[int](1)", "Literal[int](2)", "int64"]
EOF
