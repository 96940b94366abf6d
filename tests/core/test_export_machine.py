"""Exported scripts and data of the rig as it is: rotors, thrust curves, friction, estimators."""

from __future__ import annotations

import io
import re
from dataclasses import replace
from pathlib import Path

import control
import numpy as np
import pytest
from scipy.io import loadmat

from heli2dof_core import (
    AxisFriction,
    Friction,
    Observer,
    OuterLoop,
    PoleSet,
    Report,
    Rotor,
    Rotors,
    Scenario,
    Spec,
    evaluate,
    pole_error,
)
from heli2dof_core.export import FORMATS
from tests.children import python
from tests.core.test_export_scripts import octave, on_the_rig

BASE = Spec.from_preset("quanser-2dof-manual")
MOVED = Scenario(0.1, -0.2, 1.0, 101, initial=(0.05, 0.1, -0.1, 0.1))
LAG = Rotors(Rotor(0.12), Rotor(0.1))
PITCH_ALONE = Rotors(Rotor(0.05, "quadratic", 1.0, 12.0), Rotor(curve="quadratic"))
CURVES = Rotors(Rotor(curve="quadratic", dead_zone=0.5), Rotor())
BOTH = Rotors(Rotor(0.12, "quadratic", 0.8), Rotor(0.1, "quadratic", 0.4, 9.0))
FRICTION = AxisFriction(Friction(0.001, 0.002), Friction(0.003))
KALMAN = Observer(method="kalman", voltage_noise=2.0, angle_noise=2e-4)
COMPLEX = Observer(PoleSet([-30 + 10j, -30 - 10j, -25, -35]), coupling="triangular", lead="yaw")
SIX = {"place_rotors": True, "rotor_poles": (-15.0, -17.0)}
GENTLE = {"poles": PoleSet([-4, -5, -3 + 2j, -3 - 2j]), "outer": OuterLoop("none")}
SPECS = {
    "lag": replace(BASE, rotors=LAG, scenario=MOVED),
    "one-lags": replace(BASE, rotors=PITCH_ALONE, friction=FRICTION, **GENTLE, scenario=MOVED),
    "curves": replace(BASE, rotors=CURVES, theta_0=0.2, scenario=MOVED),
    "friction": replace(BASE, friction=FRICTION, scenario=MOVED),
    "six": replace(BASE, rotors=BOTH, **SIX, scenario=MOVED),
    "six-alone": replace(BASE, rotors=LAG, **SIX, outer=OuterLoop("none"), scenario=MOVED),
    "six-lqr": replace(BASE, rotors=LAG, **SIX, method="lqr", scenario=MOVED),
    "filtered": replace(BASE, scenario=replace(MOVED, measured="filtered")),
    "six-filtered": replace(BASE, rotors=LAG, **SIX, scenario=replace(MOVED, measured="filtered")),
    "observer": replace(BASE, theta_0=0.2, scenario=replace(MOVED, measured="observer")),
    "kalman": replace(BASE, rotors=CURVES, observer=KALMAN, scenario=replace(MOVED, measured="observer")),
    "observer-alone": replace(
        BASE, rotors=PITCH_ALONE, observer=COMPLEX, **GENTLE, scenario=replace(MOVED, measured="observer")
    ),
    "six-observer": replace(BASE, rotors=BOTH, **SIX, scenario=replace(MOVED, measured="observer")),
    "six-kalman": replace(
        BASE,
        rotors=LAG,
        **SIX,
        observer=KALMAN,
        outer=OuterLoop("none"),
        scenario=replace(MOVED, measured="observer"),
    ),
    "own-integral": replace(
        BASE, rotors=LAG, method="lqr-integral", scenario=replace(MOVED, measured="observer")
    ),
}


@pytest.fixture(params=SPECS, scope="module")
def case(request: pytest.FixtureRequest) -> tuple[Spec, Report]:
    spec = SPECS[request.param]
    return spec, evaluate(spec)


