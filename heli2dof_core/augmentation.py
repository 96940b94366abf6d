"""The whole loop's matrices where the model has more states: rotors that lag, and an estimator of the states."""

from __future__ import annotations

import numpy as np

from .design import Design
from .estimators import Estimator
from .signals import Floats


def augmented_loop(
    design: Design, estimator: Estimator | None, P: Floats, integral: Floats | None, by_reference: Floats
) -> tuple[Floats, Floats, Floats, tuple[int, ...], Floats]:
    """∂u/∂ states, A, B, places and motors' columns of a loop with rotors that lag, or with an estimator."""
    plant, actuators, K = design.plant, design.actuators, design.K
    tau = np.zeros(2) if actuators is None else actuators.tau
    thrust = plant.B if actuators is None else plant.B * actuators.slope
    lagged = [j for j in range(2) if tau[j] > 0.0]
    z = 0 if integral is None else 2
    v, w = 4 + z, 4 + z + len(lagged)
    n = w if estimator is None else w + estimator.order
    law, A, motors = np.zeros((2, n)), np.zeros((n, n)), np.zeros((n, 2))
    # what is fed back, by state
    if estimator is None:
        law[:, :4] = -K[:, :4]
    else:
        law[:, :2] = -K[:, : len(estimator.from_angles)] @ estimator.from_angles
        law[:, w:] = -K[:, : len(estimator.from_state)] @ estimator.from_state
    if K.shape[1] == 6 and (estimator is None or len(estimator.from_state) == 4):
        law[:, v : v + 2] = -K[:, 4:]
    law[:, :2] -= P
    if integral is not None:
        law[:, 4:6] = integral
    # the rig
    A[:4, :4] = plant.A
    for j in range(2):
        if j not in lagged:
            motors[:4, j] = thrust[:, j]
    for i, j in enumerate(lagged):
        A[:4, v + i], A[v + i, v + i], motors[v + i, j] = thrust[:, j], -1.0 / tau[j], 1.0 / tau[j]
    told = motors.copy()
    B = np.zeros((n, 2))
    if integral is not None:
        A[4, 0] = A[5, 1] = -1.0
        B[4, 0] = B[5, 1] = 1.0
    if estimator is not None:
        A[w:, w:], A[w:, :2], told[w:] = estimator.F, estimator.G, estimator.H
    A += told @ law
    B += told @ by_reference
    places = (*range(4), *range(4, 4 + z), *(6 + j for j in lagged), *range(8, 8 + n - w))
    return law, A, B, places, motors
