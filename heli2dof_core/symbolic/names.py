"""Every symbol of the derivation, once, with meaning and unit.

Names parse with plain `sympify` to the same symbol: none of them has a meaning in SymPy, so γ is
``gamma_`` (``gamma`` is SymPy's function) and β at the operating point is ``beta_0``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from ..parameters import PARAMETER_INFO


@dataclass(frozen=True)
class Name:
    """A symbol's name in expressions, its LaTeX, its meaning and its SI unit."""

    name: str
    latex: str
    meaning: str
    unit: str


PARAMETERS: dict[str, sp.Symbol] = {name: sp.Symbol(name) for name in PARAMETER_INFO}
"""Physical parameters by name (see `heli2dof_core.parameters`)."""

theta, psi, theta_dot, psi_dot = sp.symbols("theta psi theta_dot psi_dot")
theta_ddot, psi_ddot = sp.symbols("theta_ddot psi_ddot")
V_p, V_y = sp.symbols("V_p V_y")
theta_0 = sp.Symbol("theta_0")
sin_0, cos_0 = sp.symbols("sin_0 cos_0")  # plain symbols keep θ₀ ≠ 0 harmless for polynomials
alpha, beta_0, gamma_, a = sp.symbols("alpha beta_0 gamma_ a")
tau_p, tau_y = sp.symbols("tau_p tau_y")
phi_p, phi_y = sp.symbols("phi_p phi_y")
b_11, b_12, b_21, b_22 = sp.symbols("b_11 b_12 b_21 b_22")
nu_p, nu_y, Delta = sp.symbols("nu_p nu_y Delta")
p_1, p_2, p_3, p_4, p_5, p_6 = sp.symbols("p_1 p_2 p_3 p_4 p_5 p_6")
q_1, q_2, q_3, q_4 = sp.symbols("q_1 q_2 q_3 q_4")
d_10, d_11, d_12, d_20, d_21, d_22 = sp.symbols("d_10 d_11 d_12 d_20 d_21 d_22")
c = sp.Symbol("c")
s = sp.Symbol("s")


def _latex(name: str) -> str:
    """LaTeX of a parameter's name; subscripts of several letters stand upright."""
    base, _, index = name.partition("_")
    if len(index) == 1:
        return name
    axes = set(index) <= set("py")  # as in K_py, which is no word
    return f"{base}_{{{index}}}" if axes else rf"{base}_{{\text{{{index}}}}}"


NAMES: tuple[Name, ...] = (
    *(Name(n, _latex(n), i.meaning, i.unit) for n, i in PARAMETER_INFO.items()),
    Name("theta", r"\theta", "pitch angle", "rad"),
    Name("psi", r"\psi", "yaw angle", "rad"),
    Name("theta_dot", r"\dot\theta", "pitch rate", "rad/s"),
    Name("psi_dot", r"\dot\psi", "yaw rate", "rad/s"),
    Name("V_p", "V_p", "voltage of the pitch motor", "V"),
    Name("V_y", "V_y", "voltage of the yaw motor", "V"),
    Name("theta_0", r"\theta_0", "pitch angle of the operating point", "rad"),
    Name("sin_0", r"\sin\theta_0", "sine of the operating point's pitch", "1"),
    Name("cos_0", r"\left(\cos\theta_0\right)", "cosine of the operating point's pitch", "1"),
    Name("alpha", r"\alpha", "effective inertia about pitch, J_p + m l²", "kg·m²"),
    Name("beta_0", r"\beta_0", "effective inertia about yaw, J_y + m l² cos²θ₀", "kg·m²"),
    Name("gamma_", r"\gamma", "K_py K_yp − K_pp K_yy, minus the thrust matrix's determinant", "(N·m/V)²"),
    Name("a", "a", "gravity and stiffness in A₃₁, (m g l sinθ₀ − K_s)/α", "1/s²"),
    *(Name(f"p_{i}", f"p_{i}", f"desired pole {i}", "rad/s") for i in (1, 2, 3, 4)),
    Name("d_10", "d_{10}", "constant coefficient of d₁(s), p₁p₂", "1/s²"),
    Name("d_11", "d_{11}", "linear coefficient of d₁(s), −p₁ − p₂", "1/s"),
    Name("d_20", "d_{20}", "constant coefficient of d₂(s), p₃p₄", "1/s²"),
    Name("d_21", "d_{21}", "linear coefficient of d₂(s), −p₃ − p₄", "1/s"),
    Name("c", "c", "shift of the basis, q₁ → q₁ + c q₂ (yaw leading: q₂ → q₂ + c q₁)", "1"),
    Name("s", "s", "Laplace variable", "1/s"),
)

