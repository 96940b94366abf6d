"""The identities that prove the errata: computed each time, never asserted."""

# pyright: reportArgumentType=false, reportCallIssue=false, reportOperatorIssue=false, reportAttributeAccessIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

from dataclasses import dataclass
from math import degrees

import numpy as np
import sympy as sp
from sympy.polys.matrices import DomainMatrix

from ..couplings import Structure
from ..design import design
from ..interaction import dominance_over_frequency, interaction
from ..placement.ackermann import Ackermann
from ..placement.method import Task
from ..plant import plant
from ..poles import PoleSet
from ..presets import preset
from ..symbolic.linearization import linear_model
from ..symbolic.luenberger import controllability_matrix
from ..symbolic.mechanics import mechanics
from ..symbolic.names import PARAMETERS as P
from ..symbolic.names import alpha, beta_0, gamma_, p_1, p_2, p_3, p_4, psi, psi_dot, s, theta, theta_dot
from . import as_printed
from .as_printed import B_p, B_y, K_pp, K_py, K_yp, K_yy
from .printed import OPEN_LOOP_POLES, PI, printed_gain, printed_poles

_GAMMA = {gamma_: K_py * K_yp - K_pp * K_yy}


@dataclass(frozen=True)
class Proof:
    """Why an erratum is one.

    Attributes:
        statement: what is computed, in words.
        correct: the corrected form's residual or figure: a zero, where it is an identity.
        printed: the printed form's, which differs.
        holds: whether the computation says what the statement says.
        labels: what the two are called.
    """

    statement: str
    correct: sp.Basic | sp.MatrixBase | str
    printed: sp.Basic | sp.MatrixBase | str
    holds: bool
    labels: tuple[str, str] = ("right form", "printed form")


def kinetic_energy() -> Proof:
    """Eq. 2: the Hessian of T by the rates must be Eq. 10's D(q)."""
    l, rates = P["l"], sp.Matrix([theta_dot, psi_dot])  # noqa: E741
    D = sp.diag(P["J_p"] + P["m"] * l**2, P["J_y"] + P["m"] * l**2 * sp.cos(theta) ** 2)
    right = (sp.hessian(mechanics().kinetic, list(rates)) - D).expand()
    velocity = (
        -l * psi_dot * sp.sin(psi) * sp.cos(theta) - l * theta_dot * sp.cos(psi) * sp.sin(theta),
        -l * psi_dot * sp.cos(theta) + l * theta_dot * sp.sin(psi) * sp.sin(theta),
        l * theta_dot * sp.cos(theta),
    )
    mildest = P["m"] / 2 * sum(v**2 for v in velocity)
    wrong = (sp.hessian(mildest, list(rates)) - D).applyfunc(sp.trigsimp)
    return Proof(
        "The Hessian of T with respect to (θ̇, ψ̇), less Eq. 10's D(q). Printed: the mildest reading of our "
        "copy, squares and ½ put right, only cosψ and the rotational energy missing.",
        right,
        wrong,
        right.is_zero_matrix is True and wrong.is_zero_matrix is not True,
    )


def christoffel() -> Proof:
    """Eq. 11: Ḋ − 2C is skew for Christoffel's C, and not for the printed one, though C q̇ is the same."""
    rates = sp.Matrix([theta_dot, psi_dot])
    h = P["m"] * P["l"] ** 2 * sp.sin(theta) * sp.cos(theta)
    own = sp.Matrix([[0, h * psi_dot], [-h * psi_dot, -h * theta_dot]])
    change = mechanics().mass_matrix.diff(theta) * theta_dot
    skew, papers = change - 2 * own, change - 2 * as_printed.coriolis()
    same = ((own - as_printed.coriolis()) * rates).expand()
    right, wrong = (skew + skew.T).expand(), (papers + papers.T).expand()
    return Proof(
        "N + Nᵀ for N = Ḋ − 2C, which Christoffel's symbols make 0 (then friction and motors alone change the "
        "energy). Both give the same C q̇, so the motion is not touched.",
        right,
        wrong,
        same.is_zero_matrix is True and right.is_zero_matrix is True and wrong.is_zero_matrix is not True,
    )


