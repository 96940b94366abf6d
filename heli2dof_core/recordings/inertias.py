"""How simulated angles depend on the moments of inertia."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Wanted
from ..parameters import Parameters
from ..signals import Floats
from ..simulation.recorded import Turning, run_segments

_STEP = 1e-4
"""Relative, of the central differences: steps of the integration are the same on both sides, so that what is left is
of the order of its square."""


def by_inertias(
    names: Sequence[str],
    p: Any,
    starts: Floats,
    bounds: NDArray[np.int64],
    *,
    t: Floats,
    volts: Floats,
    step: float,
    rotors: Turning | None,
    wanted: Wanted,
) -> Floats:
    """Derivatives of the angles by moments of inertia, (n, 2, names), by central differences; else as `run_segments`.

    Args:
        names: "J_p", "J_y".
        p: has Parameters' fields, of any value.
        starts: of the segments, held.
        bounds: of the segments.
        t: s.
        volts: held, V.
        step: longest one of the integration, s.
        rotors: as they turn; None: as the voltages say.
        wanted: called now and then.
    """
    columns = np.zeros((len(t), 2, len(names)))
    own = {name: getattr(p, name) for name in Parameters.__dataclass_fields__}
    for i, name in enumerate(names):
        sides = []
        for sign in (1.0, -1.0):
            rig = SimpleNamespace(**{**own, name: own[name] * (1.0 + sign * _STEP)})
            rig.alpha = rig.J_p + rig.m * rig.l**2
            sides.append(
                run_segments(rig, starts, bounds, t, volts, step=step, rotors=rotors, wanted=wanted)[0]
            )
        columns[:, :, i] = (sides[0] - sides[1]) / (2.0 * _STEP * own[name])
    return columns
