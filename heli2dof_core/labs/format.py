"""The file's format, written once: from its records follow reader, JSON schema and the documentation's tables."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from ..presets import DEFAULT, PRESETS
from .bodies import SPREAD, BodyPart
from .goals import GOAL
from .goals.goal import MOST_POINTS
from .kinds import Flag, ListOf, Member, Name, Number, OneOf, Reading, Record, Text
from .lab import FORMAT, Hint, Lab, Step
from .locks import HIDDEN, LOCKS
from .question_records import QUESTION

VIEWS = ("explore", "design", "compare", "rig", "derivation", "plant", "fly")
"""Where a step may lead."""
RIG = ("parameters", "limits", "rotors", "friction", "operating_point", "scenario")
"""What makes a lab's rig, of a design body."""

HINT: Record[Hint] = Record(
    Hint,
    (
        Member("text", Text(), "Markdown", required=True),
        Member("cost", Number(0, MOST_POINTS), "in points, 0 where left out"),
    ),
    "the hint",
)


def _named_goals(goals: tuple[Any, ...]) -> tuple[Any, ...]:
    """With names for those that have none, each once in the step."""
    found: list[Any] = []
    taken = {goal.name for goal in goals if goal.name}
    for goal in goals:
        name = goal.name
        if not name:
            stem = "-".join(filter(None, _name_parts(goal))).replace("_", "-").lower()
            name, n = stem, 2
            while name in taken:
                name, n = f"{stem}-{n}", n + 1
            taken.add(name)
        found.append(goal.named(name))
    return tuple(found)


def _name_parts(goal: Any) -> tuple[str, ...]:
    told = goal.told()
    own = told.get("figure") or told.get("share") or told.get("path", "").rpartition(".")[2] or goal.kind
    return (own, told.get("axis", ""), told.get("motor", ""))


def _step(**values: Any) -> Step:
    values["goals"] = _named_goals(values.get("goals", ()))
    return Step(**values)


def _check_step(step: Step, at: Reading, path: str) -> None:
    for what, names in (
        ("goals", [g.name for g in step.goals]),
        ("questions", [q.name for q in step.questions]),
    ):
        _tell_twice(names, at, path, what)
    flights = [(i, goal.told()) for i, goal in enumerate(step.goals) if goal.kind == "flight"]
    for i, own in flights[1:]:
        for part in ("task", "changes", "seed"):
            if own.get(part) != flights[0][1].get(part):
                hint = "With an attempt one flight is handed in; put the other into a step of its own."
                at.tell_at(f"{path}.goals[{i}].{part}", f"a step's goals differ in {part}", hint)


def _tell_twice(names: list[str], at: Reading, path: str, what: str) -> None:
    for i, name in enumerate(names):
        if name in names[:i]:
            at.tell_at(
                f"{path}.{what}[{i}].name".lstrip("."), f"{name} is the name of two", "Give each its own."
            )


STEP: Record[Step] = Record(
    _step,
    (
        Member("name", Name(), "unique in the lab", required=True),
        Member("title", Text(120), "what it is called", required=True),
        Member("text", Text(), "Markdown, with formulas between dollars"),
        Member("view", OneOf(VIEWS), "where the page goes; design where left out"),
        Member(
            "start", BodyPart(), "with which design it starts: a part of a design body over the lab's rig"
        ),
        Member(
            "continue",
            Flag(),
            "true: it goes on with the student's own design of the step before, and start changes what it names",
            attribute="continues",
        ),
        Member(
            "unlocked", ListOf(OneOf(tuple(LOCKS)), 30), "what the student may change; all else is locked"
        ),
        Member("hidden", ListOf(OneOf(HIDDEN), 30), "what the page does not tell"),
        Member("goals", ListOf(GOAL, 30), "what shall be reached"),
        Member("questions", ListOf(QUESTION, 30), "what is asked"),
        Member("hints", ListOf(HINT, 20), "what helps on; each may cost points"),
        Member(
            "solution", BodyPart(), "a design over the start that reaches every goal; students never get it"
        ),
    ),
    "the step",
    _check_step,
)


def _lab(**values: Any) -> Lab:
    values.pop("lab")
    values.setdefault("preset", DEFAULT)
    values["vary"] = MappingProxyType(values.get("vary", {}))
    values["hidden_rig"] = values.pop("true_rig", "") == "hidden"
    for name in ("number", "minutes"):
        if name in values:
            values[name] = int(values[name])
    return Lab(**values)


def _check_lab(lab: Lab, at: Reading, path: str) -> None:
    if lab.worn and not lab.hidden_rig:
        at.tell_at("worn", "only a hidden rig is worn", "Write `true_rig: hidden`, or say it in `rig`.")
    _tell_twice([step.name for step in lab.steps], at, path, "steps")
    for i, step in enumerate(lab.steps):
        if lab.hidden_rig and any(goal.kind == "flight" for goal in step.goals):
            hint = "A page that flies a rig knows it: leave `true_rig` out."
            at.tell_at(f"steps[{i}].goals", "a hidden rig cannot be flown", hint)
    if lab.steps[0].continues:
        at.tell_at("steps[0].continue", "there is no step before the first", "Leave `continue` out.")


LAB: Record[Lab] = Record(
    _lab,
    (
        Member("lab", Number(FORMAT, FORMAT, whole=True), "version of the format, 1", required=True),
        Member("name", Name(), "by which it is called: the file's name without its ending", required=True),
        Member("number", Number(0, 999, whole=True), "its place in a course"),
        Member("title", Text(120), "what it is called", required=True),
        Member("minutes", Number(1, 600, whole=True), "how long it takes"),
        Member("summary", Text(400), "one sentence for the list of labs"),
        Member("preset", OneOf(tuple(PRESETS)), "the rig; the first preset where left out"),
        Member(
            "rig", BodyPart(RIG), "what differs from the preset, for all students: parts of a design body"
        ),
        Member("vary", SPREAD, "by which share parameters differ from student to student, ±"),
        Member("text", Text(), "Markdown before the first step"),
        Member("end", Text(), "Markdown when all is done"),
        Member("instructor", Text(), "Markdown for the instructor alone; students never get it"),
        Member(
            "true_rig",
            OneOf(("hidden",)),
            "hidden: students design on the rig as it is printed, and their own, which varies, has to be identified",
        ),
        Member(
            "worn",
            BodyPart(RIG),
            "where the true rig is hidden: how all true rigs differ from the printed one, before they vary",
        ),
        Member("alone", Flag(), "whether it may be done without a class; true where left out"),
        Member("steps", ListOf(STEP, 40, 1), "in order", required=True),
    ),
    "the lab",
    _check_lab,
)
