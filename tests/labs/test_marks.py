"""Marks are what others compute: python-control and NumPy of the linear loop, SciPy of the rig.

`HELI2DOF_LAB_ATTEMPTS=500` tries as many.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from math import floor, log10

import numpy as np
import pytest

from heli2dof_core.labs import mark, read_lab, student_rig
from heli2dof_core.measured import MEASURED
from tests.labs.attempts import AXES, MOTORS, Others, random_attempts

ATTEMPTS = int(os.environ.get("HELI2DOF_LAB_ATTEMPTS", "40"))
SCENARIO = {"reference": {"theta": 0.15, "psi": 0.3}, "duration": 6.0}
HEAD = """
lab: 1
name: all-figures
title: Every figure
vary: {B_p: 15 %, K_pp: 10 %, J_y: 10 %, l: 10 %}
rig: {scenario: {reference: {theta: 0.15, psi: 0.3}, duration: 6 s}}
steps:
  - name: one
    title: One
    unlocked: [poles, loops, structure]
    goals:
"""
OF_AXIS = (
    "rise_time",
    "settling_time",
    "overshoot",
    "undershoot",
    "steady_state_error",
    "iae",
    "itae",
    "coupling_peak",
)
BARE = HEAD + "      - {figure: norm, max: 1e9}\n"


def expected(others: Others) -> Iterator[tuple[str, float | None, float]]:
    """Goals' fields in YAML, the value by others, and how far they may be apart."""
    for i, axis in enumerate(AXES):
        rig = others.rig(i)
        for model, own in (("nonlinear", rig), ("linear", others.linear(i))):
            for name in OF_AXIS:
                value = own[name]
                size = {"coupling_peak": 0.15, "steady_state_error": 0.3}.get(name, abs(value or 0.0))
                if name == "settling_time" and value is not None and model == "nonlinear":
                    size = max(size, 0.1)
                least = 1e-4 if name in ("overshoot", "undershoot") else 1e-6  # %, below which none is told
                yield f"figure: {name}, axis: {axis}, model: {model}", value, 1e-4 * size + least
            for motor in MOTORS:
                yield f"figure: V_peak, axis: {axis}, motor: {motor}, model: {model}", own[motor], 1e-2
        for motor in MOTORS:
            effort = rig[f"{motor} effort"]
            yield f"figure: effort, axis: {axis}, motor: {motor}", effort, 1e-4 * effort + 1e-6
            yield f"figure: saturated, axis: {axis}, motor: {motor}", rig[f"{motor} saturated"], 1e-5
    for i, motor in enumerate(MOTORS):
        for name, value in others.margins(i).items():
            yield f"figure: {name}, motor: {motor}", value, 1e-3 * (value or 0.0)
    norms = {"norm": np.linalg.norm(others.K), "spectral_norm": np.linalg.norm(others.K, 2)}
    for name, value in norms.items():
        yield f"figure: {name}", float(value), 1e-6 * value


def limits(name: str, value: float) -> tuple[float, float]:
    """A limit that the value keeps clearly, and one that it clearly does not: beyond what rounding does."""
    figure = MEASURED[name].figure
    if figure.notation == "significant":
        leading = floor(log10(max(abs(value) * figure.scale, 1e-4)))
        whole = leading + 1 if leading >= 0 else leading + 2
        step = 2 * 10.0 ** (whole - figure.digits) / figure.scale
    elif figure.notation == "seconds":
        step = 0.02
    elif figure.notation == "decibel":
        step = 0.05 * value
    else:
        step = 2 * 10.0**-figure.digits / figure.scale
    return float(abs(value) + step), float(abs(value) - step)


@pytest.fixture(scope="module")
def attempts():
    return list(random_attempts(ATTEMPTS, seed=20))


@pytest.mark.slow
def test_marks_are_those_of_others(attempts):
    bare = read_lab(BARE)
    checked = dict.fromkeys(MEASURED, 0)
    unstable = unsettled = 0
    for attempt in attempts:
        others = Others(bare, attempt, SCENARIO)
        if not others.stable:
            unstable += 1
            continue
        wanted = list(expected(others))
        lines, verdicts = [], []
        for fields, value, _ in wanted:
            name = fields.split(",")[0].removeprefix("figure: ")
            if value is None:
                unlimited = MEASURED[name].unlimited
                lines += [f"{{{fields}, max: 1e9}}", f"{{{fields}, min: 0}}"]
                verdicts += [False, unlimited]
                unsettled += name == "settling_time"
                continue
            above, below = limits(name, value)
            lines += [f"{{{fields}, max: {above!r}}}", f"{{{fields}, max: {below!r}}}"]
            lines += [f"{{{fields}, min: {below!r}}}", f"{{{fields}, min: {above!r}}}"]
            verdicts += [True, False, True, False]
            checked[name] += 1
        marked = list(marks_of(lines, attempt))
        told = [goal for part in marked for goal in part.goals]
        assert not [
            (line, goal.value, goal.value_text, met)
            for goal, line, met in zip(told, lines, verdicts, strict=True)
            if goal.met is not met
        ]
        for part in marked:
            assert part.stable and part.ignored == ()
            assert part.points == sum(goal.met for goal in part.goals)
        at = 0
        for fields, value, room in wanted:
            if value is None:
                assert told[at].value is None, fields
                at += 2
                continue
            assert told[at].value == pytest.approx(value, abs=room), fields
            at += 4
    never = {name for name, count in checked.items() if not count}
    assert never <= NOT_HERE
    assert unstable > 0.1 * ATTEMPTS
    assert unsettled > 0


NOT_HERE = {
    "peak",
    "peak_time",
    "gain_reduction_margin",
    "lag_margin",
    "pole_error",
    "pole_error_bound",
    "lambda_11",
}
NOT_HERE |= {"eigenvector_condition", "sensitivity_peak", "sensitivity_peak_frequency", "disk_margin"}
NOT_HERE |= {"disk_frequency", "disk_gain_low", "disk_gain_high", "disk_phase"}
"""Of these the sections below ask, or goals hardly ever."""


def marks_of(lines, attempt):
    """By labs of at most 30 goals, as many as one step takes."""
    for first in range(0, len(lines), 30):
        text = HEAD + "".join(f"      - {line}\n" for line in lines[first : first + 30])
        lab = read_lab(text)
        rig = student_rig(lab, attempt.seed)
        yield mark(lab, "one", rig, attempt.design | rig, {})


def test_unstable_loops_reach_nothing(attempts):
    bare = read_lab(BARE)
    lines = [
        f"{{figure: {name}{', axis: both' if own.has_axis else ''}, max: 1e12, min: -1e12, points: 5}}"
        for name, own in MEASURED.items()
    ]
    lines += ["{kind: cloud, share: stable, min: 0 %, spread: 10 %}"]
    tried = 0
    for attempt in attempts:
        if Others(bare, attempt, SCENARIO).stable:
            continue
        tried += 1
        for marked in marks_of(lines, attempt):
            assert not marked.stable and marked.points == 0
            assert not any(goal.met for goal in marked.goals)
            assert all("unstable" in goal.value_text for goal in marked.goals)
    assert tried > 0.1 * ATTEMPTS


def test_an_unstable_loop_may_be_what_is_asked_for():
    text = HEAD + "      - {figure: undershoot, axis: psi, min: 50 %, unstable: allowed}\n"
    lab = read_lab(text)
    rig = student_rig(lab, 1)
    falling = {**rig, "poles": [-3, -4, 2, -5], "outer": "none"}
    marked = mark(lab, "one", rig, falling, {})
    assert not marked.stable and [goal.met for goal in marked.goals] == [True]
