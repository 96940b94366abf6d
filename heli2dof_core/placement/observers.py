"""L of x̂' = A x̂ + B u + L (y − C x̂): placed by duality, or a Kalman filter's."""

from __future__ import annotations

import numpy as np

from ..compiled import observer_gain as closed_form
from ..couplings import Structure
from ..errors import MethodUnavailableError
from ..plant import Plant
from ..poles import PoleSet
from ..signals import C, Floats


def observer_gain(plant: Plant, poles: PoleSet, structure: Structure) -> Floats:
    """L, 4×2, that places the poles of A − LC, by the closed form that the derivation gives."""
    return np.array(closed_form(structure.family)(*poles.coefficients, *plant.numbers))


def kalman_gain(A: Floats, B: Floats, voltage_noise: float, angle_noise: float) -> Floats:
    """L, 4×2, of the steady-state Kalman filter, by `control.lqe`.

    It depends on the ratio of the densities alone. The equation is solved in the filter's own unit of time, in which
    its terms are of one size: in seconds SciPy refuses it for ordinary rigs.

    Args:
        A: of the model, 4×4.
        B: of the model, 4×2.
        voltage_noise: density of the white noise on both voltages, V/√Hz.
        angle_noise: of that on both measured angles, rad/√Hz.

    Raises:
        MethodUnavailableError: the densities are too far apart for a solution in floats.
    """
    import control

    ratio = voltage_noise / angle_noise
    stiffness, damping = (np.linalg.norm(A[2:, columns], 2) for columns in (slice(2), slice(2, 4)))
    speed = max(np.sqrt(ratio * np.linalg.norm(B, 2)), np.sqrt(stiffness), damping)
    units = np.array([1.0, 1.0, speed, speed])
    own, driven = A * units / units[:, None] / speed, ratio * B / units[:, None] / speed
    density = driven @ driven.T
    density = (density + density.T) / 2.0  # symmetric to the last digit
    try:
        L, _, poles = control.lqe(own, np.eye(4), C, density, np.eye(2), method="scipy")
    except (ValueError, control.ControlArgument) as error:  # a LinAlgError is a ValueError
        raise _unsolved() from error
    if not (np.all(np.isfinite(L)) and np.all(np.real(poles) < 0)):
        raise _unsolved()
    return np.array(speed * units[:, None] * L, dtype=np.float64)


def _unsolved() -> MethodUnavailableError:
    return MethodUnavailableError(
        "the Kalman filter's Riccati equation was not solved: its noise densities are too far apart",
        field="observer.angle_noise",
        hint="Give densities that are closer to one another, or place the observer's poles.",
    )
