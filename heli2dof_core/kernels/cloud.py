"""Many rigs under one controller, one after the other; threads may share the work."""

from __future__ import annotations

import numpy as np

from .dormand_prince import integrate
from .jit import kernel
from .rig import LIMIT, asked


@kernel
def run(rigs, start, t, c, m, rtol, atol, most_steps, angles, within):
    """Responses of rigs that differ in their first eleven constants, (n, 11).

    θ and ψ at all t into `angles`, (n, 2, len(t)), NaN where a response was given up; `within`, (n,),
    becomes 1 where no motor met its limit at these times and pitch no stop.
    """
    own, modes = c.copy(), m.copy()
    states, y = np.empty((len(t), 6)), np.empty(6)
    for i in range(len(rigs)):
        own[: rigs.shape[1]] = rigs[i]
        modes[:] = m
        y[:] = start
        _, done, _, _, impacts = integrate(y, t, own, modes, rtol, atol, most_steps, states)
        free = impacts == 0 and done == len(t)
        for k in range(len(t)):
            if k >= done:
                angles[i, 0, k] = angles[i, 1, k] = np.nan
                continue
            angles[i, 0, k], angles[i, 1, k] = states[k, 0], states[k, 1]
            for motor in range(2):
                if abs(asked(states[k], motor, own)) > own[LIMIT + motor]:
                    free = False
        within[i] = 1.0 if free else 0.0
