"""The derivation in numbers: every step from the rig's constants to K and the RGA, for one design."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .compiled import construction
from .controllability import controllability_matrix, scan
from .couplings import Structure
from .design import Design
from .errors import InvalidInputError
from .frozen import Frozen
from .signals import Floats


@dataclass(frozen=True)
class Walkthrough(Frozen):
    """Numbers of the derivation, step by step (theory: steps 1–5).

    The fields that may be None are full-rank placement's own; another method has none of these steps.

    Attributes:
        constants: alpha, beta_0 (kg·m²), gamma_ ((N·m/V)²), a (1/s²), and gravity_torque, what the
            motors hold at rest (N·m), by name.
        controllability_matrix: [B, AB, A²B, A³B], 4×8.
        controllability_indices: σ, one per input.
        coefficients: d_10, d_11, d_20, d_21 of the desired polynomials, by name.
        T, Q: the structure's basis and the nonzero rows of TB, 4×4 and 2×2.
        A_bar, B_bar: T A T⁻¹ and T B.
        K_bar: Q K T⁻¹, 2×4.
        closed_loop_bar: T (A − BK) T⁻¹, block triangular or block diagonal.
        G_0: Ĝ(0), 2×2, rad/V; None where a closed-loop pole is 0.
    """

    constants: dict[str, float]
    controllability_matrix: Floats
    controllability_indices: tuple[int, ...]
    coefficients: dict[str, float] | None = None
    T: Floats | None = None
    Q: Floats | None = None
    A_bar: Floats | None = None
    B_bar: Floats | None = None
    K_bar: Floats | None = None
    closed_loop_bar: Floats | None = None
    G_0: Floats | None = None


def walk_through(design: Design) -> Walkthrough:
    """The steps of a design: all of them for full-rank placement, else those of the plant and of K.

    Raises:
        InvalidInputError: the design places the rotors, too, which the paper's steps know nothing of.
    """
    if design.rotor_poles is not None:
        raise InvalidInputError(
            "the paper’s derivation has four states",
            field="place_rotors",
            hint="Leave it out here; rotor_steps tells of six states.",
        )
    plant, structure = design.plant, design.structure
    family = (
        Structure("axis-decoupled") if structure is None else structure.family
    )  # whose T divides by nothing
    shift = () if structure is None or structure.shift is None else (structure.shift,)
    values = (*plant.parameters.as_dict().values(), plant.theta_0)
    T, Q, constants = construction(family, shifted=bool(shift))(*values, *shift)
    steps = Walkthrough(
        constants={
            **dict(zip(("alpha", "beta_0", "gamma_", "a"), map(float, constants), strict=True)),
            "gravity_torque": float(np.dot([plant.parameters.K_pp, plant.parameters.K_py], plant.trim)),
        },
        controllability_matrix=controllability_matrix(plant.A, plant.B),
        controllability_indices=scan(plant.A, plant.B).indices,
        G_0=design.steady_state,
    )
    if structure is None:
        return steps
    T, Q = np.array(T, dtype=float), np.array(Q, dtype=float)
    return replace(
        steps,
        coefficients=dict(zip(("d_10", "d_11", "d_20", "d_21"), design.poles.coefficients, strict=True)),
        T=T,
        Q=Q,
        A_bar=_in_basis(plant.A, T),
        B_bar=T @ plant.B,
        K_bar=np.asarray(np.linalg.solve(T.T, (Q @ design.K).T).T, dtype=np.float64),
        closed_loop_bar=_in_basis(design.A_closed, T),
    )


def _in_basis(matrix: Floats, T: Floats) -> Floats:
    return np.asarray(np.linalg.solve(T.T, (T @ matrix).T).T, dtype=np.float64)
