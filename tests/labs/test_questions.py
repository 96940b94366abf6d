"""Answers in any usual notation; quantities of the student's own rig, held against NumPy and the registry."""

from __future__ import annotations

import numpy as np
import pytest

from heli2dof_core import Observer, PoleSet, Spec, evaluate, preset
from heli2dof_core.labs import mark, read_lab, start_body, student_rig
from heli2dof_core.labs.amounts import amount, in_unit, unit_of, units_for
from heli2dof_core.labs.marking import right_answers
from heli2dof_core.labs.quantities import QUANTITIES, quantity_named
from heli2dof_core.measured import MEASURED

HEAD = """
lab: 1
name: asked
title: Questions
vary: {B_p: 15 %, K_pp: 10 %, l: 10 %}
steps:
  - name: one
    title: One
    start:
      poles: [-3 ± 4j, -9.25, -8.76]
      loops: {pitch: {kp: 10, ti: 0.5}, yaw: {kp: 8, ti: 0.6}}
      observer: {poles: [-40, -41, -42, -43]}
      scenario: {measured: observer, duration: 8 s}
    unlocked: [poles]
    solution: {poles: [-5 ± 4j, -6, -7]}
    questions:
"""


OBSERVER = Observer(PoleSet([-40, -41, -42, -43]))


def asked(*questions: str):
    lines = "".join(f"      - {{name: q{i}, text: What?, {own}}}\n" for i, own in enumerate(questions))
    return read_lab(HEAD + lines)


def told(question: str, answer, seed: int = 5):
    lab = asked(question)
    rig = student_rig(lab, seed)
    return mark(lab, "one", rig, start_body(lab, "one", rig), {"q0": answer}, seed=seed).questions[0]


NOTATIONS = [
    "-3.25",
    "−3.25",
    "–3.25",
    "-3,25",
    " -3.25 ",
    "-3.25 rad/s",
    "−3,25 rad/s",
    "-3.25 1/s",
    "-3.25rad/s",
    "-0.325e1",
    "-0,325·10^1",
    "-32.5 x 10^-1",
    "-3.25 s^-1",
    -3.25,
    "-186.2 °/s",
    "-186.2 deg/s",
]


@pytest.mark.parametrize("answer", NOTATIONS, ids=str)
def test_an_answer_may_be_written_in_any_usual_notation(answer):
    assert told("answer: -3.25, unit: rad/s, tolerance: 0.1 %", answer).met is True


@pytest.mark.parametrize(
    "answer",
    [
        "3.25",
        "-3.25 V",
        "-3.3",
        "",
        "  ",
        "none",
        "-3.25 furlongs",
        None,
        True,
        "1e999",
        float("nan"),
        float("inf"),
        [],
        {},
        "-3.25 dB",
        "9" * 5000,
    ],
)
def test_a_wrong_answer_is_wrong(answer):
    own = told("answer: -3.25, unit: rad/s, tolerance: 1 %", answer)
    assert own.met is False and own.points == 0
    if not isinstance(answer, str) or answer not in ("3.25", "-3.3"):
        assert own.message


def test_tolerances():
    for tolerance, given, met in (
        ("2 %", 10.2, True),
        ("2 %", 10.21, False),
        ("0.5", 10.5, True),
        ("0.5", 10.51, False),
        ("500 ms", 9.5, True),
        ("500 ms", 9.49, False),
        ("0", 10, True),
        ("0", 10.001, False),
    ):
        assert told(f"answer: 10, unit: s, tolerance: {tolerance}", given).met is met, (tolerance, given)
    assert told("answer: 10", 10.2).met is True and told("answer: 10", 10.3).met is False  # 2 % by itself
    assert told("answer: 5 %, unit: '%', tolerance: 0.5", "5.4 %").met is True
    assert told("answer: 5 %, unit: '%', tolerance: 0.5", "5.6").met is False
    assert told("answer: 6 dB, unit: dB, tolerance: 0.5 dB", "6,4").met is True
    assert told("answer: 200 ms, unit: s, tolerance: 1 %", "0.2").met is True
    assert told("answer: -4, sign: any", "4").met is True


def test_choices():
    one = "kind: choice, choices: [a, b, c], answer: 2"
    for answer, met in (
        (2, True),
        ("2", True),
        ([2], True),
        (1, False),
        ([1, 2], False),
        ("b", False),
        (None, False),
        (4, False),
        (0, False),
        (True, False),
        ([], False),
        (2.5, False),
        ({}, False),
        ("2, 3", False),
    ):
        assert told(one, answer).met is met, answer
    several = "kind: choice, choices: [a, b, c], answer: [1, 3]"
    for answer, met in (
        ([1, 3], True),
        ([3, 1], True),
        ("1, 3", True),
        ("1,3", True),
        ([1], False),
        ([1, 2, 3], False),
    ):
        assert told(several, answer).met is met, answer


def test_a_text_is_marked_by_a_person():
    own = told("kind: text, points: 3, sample: Because.", "It is so.")
    assert own.met is None and own.points == 0 and own.of == 3 and own.value_text == "It is so."
    assert told("kind: text", "  ").met is False
    lab = asked("kind: text, points: 3", "answer: 1")
    rig = student_rig(lab, 1)
    marked = mark(lab, "one", rig, {}, {"q0": "x", "q1": 1})
    assert (marked.points, marked.of, marked.by_hand) == (1, 4, 3)