ROTOR_NAMES: tuple[Name, ...] = (
    Name("tau_p", r"\tau_p", "time constant of the pitch motor's rotor", "s"),
    Name("tau_y", r"\tau_y", "time constant of the yaw motor's rotor", "s"),
    Name("p_5", "p_5", "desired pole 5, pitch's third", "rad/s"),
    Name("p_6", "p_6", "desired pole 6, yaw's third", "rad/s"),
    Name("d_12", "d_{12}", "quadratic coefficient of d₁(s), a cubic where the rotors are placed", "1/s"),
    Name("d_22", "d_{22}", "quadratic coefficient of d₂(s), a cubic where the rotors are placed", "1/s"),
    Name("phi_p", r"\varphi'_p", "slope of the pitch motor's thrust curve at the trim", "1"),
    Name("phi_y", r"\varphi'_y", "slope of the yaw motor's thrust curve at the trim", "1"),
    Name("b_11", "b_{11}", "pitch acceleration by the pitch rotor's speed v_p", "rad/(s²·V)"),
    Name("b_12", "b_{12}", "pitch acceleration by the yaw rotor's speed v_y", "rad/(s²·V)"),
    Name("b_21", "b_{21}", "yaw acceleration by the pitch rotor's speed v_p", "rad/(s²·V)"),
    Name("b_22", "b_{22}", "yaw acceleration by the yaw rotor's speed v_y", "rad/(s²·V)"),
    Name("nu_p", r"\nu_p", "damping of pitch, B_p by the effective inertia", "1/s"),
    Name("nu_y", r"\nu_y", "damping of yaw, B_y by the effective inertia", "1/s"),
    Name("Delta", r"\Delta", "determinant of the rotors' effects b₁₁ … b₂₂", "(rad/(s²·V))²"),
)
"""What the six-state derivation has besides (`rotors`, `reading`); d₁₀ … d₂₁ are those of cubics there."""

OBSERVER_NAMES: tuple[Name, ...] = tuple(
    Name(f"q_{i}", f"q_{i}", f"desired pole {i} of the observer", "rad/s") for i in (1, 2, 3, 4)
)
"""What the observer's derivation has besides (`observer`)."""

CUBIC_NAMES: tuple[Name, ...] = tuple(
    Name(f"d_{i}{k}", f"d_{{{i}{k}}}", f"{which} coefficient of d{sub}(s), {axis}’s desired cubic", unit)
    for i, sub, axis in ((1, "₁", "pitch"), (2, "₂", "yaw"))
    for k, (which, unit) in enumerate((("constant", "1/s³"), ("linear", "1/s²"), ("quadratic", "1/s")))
)
"""What d₁₀ … d₂₂ are where the rotors are placed, too."""

ROTOR_SIGNALS: tuple[Name, ...] = (
    *(
        Name(f"v_{j}{dot}", rf"{sign}_{j}", f"{what} of the {motor} motor's rotor, as a voltage", unit)
        for j, motor in (("p", "pitch"), ("y", "yaw"))
        for dot, sign, what, unit in (
            ("", "v", "speed", "V"),
            ("_dot", r"\dot v", "rate of the speed", "V/s"),
        )
    ),
    Name("v_j", "v_j", "speed of either rotor, as a voltage: pitch's, yaw's", "V"),
    Name("v_d", "v_d", "speed up to which a quadratic curve gives no thrust: pitch's, yaw's", "V"),
    Name("s_j", "s_j", "scale of a quadratic curve, so that it meets the linear one: pitch's, yaw's", "1/V"),
)
"""What the rotors' own equations are written in; a letter with index j stands for either motor's."""

