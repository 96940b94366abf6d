"""How far the page's kernels may be from the compiled ones: as far as a last digit takes these themselves.

Both come from the same lines, but sine and cosine are the browser's, whose last digits are not those of C. What that
does depends on the course: a loop that runs away, a rotor that hunts at its dead zone, or a window of minutes carry
it far. So the compiled kernel is asked again with a rig whose inertias differ in their last digit, both ways: a gap
counts against those.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from heli2dof_core.kernels.figures import PEAK, PEAK_TIME
from heli2dof_core.kernels.layout import ALPHA, J_Y, STOP, TRAVEL
from tests.wasm.replay import Call, Replayed, called

FILLED = {
    "run_experiments": ("linear", "nonlinear", "voltages", "axes", "motors", "courses"),
    "run_nonlinear": ("states", "voltages", "axes", "motors", "course"),
    "run_digital": ("states", "voltages", "axes", "motors", "known"),
    "polynomial_matrices": ("f",),
    "whole_polynomials": ("f",),
    "margins": ("table",),
    "sensitivity_peaks": ("both",),
    "is_stable": (),
    "lag_margin": (),
    "eigenvalues": ("real", "imaginary"),
}
"""What a kernel is asked for; all else that it writes into is scratch."""
EXACT = 1e-12
"""Of an array's largest number."""
FACTOR = 100.0
"""How much farther than by a last digit of the inertias a course may be carried, by a last digit of each sine."""
DIGIT = 2.0**-52


def gap(one: Any, other: Any) -> float:
    """The largest difference as a share of the largest number; inf where one is finite alone."""
    one, other = np.atleast_1d(one).astype(float), np.atleast_1d(other).astype(float)
    finite = np.isfinite(one)
    if not np.array_equal(one[~finite], other[~finite], equal_nan=True):
        return np.inf
    size = np.max(np.abs(one[finite]), initial=0.0)
    apart = np.max(np.abs(one - other, where=finite, out=np.zeros_like(one)), initial=0.0)
    return float(apart / size) if size > 0.0 else float(apart)


def _told(call: Call | Replayed, name: str) -> Any:
    """An array that is asked for, without the time at which pitch was highest where that is at its stop.

    It rests there more than once, as high each time but for rounding.
    """
    found = call.after[name]
    if name == "axes":
        found = np.array(found)
        travel = (
            call.after["experiments"][0, STOP] if "experiments" in call.after else call.after["c"][TRAVEL]
        )
        pitch = found[..., 0, :]
        pitch[np.isclose(np.abs(pitch[..., PEAK]), travel, rtol=1e-9), PEAK_TIME] = np.nan
    return found


def gaps(call: Call, replay: Replayed) -> dict[str, float]:
    """By array that is asked for, and `returned`."""
    assert replay.error is None, f"{call.kernel}: {replay.error}"
    found = {name: gap(_told(call, name), _told(replay, name)) for name in FILLED[call.kernel]}
    if call.returned is not None:
        found["returned"] = gap(call.returned, replay.returned)
    return found


def allowed(call: Call) -> dict[str, float]:
    """What last digits of the rig's inertias do to the compiled kernel's own answer, with `FACTOR`, by array."""
    most = dict.fromkeys(FILLED[call.kernel], 0.0)
    constants = {"run_experiments": ("rig",), "run_nonlinear": ("c",), "run_digital": ("c", "plant")}
    for ways in ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)):
        arguments = {
            name: value.copy() if isinstance(value, np.ndarray) else value
            for name, value in call.before.items()
        }
        for name in constants[call.kernel]:
            arguments[name][[ALPHA, J_Y]] *= 1.0 + DIGIT * np.array(ways)
        again = called(call.kernel, *arguments.values())
        most = {name: max(most[name], FACTOR * gap(_told(call, name), _told(again, name))) for name in most}
    return most
