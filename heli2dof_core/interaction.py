"""Interaction between the two loops of a design: RGA, pairing with its reason, dominance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .augmentation import inner_loop
from .design import Design
from .eigenvalues import resolvent
from .findings import Finding, Severity
from .relative_gains import diagonal_dominance
from .rotors import Actuators
from .scenario import Pairing
from .signals import INPUTS, OUTPUTS, Complexes, Floats
from .tables import Shown, Table, latex_matrix, number


@dataclass(frozen=True, repr=False)
class Interaction(Shown):
    """Interaction between the two loops at steady state.

    Attributes:
        relative_gain: λ₁₁; None without steady state.
        in_use: the pairing of the loops.
    """

    relative_gain: float | None
    in_use: Pairing = "diagonal"

    @property
    def rga(self) -> Floats | None:
        """2×2, rows are outputs θ, ψ, columns inputs V_p, V_y; None without steady state."""
        return None if self.relative_gain is None else np.array(self.entries)

    @property
    def entries(self) -> tuple[tuple[float, float], ...]:
        """Its rows; none without steady state."""
        if self.relative_gain is None:
            return ()
        diagonal, cross = self.relative_gain, 1 - self.relative_gain
        return (diagonal, cross), (cross, diagonal)

    @property
    def advised(self) -> Pairing:
        """The pairing with a relative gain above ½, which is the one nearer to 1."""
        return "cross" if self.relative_gain is not None and self.relative_gain < 0.5 else "diagonal"

    @property
    def pairing(self) -> tuple[tuple[str, str], ...]:
        """(output, input) names that RGA and Niederlinski index advise; none without steady state."""
        if self.relative_gain is None:
            return ()
        return _PAIRS[self.advised]

    @property
    def niederlinski(self) -> float | None:
        """Det Ĝ(0)/Π ĝᵢᵢ(0) = 1/λ₁₁ for diagonal pairing; None where a ĝᵢᵢ(0) is 0."""
        return 1 / self.relative_gain if self.relative_gain else None

    @property
    def niederlinski_cross(self) -> float | None:
        """The same for the cross pairing, 1/λ₁₂."""
        return 1 / (1 - self.relative_gain) if self.relative_gain not in (None, 1.0) else None

    @property
    def reason(self) -> str:
        """Why, in words."""
        if self.relative_gain is None:
            return "A pole lies at 0: there is no steady state, so no RGA."
        return _reason(self.relative_gain)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What the RGA says against the pairing in use."""
        if self.relative_gain is None or self.advised == self.in_use:
            return ()
        return (_against(self.relative_gain, self.advised, self.reason),)

    def summary(self) -> str:
        """What λ₁₁ means for the pairing."""
        return self.reason

    def tables(self) -> tuple[Table, ...]:
        """RGA and Niederlinski indices; none without steady state."""
        if self.rga is None:
            return ()
        indices = (("diagonal", number(self.niederlinski)), ("cross", number(self.niederlinski_cross)))
        outputs, inputs = ([s.symbol for s in signals] for signals in (OUTPUTS, INPUTS))
        return (
            Table.matrix("RGA at s = 0", self.rga, outputs, inputs),
            Table.of("Niederlinski index", ("pairing", "index"), indices),
        )

    def _repr_latex_(self) -> str | None:
        return None if self.rga is None else latex_matrix(r"\Lambda", self.rga)


_PAIRS: dict[Pairing, tuple[tuple[str, str], ...]] = {
    "diagonal": tuple((y.name, u.name) for y, u in zip(OUTPUTS, INPUTS, strict=True)),
    "cross": tuple((y.name, u.name) for y, u in zip(OUTPUTS, INPUTS[::-1], strict=True)),
}


