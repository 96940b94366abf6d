"""The whole loop around a design: two PI controllers, or the inner loop alone, as one linear system."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .design import Design
from .engine import engine
from .findings import Finding
from .layout import POLYNOMIALS
from .signals import AXES, Complexes, Floats
from .spec import OuterLoop


@dataclass(frozen=True)
class Loop:
    """Design and outer loop together, linear, in deviations from the trim.

    States are x = [θ, ψ, θ̇, ψ̇] and, with PI, z = ∫ error of pitch and yaw in rad·s. The voltage is
    u = −Kx + `proportional` e + `integral` z + `feedforward` r, e = r − [θ, ψ].

    Attributes:
        design: the state feedback.
        outer: the outer loop's settings.
        proportional: 2×2, volts of each motor per error of pitch and yaw, V/rad.
        integral: 2×2, per integral of these errors, V/(rad·s); None where nothing integrates.
        feedforward: 2×2, per reference, V/rad.
    """

    design: Design
    outer: OuterLoop
    proportional: Floats
    integral: Floats | None
    feedforward: Floats

    @property
    def has_integrators(self) -> bool:
        """Whether the errors are integrated: by PI controllers or by the method's own action."""
        return self.integral is not None

    @property
    def integral_times(self) -> Floats:
        """Time in which each axis' integral makes up for its proportional action, shape (2,), s."""
        if self.integral is None:
            return np.full(2, np.inf)
        if self.design.integral is None:
            return np.array([self.outer.pitch.ti, self.outer.yaw.ti])
        proportional = np.linalg.norm(self.design.K[:, :2], axis=0)
        return proportional / np.linalg.norm(self.integral, axis=0)

    @cached_property
    def voltage_from_state(self) -> Floats:
        """∂u/∂[x, z], 2×6 (2×4 without PI), V per state."""
        law = np.empty((2, 4 if self.integral is None else 6))
        law[:, :4] = -self.design.K
        law[:, :2] -= self.proportional
        if self.integral is not None:
            law[:, 4:] = self.integral
        return law

    @cached_property
    def voltage_from_reference(self) -> Floats:
        """∂u/∂r, 2×2, V/rad."""
        return self.proportional + self.feedforward

    @cached_property
    def A(self) -> Floats:
        """State matrix of the whole loop, 6×6 (4×4 without PI)."""
        plant, law = self.design.plant, self.voltage_from_state
        order = law.shape[1]
        A = np.zeros((order, order))
        A[:4] = plant.B @ law
        A[:4, :4] += plant.A
        if order == 6:
            A[4, 0] = A[5, 1] = -1.0
        return A

    @cached_property
    def B(self) -> Floats:
        """Matrix from the references [θ_ref, ψ_ref] to the states' rates."""
        top = self.design.plant.B @ self.voltage_from_reference
        return np.vstack([top, np.eye(2)]) if self.has_integrators else top

    @cached_property
    def polynomials(self) -> Floats:
        """Rig and law as 2×2 matrices of polynomials of s, (2, 2, 16), laid out as `kernels.frequency` says."""
        plant, f = self.design.plant, np.empty(POLYNOMIALS)
        A, B = np.array(plant.A), np.array(plant.B)  # writable: to Numba a read-only array is another type
        engine().describe(A, B, self.voltage_from_state, self.has_integrators, f)
        return f

    @cached_property
    def poles(self) -> Complexes:
        """Poles of the whole loop, rad/s: six with PI, four without; slowest first."""
        values = np.linalg.eigvals(self.A).tolist()
        return np.array(sorted(values, key=lambda p: (-p.real, -p.imag)), dtype=np.complex128)

    @cached_property
    def stable(self) -> bool:
        """Whether every pole of the whole loop lies left of the imaginary axis."""
        return bool(np.max(self.poles.real) < 0)

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Remarks on the whole loop."""
        return tuple(_remarks(self))


def close_loop(design: Design, outer: OuterLoop = OuterLoop()) -> Loop:
    """Puts the outer loop around a design (Fig. 3, or Fig. 2 with ``outer="none"``).

    A method's own integral action takes the place of the PI loops.
    """
    inverse = design.steady_state_inverse
    nothing = np.zeros((2, 2))
    if design.integral is not None:
        return Loop(design, outer, nothing, design.integral, nothing)
    if outer.outer == "none":
        return Loop(design, outer, nothing, None, inverse)
    (a, b), (c, d) = inverse
    # Ĝ(0) up to the positive or negative factor det Ĝ(0); signs below use the determinant's sign
    determinant = a * d - b * c
    sign = 1.0 if determinant == 0 else np.sign(determinant)
    G_0 = sign * np.array([[d, -b], [-c, a]])
    paired = np.diag(G_0) if outer.pairing == "diagonal" else np.array([G_0[0, 1], G_0[1, 0]])
    if outer.decoupler:
        scale = abs(determinant) or 1.0
        mixing = inverse * (np.abs(paired) / scale)
    elif outer.pairing == "diagonal":
        mixing = np.eye(2)
    else:
        signs = np.where(paired < 0, -1.0, 1.0)
        mixing = np.array([[0.0, signs[1]], [signs[0], 0.0]])
    kp = np.array([outer.pitch.kp, outer.yaw.kp])
    ki = kp / np.array([outer.pitch.ti, outer.yaw.ti])
    return Loop(design, outer, mixing * kp, mixing * ki, nothing)


def _remarks(loop: Loop) -> Iterator[Finding]:
    slowest = loop.poles[0]
    if loop.design.integral is not None:
        yield Finding(
            "own_integral_action",
            "info",
            "The method brings its own integral action, which takes the place of the PI loops.",
        )
    elif loop.has_integrators:
        if not loop.stable and np.max(loop.design.closed_loop_poles.real) < 0:
            yield Finding(
                "pi_unstable",
                "error",
                "The PI loops make the helicopter unstable: a pole of the whole loop lies at "
                f"{_words(slowest)} rad/s, although the placed poles are stable. Lower the gains, raise the "
                "integral times, or place faster poles.",
            )
        elif not loop.stable:
            yield Finding(
                "loop_unstable",
                "error",
                f"The whole loop is unstable: it has a pole at {_words(slowest)} rad/s.",
            )
        for name, gains in zip(AXES, (loop.outer.pitch, loop.outer.yaw), strict=True):
            if gains.kp == 0:
                yield Finding(f"{name}_loop_open", "warning", f"The {name} loop is open: its gain is 0.")
    damping = min((-p.real / abs(p) for p in loop.poles.tolist() if p != 0), default=1.0)
    if loop.stable and damping < 0.2:
        yield Finding(
            "poorly_damped",
            "warning",
            f"The whole loop rings: its least damped pole has a damping ratio of {damping:.2f}.",
        )


def _words(pole: complex) -> str:
    text = f"{pole.real:.3g}" + (f" ± {abs(pole.imag):.3g}j" if pole.imag else "")
    return text.replace("-", "−")
