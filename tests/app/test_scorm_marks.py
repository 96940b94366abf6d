"""What the page of a package marks beside the core's marks: goals met, right answers, points are the same."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from app.scorm import lab_content, steps_left_out
from heli2dof_core.labs import Lab, mark, read_lab, shipped_labs, start_body, student_rig
from heli2dof_core.labs.bodies import body_of_flat
from heli2dof_core.labs.rigs import solution_flat
from tests.children import ROOT

Ask = Callable[[dict[str, Any]], dict[str, Any]]
OWN = [read_lab((ROOT / name).read_text("utf-8")) for name in ("tests/labs/small.yaml", "tests/packed.yaml")]
RIGS = 8
NODE = str(Path(sys.executable).with_name("node"))
LABS = [lab for lab in (*OWN, *shipped_labs().values()) if len(steps_left_out(lab)) < len(lab.steps)]


@contextmanager
def page(content: dict[str, Any]) -> Iterator[Ask]:
    """The page's modules in Node: one line for one line."""
    command = [NODE, str(ROOT / "tests/page/package_marks.mjs")]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    ) as child:
        assert child.stdin is not None and child.stdout is not None
        to, back = child.stdin, child.stdout
        to.write(json.dumps(content) + "\n")

        def asked(attempt: dict[str, Any]) -> dict[str, Any]:
            to.write(json.dumps(attempt) + "\n")
            to.flush()
            return json.loads(back.readline())

        yield asked
        to.close()


def answers_to(lab: Lab, step: str, rig: Mapping[str, Any], body: Any, right: bool) -> dict[str, Any]:
    """All answers of a step, right or wrong."""
    from heli2dof_core.labs.context import Context
    from heli2dof_core.labs.questions import ChoiceQuestion, NumberQuestion

    own = lab.step(step)
    context = Context(lab, own, rig, body)
    found: dict[str, Any] = {}
    for question in own.questions:
        if isinstance(question, ChoiceQuestion):
            wrong = next(i for i in range(1, len(question.choices) + 1) if (i,) != question.answer)
            found[question.name] = question.answer[0] if len(question.answer) == 1 else [*question.answer]
            if not right:
                found[question.name] = wrong
        elif isinstance(question, NumberQuestion):
            value = question.right(context)
            if value is not None:
                shown = value if right else value * 1.5 + 1
                found[question.name] = f"{shown:.6g} {question.unit}".replace(".", ",").replace("-", "−")
        else:
            found[question.name] = "Because."
    return found


def compared(page_told: Mapping[str, Any], core_told: Any) -> None:
    assert page_told["name"] == core_told.name
    near = core_told.name, core_told.value_text, page_told["value_text"], page_told["message"]
    assert page_told["met"] is core_told.met, near


@pytest.mark.parametrize("lab", LABS, ids=lambda lab: lab.name)
def test_the_page_marks_as_the_core_does(lab: Lab):
    content, left_out = lab_content(lab, rigs=RIGS)
    gone = {each.step for each in left_out}
    with page(content) as ask:
        for place in range(len(content["rigs"])):
            rig = student_rig(lab, place)
            assert content["rigs"][place]["rig"] == rig
            for step in (each for each in lab.steps if each.name not in gone):
                start = start_body(lab, step.name, rig)
                solved = solution_flat(lab, step, rig)
                bodies = {"start": start} | ({} if solved is None else {"solution": body_of_flat(solved)})
                for which, body in bodies.items():
                    right = which == "solution"
                    answers = answers_to(lab, step.name, rig, body, right)
                    hints = [1] if step.hints and right else []
                    told = ask(
                        {"rig": place, "step": step.name, "body": body, "answers": answers, "hints": hints}
                    )
                    marked = mark(lab, step.name, rig, told["body"], answers, hints=hints)
                    assert told["rig"] == place
                    assert told["marked"]["stable"] == marked.stable
                    for mine, core in zip(told["marked"]["goals"], marked.goals, strict=True):
                        compared(mine, core)
                    for mine, core in zip(told["marked"]["questions"], marked.questions, strict=True):
                        compared(mine, core)
                    assert told["marked"]["points"] == pytest.approx(marked.points)
                    assert told["marked"]["of"] == pytest.approx(marked.of - marked.by_hand)


NUMBERS = [
    "5",
    "−2,5",
    "- 3",
    "1e-3",
    "3·10^2",
    "3 × 10^-2",
    "1.5e3",
    "+4",
    ".5",
    "",
    "x",
    "1 2",
    "0x10",
    "1,2,3",
]
UNITS = [
    "",
    "s",
    "ms",
    "rad",
    "deg",
    "°",
    "rad/s",
    "1/s",
    "deg/s",
    "V",
    "%",
    "dB",
    "N·m",
    "Nm",
    "kg m2",
    "parsec",
]


def test_amounts_are_read_as_the_core_reads_them():
    """Every number with every unit, asked for in every unit."""
    from app.scorm.answers import right_answer
    from heli2dof_core.labs.questions import NumberQuestion

    chosen = random.Random(3)
    questions = [
        NumberQuestion(name=f"q{i}", text="?", answer=1.0, unit=unit, absolute=0.5)
        for i, unit in enumerate(["", "s", "ms", "rad", "°", "rad/s", "V", "%", "dB", "N·m", "kg·m²"])
    ]
    typed = [f"{number} {unit}".strip() for number in NUMBERS for unit in UNITS]
    tasks = [[right_answer(question), chosen.choice(typed)] for question in questions for _ in range(150)]
    script = (
        "import { judgedAnswer } from './static/scorm/questions.js';"
        "import { readFileSync } from 'node:fs';"
        "const tasks = JSON.parse(readFileSync(0, 'utf8'));"
        "const own = { reply: null, body: {}, figure: () => undefined, stable: () => false };"
        "console.log(JSON.stringify(tasks.map(([right, answer]) =>"
        "  judgedAnswer(right, answer, { known: 1, ...own }))));"
    )
    out = subprocess.run(
        [NODE, "--input-type=module", "-e", script],
        input=json.dumps(tasks),
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=True,
        cwd=ROOT,
    ).stdout
    by_unit = {question.unit: question for question in questions}
    for (right, answer), told in zip(tasks, json.loads(out), strict=True):
        core = by_unit[right["unit"]].judge(answer, None)  # pyright: ignore[reportArgumentType]
        assert told["met"] == core.met, (right["unit"], answer, told, core)
