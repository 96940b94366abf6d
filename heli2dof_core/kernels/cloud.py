"""Many rigs under one controller, one after the other; threads may share the work."""

from __future__ import annotations

from math import nan

from . import examples
from .dormand_prince import integrate
from .jit import copy_into, entry_point
from .layout import GAIN, LIMIT, PLAIN, SIZES, TAU, WORKSPACE
from .rig import commanded_voltage


@entry_point(
    lambda size: (
        size,
        examples.constants()[None, : GAIN + 2].copy(),
        examples.zeros(len(size)),
        examples.times().copy(),
        examples.constants(size),
        examples.modes(size),
        *examples.NUMBERS,
        examples.zeros(*WORKSPACE),
        examples.zeros(len(size)),
        examples.constants(size),
        examples.modes(size),
        examples.zeros(2, len(size)),
        examples.zeros(1, 2, 2),
        examples.zeros(1),
    ),
    *SIZES,
)
def run_cloud(size, rigs, start, t, c, m, rtol, atol, most_steps, w, y, own, modes, states, angles, within):
    """Responses of rigs that differ in their first eleven constants, (n, 11), or in these and both τ, (n, 13).

    The latter where the size is not PLAIN. θ and ψ at all t into `angles`, (n, 2, len(t)), NaN where a response was
    given up; `within`, (n,), becomes 1 where no motor met its limit at these times and pitch no stop. Scratch: `w`,
    `y` like `start`, `own` and `modes` like c and m, `states` (len(t), len(size)).
    """
    copy_into(c, own)
    for i in range(len(rigs)):
        for j in range(GAIN):
            own[j] = rigs[i, j]
        if len(size) > PLAIN:
            own[TAU], own[TAU + 1] = rigs[i, GAIN], rigs[i, GAIN + 1]
        copy_into(m, modes)
        copy_into(start, y)
        _, done, _, _, impacts = integrate(size, y, t, own, modes, rtol, atol, most_steps, w, states)
        free = impacts == 0 and done == len(t)
        for k in range(len(t)):
            if k >= done:
                angles[i, 0, k] = angles[i, 1, k] = nan
                continue
            angles[i, 0, k], angles[i, 1, k] = states[k, 0], states[k, 1]
            for motor in range(2):
                if abs(commanded_voltage(size, states[k], motor, own)) > own[LIMIT + motor]:
                    free = False
        within[i] = 1.0 if free else 0.0
