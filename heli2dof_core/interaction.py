"""Relative gain array, pairing and Niederlinski index of a design, as numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .design import Design
from .findings import Finding
from .signals import INPUTS, OUTPUTS, C, Complexes, Floats

SINGULAR = 1e-12
"""Ĝ(0)⁻¹ counts as singular when its determinant is below this share of its entries' products."""


@dataclass(frozen=True)
class Interaction:
    """Interaction between the two loops at steady state.

    Attributes:
        rga: 2×2, rows are outputs θ, ψ, columns inputs V_p, V_y; None without steady state.
        pairing: (output, input) names that the RGA advises.
        niederlinski: det Ĝ(0)/Π ĝᵢᵢ(0) for diagonal pairing; None where a ĝᵢᵢ(0) is 0.
        findings: what the RGA says, in words.
    """

    rga: Floats | None
    pairing: tuple[tuple[str, str], ...]
    niederlinski: float | None
    findings: tuple[Finding, ...]


def interaction(design: Design) -> Interaction:
    """RGA = Ĝ(0) ∘ Ĝ(0)⁻ᵀ (Eq. 23; Bristol 1966), from Ĝ(0)⁻¹, which always exists.

    Two inputs and outputs pair on the side whose relative gains are nearer to 1 and positive.
    """
    inverse = design.steady_state_inverse
    (a, b), (c, d) = inverse
    determinant = a * d - b * c
    if abs(determinant) <= SINGULAR * (abs(a * d) + abs(b * c)):
        return Interaction(None, (), None, ())
    diagonal = float(a * d / determinant)  # Ĝ(0) = adj(Ĝ(0)⁻¹)/det, so λ₁₁ = ĝ₁₁ · (Ĝ⁻¹)₁₁
    rga = np.array([[diagonal, 1 - diagonal], [1 - diagonal, diagonal]])
    cross = diagonal < 0.5
    pairing = tuple((y.name, u.name) for y, u in zip(OUTPUTS, INPUTS[::-1] if cross else INPUTS, strict=True))
    niederlinski = 1 / diagonal if diagonal else None
    return Interaction(rga, pairing, niederlinski, tuple(_advice(diagonal)))


def rga_over_frequency(design: Design, frequencies: Floats) -> Complexes:
    """RGA(jω) at `frequencies` (rad/s), shape (n, 2, 2)."""
    B, identity = design.plant.B, np.eye(4)
    G = C @ np.linalg.solve(1j * frequencies[:, None, None] * identity - design.A_closed, B)
    return G * np.linalg.inv(G).transpose(0, 2, 1)


def _advice(diagonal: float) -> list[Finding]:
    if diagonal >= 0.5:
        return []
    return [
        Finding(
            "pairing_cross",
            "warning",
            f"The RGA advises against the diagonal pairing: λ₁₁ = {diagonal:.3f}, below 0.5: at steady state "
            "the cross paths outweigh the direct ones. That alone makes nothing unstable; try the cross "
            "pairing.",
        )
    ]
