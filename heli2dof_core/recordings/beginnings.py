"""How a stretch of a recording begins where rotors take time: their speeds there depend on what nobody recorded.

A file that begins with a step begins with rotors that do not yet turn as its first voltages say. For a few time
constants that shows in the angles, and is found from them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Wanted, nobody_leaves
from ..signals import Floats
from ..simulation.recorded import run_held, turning
from .recording import Recording
from .segments import FEWEST, rough_starts

WINDOW = 6.0
"""Time constants from the beginning that are looked at: by then 0.3 % is left of how far speeds were away."""
LEAST_NOISE = 1e-5
"""Of angles, rad: below it residuals are no measure of what is known of the speeds."""
_STEPS = (1e-4, 1e-4, 1e-3, 1e-3, 0.02, 0.02)
"""Of numerical derivatives: rad, rad/s, V."""
_SPEEDS = np.repeat([0.0, 1.0], [4, 2])
_MOST = 6
_SHORTER, _TRIALS = 0.25, 4
_ENOUGH = 1e-6


def beginnings(
    p: Any,
    recording: Recording,
    bounds: NDArray[np.int64],
    acting: Floats | None,
    *,
    travel: float | None = None,
    wanted: Wanted = nobody_leaves,
) -> tuple[Floats, Floats]:
    """States θ, ψ, θ̇, ψ̇ with which stretches begin, and how far rotors are from the first voltages there.

    Gauss and Newton's method on both, least squares of the angles over the first `WINDOW` time constants; how far
    rotors are away is thought to be as large as voltages are, so that what the angles do not show is taken for 0.

    Args:
        p: the rig.
        recording: what was measured.
        bounds: of the stretches, first and last + 1, (stretches, 2).
        acting: rotors and friction, `rotors.Actuators.constants`; None for the paper's rig.
        travel: pitch is stopped at ±travel, rad.
        wanted: called now and then; what it raises ends the search.

    Returns:
        (stretches, 4), rad and rad/s, and (stretches, 2), V; where no rotor takes time, the first by parabolas alone.
    """
    starts, away = rough_starts(recording, bounds), np.zeros((len(bounds), 2))
    if acting is None or not np.any(acting[:2]):
        return starts, away
    reach = WINDOW * float(np.max(acting[:2]))
    for i, (first, end) in enumerate(bounds.tolist()):
        until = int(np.searchsorted(recording.t, recording.t[first] + reach, side="right"))
        rows = slice(first, min(end, max(until, first + FEWEST)))
        if rows.stop - first >= FEWEST:
            starts[i], away[i] = _fitted(
                p, recording, rows, starts[i], acting=acting, travel=travel, wanted=wanted
            )
    return starts, away


def _fitted(
    p: Any,
    recording: Recording,
    rows: slice,
    start: Floats,
    *,
    acting: Floats,
    travel: float | None,
    wanted: Wanted,
) -> tuple[Floats, Floats]:
    t, volts, measured = recording.t[rows], recording.voltages[rows], recording.angles[rows]
    whole = np.array([[0, len(t)]])
    free = np.array([True] * 4 + [tau > 0.0 for tau in acting[:2].tolist()])
    steps, likely = np.array(_STEPS), max(1.0, float(np.max(np.abs(volts))))

    def residuals(u: Floats) -> Floats:
        turned = turning(acting, whole, t, volts, u[None, 4:])
        return (measured - run_held(p, u[:4], t, volts, travel, rotors=turned, wanted=wanted)[:, :2]).ravel()

    def cost(r: Floats, u: Floats, noise: float) -> float:
        return float(r @ r) + (noise / likely) ** 2 * float(u[4:] @ u[4:])

    u = np.concatenate([start, [0.0, 0.0]])
    r = residuals(u)
    for _ in range(_MOST):
        if not np.all(np.isfinite(r)):
            break
        noise = max(LEAST_NOISE, float(np.sqrt(np.mean(r**2))))
        J = np.column_stack([residuals(u + step) - r for step in np.diag(steps)[free]])
        if not np.all(np.isfinite(J)):
            break
        weight = noise / likely * _SPEEDS
        A = np.vstack((J, np.diag(weight * steps)[:, free]))
        b = -np.concatenate((r, weight * u))
        change = np.zeros(6)
        change[free] = steps[free] * np.linalg.lstsq(A, b, rcond=1e-9)[0]
        before = cost(r, u, noise)
        for _ in range(_TRIALS):
            tried = residuals(u + change)
            if cost(tried, u + change, noise) < before:
                break
            change *= _SHORTER
        else:
            break
        u, r = u + change, tried
        if before - cost(r, u, noise) < _ENOUGH * before:
            break
    return u[:4], u[4:]
