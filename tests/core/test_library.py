"""The library as its users meet it: changes of a spec, python-control's and SymPy's objects, the examples."""

from __future__ import annotations

import doctest
import importlib
from dataclasses import replace

import control
import numpy as np
import pytest
import sympy as sp

import heli2dof_core as heli
from tests.children import python

WITH_EXAMPLES = (
    *("heli2dof_core", "heli2dof_core.design", "heli2dof_core.spec", "heli2dof_core.formulas"),
    *("heli2dof_core.plant", "heli2dof_core.symbolic.formulas", "heli2dof_core.tables"),
)


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_examples_in_docstrings(name):
    results = doctest.testmod(importlib.import_module(name), optionflags=doctest.ELLIPSIS)
    assert results.attempted > 0 and results.failed == 0


def test_changes_are_what_they_say_and_nothing_else():
    spec = heli.Spec.from_preset("quanser-aero-2")
    changed = spec.changed(
        poles=[-1, -2, -3, -4],
        coupling="axis-decoupled",
        parameters={"J_p": 0.03},
        theta_0=0.1,
        pitch=(5, 0.5),
        decoupler=True,
        reference=(None, 0.2),
        duration=2.0,
    )
    assert changed == replace(
        spec,
        poles=heli.PoleSet([-1, -2, -3, -4]),
        structure=heli.Structure("axis-decoupled"),
        parameters=replace(spec.parameters, J_p=0.03),
        theta_0=0.1,
        outer=replace(spec.outer, pitch=heli.PIGains(5, 0.5), decoupler=True),
        scenario=replace(spec.scenario, theta=None, psi=0.2, duration=2.0),
    )
    assert spec.changed() == spec == heli.Spec.from_preset(heli.preset("quanser-aero-2"))


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"poles": [-1, -2, -3]}, "poles"),
        ({"poles": [-1, -2 + 1j, -3, -4]}, "poles.1"),
        ({"parameters": {"J_p": -1.0}}, "parameters.J_p"),
        ({"pitch": (1.0, 0.0)}, "outer.pitch.ti"),
        ({"duration": -1.0}, "scenario.duration"),
        ({"coupling": "loose"}, "structure.coupling"),
    ],
)
def test_a_wrong_change_names_its_field(change, field):
    with pytest.raises(heli.Heli2DofError) as refused:
        heli.Spec.from_preset(**change)
    assert refused.value.field == field


def test_python_control_sees_the_same_systems():
    spec = heli.Spec.from_preset(reference=(0.05, 0.02), duration=1.0)
    report = heli.evaluate(spec)
    plant, inner = report.design.plant.to_control(), report.design.to_control()
    assert (plant.input_labels, plant.output_labels) == (["V_p", "V_y"], ["theta", "psi"])
    assert plant.state_labels == ["theta", "psi", "theta_dot", "psi_dot"]
    np.testing.assert_allclose(
        sorted(inner.poles().real), sorted(p.real for p in spec.poles.values), atol=1e-9
    )
    fed_back = control.ss(plant.A, plant.B, np.eye(4), 0).feedback(control.ss([], [], [], report.design.K))
    np.testing.assert_allclose(fed_back.A, inner.A, atol=1e-12)

    whole = report.loop.to_control(voltages=True)
    assert whole.input_labels == ["theta_ref", "psi_ref"]
    assert whole.output_labels == ["theta", "psi", "V_p", "V_y"]
    assert whole.state_labels[4:] == ["z_p", "z_y"]
    own = report.step["linear"].response
    r = np.outer([0.05, 0.02], np.ones_like(own.t))
    theirs = control.forced_response(whole, own.t, r).outputs
    np.testing.assert_allclose(theirs, np.vstack((own.angles, own.voltages)), atol=2e-5)
    np.testing.assert_allclose(report.loop.to_control().A, whole.A)


def test_formulas_are_sympys_and_their_numbers_the_designs():
    spec = heli.Spec.from_preset(theta_0=0.3, poles=[-3 + 4j, -3 - 4j, -5, -6], coupling="input-diagonal")
    f, placed = heli.formulas("input-diagonal"), heli.place(spec)
    rig = spec.parameters
    np.testing.assert_allclose(f.numbers(f.K, rig, spec.poles, angle=0.3), placed.K, rtol=1e-9)
    np.testing.assert_allclose(f.numbers(f.A, rig, angle=0.3), placed.plant.A, rtol=1e-12)
    np.testing.assert_allclose(f.numbers(f.trim, rig, angle=0.3)[:, 0], placed.plant.trim, rtol=1e-9)
    rga = heli.interaction(placed).rga
    np.testing.assert_allclose(f.numbers(f.RGA, rig, spec.poles, angle=0.3), rga, rtol=1e-8)
    assert isinstance(f.K, sp.ImmutableMatrix) and f.K.free_symbols <= set(f.symbols.values())
    with pytest.raises(ValueError, match="p_1"):
        f.numbers(f.K, rig)
    with pytest.raises(ValueError, match="s"):
        f.numbers(f.G, rig, spec.poles)
    assert sp.latex(f.symbols["J_p"]) in sp.latex(f.mechanics.mass_matrix)


@pytest.mark.slow
def test_the_shift_can_stay_a_symbol():
    f = heli.formulas(shifted=True)
    spec = heli.Spec.from_preset()
    shifted = replace(spec, structure=heli.Structure(shift=0.25))
    own = f.numbers(f.K, spec.parameters, spec.poles, shift=0.25)
    np.testing.assert_allclose(own, heli.place(shifted).K, rtol=1e-9)


def test_the_import_is_light_and_the_rest_comes_when_asked_for():
    code = (
        "import sys, heli2dof_core as heli; "
        "print([m for m in ('sympy', 'control', 'scipy', 'numba', 'matplotlib') if m in sys.modules]); "
        "import heli2dof_core.symbolic.rga; heli.symbolic.rga, heli.paper; "
        "print('sympy' in sys.modules, hasattr(heli, 'nonsense'))"
    )
    shown = python("-c", code)
    assert shown.split("\n") == ["[]", "True False", ""]
