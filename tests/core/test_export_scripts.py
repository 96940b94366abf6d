"""Exported scripts and data, run or read by the programs that they are for, against the core's numbers."""

from __future__ import annotations

import io
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.io import loadmat

from heli2dof_core import PRESETS, OuterLoop, Report, Scenario, Spec, evaluate, pole_error, preset
from heli2dof_core.export import FORMATS
from heli2dof_core.scenario import Digital, Disturbance
from tests.children import python

BASE = Spec.from_preset(preset())
MOVED = Scenario(0.3, -0.5, 2.0, 401, initial=(0.1, 0.2, -0.3, 0.4))
SPECS = {
    "default": BASE,
    "moved": replace(BASE, theta_0=0.25, scenario=MOVED),
    "static": replace(BASE, outer=OuterLoop("none"), scenario=MOVED),
    "cross": replace(BASE, outer=replace(BASE.outer, pairing="cross", decoupler=True)),
    "own-integral": replace(BASE, method="lqr-integral", scenario=MOVED),
    "aero": Spec.from_preset(PRESETS["quanser-aero"]),
}


@pytest.fixture(params=SPECS, scope="module")
def case(request: pytest.FixtureRequest) -> tuple[Spec, Report]:
    spec = SPECS[request.param]
    return spec, evaluate(spec)


def agree(names: dict, report: Report, integral: str) -> None:
    """The numbers of a script are the core's."""
    design, loop = report.design, report.loop
    expected = {
        "A": design.plant.A,
        "B": design.plant.B,
        "trim": design.plant.trim,
        "K": design.K,
        "P": loop.proportional,
        "F": loop.feedforward,
        "A_loop": loop.A,
        "B_loop": loop.B,
    } | ({} if loop.integral is None else {integral: loop.integral})
    for name, value in expected.items():
        found = np.reshape(names[name], value.shape)
        np.testing.assert_allclose(found, value, rtol=1e-12, atol=1e-12, err_msg=name)
    assert pole_error(np.ravel(names["loop_poles"]), loop.poles) < 1e-6  # double poles move with √ε
    response = report.step["linear"].response
    for name, values in zip(
        ("t", "theta", "psi", "V_p", "V_y"), (response.t, *response.angles, *response.voltages), strict=True
    ):
        assert np.max(np.abs(np.ravel(names[name]) - values)) < 1e-9, name


def test_the_python_script_runs_and_says_the_same(case):
    spec, report = case
    text = FORMATS["python"].render(spec)
    names: dict = {"__name__": "exported"}
    exec(compile(text, "heli2dof_design.py", "exec"), names)
    agree(names, report, "I")
    if report.design.aims:
        np.testing.assert_array_equal(names["poles"], report.design.poles.array)
        assert (
            names["distance"](np.linalg.eigvals(names["A"] - names["B"] @ names["K"]), names["poles"]) < 1e-9
        )
    assert {type(names["plant"]).__name__, type(names["loop"]).__name__} == {"StateSpace"}


def test_the_call_for_figures_of_merit_that_the_script_names_gives_them():
    text = FORMATS["python"].render(BASE)
    names: dict = {"__name__": "exported"}
    exec(compile(text, "heli2dof_design.py", "exec"), names)
    (call,) = (line[2:] for line in text.splitlines() if line.startswith("# ct."))
    info = eval(call, names)
    alone = replace(BASE, scenario=replace(BASE.scenario, theta=0.1, psi=None))
    own = evaluate(alone).step["linear"].metrics.axes["theta"]
    sample = names["t"][1]
    assert info["SettlingTime"] == pytest.approx(own.settling_time, abs=2 * sample)
    assert info["Overshoot"] == pytest.approx(own.overshoot, abs=0.01)


def test_the_python_script_is_a_program(tmp_path: Path):
    script = tmp_path / FORMATS["python"].filename
    script.write_bytes(FORMATS["python"].content(BASE, "http://127.0.0.1:8000/#x"))
    shown = python("-W", "ignore", str(script), cwd=tmp_path, MPLBACKEND="Agg")
    assert "poles of the whole loop" in shown and "51.17005" in shown


def octave(text: str, folder: Path) -> dict:
    """What the script leaves behind in GNU Octave."""
    program = shutil.which("octave-cli") or shutil.which("octave")
    if program is None:
        pytest.skip("no GNU Octave here")
    (folder / "heli2dof_design.m").write_text(text, encoding="ascii")
    numbers = "known = whos; names = {known(strcmp({known.class}, 'double')).name};"
    run = f"no_plots = true; heli2dof_design; {numbers} save('-v6', 'out.mat', names{{:}});"
    command = [program, "--no-gui", "--no-init-file", "--no-history", "--quiet", "--eval", run]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and not done.stderr, done.stderr
    assert "The placed poles are off by" in done.stdout
    return loadmat(str(folder / "out.mat"))