MATRIX_NAMES: tuple[Name, ...] = (
    Name("x", "x", "state [θ, ψ, θ̇, ψ̇], from rest at θ₀", ""),
    Name("x_hat", r"\hat{x}", "estimate of the state", ""),
    Name("x_hat_dot", r"\dot{\hat{x}}", "rate of the estimate", ""),
    Name("e", "e", "error of the estimate, x − x̂", ""),
    Name("u", "u", "voltages [V_p, V_y], from the trim", "V"),
    Name("y", "y", "measured angles [θ, ψ]", "rad"),
    Name("A", "A", "system matrix", ""),
    Name("B", "B", "input matrix", ""),
    Name("C", "C", "output matrix: the angles are measured", "1"),
    Name("K", "K", "state feedback", ""),
    Name("L", "L", "observer's gain", ""),
)
"""Vectors and matrices by one letter each, as the observer's equations are written."""


def gain_names(columns: int = 4) -> tuple[Name, ...]:
    """k₁₁ … of K, with the states that its columns stand for."""
    motors, states = ("pitch motor", "yaw motor"), ("θ", "ψ", "θ̇", "ψ̇", "v_p", "v_y")
    units = ("V/rad", "V/rad", "V·s/rad", "V·s/rad", "V/V", "V/V")
    return tuple(
        Name(f"k_{i}{j}", f"k_{{{i}{j}}}", f"feedback from {state} to the {motor}", unit)
        for i, motor in enumerate(motors, 1)
        for j, (state, unit) in enumerate(zip(states[:columns], units[:columns], strict=True), 1)
    )


def observer_gain_names() -> tuple[Name, ...]:
    """l₁₁ … of L."""
    return tuple(
        Name(
            f"l_{i}{j}", f"l_{{{i}{j}}}", f"correction of the estimated {state} by the error of {angle}", unit
        )
        for i, (state, unit) in enumerate((("θ", "1/s"), ("ψ", "1/s"), ("θ̇", "1/s²"), ("ψ̇", "1/s²")), 1)
        for j, angle in enumerate("θψ", 1)
    )


LATEX: dict[sp.Symbol, str] = {
    **{sp.Symbol(n.name): n.latex for n in (*NAMES, *ROTOR_NAMES, *ROTOR_SIGNALS, *OBSERVER_NAMES)},
    **{sp.Symbol(n.name, commutative=False): n.latex for n in MATRIX_NAMES},
}
"""Symbol → LaTeX, for SymPy's printer."""

COEFFICIENTS_OF_POLES: dict[sp.Symbol, sp.Expr] = {
    d_10: p_1 * p_2,
    d_11: -p_1 - p_2,
    d_20: p_3 * p_4,
    d_21: -p_3 - p_4,
}
"""Coefficients of the desired polynomials d₁, d₂ in terms of the poles."""

COEFFICIENTS_OF_TRIPLES: dict[sp.Symbol, sp.Expr] = {
    d: value
    for names, (p, q, r) in (((d_10, d_11, d_12), (p_1, p_2, p_5)), ((d_20, d_21, d_22), (p_3, p_4, p_6)))
    for d, value in zip(names, (-p * q * r, p * q + p * r + q * r, -p - q - r), strict=True)
}
"""Coefficients of the desired cubics where the rotors are placed, too: pitch's triple is p₁, p₂, p₅."""

COEFFICIENTS_OF_OBSERVER_POLES: dict[sp.Symbol, sp.Expr] = {
    d: value.subs({p_1: q_1, p_2: q_2, p_3: q_3, p_4: q_4}) for d, value in COEFFICIENTS_OF_POLES.items()
}
"""Coefficients of the observer's polynomials: (q₁, q₂) is pitch's pair, (q₃, q₄) yaw's."""


def latex(expression: Any) -> str:
    """LaTeX in the derivation's own names."""
    return sp.latex(expression, symbol_names=LATEX, mat_delim="[")
