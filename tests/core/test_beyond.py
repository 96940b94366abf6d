"""Formulas beyond the paper's model: the six-state gain in letters and groups, the observer, what they are worth."""

from __future__ import annotations

import re
import time
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from heli2dof_core import (
    PoleSet,
    Rotor,
    Rotors,
    Spec,
    Structure,
    loop_of,
    observer_formulas,
    place,
    rotor_formulas,
)
from heli2dof_core.compiled import names_with_rotors
from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.placement.with_rotors import cubic, gain_with_rotors
from heli2dof_core.rotors import USUAL_LAG
from heli2dof_core.symbolic import names as n
from heli2dof_core.symbolic import reading
from heli2dof_core.symbolic.full_rank import full_rank
from heli2dof_core.symbolic.linearization import linear_model
from heli2dof_core.symbolic.names import PARAMETERS as P
from heli2dof_core.symbolic.observer import observer
from heli2dof_core.symbolic.reading import ENTRIES, gain_in_letters, read_gain, read_observer
from heli2dof_core.symbolic.render import symbolic_report
from heli2dof_core.symbolic.rotors import COEFFICIENTS, full_rank_with_rotors
from heli2dof_core.walkthrough_beyond import observer_steps, rotor_steps
from tests.core.test_six_states import SHIFTED, random_design

MEMBERS = [(s, False) for s in STRUCTURES] + [(s, True) for s in SHIFTED]
POLES = sp.symbols("p_1 p_2 p_3 p_4 p_5 p_6")
SLOPES = (("p", n.phi_p), ("y", n.phi_y))
WORDS = Path(__file__).parents[2] / "static/paper/beyond_words.js"


def rationals(*besides):
    """A rational number for each letter that formulas end in."""
    letters = [*P.values(), n.alpha, n.beta_0, n.a, n.phi_p, n.phi_y, n.c, *POLES, *besides]
    return {x: sp.Rational(3 + 2 * i, 7 + (i * i) % 11) for i, x in enumerate(letters)}


def exactly(matrix, values):
    return sp.Matrix(matrix.rows, matrix.cols, [sp.cancel(x.xreplace(values)) for x in matrix])


@pytest.mark.parametrize(("structure", "shifted"), MEMBERS, ids=str)
def test_letters_and_groups_put_in_give_the_derived_gain_exactly(structure, shifted):
    found = read_gain(structure, shifted=shifted)
    values = rationals(n.tau_p, n.tau_y)
    slopes = {P[f"K_{axis}{motor}"]: P[f"K_{axis}{motor}"] * phi for axis in "py" for motor, phi in SLOPES}
    derived = full_rank_with_rotors(structure, shifted=shifted).K.to_Matrix()
    derived = derived.subs(slopes, simultaneous=True).subs(n.COEFFICIENTS_OF_TRIPLES)
    assert exactly(found.written_out(found.gain), values) == exactly(derived, values)
    form = gain_in_letters(structure, shifted=shifted).form
    for shown, own in ((found.T, form.T), (found.Q, form.Q)):
        assert exactly(found.written_out(shown), values) == exactly(
            found.written_out(own.to_Matrix().subs(reading.RATES)), values
        )


ALIKE = [(structure, 1) for structure in STRUCTURES]


@pytest.mark.parametrize(("structure", "slower"), [*ALIKE, (Structure("input-diagonal"), 2)], ids=str)
def test_six_states_become_the_papers_four_as_the_lag_goes_to_nothing(structure, slower):
    """With the third poles at −1/τ, exactly: a rational function of τ at τ = 0.

    Rotors that are not alike have their poles by motor, not by axis, as the input-diagonal structure places them.
    """
    tau, found = sp.Symbol("tau"), read_gain(structure)
    values = rationals() | {n.phi_p: 1, n.phi_y: 1}
    lagging = {n.tau_p: tau, n.tau_y: slower * tau, n.p_5: -1 / tau, n.p_6: -1 / (slower * tau)}
    for x in lagging:
        values.pop(x, None)
    K = found.written_out(found.gain).xreplace(lagging).xreplace(values).applyfunc(sp.cancel).subs(tau, 0)
    paper = full_rank(structure).K.to_Matrix().subs(n.COEFFICIENTS_OF_POLES)
    assert K[:, :4] == exactly(paper, values)
    assert K[:, 4:] == sp.zeros(2, 2)


