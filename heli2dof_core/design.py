"""Parameters + poles + method → Design: K and what it does to the poles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import hypot, sqrt

import numpy as np

from .compiled import gain
from .couplings import Structure, require_structure
from .findings import Finding
from .placement.assess import eigenvector_condition
from .placement.lqr_integral import IntegralPlacement
from .placement.method import Placement, Task, Weights
from .placement.registry import method as method_named
from .plant import Plant
from .poles import PoleSet, match_poles
from .remarks import design_remarks
from .signals import C, Complexes, Floats

FULL_RANK = "full-rank"


@dataclass(frozen=True)
class Design:
    """State feedback u = −Kx + v for one rig, by one method.

    Attributes:
        plant: the rig at its operating point.
        poles: the poles asked for, rad/s.
        method: name of the placement method (`placement.registry`).
        structure: structure of the closed loop; None where the method is not full-rank's.
        K: gain, 2×4, V/rad in columns θ, ψ and V·s/rad in columns θ̇, ψ̇ (Eqs. 21, 22).
        integral: 2×2, V/(rad·s): the method's own integral action; None where it has none.
        A_closed: A − BK, 4×4.
        closed_loop_poles: eigenvalues of A − BK as computed, in the order of `poles`, rad/s.
        pole_error: largest distance between the two, rad/s; None where the method chose its own.
        findings: remarks on the poles and the gain.
    """

    plant: Plant
    poles: PoleSet
    method: str
    structure: Structure | None
    K: Floats
    integral: Floats | None
    A_closed: Floats
    closed_loop_poles: Complexes
    pole_error: float | None
    findings: tuple[Finding, ...]

    @property
    def norm(self) -> float:
        """Frobenius norm of K (mixed units, as the literature compares it)."""
        return float(np.linalg.norm(self.K))

    @property
    def spectral_norm(self) -> float:
        """Largest singular value of K (mixed units): the root of the larger eigenvalue of K Kᵀ, 2×2."""
        (a, b), (_, d) = (self.K @ self.K.T).tolist()
        return sqrt((a + d) / 2 + hypot((a - d) / 2, b))

    @cached_property
    def eigenvector_condition(self) -> float | None:
        """κ₂ of the closed loop's eigenvectors; None where there are too few (see `placement.assess`)."""
        return eigenvector_condition(self.A_closed)

    @cached_property
    def steady_state_inverse(self) -> Floats:
        """Ĝ(0)⁻¹, 2×2, V/rad: the voltages v that hold one radian on either axis.

        It equals K's first two columns minus B₂⁻¹ A₂₁ and so exists even where a closed-loop pole
        is 0 and Ĝ(0) does not; it is then singular.
        """
        return self.K[:, :2] - np.linalg.solve(self.plant.B[2:], self.plant.A[2:, :2])


def design(
    plant: Plant,
    poles: PoleSet,
    structure: Structure = Structure(),
    method: str = FULL_RANK,
    weights: Weights | None = None,
) -> Design:
    """State feedback for the rig: by the derived closed form, or by another method.

    Args:
        plant: the rig at its operating point.
        poles: the poles asked for; LQR does not look at them.
        structure: of the closed loop; full-rank placement alone looks at it.
        method: name in `placement.registry`.
        weights: of the quadratic methods.

    Raises:
        InvalidInputError: there is no such method.
        StructureUnavailableError: the rig has no such structure.
        MethodUnavailableError: the method cannot place these poles on this rig.
    """
    chosen = method_named(method)
    if method == FULL_RANK:
        placed = Placement(full_rank_gain(plant, poles, structure))
        return assess(plant, poles, placed, method, structure)
    placed = chosen.place(Task(plant.A, plant.B, poles.array, C, weights))
    return assess(plant, poles, placed, method, None, misses=not chosen.places_poles)


def full_rank_gain(plant: Plant, poles: PoleSet, structure: Structure) -> Floats:
    """K by the closed form that the derivation gives, 2×4."""
    require_structure(plant.parameters, structure)
    arguments = (*poles.coefficients, *plant.parameters.as_dict().values(), plant.theta_0)
    if structure.shift is None:
        return np.array(gain(structure)(*arguments))
    return np.array(gain(structure.family, shifted=True)(*arguments, structure.shift))


def assess(
    plant: Plant,
    poles: PoleSet,
    placed: Placement,
    method: str,
    structure: Structure | None,
    *,
    misses: bool = False,
) -> Design:
    """The design that a given K makes of the rig; `misses`: it does not aim at the poles."""
    A_closed = plant.A - plant.B @ placed.K
    found = np.linalg.eigvals(A_closed).astype(complex)
    found = found[match_poles(poles.array, found)]
    error = None if misses else float(np.max(np.abs(found - poles.array)))
    integral = placed.integral if isinstance(placed, IntegralPlacement) else None
    remarks = design_remarks(plant, poles, placed.K, found, error)
    return Design(plant, poles, method, structure, placed.K, integral, A_closed, found, error, remarks)
