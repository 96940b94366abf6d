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


def observer_gain(structure: Structure):
    raise NotImplementedError
