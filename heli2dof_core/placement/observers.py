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

    Args:
        A: of the model, 4×4.
        B: of the model, 4×2.
        voltage_noise: density of the white noise on both voltages, V/√Hz.
        angle_noise: of that on both measured angles, rad/√Hz.

    Raises:
        MethodUnavailableError: the densities are too far apart for a solution in floats.
    """
    import control

    eye = np.eye(2)
    try:
        L, _, poles = control.lqe(A, B, C, voltage_noise**2 * eye, angle_noise**2 * eye, method="scipy")
    except (ValueError, control.ControlArgument) as error:  # a LinAlgError is a ValueError
        raise _unsolved() from error
    if not (np.all(np.isfinite(L)) and np.all(np.real(poles) < 0)):
        raise _unsolved()
    return np.array(L, dtype=np.float64)


def _unsolved() -> MethodUnavailableError:
    return MethodUnavailableError(
        "the Kalman filter's Riccati equation was not solved: its noise densities are too far apart",
        field="observer.angle_noise",
        hint="Give densities that are closer to one another, or place the observer's poles.",
    )
