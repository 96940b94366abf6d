"""Parameters + poles + method → Design: K and what it does to the poles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from math import hypot, isfinite, sqrt
from typing import TYPE_CHECKING

import numpy as np

from .compiled import gain
from .couplings import Structure, require_structure
from .engine import engine
from .errors import StructureUnavailableError
from .findings import Finding
from .frozen import Frozen, frozen
from .interop import state_space
from .kernels.layout import POLYNOMIALS, ROUNDING
from .placement.exact import exact_coefficients, exact_matrix, float_matrix
from .placement.method import Task, Weights
from .placement.registry import method as method_named
from .placement.verdict import Verdict, eigenvector_condition, judge
from .plant import Plant
from .poles import PoleSet
from .remarks import design_remarks
from .scratch import scratch
from .signals import INPUTS, OUTPUTS, STATES, C, Complexes, Floats
from .tables import Shown, Table, latex_matrix, number, poles

if TYPE_CHECKING:
    import control

FULL_RANK = "full-rank"


@dataclass(frozen=True, repr=False)
class Design(Frozen, Shown):
    """State feedback u = −Kx + v for one rig, by one method.

    Attributes:
        plant: the rig at its operating point.
        poles: the poles asked for, rad/s.
        method: name of the placement method (`placement.registry`).
        structure: structure of the closed loop; None where the method is not full-rank's.
        K: gain, 2×4, V/rad in columns θ, ψ and V·s/rad in columns θ̇, ψ̇ (Eqs. 21, 22).
        steady_state_inverse: Ĝ(0)⁻¹, 2×2, V/rad: the voltages v that hold one radian on either axis. It equals K's
            first two columns minus B₂⁻¹ A₂₁ and so exists even where a closed-loop pole is 0 and Ĝ(0) does not; it is
            then singular. Where K has a closed form, so has this: near 0 the difference of the numbers would lose
            the digits that decide.
        integral: 2×2, V/(rad·s): the method's own integral action; None where it has none.
        aims: whether the method aims at `poles`, or chooses its own.
    """

    plant: Plant
    poles: PoleSet
    method: str
    structure: Structure | None
    K: Floats
    steady_state_inverse: Floats
    integral: Floats | None = None
    aims: bool = True

    @cached_property
    def A_closed(self) -> Floats:
        """A − BK, 4×4."""
        return frozen(self.plant.A - self.plant.B @ self.K)

    @cached_property
    def verdict(self) -> Verdict:
        """Where the poles of A − BK are, exactly where floats do not tell it."""
        return judge(self.plant.A, self.plant.B, self.K, self.poles.array)

    @property
    def closed_loop_poles(self) -> Complexes:
        """Eigenvalues of A − BK, in the order of `poles`, rad/s."""
        return self.verdict.poles

    @property
    def pole_error(self) -> float | None:
        """Largest distance between these and `poles`, rad/s; None where the method chose its own."""
        return self.verdict.error if self.aims else None

    @property
    def pole_error_bound(self) -> float:
        """How far rounding may have moved `closed_loop_poles` as told, and so `pole_error`, rad/s."""
        return self.verdict.bound

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Remarks on the poles and the gain."""
        found = self.poles.values if self.aims else self.closed_loop_poles.tolist()
        verdict = {"stable": self.stable, "steady": self.steady_state_determinant != 0}
        return design_remarks(self.plant, self.K, found, self.pole_error, **verdict)

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
        """κ₂ of the closed loop's eigenvectors; None where there are too few (see `placement.verdict`)."""
        return eigenvector_condition(self.A_closed)

    @cached_property
    def steady_state_determinant(self) -> float:
        """Its determinant, the product of the poles by det B₂⁻¹; 0 where a pole of A − BK lies at 0.

        So it does where the product is nothing but rounding of K (`ROUNDING`), as in the loop's own verdict.
        """
        # plain numbers: on two by two, NumPy takes longer around a product than it takes itself
        (p, q), (r, s) = self.plant.thrust
        (w, x), (y, z) = self.steady_state_inverse.tolist()
        a, b, c, d = p * w + q * y, p * x + q * z, r * w + s * y, r * x + s * z
        (i, j, _, _), (k, m, _, _) = self.K.tolist()
        stiffness = abs(float(self.plant.A[2, 0]))
        e, f = stiffness + abs(p * i) + abs(q * k), abs(p * j) + abs(q * m)
        g, h = abs(r * i) + abs(s * k), abs(r * j) + abs(s * m)
        if self.structure is not None:
            p_1, p_2, p_3, p_4 = self.poles.values
            product = (p_1 * p_2).real * (p_3 * p_4).real
        else:
            product = a * d - b * c if not self.aims or all(self.poles.values) else 0.0
        size = abs(a) * h + e * abs(d) + abs(b) * g + f * abs(c)
        return product / (p * s - q * r) if abs(product) > ROUNDING * size else 0.0

    @cached_property
    def steady_state(self) -> Floats | None:
        """Ĝ(0), 2×2, rad/V; None where a pole of A − BK lies at 0."""
        if not self.steady_state_determinant:
            return None
        (a, b), (c, d) = self.steady_state_inverse.tolist()
        return frozen(np.array([[d, -b], [-c, a]]) / self.steady_state_determinant)

    @cached_property
    def stable(self) -> bool:
        """Whether all poles of A − BK lie left of the imaginary axis: those asked for, or the method's own."""
        if self.aims:
            return self.steady_state_determinant != 0 and all(p.real < 0 for p in self.poles.values)
        f = np.empty(POLYNOMIALS)
        engine().polynomial_matrices(self.plant.A, self.plant.B, -self.K, f)
        return bool(engine().is_stable(f, scratch.stability))

    def to_control(self) -> control.StateSpace:
        """The inner loop alone, Ĝ(s) (Eq. 17): v_p, v_y of u = −Kx + v to θ, ψ, V to rad, deviations.

        >>> import heli2dof_core as heli
        >>> inner = heli.place(heli.Spec.from_preset(poles=[-4, -5, -6, -7])).to_control()
        >>> sorted(round(p.real, 6) for p in inner.poles().tolist())
        [-7.0, -6.0, -5.0, -4.0]
        """
        matrices = (self.A_closed, self.plant.B, C, np.zeros((2, 2)))
        return state_space("inner_loop", matrices, STATES, ("v_p", "v_y"), OUTPUTS)

    def summary(self) -> str:
        """Method, poles and size of K."""
        own = "" if self.structure is None else f", {self.structure.coupling}"
        return f"{self.method}{own}; poles {poles(self.closed_loop_poles.tolist())} rad/s; ‖K‖ = {number(self.norm)}"

    def tables(self) -> tuple[Table, ...]:
        """K, and the poles as placed beside those asked for."""
        units = ("V/rad", "V/rad", "V·s/rad", "V·s/rad")
        heads = [f"{s.symbol} ({unit})" for s, unit in zip(STATES, units, strict=True)]
        wanted = self.poles.values if self.aims else (None,) * 4
        rows = zip("1234", map(number, wanted), map(number, self.closed_loop_poles.tolist()), strict=True)
        return (
            Table.matrix("K, u = −Kx + v", self.K, [s.symbol for s in INPUTS], heads),
            Table.of("poles, rad/s", ("pole", "wanted", "placed"), rows),
        )

    def _repr_latex_(self) -> str:
        return latex_matrix("K", self.K)


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
    if chosen.structured:
        return Design(plant, poles, method, structure, *full_rank_gain(plant, poles, structure))
    placed = chosen.place(Task(plant.A, plant.B, poles.array, C, weights))
    K = np.ascontiguousarray(placed.K, dtype=np.float64)
    return Design(
        plant, poles, method, None, K, K[:, :2] - plant.statics, placed.integral, chosen.places_poles
    )


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
