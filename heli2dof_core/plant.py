"""The rig as numbers at an operating point: A, B, trim voltages."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from .checks import require_within
from .compiled import linear_matrices
from .couplings import require_controllable
from .eigenvalues import eigenvalues
from .frozen import Frozen, frozen
from .interop import state_space
from .kernels.update_layout import NEARLY_PARALLEL, SMALLEST
from .parameters import Parameters
from .signals import INPUTS, OUTPUTS, STATES, C, Complexes, Floats, fixed
from .tables import Shown, Table, number, poles

if TYPE_CHECKING:
    import control

STEEPEST = 1.5
"""Largest operating angle, rad: beyond it yaw's lever arm vanishes."""


@dataclass(frozen=True, repr=False)
class Plant(Frozen, Shown):
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
    def constants(self) -> Floats:
        """The rig's part of `kernels.rig`'s constants, shape (11,)."""
        return fixed(rig_constants(self.parameters))

    @cached_property
    def numbers(self) -> tuple[float, ...]:
        """Parameters and operating point in the order in which compiled functions take them."""
        return (*self.parameters.as_dict().values(), self.theta_0)

    @cached_property
    def thrust(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """B₂, the lower half of B, as plain numbers, rad/(s²·V)."""
        (a, b), (c, d) = self.B[2:].tolist()
        return (a, b), (c, d)

    @cached_property
    def independence(self) -> float:
        """That of the motors: see `Parameters`."""
        return self.parameters.independence

    @cached_property
    def nearly_parallel(self) -> bool:
        """Whether closed forms lose digits, as they divide by γ and its powers."""
        p = self.parameters
        return self.independence < NEARLY_PARALLEL or abs(p.gamma) < SMALLEST

    @cached_property
    def statics(self) -> Floats:
        """B₂⁻¹ A₂₁, 2×2, V/rad: −1 times the voltages that hold one radian on either axis without feedback."""
        return fixed(np.linalg.solve(self.B[2:], self.A[2:, :2]))

    @cached_property
    def poles(self) -> Complexes:
        """Poles of the rig without feedback, rad/s, shape (4,)."""
        return frozen(np.array(eigenvalues(self.A)))

    @cached_property
    def own_poles(self) -> tuple[complex, ...]:
        """The same as plain numbers."""
        return tuple(self.poles.tolist())

    def to_control(self) -> control.StateSpace:
        """The rig without feedback: V_p, V_y to θ, ψ, V to rad, in deviations from the trim.

        >>> import heli2dof_core as heli
        >>> heli.plant(heli.preset().parameters).to_control().input_labels
        ['V_p', 'V_y']
        """
        matrices = (self.A, self.B, C, np.zeros((2, 2)))
        return state_space("plant", matrices, STATES, INPUTS, OUTPUTS)

    def summary(self) -> str:
        """Operating point and poles."""
        return f"at θ₀ = {number(self.theta_0)} rad; poles {poles(self.poles.tolist())} rad/s"

    def tables(self) -> tuple[Table, ...]:
        """A, B and the trim voltages."""
        states, inputs = [s.symbol for s in STATES], [s.symbol for s in INPUTS]
        rates = [f"d{s}/dt" for s in states]
        trim = ((name, f"{number(v)} V") for name, v in zip(inputs, self.trim.tolist(), strict=True))
        return (
            Table.matrix("A", self.A, rates, states),
            Table.matrix("B", self.B, rates, inputs),
            Table.of("trim", ("motor", "voltage"), trim),
        )


def rig_constants(p: Any) -> list[Any]:
    """The rig's part of `kernels.rig`'s constants; `p` has Parameters' fields, as numbers or arrays."""
    ml2 = p.m * p.l**2
    return [p.K_pp, p.K_py, p.K_yp, p.K_yy, p.alpha, p.J_y, ml2, p.m * p.g * p.l, p.B_p, p.B_y, p.K_s]


@lru_cache(maxsize=256)  # every change of a design asks for the same rig
def plant(parameters: Parameters, theta_0: float = 0.0) -> Plant:
    """The rig's numbers at rest at `theta_0` (rad).

    Raises:
        InvalidInputError: `theta_0` is not a number within ±`STEEPEST`.
        UncontrollableError: the motors cannot hold the rig, as their torques are parallel.
    """
    require_controllable(parameters)
    angle = require_within(theta_0, "theta_0", "rad", -STEEPEST, STEEPEST)
    A, B, trim = linear_matrices(*parameters.as_dict().values(), angle)
    return Plant(parameters, angle, fixed(A), fixed(B), fixed(trim))
