"""Symbols → plain numeric functions, generated once from the derivation, never typed by hand.

This is the door from `symbolic` to floats; exact placement alone reads the symbols besides. SymPy is imported on
the first call, not with this module, so that a server can answer its first page before the derivation has run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cache
from typing import Any

from .couplings import Structure
from .parameters import PARAMETER_INFO

PARAMETER_ORDER = tuple(PARAMETER_INFO)
"""Physical parameters in the order in which compiled functions take them."""

Matrix = Sequence[Sequence[float]]


@cache
def linear_matrices() -> Callable[..., tuple[Matrix, Matrix, Sequence[float]]]:
    """f(*parameters, theta_0) → A (4×4), B (4×2), trim [V_p, V_y], as nested sequences."""
    from .symbolic.linearization import linear_model
    from .symbolic.names import PARAMETERS, theta_0

    trim = [row[0] for row in _physical(linear_model().trim)]
    matrices = (_physical(linear_model().A), _physical(linear_model().B), trim)
    return _compile([*PARAMETERS.values(), theta_0], matrices)


@cache
def gain(structure: Structure, *, shifted: bool = False) -> Callable[..., tuple[Matrix, Matrix]]:
    """f(d_10, d_11, d_20, d_21, *parameters, theta_0) → K, 2×4, and Ĝ(0)⁻¹, 2×2 (see `poles.PoleSet.coefficients`).

    With `shifted` the function takes the basis' shift c as one more argument, the last. In Ĝ(0)⁻¹ what K shares
    with the rig has cancelled, which as a difference of numbers costs digits.
    """
    from .symbolic.full_rank import full_rank, plant, steady_state_inverse
    from .symbolic.names import PARAMETERS, c, d_10, d_11, d_20, d_21, theta_0

    arguments = [d_10, d_11, d_20, d_21, *PARAMETERS.values(), theta_0, *([c] if shifted else [])]
    K = full_rank(structure, shifted=shifted).K
    inverse = steady_state_inverse(K, *plant())
    return _compile(arguments, (_physical(K.to_Matrix()), _physical(inverse.to_Matrix())))


@cache
def gain_with_rotors(structure: Structure, *, shifted: bool = False) -> Callable[..., tuple[Matrix, Matrix]]:
    """f(d_10, d_11, d_12, d_20, d_21, d_22, *parameters, theta_0, tau_p, tau_y) → K, 2×6, and Ĝ(0)⁻¹, 2×2.

    With `shifted` the function takes the basis' shift c as one more argument, the last. Where thrust is no straight
    line, each motor's thrust constants are given times the curve's slope φ′ at the trim.
    """
    from .symbolic.full_rank import steady_state_inverse
    from .symbolic.names import PARAMETERS, c, tau_p, tau_y, theta_0
    from .symbolic.rotors import COEFFICIENTS, base, full_rank_with_rotors

    coefficients = [d for triple in COEFFICIENTS for d in triple]
    arguments = [*coefficients, *PARAMETERS.values(), theta_0, tau_p, tau_y, *([c] if shifted else [])]
    K = full_rank_with_rotors(structure, shifted=shifted).K
    inverse = steady_state_inverse(K, *base())
    return _compile(arguments, (_physical(K.to_Matrix()), _physical(inverse.to_Matrix())))


@cache
def observer_gain(structure: Structure, *, shifted: bool = False) -> Callable[..., Matrix]:
    """f(d_10, d_11, d_20, d_21, *parameters, theta_0) → L, 4×2, with the coefficients of the observer's polynomials.

    With `shifted` the function takes the basis' shift c as one more argument, the last.
    """
    from .symbolic.names import PARAMETERS, c, d_10, d_11, d_20, d_21, theta_0
    from .symbolic.observer import observer

    arguments = [d_10, d_11, d_20, d_21, *PARAMETERS.values(), theta_0, *([c] if shifted else [])]
    return _compile(arguments, _physical(observer(structure, shifted=shifted).L.to_Matrix()))


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
    linear_matrices()
    accelerations()
    for structure in structures:
        gain(structure)


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