def on_the_rig(names: dict, report: Report) -> None:
    """The script's nonlinear response, by Octave's ode45, is the core's: to 3e-5 rad, where a motor is at its limit
    or friction holds an axis, since there it approximates; else to the solvers' tolerances."""
    response = report.step["nonlinear"].response
    voltages = [np.ravel(names[name]) for name in ("V_p_rig", "V_y_rig")]
    bounds = np.ravel(names["limit"])
    rough = (
        any(np.any(np.abs(v) > 0.999 * b) for v, b in zip(voltages, bounds, strict=True)) or "creep" in names
    )
    for name, values in zip(("theta_rig", "psi_rig"), response.angles, strict=True):
        assert np.max(np.abs(np.ravel(names[name]) - values)) < (5e-5 if rough else 2e-8), name
    for found, values in zip(voltages, response.voltages, strict=True):
        assert np.max(np.abs(found - values)) < (5e-3 if rough else 2e-6)


def test_the_matlab_script_runs_in_octave_and_says_the_same(case, tmp_path: Path):
    spec, report = case
    names = octave(FORMATS["matlab"].render(spec, "http://127.0.0.1:8000/#x"), tmp_path)
    agree(names, report, "I_z")
    on_the_rig(names, report)
    assert names["pole_error"][0, 0] < 1e-9
    if report.design.aims:
        np.testing.assert_array_equal(names["poles"].ravel(), report.design.poles.array)


RIG = {
    "stop": Scenario(0.9, 0.2, 2.0, 201),
    "from-a-stop": Scenario(0.1, 0.2, 2.0, 201, initial=(-0.9, 0.0, 0.0, 0.3)),
    "back-calculation": Scenario(0.5, -0.8, 2.0, 201, anti_windup="back-calculation"),
    "windup": Scenario(0.5, -0.8, 2.0, 201, anti_windup="none"),
    "clamping": Scenario(0.5, -0.8, 2.0, 201),
    "unlimited": Scenario(0.5, -0.8, 2.0, 201, saturation=False),
    "disturbed": Scenario(0.2, 0.1, 2.0, 201, disturbance=Disturbance(3.0, -2.0, 1.005)),
    "without-trim": Scenario(0.2, 0.1, 2.0, 201, trim_feedforward=False),
}


@pytest.mark.parametrize("scenario", RIG.values(), ids=RIG)
def test_the_nonlinear_rig_of_the_script_is_the_cores(scenario: Scenario, tmp_path: Path):
    spec = replace(BASE, scenario=scenario)
    on_the_rig(octave(FORMATS["matlab"].render(spec), tmp_path), evaluate(spec))


def test_the_script_says_that_its_controller_is_continuous():
    text = FORMATS["matlab"].render(replace(BASE, scenario=replace(MOVED, digital=Digital())))
    assert "sampling, encoders and noise are left out" in text
    assert "sampling" not in FORMATS["matlab"].render(BASE)


def test_the_mat_file_holds_the_design_and_both_responses(case):
    spec, report = case
    content = FORMATS["mat"].content(spec)
    assert content == FORMATS["mat"].content(spec) and content.startswith(b"MATLAB 5.0 MAT-file, heli2dof ")
    names = loadmat(io.BytesIO(content))
    linear = names["linear"][0, 0]
    agree({**names, **{name: linear[name] for name in linear.dtype.names}}, report, "I_z")
    rig = report.step["nonlinear"].response
    for name, values in zip(("theta", "psi", "theta_dot", "psi_dot"), rig.states, strict=False):
        np.testing.assert_array_equal(names["nonlinear"][0, 0][name].ravel(), values)
    assert names["parameters"][0, 0]["K_pp"] == spec.parameters.K_pp
    assert "POST /api/v1/export/mat" in names["about"][0]


def test_octave_reads_the_mat_file(tmp_path: Path):
    (tmp_path / "heli2dof_data.mat").write_bytes(FORMATS["mat"].content(BASE))
    names = octave("load heli2dof_data.mat\ndisp('The placed poles are off by 0')\n", tmp_path)
    np.testing.assert_array_equal(names["K"], evaluate(BASE).design.K)


def test_the_csv_holds_both_responses_to_the_last_digit(case):
    spec, report = case
    text = FORMATS["csv"].render(spec)
    comments = [line for line in text.splitlines() if line.startswith("#")]
    header = text.splitlines()[len(comments)].split(",")
    table = dict(
        zip(header, np.loadtxt(io.StringIO(text), delimiter=",", skiprows=len(comments) + 1).T, strict=True)
    )
    for model, step in report.step.items():
        response = step.response
        np.testing.assert_array_equal(table["t [s]"], response.t)
        for name, values in zip(
            ("theta", "psi", "V_p", "V_y"), (*response.angles, *response.voltages), strict=True
        ):
            unit = "V" if name.startswith("V") else "rad"
            np.testing.assert_array_equal(table[f"{name}_{model} [{unit}]"], values)
    assert table["theta_reference [rad]"][0] == report.step["linear"].response.reference[0]
    assert ("z_y_nonlinear [rad*s]" in table) == report.loop.has_integrators


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_names_its_rig_poles_version_and_call(name: str):
    chosen = FORMATS[name]
    assert chosen.name == name and chosen.filename.startswith("heli2dof_")
    text = chosen.content(BASE, "http://127.0.0.1:8000/#poles=x").decode("latin-1")
    if name == "mat":
        text = str(loadmat(io.BytesIO(chosen.content(BASE, "http://127.0.0.1:8000/#poles=x")))["about"][0])
    for said in ("heli2dof ", "quanser-2dof-manual", f"/api/v1/export/{name}", "#poles=x"):
        assert said in text, said