def interaction(design: Design, pairing: Pairing = "diagonal") -> Interaction:
    """RGA = Ĝ(0) ∘ Ĝ(0)⁻ᵀ (Eq. 23; Bristol 1966), from Ĝ(0)⁻¹, which always exists; `pairing` is in use.

    There is none exactly where a pole of A − BK lies at 0 (`Design.steady_state_determinant`).

    Of two by two gains the pairing with a relative gain above ½ is the one nearer to 1, and the only
    one with a positive Niederlinski index unless both have: the index is 1/λ₁₁, and 1/λ₁₂ crosswise.
    """
    (a, b), (c, d) = design.steady_state_inverse.tolist()
    determinant = design.steady_state_determinant
    if not determinant:
        return Interaction(None, pairing)
    if design.actuators is not None and design.rotor_poles is None:
        (a, b), (c, d) = _on_the_machine(design, design.actuators).tolist()
        determinant = a * d - b * c
        if not determinant:
            return Interaction(None, pairing)
    return Interaction(a * d / determinant, pairing)  # Ĝ(0) = adj(Ĝ(0)⁻¹)/det, so λ₁₁ = ĝ₁₁ (Ĝ⁻¹)₁₁


def _on_the_machine(design: Design, actuators: Actuators) -> Floats:
    """Ĝ(0)⁻¹ where a change of voltage acts φ′ times as hard as the design knows."""
    slope = np.where(actuators.slope > 0.0, actuators.slope, 1.0)[:, None]
    return design.steady_state_inverse + (1.0 - 1.0 / slope) * design.plant.statics


def closed_loop_response(design: Design, frequencies: Floats) -> Complexes:
    """Ĝ(jω) at `frequencies` (rad/s), shape (n, 2, 2), rad/V (Eq. 17), on the rig's own rotors."""
    A, B = inner_loop(design)
    return resolvent(A, B, frequencies)[:, :2]


def rga_over_frequency(design: Design, frequencies: Floats) -> Complexes:
    """RGA(jω) at `frequencies` (rad/s), shape (n, 2, 2); very large at a pole, where it does not exist.

    Of two by two gains one entry tells all; det Ĝ may be as small as it likes, which an inverse may not.
    """
    G = closed_loop_response(design, frequencies)
    straight, crosswise = G[:, 0, 0] * G[:, 1, 1], G[:, 0, 1] * G[:, 1, 0]
    determinant = straight - crosswise
    return np.moveaxis(np.array([[straight, -crosswise], [-crosswise, straight]]) / determinant, 2, 0)


def dominance_over_frequency(design: Design, frequencies: Floats) -> tuple[Floats, Floats]:
    """Ratios of off-diagonal to diagonal size of Ĝ(jω), by rows and by columns, each (n, 2).

    The paper's claim that the system is diagonally dominant: all below 1 (Section IV).
    """
    return diagonal_dominance(closed_loop_response(design, frequencies))


def _reason(diagonal: float) -> str:
    """What λ₁₁ means for the pairing."""
    cross = 1 - diagonal
    if abs(diagonal - 1) < 0.05:
        return f"λ₁₁ = {diagonal:.3f}, near 1: the two loops hardly interact."
    if diagonal >= 0.5:
        strength = "moderate" if diagonal < 1.5 else "strong"
        return (
            f"λ₁₁ = {diagonal:.3f}: closing the other loop divides a loop's gain by that, a {strength} interaction. "
            f"Crosswise λ₁₂ = {cross:.3f} is farther from 1"
            + (" and negative: integral action would be unstable." if cross < 0 else ".")
        )
    if diagonal < 0:
        return (
            f"λ₁₁ = {diagonal:.3f} is negative: closing the other loop reverses the sign of a loop's gain. The "
            f"Niederlinski index is {1 / diagonal:.2f}: integral action in both loops is unstable."
        )
    index = "" if diagonal == 0 else f" (Niederlinski index {1 / diagonal:.2f} > 0)"
    return (
        f"λ₁₁ = {diagonal:.3f}, below 0.5: at steady state the cross paths outweigh the direct ones. Crosswise "
        f"λ₁₂ = {cross:.3f} is nearer to 1. This does not make diagonal pairing unstable{index}."
    )


def _against(diagonal: float, advised: Pairing, reason: str) -> Finding:
    own = diagonal if advised == "cross" else 1 - diagonal
    severity: Severity = "warning" if own >= 0 else "error"
    if advised == "cross":
        words = f"The RGA advises against the diagonal pairing: {reason} Try the cross pairing."
        return Finding("pairing_cross", severity, words)
    words = f"The RGA advises against the cross pairing: {reason} Try the diagonal pairing."
    return Finding("pairing_diagonal", severity, words)
