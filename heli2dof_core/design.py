"""Parameters + poles + method → Design: K and what it does to the poles."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import hypot, sqrt
from typing import TYPE_CHECKING

import numpy as np

from .couplings import Structure
from .engine import engine
from .findings import Finding
from .frozen import Frozen, frozen
from .gains import full_rank_gain
from .interop import state_space
from .judged import Placed, Size, placed_findings
from .kernels.layout import POLYNOMIALS, ROUNDING
from .loop_polynomials import controller_numbers, whole_polynomials
from .placement.method import Task, Weights
from .placement.registry import method as method_named
from .placement.verdict import Verdict, eigenvector_condition, judge
from .placement.with_rotors import gain_with_rotors, require_slopes, with_rotors
from .plant import Plant
from .poles import PoleSet
from .rotors import Actuators
from .scratch import scratch
from .signals import INPUTS, OUTPUTS, ROTORS, STATES, C, Complexes, Floats, Signal
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
        K: gain, 2×4, V/rad in columns θ, ψ and V·s/rad in columns θ̇, ψ̇ (Eqs. 21, 22); where the rotors are
            placed, too, 2×6, V/V in columns v_p, v_y.
        steady_state_inverse: Ĝ(0)⁻¹, 2×2, V/rad: the voltages v that hold one radian on either axis. It equals K's
            first two columns minus B₂⁻¹ A₂₁ and so exists even where a closed-loop pole is 0 and Ĝ(0) does not; it is
            then singular. Where K has a closed form, so has this: near 0 the difference of the numbers would lose
            the digits that decide.
        integral: 2×2, V/(rad·s): the method's own integral action; None where it has none.
        aims: whether the method aims at `poles`, or chooses its own.
        actuators: rotors and friction of the rig, which the design may know of or not; None of the paper's rig.
        rotor_poles: the poles p₅ of pitch's and p₆ of yaw's triple, rad/s, where the rotors are placed; else None.
    """

    plant: Plant
    poles: PoleSet
    method: str
    structure: Structure | None
    K: Floats
    steady_state_inverse: Floats
    integral: Floats | None = None
    aims: bool = True
    actuators: Actuators | None = None
    rotor_poles: tuple[float, float] | None = None

    @property
    def trim(self) -> Floats:
        """Voltages that hold the rig at its operating point, (2,), V, thrust curves considered."""
        return self.plant.trim if self.actuators is None else self.actuators.trim

    @cached_property
    def model(self) -> tuple[Floats, Floats]:
        """A and B of the model that K is designed for: 4×4 and 4×2, or 6×6 and 6×2 with both rotors."""
        if self.rotor_poles is None or self.actuators is None:
            return self.plant.A, self.plant.B
        return frozen(with_rotors(self.plant.A, self.plant.B * self.actuators.slope, self.actuators.tau))

    def inverses(self, K: Floats) -> Floats:
        """Ĝ(0)⁻¹, (..., 2, 2), of other gains for the same model, (..., 2, 4) or (..., 2, 6), by their numbers.

        Where K has a closed form, `steady_state_inverse` has digits that these lose.
        """
        if self.rotor_poles is None:
            return K[..., :2] - self.plant.statics
        return _inverses_with_rotors(self.model[0], K)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Those of the model."""
        return STATES if self.rotor_poles is None else (*STATES, *ROTORS)

    @cached_property
    def wanted(self) -> Complexes:
        """All poles asked for, rad/s: p₁ … p₄, and p₅, p₆ where the rotors are placed."""
        return frozen(np.array([*self.poles.values, *(self.rotor_poles or ())], dtype=np.complex128))

    @cached_property
    def A_closed(self) -> Floats:
        """A − BK, 4×4 or 6×6."""
        A, B = self.model
        return frozen(A - B @ self.K)

    @cached_property
    def verdict(self) -> Verdict:
        """Where the poles of A − BK are, exactly where floats do not tell it."""
        return judge(*self.model, self.K, self.wanted)

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
        return placed_findings(self.numbers)

    @cached_property
    def numbers(self) -> Placed:
        """Its numbers, as remarks and replies take them."""
        return Placed(
            self.plant,
            self.method,
            self.K.tolist(),
            None if self.integral is None else self.integral.tolist(),
            self.wanted.tolist(),
            self.rotor_poles,
            self.aims,
            self.closed_loop_poles.tolist(),
            self.pole_error,
            self.pole_error_bound,
            self.stable,
            self.steady_state_determinant != 0,
        )

    @property
    def size(self) -> Size:
        """Figures of its gain."""
        return Size(self.norm, self.spectral_norm, self.eigenvector_condition)

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
        if self.rotor_poles is not None:
            return self._determinant_with_rotors()
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

    def _determinant_with_rotors(self) -> float:
        """The same of six states: det(A − BK) = det(B₂ φ′) det Ĝ(0)⁻¹ / (τ_p τ_y)."""
        A, B = self.model
        thrust, lag = A[2:4, 4:], B[4:].diagonal()
        statics = np.abs(np.linalg.solve(thrust, A[2:4, :2]))
        sizes = np.abs(self.K[:, :2]) + (np.eye(2) + np.abs(self.K[:, 4:])) @ statics
        (a, b), (c, d) = self.steady_state_inverse.tolist()
        size = float(
            sizes[0, 0] * abs(d) + abs(a) * sizes[1, 1] + sizes[0, 1] * abs(c) + abs(b) * sizes[1, 0]
        )
        determinant = a * d - b * c
        if self.aims:
            product = float(np.prod(self.wanted).real)
            determinant = product / float(np.linalg.det(thrust) * np.prod(lag))
        return determinant if abs(determinant) > ROUNDING * size else 0.0

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
            return self.steady_state_determinant != 0 and all(p.real < 0 for p in self.wanted.tolist())
        if self.rotor_poles is not None and self.actuators is not None:
            thrust, nothing = self.plant.B * self.actuators.slope, np.zeros((2, 2))
            law = controller_numbers(self.K, nothing, None)
            f = whole_polynomials(self.plant.A, thrust, self.actuators.tau, law)
            return bool(engine().is_stable(f, scratch.stability))
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
        n = len(self.A_closed)
        matrices = (self.A_closed, self.model[1], np.eye(2, n), np.zeros((2, 2)))
        return state_space("inner_loop", matrices, self.states, ("v_p", "v_y"), OUTPUTS)

    def summary(self) -> str:
        """Method, poles and size of K."""
        own = "" if self.structure is None else f", {self.structure.coupling}"
        return f"{self.method}{own}; poles {poles(self.closed_loop_poles.tolist())} rad/s; ‖K‖ = {number(self.norm)}"

    def tables(self) -> tuple[Table, ...]:
        """K, and the poles as placed beside those asked for."""
        units = ("V/rad", "V/rad", "V·s/rad", "V·s/rad", "V/V", "V/V")
        heads = [f"{s.symbol} ({unit})" for s, unit in zip(self.states, units, strict=False)]
        placed = self.closed_loop_poles.tolist()
        wanted = self.wanted.tolist() if self.aims else (None,) * len(placed)
        rows = zip("123456", map(number, wanted), map(number, placed), strict=False)
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
    *,
    actuators: Actuators | None = None,
    rotor_poles: tuple[float, float] | None = None,
) -> Design:
    """State feedback for the rig: by the derived closed form, or by another method.

    Args:
        plant: the rig at its operating point.
        poles: the poles asked for; LQR does not look at them.
        structure: of the closed loop; full-rank placement alone looks at it.
        method: name in `placement.registry`.
        weights: of the quadratic methods.
        actuators: rotors and friction of the rig; None of the paper's.
        rotor_poles: where the rotors' own poles shall be, rad/s, one per axis; None leaves the rotors out of the
            model.

    Raises:
        InvalidInputError: there is no such method; or a rotor is to be placed that does not lag.
        StructureUnavailableError: the rig has no such structure.
        MethodUnavailableError: the method cannot place these poles on this rig.
    """
    chosen = method_named(method)
    if rotor_poles is not None:
        task = _SixStates(plant, actuators or Actuators.none(plant), poles, rotor_poles)
        return task.placed(structure, method, weights)
    if chosen.structured:
        K, inverse = full_rank_gain(plant, poles, structure)
        return Design(plant, poles, method, structure, K, inverse, actuators=actuators)
    placed = chosen.place(Task(plant.A, plant.B, poles.array, C, weights))
    K = np.ascontiguousarray(placed.K, dtype=np.float64)
    own = (None, K, K[:, :2] - plant.statics, placed.integral, chosen.places_poles)
    return Design(plant, poles, method, *own, actuators)


@dataclass(frozen=True)
class _SixStates:
    """The rig and both rotors' speeds, whose poles shall be placed."""

    plant: Plant
    actuators: Actuators
    poles: PoleSet
    rotor_poles: tuple[float, float]

    def placed(self, structure: Structure, method: str, weights: Weights | None) -> Design:
        chosen, slope, tau = method_named(method), self.actuators.slope, self.actuators.tau
        known = (self.actuators, self.rotor_poles)
        if chosen.structured:
            task = (self.plant, self.poles, self.rotor_poles, structure, tau)
            K, inverse = gain_with_rotors(*task, slope=slope)
            return Design(self.plant, self.poles, method, structure, K, inverse, None, True, *known)
        if weights is not None:  # what the rotors' speeds cost is their voltages' business
            weights = replace(weights, states=(*weights.states, 0.0, 0.0))
        require_slopes(slope)
        A, B = with_rotors(self.plant.A, self.plant.B * slope, tau)
        wanted = np.array([*self.poles.values, *self.rotor_poles], dtype=np.complex128)
        found = chosen.place(Task(A, B, wanted, np.eye(2, 6), weights))
        K = np.ascontiguousarray(found.K, dtype=np.float64)
        own = (method, None, K, _inverses_with_rotors(A, K), found.integral, chosen.places_poles)
        return Design(self.plant, self.poles, *own, *known)


def _inverses_with_rotors(A: Floats, K: Floats) -> Floats:
    return K[..., :2] - (np.eye(2) + K[..., 4:]) @ np.linalg.solve(A[2:4, 4:], A[2:4, :2])