def test_formulas_are_worth_what_is_computed():
    """K through its letters and groups in floats against the compiled closed form, to 1e-12, for random designs."""
    rng, worst = np.random.default_rng(1709), 0.0
    for _ in range(200):
        model, poles, thirds, structure, tau, slope = random_design(rng)
        K, _ = gain_with_rotors(model, poles, thirds, structure, tau, slope=slope)
        own = () if structure.shift is None else (structure.shift,)
        d = poles.coefficients
        coefficients = (*cubic(d[:2], thirds[0]), *cubic(d[2:], thirds[1]))
        names, function = names_with_rotors(structure.family, shifted=bool(own))
        values = function(*coefficients, *model.numbers, *tau, *slope, *own)
        known = dict(zip(names, values, strict=True))
        known |= dict(zip((str(x) for triple in COEFFICIENTS for x in triple), coefficients, strict=True))
        known |= {"tau_p": tau[0], "tau_y": tau[1], "a": model.A[2, 0], **({"c": own[0]} if own else {})}
        gain = compiled(structure.family, bool(own))
        shown = np.array(gain(known))
        worst = max(worst, float(np.max(np.abs(shown - K)) / np.max(np.abs(K))))
    print(f"worst difference {worst:.1e} of the largest entry")
    assert worst < 1e-12


def compiled(structure, shifted):
    found = read_gain(structure, shifted=shifted).gain
    letters = sorted(found.free_symbols, key=str)
    function = sp.lambdify(letters, found.tolist(), "math")
    return lambda known: function(*(known[str(letter)] for letter in letters))


@pytest.mark.parametrize(("structure", "shifted"), MEMBERS, ids=str)
def test_every_group_is_used_has_several_terms_and_one_unit(structure, shifted):
    found = read_gain(structure, shifted=shifted)
    groups = {str(name): value for name, value in found.definitions.items() if str(name).startswith("h_")}
    assert [name.name for name in found.names] == list(groups) == [f"h_{i + 1}" for i in range(len(groups))]
    assert {str(x) for x in found.gain.free_symbols if str(x).startswith("h_")} == set(groups)
    assert len({sp.expand(value) for value in groups.values()}) == len(groups)
    faster = sp.Symbol("faster")  # a unit of time that is shorter: what is in 1/s^k grows by its k-th power
    grown = {x: x * faster ** (3 - int(str(x)[-1])) for triple in COEFFICIENTS for x in triple}
    grown |= {n.a: n.a * faster**2, n.nu_p: n.nu_p * faster, n.nu_y: n.nu_y * faster}
    grown |= {n.tau_p: n.tau_p / faster, n.tau_y: n.tau_y / faster}
    for name in found.names:
        power = " ¹²³".index(name.unit.removeprefix("1/s") or "¹")
        value = groups[name.name]
        assert len(sp.Add.make_args(sp.expand(value))) > 1
        assert sp.expand(value.xreplace(grown) - faster**power * value) == 0
        cells = [
            f"k_{i + 1}{j + 1}"
            for i in (0, 1)
            for j in range(6)
            if found.gain[i, j].has(sp.Symbol(name.name))
        ]
        assert name.meaning.endswith(", ".join(cells))


def test_definitions_stand_on_those_before_them_and_end_in_the_rigs_own_letters():
    found = rotor_formulas("input-diagonal")
    known = {*P.values(), n.sin_0, n.cos_0, n.phi_p, n.phi_y, n.tau_p, n.tau_y}
    known |= {sp.Symbol(f"p_{i}") for i in range(1, 7)}
    for name, value in found.definitions.items():
        assert value.free_symbols <= known, name
        known.add(name)
    assert found.written_out().free_symbols <= known
    assert {x.name for x in found.symbols} >= {str(x) for x in found.gain.free_symbols}
    for f in (found, observer_formulas()):
        assert len({x.name for x in f.symbols}) == len(f.symbols)
    units = {x.name: x.unit for x in found.symbols}
    for i in (1, 2):
        assert [units[f"d_{i}{k}"] for k in range(3)] == ["1/s³", "1/s²", "1/s"]
    assert found.indices == (3, 3) and observer_formulas().indices == (2, 2)


