"""How far the page's kernels may be from the compiled ones: as far as a last digit takes these themselves.

Both come from the same lines, but sine and cosine are the browser's, whose last digits are not those of C. What that
does depends on the course: a loop that runs away, a rotor that hunts at its dead zone, or a window of minutes carry
it far. So the compiled kernel is asked again with a rig whose inertias differ in their last digit, both ways: a gap
counts against those.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from heli2dof_core.kernels.update_layout import PARAMETERS, block_shapes
from heli2dof_core.parameters import PARAMETER_INFO
from tests.wasm.replay import Call, Replayed, called

RIGS = ("rig_poles", "angles", "stable", "within")
FILLED = {
    "update": tuple(re.sub("^open$", "own_poles", name) for name in block_shapes(6, 2)),
    "run_rigs": RIGS,
    "eigenvalues": ("real", "imaginary"),
}
"""What a kernel is asked for; all else that it writes into is scratch."""
EXACT = 1e-12
"""Of an array's largest number."""
FACTOR = 100.0
"""How much farther than by a last digit of the inertias a course may be carried, by a last digit of each sine."""
DIGIT = 2.0**-52
INERTIAS = [PARAMETERS + [*PARAMETER_INFO].index(name) for name in ("J_p", "J_y")]


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


def allowed(call: Call) -> dict[str, float]:
    """What last digits of the rig's inertias do to the compiled kernel's own answer, with `FACTOR`, by array."""
    most = dict.fromkeys(FILLED[call.kernel], 0.0)
    for ways in ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)):
        arguments = {
            name: value.copy() if isinstance(value, np.ndarray) else value
            for name, value in call.before.items()
        }
        arguments["numbers"][INERTIAS] *= 1.0 + DIGIT * np.array(ways)
        again = called(call.kernel, *arguments.values())
        most = {name: max(most[name], FACTOR * gap(call.after[name], again.after[name])) for name in most}
    return most
