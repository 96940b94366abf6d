"""What is allowed in a lab but unwise: goals that nobody reaches, steps without a task, hints that cost too much."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..errors import Heli2DofError
from .bodies import body_of_flat
from .context import Context
from .flights import tried_flight
from .goals.figure import FigureGoal
from .kinds import Reading
from .lab import Lab, Step
from .locks import LOCKS
from .marking import mark
from .math import LONGEST, converted, formulas_in
from .questions import NumberQuestion
from .rigs import lab_rig, solution_flat, start_flat, student_rig

Warn = Callable[[str, str, str], None]
"""Takes path, message and hint."""
SEEDS = (1, 2, 3)
"""Students on whose rigs a solution is tried, besides the rig as it is printed."""


def tell_unwise(lab: Lab, at: Reading) -> None:
    """Notes warnings about a lab without errors."""

    def warn(path: str, message: str, hint: str) -> None:
        at.tell_at(path, message, hint, "warning")

    if not lab.vary:
        warn("steps", "all students have the same rig", "Give `vary: {B_p: 10 %}`, so that none can copy.")
    _formulas(lab, warn)
    for i, step in enumerate(lab.steps):
        path = f"steps[{i}]"
        _task(step, path, warn)
        _hints(step, path, warn)
        for j, goal in enumerate(step.goals):
            if isinstance(goal, FigureGoal):
                _digits(goal, f"{path}.goals[{j}]", warn)
        _solved(lab, step, path, warn)
        _answers(lab, step, path, warn)


def _task(step: Step, path: str, warn: Warn) -> None:
    if not step.goals and not step.questions:
        warn(path, f"the step {step.name} has neither goals nor questions", "Give it one, or make it text.")
    on_design = [
        goal for goal in step.goals if goal.kind != "flight"
    ]  # a flight may be the task, not the design
    if on_design and not any(LOCKS[name] for name in step.unlocked):
        warn(
            f"{path}.unlocked", "there are goals, but all is locked", "Unlock what the student shall change."
        )


def _hints(step: Step, path: str, warn: Warn) -> None:
    costs = sum(hint.cost for hint in step.hints)
    if costs > step.points:
        warn(
            f"{path}.hints",
            f"the hints cost {costs:g} points, the step gives {step.points:g}",
            "Make them cheaper.",
        )


def _digits(goal: FigureGoal, path: str, warn: Warn) -> None:
    for side in ("max", "min"):
        limit = getattr(goal, side)
        if limit is None:
            continue
        plain, exact = goal.measured.written(limit), goal.measured.limit_text(limit)
        if plain != exact:
            hint = f"A value is judged as it is shown, such as {plain}."
            warn(f"{path}.{side}", f"{exact} has more digits than the figure is shown with", hint)


def _formulas(lab: Lab, warn: Warn) -> None:
    texts = {"text": lab.text, "end": lab.end, "instructor": lab.instructor}
    for i, step in enumerate(lab.steps):
        texts[f"steps[{i}].text"] = step.text
        texts |= {f"steps[{i}].hints[{j}].text": hint.text for j, hint in enumerate(step.hints)}
        texts |= {f"steps[{i}].questions[{j}].text": own.text for j, own in enumerate(step.questions)}
    for path, text in texts.items():
        for latex, display in formulas_in(text):
            if converted(latex, display=display) is None:
                short = latex if len(latex) <= 40 else f"{latex[:40]}…"
                hint = f"Mend its LaTeX; a formula has at most {LONGEST} characters. A plain dollar is written \\$."
                warn(path, f"the formula {short} is not understood", hint)


def _solved(lab: Lab, step: Step, path: str, warn: Warn) -> None:
    """Whether start and solution are what they should be, on the printed rig and on a few students'."""
    if not step.goals:
        return
    if step.solution is None:
        warn(
            path,
            f"the step {step.name} has no solution",
            "Give one, so that it is known that goals can be reached.",
        )
        return
    rigs: list[tuple[str, Mapping[str, Any], int]] = [("the rig as it is printed", lab_rig(lab), 0)]
    if lab.vary:
        rigs += [(f"the rig of seed {seed}", student_rig(lab, seed), seed) for seed in SEEDS]
    if lab.hidden_rig:
        rigs = rigs[1:]
    missed: set[str] = set()
    for where, rig, seed in rigs:
        try:
            flat = solution_flat(lab, step, rig, seed)
            body = {} if flat is None else body_of_flat(flat)
            flight = tried_flight(step, body)
            marked = mark(lab, step.name, rig, body, {}, seed=seed, flight=flight)
        except Heli2DofError as error:
            warn(f"{path}.solution", f"on {where} the solution is no design: {error}", error.hint)
            return
        if marked.ignored:
            warn(
                f"{path}.solution",
                f"the solution changes what is locked: {', '.join(marked.ignored)}",
                "Unlock it, or name it in start.",
            )
            return
        for j, told in enumerate(marked.goals):
            if told.met is False and told.name not in missed:
                missed.add(told.name)
                value = told.value_text or told.message
                message = f"on {where} the solution has {value}, required is {told.required_text}"
                warn(f"{path}.goals[{j}]", message, "Move the solution, or ask for less.")
    _begun(lab, step, path, warn)


def _begun(lab: Lab, step: Step, path: str, warn: Warn) -> None:
    rig = lab_rig(lab) if not lab.hidden_rig else student_rig(lab, SEEDS[0])
    body = body_of_flat(start_flat(lab, step, rig))
    flight = tried_flight(step, body)
    marked = mark(lab, step.name, rig, body, {}, seed=SEEDS[0], flight=flight)
    if all(goal.kind == "flight" for goal in step.goals) and not any(LOCKS[name] for name in step.unlocked):
        return  # there is nothing to design: what is to be done is to fly
    if step.goals and all(told.met for told in marked.goals) and not step.continues:
        warn(f"{path}.start", "the start reaches every goal already", "Ask for more, or begin farther away.")


def _answers(lab: Lab, step: Step, path: str, warn: Warn) -> None:
    rig = student_rig(lab, SEEDS[0])
    flat = solution_flat(lab, step, rig, SEEDS[0]) or start_flat(lab, step, rig)
    context = Context(lab, step, rig, body_of_flat(flat), seed=SEEDS[0])
    for j, question in enumerate(step.questions):
        if not isinstance(question, NumberQuestion):
            continue
        right = question.right(context)
        if right is None:
            warn(
                f"{path}.questions[{j}].answer",
                "there is no such value, neither of the start nor of a solution",
                "Ask for something that exists on this rig, or give a solution.",
            )
        elif question.absolute is None and abs(right) < 1e-9:
            warn(
                f"{path}.questions[{j}].tolerance",
                "the answer is 0, of which any percentage is nothing",
                "Give a tolerance in the question's unit.",
            )
