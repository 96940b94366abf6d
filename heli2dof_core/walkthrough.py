"""The derivation in numbers: every step from the rig's constants to K and the RGA, for one design."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .compiled import construction
from .design import Design
from .plant import Plant
from .signals import Floats


@dataclass(frozen=True)
class Walkthrough:
    """Numbers of full-rank placement, step by step (theory: steps 1–5).

    Attributes:
        constants: alpha, beta_0 (kg·m²), gamma_ ((N·m/V)²), a (1/s²), by name.
        coefficients: d_10, d_11, d_20, d_21 of the desired polynomials, by name.
        controllability_matrix: [B, AB, A²B, A³B], 4×8.
        T, Q: the structure's basis and the nonzero rows of TB, 4×4 and 2×2.
        A_bar, B_bar: T A T⁻¹ and T B.
        K: from the design, 2×4.
        closed_loop_bar: T (A − BK) T⁻¹, block triangular or block diagonal.
        G_0: Ĝ(0), 2×2, rad/V; None where a closed-loop pole is 0.
    """

    constants: dict[str, float]
    coefficients: dict[str, float]
    controllability_matrix: Floats
    T: Floats
    Q: Floats
    A_bar: Floats
    B_bar: Floats
    K: Floats
    closed_loop_bar: Floats
    G_0: Floats | None


def walk_through(design: Design) -> Walkthrough | None:
    """The steps of a full-rank design; None where another method made it."""
    if design.structure is None:
        return None
    plant = design.plant
    values = (*plant.parameters.as_dict().values(), plant.theta_0)
    shift = () if design.structure.shift is None else (design.structure.shift,)
    T, Q, constants = construction(design.structure.family, shifted=bool(shift))(*values, *shift)
    T, Q = np.array(T, dtype=float), np.array(Q, dtype=float)
    inverse = design.steady_state_inverse
    regular = abs(np.linalg.det(inverse)) > 1e-12 * float(np.max(np.abs(inverse))) ** 2
    return Walkthrough(
        constants=dict(zip(("alpha", "beta_0", "gamma_", "a"), map(float, constants), strict=True)),
        coefficients=dict(zip(("d_10", "d_11", "d_20", "d_21"), design.poles.coefficients, strict=True)),
        controllability_matrix=_controllability_matrix(plant),
        T=T,
        Q=Q,
        A_bar=_in_basis(plant.A, T),
        B_bar=T @ plant.B,
        K=design.K,
        closed_loop_bar=_in_basis(design.A_closed, T),
        G_0=np.asarray(np.linalg.inv(inverse), dtype=np.float64) if regular else None,
    )


def _in_basis(matrix: Floats, T: Floats) -> Floats:
    return np.asarray(np.linalg.solve(T.T, (T @ matrix).T).T, dtype=np.float64)


def _controllability_matrix(plant: Plant) -> Floats:
    blocks = [plant.B]
    for _ in range(3):
        blocks.append(plant.A @ blocks[-1])
    return np.hstack(blocks)
