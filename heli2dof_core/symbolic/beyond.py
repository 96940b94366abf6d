"""What follows where the paper's model ends: rotors' equations, six states and their K, the observer and its L."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from ..couplings import Sought, Structure
from ..tables import Shown
from .linearization import linear_model
from .names import (
    CUBIC_NAMES,
    MATRIX_NAMES,
    NAMES,
    OBSERVER_NAMES,
    ROTOR_NAMES,
    ROTOR_SIGNALS,
    Name,
    gain_names,
    latex,
    observer_gain_names,
    phi_p,
    phi_y,
    tau_p,
    tau_y,
)
from .observer import indices as observability_indices
from .reading import Reading, read_gain, read_observer
from .rotors import indices as indices_with_rotors

_TAU = (("p", tau_p), ("y", tau_y))


@dataclass(frozen=True, repr=False)
class GainFormulas(Shown):
    """A gain beyond the paper's model, with its model and what its names stand for; SymPy's, immutable.

    Attributes:
        structure: of the closed loop, or of the estimate's errors.
        sought: K, 2×6 of the rig with rotors, or L, 4×2 of the observer.
        equations: of the rotors, or of the observer, by name.
        matrices: A, B, T, Q and K, in physical letters and those of `definitions`; or A, C, T, Q and L.
        definitions: what the letters stand for, each by those before it and the linear model's α, β₀, a.
        indices: controllability indices, of (Aᵀ, Cᵀ) for L: observability indices.
        symbols: all that occur, with meaning and unit.
        reading: the gain and its names, as derived.
    """

    structure: Structure
    sought: Sought
    equations: dict[str, Any]
    matrices: dict[str, Any]
    definitions: Mapping[sp.Symbol, sp.Expr]
    indices: tuple[int, ...]
    symbols: tuple[Name, ...]
    reading: Reading

    @property
    def gain(self) -> sp.ImmutableMatrix:
        """K or L."""
        return self.reading.gain

    def written_out(self) -> sp.ImmutableMatrix:
        """The gain in physical parameters, sin_0 and cos_0, and the poles."""
        return self.reading.written_out(self.gain).subs(linear_model().definitions)

    def summary(self) -> str:
        """What of, and in which structure."""
        what = "K of six states" if self.sought == "K" else "L of the observer"
        return f"{what}: {self.structure.coupling}, {self.structure.lead} leads"

    def _repr_html_(self) -> None:
        return None  # so that notebooks typeset the gain

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle {self.sought} = {latex(self.gain)}$"


@cache
def rotor_formulas(structure: Structure, *, shifted: bool = False) -> GainFormulas:
    """K, 2×6, of x⁺ = [θ, ψ, θ̇, ψ̇, v_p, v_y], derived with the structure's basis.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    reading, model = read_gain(structure, shifted=shifted), linear_model()
    slopes, lag = sp.diag(phi_p, phi_y), sp.diag(1 / tau_p, 1 / tau_y)
    A = sp.Matrix(sp.BlockMatrix([[model.A, model.B * slopes], [sp.zeros(2, 4), -lag]]).as_explicit())
    own = {"A": A, "B": sp.zeros(4, 2).col_join(lag)}
    cubics = {name.name: name for name in CUBIC_NAMES}
    names = (*(cubics.get(n.name, n) for n in (*NAMES, *ROTOR_NAMES)), *ROTOR_SIGNALS, *reading.names)
    indices = indices_with_rotors()
    return _gathered("K", structure, reading, own=own, equations=_rotors(), indices=indices, names=names)


@cache
def observer_formulas(structure: Structure, *, shifted: bool = False) -> GainFormulas:
    """L, 4×2, with the structure of the estimate's errors.

    Raises:
        InvalidInputError: a shift is asked for where there is none.
    """
    reading = read_observer(structure, shifted=shifted)
    own = {"A": linear_model().A, "C": sp.eye(2, 4)}
    names = (*NAMES, *ROTOR_NAMES, *OBSERVER_NAMES, *MATRIX_NAMES)
    indices = observability_indices()
    return _gathered("L", structure, reading, own=own, equations=_observer(), indices=indices, names=names)


def _gathered(
    sought: Sought,
    structure: Structure,
    reading: Reading,
    *,
    own: Mapping[str, sp.MatrixBase],
    equations: dict[str, Any],
    indices: tuple[int, ...],
    names: tuple[Name, ...],
) -> GainFormulas:
    matrices = {**own, "T": reading.T, "Q": reading.Q, sought: reading.gain}
    shown: list[Any] = [*matrices.values(), *equations.values(), *reading.definitions.values()]
    used = set().union(*(x.free_symbols for x in shown), reading.definitions)
    short = {symbol: value for symbol, value in linear_model().definitions.items() if symbol in used}
    used |= set().union(*(value.free_symbols for value in short.values()))
    by_name = {str(symbol) for symbol in used}
    return GainFormulas(
        structure,
        sought,
        equations,
        {name: sp.ImmutableMatrix(matrix) for name, matrix in matrices.items()},
        {**short, **reading.definitions},
        indices,
        (
            *(n for n in names if n.name in by_name),
            *(gain_names(6) if sought == "K" else observer_gain_names()),
        ),
        reading,
    )


def _rotors() -> dict[str, Any]:
    """τ v̇ = V − v of both; the thrust curve and, where it gives thrust, its slope."""
    v, dead, scale = sp.symbols("v_j v_d s_j")
    beyond = sp.Symbol("beyond", positive=True)  # |v| − v_d where there is thrust: the slope is even in v
    slope = (scale * beyond**2).diff(beyond).subs(beyond, sp.Abs(v) - dead)
    lag = [sp.Eq(tau * sp.Symbol(f"v_{j}_dot"), sp.Symbol(f"V_{j}") - sp.Symbol(f"v_{j}")) for j, tau in _TAU]
    return {
        "lag_pitch": lag[0],
        "lag_yaw": lag[1],
        "thrust": scale * sp.sign(v) * sp.Max(sp.Abs(v) - dead, 0) ** 2,
        "slope": slope,
    }


def _observer() -> dict[str, Any]:
    """The observer, its error, and the loop of both in [x, e], derived."""
    A, B, C, K, L, x, estimate, e, u, y = sp.symbols("A B C K L x x_hat e u y", commutative=False)
    observed = A * estimate + B * u + L * (y - C * estimate)
    loop = {u: -K * estimate, y: C * x}
    rate = (A * x + B * u).subs(loop).subs(estimate, x - e)
    rates = [rate, rate - observed.subs(loop).subs(estimate, x - e)]
    return {
        "observer": observed,
        "separation": sp.Matrix([[_before(r, x), _before(r, e)] for r in map(sp.expand, rates)]),
    }


def _before(expression: sp.Expr, vector: sp.Symbol) -> sp.Expr:
    """The matrix that a sum of products multiplies a vector by."""
    terms = (term.args for term in sp.Add.make_args(expression) if isinstance(term, sp.Mul))
    return sp.Add(*(sp.Mul(*factors[:-1]) for factors in terms if factors[-1] == vector))
