"""K of the rig by full-rank placement: derived closed forms, and the exact construction where they lose digits."""

from __future__ import annotations

from itertools import chain
from math import isfinite

import numpy as np

from .compiled import gain
from .couplings import Structure, require_structure
from .errors import InvalidInputError, StructureUnavailableError, UncontrollableError
from .placement.exact import exact_coefficients, exact_matrix, float_matrix
from .plant import Plant
from .poles import PoleSet
from .rotors import Actuators
from .signals import AXES, Floats


def with_rotors(plant: Plant, actuators: Actuators) -> tuple[Floats, Floats]:
    """A⁺, 6×6, and B⁺, 6×2, of x⁺ = [θ, ψ, θ̇, ψ̇, v_p, v_y], deviations: τ_j v̇_j = V_j − v_j, torques by φ′ v.

    Raises:
        InvalidInputError: a rotor does not lag, so that there is nothing to place.
        UncontrollableError: a thrust curve has no slope at the trim.
    """
    for i, axis in enumerate(AXES):
        if not actuators.tau[i]:
            raise InvalidInputError(
                f"the {axis} motor's rotor follows at once, so it has no pole to be placed",
                field=f"rotors.{axis}.tau",
                value=0.0,
                hint="Give both rotors a time constant, or leave the rotors out of the placement.",
            )
        if not actuators.slope[i]:
            raise UncontrollableError(
                f"the {axis} motor rests at the trim, where its quadratic thrust has no slope",
                field=f"rotors.{axis}.curve",
                value="quadratic",
                hint="Make its thrust linear, or choose an operating point at which it turns.",
            )
    A, B = np.zeros((6, 6)), np.zeros((6, 2))
    A[:4, :4], A[:4, 4:] = plant.A, plant.B * actuators.slope
    A[4:, 4:], B[4:] = -np.diag(1.0 / actuators.tau), np.diag(1.0 / actuators.tau)
    return A, B


def full_rank_gain(plant: Plant, poles: PoleSet, structure: Structure) -> tuple[Floats, Floats]:
    """K, 2×4, and Ĝ(0)⁻¹, 2×2, by the closed forms that the derivation gives.

    They divide by γ, shifted by γ², so that as many digits are lost as γ's terms cancel, or twice as many. Where the
    motors push nearly alike the same construction runs over the rational numbers, which loses none, and so it does
    where a product leaves the floats' range.

    Raises:
        StructureUnavailableError: the rig has no such structure, or K is beyond the floats' range.
    """
    require_structure(plant.parameters, structure)
    if plant.nearly_parallel:
        return _exact_gain(plant, poles, structure)
    arguments = (*poles.coefficients, *plant.numbers)
    try:
        if structure.shift is None:
            K, inverse = gain(structure)(*arguments)
        else:
            K, inverse = gain(structure.family, shifted=True)(*arguments, structure.shift)
    except ArithmeticError:
        return _exact_gain(plant, poles, structure)
    if not isfinite(sum(chain(*K, *inverse))):
        return _exact_gain(plant, poles, structure)
    return np.array(K), np.array(inverse)


def full_rank_gain_with_rotors(
    plant: Plant,
    actuators: Actuators,
    poles: PoleSet,
    rotor_poles: tuple[float, float],
    structure: Structure,
) -> tuple[Floats, Floats]:
    """The same of six states: K, 2×6, and Ĝ(0)⁻¹; thrust constants are those at the trim, K φ′."""
    require_structure(plant.parameters, structure)
    raise NotImplementedError


def _exact_gain(plant: Plant, poles: PoleSet, structure: Structure) -> tuple[Floats, Floats]:
    from sympy import QQ

    from .symbolic.full_rank import member, steady_state_inverse

    shift = None if structure.shift is None else QQ(*float(structure.shift).as_integer_ratio())
    polynomials = [exact_coefficients(pair) for pair in (poles.values[:2], poles.values[2:])]
    A, B = exact_matrix(plant.A), exact_matrix(plant.B)
    try:
        placed = member(A, B, structure, polynomials, shift)
        return float_matrix(placed.K), float_matrix(steady_state_inverse(placed.K, A, B))
    except ArithmeticError as error:
        raise StructureUnavailableError(
            "the gain of this structure is too large a number for this rig",
            field="parameters",
            hint="Make the motors' thrusts larger or less alike, or choose another coupling.",
        ) from error
