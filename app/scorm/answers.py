"""Right answers to a lab's questions, as a package holds them.

Those that depend on a student's rig are there for each rig, those of the student's own design as what the page has to
read of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from heli2dof_core.labs import Lab, Step, start_body
from heli2dof_core.labs.amounts import DECIBEL, conversions, in_unit
from heli2dof_core.labs.bodies import PATHS
from heli2dof_core.labs.context import Context
from heli2dof_core.labs.lab import Question
from heli2dof_core.labs.quantities import Asked
from heli2dof_core.labs.questions import ChoiceQuestion, NumberQuestion
from heli2dof_core.measured import MEASURED
from heli2dof_core.parameters import PARAMETER_INFO

OF_THE_RIG = frozenset((*PARAMETER_INFO, "alpha", "beta", "gamma"))
"""Quantities that are the same of every design on a rig."""

READABLE = frozenset(
    (
        *("K", "A", "B", "L", "rga", "niederlinski", "niederlinski_cross", "slowest_pole", "fastest_pole"),
        *("loop_pole_re", "loop_pole_im", "order", "damping", "trim_V_p", "trim_V_y"),
        *("largest_step_theta", "largest_step_psi", "largest_kp_pitch", "largest_kp_yaw"),
    )
)
"""Quantities of the student's own design, beside figures and what stands in it, that the page can read
(static/scorm/quantities.js)."""


def unreadable(question: Question) -> str:
    """What a question asks of the student's own design that the page cannot read; empty: nothing."""
    asked = _of_own_design(question) if isinstance(question, NumberQuestion) else None
    name = "" if asked is None else asked.quantity.name
    return "" if not name or name in READABLE or name in MEASURED or name in PATHS else name


def right_answer(question: Question) -> dict[str, Any]:
    """What is right whatever the rig, and for a number how it is read: static/scorm/questions.js.

    Returns:
        with `own`, where the right number is one of the student's own design.
    """
    if isinstance(question, ChoiceQuestion):
        return {"kind": "choice", "answer": [*question.answer]}
    if not isinstance(question, NumberQuestion):
        return {"kind": "text"}
    room = {"tolerance": question.tolerance} if question.absolute is None else {"absolute": question.absolute}
    asked = _of_own_design(question)
    own = {} if asked is None else {"own": _own(asked, question.unit)}
    return {
        "kind": "number",
        "unit": question.unit,
        "units": conversions(question.unit),
        **room,
        **({"either_sign": True} if question.either_sign else {}),
        **own,
    }


def right_numbers(lab: Lab, step: Step, rig: Mapping[str, Any]) -> dict[str, float]:
    """The right numbers of a step on one student's rig, each in its question's unit.

    Those of the student's own design are left out, but for what stands in it: that is the start's value, which holds
    where the page says nothing else. Where there is none on this rig, it is left out.
    """
    context = Context(lab, step, rig, start_body(lab, step.name, rig))
    found = {}
    for question in step.questions:
        if not isinstance(question, NumberQuestion):
            continue
        asked = _of_own_design(question)
        if asked is not None and asked.quantity.name not in PATHS:
            continue
        value = question.right(context)
        if value is not None:
            found[question.name] = value
    return found


def _of_own_design(question: NumberQuestion) -> Asked | None:
    """What a question asks for, where it depends on what the student designs."""
    own = question.answer
    if isinstance(own, Asked) and own.of == "own" and own.quantity.name not in OF_THE_RIG:
        return own
    return None


def _own(asked: Asked, unit: str) -> dict[str, Any]:
    name, where = asked.quantity.name, asked.where
    scale = DECIBEL if unit == DECIBEL else in_unit(1.0, asked.quantity.unit, unit) if unit else 1.0
    own: dict[str, Any] = {"name": name, "indices": [*asked.indices], "scale": scale}
    measured = MEASURED.get(name)
    if measured is not None:
        own["figure"] = {
            "figure": name,
            "of": measured.of,
            "model": where.model,
            "steps": where.steps,
            **({} if where.axis is None else {"axis": where.axis}),
            **({} if where.motor is None else {"motor": where.motor}),
        }
    return own
