"""Where the rotors' lag takes the poles of the whole loop, as it grows from nothing to what it is."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .augmentation import augmented_loop
from .eigenvalues import courses
from .frozen import Frozen
from .loop import Loop
from .rotors import USUAL_LAG, Actuators
from .signals import Complexes, Floats, fixed

STEPS = 120
HALVINGS = 14
"""Of each step in which two poles meet on the real axis: there they move infinitely fast, and mirrored."""


@dataclass(frozen=True)
class LagTrack(Frozen):
    """The poles of the whole loop over the rotors' lag.

    Attributes:
        tau: both rotors' time constants at the end, (2,), s: the rig's own, or `rotors.USUAL_LAG` where it has none.
        assumed: whether they are `rotors.USUAL_LAG`.
        share: of these, (steps,), from nearly 0 to 1, finer where poles move fast or meet on the real axis.
        poles: rad/s, (steps, n), each column the course of one pole.
    """

    tau: Floats
    assumed: bool
    share: Floats
    poles: Complexes


def lag_track(loop: Loop, steps: int = STEPS) -> LagTrack:
    """The track of each pole of the loop; gains and estimator stay as they are."""
    own, design = loop.actuators or Actuators.none(loop.design.plant), loop.design
    assumed = not own.lags
    tau = fixed(np.full(2, USUAL_LAG)) if assumed else own.tau
    outer = (loop.proportional, loop.integral, loop.voltage_from_reference)
    _, A, _, places, _ = augmented_loop(design, replace(own, tau=tau), loop.estimator, outer)
    kept = [i for i, place in enumerate(places) if place not in _apart(loop)]
    A, places = A[np.ix_(kept, kept)], [places[i] for i in kept]
    rotors = [i for i, place in enumerate(places) if place in (6, 7)]
    share = np.linspace(0.0, 1.0, steps + 1)[1:] ** 2
    poles = _poles(A, rotors, share)
    for _ in range(HALVINGS):
        real = np.count_nonzero(poles.imag == 0.0, axis=1)
        meet = np.flatnonzero(np.diff(real))
        between = 0.5 * (share[meet] + share[meet + 1])
        share = np.insert(share, meet + 1, between)
        poles = np.insert(poles, meet + 1, _poles(A, rotors, between), axis=0)
    return LagTrack(tau, assumed, share, courses(poles))


def _poles(A: Floats, rotors: list[int], share: Floats) -> Complexes:
    """Of the loop at shares of its rotors' time constants, (steps, n), rad/s."""
    stack = np.repeat(A[None], len(share), axis=0)
    stack[:, rotors] /= share[:, None, None]  # their rows are divided by τ
    return np.linalg.eigvals(stack).astype(np.complex128)


def _apart(loop: Loop) -> set[int]:
    """Places of the integrals that drive no motor."""
    return {loop.places[i] for i in range(len(loop.A)) if i not in loop.connected}
