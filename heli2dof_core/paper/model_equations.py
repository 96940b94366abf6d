"""From the machine to the linear model: Fig. 1, Table I, Eqs. 1–15, in the order of the derivation."""

# pyright: reportArgumentType=false, reportCallIssue=false, reportOperatorIssue=false, reportAttributeAccessIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

import sympy as sp

from ..symbolic.linearization import linear_model
from ..symbolic.mechanics import mechanics
from ..symbolic.names import latex, psi, psi_dot, theta, theta_dot
from . import as_printed
from .equation import Equation, named


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
    return r",\quad ".join(
        f"{latex(name)} = {latex(value)}" for name, value in linear_model().definitions.items()
    )


MACHINE = (
    Equation(
        number="Fig. 1",
        title="Free body diagram",
        plain="Two propellers on one beam make four torques: each turns its own axis and disturbs the other.",
        note="Redrawn from the text; our copy has no picture.",
    ),
    Equation(
        number="Eq. 1",
        title="Centre of mass",
        plain="All moving parts together weigh as if they sat in one point, at the distance $l$ from the pivot.",
        printed=r"l = \frac{(m_{m,p} + m_{shield})\, r_p + (m_{m,y} + m_{shield})\, r_y}{m_{m,p} + m_{m,y} + 2 m_{shield}}",
        note="The arms lie on opposite sides of the pivot, so one would expect their difference; Quanser's files "
        "add them too. Also J_p holds both point masses already, so α counts part of them twice.",
    ),
    Equation(
        number="Eq. 8",
        title="Thrust constants",
        plain="A volt on a motor becomes thrust, and thrust times its arm a torque; the motor's drag turns the "
        "other axis.",
        printed=r"K_{pp} = K_{f,p} r_p,\quad K_{yy} = K_{f,y} r_y,\quad K_{py} = \frac{K_{t,y}}{R_{m,y}},\quad K_{yp} = \frac{K_{t,p}}{R_{m,p}}",
        note="With the design file's components it gives Table I's constants, rounded.",
    ),
    Equation(
        number="Table I",
        title="Body parameters",
        plain="These numbers, and no others, tell one rig from another.",
        status="corrected",
        note="Two units are wrong, and the results used other values: see the numbers below.",
        errata=("table-values", "units"),
    ),
)

