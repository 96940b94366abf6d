"""What a package holds of a lab: the student's view, rigs, right answers, hints; what is left out, and why."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from heli2dof_core import PRESETS
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.labs import Lab, Step, hint_view, start_body, student_rig, student_view
from heli2dof_core.labs.goals.cloud import CloudGoal
from heli2dof_core.labs.rigs import solution_flat
from heli2dof_core.request import Body, spec_of
from heli2dof_core.robustness import random_factors
from heli2dof_core.spec import Spec

from ..contract.encoding import json_bytes
from ..contract.placement import methods_reply
from ..contract.presets import preset_reply
from .answers import right_answer, right_numbers, unreadable

RIGS = 64
"""So many students' rigs are in a package; which is whose follows from the id that the LMS gives a student."""
PASS = 0.8
"""Share of the points from which a lab counts as passed."""
_METHOD = "full-rank"
_KINDS = {"figure", "cloud", "setting"}
"""Kinds of goals that the page judges by itself."""
_VIEWS = {
    "compare": "it compares methods, which a server computes",
    "rig": "it is done in the view Rig, which needs a server",
    "derivation": "it is done in the view Derivation, which needs a server",
    "plant": "it is done in the view Plant, which needs a server",
    "fly": "it is flown, and flights are marked by a server",
}


@dataclass(frozen=True)
class LeftOut:
    """A step that a package does not have.

    Attributes:
        step: its name.
        title: its title.
        why: the reason, a part of a sentence.
    """

    step: str
    title: str
    why: str


def lab_content(
    lab: Lab, rigs: int = RIGS, passed: float = PASS
) -> tuple[dict[str, Any], tuple[LeftOut, ...]]:
    """What the page reads of a lab (static/scorm/content.js), and the steps that it cannot do.

    Points are given for what the page can mark: none for texts, which a person would have to read.

    Args:
        lab: the lab.
        rigs: how many students' rigs it holds; 1 where nothing varies.
        passed: share of the points from which it counts as passed.

    Raises:
        InvalidInputError: no step of the lab can be done without a server.
    """
    left_out = steps_left_out(lab)
    gone = {each.step for each in left_out}
    kept = [step for step in lab.steps if step.name not in gone]
    if not kept:
        reasons = "; ".join(f"{each.title}: {each.why}" for each in left_out) or "it has no steps"
        raise InvalidInputError(
            f"the lab {lab.name} cannot be done without a server ({reasons})",
            field="lab",
            value=lab.name,
            hint="Give it to a class on a server: docs/labs.md.",
        )
    own = [student_rig(lab, seed) for seed in range(rigs if lab.vary else 1)]
    content = {
        "lab": _without(student_view(lab), gone),
        "left_out": [{"title": each.title, "why": each.why} for each in left_out],
        "pass": passed,
        "presets": [_plain(preset_reply(PRESETS[lab.preset]))],
        "methods": [own for own in map(_plain, methods_reply()) if own["name"] == _METHOD],
        "hints": {
            step.name: [hint_view(lab, step.name, n + 1) for n in range(len(step.hints))] for step in kept
        },
        "answers": {
            step.name: {question.name: right_answer(question) for question in step.questions} for step in kept
        },
        "clouds": {step.name: clouds for step in kept if (clouds := _clouds(step))},
        "rigs": [{"rig": rig, "right": _right(lab, kept, rig)} for rig in own],
    }
    return content, left_out


def steps_left_out(lab: Lab) -> tuple[LeftOut, ...]:
    """The steps that need a server, in the lab's order, each with the first reason."""
    found: list[LeftOut] = []
    rig = student_rig(lab, 0)
    for step in lab.steps:
        before = lab.before(step) if step.continues else None
        if before is not None and any(each.step == before.name for each in found):
            why = f"it goes on with “{before.title}”, which is left out"
        else:
            why = _why_not(lab, step, rig)
        if why:
            found.append(LeftOut(step.name, step.title, why))
    return tuple(found)


def _why_not(lab: Lab, step: Step, rig: Mapping[str, Any]) -> str:
    """Why the page cannot do a step by itself; empty where it can."""
    if lab.hidden_rig:
        return "the student's true rig must stay hidden, and the page would hold it"
    return _VIEWS.get(step.view) or _not_marked(step) or _not_computed(lab, step, rig)


def _not_marked(step: Step) -> str:
    """What of a step the page cannot mark."""
    for goal in step.goals:
        if goal.kind not in _KINDS or goal.told().get("page") is False:
            return f"its goal “{goal.label}” is judged by a server alone"
    for question in step.questions:
        if name := unreadable(question):
            return f"its question {question.name} asks for {name}, which a server computes"
    return ""


def _not_computed(lab: Lab, step: Step, rig: Mapping[str, Any]) -> str:
    """What of a step's designs the page's kernel does not serve."""
    if "weights" in step.unlocked:
        return "it is about the weights of quadratic methods, which a server computes"
    solution = solution_flat(lab, step, rig)
    bodies = {"it starts with": start_body(lab, step.name, rig)}
    if solution is not None:
        bodies["its solution has"] = _body(solution)
    for begins, body in bodies.items():
        if need := _needs(spec_of(body)):
            return f"{begins} {need}, which a server computes"
    return ""


def _body(flat: Mapping[str, Any]) -> Body:
    from heli2dof_core.labs.bodies import body_of_flat

    return body_of_flat(flat)


def _needs(spec: Spec) -> str:
    """What of a design the page's kernel does not serve, as static/kernel/numbers.js has it; empty: nothing."""
    scenario = spec.scenario
    if spec.method != _METHOD:
        return f"the method {spec.method}"
    digital = scenario.digital
    if any(scenario.noise) or (digital is not None and digital.noise):
        return "noise"
    if scenario.measured == "observer" and spec.observer is not None and spec.observer.method == "kalman":
        return "a Kalman filter"
    return ""


def _without(view: dict[str, Any], gone: set[str]) -> dict[str, Any]:
    """The student's view without the steps that are gone, and without points that only a person could give."""
    steps = []
    for step in view["steps"]:
        if step["name"] in gone:
            continue
        asked = [q | {"points": 0} if q["kind"] == "text" else q for q in step["questions"]]
        points = sum(each["points"] for each in (*step["goals"], *asked))
        steps.append(step | {"questions": asked, "points": points})
    return view | {"steps": steps, "points": sum(step["points"] for step in steps)}


def _clouds(step: Step) -> dict[str, str]:
    """By the names of goals on a cloud, by which its rigs differ from the nominal one: float64, lowest byte first."""
    return {
        goal.name: b64encode(random_factors(goal.uncertainty).astype("<f8").tobytes()).decode()
        for goal in step.goals
        if isinstance(goal, CloudGoal)
    }


def _right(lab: Lab, steps: list[Step], rig: Mapping[str, Any]) -> dict[str, dict[str, float]]:
    found = {step.name: right_numbers(lab, step, rig) for step in steps}
    return {name: numbers for name, numbers in found.items() if numbers}


def _plain(reply: Any) -> Any:
    return json.loads(json_bytes(reply))