def agree(names: dict, report: Report, integral: str) -> None:
    """The numbers of a file are the core's."""
    design, loop, estimator = report.design, report.loop, report.loop.estimator
    expected = {"A": design.plant.A, "B": design.plant.B, "trim": design.trim, "K": design.K}
    expected |= {"P": loop.proportional, "F": loop.feedforward, "A_loop": loop.A, "B_loop": loop.B}
    expected |= {"law": loop.voltage_from_state, "law_of_reference": loop.voltage_from_reference}
    expected |= {} if loop.integral is None else {integral: loop.integral}
    if design.rotor_poles is not None:
        expected |= {"A_plus": design.model[0], "B_plus": design.model[1]}
    if design.actuators is not None and design.actuators.square.any():
        expected["slope"] = design.actuators.slope
    if estimator is not None:
        expected |= {"F_w": estimator.F, "G_w": estimator.G, "H_w": estimator.H}
        expected |= {} if estimator.L is None else {"L": estimator.L}
    for name, value in expected.items():
        scale = max(1.0, np.max(np.abs(value)))
        found = np.reshape(names[name], value.shape)
        np.testing.assert_allclose(found, value, rtol=1e-12, atol=1e-14 * scale, err_msg=name)
    assert pole_error(np.ravel(names["loop_poles"]), loop.poles) < 1e-5  # multiple poles move with roots of ε
    response = report.step["linear"].response
    for name, values in zip(
        ("t", "theta", "psi", "V_p", "V_y"), (response.t, *response.angles, *response.voltages), strict=True
    ):
        size = max(1.0, np.max(np.abs(values)))
        assert np.max(np.abs(np.ravel(names[name]) - values)) < 1e-9 * size, name


def test_the_python_script_says_the_same(case):
    spec, report = case
    text = FORMATS["python"].render(spec)
    names: dict = {"__name__": "exported"}
    exec(compile(text, "heli2dof_design.py", "exec"), names)
    agree(names, report, "I")
    A, B = (names["A_plus"], names["B_plus"]) if spec.place_rotors else (names["A"], names["B"])
    if report.design.aims:
        np.testing.assert_array_equal(names["poles"], report.design.wanted)
        assert names["distance"](np.linalg.eigvals(A - B @ names["K"]), names["poles"]) < 1e-6
    if spec.scenario.measured == "observer" and spec.observer is not KALMAN:
        found = np.linalg.eigvals(names["A"] - names["L"] @ names["C"])
        assert names["distance"](found, names["observer_poles"]) < 1e-6
    if spec.actuators is not None and spec.actuators.lags:
        assert isinstance(names["rig"], control.StateSpace) and len(names["rig"].A) == len(names["A_plus"])


def test_the_matlab_script_says_the_same_in_octave(case, tmp_path: Path):
    spec, report = case
    names = octave(FORMATS["matlab"].render(spec, "http://127.0.0.1:8000/#x"), tmp_path)
    on_the_rig(names, report)
    agree(names, report, "I_z")
    assert names["pole_error"][0, 0] < 1e-6
    if spec.scenario.measured == "observer" and spec.observer is not KALMAN:
        assert names["observer_error"][0, 0] < 1e-6


def test_the_linear_response_is_python_controls(case):
    """The response that both scripts are held to, by the loop that the core gives python-control."""
    _, report = case
    response, loop = report.step["linear"].response, report.loop
    start = response.states[:, 0] - np.eye(len(loop.A))[0] * report.design.plant.theta_0
    deviations = np.array(response.reference) - [report.design.plant.theta_0, 0.0]
    expected = control.forced_response(
        loop.to_control(voltages=True), response.t, np.tile(deviations[:, None], len(response.t)), start
    ).outputs
    found = np.vstack([response.angles - [[report.design.plant.theta_0], [0.0]], response.voltages])
    assert np.max(np.abs(found - expected)) < 1e-8 * max(1.0, np.max(np.abs(expected)))


