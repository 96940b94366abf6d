"""The linear model about rest at the pitch angle θ₀ (Eqs. 13–15), derived from `mechanics`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from .mechanics import mechanics
from .names import PARAMETERS as P
from .names import V_p, V_y, a, alpha, beta_0, cos_0, gamma_, psi, psi_dot, sin_0, theta, theta_0, theta_dot


@dataclass(frozen=True)
class LinearModel:
    """ẋ = Ax + Bu in deviations from the trim, x = [θ, ψ, θ̇, ψ̇], u = [V_p, V_y].

    Attributes:
        A, B: 4×4 and 4×2 in the short names α, β₀, a and the physical parameters.
        definitions: what the short names stand for, in physical parameters, sin_0 and cos_0.
        trim: voltages [V_p, V_y] that hold the rig at θ₀, 2×1, V.
    """

    A: sp.ImmutableMatrix
    B: sp.ImmutableMatrix
    definitions: dict[sp.Symbol, sp.Expr]
    trim: sp.ImmutableMatrix

    @property
    def short_names(self) -> sp.Matrix:
        """[α, β₀, γ, a], 1×4."""
        return sp.Matrix([[alpha, beta_0, gamma_, a]])


@cache
def linear_model() -> LinearModel:
    """Jacobians of [θ̇, ψ̇, θ̈, ψ̈] at rest, and the trim voltages.

    Errata: Eq. 13 prints A₄₄ = −B_p/β for −B_y/β, and Eq. 14 divides B's columns, not its rows,
    by α and β.
    """
    accelerations = mechanics().accelerations
    state = sp.Matrix([theta, psi, theta_dot, psi_dot])
    rates = sp.Matrix([theta_dot, psi_dot, *accelerations])
    at_rest = {psi: 0, theta_dot: 0, psi_dot: 0}

    holding = accelerations.subs(at_rest)
    voltages = sp.solve(list(holding), [V_p, V_y], dict=True)[0]

    definitions = {
        alpha: P["J_p"] + P["m"] * P["l"] ** 2,
        beta_0: P["J_y"] + P["m"] * P["l"] ** 2 * cos_0**2,
        gamma_: P["K_py"] * P["K_yp"] - P["K_pp"] * P["K_yy"],
    }
    point = {sp.sin(theta): sin_0, sp.cos(theta): cos_0, theta: theta_0}
    inertias = {definitions[alpha]: alpha, definitions[beta_0]: beta_0}

    def at_trim(matrix: sp.Matrix) -> sp.Matrix:
        values = matrix.subs(at_rest).subs(voltages).subs(point).subs(inertias)
        return values.applyfunc(sp.cancel)

    A = at_trim(rates.jacobian(state))
    B = at_trim(rates.jacobian([V_p, V_y]))
    definitions[a] = A[2, 0]
    A[2, 0] = a
    trim = sp.Matrix([voltages[V_p], voltages[V_y]]).subs(point).applyfunc(sp.factor)
    return LinearModel(sp.ImmutableMatrix(A), sp.ImmutableMatrix(B), definitions, sp.ImmutableMatrix(trim))
