"""Every numbered equation and figure of the paper: as printed, as derived, and what became of it."""

# pyright: reportArgumentType=false, reportCallIssue=false, reportOperatorIssue=false, reportAttributeAccessIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import sympy as sp

from ..couplings import Structure
from ..symbolic.full_rank import full_rank, plant
from ..symbolic.linearization import linear_model
from ..symbolic.luenberger import controllability_matrix
from ..symbolic.mechanics import mechanics
from ..symbolic.names import LATEX, psi, psi_dot, theta, theta_dot
from ..symbolic.render import grouped
from ..symbolic.rga import relative_gain_array, transfer_matrix
from . import as_printed

Status = Literal["reproduced", "corrected", "explained"]
Chapter = Literal["machine", "mechanics", "linear", "feedback", "interaction", "loops"]


@dataclass(frozen=True)
class Equation:
    """One numbered equation, table or figure.

    Attributes:
        number: as in the paper, such as ``Eq. 13``.
        title: what it says.
        chapter: where it stands in the derivation.
        printed: LaTeX as printed in our copy; empty for a picture.
        derived: computes the LaTeX of what heli2dof derives or uses; None where the printed form is it.
        status: reproduced as printed, corrected, or explained in words.
        note: what a reader should know.
        errata: names of the errata that concern it.
    """

    number: str
    title: str
    chapter: Chapter
    printed: str
    derived: Callable[[], str] | None
    status: Status
    note: str = ""
    errata: tuple[str, ...] = ()


def _latex(expression: Any) -> str:
    return sp.latex(expression, symbol_names=LATEX, mat_delim="[")


def _named(name: str, value: Callable[[], Any]) -> Callable[[], str]:
    return lambda: f"{name} = {_latex(value())}"


def _coriolis() -> sp.Matrix:
    """Christoffel's C(q, q̇) from the derived D(q)."""
    D, q, rates = mechanics().mass_matrix, (theta, psi), (theta_dot, psi_dot)

    def symbol(i: int, j: int) -> sp.Expr:
        terms = (
            (D[i, j].diff(q[k]) + D[i, k].diff(q[j]) - D[j, k].diff(q[i])) / 2 * rates[k] for k in range(2)
        )
        return sp.Add(*terms)

    return sp.Matrix(2, 2, symbol)


def _gravity() -> sp.Matrix:
    """g(q) = ∂V/∂q, torques that hold the rig at rest."""
    return sp.Matrix([mechanics().potential.diff(theta), mechanics().potential.diff(psi)])


def _thrust() -> sp.Matrix:
    return mechanics().torque.subs({theta_dot: 0, psi_dot: 0})


def _definitions() -> str:
    pairs = [
        (name, linear_model().definitions[name]) for name in linear_model().definitions if str(name) != "a"
    ]
    return r",\quad ".join(f"{_latex(name)} = {_latex(value)}" for name, value in pairs)


_TRIM = r"V_{\text{trim}} = "

