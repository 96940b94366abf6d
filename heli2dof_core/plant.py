"""The rig as numbers at an operating point: A, B, trim voltages."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from .checks import require_within
from .compiled import linear_matrices
from .couplings import require_controllable
from .parameters import Parameters
from .signals import Complexes, Floats

STEEPEST = 1.5
"""Largest operating angle, rad: beyond it yaw's lever arm vanishes."""


@dataclass(frozen=True)
class Plant:
    """Linear model about rest at pitch angle `theta_0` (Eqs. 13, 14), in deviations from the trim.

    Attributes:
        parameters: the rig.
        theta_0: operating point, rad.
        A, B: 4×4 and 4×2, x = [θ, ψ, θ̇, ψ̇], u = [V_p, V_y].
        trim: voltages that hold the rig at `theta_0`, shape (2,), V.
    """

    parameters: Parameters
    theta_0: float
    A: Floats
    B: Floats
    trim: Floats

    @cached_property
    def poles(self) -> Complexes:
        """Poles of the rig without feedback, rad/s, shape (4,)."""
        return np.linalg.eigvals(self.A).astype(np.complex128)


@lru_cache(maxsize=256)  # every change of a design asks for the same rig
def plant(parameters: Parameters, theta_0: float = 0.0) -> Plant:
    """The rig's numbers at rest at `theta_0` (rad).

    Raises:
        InvalidInputError: `theta_0` is not a number within ±`STEEPEST`.
        UncontrollableError: the motors cannot hold the rig, as their torques are parallel.
    """
    require_controllable(parameters)
    angle = require_within(theta_0, "operating_point.theta", "rad", -STEEPEST, STEEPEST)
    A, B, trim = linear_matrices()(*parameters.as_dict().values(), angle)
    arrays = [np.array(values, dtype=float) for values in (A, B, trim)]
    for array in arrays:
        array.flags.writeable = False
    return Plant(parameters, angle, *arrays)
