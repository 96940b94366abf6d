"""The derivation against the theory, each identity with residual zero."""

from __future__ import annotations

import pytest
import sympy as sp
from sympy import Matrix, cos, simplify, sin

from heli2dof_core.symbolic import names as n
from heli2dof_core.symbolic.full_rank import full_rank, indices, plant
from heli2dof_core.symbolic.linearization import linear_model
from heli2dof_core.symbolic.luenberger import controllability_matrix
from heli2dof_core.symbolic.mechanics import mechanics, residual
from heli2dof_core.symbolic.names import PARAMETERS as P
from heli2dof_core.symbolic.render import symbolic_report
from heli2dof_core.symbolic.rga import relative_gain_array, steady_state, transfer_matrix
from tests.strategies import STRUCTURES

K_pp, K_py, K_yp, K_yy = (P[name] for name in ("K_pp", "K_py", "K_yp", "K_yy"))
B_p, B_y, m, l, g, K_s = (P[name] for name in ("B_p", "B_y", "m", "l", "g", "K_s"))  # noqa: E741
PHYSICAL = {n.gamma_: K_py * K_yp - K_pp * K_yy}


def zero(matrix: Matrix) -> bool:
    return all(sp.cancel(sp.together(entry)) == 0 for entry in matrix)


def test_equations_of_motion_are_those_of_the_theory():
    th, thd, psd = n.theta, n.theta_dot, n.psi_dot
    pitch = (
        K_pp * n.V_p + K_py * n.V_y - B_p * thd - K_s * th - m * l**2 * sin(th) * cos(th) * psd**2
    ) - m * g * l * cos(th)
    yaw = K_yp * n.V_p + K_yy * n.V_y - B_y * psd + 2 * m * l**2 * sin(th) * cos(th) * thd * psd
    expected = Matrix(
        [
            (P["J_p"] + m * l**2) * n.theta_ddot - pitch,
            (P["J_y"] + m * l**2 * cos(th) ** 2) * n.psi_ddot - yaw,
        ]
    )
    assert (residual() - expected).expand() == sp.zeros(2, 1)


def test_energy_changes_by_the_work_of_the_motors_and_of_friction_alone():
    model = mechanics()
    accelerations = dict(zip((n.theta_dot, n.psi_dot), model.accelerations, strict=True))
    energy = model.kinetic + model.potential
    power = sum(energy.diff(rate) * accelerations[rate] for rate in accelerations)
    power += energy.diff(n.theta) * n.theta_dot + energy.diff(n.psi) * n.psi_dot
    work = Matrix([[n.theta_dot, n.psi_dot]]) * model.torque
    assert simplify(power - work[0]) == 0


def test_mass_matrix_minus_twice_christoffel_is_skew_and_the_papers_matrix_is_not():
    th, thd, psd = n.theta, n.theta_dot, n.psi_dot
    h = m * l**2 * sin(th) * cos(th)
    change = mechanics().mass_matrix.diff(th) * thd
    christoffel = Matrix([[0, h * psd], [-h * psd, -h * thd]])
    papers = Matrix([[0, h * psd], [-2 * h * psd, 0]])  # Eq. 11 without its friction
    rates = Matrix([thd, psd])
    assert (christoffel * rates - papers * rates).expand() == sp.zeros(2, 1)
    skew = change - 2 * christoffel
    assert (skew + skew.T).expand() == sp.zeros(2, 2)
    not_skew = change - 2 * papers
    assert (not_skew + not_skew.T).expand() != sp.zeros(2, 2)


def test_linear_model_is_that_of_the_theory():
    model = linear_model()
    A = Matrix([[0, 0, 1, 0], [0, 0, 0, 1], [n.a, 0, -B_p / n.alpha, 0], [0, 0, 0, -B_y / n.beta_0]])
    B = Matrix([[0, 0], [0, 0], [K_pp / n.alpha, K_py / n.alpha], [K_yp / n.beta_0, K_yy / n.beta_0]])
    assert zero(model.A - A)
    assert zero(model.B - B)
    assert sp.cancel(model.definitions[n.a] - (m * g * l * n.sin_0 - K_s) / n.alpha) == 0
    assert model.definitions[n.alpha] == P["J_p"] + m * l**2
    assert model.definitions[n.beta_0] == P["J_y"] + m * l**2 * n.cos_0**2


def test_trim_holds_the_rig():
    trim = linear_model().trim
    thrust = Matrix([[K_pp, K_py], [K_yp, K_yy]])
    gravity = Matrix([m * g * l * n.cos_0 + K_s * n.theta_0, 0])
    assert zero(thrust * trim - gravity)