def test_quantities_are_the_rigs():
    """Entries and poles by NumPy from the student's parameters; figures by the core's report."""
    lab = asked("answer: 1")
    for seed in range(3):
        rig = student_rig(lab, seed)
        body = start_body(lab, "one", rig)
        p = preset().parameters.replaced(rig["parameters"])
        alpha, beta = p.J_p + p.m * p.l**2, p.J_y + p.m * p.l**2
        trim = np.linalg.solve([[p.K_pp, p.K_py], [p.K_yp, p.K_yy]], [p.m * p.g * p.l, 0])
        report = evaluate(
            Spec.from_preset(
                parameters=rig["parameters"],
                poles=[-3 + 4j, -3 - 4j, -9.25, -8.76],
                pitch=(10, 0.5),
                yaw=(8, 0.6),
                observer=OBSERVER,
                measured="observer",
                duration=8,
            ),
            each_axis=True,
        )
        poles = sorted(report.loop.connected_poles, key=lambda q: -q.real)
        wanted = {
            "alpha": alpha,
            "beta": beta,
            "gamma": p.K_py * p.K_yp - p.K_pp * p.K_yy,
            "B_p": p.B_p,
            "l": p.l,
            "trim_V_p": trim[0],
            "trim_V_y": trim[1],
            "A[3,3]": -p.B_p / alpha,
            "B[3,1]": p.K_pp / alpha,
            "B[4,1]": p.K_yp / beta,
            "K[1,1]": report.design.K[0, 0],
            "K[2,3]": report.design.K[1, 2],
            "slowest_pole": poles[0].real,
            "fastest_pole": poles[-1].real,
            "loop_pole_re[2]": poles[1].real,
            "order": len(poles),
            "lambda_11": report.interaction.relative_gain,
            "rga[1,2]": 1 - report.interaction.relative_gain,
            "niederlinski": 1 / report.interaction.relative_gain,
            "loops.pitch.kp": 10,
            "loops.pitch.ti": 0.5,
            "limits.V_p": 24,
            "lag_margin": report.loop.lag_margin,
        }
        questions = [f"answer: {{quantity: '{name}'}}" for name in wanted]
        found = right_answers(asked(*questions), "one", rig, body, seed=seed)
        for own, (name, value) in zip(found.values(), wanted.items(), strict=True):
            assert own["value"] == pytest.approx(value, rel=1e-9), name


def test_figures_are_of_the_design_that_is_meant():
    questions = [
        f"answer: {{quantity: settling_time, axis: theta, of: {of}}}" for of in ("own", "start", "solution")
    ]
    lab = asked(*questions, "answer: {quantity: rise_time, axis: both}")
    rig = student_rig(lab, 7)
    own = start_body(lab, "one", rig) | {"poles": [-4, -5, -4, -5]}
    found = [own["value"] for own in right_answers(lab, "one", rig, own, seed=7).values()]
    for value, poles in zip(
        found, ([-4, -5, -4, -5], [-3 + 4j, -3 - 4j, -9.25, -8.76], [-5 + 4j, -5 - 4j, -6, -7]), strict=False
    ):
        spec = Spec.from_preset(
            parameters=rig["parameters"],
            poles=poles,
            pitch=(10, 0.5),
            yaw=(8, 0.6),
            observer=OBSERVER,
            measured="observer",
            duration=8,
        )
        steps = evaluate(spec, each_axis=True).axis_steps
        assert value == pytest.approx(
            steps["theta"]["nonlinear"].metrics.axes["theta"].settling_time, abs=1e-9
        )
    spec = Spec.from_preset(
        parameters=rig["parameters"],
        poles=[-4, -5, -4, -5],
        pitch=(10, 0.5),
        yaw=(8, 0.6),
        observer=OBSERVER,
        measured="observer",
        duration=8,
    )
    steps = evaluate(spec, each_axis=True).axis_steps
    rises = [steps[a]["nonlinear"].metrics.axes[a].rise_time for a in steps]
    assert found[3] == pytest.approx(max(rises)) and max(rises) > min(rises)
    worse = right_answers(asked("answer: {quantity: phase_margin}"), "one", rig, own)["q0"]["value"]
    margins = [m.phase_margin for m in evaluate(spec).margins]
    assert np.radians(worse) == pytest.approx(min(margins)) and min(margins) < max(margins)


def test_every_quantity_can_be_asked_for_and_has_a_unit_that_is_known():
    for name, own in QUANTITIES.items():
        unit = own.shown or own.unit
        assert own.meaning
        indices = "" if not own.shape else "[1]" if len(own.shape) == 1 else "[1,1]"
        assert quantity_named(name + indices) == (own, (1,) * len(own.shape))
        assert quantity_named(name + ("[9,9]" if len(own.shape) < 2 else "[1]")) is None
        axis = ", axis: theta" if name in MEASURED and MEASURED[name].has_axis else ""
        lab = asked(f"answer: {{quantity: '{name}{indices}'{axis}}}")
        rig = student_rig(lab, 1)
        right_answers(lab, "one", rig, start_body(lab, "one", rig), seed=1)
        if unit_of(unit) is None:
            assert lab.steps[0].questions[0].unit == ""
        else:
            assert lab.steps[0].questions[0].unit == unit_of(unit)


def test_units_go_there_and_back():
    for si in ("s", "rad", "", "V", "N·m", "rad/s", "kg·m²"):
        for unit in units_for(si):
            value = amount(f"2.5 {unit}", si)
            assert value is not None and in_unit(value, si, unit) == pytest.approx(2.5), (si, unit)
    assert amount("5 %", "%") == 5 and amount("5", "") == 5 and amount("1,5e-3 Nm", "N·m") == 1.5e-3
    assert amount("2 V", "s") is None and amount("1.2.3", "s") is None and amount("", "s") is None
