"""The derivation as plain numeric functions, never typed by hand.

What every design needs, the linear model and K, is generated beforehand (`kernels/derived.py`), so that a server
answers without SymPy. All else is made of the symbols on the first call, and SymPy is imported then: this is the door
from `symbolic` to floats; exact placement alone reads the symbols besides.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from .couplings import STRUCTURES, Structure
from .errors import InvalidInputError
from .parameters import PARAMETER_INFO
from .signals import Floats

PARAMETER_ORDER = tuple(PARAMETER_INFO)
"""Physical parameters in the order in which compiled functions take them."""

Matrix = Sequence[Sequence[float]]
Numbers = Sequence[float]
_FOUR = import_module(f"{__package__}.interpreted.derived")
_SIX = import_module(f"{__package__}.interpreted.derived_rotors")


def linear_matrices(*numbers: Any) -> tuple[Floats, Floats, Floats]:
    """A (4×4), B (4×2), trim [V_p, V_y] of the parameters and theta_0, the last.

    Parameters may be arrays of one shape, which A, B and the trim then have as their last axes.
    """
    *p, theta_0 = numbers
    shape = np.shape(p[0])
    A, B, trim = np.empty((4, 4, *shape)), np.empty((4, 2, *shape)), np.empty((2, *shape))
    _FOUR.rig_model(p, theta_0, A, B, trim)
    return A, B, trim


@cache
def gain(structure: Structure, *, shifted: bool = False) -> Callable[..., tuple[Floats, Floats]]:
    """f(d_10, d_11, d_20, d_21, *parameters, theta_0) → K, 2×4, and Ĝ(0)⁻¹, 2×2 (see `poles.PoleSet.coefficients`).

    With `shifted` the function takes the basis' shift c as one more argument, the last. In Ĝ(0)⁻¹ what K shares
    with the rig has cancelled, which as a difference of numbers costs digits.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    family = _family(structure, shifted)

    def function(*numbers: float) -> tuple[Floats, Floats]:
        d, p, theta_0, _, c = _parted(numbers, 4, 0)
        K, inverse = np.empty((2, 4)), np.empty((2, 2))
        _FOUR.full_rank_gain(family, shifted, d, p, theta_0, c, K, inverse)
        return K, inverse

    return function


