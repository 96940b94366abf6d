"""Many rigs under one controller, one after the other; threads may share the work."""

from __future__ import annotations

from math import nan

from . import examples
from .dormand_prince import integrate
from .jit import copy_into, entry_point
from .layout import (
    GAIN,
    LIMIT,
    WORKSPACE,
)
from .rig import commanded_voltage


@entry_point(
    lambda: (
        examples.constants()[None, :GAIN].copy(),
        examples.zeros(6),
        examples.times().copy(),
        examples.constants(),
        examples.modes(),
        *examples.NUMBERS,
        examples.zeros(*WORKSPACE),
        examples.zeros(6),
        examples.constants(),
        examples.modes(),
        examples.zeros(2, 6),
        examples.zeros(1, 2, 2),
        examples.zeros(1),
    )
)
def run_cloud(rigs, start, t, c, m, rtol, atol, most_steps, w, y, own, modes, states, angles, within):
    """Responses of rigs that differ in their first eleven constants, (n, 11).

    θ and ψ at all t into `angles`, (n, 2, len(t)), NaN where a response was given up; `within`, (n,),
    becomes 1 where no motor met its limit at these times and pitch no stop. Scratch: `w`, `y` (6,),
    `own` and `modes` like c and m, `states` (len(t), 6).
    """
    copy_into(c, own)
    for i in range(len(rigs)):
        copy_into(rigs[i], own)
        copy_into(m, modes)
        copy_into(start, y)
        _, done, _, _, impacts = integrate(y, t, own, modes, rtol, atol, most_steps, w, states)
        free = impacts == 0 and done == len(t)
        for k in range(len(t)):
            if k >= done:
                angles[i, 0, k] = angles[i, 1, k] = nan
                continue
            angles[i, 0, k], angles[i, 1, k] = states[k, 0], states[k, 1]
            for motor in range(2):
                if abs(commanded_voltage(states[k], motor, own)) > own[LIMIT + motor]:
                    free = False
        within[i] = 1.0 if free else 0.0