def yaw_damping_in_a() -> Proof:
    """Eq. 13: A₄₄ is −B_y/β."""
    A = linear_model().A
    right, wrong = sp.cancel(A[3, 3] + B_y / beta_0), sp.cancel(A[3, 3] + B_p / beta_0)
    rig = preset("paper-as-computed").parameters
    root = -rig.B_y / rig.beta
    shown = abs(root - OPEN_LOOP_POLES[3].value) < 5e-6
    return Proof(
        "A₄₄ as derived, less −B_y/β, and less the printed −B_p/β. The printed open-loop pole −8.76343 is "
        f"−0.8/β = {root:.5f}: the results put B_p = 0.8 on both axes.",
        right,
        wrong,
        right == 0 and wrong != 0 and shown,
    )


def row_denominators() -> Proof:
    """Eq. 14: B is D(q)⁻¹ times the thrust constants, so its rows have one inertia each."""
    derived = linear_model().B
    rows = sp.Matrix([[0, 0], [0, 0], [K_pp / alpha, K_py / alpha], [K_yp / beta_0, K_yy / beta_0]])
    right = (derived - rows).applyfunc(sp.cancel)
    wrong = (derived - as_printed.input_matrix()).applyfunc(sp.factor)
    return Proof(
        "B as derived, less the form with α in row 3 and β in row 4, and less the printed one.",
        right,
        wrong,
        right.is_zero_matrix is True and wrong.is_zero_matrix is not True,
    )


def sign_of_the_feedback() -> Proof:
    """Eqs. 16–18: the printed K stabilizes with A − BK only."""
    model = plant(preset("paper-as-computed").parameters)
    minus, plus = (
        float(np.max(np.linalg.eigvals(model.A + sign * model.B @ printed_gain()).real)) for sign in (-1, 1)
    )
    return Proof(
        "Largest real part of the eigenvalues of A − BK, and of A + BK, with the printed K, rad/s.",
        f"{minus:.3f}",
        f"+{plus:.3f}",
        minus < 0 < plus,
        ("A − BK", "A + BK"),
    )


def yaw_damping_in_k() -> Proof:
    """Eqs. 21–22: with B_y/β the characteristic polynomial is the desired one, with B_p/β not."""
    right, wrong = (_polynomial_residual(as_printed.gain(beta_0, damping)) for damping in (B_y, B_p))
    return Proof(
        "det(sI − A + BK) − (s − p₁)(s − p₂)(s − p₃)(s − p₄), with B_y/β and with the printed B_p/β.",
        right,
        wrong,
        right == 0 and wrong != 0,
    )


def yaw_inertia_in_k() -> Proof:
    """Eqs. 21–22: α in k₁₂, k₁₄, k₂₂, k₂₄ is right only for a B with α in all four entries."""
    right, wrong = (_polynomial_residual(as_printed.gain(inertia, B_y)) for inertia in (beta_0, alpha))
    B_alpha = sp.Matrix([[0, 0], [0, 0], [K_pp / alpha, K_py / alpha], [K_yp / alpha, K_yy / alpha]])
    fits = _polynomial_residual(as_printed.gain(), as_printed.system_matrix(), B_alpha)
    return Proof(
        "The same residual with β, and with the printed α, in k₁₂, k₁₄, k₂₂, k₂₄. For a B with α in all four "
        "entries and Eq. 13's A it is 0 as printed, which tells how the formula came about.",
        right,
        wrong,
        right == 0 and wrong != 0 and fits == 0,
    )


def table_values() -> Proof:
    """Table I's own values do not give the printed K; those of the preset do, to every digit."""
    poles, K = printed_poles(), printed_gain()
    computed, table = (
        as_printed.number(as_printed.gain(), preset(name).parameters, poles)
        for name in ("paper-as-computed", "paper-table-1")
    )
    hits = [int(np.sum(found.round(3) == K)) for found in (computed, table)]
    return Proof(
        "How many of K's eight entries Eqs. 21–22 as printed give to every printed digit: from m 1.39, l 0.186, "
        "J_y 0.0432, K_pp 0.204, B 0.8 on both axes, and from Table I.",
        f"{hits[0]} of 8",
        f"{hits[1]} of 8",
        hits[0] == 8 and hits[1] < 8,
        ("as computed", "Table I"),
    )


def units() -> Proof:
    """B_p θ̇ is a torque, so B_p is in N·m·s/rad; N/V is none. Exponents of kg, m, s, A."""
    newton, volt = np.array([1, 1, -2, 0]), np.array([1, 2, -3, -1])
    torque, rate = newton + np.array([0, 1, 0, 0]), np.array([0, 0, -1, 0])
    needed, printed = torque - rate, newton - volt
    return Proof(
        "Powers of (kg, m, s, A): of torque over angular rate, and of the printed N/V.",
        str(tuple(int(n) for n in needed)),
        str(tuple(int(n) for n in printed)),
        not np.array_equal(needed, printed),
        ("torque / rate", "N/V"),
    )


