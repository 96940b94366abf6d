"""What the symbols in the derivation's formulas mean: parameters, short names, matrices and signals."""

from __future__ import annotations

from dataclasses import dataclass

from ..components import COMPONENT_INFO
from ..symbolic.names import NAMES, gain_names
from .equation import Chapter

_ENERGIES: tuple[Chapter, ...] = ("mechanics",)
_CONTROL: tuple[Chapter, ...] = ("linear", "feedback", "interaction", "loops")


@dataclass(frozen=True)
class Term:
    """One symbol as it stands in a formula.

    Attributes:
        name: as in the replies where it has a value there, such as ``K_pp``, ``alpha``, ``A_bar``.
        latex: as it is written; with an opening bracket only where it is followed by one.
        meaning, unit: in words, SI; the unit is empty where entries have different ones.
        chapters: where it means this; empty: wherever nothing else is said.
    """

    name: str
    latex: str
    meaning: str
    unit: str
    chapters: tuple[Chapter, ...] = ()


def _components() -> list[Term]:
    """The parts of Eqs. 1 and 8, with the paper's indices."""
    terms = []
    for name, part in COMPONENT_INFO.items():
        base, _, index = part.symbol.partition("_")
        terms.append(Term(name, f"{base}_{{{index}}}", part.meaning, part.unit))
    return terms


TERMS: tuple[Term, ...] = (
    *(Term(n.name, n.latex, n.meaning, n.unit) for n in NAMES if n.name not in ("sin_0", "cos_0")),
    *_components(),
    *(Term(n.name, n.latex, n.meaning, n.unit) for n in gain_names()),
    Term("beta", r"\beta", "effective inertia about yaw at θ = 0, J_y + m l²", "kg·m²"),
    Term("theta_ddot", r"\ddot\theta", "pitch acceleration", "rad/s²"),
    Term("psi_ddot", r"\ddot\psi", "yaw acceleration", "rad/s²"),
    Term("kinetic", "T", "kinetic energy", "J", _ENERGIES),
    Term("kinetic", "K", "kinetic energy, as Eq. 3 calls it", "J", _ENERGIES),
    Term("potential", "P", "potential energy, of gravity and of the stiffness", "J", _ENERGIES),
    Term("lagrangian", "L", "Lagrangian, kinetic less potential energy", "J", _ENERGIES),
    Term("h", "h", "m l² sinθ cosθ, short for this matrix", "kg·m²", _ENERGIES),
    Term("q", "q", "generalized coordinates, the angles θ and ψ", "rad", _ENERGIES),
    Term("q", "q_i", "generalized coordinate, the angle θ or ψ", "rad", _ENERGIES),
    Term("q_dot", r"\dot q", "rates of the generalized coordinates", "rad/s", _ENERGIES),
    Term("q_dot", r"\dot q_i", "rate of a generalized coordinate", "rad/s", _ENERGIES),
    Term("q_ddot", r"\ddot q", "accelerations of the generalized coordinates", "rad/s²", _ENERGIES),
    Term("forces", "Q", "generalized forces: torques of motors and friction", "N·m", _ENERGIES),
    Term(
        "forces", "Q_i", "generalized force: torque of motors and friction about one axis", "N·m", _ENERGIES
    ),
    Term("forces", "Q_1", "generalized force about pitch", "N·m", _ENERGIES),
    Term("forces", "Q_2", "generalized force about yaw", "N·m", _ENERGIES),
    Term("thrust", r"\tau", "thrust torques of both motors about both axes", "N·m"),
    Term("thrust", r"\tau_p", "thrust torque about pitch", "N·m", _ENERGIES),
    Term("thrust", r"\tau_y", "thrust torque about yaw", "N·m", _ENERGIES),
    Term("mass_matrix", "D(", "mass matrix", "kg·m²", _ENERGIES),
    Term("mass_matrix", "D", "mass matrix", "kg·m²", _ENERGIES),
    Term("coriolis", "C(", "Coriolis and centrifugal torques per rate", "N·m·s/rad", _ENERGIES),
    Term("coriolis", "C", "Coriolis and centrifugal torques per rate", "N·m·s/rad", _ENERGIES),
    Term("gravity", "g(", "gravity torques", "N·m", _ENERGIES),
    Term("x", "x", "state: θ, ψ and their rates, as deviations from rest", ""),
    Term("x_dot", r"\dot x", "the state's rate of change", ""),
    Term("u", "u", "voltages of both motors, as deviations from the trim", "V"),
    Term("v", "v", "commands of the inner loop, one per motor", "V"),
    Term("y", "y", "outputs, the angles θ and ψ", "rad"),
    Term("trim", r"V_{\text{trim}}", "voltages that hold the rig at rest", "V"),
    Term("A", "A", "system matrix", "", _CONTROL),
    Term("A_44", "A_{44}", "last entry of the system matrix, the decay of the yaw rate", "1/s", _CONTROL),
    Term("B", "B", "input matrix", "", _CONTROL),
    Term("C", "C", "output matrix, picks the angles out of the state", "", _CONTROL),
    Term("sigma", r"\sigma(", "set of eigenvalues", "rad/s", _CONTROL),
    Term("sigma_1", r"\sigma_1", "controllability index of the pitch motor", "1", _CONTROL),
    Term("sigma_2", r"\sigma_2", "controllability index of the yaw motor", "1", _CONTROL),
    Term("T", "T", "transformation to the canonical form, z = Tx", "", _CONTROL),
    Term("Q", "Q", "nonzero rows of TB", "", _CONTROL),
    Term("A_bar", r"\bar A", "system matrix in the canonical form", "", _CONTROL),
    Term("B_bar", r"\bar B", "input matrix in the canonical form", "", _CONTROL),
    Term("K_bar", r"\bar K", "gain in the canonical form", "", _CONTROL),
    Term("K", "K", "state feedback, u = −Kx + v", "V/rad, V·s/rad", _CONTROL),
    Term("I", "I", "identity matrix", "1", _CONTROL),
    Term("f", "f", "direction in which one input would drive both motors", "1", _CONTROL),
    Term("d_1", "d_1(", "desired polynomial of the first chain", "", _CONTROL),
    Term("d_2", "d_2(", "desired polynomial of the second chain", "", _CONTROL),
    Term("G", r"\hat G(", "transfer matrix of the closed loop, from v to y", "rad/V", _CONTROL),
    Term("rga", r"\text{RGA}", "relative gain array at s = 0", "1", _CONTROL),
    Term("lambda_11", r"\lambda_{11}", "relative gain of the diagonal pairing", "1", _CONTROL),
    Term("PI", r"\text{PI}", "PI controller of one axis", "V/rad", _CONTROL),
    Term("kp", "k_p", "gain of a PI controller, pitch and yaw", "V/rad", _CONTROL),
    Term("ti", "T_i", "integral time of a PI controller, pitch and yaw", "s", _CONTROL),
    Term("r", "r", "reference of an angle", "rad", _CONTROL),
)
"""Terms that name chapters come after those that hold everywhere, and go before them where they apply."""
