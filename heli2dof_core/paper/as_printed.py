"""The paper's formulas to the letter, mistakes included, for the proofs and the recomputation."""

# pyright: reportArgumentType=false, reportCallIssue=false, reportOperatorIssue=false, reportAttributeAccessIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

from functools import cache

import numpy as np
import sympy as sp

from ..parameters import Parameters
from ..signals import Floats
from ..symbolic.names import PARAMETERS as P
from ..symbolic.names import alpha, beta_0, gamma_, p_1, p_2, p_3, p_4, psi_dot, theta

K_pp, K_py, K_yp, K_yy = (P[name] for name in ("K_pp", "K_py", "K_yp", "K_yy"))
B_p, B_y = P["B_p"], P["B_y"]
_h = P["m"] * P["l"] ** 2 * sp.sin(theta) * sp.cos(theta) * psi_dot


@cache
def coriolis() -> sp.Matrix:
    """Eq. 11 without the B_p, B_y that it carries on its diagonal."""
    return sp.Matrix([[0, _h], [-2 * _h, 0]])


@cache
def system_matrix() -> sp.Matrix:
    """Eq. 13, with B_p in A₄₄; β is β₀ at θ₀ = 0."""
    return sp.Matrix([[0, 0, 1, 0], [0, 0, 0, 1], [0, 0, -B_p / alpha, 0], [0, 0, 0, -B_p / beta_0]])


@cache
def input_matrix() -> sp.Matrix:
    """Eq. 14, each column over one inertia."""
    return sp.Matrix([[0, 0], [0, 0], [K_pp / alpha, K_py / beta_0], [K_yp / alpha, K_yy / beta_0]])


@cache
def gain(inertia: sp.Expr = alpha, damping: sp.Expr = B_p) -> sp.Matrix:
    """Eqs. 21–22, 2×4, γ as a name.

    Args:
        inertia: what stands in k₁₂, k₁₄, k₂₂, k₂₄: α as printed; β is right.
        damping: what stands over β: B_p as printed; B_y is right.
    """
    first, second = -p_1 - p_2 - B_p / alpha, -p_3 - p_4 - damping / beta_0
    cross = K_py * K_yp * alpha / (K_pp * gamma_)
    return sp.Matrix(
        [
            [
                p_1 * p_2 * alpha / K_pp - cross * p_3 * p_4,
                K_py * p_3 * p_4 * inertia / gamma_,
                first * alpha / K_pp - cross * second,
                K_py * inertia * second / gamma_,
            ],
            [
                K_yp * p_3 * p_4 * alpha / gamma_,
                -K_pp * p_3 * p_4 * inertia / gamma_,
                K_yp * alpha * second / gamma_,
                -K_pp * inertia * second / gamma_,
            ],
        ]
    )


def values(rig: Parameters) -> dict[sp.Symbol, float]:
    """The rig's numbers for the symbols of these formulas, at θ₀ = 0."""
    own = {P[name]: value for name, value in rig.as_dict().items()}
    return {**own, alpha: rig.alpha, beta_0: rig.beta, gamma_: rig.gamma}


def number(matrix: sp.Matrix, rig: Parameters, poles: tuple[float, ...] = ()) -> Floats:
    """A formula as numbers for one rig and, where it has them, poles."""
    named = dict(zip((p_1, p_2, p_3, p_4), poles, strict=False))
    return np.array(matrix.subs({**values(rig), **named}).tolist(), dtype=float)
