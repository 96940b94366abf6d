"""Goals on what the student sets: read in any unit, judged and told in the one in which they are written."""

from __future__ import annotations

import pytest

from heli2dof_core.labs import mark, problems_of, read_lab, start_body, student_rig, student_view

LAB = """
lab: 1
name: small
title: Small
steps:
  - name: slow
    title: Slow
    start: {scenario: {reference: {psi: 20 °}, digital: {sample_time: 5 ms}}}
    unlocked: [sample-time, yaw-pi]
    goals:
      - {kind: setting, path: scenario.digital.sample_time, min: 20 ms, max: 0.04 s, points: 2}
      - {kind: setting, path: loops.yaw.kp, max: 20, label: A gentle loop, unstable: allowed}
"""


def marked(sample_time, kp=30.0):
    lab = read_lab(LAB)
    rig = student_rig(lab, 1)
    body = start_body(lab, "slow", rig)
    body["scenario"]["digital"]["sample_time"] = sample_time
    body["loops"]["yaw"]["kp"] = kp
    return mark(lab, "slow", rig, body, {}).goals


@pytest.mark.parametrize(
    ("sample_time", "met"), [(0.005, False), (0.02, True), (0.0199, False), (0.04, True), (0.041, False)]
)
def test_a_setting_is_met_within_its_limits(sample_time, met):
    goal = marked(sample_time)[0]
    assert goal.met is met
    assert goal.required_text == "20 ms to 40 ms"
    assert goal.value == pytest.approx(sample_time)
    assert goal.value_text == f"{1e3 * sample_time:g} ms"


def test_labels_and_units_are_the_files_or_the_quantitys():
    time, gain = marked(0.02, 20.0)
    assert time.label == "Time between two samples" and gain.label == "A gentle loop"
    assert gain.met and gain.required_text == "≤ 20 V/rad"
    assert not marked(0.02, 20.1)[1].met


def test_a_setting_that_is_not_there_is_not_met():
    lab = read_lab(LAB.replace("digital: {sample_time: 5 ms}", "duration: 3 s"))
    rig = student_rig(lab, 1)
    goal = mark(lab, "slow", rig, start_body(lab, "slow", rig), {}).goals[0]
    assert not goal.met and goal.value is None and goal.value_text == "not set"


def test_a_page_is_told_the_path_and_the_scale():
    told = student_view(read_lab(LAB))["steps"][0]["goals"]
    assert told[0]["path"] == "scenario.digital.sample_time"
    assert told[0]["unit"] == "ms" and told[0]["scale"] == pytest.approx(1000)
    assert (told[0]["min"], told[0]["max"]) == (20, 40)
    assert told[1]["unit"] == "V/rad" and told[1]["scale"] == 1 and "min" not in told[1]


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        ("min: 20 ms, max: 0.04 s", "min: 20 V", "does not fit"),
        ("min: 20 ms, max: 0.04 s, ", "", "neither max nor min"),
        ("min: 20 ms, max: 0.04 s", "min: 50 ms, max: 20 ms", "min is above max"),
        ("scenario.digital.sample_time, min", "parameters.K_pp, min", "parameters.K_pp"),
        ("min: 20 ms", "min: [1]", "not a value"),
    ],
)
def test_what_is_wrong_is_told_where_it_stands(before, after, words):
    text = LAB.replace(before, after)
    problems = [p for p in problems_of(text) if p.severity == "error"]
    assert problems and words in problems[0].message
    assert problems[0].line == 1 + text[: text.index("kind: setting")].count("\n")