MECHANICS = (
    Equation(
        number="Eq. 5",
        title="State",
        plain="Two angles say where the rig is and their two rates where it is going; nothing else is needed to "
        "predict its motion.",
        printed=r"x = [\theta\ \ \psi\ \ \dot\theta\ \ \dot\psi]^T",
        note="Printed as q = [q₁ q₂ q₃ q₄], while Eqs. 4 and 9 to 12 call q the two angles alone.",
    ),
    Equation(
        number="Eq. 2",
        title="Kinetic energy",
        plain="Energy of motion: the centre of mass moves on a sphere, and the body turns about both axes.",
        printed=r"T = \tfrac12 m\left((-l\dot\psi\sin\psi\cos\theta - l\dot\theta\cos\psi\sin\theta)^2 "
        r"+ \tfrac12(-l\dot\psi\cos\theta + l\dot\theta\sin\psi\sin\theta)^2 + l^2\dot\theta\cos\theta^2\right)^2",
        derived=named("T", lambda: sp.collect(mechanics().kinetic, [theta_dot, psi_dot])),
        status="corrected",
        note="From the centre of mass at l (cosψ cosθ, −sinψ cosθ, sinθ), and both axes' own inertia.",
        errata=("kinetic-energy",),
    ),
    Equation(
        number="potential energy",
        title="Potential energy",
        plain="Energy of position: raising the nose lifts the centre of mass, and in the Aero rigs bends a spring.",
        derived=named("P", lambda: mechanics().potential),
        status="explained",
        note="The paper does not write it out; Eq. 12's gravity torque is its derivative.",
    ),
    Equation(
        number="Eq. 3",
        title="Lagrangian",
        plain="Kinetic less potential energy: one function that holds the whole motion.",
        printed=r"L = K - P",
        derived=named("L", lambda: mechanics().kinetic - mechanics().potential),
        note="The kinetic energy is called K here and T in Eq. 2.",
    ),
    Equation(
        number="Eq. 4",
        title="Lagrange's equations",
        plain="Differentiating the Lagrangian, once per angle, gives the balance of torques about each axis.",
        printed=r"\frac{\partial}{\partial t}\frac{\partial L}{\partial \dot q_i} - \frac{\partial L}{\partial q_i} = Q_i",
        derived=lambda: (
            r"\frac{d}{dt}\frac{\partial L}{\partial \dot q_i} - \frac{\partial L}{\partial q_i} = Q_i"
        ),
        status="explained",
        note="Our copy has lost the dots. The first derivative is the total one.",
    ),
    Equation(
        number="Eq. 6",
        title="Generalized forces",
        plain="What no energy tells: the motors push and friction brakes.",
        printed=r"Q_1 = \tau_p - B_p\dot\theta, \quad Q_2 = \tau_y - B_y\dot\psi",
        derived=lambda: f"Q = {latex(mechanics().torque)}",
    ),
    Equation(
        number="Eq. 7",
        title="Thrust torques",
        plain="Each propeller's thrust turns its own axis, its drag the other; both grow with the voltage.",
        printed=r"\tau_p = K_{pp}V_p + K_{py}V_y, \quad \tau_y = K_{yp}V_p + K_{yy}V_y",
    ),
    Equation(
        number="Eq. 9",
        title="Equations of motion",
        plain="Inertia, Coriolis and gravity torques balance the motors and friction at every instant.",
        printed=r"D(q)\ddot q + C(q,\dot q)\dot q + g(q) = \tau",
        derived=lambda: (
            r"\begin{bmatrix}\ddot\theta\\\ddot\psi\end{bmatrix} = " + latex(mechanics().accelerations)
        ),
        note="Solved for the accelerations: this is what the nonlinear simulation integrates.",
    ),
    Equation(
        number="Eq. 10",
        title="Mass matrix",
        plain="How hard each axis is to accelerate; yaw gets easier as the nose leaves the horizontal.",
        printed=r"D(q) = \begin{bmatrix} J_p + m l^2 & 0 \\ 0 & J_y + m l^2\cos^2\theta \end{bmatrix}",
        derived=named("D(q)", lambda: mechanics().mass_matrix),
    ),
    Equation(
        number="Eq. 11",
        title="Coriolis and centrifugal torques",
        plain="Turning pulls the raised or lowered nose back to the horizontal, and pitching changes the inertia "
        "that yaw feels.",
        printed=r"C(q,\dot q) = \begin{bmatrix} B_p & m l^2\sin\theta\cos\theta\,\dot\psi \\ -2 m l^2\sin\theta\cos\theta\,\dot\psi & B_y \end{bmatrix}",
        derived=named(r"C(q,\dot q)", _coriolis),
        status="corrected",
        note="Derived from D by Christoffel's symbols; friction stays in Eq. 6.",
        errata=("christoffel",),
    ),
    Equation(
        number="Eq. 12",
        title="Gravity and thrust",
        plain="Gravity pulls the nose down, most where the beam is level; the motors hold against it.",
        printed=r"g(q) = \begin{bmatrix} m g l\cos\theta \\ 0 \end{bmatrix},\quad \tau = \begin{bmatrix} K_{pp}V_p + K_{py}V_y \\ K_{yp}V_p + K_{yy}V_y \end{bmatrix}",
        derived=lambda: f"g(q) = {latex(_gravity())},\\quad \\tau = {latex(_thrust())}",
        note="The text calls g(q) “gravitational acceleration”; it is the gravity torque.",
    ),
)

LINEAR = (
    Equation(
        number="trim",
        title="Rest at θ₀",
        plain="The voltages at which nothing accelerates: from here on, states and voltages count from this rest.",
        derived=lambda: r"V_{\text{trim}} = " + latex(linear_model().trim),
        status="explained",
        note="The paper does not speak of it: the linear model holds for deviations from these voltages.",
    ),
    Equation(
        number="Eq. 15",
        title="Short names",
        plain="Three combinations of the parameters occur so often that they get names: the inertia about each "
        "axis, and how differently the two motors push.",
        printed=r"\alpha = J_p + m l^2,\quad \beta = J_y + m l^2,\quad \gamma = K_{py}K_{yp} - K_{pp}K_{yy}",
        derived=_definitions,
        note="β₀ is β at θ₀ = 0. The paper has no a: it is 0 at θ₀ = 0 without stiffness.",
    ),
    Equation(
        number="Eq. 13",
        title="System matrix",
        plain="How the rig moves by itself near rest: angles integrate rates, and friction makes the rates decay.",
        printed=latex(as_printed.system_matrix()).join(("A = ", "")),
        derived=named("A", lambda: linear_model().A),
        status="corrected",
        note="a is 0 at θ₀ = 0 without stiffness, the paper's case.",
        errata=("yaw-damping-in-A",),
    ),
    Equation(
        number="Eq. 14",
        title="Input matrix",
        plain="How a volt on each motor accelerates each axis.",
        printed=latex(as_printed.input_matrix()).join(("B = ", "")),
        derived=named("B", lambda: linear_model().B),
        status="corrected",
        errata=("row-denominators",),
    ),
)
"""Each tuple in the order in which the derivation needs it."""
