"""A lab's file → a lab, or all that is wrong with it."""

from __future__ import annotations

from ..errors import Heli2DofError
from .bodies import flat_body, tell_refusal
from .format import LAB
from .kinds import Reading, Unusable
from .lab import Lab
from .nodes import nodes_of
from .problems import LabError, LabProblem
from .rigs import lab_rig, solution_flat, start_flat, true_rig


def read_lab(text: str, name: str = "") -> Lab:
    """The lab that a file's text describes.

    Args:
        text: YAML, see docs/labs.md.
        name: of the file, for messages.

    Raises:
        LabError: with all its problems, each with line and column.
    """
    lab, at = _read(text, name)
    if lab is None or at.errors:
        raise LabError(at.errors, name)
    return lab


def problems_of(text: str) -> tuple[LabProblem, ...]:
    """All that is wrong or unwise, in the file's order; warnings are looked for where there are no errors."""
    try:
        lab, at = _read(text, "")
    except LabError as error:
        return error.problems
    if lab is not None and not at.errors:
        from .lint import tell_unwise

        tell_unwise(lab, at)
    return tuple(sorted(at.problems))


def _read(text: str, name: str) -> tuple[Lab | None, Reading]:
    at = Reading()
    try:
        root = nodes_of(text)
    except LabError as error:
        raise LabError(error.problems, name) from None
    at.places[""] = root
    try:
        lab = LAB.read(root, at, "")
    except Unusable:
        return None, at
    if not at.errors:
        _require_designs(lab, at)
    return lab, at


def _require_designs(lab: Lab, at: Reading) -> None:
    """Tells of rigs, starts and solutions that are no designs."""
    rig = lab_rig(lab)
    try:
        flat_body(rig)
    except Heli2DofError as error:
        return tell_refusal(error, at, "rig")
    try:
        true_rig(lab, 0)
    except Heli2DofError as error:
        return at.tell_at(error.field, str(error), error.hint)
    for i, step in enumerate(lab.steps):
        try:
            start_flat(lab, step, rig)
        except Heli2DofError as error:
            tell_refusal(error, at, f"steps[{i}].start")
            return None  # what continues it has the same
        try:
            solution_flat(lab, step, rig)
        except Heli2DofError as error:
            tell_refusal(error, at, f"steps[{i}].solution")
    return None
