"""Full-rank placement of the rig with its rotors: six poles, K 2×6, by closed form or over the rational numbers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ..compiled import PARAMETER_ORDER
from ..compiled import gain_with_rotors as closed_form
from ..couplings import Structure, require_structure
from ..errors import InvalidInputError, StructureUnavailableError, UncontrollableError
from ..plant import Plant
from ..poles import PoleSet
from ..signals import Floats
from .exact import exact_coefficients, exact_matrix, float_matrix

if TYPE_CHECKING:
    from sympy.polys.matrices import DomainMatrix

_THRUSTS = ((0, "K_pp"), (1, "K_py"), (0, "K_yp"), (1, "K_yy"))
"""By thrust constant the motor that it belongs to."""


def with_rotors(A: ArrayLike, B: ArrayLike, tau: ArrayLike) -> tuple[Floats, Floats]:
    """A⁺ = [[A, B], [0, −diag(1/τ)]], 6×6, and B⁺ = [0; diag(1/τ)], 6×2, of x⁺ = [θ, ψ, θ̇, ψ̇, v_p, v_y].

    Args:
        A: of the rig whose thrust follows the voltage at once, 4×4.
        B: the same rig's, times the thrust curves' slopes φ′ column by column, 4×2.
        tau: time constants of both rotors, s, above 0.

    Raises:
        InvalidInputError: a time constant is 0 or less.
    """
    lag = np.diag(1.0 / _require_lags(tau))
    return (
        np.block([[np.asarray(A, dtype=float), np.asarray(B, dtype=float)], [np.zeros((2, 4)), -lag]]),
        np.vstack((np.zeros((4, 2)), lag)),
    )


def gain_with_rotors(
    plant: Plant,
    poles: PoleSet,
    rotor_poles: Sequence[float],
    structure: Structure,
    tau: ArrayLike,
    *,
    slope: ArrayLike = (1.0, 1.0),
) -> tuple[Floats, Floats]:
    """K, 2×6 with its last columns on v_p and v_y (V/V), and Ĝ(0)⁻¹, 2×2: `design.full_rank_gain` with rotors.

    Args:
        plant: the rig at its operating point.
        poles: pitch's pair and yaw's, rad/s.
        rotor_poles: pitch's third pole and yaw's, real, rad/s.
        structure: of the closed loop.
        tau: time constants of both rotors, s, above 0.
        slope: φ′ of both motors' thrust curves at the trim.

    Raises:
        InvalidInputError: a time constant is 0 or less.
        UncontrollableError: a thrust curve has no slope at the trim.
        StructureUnavailableError: the rig has no such structure, or K is beyond the floats' range.
    """
    require_structure(plant.parameters, structure)
    lags, slopes = _require_lags(tau), np.asarray(slope, dtype=float)
    require_slopes(slopes)
    if not plant.nearly_parallel:
        numbers = list(plant.numbers)
        for motor, name in _THRUSTS:
            numbers[PARAMETER_ORDER.index(name)] *= float(slopes[motor])
        d = poles.coefficients
        cubics = (cubic(d[:2], float(rotor_poles[0])), cubic(d[2:], float(rotor_poles[1])))
        own = () if structure.shift is None else (structure.shift,)
        try:
            function = closed_form(structure.family, shifted=structure.shift is not None)
            K, inverse = function(*chain(*cubics), *numbers, *lags.tolist(), *own)
        except ArithmeticError:
            pass
        else:
            if isfinite(sum(chain(*K, *inverse))):
                return np.array(K), np.array(inverse)
    triples = ((*poles.values[:2], complex(rotor_poles[0])), (*poles.values[2:], complex(rotor_poles[1])))
    polynomials = [exact_coefficients(triple) for triple in triples]
    return exact_gain_with_rotors(plant.A, plant.B * slopes, lags, structure, polynomials)


def cubic(quadratic: Sequence[float], pole: float) -> tuple[float, float, float]:
    """(d₀, d₁, d₂) of (s² + d₁ s + d₀)(s − p)."""
    d_0, d_1 = quadratic
    return -pole * d_0, d_0 - pole * d_1, d_1 - pole


def exact_gain_with_rotors(
    A: Floats, B: Floats, tau: ArrayLike, structure: Structure, polynomials: Sequence[Sequence[Any]]
) -> tuple[Floats, Floats]:
    """K, 2×6, and Ĝ(0)⁻¹, 2×2, with nothing rounded but these: for motors that push nearly alike.

    Args:
        A: of the rig whose thrust follows the voltage at once, 4×4.
        B: the same rig's, times the thrust curves' slopes column by column, 4×2.
        tau: time constants of both rotors, s, above 0.
        structure: of the closed loop, with its shift.
        polynomials: d₀, d₁, d₂ of both cubics, floats or fractions as `exact_coefficients` gives them.

    Raises:
        InvalidInputError: a time constant is 0 or less.
        UncontrollableError: the columns of B are parallel.
        StructureUnavailableError: the rig has no such structure, or K is beyond the floats' range.
    """
    from ..symbolic.full_rank import member, steady_state_inverse
    from ..symbolic.rotors import with_rotors as exactly

    lags = _require_lags(tau)
    base = exact_matrix(np.asarray(A, dtype=float)), exact_matrix(np.asarray(B, dtype=float))
    _require_independent(base[1])
    rates = [1 / _fraction(t) for t in lags.tolist()]
    shift = None if structure.shift is None else _fraction(structure.shift)
    wanted = [[_fraction(d) for d in own] for own in polynomials]
    try:
        K = member(*exactly(*base, (rates[0], rates[1])), structure, wanted, shift).K
        return float_matrix(K), float_matrix(steady_state_inverse(K, *base))
    except ArithmeticError as error:
        raise StructureUnavailableError(
            "the gain of this structure is too large a number for this rig with its rotors",
            field="parameters",
            hint="Make the motors' thrusts larger or less alike, or choose another coupling.",
        ) from error


def _fraction(number: Any) -> Any:
    from sympy import QQ

    return QQ(*number.as_integer_ratio()) if isinstance(number, float) else number


def _require_lags(tau: ArrayLike) -> Floats:
    lags = np.asarray(tau, dtype=float)
    for axis, value in zip(("pitch", "yaw"), lags.tolist(), strict=True):
        if not value > 0:
            raise InvalidInputError(
                f"the {axis} motor's rotor follows at once, so it has no pole to place",
                field=f"rotors.{axis}.tau",
                value=value,
                hint="Give both rotors a time constant, or place the four poles alone.",
            )
    return lags


def require_slopes(slopes: Floats) -> None:
    """Raises UncontrollableError where a thrust curve has no slope at the trim."""
    for axis, value in zip(("pitch", "yaw"), slopes.tolist(), strict=True):
        if not value > 0:
            raise UncontrollableError(
                f"the {axis} motor's thrust does not change with its speed at the trim",
                field=f"rotors.{axis}",
                value=value,
                hint="Choose an operating point at which the motor turns, or a linear curve.",
            )


def _require_independent(B: DomainMatrix) -> None:
    if B.rank() < 2:
        raise UncontrollableError(
            "the rig is not controllable: both motors act alike, or one not at all",
            field="parameters",
            hint="Change one thrust constant so that K_pp K_yy and K_py K_yp differ.",
        )
