"""The loop under a digital controller, from one sample to the next: linear, as the controller's own lines have it.

The voltages are held between samples, the integrals are sums, rates come from filters or are exact, an estimator goes
on by exact steps, and a late controller's voltages act one sample later (`kernels.digital`). Encoders and limits are
left out.
"""

from __future__ import annotations

import numpy as np

from ..kernels.layout import FILTER_FREQUENCY
from ..loop import Loop
from ..scenario import Digital
from ..signals import Floats
from ..simulation.augmented import sampled_estimator
from ..simulation.digital import rate_filter

_ESTIMATED = 8
"""First place of an estimator's states (`kernels.layout`)."""


def sampled_loop(loop: Loop, open_loop: Floats, digital: Digital) -> Floats:
    """Φ of x(k + 1) = Φ x(k), in deviations from rest.

    Args:
        loop: with the continuous law.
        open_loop: A of the same states where the motors have no voltage, n×n.
        digital: how the law is run.

    Returns:
        m×m: the loop's own states, then four of the rate filters where the law reads these, and two voltages on their
        way where the controller is late.
    """
    places, law = list(loop.places), loop.voltage_from_state
    rig = [i for i, place in enumerate(places) if place < 4 or place in (6, 7)]
    inner = [i for i, place in enumerate(places) if place >= _ESTIMATED]
    integrals = [i for i, place in enumerate(places) if place in (4, 5)]
    n, period = len(places), digital.sample_time
    filtered = digital.rates == "filtered" and bool(law[:, 2:4].any())
    m = n + (4 if filtered else 0) + (2 if digital.delay else 0)
    now = np.eye(m)  # each column a state; what follows is what the controller does with it
    measured = now[:4].copy()
    following = np.zeros((m, m))
    if filtered:
        F, b = rate_filter(period)
        rate = FILTER_FREQUENCY**2
        for axis in range(2):
            own = now[n + 2 * axis : n + 2 * axis + 2]
            measured[2 + axis] = rate * own[1]
            following[n + 2 * axis : n + 2 * axis + 2] = F @ own + np.outer(b, measured[axis])
    rest = [i for i in range(n) if i >= 4]
    asked = law[:, :4] @ measured + law[:, rest] @ now[rest]
    for i in integrals:
        following[i] = now[i] - period * measured[places[i] - 4]
    held = now[m - 2 :] if digital.delay else asked
    if digital.delay:
        following[m - 2 :] = asked
    step = _held(open_loop[np.ix_(rig, rig)], loop.motors[rig], period)
    following[rig] = step[:, : len(rig)] @ now[rig] + step[:, len(rig) :] @ held
    if inner:
        k, rows = len(inner), sampled_estimator(loop, period)
        following[inner] = rows[:k, :k] @ now[inner] + rows[:k, 6:8] @ measured[:2] + rows[:k, 8:10] @ held
    return following


def _held(A: Floats, B: Floats, period: float) -> Floats:
    """[Φ Γ] of ẋ = Ax + Bu under a voltage that is held."""
    from scipy.linalg import expm

    n, p = B.shape
    whole = np.zeros((n + p, n + p))
    whole[:n] = np.hstack((A, B))
    return np.asarray(expm(whole * period), dtype=np.float64)[:n]