@pytest.mark.parametrize(("structure", "shifted"), MEMBERS, ids=str)
def test_observers_gain_is_the_derived_one(structure, shifted):
    found = read_observer(structure, shifted=shifted)
    derived = observer(structure, shifted=shifted).L.to_Matrix().subs(n.COEFFICIENTS_OF_OBSERVER_POLES)
    for difference in found.written_out(found.gain) - derived:
        assert sp.cancel(difference) == 0
    assert found.definitions == {n.nu_p: ENTRIES[n.nu_p], n.nu_y: ENTRIES[n.nu_y]}


def test_the_loop_of_state_and_error_is_that_of_rig_and_observer():
    """The typeset matrix in numbers, against the loop in [x, x̂] brought to [x, x − x̂]."""
    rng = np.random.default_rng(5)
    A, B, C, K, L = (rng.normal(size=shape) for shape in ((4, 4), (4, 2), (2, 4), (2, 4), (4, 2)))
    blocks = observer_formulas().equations["separation"]
    numbers = {"A": A, "B": B, "C": C, "K": K, "L": L}
    zero = np.zeros((4, 4))
    shown = np.block(
        [[eval(str(x).replace("*", "@"), numbers) + zero for x in row] for row in blocks.tolist()]
    )
    loop = np.block([[A, -B @ K], [L @ C, A - B @ K - L @ C]])
    change = np.block([[np.eye(4), zero], [np.eye(4), -np.eye(4)]])  # its own inverse
    np.testing.assert_allclose(shown, change @ loop @ change, atol=1e-12)
    rate = observer_formulas().equations["observer"]
    x, u, y = rng.normal(size=4), rng.normal(size=2), rng.normal(size=2)
    found = eval(str(rate).replace("*", "@"), {**numbers, "x_hat": x, "u": u, "y": y})
    np.testing.assert_allclose(found, A @ x + B @ u + L @ (y - C @ x))


def test_thrusts_slope_is_the_curves():
    curve, slope = (rotor_formulas().equations[name] for name in ("thrust", "slope"))
    values = {sp.Symbol("s_j"): sp.Rational(1, 9), sp.Symbol("v_d"): 1}
    v, step = sp.Symbol("v_j"), sp.Rational(1, 10**6)
    for at in (3, -4, sp.Rational(3, 2)):
        around = [curve.subs(values).subs(v, at + side * step) for side in (-1, 1)]
        assert (around[1] - around[0]) / (2 * step) == slope.subs(values).subs(v, at)
    assert curve.subs(values).subs(v, sp.Rational(1, 2)) == 0


@pytest.mark.parametrize(("structure", "shifted"), MEMBERS, ids=str)
def test_rendered_formulas_parse_back(structure, shifted):
    for what in ("K", "L"):
        report = symbolic_report(structure, shifted=shifted, model="rotors", what=what)
        own = (read_gain if what == "K" else read_observer)(structure, shifted=shifted)
        assert sp.Matrix(sp.sympify(report.formulas[what].sympy)) == sp.Matrix(own.gain)
        for name, value in own.definitions.items():
            assert sp.sympify(report.definitions[str(name)].sympy) == value
        letter = what.lower()
        assert report.entries[what][f"{letter}_21"].sympy == str(own.gain[1, 0])
        known = {symbol.name for symbol in report.symbols}
        texts = (f.sympy for f in (*report.formulas.values(), *report.definitions.values()))
        assert {str(x) for text in texts for x in sp.sympify(text).free_symbols} <= known
        assert set(report.notation) == known


