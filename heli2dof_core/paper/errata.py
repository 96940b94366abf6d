"""What is wrong in our copy of the paper, the corrected form, and the proof of each.

Only what the paper's own printed numbers confirm is an erratum of the paper; the rest is unclear in our copy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from . import proofs
from .evidence import EVIDENCE, Evidence
from .proofs import Proof


@dataclass(frozen=True)
class Erratum:
    """One mistake, of the paper or of our copy.

    Attributes:
        name: for programs.
        where: equation, table or section.
        printed, correct: both forms, in LaTeX.
        why: one sentence for people.
        effect: what it does to the printed results, or to who uses them.
        prove: computes the proof.
    """

    name: str
    where: str
    printed: str
    correct: str
    why: str
    effect: str
    prove: Callable[[], Proof]

    @property
    def evidence(self) -> Evidence | None:
        """Printed numbers of the paper that confirm it; None where our copy alone may be at fault."""
        return EVIDENCE.get(self.name)


ERRATA = (
    Erratum(
        "kinetic-energy",
        "Eq. 2",
        r"T = \tfrac12 m\left[(-l\dot\psi\sin\psi\cos\theta - l\dot\theta\cos\psi\sin\theta)^2 "
        r"+ (-l\dot\psi\cos\theta + l\dot\theta\sin\psi\sin\theta)^2 + (l\dot\theta\cos\theta)^2\right]",
        r"T = \tfrac12 m l^2(\dot\theta^2 + \dot\psi^2\cos^2\theta) + \tfrac12 J_p\dot\theta^2 + \tfrac12 J_y\dot\psi^2",
        "In our copy the second term lacks cosψ, squares and ½ are misplaced, and the rotational energy is missing. "
        "Eqs. 9 to 12 follow from the right form.",
        "None: the later equations are those of the right form.",
        proofs.kinetic_energy,
    ),
    Erratum(
        "christoffel",
        "Eq. 11",
        r"C = \begin{bmatrix} 0 & h\dot\psi \\ -2h\dot\psi & 0 \end{bmatrix}, \quad h = m l^2\sin\theta\cos\theta",
        r"C = \begin{bmatrix} 0 & h\dot\psi \\ -h\dot\psi & -h\dot\theta \end{bmatrix}",
        "The printed matrix gives the right torques C q̇, but it is not made of Christoffel symbols, as the text "
        "says: Ḋ − 2C is not skew. It also carries B_p and B_y on its diagonal, which Eq. 6 counts already.",
        "None on the motion; proofs of passivity that rest on skewness would fail.",
        proofs.christoffel,
    ),
    Erratum(
        "yaw-damping-in-A",
        "Eq. 13",
        r"A_{44} = -\frac{B_p}{\beta}",
        r"A_{44} = -\frac{B_y}{\beta}",
        "Yaw is damped by its own friction. And nothing is said of gravity: the model holds for deviations from "
        "the trim, at θ₀ = 0 with V_p = 12.5 V and V_y = −3.8 V on the motors.",
        "The printed results use 0.8 for B_y too, in place of 0.318.",
        proofs.yaw_damping_in_a,
    ),
    Erratum(
        "row-denominators",
        "Eq. 14",
        r"B = \begin{bmatrix} 0 & 0 \\ 0 & 0 \\ K_{pp}/\alpha & K_{py}/\beta \\ K_{yp}/\alpha & K_{yy}/\beta \end{bmatrix}",
        r"B = \begin{bmatrix} 0 & 0 \\ 0 & 0 \\ K_{pp}/\alpha & K_{py}/\alpha \\ K_{yp}/\beta & K_{yy}/\beta \end{bmatrix}",
        "A torque about an axis is divided by the inertia about that axis: denominators go by rows.",
        "Small, since α = 0.0865 and β = 0.0913 are near one another.",
        proofs.row_denominators,
    ),
    Erratum(
        "sign-of-feedback",
        "Eqs. 16–18",
        r"u = Kx + v, \quad A + BK",
        r"u = -Kx + v, \quad A - BK",
        "The printed K stabilizes with the minus sign only, as Eqs. 21 and 22 assume.",
        "Used with the printed sign the helicopter runs away.",
        proofs.sign_of_the_feedback,
    ),
    Erratum(
        "yaw-damping-in-K",
        "Eqs. 21, 22",
        r"-p_3 - p_4 - \frac{B_p}{\beta}",
        r"-p_3 - p_4 - \frac{B_y}{\beta}",
        "As in Eq. 13, four times.",
        "The yaw pair misses: the sum of its poles is off by (B_p − B_y)/β.",
        proofs.yaw_damping_in_k,
    ),
    Erratum(
        "yaw-inertia-in-K",
        "Eqs. 21, 22",
        r"k_{12}, k_{14}, k_{22}, k_{24} \propto \alpha",
        r"k_{12}, k_{14}, k_{22}, k_{24} \propto \beta",
        "These four entries act about the yaw axis. As printed they are exact for a B with α in all four entries.",
        "The yaw pair misses by the ratio α/β, even where B_p = B_y.",
        proofs.yaw_inertia_in_k,
    ),
    Erratum(
        "table-values",
        "Table I",
        r"m = 1.3872,\ l = 0.1855,\ J_y = 0.0431,\ K_{pp} = 0.2041",
        r"m = 1.39,\ l = 0.186,\ J_y = 0.0432,\ K_{pp} = 0.204,\ B_p = B_y = 0.8",
        "The printed results follow, digit for digit, from the second set, and not from the table.",
        "Anyone who uses the table gets different gains.",
        proofs.table_values,
    ),
    Erratum(
        "units",
        "Table I",
        r"[B_p] = [B_y] = \text{N/V}, \quad [l] = \text{ms}",
        r"[B_p] = [B_y] = \text{N·m·s/rad}, \quad [l] = \text{m}",
        "Damping times angular rate is a torque; a length is in metres.",
        "None on the numbers.",
        proofs.units,
    ),
    Erratum(
        "unit-step",
        "Section IV",
        r"r = 1\ \text{rad}, \quad k_p = 30\ \text{V/rad}",
        r"|r| \lesssim 10^\circ",
        "30 V at the first instant is beyond both motors, and 57° beyond the pitch travel: the paper simulates "
        "without limits.",
        "Figs. 4 and 5 show what no such rig does; ours are drawn with and without limits.",
        proofs.unit_step,
    ),
    Erratum(
        "lower-gain",
        "Section III",
        r"\lVert K\rVert \ll \lVert K_{\text{Ackermann}}\rVert, \lVert K_{\text{Bass–Gura}}\rVert",
        r"\det\,[Bf\ \ ABf\ \ A^2Bf\ \ A^3Bf] = 0 \quad \forall f",
        "At θ₀ = 0 A has the eigenvalue 0 with two 1×1 Jordan blocks, so no single input f can control it: "
        "there is no Ackermann or Bass–Gura gain to compare with, unless a first feedback comes before.",
        "The claim cannot be tested there. Where it can, the full-rank norm is indeed far lower.",
        proofs.no_dyadic_design,
    ),
    Erratum(
        "no-interaction",
        "Section IV",
        r"\lambda_{11}(0) = 1",
        r"\lambda_{11}(0) = 1 + \frac{73}{7127}\,\frac{p_3 p_4}{p_1 p_2} = 1.0069",
        "At zero frequency there is nearly no interaction, not none.",
        "None: the pairing and the diagonal dominance stand.",
        proofs.interaction_at_rest,
    ),
)
"""All of them, in the order of the paper."""
CONFIRMED = tuple(erratum for erratum in ERRATA if erratum.evidence is not None)
"""The paper's errata: its own numbers confirm them."""
