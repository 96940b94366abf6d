"""The whole loop around a design: two PI controllers, or the inner loop alone, as one linear system."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .design import Design
from .findings import Finding
from .signals import AXES, Complexes, Floats
from .spec import OuterLoop


@dataclass(frozen=True)
class Loop:
    """Design and outer loop together, linear, in deviations from the trim.

    States are x = [θ, ψ, θ̇, ψ̇] and, with PI, z = ∫ error of pitch and yaw in rad·s. The voltage is
    u = −Kx + v with v = `mixing` (kp ∘ (e + z / ti)), or v = `mixing` r without an outer loop.

    Attributes:
        design: the state feedback.
        outer: the outer loop's settings.
        mixing: 2×2; how controller outputs (or references) reach the motors: pairing with signs,
            decoupler, or Ĝ(0)⁻¹.
        kp, ki: proportional gains, V/rad, and kp / ti, V/(rad·s), of pitch and yaw; 0 without PI.
    """

    design: Design
    outer: OuterLoop
    mixing: Floats
    kp: Floats
    ki: Floats

    @property
    def has_integrators(self) -> bool:
        """Whether there are PI controllers."""
        return self.outer.outer == "pi"

    @cached_property
    def voltage_from_state(self) -> Floats:
        """∂u/∂[x, z], 2×6 (2×4 without PI), V per state."""
        if not self.has_integrators:
            return -self.design.K
        proportional = -self.design.K.copy()
        proportional[:, :2] -= self.mixing * self.kp
        return np.hstack([proportional, self.mixing * self.ki])

    @cached_property
    def voltage_from_reference(self) -> Floats:
        """∂u/∂r, 2×2, V/rad."""
        return self.mixing * self.kp if self.has_integrators else self.mixing

    @cached_property
    def A(self) -> Floats:
        """State matrix of the whole loop, 6×6 (4×4 without PI)."""
        plant = self.design.plant
        top = plant.B @ self.voltage_from_state
        top[:, :4] += plant.A
        if not self.has_integrators:
            return top
        return np.vstack([top, np.hstack([-np.eye(2), np.zeros((2, 4))])])

    @cached_property
    def B(self) -> Floats:
        """Matrix from the references [θ_ref, ψ_ref] to the states' rates."""
        top = self.design.plant.B @ self.voltage_from_reference
        return np.vstack([top, np.eye(2)]) if self.has_integrators else top

    @cached_property
    def poles(self) -> Complexes:
        """Poles of the whole loop, rad/s: six with PI, four without; slowest first."""
        values: Complexes = np.linalg.eigvals(self.A).astype(np.complex128)
        return values[np.lexsort((-np.imag(values), -np.real(values)))]

    @property
    def stable(self) -> bool:
        """Whether every pole of the whole loop lies left of the imaginary axis."""
        return bool(np.max(self.poles.real) < 0)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Remarks on the whole loop."""
        return tuple(_remarks(self))


def close_loop(design: Design, outer: OuterLoop = OuterLoop()) -> Loop:
    """Puts the outer loop around a design (Fig. 3, or Fig. 2 with ``outer="none"``)."""
    inverse = design.steady_state_inverse
    nothing = np.zeros(2)
    if outer.outer == "none":
        return Loop(design, outer, inverse, nothing, nothing)
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
    return Loop(design, outer, mixing, kp, ki)


def _remarks(loop: Loop) -> Iterator[Finding]:
    slowest = loop.poles[0]
    if loop.has_integrators:
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
        for name, kp in zip(AXES, loop.kp, strict=True):
            if kp == 0:
                yield Finding(f"{name}_loop_open", "warning", f"The {name} loop is open: its gain is 0.")
    damping = min((-p.real / abs(p) for p in loop.poles if abs(p) > 0), default=1.0)
    if loop.stable and damping < 0.2:
        yield Finding(
            "poorly_damped",
            "warning",
            f"The whole loop rings: its least damped pole has a damping ratio of {damping:.2f}.",
        )


def _words(pole: complex) -> str:
    text = f"{pole.real:.3g}" + (f" ± {abs(pole.imag):.3g}j" if pole.imag else "")
    return text.replace("-", "−")