EQUATIONS = (
    Equation(
        "Fig. 1",
        "Free body diagram",
        "machine",
        "",
        None,
        "reproduced",
        "Redrawn from the text; our copy has no picture.",
    ),
    Equation(
        "Eq. 1",
        "Centre of mass",
        "machine",
        r"l = \frac{(m_{m,p} + m_{shield})\, r_p + (m_{m,y} + m_{shield})\, r_y}{m_{m,p} + m_{m,y} + 2 m_{shield}}",
        None,
        "reproduced",
        "The arms lie on opposite sides of the pivot, so one would expect their difference; Quanser's files add "
        "them too. Also J_p holds both point masses already, so α counts part of them twice.",
    ),
    Equation(
        "Table I",
        "Body parameters",
        "machine",
        "",
        None,
        "corrected",
        "Two units are wrong, and the results used other values: see the numbers below.",
        ("table-values", "units"),
    ),
    Equation(
        "Eq. 2",
        "Kinetic energy",
        "mechanics",
        r"T = \tfrac12 m\left((-l\dot\psi\sin\psi\cos\theta - l\dot\theta\cos\psi\sin\theta)^2 "
        r"+ \tfrac12(-l\dot\psi\cos\theta + l\dot\theta\sin\psi\sin\theta)^2 + l^2\dot\theta\cos\theta^2\right)^2",
        _named("T", lambda: sp.collect(mechanics().kinetic, [theta_dot, psi_dot])),
        "corrected",
        "From the centre of mass at l (cosψ cosθ, −sinψ cosθ, sinθ), and both axes' own inertia.",
        ("kinetic-energy",),
    ),
    Equation(
        "Eq. 3",
        "Lagrangian",
        "mechanics",
        r"L = K - P",
        _named("L", lambda: mechanics().kinetic - mechanics().potential),
        "reproduced",
        "Potential energy is that of gravity and, for the Aero rigs, of the pitch stiffness K_s.",
    ),
    Equation(
        "Eq. 4",
        "Lagrange's equations",
        "mechanics",
        r"\frac{\partial}{\partial t}\frac{\partial L}{\partial \dot q_i} - \frac{\partial L}{\partial q_i} = Q_i",
        lambda: r"\frac{d}{dt}\frac{\partial L}{\partial \dot q_i} - \frac{\partial L}{\partial q_i} = Q_i",
        "explained",
        "Our copy has lost the dots. The first derivative is the total one.",
    ),
    Equation(
        "Eq. 5",
        "State",
        "mechanics",
        r"x = [\theta\ \ \psi\ \ \dot\theta\ \ \dot\psi]^T",
        None,
        "reproduced",
        "Printed as q = [q₁ q₂ q₃ q₄], while Eqs. 4 and 9 to 12 call q the two angles alone.",
    ),
    Equation(
        "Eq. 6",
        "Generalized forces",
        "mechanics",
        r"Q_1 = \tau_p - B_p\dot\theta, \quad Q_2 = \tau_y - B_y\dot\psi",
        lambda: f"Q = {_latex(mechanics().torque)}",
        "reproduced",
    ),
    Equation(
        "Eq. 7",
        "Thrust torques",
        "mechanics",
        r"\tau_p = K_{pp}V_p + K_{py}V_y, \quad \tau_y = K_{yp}V_p + K_{yy}V_y",
        None,
        "reproduced",
        "Each propeller's thrust turns its own axis, its drag the other.",
    ),
    Equation(
        "Eq. 8",
        "Thrust constants",
        "machine",
        r"K_{pp} = K_{f,p} r_p,\quad K_{yy} = K_{f,y} r_y,\quad K_{py} = \frac{K_{t,y}}{R_{m,y}},\quad K_{yp} = \frac{K_{t,p}}{R_{m,p}}",
        None,
        "reproduced",
        "With the design file's components it gives Table I's constants, rounded.",
    ),
    Equation(
        "Eq. 9",
        "Equations of motion",
        "mechanics",
        r"D(q)\ddot q + C(q,\dot q)\dot q + g(q) = \tau",
        lambda: r"\begin{bmatrix}\ddot\theta\\\ddot\psi\end{bmatrix} = " + _latex(mechanics().accelerations),
        "reproduced",
        "Solved for the accelerations: this is what the nonlinear simulation integrates.",
    ),
    Equation(
        "Eq. 10",
        "Mass matrix",
        "mechanics",
        r"D(q) = \begin{bmatrix} J_p + m l^2 & 0 \\ 0 & J_y + m l^2\cos^2\theta \end{bmatrix}",
        _named("D", lambda: mechanics().mass_matrix),
        "reproduced",
    ),
    Equation(
        "Eq. 11",
        "Coriolis and centrifugal torques",
        "mechanics",
        r"C = \begin{bmatrix} B_p & m l^2\sin\theta\cos\theta\,\dot\psi \\ -2 m l^2\sin\theta\cos\theta\,\dot\psi & B_y \end{bmatrix}",
        _named("C", _coriolis),
        "corrected",
        "Derived from D by Christoffel's symbols; friction stays in Eq. 6.",
        ("christoffel",),
    ),
    Equation(
        "Eq. 12",
        "Gravity and thrust",
        "mechanics",
        r"g(q) = \begin{bmatrix} m g l\cos\theta \\ 0 \end{bmatrix},\quad \tau = \begin{bmatrix} K_{pp}V_p + K_{py}V_y \\ K_{yp}V_p + K_{yy}V_y \end{bmatrix}",
        lambda: f"g = {_latex(_gravity())},\\quad \\tau = {_latex(_thrust())}",
        "reproduced",
        "The text calls g “gravitational acceleration”; it is the gravity torque.",
    ),
    Equation(
        "trim",
        "Rest at θ₀",
        "linear",
        "",
        lambda: _TRIM + _latex(linear_model().trim),
        "explained",
        "The paper does not speak of it: the linear model holds for deviations from these voltages.",
        ("yaw-damping-in-A",),
    ),
    Equation(
        "Eq. 13",
        "System matrix",
        "linear",
        _latex(as_printed.system_matrix()).join(("A = ", "")),
        _named("A", lambda: linear_model().A),
        "corrected",
        "a is 0 at θ₀ = 0 without stiffness, the paper's case.",
        ("yaw-damping-in-A",),
    ),
    Equation(
        "Eq. 14",
        "Input matrix",
        "linear",
        _latex(as_printed.input_matrix()).join(("B = ", "")),
        _named("B", lambda: linear_model().B),
        "corrected",
        "",
        ("row-denominators",),
    ),
    Equation(
        "Eq. 15",
        "Short names",
        "linear",
        r"\alpha = J_p + m l^2,\quad \beta = J_y + m l^2,\quad \gamma = K_{py}K_{yp} - K_{pp}K_{yy}",
        _definitions,
        "reproduced",
        "β₀ is β at θ₀ = 0.",
    ),
    Equation(
        "Fig. 2",
        "State feedback",
        "feedback",
        "",
        None,
        "reproduced",
        "Redrawn, with the sign that is right.",
    ),
    Equation(
        "Eq. 16",
        "Closed loop",
        "feedback",
        r"\dot x = (A + BK)x + Bv,\quad y = Cx",
        lambda: r"\dot x = (A - BK)x + Bv,\quad y = Cx",
        "corrected",
        "",
        ("sign-of-feedback",),
    ),
    Equation(
        "Eq. 17",
        "Closed-loop transfer matrix",
        "interaction",
        r"\hat G(s) = C(sI - A - BK)^{-1}B",
        lambda: r"\hat G(s) = " + _latex(grouped(transfer_matrix(Structure()))),
        "corrected",
        "",
        ("sign-of-feedback",),
    ),
    Equation(
        "Eq. 18",
        "Desired poles",
        "feedback",
        r"\sigma(A + BK) = \{p_1, p_2, p_3, p_4\}",
        lambda: r"\sigma(A - BK) = \{p_1, p_2, p_3, p_4\}",
        "corrected",
        "",
        ("sign-of-feedback",),
    ),
    Equation(
        "controllability",
        "Controllability",
        "feedback",
        "",
        lambda: (
            r"\left[B\ \ AB\ \ A^2B\ \ A^3B\right] = " + _latex(controllability_matrix(*plant()).to_Matrix())
        ),
        "explained",
        "“A simple test” is all that the paper says. The indices are (2, 2) exactly where γ ≠ 0.",
    ),
    Equation(
        "Eq. 19",
        "Gain from the canonical form",
        "feedback",
        r"K = Q^{-1}\bar K T",
        lambda: (
            r"T = "
            + _latex(grouped(full_rank(Structure()).form.T))
            + r",\quad Q = "
            + _latex(grouped(full_rank(Structure()).form.Q))
        ),
        "reproduced",
        "The paper gives neither T nor Q. These, Luenberger's with the basis shifted by K_py/K_pp, lead to its K.",
    ),
    Equation(
        "Eq. 20",
        "Shape of K",
        "feedback",
        r"K = \begin{bmatrix} k_{11} & k_{12} & k_{13} & k_{14} \\ k_{21} & k_{22} & k_{23} & k_{24} \end{bmatrix}",
        None,
        "reproduced",
    ),
    Equation(
        "Eqs. 21, 22",
        "Gain in terms of the poles",
        "feedback",
        r"K = " + _latex(as_printed.gain()),
        _named("K", lambda: grouped(full_rank(Structure()).K)),
        "corrected",
        "",
        ("yaw-damping-in-K", "yaw-inertia-in-K"),
    ),
    Equation(
        "Eq. 23",
        "Relative gain array",
        "interaction",
        r"\text{RGA} = \begin{bmatrix} 1 + \frac{73 p_3p_4}{7127 p_1p_2} & -\frac{73 p_3p_4}{7127 p_1p_2} \\ "
        r"-\frac{73 p_3p_4}{7127 p_1p_2} & 1 + \frac{73 p_3p_4}{7127 p_1p_2} \end{bmatrix}",
        lambda: r"\text{RGA} = " + _latex(grouped(relative_gain_array(Structure()))),
        "reproduced",
        "“No interaction at zero frequency” is not quite what it says.",
        ("no-interaction",),
    ),
    Equation(
        "Fig. 3",
        "PI control of the overall system",
        "loops",
        r"\text{PI}(s) = 30\left(1 + \frac{1}{0.1\, s}\right)",
        None,
        "reproduced",
        "The zero at −10 cancels the placed pole p₂ = −10; the loop's other poles are not those placed.",
    ),
    Equation(
        "Fig. 4",
        "Step of the pitch reference",
        "loops",
        "",
        None,
        "explained",
        "Our copy has no curve: redrawn from the model.",
        ("unit-step",),
    ),
    Equation(
        "Fig. 5",
        "Step of the yaw reference",
        "loops",
        "",
        None,
        "explained",
        "Our copy has no curve: redrawn from the model.",
        ("unit-step",),
    ),
)
"""In the order of the paper, where the derivation does not need another."""
