"""Everything symbolic of one structure as SymPy objects, for notebooks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import sympy as sp

from ..couplings import Structure
from ..parameters import Parameters
from ..poles import PoleSet
from ..signals import Floats
from ..tables import Shown
from .full_rank import full_rank, plant
from .grouping import grouped
from .linearization import linear_model
from .luenberger import controllability_matrix
from .mechanics import Mechanics, mechanics
from .names import COEFFICIENTS_OF_POLES, NAMES, PARAMETERS, c, cos_0, latex, s, sin_0, theta_0
from .rga import relative_gain_array, relative_gains_of_s, steady_state, transfer_matrix


@dataclass(frozen=True, repr=False)
class Formulas(Shown):
    """The derivation for one structure of the closed loop; all matrices are SymPy's, immutable.

    Attributes:
        structure: which; with its own `shift` that is a symbol.
        mechanics: energies, mass matrix, accelerations.
        A, B, trim: of the linear model, 4×4, 4×2, 2×1.
        controllability_matrix: [B, AB, A²B, A³B], 4×8.
        T, Q, A_bar, B_bar: Luenberger's canonical form, Ā = T A T⁻¹, B̄ = T B.
        K, K_bar: the gain (Eqs. 21, 22), and Q K T⁻¹, 2×4, in the coefficients of d₁, d₂.
        closed_loop, canonical_closed_loop: A − BK and T (A − BK) T⁻¹.
        G, G_0: Ĝ(s) and Ĝ(0), 2×2, rad/V (Eq. 17).
        RGA, RGA_s: at s = 0 (Eq. 23) and as a function of s.
        definitions: what α, β₀, γ, a and d₁₀ … d₂₁ stand for.
        symbols: every symbol by its name in expressions.
    """

    structure: Structure
    mechanics: Mechanics
    A: sp.ImmutableMatrix
    B: sp.ImmutableMatrix
    trim: sp.ImmutableMatrix
    controllability_matrix: sp.ImmutableMatrix
    T: sp.ImmutableMatrix
    Q: sp.ImmutableMatrix
    A_bar: sp.ImmutableMatrix
    B_bar: sp.ImmutableMatrix
    K: sp.ImmutableMatrix
    K_bar: sp.ImmutableMatrix
    closed_loop: sp.ImmutableMatrix
    canonical_closed_loop: sp.ImmutableMatrix
    G: sp.ImmutableMatrix
    G_0: sp.ImmutableMatrix
    RGA: sp.ImmutableMatrix
    RGA_s: sp.ImmutableMatrix
    definitions: Mapping[sp.Symbol, sp.Expr]
    symbols: Mapping[str, sp.Symbol]

    def numbers(
        self,
        matrix: sp.MatrixBase,
        parameters: Parameters,
        poles: PoleSet | None = None,
        *,
        angle: float = 0.0,
        shift: float | None = None,
    ) -> Floats:
        """A matrix of this derivation in numbers, as an array.

        >>> import heli2dof_core as heli
        >>> spec, f = heli.Spec.from_preset(), heli.formulas()
        >>> float(abs(f.numbers(f.K, spec.parameters, spec.poles) - heli.place(spec).K).max()) < 1e-9
        True

        Args:
            matrix: without s: `G` and `RGA_s` take their s first, by `subs`.
            parameters: the rig.
            poles: where they occur.
            angle: operating point θ₀, rad.
            shift: of the basis, where it is a symbol.

        Raises:
            ValueError: a symbol is left without a value.
        """
        expanded = matrix.subs(dict(self.definitions)).subs({sin_0: sp.sin(theta_0), cos_0: sp.cos(theta_0)})
        values: dict[sp.Symbol, float | complex] = {PARAMETERS[n]: v for n, v in parameters.as_dict().items()}
        values[theta_0] = angle
        if shift is not None:
            values[c] = shift
        if poles is not None:
            values |= {sp.Symbol(f"p_{i + 1}"): p for i, p in enumerate(poles.values)}
        left = expanded.free_symbols - set(values)
        if left:
            raise ValueError("without a value: " + ", ".join(sorted(map(str, left))))
        used = sorted(expanded.free_symbols, key=str)
        result = sp.lambdify(used, expanded, "numpy", cse=True)(*(values[symbol] for symbol in used))
        return result.real.astype(float) if poles is not None else result.astype(float)

    def summary(self) -> str:
        """The structure."""
        return f"{self.structure.coupling}, {self.structure.lead} leads; the matrices of the derivation, as SymPy's"

    def _repr_html_(self) -> None:
        return None  # so that notebooks typeset K

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle K = {latex(self.K)}$"


@cache
def derive(structure: Structure, *, shifted: bool = False) -> Formulas:
    """The derivation for one structure; with `shifted` the shift c of the basis stays a symbol."""
    model, result = linear_model(), full_rank(structure, shifted=shifted)
    matrices = {
        "A": model.A,
        "B": model.B,
        "trim": model.trim,
        "controllability_matrix": controllability_matrix(*plant()).to_Matrix(),
        "T": grouped(result.form.T),
        "Q": grouped(result.form.Q),
        "A_bar": grouped(result.form.A_bar),
        "B_bar": grouped(result.form.B_bar),
        "K": grouped(result.K),
        "K_bar": grouped(result.K_bar),
        "closed_loop": grouped(result.closed_loop),
        "canonical_closed_loop": grouped(result.canonical_closed_loop),
        "G": grouped(transfer_matrix(structure, shifted=shifted)),
        "G_0": grouped(steady_state(structure, shifted=shifted)),
        "RGA": grouped(relative_gain_array(structure, shifted=shifted)),
        "RGA_s": relative_gains_of_s(structure, shifted=shifted),
    }
    return Formulas(
        structure=structure,
        mechanics=mechanics(),
        **{name: sp.ImmutableMatrix(matrix) for name, matrix in matrices.items()},
        definitions={**model.definitions, **COEFFICIENTS_OF_POLES},
        symbols={name.name: sp.Symbol(name.name) for name in NAMES} | {"s": s},
    )