def unit_step() -> Proof:
    """A step of 1 rad asks for k_p volts at once, and is beyond the pitch travel."""
    rig = preset()
    volts, angle = PI[0].value, degrees(1.0)
    travel = degrees(rig.limits.theta or np.inf)
    return Proof(
        "The motors' limits and the pitch travel; and what a step of 1 rad with k_p = 30 V/rad asks for at t = 0⁺.",
        f"±{rig.limits.V_p:g} V, ±{rig.limits.V_y:g} V, ±{travel:.1f}°",
        f"{volts:g} V, {angle:.1f}°",
        volts > max(rig.limits.V_p, rig.limits.V_y) and angle > travel,
        ("the rig has", "the step asks"),
    )


def no_dyadic_design() -> Proof:
    """Det 𝒞(A, Bf) vanishes for every f when a = 0: eigenvalue 0 has two 1×1 Jordan blocks."""
    f = sp.Matrix(sp.symbols("f_1 f_2"))
    model = linear_model()
    A, b = (DomainMatrix.from_Matrix(matrix).to_field() for matrix in (model.A, model.B * f))
    field = controllability_matrix(*A.unify(b))
    determinant = sp.factor(field.domain.to_sympy(field.det()))
    at_zero = determinant.subs(sp.Symbol("a"), 0)
    rig = preset().parameters
    ratios = []
    for angle in (0.1, 0.01):
        tilted = plant(rig, angle)
        dyad = Ackermann().place(Task(tilted.A, tilted.B, PoleSet(printed_poles()).array))
        ratios.append(float(np.linalg.norm(dyad.K)) / design(tilted, PoleSet(printed_poles())).norm)
    return Proof(
        "Determinant of the controllability matrix of (A, Bf) at any operating point: it has the factor a, which "
        "is 0 at θ₀ = 0, so no f works there. Tilted by 0.1 rad the smallest dyadic ‖K‖ is "
        f"{ratios[0]:.3g} times the full-rank one, by 0.01 rad {ratios[1]:.3g} times.",
        determinant,
        at_zero,
        at_zero == 0 and determinant != 0 and 1 < ratios[0] < ratios[1],
        ("at any θ₀", "at θ₀ = 0"),
    )


def interaction_at_rest() -> Proof:
    """λ₁₁ is 1.0069 at the example's poles; the dominance that the paper claims holds."""
    poles, model = PoleSet(printed_poles()), plant(preset("paper-as-computed").parameters)
    placed = design(model, poles)
    rga = interaction(placed).rga
    constant = interaction(design(model, poles, Structure("input-diagonal"))).rga
    ratios = dominance_over_frequency(placed, np.geomspace(1e-3, 1e4, 400))
    worst = float(max(np.max(side) for side in ratios))
    gain = np.nan if rga is None else float(rga[0, 0])
    other = np.nan if constant is None else float(constant[0, 0])
    return Proof(
        f"λ₁₁ at the example's poles, and in the input-diagonal structure, where it is {other:.6f} whatever the "
        "poles: its dependence on them comes from the structure. Off-diagonal over diagonal size of Ĝ(jω) stays "
        f"below {worst:.3f} at all frequencies, by rows and by columns: diagonally dominant, as claimed.",
        f"{gain:.6f}",
        "1",
        bool(abs(gain - 1) > 1e-3 and worst < 1),
        ("λ₁₁(0)", "as claimed"),
    )


def _polynomial_residual(K: sp.Matrix, A: sp.Matrix | None = None, B: sp.Matrix | None = None) -> sp.Expr:
    """det(sI − A + BK) less the desired polynomial, at θ₀ = 0 and K_s = 0, where a = 0."""
    model = linear_model()
    A = model.A.subs(sp.Symbol("a"), 0) if A is None else A
    closed = (A - (model.B if B is None else B) * K).subs(_GAMMA)
    field = DomainMatrix.from_Matrix(closed).to_field()
    powers = (
        s**k * field.domain.to_sympy(c) for k, c in zip(range(4, -1, -1), field.charpoly(), strict=True)
    )
    wanted = (s - p_1) * (s - p_2) * (s - p_3) * (s - p_4)
    return sp.factor(sp.Add(*powers) - wanted)
