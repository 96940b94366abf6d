"""The page's kernels beside the compiled ones: the same sums in the same order, so the same digits.

Only functions that are the browser's own may differ in their last digit: powers, logarithms, and the phase's arcus
tangent. Sine and cosine are the kernels' (`kernels.trigonometry`), since a long course carries their last digit far.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from heli2dof_core.kernels.update_layout import block_shapes
from tests.wasm.replay import Call, Replayed

RIGS = ("rig_poles", "angles", "stable", "within")
FILLED = {
    "update": tuple(re.sub("^open$", "own_poles", name) for name in block_shapes(6, 2)),
    "run_rigs": RIGS,
    "run_designs": ("found_poles", "found"),
    "flight_controller": ("outcome", "c", "m", "estimated", "start", "k"),
    "begin_flight": ("y", "s", "free"),
    "fly": ("y", "s", "free", "rows"),
    "take_over": ("y", "s", "told"),
    "eigenvalues": ("real", "imaginary"),
}
"""What a kernel is asked for; all else that it writes into is scratch."""
EXACT = 1e-12
"""Of an array's largest number."""


def gap(one: Any, other: Any) -> float:
    """The largest difference as a share of the largest number; inf where one is finite alone."""
    one, other = (np.atleast_1d(each).astype(complex).view(float) for each in (one, other))
    finite = np.isfinite(one)
    if not np.array_equal(one[~finite], other[~finite], equal_nan=True):
        return np.inf
    own, others = one[finite], other[finite]
    size = np.max(np.abs(own), initial=0.0)
    apart = np.max(np.abs(own - others), initial=0.0)
    return float(apart / size) if size > 0.0 else float(apart)


def gaps(call: Call, replay: Replayed) -> dict[str, float]:
    """By array that is asked for, and `returned`."""
    assert replay.error is None, f"{call.kernel}: {replay.error}"
    found = {name: gap(call.after[name], replay.after[name]) for name in FILLED[call.kernel]}
    if call.returned is not None:
        found["returned"] = gap(call.returned, replay.returned)
    return found
