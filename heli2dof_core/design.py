"""Parameters + poles + structure → Design: K and what it does to the poles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .compiled import gain
from .couplings import Structure, require_structure
from .findings import Finding
from .plant import Plant
from .poles import PoleSet, match_poles
from .signals import Complexes, Floats


@dataclass(frozen=True)
class Design:
    """Full-rank state feedback u = −Kx + v for one rig and one set of poles.

    Attributes:
        plant: the rig at its operating point.
        poles: the poles asked for, rad/s.
        structure: structure of the closed loop.
        K: gain, 2×4, V/rad in columns θ, ψ and V·s/rad in columns θ̇, ψ̇ (Eqs. 21, 22).
        A_closed: A − BK, 4×4.
        closed_loop_poles: eigenvalues of A − BK as computed, in the order of `poles`, rad/s.
        pole_error: largest distance between the two, rad/s.
        findings: remarks on the poles.
    """

    plant: Plant
    poles: PoleSet
    structure: Structure
    K: Floats
    A_closed: Floats
    closed_loop_poles: Complexes
    pole_error: float
    findings: tuple[Finding, ...]

    @property
    def norm(self) -> float:
        """Frobenius norm of K (mixed units, as the literature compares it)."""
        return float(np.linalg.norm(self.K))

    @property
    def steady_state_inverse(self) -> Floats:
        """Ĝ(0)⁻¹, 2×2, V/rad: the voltages v that hold one radian on either axis.

        It equals K's first two columns minus B₂⁻¹ A₂₁ and so exists even where a closed-loop pole
        is 0 and Ĝ(0) does not; it is then singular.
        """
        return self.K[:, :2] - np.linalg.solve(self.plant.B[2:], self.plant.A[2:, :2])


def design(plant: Plant, poles: PoleSet, structure: Structure = Structure()) -> Design:
    """Places the four poles by full-rank state feedback, by the derived closed form.

    Raises:
        StructureUnavailableError: the rig has no such structure.
    """
    parameters = plant.parameters
    require_structure(parameters, structure)
    K = np.array(gain(structure)(*poles.coefficients, *parameters.as_dict().values(), plant.theta_0))
    A_closed = plant.A - plant.B @ K
    found = np.linalg.eigvals(A_closed).astype(complex)
    found = found[match_poles(poles.array, found)]
    error = float(np.max(np.abs(found - poles.array)))
    return Design(plant, poles, structure, K, A_closed, found, error, tuple(_remarks(poles, error)))


def _remarks(poles: PoleSet, error: float) -> Iterator[Finding]:
    """Placed poles that are legal but unwise."""
    largest = float(np.max(np.abs(poles.array)))
    if any(p.real > 0 for p in poles.values):
        yield Finding(
            "right_half_plane",
            "error",
            "A pole lies in the right half plane: without an outer loop the helicopter runs away. "
            "Drag it left of the imaginary axis.",
        )
    elif any(p.real == 0 for p in poles.values):
        yield Finding(
            "imaginary_axis",
            "warning",
            "A pole lies on the imaginary axis: its motion neither grows nor dies out.",
        )
    if any(p == 0 for p in poles.values):
        yield Finding(
            "no_steady_state",
            "warning",
            "A pole lies at 0, so the inner loop has no steady state, and Ĝ(0) and the RGA do not exist.",
        )
    if error > 1e-6 * max(largest, 1.0):
        yield Finding(
            "pole_error",
            "warning",
            f"The computed poles miss the wanted ones by up to {error:.2g} rad/s: poles that coincide, "
            "or lie far out, are sensitive to rounding.",
        )
