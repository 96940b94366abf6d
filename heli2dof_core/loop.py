"""The whole loop around a design: two PI controllers, or the inner loop alone, as one linear system."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .design import Design
from .eigenvalues import eigenvalues
from .engine import engine
from .findings import Finding
from .interop import state_space
from .layout import OWN, PI, POLYNOMIALS, STATIC
from .signals import AXES, INPUTS, INTEGRALS, OUTPUTS, STATES, Complexes, Floats
from .spec import OuterLoop
from .tables import Shown, Table, number, poles

if TYPE_CHECKING:
    import control


@dataclass(frozen=True, repr=False)
class Loop(Shown):
    """Design and outer loop together, linear, in deviations from the trim.

    States are x = [θ, ψ, θ̇, ψ̇] and, with PI, z = ∫ error of pitch and yaw in rad·s. The voltage is
    u = −Kx + `proportional` e + `integral` z + `feedforward` r, e = r − [θ, ψ].

    Attributes:
        design: the state feedback.
        outer: the outer loop's settings.
        proportional: 2×2, volts of each motor per error of pitch and yaw, V/rad.
        integral: 2×2, per integral of these errors, V/(rad·s); None where nothing integrates.
        feedforward: 2×2, per reference, V/rad.
        voltage_from_state: ∂u/∂[x, z], 2×6 (2×4 where nothing integrates), V per state.
        voltage_from_reference: ∂u/∂r, 2×2, V/rad.
        A: state matrix of the whole loop, 6×6 or 4×4.
        B: from the references [θ_ref, ψ_ref] to the states' rates.
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
    def polynomials(self) -> Floats:
        """Rig and law as 2×2 matrices of polynomials of s, (2, 2, 16), laid out as `kernels.frequency` says."""
        plant, f = self.design.plant, np.empty(POLYNOMIALS)
        engine().describe(plant.A, plant.B, self.voltage_from_state, self.has_integrators, f)
        return f

    @cached_property
    def poles(self) -> Complexes:
        """Poles of the whole loop, rad/s: six with PI, four without; slowest first."""
        return np.array(sorted(eigenvalues(self.A), key=lambda p: (-p.real, -p.imag)))

    @cached_property
    def stable(self) -> bool:
        """Whether every pole of the whole loop lies left of the imaginary axis."""
        return bool(self.poles[0].real < 0)

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
        return state_space(
            "whole_loop", (self.A, self.B, C, D), (*STATES, *INTEGRALS)[:order], references, outputs
        )

    def summary(self) -> str:
        """Stability and poles."""
        stability = "stable" if self.stable else "unstable"
        kind = "own integral action" if self.design.integral is not None else self.outer.outer
        return f"{stability}, {kind}; poles {poles(self.poles.tolist())} rad/s"

    def tables(self) -> tuple[Table, ...]:
        """The poles of the whole loop, slowest first, with their natural frequency and damping."""
        rows = (
            (number(p), number(abs(p)), number(-p.real / abs(p) if p else None)) for p in self.poles.tolist()
        )
        return (Table.of("whole loop", ("pole (rad/s)", "ωₙ (rad/s)", "ζ"), rows),)

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Remarks on the whole loop."""
        return tuple(_remarks(self))


def close_loop(design: Design, outer: OuterLoop = OuterLoop()) -> Loop:
    """Puts the outer loop around a design (Fig. 3, or Fig. 2 with ``outer="none"``).

    A method's own integral action takes the place of the PI loops.
    """
    kind = OWN if design.integral is not None else PI if outer.outer == "pi" else STATIC
    order = 4 if kind == STATIC else 6
    P, F, by_reference = np.empty((3, 2, 2))
    gains = np.array([[pi.kp, pi.kp / pi.ti] for pi in (outer.pitch, outer.yaw)])
    integral = np.zeros((2, 2)) if design.integral is None else np.array(design.integral, order="C")
    law, A, B = np.empty((2, order)), np.empty((order, order)), np.empty((order, 2))
    plant, cross = design.plant, outer.pairing == "cross"
    settings = (kind, gains, cross, outer.decoupler)
    engine().close(
        design.K, plant.statics, plant.A, plant.B, *settings, P, integral, F, law, by_reference, A, B
    )
    return Loop(design, outer, P, None if kind == STATIC else integral, F, law, by_reference, A, B)


def _remarks(loop: Loop) -> Iterator[Finding]:
    slowest = loop.poles[0]
    if loop.design.integral is not None:
        yield Finding(
            "own_integral_action",
            "info",
            "The method has its own integral action. The PI loops are not used.",
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
                f"The whole loop is unstable: it has a pole at {_words(slowest)} rad/s. Place all poles in the "
                "left half plane.",
            )
        for name, gains in zip(AXES, (loop.outer.pitch, loop.outer.yaw), strict=True):
            if gains.kp == 0:
                yield Finding(f"{name}_loop_open", "warning", f"The {name} loop is open: its gain is 0.")
    damping = min((-p.real / abs(p) for p in loop.poles.tolist() if p != 0), default=1.0)
    if loop.stable and damping < 0.2:
        yield Finding(
            "poorly_damped",
            "warning",
            f"The whole loop rings: its least damping ratio is {damping:.2f}. Lower the gains or raise the "
            "integral times.",
        )


def _words(pole: complex) -> str:
    text = f"{pole.real:.3g}" + (f" ± {abs(pole.imag):.3g}j" if pole.imag else "")
    return text.replace("-", "−")