def test_controllability_indices_and_matrix():
    A, B = plant()
    assert indices() == (2, 2)
    assert controllability_matrix(A, B).shape == (4, 8)
    assert controllability_matrix(A, B).rank() == 4


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_canonical_form_is_similar_and_block_companion(structure):
    A, B = plant()
    form = full_rank(structure).form
    assert form.T.matmul(A) == form.A_bar.matmul(form.T)
    assert form.T.matmul(B) == form.B_bar
    top = form.A_bar.to_Matrix()
    assert top[0, :] == Matrix([[0, 1, 0, 0]])
    assert top[2, :] == Matrix([[0, 0, 0, 1]])
    B_bar = form.B_bar.to_Matrix()
    assert B_bar[0, :] == B_bar[2, :] == sp.zeros(1, 2)
    assert B_bar.extract([1, 3], [0, 1]) == form.Q.to_Matrix()


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_closed_loop_has_exactly_the_desired_polynomial_and_shape(structure):
    result = full_rank(structure)
    A, B = plant()
    assert result.closed_loop == A - B.matmul(result.K)
    closed = result.canonical_closed_loop.to_Matrix()
    s = n.s
    d_1, d_2 = s**2 + n.d_11 * s + n.d_10, s**2 + n.d_21 * s + n.d_20
    assert sp.expand(closed.charpoly(s).as_expr() - d_1 * d_2) == 0
    upper, lower = closed[:2, 2:], closed[2:, :2]
    if structure.coupling == "triangular":
        assert (upper if structure.lead == "pitch" else lower).is_zero_matrix
        assert not (lower if structure.lead == "pitch" else upper).is_zero_matrix
    else:
        assert upper.is_zero_matrix and lower.is_zero_matrix


def test_triangular_gain_is_the_closed_form_of_the_theory():
    """Eqs. 21–22 with their errata mended."""
    p_1, p_2, p_3, p_4, alpha, beta, gamma = n.p_1, n.p_2, n.p_3, n.p_4, n.alpha, n.beta_0, n.gamma_
    a_1, a_2 = B_p / alpha, B_y / beta
    second = -p_3 - p_4 - a_2
    expected = Matrix(
        [
            [
                p_1 * p_2 * alpha / K_pp - K_py * K_yp * p_3 * p_4 * alpha / (K_pp * gamma),
                K_py * p_3 * p_4 * beta / gamma,
                (-p_1 - p_2 - a_1) * alpha / K_pp - K_py * K_yp * alpha * second / (K_pp * gamma),
                K_py * beta * second / gamma,
            ],
            [
                K_yp * p_3 * p_4 * alpha / gamma,
                -K_pp * p_3 * p_4 * beta / gamma,
                K_yp * alpha * second / gamma,
                -K_pp * beta * second / gamma,
            ],
        ]
    ).subs(PHYSICAL)
    derived = full_rank(STRUCTURES[0]).K.to_Matrix().subs(n.COEFFICIENTS_OF_POLES).subs(n.a, 0)
    assert zero(derived - expected)


@pytest.mark.parametrize(
    ("structure", "excess"),
    [
        (STRUCTURES[0], (n.d_20 - n.a) / n.d_10),
        (STRUCTURES[1], (n.d_10 + n.a) / n.d_20),
        (STRUCTURES[2], sp.Integer(1)),
        (STRUCTURES[3], sp.Integer(1)),
    ],
    ids=str,
)
def test_rga_is_that_of_the_theory_and_its_rows_sum_to_one(structure, excess):
    k = K_py * K_yp / (K_pp * K_yy - K_py * K_yp)
    rga = relative_gain_array(structure).to_Matrix()
    assert sp.cancel(rga[0, 0] - (1 + k * excess)) == 0
    assert zero(rga * Matrix([1, 1]) - Matrix([1, 1]))
    assert zero(Matrix([[1, 1]]) * rga - Matrix([[1, 1]]))


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_transfer_matrix_solves_the_closed_loop(structure):
    A, B = (matrix.to_Matrix() for matrix in plant())
    G = transfer_matrix(structure).to_Matrix()
    K = full_rank(structure).K.to_Matrix()
    values = {
        symbol: sp.Rational(3 + 2 * i, 7 + i) for i, symbol in enumerate(sorted(A.free_symbols, key=str))
    }
    values |= {x: sp.Rational(5 + i, 3 + i) for i, x in enumerate((K_pp, K_py, K_yp, K_yy))}
    values |= {n.d_10: 12, n.d_11: 7, n.d_20: 20, n.d_21: 9, n.s: sp.Rational(3, 2)}
    A, B, G, K = (x.subs(values) for x in (A, B, G, K))
    pencil = values[n.s] * sp.eye(4) - A + B * K
    assert sp.eye(2, 4) * pencil.inv() * B == G


@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_rendered_formulas_parse_back_to_what_was_derived(structure):
    report = symbolic_report(structure)
    derived = {
        "K": full_rank(structure).K,
        "RGA": relative_gain_array(structure),
        "G": transfer_matrix(structure),
        "T": full_rank(structure).form.T,
        "Q": full_rank(structure).form.Q,
        "A_bar": full_rank(structure).form.A_bar,
        "B_bar": full_rank(structure).form.B_bar,
        "K_bar": full_rank(structure).K_bar,
        "G_0": steady_state(structure),
        "closed_loop": full_rank(structure).closed_loop,
        "canonical_closed_loop": full_rank(structure).canonical_closed_loop,
    }
    for name, matrix in derived.items():
        parsed = Matrix(sp.sympify(report.formulas[name].sympy))
        expected = matrix.to_Matrix().subs(n.COEFFICIENTS_OF_POLES)
        assert zero(parsed.subs(PHYSICAL) - expected), name
        assert report.formulas[name].mathml.startswith("<math")
    known = {symbol.name for symbol in report.symbols}
    used = set().union(*(sp.sympify(f.sympy).free_symbols for f in report.formulas.values()))
    assert {str(symbol) for symbol in used} <= known


def test_every_name_parses_as_a_plain_symbol():
    for name in (*n.NAMES, *n.ROTOR_NAMES, *n.OBSERVER_NAMES):
        assert sp.sympify(name.name) == sp.Symbol(name.name)