@pytest.mark.parametrize("name", ["six-observer", "kalman"])
def test_the_python_script_is_a_program(name: str, tmp_path: Path):
    script = tmp_path / FORMATS["python"].filename
    script.write_bytes(FORMATS["python"].content(SPECS[name]))
    shown = python("-W", "ignore", str(script), cwd=tmp_path, MPLBACKEND="Agg")
    assert "poles of A - LC" in shown and "poles of the whole loop" in shown
    off = [float(text) for text in re.findall(r"off by (\S+)", shown)]
    assert len(off) == (2 if name == "six-observer" else 1) and max(off) < 1e-6


def test_the_mat_file_holds_machine_estimator_and_states(case):
    spec, report = case
    names = loadmat(io.BytesIO(FORMATS["mat"].content(spec)))
    linear, rig = (names[model][0, 0] for model in ("linear", "nonlinear"))
    agree(
        {"slope": np.ones(2), **names, **{name: linear[name] for name in linear.dtype.names}}, report, "I_z"
    )
    for signal, values in report.step["nonlinear"].response.by_signal():
        np.testing.assert_array_equal(rig[signal.name].ravel(), values)
    assert {signal.name for signal in report.loop.states} < set(rig.dtype.names)
    np.testing.assert_array_equal(names["poles"].ravel(), report.design.wanted)
    own = report.design.actuators
    assert ("tau" in names) == (own is not None)
    if own is not None:
        for name in ("tau", "dead_zone", "square", "slope", "coulomb", "breakaway"):
            np.testing.assert_array_equal(names[name].ravel(), getattr(own, name))
    estimator = report.loop.estimator
    if estimator is not None:
        np.testing.assert_array_equal(names["x_from_w"], estimator.from_state)
        np.testing.assert_array_equal(names["x_from_y"], estimator.from_angles)


def test_the_csv_holds_every_state(case):
    spec, report = case
    text = FORMATS["csv"].render(spec)
    lines = text.splitlines()
    comments = [line for line in lines if line.startswith("#")]
    header = lines[len(comments)].split(",")
    table = dict(
        zip(header, np.loadtxt(io.StringIO(text), delimiter=",", skiprows=len(comments) + 1).T, strict=True)
    )
    for model, step in report.step.items():
        for signal, values in step.response.by_signal():
            unit = f" [{signal.unit.replace('·', '*')}]" if signal.unit else ""
            np.testing.assert_array_equal(table[f"{signal.name}_{model}{unit}"], values)
    said = "\n".join(comments)
    lags = report.design.actuators is not None and report.design.actuators.lags
    assert ("Rotors' speeds v_p" in said) == lags == ("v_p_nonlinear [V]" in table)
    assert ("w_3: theta_dot" in said) == (spec.scenario.measured == "observer")
    assert ("w_1_linear" in table) == (report.loop.estimator is not None)
    assert ("w_6: v_y" in said) == (spec.place_rotors and spec.scenario.measured == "observer")


WORDS = (
    "rotors",
    "Rotors",
    "friction",
    "Friction",
    "observer",
    "Observer",
    "estimate",
    "tau",
    "slope",
    "A_plus",
    "F_w",
    "lag",
)


@pytest.mark.parametrize("name", ["python", "matlab", "c-header", "c-source", "csv"])
def test_nothing_is_said_where_all_is_the_papers(name: str):
    """Nor where rotors are given that change nothing: a dead zone belongs to a curve."""
    idle = replace(BASE, rotors=Rotors(Rotor(dead_zone=1.0, matched_at=5.0), Rotor()))
    plain, other = (FORMATS[name].render(spec).splitlines() for spec in (BASE, idle))
    assert [a for a, b in zip(plain, other, strict=True) if a != b] == [
        line for line in plain if line.endswith('{"preset": "quanser-2dof-manual"}')
    ]
    text = "\n".join(plain)
    assert not [word for word in WORDS if word in text]