@cache
def gain_with_rotors(structure: Structure, *, shifted: bool = False) -> Callable[..., tuple[Floats, Floats]]:
    """f(d_10, d_11, d_12, d_20, d_21, d_22, *parameters, theta_0, tau_p, tau_y) → K, 2×6, and Ĝ(0)⁻¹, 2×2.

    With `shifted` the function takes the basis' shift c as one more argument, the last. Where thrust is no straight
    line, each motor's thrust constants are given times the curve's slope φ′ at the trim.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    family = _family(structure, shifted)

    def function(*numbers: float) -> tuple[Floats, Floats]:
        d, p, theta_0, tau, c = _parted(numbers, 6, 2)
        K, inverse = np.empty((2, 6)), np.empty((2, 2))
        _SIX.full_rank_gain_with_rotors(family, shifted, d, p, theta_0, tau, c, K, inverse)
        return K, inverse

    return function


def _parted(numbers: Numbers, coefficients: int, lags: int) -> tuple[Numbers, Numbers, float, Numbers, float]:
    """d, p, theta_0, tau and c, which is 0 where it is not given."""
    angle = coefficients + len(PARAMETER_ORDER)
    end = angle + 1 + lags
    c = numbers[end] if len(numbers) > end else 0.0
    return numbers[:coefficients], numbers[coefficients:angle], numbers[angle], numbers[angle + 1 : end], c


def _observer_gain(*numbers: float) -> Floats:
    d, p, theta_0, _, _ = _parted(numbers, 4, 0)
    L = np.empty((4, 2))
    _FOUR.full_rank_observer(d, p, theta_0, L)
    return L


def _family(structure: Structure, shifted: bool) -> int:
    if shifted and structure.coupling == "axis-decoupled":
        raise InvalidInputError("the axis-decoupled structure has no shift", field="shifted")
    return STRUCTURES.index(structure.family)


@cache
def observer_gain(structure: Structure, *, shifted: bool = False) -> Callable[..., Matrix | Floats]:
    """f(d_10, d_11, d_20, d_21, *parameters, theta_0) → L, 4×2, with the coefficients of the observer's polynomials.

    With `shifted` the function takes the basis' shift c as one more argument, the last; without, all structures have
    the same.
    """
    if not shifted:
        return _observer_gain
    from .symbolic.names import PARAMETERS, c, d_10, d_11, d_20, d_21, theta_0
    from .symbolic.observer import observer

    arguments = [d_10, d_11, d_20, d_21, *PARAMETERS.values(), theta_0, c]
    return _compile(arguments, _physical(observer(structure, shifted=True).L.to_Matrix()))


@cache
def names_with_rotors(
    structure: Structure, *, shifted: bool = False
) -> tuple[tuple[str, ...], Callable[..., Sequence[float]]]:
    """Names of the six-state K's letters and groups, and f(…, phi_p, phi_y) → what they are worth.

    The arguments before are those of `gain_with_rotors`, but thrust constants as they are, and the slopes by
    themselves; with `shifted` the shift c comes last.
    """
    import sympy as sp

    from .symbolic.linearization import linear_model
    from .symbolic.names import PARAMETERS, c, cos_0, phi_p, phi_y, sin_0, tau_p, tau_y, theta_0
    from .symbolic.reading import read_gain
    from .symbolic.rotors import COEFFICIENTS

    given = [d for triple in COEFFICIENTS for d in triple]
    own = {
        name: x for name, x in read_gain(structure, shifted=shifted).definitions.items() if name not in given
    }
    chain = [
        (sin_0, sp.sin(theta_0)),
        (cos_0, sp.cos(theta_0)),
        *linear_model().definitions.items(),
        *own.items(),
    ]
    arguments = [*given, *PARAMETERS.values(), theta_0, tau_p, tau_y, phi_p, phi_y, *([c] if shifted else [])]

    def by_turns(
        shown: Any,
    ) -> Any:  # each from those before it, as lambdify takes what subexpressions were found
        return chain, shown

    turns: Any = by_turns
    return tuple(map(str, own)), sp.lambdify(arguments, [*own], modules="math", cse=turns)


@cache
def construction(structure: Structure, *, shifted: bool = False) -> Callable[..., tuple[Matrix, Matrix, Any]]:
    """f(*parameters, theta_0[, c]) → T (4×4), Q (2×2), (α, β₀, γ, a), of the structure's basis."""
    from .symbolic.full_rank import full_rank
    from .symbolic.linearization import linear_model
    from .symbolic.names import PARAMETERS, c, theta_0

    form, short = full_rank(structure, shifted=shifted).form, linear_model().short_names
    matrices = (_physical(form.T.to_Matrix()), _physical(form.Q.to_Matrix()), _physical(short)[0])
    return _compile([*PARAMETERS.values(), theta_0, *([c] if shifted else [])], matrices)


@cache
def accelerations() -> Callable[..., tuple[float, float]]:
    """f(theta, theta_dot, psi_dot, V_p, V_y, *parameters) → (θ̈, ψ̈) in rad/s² (Eqs. 9–12).

    ψ is cyclic: the accelerations do not depend on it, which the derivation shows.
    """
    from .symbolic import names
    from .symbolic.mechanics import mechanics

    arguments = [names.theta, names.theta_dot, names.psi_dot, names.V_p, names.V_y]
    return _compile([*arguments, *names.PARAMETERS.values()], list(mechanics().accelerations.flat()))


def warm_up(structures: Iterable[Structure] = (Structure(),)) -> None:
    """Runs the derivation for these structures, the paper's if none is named, so that no later call waits for it."""
    from .symbolic.full_rank import full_rank

    accelerations()
    for structure in structures:
        full_rank(structure)


def _physical(matrix: Any) -> list[list[Any]]:
    """A symbolic matrix with α, β₀ and a written out, as nested lists."""
    import sympy as sp

    from .symbolic.linearization import linear_model
    from .symbolic.names import cos_0, sin_0, theta_0

    angles = {sin_0: sp.sin(theta_0), cos_0: sp.cos(theta_0)}
    return matrix.subs(linear_model().definitions).subs(angles).tolist()


def _compile(arguments: Sequence[Any], expression: Any) -> Callable[..., Any]:
    import sympy as sp

    return sp.lambdify(arguments, expression, modules="math", cse=True)
