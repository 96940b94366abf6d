"""The nonlinear model from kinetic and potential energy (Eqs. 2–12).

Coordinates and rates are plain symbols, not functions of time: the time derivative in
Euler–Lagrange's equation is written out by the chain rule, which is thirty times faster in SymPy.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from .names import PARAMETERS as P
from .names import V_p, V_y, psi, psi_ddot, psi_dot, theta, theta_ddot, theta_dot


@dataclass(frozen=True)
class Mechanics:
    """The rig's energies and equations of motion, D(q) q̈ + h(q, q̇) = τ(V) − friction.

    Attributes:
        kinetic, potential: T and V in joule.
        mass_matrix: D(q), 2×2, kg·m² (Eq. 10).
        bias: Coriolis, centrifugal, gravity and stiffness torques, 2×1, N·m.
        torque: thrust torques minus viscous friction, 2×1, N·m (Eqs. 6, 7).
        accelerations: [θ̈, ψ̈] as functions of the state and the voltages, 2×1, rad/s².
    """

    kinetic: sp.Expr
    potential: sp.Expr
    mass_matrix: sp.ImmutableMatrix
    bias: sp.ImmutableMatrix
    torque: sp.ImmutableMatrix
    accelerations: sp.ImmutableMatrix


@cache
def mechanics() -> Mechanics:
    """Derives the model by Euler–Lagrange, d/dt ∂L/∂q̇ − ∂L/∂q = Q (Eq. 4).

    Erratum: the paper's Eq. 2 (in our copy) has squares and ½ misplaced, lacks a cosψ and the
    rotational energy; T below gives its Eqs. 9 to 12.
    """
    q, rates = sp.Matrix([theta, psi]), sp.Matrix([theta_dot, psi_dot])
    m, l = P["m"], P["l"]  # noqa: E741

    direction = sp.Matrix([sp.cos(psi) * sp.cos(theta), -sp.sin(psi) * sp.cos(theta), sp.sin(theta)])
    velocity = l * direction.jacobian(q) * rates
    translation = _without_squared_sines(velocity.dot(velocity))
    kinetic = m * translation / 2 + P["J_p"] * theta_dot**2 / 2 + P["J_y"] * psi_dot**2 / 2
    potential = m * P["g"] * l * direction[2] + P["K_s"] * theta**2 / 2

    momentum = sp.Matrix([kinetic]).jacobian(rates).T
    mass_matrix = momentum.jacobian(rates).expand()
    gradient = sp.Matrix([kinetic - potential]).jacobian(q).T
    bias = (momentum.jacobian(q) * rates - gradient).expand()
    thrust = sp.Matrix([[P["K_pp"], P["K_py"]], [P["K_yp"], P["K_yy"]]])
    torque = thrust * sp.Matrix([V_p, V_y]) - sp.Matrix([P["B_p"] * theta_dot, P["B_y"] * psi_dot])

    accelerations = mass_matrix.LUsolve(torque - bias)
    return Mechanics(kinetic, potential, *map(sp.ImmutableMatrix, (mass_matrix, bias, torque, accelerations)))


def _without_squared_sines(expression: sp.Expr) -> sp.Expr:
    """sin² → 1 − cos² in both angles, which is all the trigonometry that T needs."""
    for angle in (psi, theta):
        sine = sp.Symbol("sine")
        powers = sp.Poly(expression.expand().subs(sp.sin(angle), sine), sine)
        expression = powers.rem(sp.Poly(sine**2 + sp.cos(angle) ** 2 - 1, sine)).as_expr()
        expression = expression.subs(sine, sp.sin(angle))
    return expression.expand()


def residual() -> sp.Matrix:
    """D(q) q̈ + h − τ, 2×1, N·m: zero along every motion of the rig."""
    model = mechanics()
    return model.mass_matrix * sp.Matrix([theta_ddot, psi_ddot]) + model.bias - model.torque
