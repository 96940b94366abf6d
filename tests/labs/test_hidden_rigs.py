"""Labs whose true rig is hidden: designs flown on another rig than their own, recordings, what pages are told."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from heli2dof_core import InvalidInputError, evaluate, place, plant, spec_of, warm_up
from heli2dof_core.eigenvalues import eigenvalues
from heli2dof_core.labs import (
    instructor_view,
    mark,
    problems_of,
    read_lab,
    recording_csv,
    shipped_labs,
    start_body,
    student_rig,
    student_view,
    true_rig,
)
from heli2dof_core.labs.bodies import body_of_flat
from heli2dof_core.labs.flown import fly
from heli2dof_core.labs.rigs import solution_flat
from heli2dof_core.recordings.files import read_table
from heli2dof_core.recordings.identification import identify
from heli2dof_core.recordings.recording import Columns, recording_of
from tests.labs.test_reading import SMALL

OLD = {"K_pp": 0.16, "K_yy": 0.05, "B_p": 1.2, "B_y": 0.5}
ROLES = ("time", "theta", "psi", "V_p", "V_y", "theta_ref", "psi_ref")


@pytest.fixture(scope="module", autouse=True)
def kernels():
    warm_up()


def specs(**body):
    design = spec_of({"poles": [-5, -6, {"re": -4, "im": 3}, {"re": -4, "im": -3}], **body})
    return design, replace(design, parameters=design.parameters.replaced(OLD))


@pytest.mark.parametrize("outer", ["none", "pi"])
def test_a_design_on_its_own_rig_is_as_ever(outer):
    design, _ = specs(outer=outer)
    flown, known = fly(design, design), evaluate(design, each_axis=True)
    for axis in ("theta", "psi"):
        mine, theirs = (report.axis_steps[axis]["nonlinear"].metrics for report in (flown, known))
        assert mine == theirs


@pytest.mark.parametrize("outer", ["none", "pi"])
@pytest.mark.parametrize("theta_0", [0.0, 0.2])
def test_poles_are_those_of_the_rig_that_is_flown_under_the_gain_that_was_designed(outer, theta_0):
    design, rig = specs(outer=outer, operating_point={"theta": theta_0})
    K, true = place(design).K, plant(rig.parameters, theta_0)
    A = true.A - true.B @ K
    if outer == "pi":
        P = np.diag([design.outer.pitch.kp, design.outer.yaw.kp])
        integral = np.diag([pi.kp / pi.ti for pi in (design.outer.pitch, design.outer.yaw)])
        C = np.eye(2, 4)
        A = np.block([[A - true.B @ P @ C, true.B @ integral], [-C, np.zeros((2, 2))]])
    mine = np.sort_complex(np.array(fly(design, rig).judged.connected))
    assert mine == pytest.approx(np.sort_complex(eigenvalues(A)), rel=1e-9)


def test_the_linear_course_is_that_of_both(outer="none"):
    design, rig = specs(outer=outer, scenario={"reference": {"psi": 0.1}, "duration": 2.0, "samples": 41})
    placed, true = place(design), plant(rig.parameters, 0.0)
    A, v = true.A - true.B @ placed.K, placed.steady_state_inverse @ [0.0, 0.1]
    big = np.zeros((5, 5))
    big[:4, :4], big[:4, 4] = A, true.B @ v
    response = fly(design, rig).step["linear"].response
    for i in (0, 7, 20, 40):
        expected = expm(big * 0.05 * i) @ [0, 0, 0, 0, 1]
        assert response.angles[:, i] == pytest.approx(expected[:2], abs=1e-9)


def test_the_rig_starts_at_rest_on_its_own_trim():
    design, rig = specs(outer="none", scenario={"reference": {"psi": 0.0}, "duration": 2.0})
    report = fly(design, rig)
    assert report.step["nonlinear"].response.angles == pytest.approx(0.0, abs=1e-7)
    assert report.judged.trim == pytest.approx(plant(rig.parameters, 0.0).trim.tolist())


def test_an_observer_of_another_rig_is_refused():
    design, rig = specs(scenario={"measured": "observer"})
    with pytest.raises(InvalidInputError) as refused:
        fly(design, rig)
    assert refused.value.field == "scenario.measured"


def identify_lab():
    return shipped_labs()["identify"]


def test_pages_are_told_of_the_printed_rig_alone():
    lab = identify_lab()
    printed = student_rig(lab, 1)
    assert printed == student_rig(lab, 2)
    assert true_rig(lab, 1) != true_rig(lab, 2)
    assert "parameters" not in printed
    told = student_view(lab)
    assert told["hidden_rig"] and "worn" not in json.dumps(told) and "vary" not in told
    assert all(step["recording"] for step in told["steps"])
    assert all(goal["page"] is False for step in told["steps"] for goal in step["goals"])
    assert instructor_view(lab)["worn"]["parameters"]["K_yy"] == 0.052
    other = student_view(shipped_labs()["digital"])
    assert not any(step["recording"] for step in other["steps"])
    assert not any("page" in goal for step in other["steps"] for goal in step["goals"])


def test_goals_are_judged_on_the_true_rig_and_answers_are_of_it():
    lab, seed = identify_lab(), 11
    rig = student_rig(lab, seed)
    start = start_body(lab, "numbers", rig)
    K_yy = true_rig(lab, seed)["parameters"]["K_yy"]
    marked = mark(lab, "numbers", rig, start, {"thrust": 0.072}, seed=seed)
    assert not any(goal.met for goal in marked.goals) and not marked.questions[0].met
    solved = body_of_flat(solution_flat(lab, lab.step("numbers"), rig, seed))
    marked = mark(lab, "numbers", rig, solved, {"thrust": f"{K_yy:.4f} N·m/V"}, seed=seed)
    assert all(goal.met for goal in marked.goals) and marked.questions[0].met
    assert not marked.ignored
    true = spec_of({**solved, **{k: v for k, v in true_rig(lab, seed).items() if k == "parameters"}})
    rise = evaluate(true, each_axis=True).axis_steps["psi"]["nonlinear"].metrics.axes["psi"].rise_time
    assert marked.goals[1].value == pytest.approx(rise, rel=1e-6)


def test_nobody_else_is_judged_without_a_seed():
    lab = identify_lab()
    rig = student_rig(lab, 0)
    with pytest.raises(InvalidInputError, match="no student"):
        mark(lab, "numbers", rig, start_body(lab, "numbers", rig), {})


def test_a_recording_is_the_students_own_and_tells_no_truth():
    lab = identify_lab()
    one = recording_csv(lab, "numbers", 5)
    assert one == recording_csv(lab, "numbers", 5) != recording_csv(lab, "numbers", 6)
    text = one.decode()
    assert not any(f"{value:.4g}" in text.split("\n")[0] for value in true_rig(lab, 5)["parameters"].values())
    with pytest.raises(InvalidInputError, match="has no recordings"):
        recording_csv(shipped_labs()["digital"], "slow", 5)
    with pytest.raises(InvalidInputError):
        recording_csv(lab, "nothing", 5)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [3, 77])
def test_a_recording_tells_the_true_numbers_well_enough_for_the_questions(seed):
    lab = identify_lab()
    table = read_table(recording_csv(lab, "numbers", seed), "rig.csv")
    recording = recording_of(table, Columns({role: role for role in ROLES}))
    sheet = spec_of(student_rig(lab, seed))
    limits = (sheet.limits.V_p, sheet.limits.V_y)
    found = identify(sheet.parameters, recording, limits=limits, held_out=1 / 3)
    for name, value in true_rig(lab, seed)["parameters"].items():
        assert getattr(found.parameters, name) == pytest.approx(value, rel=0.03)
    start = start_body(lab, "numbers", student_rig(lab, seed))
    start["parameters"] |= {name: getattr(found.parameters, name) for name in OLD}
    marked = mark(lab, "numbers", student_rig(lab, seed), start, {}, seed=seed)
    assert all(goal.met for goal in marked.goals)


def test_only_a_hidden_rig_is_worn():
    text = SMALL.replace("steps:\n", "worn: {parameters: {K_yy: 0.05}}\nsteps:\n", 1)
    assert any("hidden rig" in problem.message for problem in problems_of(text))
    hidden = read_lab(text.replace("worn:", "true_rig: hidden\nworn:", 1))
    assert true_rig(hidden, 1)["parameters"]["K_yy"] == pytest.approx(0.05, rel=0.2)
