"""The whole loop around a design: two PI controllers, or the inner loop alone, as one linear system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from .augmentation import augmented_loop
from .design import Design
from .eigenvalues import eigenvalues
from .engine import engine
from .estimators import Estimator
from .figures import LOOP
from .findings import Finding, merged
from .frozen import Frozen, frozen
from .interop import state_space
from .judged import Judged, loop_findings
from .kernels.layout import FILTER_DAMPING, FILTER_FREQUENCY, OWN, PI, PLAIN, POLYNOMIALS, SIZES, STATIC
from .loop_polynomials import controller_numbers, whole_polynomials
from .rotors import Actuators
from .scenario import OuterLoop
from .scratch import scratch
from .signals import INPUTS, INTEGRALS, OUTPUTS, ROTORS, STATES, Complexes, Floats, Signal
from .tables import NOTHING, Shown, Table, number, poles

if TYPE_CHECKING:
    import control


@dataclass(frozen=True, repr=False)
class Loop(Frozen, Shown):
    """Design and outer loop together, linear, in deviations from the trim.

    States are x = [θ, ψ, θ̇, ψ̇] and, with PI, z = ∫ error of pitch and yaw in rad·s; then the speed of each rotor
    that lags, in V, and the states of what estimates x. The voltage is u = −Kx̂ + `proportional` e + `integral` z
    + `feedforward` r, e = r − [θ, ψ], x̂ = x where the states are measured.

    Attributes:
        design: the state feedback.
        outer: the outer loop's settings.
        proportional: 2×2, volts of each motor per error of pitch and yaw, V/rad.
        integral: 2×2, per integral of these errors, V/(rad·s); None where nothing integrates.
        feedforward: 2×2, per reference, V/rad.
        voltage_from_state: ∂u/∂ states, 2×n, V per state: n is 6, 4 where nothing integrates, more with rotors or an
            estimator.
        voltage_from_reference: ∂u/∂r, 2×2, V/rad.
        A: state matrix of the whole loop, n×n.
        B: from the references [θ_ref, ψ_ref] to the states' rates, n×2.
        places: where each state stands in the kernels' arrays (`kernels.layout`), (n,).
        motors: from the voltages that reach the motors to the states' rates, n×2; the law's own knowledge of them in
            an estimator is not in it.
        estimator: what estimates the states; None where they are measured.
    """

    design: Design
    outer: OuterLoop
    proportional: Floats
    integral: Floats | None
    feedforward: Floats
    voltage_from_state: Floats
    voltage_from_reference: Floats
    A: Floats
    B: Floats
    places: tuple[int, ...]
    motors: Floats
    estimator: Estimator | None = None

    @property
    def actuators(self) -> Actuators | None:
        """Rotors and friction of the rig; None of the paper's."""
        return self.design.actuators

    @cached_property
    def size(self) -> Sequence[int]:
        """As many zeros as the kernels' states of this loop: compiled for each number of them."""
        if self.estimator is not None:
            return WITH_ESTIMATOR
        return PAPERS if self.actuators is None or self.actuators.plain else WITH_ROTORS

    @cached_property
    def padded(self) -> tuple[Floats, Floats, Floats]:
        """∂u/∂ states, A and B with the states at their places in the kernels' arrays."""
        n = len(self.size)
        if n == PLAIN:
            return self.voltage_from_state, self.A, self.B
        law, A, B, at = np.zeros((2, n)), np.zeros((n, n)), np.zeros((n, 2)), list(self.places)
        law[:, at], A[np.ix_(at, at)], B[at] = self.voltage_from_state, self.A, self.B
        return frozen((law, A, B))

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """The loop's states."""
        known = (*STATES, *INTEGRALS, *ROTORS)
        return tuple(known[i] if i < len(known) else estimated(i - len(known)) for i in self.places)

    @property
    def has_integrators(self) -> bool:
        """Whether the errors are integrated: by PI loops or the method itself."""
        return self.integral is not None

    @property
    def integral_times(self) -> Floats:
        """Time in which each axis' integral makes up for its proportional action, shape (2,), s."""
        if self.integral is None:
            return np.full(2, np.inf)
        if self.design.integral is None:
            return np.array([self.outer.pitch.ti, self.outer.yaw.ti])
        proportional = np.linalg.norm(self.design.K[:, :2], axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return proportional / np.linalg.norm(self.integral, axis=0)

    @cached_property
    def polynomials(self) -> Floats:
        """Rig and law as 2×2 matrices of polynomials of s, (2, 2, 20), laid out as `kernels.polynomials` says.

        With rotors that lag or an estimator it is eight polynomials, (8, 2, 16), laid out as `kernels.whole` says.
        """
        return self.polynomials_on(self.design.plant.A, self.design.plant.B)

    def polynomials_on(self, A: Floats, B: Floats, tau: Floats | None = None) -> Floats:
        """The same of another rig, 4×4 and 4×2, and with other time constants of its rotors, under this law."""
        own = self.actuators
        if own is not None:
            B, tau = B * own.slope, own.tau if tau is None else tau
        placed = self.design.rotor_poles is not None
        if self.estimator is None and not placed and (tau is None or not tau.any()):
            f, law = np.empty(POLYNOMIALS), self.voltage_from_state
            law = law if own is None else np.ascontiguousarray(law[:, : 4 + self._z])
            engine().polynomial_matrices(A, B, law, f)
            return frozen(f)
        return whole_polynomials(A, B, np.zeros(2) if tau is None else tau, self.controller)

    @cached_property
    def controller(self) -> Floats:
        """The law as `kernels.whole` takes it, (5, 10)."""
        filters = observer = None
        if self.estimator is not None:
            filters = (FILTER_FREQUENCY, FILTER_DAMPING) if self.estimator.model is None else None
            L, model = self.estimator.L, self.estimator.model
            observer = None if model is None or L is None else (model[0], model[1], L, model[2])
        return controller_numbers(self.design.K, self.proportional, self.integral, filters, observer)

    @cached_property
    def lag_margin(self) -> float | None:
        """The least time constant of both rotors, s, at which the loop is not stable; None where there is none.

        Where the rotors are placed, it is the least from their own on, the larger of both: this itself where the loop
        lives by their difference. None, too, where the loop is stable neither there nor with its own rotors. Found
        from polynomials, without a grid (`kernels.lag`).
        """
        own = self.actuators
        start = 0.0 if own is None or self.design.rotor_poles is None else float(own.tau.max())
        found = engine().lag_margin(self.polynomials, start, scratch.lag)
        return found if found < inf and (found > start or self.stable) else None

    @property
    def _z(self) -> int:
        return 0 if self.integral is None else 2

    @cached_property
    def connected(self) -> tuple[int, ...]:
        """The states of the loop: all but integrals that drive no motor, as that of a PI loop whose gain is 0."""
        n = len(self.A)
        if self.integral is None:
            return tuple(range(n))
        (a, b), (c, d) = self.integral.tolist()
        return (0, 1, 2, 3, *((4,) if a or c else ()), *((5,) if b or d else ()), *range(6, n))

    @cached_property
    def connected_poles(self) -> Complexes:
        """The poles that decide on stability, rad/s: those of the connected states; slowest first."""
        order = self.connected
        A = self.A if len(order) == len(self.A) else self.A[np.ix_(order, order)]
        return frozen(np.array(sorted(eigenvalues(A), key=_slowest_first)))

    @cached_property
    def poles(self) -> Complexes:
        """All poles, rad/s, slowest first: one per state. A disconnected integrator's lies at 0."""
        own = self.connected_poles
        if len(own) == len(self.A):  # as a rule
            return own
        apart = [0j] * (len(self.A) - len(own))
        return frozen(np.array(sorted([*apart, *own.tolist()], key=_slowest_first)))

    @cached_property
    def stable(self) -> bool:
        """Whether every connected pole lies left of the imaginary axis, whatever the rounding of A, B and K.

        `kernels.stability` says how rounding is told; where no outer loop moves the placed poles, those asked for
        must comply as well.
        """
        robust = bool(engine().is_stable(self.polynomials, scratch.stability))
        return robust and (not self._poles_are_the_designs or self.design.stable)

    @property
    def _poles_are_the_designs(self) -> bool:
        known = self.actuators is None or self.design.rotor_poles is not None
        closed = len(self.connected) > len(self.design.states) or any(map(any, self.proportional.tolist()))
        return known and self.estimator is None and not closed

    def to_control(self, *, voltages: bool = False) -> control.StateSpace:
        """The whole loop: θ_ref, ψ_ref to θ, ψ, rad to rad, in deviations from the operating point.

        Args:
            voltages: V_p, V_y (V, deviations from the trim) are outputs too.
        """
        order = len(self.A)
        C, D = np.eye(2, order), np.zeros((2, 2))
        outputs = OUTPUTS
        if voltages:
            C, D = np.vstack((C, self.voltage_from_state)), np.vstack((D, self.voltage_from_reference))
            outputs = (*OUTPUTS, *INPUTS)
        references = [f"{signal.name}_ref" for signal in OUTPUTS]
        return state_space("whole_loop", (self.A, self.B, C, D), self.states, references, outputs)

    def summary(self) -> str:
        """Stability and poles."""
        stability = "stable" if self.stable else "unstable"
        kind = "own integral action" if self.design.integral is not None else self.outer.outer
        return f"{stability}, {kind}; poles {poles(self.poles.tolist())} rad/s"

    def tables(self) -> tuple[Table, ...]:
        """The poles of the whole loop, slowest first, with their natural frequency and damping; its lag margin."""
        rows = (
            (number(p), number(abs(p)), number(-p.real / abs(p) if p else None)) for p in self.poles.tolist()
        )
        return (Table.of("whole loop", ("pole (rad/s)", "ωₙ (rad/s)", "ζ"), rows), lag_table(self))

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Remarks on the whole loop."""
        return tuple(loop_findings(self.judged))

    @cached_property
    def judged(self) -> Judged:
        """Its numbers, as remarks and replies take them."""
        own = self.estimator
        L = None if own is None or own.L is None else own.L.tolist()
        return Judged(
            self.design.numbers,
            None if self.integral is None else self.integral.T.tolist(),
            (self.outer.pitch.kp, self.outer.yaw.kp),
            self.outer.decoupler,
            self.connected_poles.tolist(),
            self.poles.tolist(),
            self.stable,
            self.lag_margin,
            self.actuators,
            None if own is None else own.growing,
            L,
            None if own is None or L is None else own.poles.tolist(),
        )

    @cached_property
    def all_findings(self) -> tuple[Finding, ...]:
        """Remarks on the design and on the whole loop."""
        return merged(self.design.findings, self.findings)


def lag_in_words(loop: Loop) -> str:
    """The lag margin, s; in words where there is no limit, a dash where the loop is not stable."""
    if loop.lag_margin is None:
        return UNLIMITED if loop.stable else NOTHING
    return number(loop.lag_margin)


def lag_table(loop: Loop) -> Table:
    """The loop's figures beside its poles."""
    return Table.of("of the rotors", ("", "value"), [(LOOP["lag_margin"].head, lag_in_words(loop))])


def _slowest_first(pole: complex) -> tuple[float, float]:
    return -pole.real, -pole.imag


UNLIMITED = "unlimited"
PAPERS, WITH_ROTORS, WITH_ESTIMATOR = SIZES


def estimated(i: int) -> Signal:
    """The state number `i` of an estimator."""
    return Signal(f"w_{i + 1}", f"w_{i + 1}", "", "state of what estimates the states")


def close_loop(design: Design, outer: OuterLoop = OuterLoop(), estimator: Estimator | None = None) -> Loop:
    """Puts the outer loop around a design (Fig. 3, or Fig. 2 with ``outer="none"``).

    A method's own integral action takes the place of the PI loops. `estimator` is what the feedback acts on where the
    states are not measured (`estimators.estimator`).
    """
    kind = OWN if design.integral is not None else PI if outer.outer == "pi" else STATIC
    order = 4 if kind == STATIC else 6
    P, F, by_reference = np.empty((2, 2)), np.empty((2, 2)), np.empty((2, 2))
    gains = np.array([[pi.kp, pi.kp / pi.ti] for pi in (outer.pitch, outer.yaw)])
    integral = np.zeros((2, 2)) if design.integral is None else np.array(design.integral, order="C")
    law, A, B = np.empty((2, order)), np.empty((order, order)), np.empty((order, 2))
    plant, cross = design.plant, outer.pairing == "cross"
    settings = (kind, gains, cross, outer.decoupler)
    steady = (design.steady_state_inverse, design.steady_state_determinant)
    K = design.K if design.rotor_poles is None else np.ascontiguousarray(design.K[:, :4])
    engine().loop_matrices(K, *steady, plant.A, plant.B, *settings, P, integral, F, law, by_reference, A, B)
    integral = None if kind == STATIC else integral
    if estimator is None and (design.actuators is None or design.actuators.plain):
        motors = np.zeros((order, 2))
        motors[:4] = plant.B
        return Loop(design, outer, P, integral, F, law, by_reference, A, B, tuple(range(order)), motors)
    parts = augmented_loop(design, design.actuators, estimator, (P, integral, by_reference))
    return Loop(design, outer, P, integral, F, parts[0], by_reference, *parts[1:], estimator)
