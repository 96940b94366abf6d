"""The paper's reproduction: complete, every erratum proved, every digit accounted for."""

from __future__ import annotations

import re

import numpy as np
import pytest

from heli2dof_core.couplings import Structure
from heli2dof_core.paper.consequence import consequence
from heli2dof_core.paper.equations import EQUATIONS
from heli2dof_core.paper.errata import CONFIRMED, ERRATA
from heli2dof_core.paper.evidence import EVIDENCE
from heli2dof_core.paper.figures import figures
from heli2dof_core.paper.glossary import TERMS
from heli2dof_core.paper.proofs import christoffel
from heli2dof_core.paper.reproduce import digits_that_agree, reproduce, significant_digits
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.symbolic.names import PARAMETERS as P
from heli2dof_core.symbolic.names import psi_dot, theta, theta_dot
from heli2dof_core.symbolic.render import symbolic_report
from tests.authorities.test_paper import PRINTED_K, PRINTED_OPEN_LOOP_POLES, PRINTED_POLES


@pytest.mark.parametrize("erratum", ERRATA, ids=lambda e: e.name)
def test_every_erratum_is_proved(erratum):
    proof = erratum.prove()
    assert proof.holds
    assert proof.correct != proof.printed
    assert erratum.why and erratum.effect


@pytest.mark.parametrize("erratum", CONFIRMED, ids=lambda e: e.name)
def test_what_is_called_an_erratum_shows_in_the_papers_own_numbers(erratum):
    assert erratum.evidence.shows()
    assert "our copy" not in erratum.why.lower()


def test_what_no_printed_number_shows_is_unclear_in_our_copy():
    assert set(EVIDENCE) <= {erratum.name for erratum in ERRATA}
    unclear = [erratum.name for erratum in ERRATA if erratum not in CONFIRMED]
    assert unclear == ["kinetic-energy", "christoffel", "row-denominators", "units"]


def test_nothing_numbered_is_left_out():
    numbers = {n for e in EQUATIONS for n in _numbers(e.number)}
    assert {f"Eq. {i}" for i in range(1, 24)} | {f"Fig. {i}" for i in range(1, 6)} | {"Table I"} <= numbers
    known = {erratum.name for erratum in ERRATA}
    named = {name for equation in EQUATIONS for name in equation.errata}
    assert named == known  # each stands somewhere
    for equation in EQUATIONS:
        assert re.fullmatch(r"[A-Z$][^.]*[.?](?: [A-Z][^.]*\.)?", equation.plain), (
            equation.number
        )  # plain, and short
        assert len(equation.plain) < 180
        assert equation.printed or equation.derived or equation.note
        assert bool(equation.errata) or equation.status != "corrected"


def test_the_steps_follow_from_one_another():
    order = [equation.number for equation in EQUATIONS]
    assert len(set(order)) == len(order)
    chain = [
        *("Eq. 2", "potential energy", "Eq. 3", "Eq. 9", "trim", "Eq. 13", "Eq. 14", "controllability"),
        *("transformation", "canonical form", "desired polynomials", "gain in z", "Eq. 19", "Eqs. 21, 22"),
        *("closed loop", "Eq. 17", "steady state", "Eq. 23", "Fig. 3"),
    ]
    places = [order.index(number) for number in chain]
    assert places == sorted(places)


def test_every_step_that_depends_on_the_structure_has_its_formula_for_each():
    for structure in (Structure("input-diagonal"), Structure("triangular", "yaw")):
        formulas = symbolic_report(structure).formulas
        for equation in EQUATIONS:
            assert set(equation.formulas) <= set(formulas), equation.number


def test_the_glossary_names_each_sign_once_per_chapter():
    seen = set()
    for term in TERMS:
        assert term.meaning
        for chapter in term.chapters or ("",):
            assert (term.latex, chapter) not in seen, term
            seen.add((term.latex, chapter))
    assert set(PARAMETER_INFO) <= {term.name for term in TERMS}


def _numbers(text):
    if not text.startswith(("Eq", "Fig")):
        return [text]
    kind = text.split()[0].removesuffix("s.").removesuffix(".")
    found = re.findall(r"\d+", text)
    return [f"{kind}. {n}" for n in found] or [text]


