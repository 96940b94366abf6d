"""What of a lab leaves the server: the student's part of it without answers, and the instructor's with all."""

from __future__ import annotations

from typing import Any

from ..errors import InvalidInputError
from .lab import Goal, Hint, Lab, Question, Step
from .locks import locked
from .math import math_of


def student_view(lab: Lab) -> dict[str, Any]:
    """JSON for the page: no answers, no solutions, nothing of the instructor's, and no hint that costs points."""
    return {
        "name": lab.name,
        "title": lab.title,
        "summary": lab.summary,
        **({} if lab.number is None else {"number": lab.number}),
        **({} if lab.minutes is None else {"minutes": lab.minutes}),
        "preset": lab.preset,
        "alone": lab.alone,
        "hidden_rig": lab.hidden_rig,
        "points": lab.points,
        "text": lab.text,
        "end": lab.end,
        "steps": [_step(lab, step) for step in lab.steps],
        "math": math_of(_texts(lab)),
    }


def instructor_view(lab: Lab) -> dict[str, Any]:
    """The same with answers, solutions, hints and the instructor's text."""
    own = student_view(lab)
    own["instructor"] = lab.instructor
    own["rig"], own["vary"] = lab.rig, dict(lab.vary)
    if lab.hidden_rig:
        own["worn"] = lab.worn
    for step, told in zip(lab.steps, own["steps"], strict=True):
        told["hints"] = [{"cost": hint.cost, "text": hint.text} for hint in step.hints]
        if step.solution is not None:
            told["solution"] = step.solution
        for question, asked in zip(step.questions, told["questions"], strict=True):
            asked.update(question.answered())
    samples = [getattr(q, "sample", "") for step in lab.steps for q in step.questions]
    hints = [hint.text for step in lab.steps for hint in step.hints]
    own["math"] = math_of([*_texts(lab), lab.instructor, *samples, *hints])
    return own


def hint_view(lab: Lab, step_name: str, n: int) -> dict[str, Any]:
    """One hint, whatever it costs, by its number from 1.

    Raises:
        InvalidInputError: there is no such step or hint.
    """
    hints = lab.step(step_name).hints
    if not 1 <= n <= len(hints):
        raise InvalidInputError(
            f"there is no hint {n}", field="hint", value=n, hint=f"There are {len(hints)}."
        )
    return {"text": hints[n - 1].text, "cost": hints[n - 1].cost, "math": math_of([hints[n - 1].text])}


def _step(lab: Lab, step: Step) -> dict[str, Any]:
    judged = (
        {"page": False} if lab.hidden_rig else {}
    )  # a page does not know the rig that goals are judged on
    return {
        "name": step.name,
        "title": step.title,
        "text": step.text,
        "view": step.view,
        "continue": step.continues,
        "start": step.start,
        "unlocked": [*step.unlocked],
        "locked": [*locked(step.unlocked)],
        "hidden": [*step.hidden],
        "recording": lab.hidden_rig,
        "points": step.points,
        "goals": [{**_goal(goal), **judged} for goal in step.goals],
        "questions": [_question(question) for question in step.questions],
        "hints": [_hint(hint) for hint in step.hints],
    }


def _goal(goal: Goal) -> dict[str, Any]:
    return {
        "name": goal.name,
        "kind": goal.kind,
        "label": goal.label,
        "required_text": goal.required_text,
        "points": goal.points,
        "unstable": goal.unstable,
        **goal.told(),
    }


def _question(question: Question) -> dict[str, Any]:
    return {
        "name": question.name,
        "kind": question.kind,
        "text": question.text,
        "points": question.points,
        **question.told(),
    }


def _hint(hint: Hint) -> dict[str, Any]:
    return {"cost": hint.cost} if hint.cost else {"cost": 0, "text": hint.text}


def _texts(lab: Lab) -> list[str]:
    """All Markdown that a student reads without paying."""
    found = [lab.text, lab.end, lab.summary]
    for step in lab.steps:
        found.append(step.text)
        found += [hint.text for hint in step.hints if not hint.cost]
        for question in step.questions:
            found += [question.text, *question.told().get("choices", ())]
        found += [goal.label for goal in step.goals]
    return found