def test_six_states_are_derived_within_two_seconds():
    linear_model()
    for cached in (reading.plant_in_letters, gain_in_letters, read_gain, symbolic_report):
        cached.cache_clear()
    worst = 0.0
    for structure, shifted in MEMBERS:
        start = time.process_time()
        read_gain.__wrapped__(structure, shifted=shifted)
        worst = max(worst, time.process_time() - start)
    print(f"slowest member {worst:.2f} s")
    assert worst < 2.0


def test_what_the_page_says_of_the_first_design():
    """The table in the section's words, against the eigenvalues of the whole loop with both rotors lagged."""
    text = WORDS.read_text("utf-8")
    assert float(re.search(r"USUAL_LAG = ([\d.]+)", text)[1]) == USUAL_LAG
    table = re.search(r"EDGE = \[(.*?)\];", text, re.DOTALL)[1]
    rows = [tuple(map(float, row)) for row in re.findall(r"\[([-\d.]+), ([-\d.]+)\]", table)]
    assert len(rows) == 6
    for tau, largest in rows:
        rotors = Rotors(Rotor(tau=tau), Rotor(tau=tau))
        poles = loop_of(Spec.from_preset(rotors=rotors)).poles
        assert np.max(poles.real) == pytest.approx(largest, abs=6e-3)
    assert loop_of(Spec.from_preset()).lag_margin == pytest.approx(rows[4][0], abs=1e-4)


def test_steps_are_the_designs_own_where_it_places_the_rotors():
    rotors = Rotors(Rotor(tau=0.16), Rotor(tau=0.2))
    spec = Spec.from_preset(rotors=rotors, place_rotors=True, rotor_poles=(-20.0, -21.0))
    steps = rotor_steps(spec)
    assert steps.placed and steps.assumed == () and steps.rotor_poles == (-20.0, -21.0)
    np.testing.assert_array_equal(steps.K, place(spec).K)
    half = rotor_steps(Spec.from_preset(rotors=Rotors(Rotor(tau=0.3), Rotor())))
    assert not half.placed and half.assumed == ("yaw",)
    assert (half.names["tau_p"], half.names["tau_y"]) == (0.3, USUAL_LAG)
    curved = Rotors(Rotor(tau=0.1, curve="quadratic", dead_zone=1.0), Rotor(tau=0.1))
    steps = rotor_steps(Spec.from_preset(rotors=curved, place_rotors=True))
    assert steps.names["phi_p"] != 1.0 and steps.names["s_p"] > 0 and steps.names["v_d_p"] == 1.0
    assert steps.names["b_11"] == pytest.approx(steps.A[2, 4], rel=1e-14)
    refused = rotor_steps(Spec.from_preset("quanser-aero-2", rotors=curved))
    assert refused.K is None and "does not change with its speed" in refused.refused
    other = rotor_steps(Spec.from_preset(method="lqr"))
    assert other.K.shape == (2, 6) and "h_1" not in other.names


def test_observers_steps_are_the_usual_ones_or_the_specs():
    steps = observer_steps(Spec.from_preset())
    L = observer_formulas().written_out()
    values = {P[name]: x for name, x in Spec.from_preset().parameters.as_dict().items()}
    values |= {n.sin_0: 0, n.cos_0: 1} | dict(
        zip((n.q_1, n.q_2, n.q_3, n.q_4), (-40, -42, -41, -43), strict=True)
    )
    np.testing.assert_allclose(np.array(L.subs(values).evalf(), dtype=float), steps.L, rtol=1e-12, atol=1e-9)
    assert steps.asked == PoleSet([-40, -42, -41, -43]) and not steps.used


def test_structures_with_and_without_a_shift_differ_in_nothing_else():
    """A shift of 0 is the input-diagonal structure's own."""
    values = rationals(n.tau_p, n.tau_y)
    own, shifted = (read_gain(Structure("input-diagonal"), shifted=s) for s in (False, True))
    at_zero = shifted.written_out(shifted.gain).subs(n.c, 0)
    assert exactly(at_zero, values) == exactly(own.written_out(own.gain), values)