def test_all_printed_numbers_are_there_with_their_verdict():
    rows = reproduce()
    by_name = {row.printed.name: row for row in rows}
    for i, j in np.ndindex(2, 4):
        row = by_name[f"k_{i + 1}{j + 1}"]
        assert row.printed.value == PRINTED_K[i, j]
        assert row.verdict == "reproduced" and row.digits == significant_digits(row.printed.text)
        assert (abs(row.corrected - row.recomputed) > 1e-3) == (j in (1, 3))
    for i, (own, desired) in enumerate(zip(PRINTED_OPEN_LOOP_POLES, PRINTED_POLES, strict=True)):
        assert by_name[f"open-loop pole {i + 1}"].printed.value == own
        assert by_name[f"open-loop pole {i + 1}"].verdict == "reproduced"
        assert by_name[f"p_{i + 1}"].printed.value == desired
    assert (by_name["numerator"].recomputed, by_name["denominator"].recomputed) == (73, 7127)
    assert {row.printed.name for row in rows if row.verdict == "differs"} == {"l", "J_y"}
    assert all(row.note for row in rows if row.verdict == "differs")
    assert len(rows) == 2 + 11 + 2 + 4 + 4 + 8 + 3


@pytest.mark.parametrize(
    ("text", "value", "digits"),
    [
        ("51.227", 51.2274, 5),
        ("51.227", 51.170, 3),
        ("-3.278", -3.27775, 4),
        ("-3.278", -3.46, 1),
        ("0.1855", 0.18567, 3),
        ("0.0431", 0.04315, 2),
        ("0", 0.0, 1),
        ("9.25", -9.25, 0),
        ("24", 24.0, 2),
    ],
)
def test_digits_are_counted_as_one_reads_them(text, value, digits):
    assert digits_that_agree(text, value) == digits


def test_the_printed_gain_loses_the_yaw_pair_step_by_step():
    implied, rows, damping, manual = (outcome.poles for outcome in consequence())
    np.testing.assert_allclose(implied, [-12, -10, -9.25, -8.76], atol=5e-3)
    np.testing.assert_allclose(rows, [-12.004, -9.997, -8.794, -8.730], atol=1e-3)
    np.testing.assert_allclose(damping, [-12.004, -9.997, -6.122 + 6.268j, -6.122 - 6.268j], atol=1e-3)
    np.testing.assert_allclose(manual, [-12.082, -9.943, -6.128 + 6.268j, -6.128 - 6.268j], atol=1e-3)
    np.testing.assert_allclose(consequence()[1].unrounded[2:], [-8.802, -8.722], atol=1e-3)
    np.testing.assert_allclose(consequence()[0].unrounded, [-12, -10, -9.25, -8.76], atol=1e-9)


def test_figures_are_the_steps_that_python_control_gives():
    import control

    from heli2dof_core import design, plant, preset

    rig, poles = preset("paper-as-computed"), preset("paper-as-computed").poles
    s = control.tf("s")
    model = design(plant(rig.parameters), poles)
    inner = control.tf(control.ss(model.A_closed, model.plant.B, np.eye(2, 4), 0))
    pi = 30 * (1 + 1 / (0.1 * s))
    G = [[inner[i, j] for j in range(2)] for i in range(2)]
    # both loops closed on the PI's: T = (I + G PI)⁻¹ G PI, its first entry written out
    a, b, c, d = (1 + G[0][0] * pi, G[0][1] * pi, G[1][0] * pi, 1 + G[1][1] * pi)
    T11 = control.minreal((a * d - b * c - d) / (a * d - b * c), verbose=False)
    figure = figures()[0]
    _, expected = control.step_response(T11, figure.t)
    own = {curve.name: curve.angle for curve in figure.curves}
    np.testing.assert_allclose(own["corrected"], expected, atol=2e-3)
    assert figure.output == "theta" and figures()[1].output == "psi"
    assert np.max(own["limited"]) == pytest.approx(np.radians(40.5), abs=1e-9)


def test_the_proof_of_christoffels_symbols_shows_the_symmetric_part_of_both_readings():
    """N + Nᵀ, N = Ḋ − 2C, with D of Eq. 10 differentiated by hand and C of Eq. 11 as printed."""
    mass, arm, th, thd, psd = 1.4, 0.19, 0.3, 0.7, -1.1
    h = mass * arm**2 * np.sin(th) * np.cos(th)
    N = np.diag([0, -2 * h * thd]) - 2 * np.array([[0, h * psd], [-2 * h * psd, 0]])
    values = {P["m"]: mass, P["l"]: arm, theta: th, theta_dot: thd, psi_dot: psd}
    proof = christoffel()
    np.testing.assert_allclose(np.array(proof.printed.subs(values).tolist(), dtype=float), N + N.T)
    assert proof.correct.is_zero_matrix
