"""The digital rig with rotors, friction or an estimator under references that change from sample to sample.

What the controller does at a sample are the kernels' own lines, which Python reads here; between two samples the rig
runs in the compiled integrator.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from ..engine import engine
from ..errors import Wanted
from ..kernels.layout import DELAY, OFFSET, PLAIN, WANTED, WORKSPACE
from ..loop import Loop
from ..signals import Floats
from .augmented import sampled_estimator
from .nonlinear import ABSOLUTE_TOLERANCE, NonlinearLoop

_LOOK = 500
"""Samples between two looks whether somebody still waits."""
_MEASURED = 10
"""Room for the angles and rates at a sample, and for what an estimator makes of them."""


def run_sampled(
    loop: Loop,
    system: NonlinearLoop,
    y: Floats,
    *,
    settings: Floats,
    noise: Floats,
    references: Floats,
    offsets: Floats,
    rtol: float,
    wanted: Wanted,
) -> tuple[int, Floats, Floats, Floats]:
    """Samples that were simulated; what was measured (n, 2), the states (n, size) and the voltages (n, 2) at each.

    As `kernels.recorded.run_recorder`, of a loop of any size; `system.constants` hold the rig, `y` is its start.
    """
    n, size, period = len(references), loop.size, float(settings[0])
    twin: Any = import_module("heli2dof_core.interpreted.digital")
    kernels = engine()
    plant, free = np.empty_like(system.constants), np.empty_like(system.modes)
    twin.rig_without_feedback(size, system.constants, system.modes, plant, free)
    c, m, d = system.constants.tolist(), system.modes.tolist(), settings.tolist()
    estimator = sampled_estimator(loop, period)
    filters, seen, held, waiting, asked = np.zeros((2, 2)), [0.0] * _MEASURED, [0.0] * 2, [0.0] * 2, [0.0] * 2
    wish, shift, told = references.tolist(), offsets.tolist(), noise.tolist()
    numbers = (rtol, ABSOLUTE_TOLERANCE * rtol, kernels.most_steps)
    w, course = np.zeros(WORKSPACE), np.empty((2, len(size)))
    measured, states, voltages = (
        np.full((n, 2), np.nan),
        np.full((n, len(size)), np.nan),
        np.full((n, 2), np.nan),
    )
    twin.initialize_controller(y, c, d, filters, held)
    for k in range(n):
        if k % _LOOK == 0:
            wanted()
        c[WANTED : WANTED + 2], c[OFFSET : OFFSET + 2] = wish[k], shift[k]
        states[k], own = y, y.tolist()
        twin.sample_sensors(own, d, filters, told[k], seen)
        twin.sample_controller(size, own, c, m, d, seen, asked, waiting)
        if d[DELAY] == 0.0:
            held[:] = waiting
        measured[k], voltages[k], plant[OFFSET : OFFSET + 2] = seen[:2], held, held
        twin.held_speeds(size, plant, states[k])
        outcome = kernels.integrate(
            size, y, np.array([k * period, (k + 1) * period]), plant, free, *numbers, w, course
        )[0]
        y[4:PLAIN] = own[4:PLAIN]
        if outcome != 0:
            return k + 1, measured, states, voltages
        own[:] = y.tolist()
        twin.sample_estimator(size, own, estimator, seen, held)
        y[PLAIN + 2 :] = own[PLAIN + 2 :]
        held[:] = waiting
    return n, measured, states, voltages
