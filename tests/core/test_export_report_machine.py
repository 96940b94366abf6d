"""The laboratory report of the rig as it is: its words, its numbers, and formulas that give its K."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

from heli2dof_core import Report, Rotor, Rotors, Spec, Structure, evaluate
from heli2dof_core.export import FORMATS
from heli2dof_core.export.report_formulas import formulas
from heli2dof_core.figures.written import seconds
from heli2dof_core.tables import number
from tests.core.test_export_machine import BASE, BOTH, SIX, SPECS
from tests.core.test_export_report import tree


@cache
def page_of(name: str) -> tuple[Report, ET.Element, str]:
    spec = SPECS[name]
    page = tree(FORMATS["report"].render(spec))
    return evaluate(spec, each_axis=True), page, " ".join("".join(page.itertext()).split())


@pytest.mark.parametrize("name", SPECS)
def test_the_report_holds_machine_gains_and_poles(name: str):
    report, page, words = page_of(name)
    design, loop = report.design, report.loop
    estimator = loop.estimator
    for value in (
        *design.K.ravel(),
        *([] if estimator is None or estimator.L is None else estimator.L.ravel()),
    ):
        assert number(value, 6) in words
    rows = {row[0].text: [cell.text for cell in row[1:]] for row in page.iter("tr")}
    own = design.actuators
    told = {"τ": "tau", "s": "square", "v_d": "dead_zone", "F_c": "coulomb", "F_s": "breakaway"}
    for symbol, attribute in told.items():
        values = np.zeros(2) if own is None else getattr(own, attribute)
        assert (symbol in rows) == bool(values.any())
        if symbol in rows:
            assert rows[symbol][1:3] == [number(value, 6) for value in values]
    assert (
        ("p₅" in rows)
        == (design.rotor_poles is not None)
        == ("v_p, v_y], in V/rad, V·s/rad and V/V" in words)
    )
    assert ("A − LC" in words) == (estimator is not None and estimator.L is not None)
    assert ("filtered from them" in words) == (SPECS[name].scenario.measured == "filtered")
    assert ("Lag margin" in words) == report.loop.stable
    assert "nan" not in words.lower().split() and "None" not in words


@pytest.mark.parametrize("name", SPECS)
def test_rotors_that_lag_have_curves(name: str):
    report, page, _ = page_of(name)
    own = report.design.actuators
    lagging = 0 if own is None else int(np.sum(own.tau > 0))
    kinds = [line.get("class") for line in page.iter("polyline")]
    assert all(kinds.count(kind) == 4 + lagging for kind in ("pitch", "yaw", "pitch-linear", "yaw-linear"))


def test_the_lag_margin_is_the_loops():
    report, _, words = page_of("six")
    assert report.loop.lag_margin is not None
    assert f"Lag margin: {seconds(report.loop.lag_margin)}, the least time constant" in words


STRUCTURES = [
    Structure("triangular", "pitch"),
    Structure("triangular", "yaw"),
    Structure("input-diagonal"),
    Structure("axis-decoupled"),
    Structure("triangular", "pitch", 0.3),
]


@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda s: f"{s.coupling}-{s.lead}-{s.shift}")
@pytest.mark.parametrize("rotors", [BOTH, Rotors(Rotor(0.05), Rotor(0.2))], ids=["curved", "lagging"])
def test_the_formulas_give_the_gain(structure: Structure, rotors: Rotors):
    """Read as a reader would: cubics by their poles, thrust constants by the slopes."""
    spec = replace(BASE, rotors=rotors, **SIX, structure=structure, theta_0=0.1)
    design = evaluate(spec).design
    found = formulas(design)
    assert found["relative"] is None
    values = dict(spec.parameters.as_dict()) | {"c": structure.shift or 0.0}
    values |= {"sin_0": np.sin(spec.theta_0), "cos_0": np.cos(spec.theta_0)}
    values |= dict(zip(("tau_p", "tau_y"), design.actuators.tau.tolist(), strict=True))
    slope = design.actuators.slope.tolist()
    for motor, names in enumerate((("K_pp", "K_yp"), ("K_py", "K_yy"))):
        values |= {name: values[name] * slope[motor] for name in names}
    p = design.wanted.real
    for i, triple in ((1, p[[0, 1, 4]]), (2, p[[2, 3, 5]])):
        _, *cubic = np.poly(triple)
        values |= {f"d_{i}{2 - k}": float(value) for k, value in enumerate(cubic)}
    symbols = {sp.Symbol(name): value for name, value in values.items()}
    for name, definition in found["symbols"].definitions.items():
        symbols[sp.Symbol(name)] = float(sp.sympify(definition.sympy).subs(symbols))
    for index, entry in found["gains"].items():
        i, j = int(index[0]) - 1, int(index[1]) - 1
        value = float(sp.sympify(entry.sympy).subs(symbols))
        assert value == pytest.approx(design.K[i, j], rel=1e-9, abs=1e-9 * np.max(np.abs(design.K)))


def test_noise_is_told_and_nothing_of_the_machine_where_there_is_none():
    noisy = replace(BASE, scenario=replace(BASE.scenario, noise=(0.001, 0.002)))
    plain, told = (FORMATS["report"].render(spec) for spec in (BASE, noisy))
    assert "white noise on the measured angles, standard deviations 0.0573° and 0.1146°" in told
    for word in ("rotor's speed", "riction", "observer", "estimate", "beyond the paper"):
        assert word not in plain


def test_a_relative_gain_in_symbols_is_that_of_linear_thrust():
    spec: Spec = SPECS["curves"]
    assert formulas(evaluate(spec).design)["relative"] is None
    assert formulas(evaluate(SPECS["lag"]).design)["relative"] is not None
